//! Stage `syntax`: raw names.
//!
//! In: tokens. Out: the same with `r#arm` as `arm`, which to Rust is one name: what declares it as one and uses it as the other
//! means one thing, and the structs that are generated could not tell them apart. Keywords of Rust stay raw.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

use crate::rust_keywords::is_keyword;

/// Calls without such names are left as they are, with all their spans. Nothing recurses over the nesting of groups.
pub(super) fn plain(tokens: TokenStream) -> TokenStream {
    if !holds_raw(&tokens) {
        return tokens;
    }
    let mut open: Vec<(Delimiter, Span, std::vec::IntoIter<TokenTree>, Vec<TokenTree>)> = Vec::new();
    let mut tokens = list(tokens);
    let mut done: Vec<TokenTree> = Vec::new();
    loop {
        match tokens.next() {
            Some(TokenTree::Group(group)) => {
                let inside = list(group.stream());
                let outside = (group.delimiter(), group.span(), std::mem::replace(&mut tokens, inside), done);
                open.push(outside);
                done = Vec::new();
            }
            Some(TokenTree::Ident(name)) => done.push(TokenTree::Ident(unraw(&name).unwrap_or(name))),
            Some(other) => done.push(other),
            None => {
                let Some((delimiter, span, rest, before)) = open.pop() else { return done.into_iter().collect() };
                let mut group = Group::new(delimiter, std::mem::replace(&mut done, before).into_iter().collect());
                group.set_span(span);
                done.push(TokenTree::Group(group));
                tokens = rest;
            }
        }
    }
}

fn list(tokens: TokenStream) -> std::vec::IntoIter<TokenTree> {
    tokens.into_iter().collect::<Vec<_>>().into_iter()
}

fn holds_raw(tokens: &TokenStream) -> bool {
    let mut waiting = vec![tokens.clone()];
    while let Some(next) = waiting.pop() {
        for token in next {
            match token {
                TokenTree::Group(group) => waiting.push(group.stream()),
                TokenTree::Ident(name) if unraw(&name).is_some() => return true,
                _ => {}
            }
        }
    }
    false
}

/// The plain form of a raw name, if it has one.
fn unraw(name: &Ident) -> Option<Ident> {
    let text = name.to_string();
    let plain = text.strip_prefix("r#")?;
    (!is_keyword(plain)).then(|| Ident::new(plain, name.span()))
}
