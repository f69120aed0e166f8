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
pub mod solve;
pub mod symbolic;
pub mod syntax;

use proc_macro2::TokenStream;

use diagnostics::Diagnostics;
use mechanics::analysis::Complaint;
use mechanics::structure::Structure;
use model::types::Model;
use optimize::Refusal;
use optimize::program::Compiled;

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
            Ok((structure, compiled)) => output.extend(emit::emit(model, &structure, &compiled)),
            Err(trouble) => trouble.report(model, &mut diagnostics),
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
pub fn compile(model: &Model) -> Result<(Structure, Compiled), Trouble> {
    if mechanics::freedoms(model) > mechanics::MOST_FREEDOMS {
        return Err(Trouble::Refused(Refusal::TooLarge));
    }
    let (structure, derivation) = mechanics::of(model).map_err(Trouble::Complaints)?;
    let compiled = optimize::compile(&derivation).map_err(Trouble::Refused)?;
    Ok((structure, compiled))
}

/// Why there is no code for a model.
pub enum Trouble {
    /// What is wrong with its mechanics.
    Complaints(Vec<Complaint>),
    Refused(Refusal),
}

impl Trouble {
    fn report(self, model: &Model, diagnostics: &mut Diagnostics) {
        let span = model.name.span();
        match self {
            Trouble::Complaints(complaints) => {
                for Complaint { span, message, help } in complaints {
                    match help {
                        Some(help) => diagnostics.error_help(span, message, help),
                        None => diagnostics.error(span, message),
                    }
                }
            }
            Trouble::Refused(Refusal::TooLarge) => diagnostics.error_help(
                span,
                format!("the equations of `{}` are too large", model.name),
                format!(
                    "a model may have {} coordinates and a function {} operations before optimisation; ask for less in \
                     `emit` (a mass matrix grows with the square of the coordinates), or declare fewer bodies",
                    mechanics::MOST_FREEDOMS,
                    optimize::MOST_OPERATIONS
                ),
            ),
            Trouble::Refused(Refusal::NotFinite) => diagnostics.error_help(
                span,
                format!("the equations of `{}` hold a number that is not finite", model.name),
                "literals multiply out of the range of f64, or something is divided by what is always zero",
            ),
        }
    }
}
