//! Stage `syntax`: parts that stages write in the language.
//!
//! In: the text of one module, and a place in the user's. Out: the module, with every token of it at that place.

use proc_macro2::{Group, Span, TokenStream, TokenTree};

use super::parse;
use super::tree::Module;
use crate::diagnostics::Diagnostics;

/// What is wrong with the text otherwise.
pub(crate) fn written(text: &str, span: Span) -> Result<Module, String> {
    let mut mistakes = Diagnostics::default();
    let tokens = text.parse::<TokenStream>().map_err(|error| error.to_string())?;
    let module = parse(at(tokens, span), &mut mistakes).modules.pop();
    match (module, mistakes.errors().first()) {
        (Some(module), None) => Ok(module),
        (_, mistake) => Err(mistake.map_or_else(String::new, |mistake| mistake.message.clone())),
    }
}

/// The same tokens at another place.
fn at(tokens: TokenStream, span: Span) -> TokenStream {
    let moved = tokens.into_iter().map(|mut token| {
        if let TokenTree::Group(group) = &token {
            token = TokenTree::Group(Group::new(group.delimiter(), at(group.stream(), span)));
        }
        token.set_span(span);
        token
    });
    moved.collect()
}
