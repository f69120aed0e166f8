//! Stage `syntax`: functions of the user's own Rust, `extern name(x, y) = crate::path::Type;`.
//!
//! In: the tokens behind the keyword. Out: the function, with the path of its type as it is written. Generated code stands in
//! a module of its own, and a part's in that of another crate, so a path says from where it counts: it begins with `crate`,
//! `$crate` or `::`. A part that goes to another call takes `$crate` along, by which rustc finds the crate that wrote it.

use proc_macro2::{Delimiter, Group, Ident, Punct, Spacing, TokenStream, TokenTree};

use syn::parse::{ParseStream, Parser};
use syn::{Token, TypePath};

use super::cursor::{Cursor, Read, Reported};
use super::functions::parameters;
use super::keywords::Keyword;
use super::names::{form, name};
use super::tree::{External, ItemKind, Module};
use crate::diagnostics::Diagnostics;

/// Most arguments of one function.
const MOST_ARGUMENTS: usize = 8;

/// What stands behind `extern`; without a name it is lost.
pub(super) fn external(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<External> {
    if let Some(abi) = cursor.literal() {
        diagnostics.error_help(abi.span(), "an `extern` has no ABI here", form(Keyword::Extern));
        return None;
    }
    if cursor.at_word("crate") || cursor.at_word("fn") {
        let message = format!("expected a name after `extern`, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form(Keyword::Extern));
        return None;
    }
    let name = name(Keyword::Extern, cursor, diagnostics).ok()?;
    let (parameters, path) = rest(cursor, diagnostics).unwrap_or_else(|Reported| {
        cursor.skip_item();
        Default::default()
    });
    Some(External { name, parameters, path })
}

/// `(x, y) = crate::path::Type;`
fn rest(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<(Vec<Ident>, TokenStream)> {
    let form = form(Keyword::Extern);
    let Some(head) = cursor.take_group(Delimiter::Parenthesis) else {
        let message = format!("expected `(` and the names of arguments, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form);
        return Err(Reported);
    };
    let empty = "what takes none is a `const`, a `param` or an `input`";
    let parameters = parameters(&mut cursor.enter(&head, diagnostics)?, empty, &form, diagnostics)?;
    if let Some(first) = parameters.get(MOST_ARGUMENTS) {
        let message = format!("a function of Rust has at most {MOST_ARGUMENTS} arguments");
        diagnostics.error(first.span(), message);
        return Err(Reported);
    }
    if cursor.take("=").is_none() {
        diagnostics.error_help(cursor.span(), format!("expected `=`, found {}", cursor.found()), form);
        return Err(Reported);
    }
    let path = path(cursor, diagnostics)?;
    Ok((parameters, path))
}

/// `crate::path::Type;`
fn path(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<TokenStream> {
    let (first, found) = (cursor.span(), cursor.found());
    let start = cursor.position();
    cursor.skip_within_item(&[]);
    let path = cursor.since(start);
    if path.is_empty() {
        let message = format!("expected the path of a type, found {found}");
        diagnostics.error_help(first, message, form(Keyword::Extern));
        return Err(Reported);
    }
    if !says_from_where(&path) {
        let message = "the path of a function of Rust begins with `crate` or `::`";
        let help = "generated code stands in a module of its own: write `crate::path::Type` or `::name_of_crate::Type`";
        diagnostics.error_help(first, message, help);
        return Err(Reported);
    }
    // Outside of rustc the `$` of a macro is a token of its own. A path that ends too early is reported where it ends: syn
    // has no place for the end of its tokens, so they end with a token of the user's.
    let mut end = Punct::new(';', Spacing::Alone);
    end.set_span(if cursor.at(";") { cursor.span() } else { cursor.last_span() });
    let plain = path.clone().into_iter().filter(|token| !is_dollar(token)).chain([end.into()]).collect();
    let whole = |input: ParseStream| input.parse::<TypePath>().and(input.parse::<Token![;]>());
    if let Err(error) = whole.parse2(plain) {
        let message = format!("this is no path of a type: {error}");
        diagnostics.error_help(error.span(), message, form(Keyword::Extern));
        return Err(Reported);
    }
    if cursor.take(";").is_none() {
        diagnostics.error(cursor.last_span(), "missing `;` at the end of this item");
    }
    Ok(path)
}

fn is_dollar(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == '$')
}

fn says_from_where(path: &TokenStream) -> bool {
    match path.clone().into_iter().next() {
        Some(TokenTree::Ident(word)) => word == "crate" || word == "$crate",
        Some(TokenTree::Punct(punct)) => matches!(punct.as_char(), ':' | '$'),
        _ => false,
    }
}

/// Whether a module calls functions of the crate that wrote it. Then its text doesn't say which these are.
pub(super) fn names_its_crate(module: &Module) -> bool {
    module.items.iter().any(|item| match &item.kind {
        ItemKind::External(function) => {
            let says = |token| {
                matches!(&token, TokenTree::Ident(word) if word == "crate" || word == "$crate") || is_dollar(&token)
            };
            function.path.clone().into_iter().any(says)
        }
        _ => false,
    })
}

/// A module's tokens as another crate reads them: with `$crate` where a path begins with `crate`.
pub(super) fn from_elsewhere(module: &Module) -> TokenStream {
    if !names_its_crate(module) {
        return module.tokens.clone();
    }
    let items = |group: Group| {
        let mut own = Group::new(group.delimiter(), in_items(group.stream()));
        own.set_span(group.span());
        own
    };
    let token = |token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => TokenTree::Group(items(group)),
        other => other,
    };
    module.tokens.clone().into_iter().map(token).collect()
}

/// Paths stand behind the `=` of an `extern`.
fn in_items(items: TokenStream) -> TokenStream {
    // Wherever it stands in a path: arguments of types are paths too.
    let (mut tokens, mut is_extern, mut is_path, mut dollar_before) = (TokenStream::new(), false, false, false);
    for token in items {
        match &token {
            TokenTree::Ident(word) if word == "extern" => is_extern = true,
            TokenTree::Ident(word) if is_path && !dollar_before && word == "crate" => {
                let mut dollar = Punct::new('$', Spacing::Alone);
                dollar.set_span(word.span());
                tokens.extend([TokenTree::Punct(dollar)]);
            }
            TokenTree::Punct(punct) if punct.as_char() == ';' => (is_extern, is_path) = (false, false),
            TokenTree::Punct(punct) if punct.as_char() == '=' => is_path = is_extern,
            _ => {}
        }
        dollar_before = is_dollar(&token);
        tokens.extend([token]);
    }
    tokens
}
