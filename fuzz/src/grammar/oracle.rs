//! What must come of a call: code, or messages at the user's own tokens; never a panic.

use std::panic::{AssertUnwindSafe, catch_unwind};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::optimize::Refusal;
use multibody_engine::{Trouble, compile, expand, model};
use proc_macro2::TokenStream;

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Code, so many characters.
    Code(usize),
    /// The compiler's messages.
    Refused(Vec<String>),
    /// What must not be.
    Broken(String),
}

impl Outcome {
    /// What minimising keeps.
    pub fn class(&self) -> String {
        match self {
            Outcome::Code(_) => "code".into(),
            Outcome::Refused(list) => {
                let text = list.first().cloned().unwrap_or_default();
                let mut class = String::from("refused: ");
                for (k, part) in text.split('`').enumerate() {
                    class += if k % 2 == 0 { part } else { "_" };
                }
                class.chars().map(|c| if c.is_ascii_digit() { '0' } else { c }).collect()
            }
            Outcome::Broken(what) => format!("broken: {}", what.split('\n').next().unwrap_or_default()),
        }
    }
}

/// Messages with the spans they stand at: whether each stands at a token of the text.
fn messages(tokens: TokenStream) -> Result<Vec<String>, String> {
    let mut diagnostics = Diagnostics::default();
    let source = multibody_engine::parse(tokens, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    if diagnostics.is_empty() {
        for model in &models {
            match compile(model) {
                Ok(_) => {}
                Err(Trouble::Complaints(list)) => {
                    list.into_iter().for_each(|complaint| diagnostics.error(complaint.at.span(), complaint.message));
                }
                Err(Trouble::Refused(refusal @ (Refusal::TooLarge(_) | Refusal::NotFinite))) => {
                    diagnostics.error(model.name.span(), format!("{refusal:?}"));
                }
                Err(Trouble::Refused(own)) => return Err(format!("the engine's own check: {own:?}")),
                Err(Trouble::Fault(fault)) => return Err(format!("a fault of the engine: {fault:?}")),
            }
        }
    }
    for error in diagnostics.errors() {
        if error.span.source_text().is_none_or(|text| text.is_empty()) {
            return Err(format!("no token of the user's under: {}", error.message));
        }
    }
    Ok(diagnostics.errors().iter().map(|error| error.message.clone()).collect())
}

/// Expands a call.
pub fn outcome(text: &str) -> Option<Outcome> {
    let tokens: TokenStream = text.parse().ok()?;
    let given = tokens.clone();
    let run = move || -> Outcome {
        let output = expand(given.clone());
        let written = output.to_string();
        let refused = written.contains("compile_error");
        if let Err(error) = syn::parse2::<syn::File>(output) {
            return Outcome::Broken(format!("no Rust: {error}"));
        }
        if !refused {
            return Outcome::Code(written.len());
        }
        match messages(given) {
            Ok(list) if list.is_empty() => Outcome::Broken("an error without a message".into()),
            Ok(list) => Outcome::Refused(list),
            Err(text) => Outcome::Broken(text),
        }
    };
    Some(catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|cause| {
        let text = cause.downcast_ref::<String>().cloned();
        let text = text.or_else(|| cause.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Outcome::Broken(format!("panic: {}", text.unwrap_or_default()))
    }))
}

/// The fewest lines that keep what `keeps` looks at.
pub fn minimise(lines: Vec<String>, keeps: &mut dyn FnMut(&[String]) -> bool) -> Vec<String> {
    let mut best = lines;
    let mut size = best.len() / 2;
    while size > 0 {
        let mut at = 0;
        while at + size <= best.len() {
            let mut other = best.clone();
            other.drain(at..at + size);
            if keeps(&other) {
                best = other;
            } else {
                at += size;
            }
        }
        size /= 2;
    }
    best
}
