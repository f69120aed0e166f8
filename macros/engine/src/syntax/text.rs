//! Stage `syntax`: the text of tokens, by which calls and parts are told apart.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

/// Two streams have one text if they hold the same tokens. Unlike `TokenStream::to_string` it doesn't recurse over the nesting of groups,
/// which has no bound before a call is parsed.
pub(crate) fn text(tokens: TokenStream) -> String {
    let mut text = String::new();
    let mut open = Vec::new();
    let mut tokens = tokens.into_iter();
    loop {
        let Some(token) = tokens.next() else {
            let Some((rest, closing)) = open.pop() else { return text };
            text += closing;
            tokens = rest;
            continue;
        };
        match token {
            TokenTree::Group(group) => {
                let (opening, closing) = match group.delimiter() {
                    Delimiter::Parenthesis => ("( ", ") "),
                    Delimiter::Brace => ("{ ", "} "),
                    Delimiter::Bracket => ("[ ", "] "),
                    // What a macro has put in holds together without a bracket.
                    Delimiter::None => ("\u{ab} ", "\u{bb} "),
                };
                text += opening;
                open.push((std::mem::replace(&mut tokens, group.stream().into_iter()), closing));
            }
            TokenTree::Punct(punct) => {
                text.push(punct.as_char());
                if punct.spacing() == Spacing::Alone {
                    text.push(' ');
                }
            }
            TokenTree::Ident(_) | TokenTree::Literal(_) => {
                text += &token.to_string();
                text.push(' ');
            }
        }
    }
}
