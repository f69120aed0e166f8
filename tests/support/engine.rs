//! The committed models through the engine as a library.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model;
use multibody_engine::model::types::Model;
use proc_macro2::{Group, Ident, TokenStream, TokenTree};

use super::data::path;

/// The calls of `multibody!` in a file of this package, in order.
pub fn calls(file: &str) -> Vec<TokenStream> {
    let text = std::fs::read_to_string(path(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
    let file = syn::parse_file(&text).unwrap();
    let calls = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.is_ident("multibody") => Some(item.mac.tokens),
        _ => None,
    });
    calls.collect()
}

/// Parses and checks a call without mistakes.
pub fn models(call: TokenStream) -> Vec<Model> {
    let mut diagnostics = Diagnostics::default();
    let source = multibody_engine::parse(call, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let errors: Vec<&str> = diagnostics.errors().iter().map(|e| e.message.as_str()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    models
}

/// The one model of a call given as text.
pub fn model_of(text: &str) -> Model {
    let mut models = models(text.parse().unwrap());
    assert_eq!(models.len(), 1);
    models.remove(0)
}

/// The call with every `param` a `const`.
pub fn literal(call: TokenStream) -> TokenStream {
    let tokens = call.into_iter().map(|token| match token {
        TokenTree::Ident(word) if word == "param" => TokenTree::Ident(Ident::new("const", word.span())),
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), literal(group.stream()));
            inner.set_span(group.span());
            TokenTree::Group(inner)
        }
        token => token,
    });
    tokens.collect()
}
