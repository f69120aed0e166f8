//! The compiler behind `multibody!`, an ordinary library so that tests, benches and fuzzers can link it.
//!
//! Stages flow one way: `syntax -> model -> (symbolic <- mechanics <- solve) -> optimize -> emit`. `symbolic` knows no
//! mechanics; `mechanics` knows no tokens; `emit` decides nothing about equations. The public items here serve the
//! project's own tests and tools; users call the macro.

pub mod diagnostics;
pub mod emit;
pub mod mechanics;
pub mod model;
pub mod optimize;
mod rust_keywords;
pub mod symbolic;
pub mod syntax;

use proc_macro2::TokenStream;

use diagnostics::Diagnostics;

/// Tokens of a `multibody!` call to tokens of its modules; with errors in between, everything that is wrong.
pub fn expand(tokens: TokenStream) -> TokenStream {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(tokens, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    if !diagnostics.is_empty() {
        let mut output = diagnostics.to_tokens();
        output.extend(emit::skeletons(&source));
        return output;
    }
    let mut output = TokenStream::new();
    for model in &models {
        match compile(model) {
            Ok(compiled) => output.extend(emit::emit(model, &compiled)),
            Err(optimize::Refusal::TooLarge) => diagnostics.error_help(
                model.name.span(),
                format!("the equations of `{}` are too large", model.name),
                format!(
                    "a model may have {} coordinates and a function {} operations before optimisation; ask for less in \
                     `emit` (a mass matrix grows with the square of the coordinates), or declare fewer bodies",
                    mechanics::MOST_FREEDOMS,
                    optimize::MOST_OPERATIONS
                ),
            ),
            Err(optimize::Refusal::NotFinite) => diagnostics.error_help(
                model.name.span(),
                format!("the equations of `{}` hold a number that is not finite", model.name),
                "literals multiply out of the range of f64, or something is divided by what is always zero",
            ),
        }
    }
    if diagnostics.is_empty() {
        return output;
    }
    let mut errors = diagnostics.to_tokens();
    errors.extend(emit::skeletons(&source));
    errors
}

/// The stages behind the checked model.
fn compile(model: &model::types::Model) -> Result<optimize::program::Compiled, optimize::Refusal> {
    if mechanics::freedoms(model) > mechanics::MOST_FREEDOMS {
        return Err(optimize::Refusal::TooLarge);
    }
    optimize::compile(&mechanics::derive(model))
}
