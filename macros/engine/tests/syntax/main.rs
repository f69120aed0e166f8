//! The parser, through its public API: what it reads, what it says, and that nothing stops it.

mod errors;
mod expressions;
mod grammar;
mod robust;

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::syntax::parse;
use multibody_engine::syntax::tree::Source;
use proc_macro2::TokenStream;

/// Parses the text of a whole call.
fn parse_text(text: &str) -> (Source, Diagnostics) {
    let tokens: TokenStream = text.parse().unwrap_or_else(|error| panic!("{error} in {text}"));
    parse_tokens(tokens)
}

fn parse_tokens(tokens: TokenStream) -> (Source, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let source = parse(tokens, &mut diagnostics);
    (source, diagnostics)
}

/// Parses text that has no mistakes.
fn valid(text: &str) -> Source {
    let (source, diagnostics) = parse_text(text);
    let messages: Vec<&str> = diagnostics.errors().iter().map(|error| error.message.as_str()).collect();
    assert!(messages.is_empty(), "{messages:?} in {text}");
    source
}

/// Every sample of the language's description.
const DOUBLE_PENDULUM: &str = include_str!("samples/double_pendulum.txt");
const STEWART: &str = include_str!("samples/stewart.txt");
const OTHERS: &str = include_str!("samples/others.txt");
