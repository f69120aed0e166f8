//! The compiler behind `multibody!`, an ordinary library so that tests, benches and fuzzers can link it.
//!
//! Stages flow one way. Each line names a stage and all that it may read; `tests/stages` holds the sources to it. What stands
//! behind `::` is the only part that is open. The public items here serve the project's own tests and tools; users call the
//! macro.
//!
//! ```text
//! invariant:
//! rust_keywords:
//! diagnostics:
//! syntax: diagnostics rust_keywords
//! model: syntax diagnostics rust_keywords invariant
//! robots: model::names syntax diagnostics
//! compounds: syntax diagnostics invariant
//! contracts: model invariant
//! symbolic: contracts::call contracts::cost invariant
//! dynamics: symbolic contracts::call contracts::cost invariant
//! solve: dynamics symbolic contracts::call contracts::cost invariant
//! mechanics: solve dynamics symbolic contracts model invariant
//! optimize: mechanics symbolic contracts rust_keywords invariant
//! verify: optimize mechanics symbolic contracts model invariant
//! formulation: optimize mechanics contracts model invariant
//! emit: optimize mechanics contracts model symbolic::write rust_keywords invariant
//! ```
//!
//! So `symbolic` knows no mechanics; `dynamics` knows trees of links and no model; behind `model` only `emit` knows tokens,
//! and places in the user's text are opaque ([`model::site`]); `emit` reads programs and never the graph: it decides nothing
//! about equations and counts none.

// The name by which the project's tests know this library, for those of them that are its own.
#[cfg(test)]
extern crate self as multibody_engine;

mod compounds;
pub mod contracts;
pub mod diagnostics;
pub mod dynamics;
pub mod emit;
pub mod formulation;
pub mod invariant;
pub mod mechanics;
pub mod model;
pub mod optimize;
pub mod robots;
mod rust_keywords;
pub mod solve;
pub mod symbolic;
pub mod syntax;
pub mod verify;

use std::borrow::Cow;
use std::collections::HashSet;

use proc_macro2::{Span, TokenStream};

use crate::contracts::function::FunctionKind;

use diagnostics::Diagnostics;
use invariant::fault::{Fault, guard};
use mechanics::analysis::Complaint;
use mechanics::loops::advice::Advice;
use mechanics::loops::structure::Structure;
use model::Soundness;
use model::types::{Handling, Model, Request, SpeedChoice};
use optimize::program::Compiled;
use optimize::{Excess, Refusal};
use syntax::tree::Source;

/// Tokens of a `multibody!` call to tokens of its modules, and of everything that is wrong. A model without a mistake is
/// there in full whatever stands beside it, one with mistakes as an outline without equations: one mistake, one error.
pub fn expand(tokens: TokenStream) -> TokenStream {
    expand_at(tokens, "", &robots::no_file)
}

/// The same where the call stands at a `place` of the crate, by which macros that hand parts on to other calls are named, with what
/// reads the files that robots stand in. The output holds each of these by `include_str!`, so that a build follows its changes.
pub fn expand_at(tokens: TokenStream, place: &str, reader: &robots::Reader) -> TokenStream {
    let followed = if emit::references::for_an_editor() { Followed::Always } else { Followed::Sound };
    expand_by(tokens, place, syntax::parse, reader, emit::emit, followed)
}

/// The same for a runtime with its feature `serde`.
pub fn expand_serialised_at(tokens: TokenStream, place: &str, reader: &robots::Reader) -> TokenStream {
    let followed = if emit::references::for_an_editor() { Followed::Always } else { Followed::Sound };
    expand_by(tokens, place, parse_serialised, reader, emit::emit, followed)
}

fn parse_serialised(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Source {
    Source { serialised: true, ..syntax::parse(tokens, diagnostics) }
}

/// The same for readers: paragraphs of statements have headings, as the attribute `#[doc = "// .."]`, and what editors alone
/// follow is left out.
pub fn commented(tokens: TokenStream) -> TokenStream {
    commented_reading(tokens, &robots::no_file)
}

/// The same, with what reads the files that robots stand in.
pub fn commented_reading(tokens: TokenStream, reader: &robots::Reader) -> TokenStream {
    expand_by(tokens, "", syntax::parse, reader, emit::commented, Followed::Never)
}

/// A call as the stages behind `compounds` have it, for tools and tests that go on from there.
pub fn parse(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Source {
    parse_reading(tokens, &robots::no_file, diagnostics)
}

/// The same, with what reads the files that robots stand in.
pub fn parse_reading(tokens: TokenStream, reader: &robots::Reader, diagnostics: &mut Diagnostics) -> Source {
    let mut source = syntax::parse(tokens, diagnostics);
    robots::place(&mut source, reader, diagnostics);
    compounds::place(&mut source, diagnostics);
    source
}

/// When references stand beside the modules, for editors to follow.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Followed {
    Never,
    /// In calls without a mistake: those of others may lead nowhere, which is one more error to a compiler.
    Sound,
    Always,
}

fn expand_by(
    tokens: TokenStream,
    place: &str,
    parse: fn(TokenStream, &mut Diagnostics) -> Source,
    reader: &robots::Reader,
    emit: fn(&Model, &Structure, &Compiled) -> TokenStream,
    followed: Followed,
) -> TokenStream {
    let mut diagnostics = Diagnostics::default();
    let text = syntax::text(tokens.clone());
    let source = guard("syntax", || parse(tokens, &mut diagnostics));
    let suffix = format!("{:016x}", hash(&format!("{place} {text}")));
    // Parts of other calls come first: rustc brings them, and calls again.
    if let Some(pending) = source.as_ref().ok().and_then(|source| source.pending.as_ref()) {
        let mut output = diagnostics.to_tokens();
        output.extend(pending.invocation(&suffix));
        return output;
    }
    // What is for editors alone never stands in the way of a build.
    let references = source.as_ref().ok().filter(|_| followed != Followed::Never);
    let references = references.and_then(|source| guard("model", || model::references::of(source)).ok());
    let placed = source.and_then(|mut source| {
        let files = guard("robots", || robots::place(&mut source, reader, &mut diagnostics))?;
        guard("compounds", || compounds::place(&mut source, &mut diagnostics))?;
        Ok((source, files))
    });
    let (source, files) = match placed {
        Ok((source, files)) => (Ok(source), files),
        Err(fault) => (Err(fault), Vec::new()),
    };
    let checked = source.as_ref().map_err(Fault::clone);
    let checked = checked.and_then(|source| guard("model", || model::check_all(source, &mut diagnostics)));
    let checked = checked.unwrap_or_else(|fault| {
        diagnostics.error_help(Span::call_site(), fault_of("the call", &fault), REPORT);
        Vec::new()
    });
    let mut modules = TokenStream::new();
    let mut fields = TokenStream::new();
    let mut names = HashSet::new();
    for checked in checked {
        let model = &checked.model;
        let has_cfg = model.attrs.iter().any(|attr| attr.path().is_ident("cfg"));
        // Two modules of one name are an error already, unless `cfg` takes one away.
        if !names.insert(model.name.to_string()) && !has_cfg {
            continue;
        }
        if checked.state == Soundness::Sound {
            let made = chosen(model).and_then(|chosen| {
                let (structure, compiled) = compile(&chosen)?;
                let module = guard("emit", || emit(&chosen, &structure, &compiled)).map_err(Trouble::Fault)?;
                Ok((chosen, module, structure))
            });
            match made {
                Ok((chosen, module, structure)) => {
                    modules.extend(module);
                    let of_model = references.as_ref().map(|all| || emit::references::fields(all, &chosen, &structure));
                    fields.extend(of_model.and_then(|of_model| guard("emit", of_model).ok()));
                    continue;
                }
                Err(trouble) => trouble.report(model, &mut diagnostics),
            }
        }
        match guard("emit", || emit::skeleton(&checked)) {
            Ok(module) => modules.extend(module),
            Err(fault) => Trouble::Fault(fault).report(model, &mut diagnostics),
        }
    }
    let mut output = TokenStream::new();
    let is_followed = followed == Followed::Always || diagnostics.is_empty();
    if let Some(references) = references.filter(|_| is_followed) {
        let all = followed == Followed::Always;
        output.extend(guard("emit", || emit::references::names(&references, all)).ok());
    } else {
        fields = TokenStream::new();
    }
    let exports = source.iter().flat_map(|source| model::exports::of(source, !diagnostics.is_empty()));
    let exports = emit::exports(exports, &suffix);
    output.extend(diagnostics.to_tokens());
    output.extend(modules);
    output.extend(exports);
    output.extend(fields);
    output.extend(files.iter().map(|file| {
        quote::quote!(
            const _: &str = ::core::include_str!(#file);
        )
    }));
    output
}

/// FNV-1a of 64 bits, which is the same in every build.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The model with the speeds that `speeds: Auto` stands for, from which all that follows goes on.
pub fn chosen(model: &Model) -> Result<Cow<'_, Model>, Trouble> {
    if model.speed_choice != SpeedChoice::Open {
        return Ok(Cow::Borrowed(model));
    }
    guard("formulation", || formulation::with_speeds(model)).map(Cow::Owned).map_err(Trouble::Fault)
}

/// The stages behind the checked model, whose speeds are [`chosen`]: where they are not, it has the rates of its coordinates.
pub fn compile(model: &Model) -> Result<(Structure, Compiled), Trouble> {
    let (model, advice, (structure, compiled)) = settled(model, compile_as_written)?;
    let structure = Structure { advice: advice.map(Box::new), ..structure };
    Ok((
        if model.emit.contains(&Request::Report) { advised(&model, structure, &compiled)? } else { structure },
        compiled,
    ))
}

/// With all that there is to say of the choice for a model's loops.
pub fn advised(model: &Model, structure: Structure, compiled: &Compiled) -> Result<Structure, Trouble> {
    let advice = guard("formulation", || formulation::advice(model, &structure, compiled)).map_err(Trouble::Fault)?;
    Ok(Structure { advice: advice.map(Box::new), ..structure })
}

/// The model as `constraints: Auto` has it, and what work makes of that. A choice that is refused as a whole is not taken.
pub fn settled<T>(
    model: &Model,
    work: impl Fn(&Model) -> Result<T, Trouble>,
) -> Result<(Cow<'_, Model>, Option<Advice>, T), Trouble> {
    if !matches!(model.handling, Handling::Auto) {
        return Ok((Cow::Borrowed(model), None, work(model)?));
    }
    let ([first, second], advice) = guard("formulation", || formulation::choose(model)).map_err(Trouble::Fault)?;
    let with = |handling: Handling| Model { handling, ..model.clone() };
    let first = with(first);
    let trouble = match work(&first) {
        Ok(done) => return Ok((Cow::Owned(first), advice, done)),
        // An error of this compiler is told of, not avoided.
        Err(trouble) if trouble.is_fault() => return Err(trouble),
        Err(trouble) => trouble,
    };
    let second = with(second);
    let Ok(done) = work(&second) else { return Err(trouble) };
    let advice = advice.map(|advice| advice.turned(trouble.reason()));
    Ok((Cow::Owned(second), advice, done))
}

fn compile_as_written(model: &Model) -> Result<(Structure, Compiled), Trouble> {
    let freedoms = guard("mechanics", || mechanics::freedoms(model)).map_err(Trouble::Fault)?;
    if freedoms > mechanics::MOST_FREEDOMS {
        return Err(Trouble::Refused(Refusal::TooLarge(Excess::Coordinates(freedoms))));
    }
    let derived = guard("mechanics", || mechanics::of(model)).map_err(Trouble::Fault)?;
    let (structure, derivation) = derived.map_err(Trouble::Complaints)?;
    let compiled = guard("verify", || verify::compile(model, &structure, &derivation)).map_err(Trouble::Fault)?;
    let compiled = compiled.map_err(Trouble::Refused)?;
    match guard("emit", || emit::misfit(model, &structure, &compiled)).map_err(Trouble::Fault)? {
        None => Ok((structure, compiled)),
        Some(kind) => Err(Trouble::Refused(Refusal::Misfit(kind))),
    }
}

/// What to do about an error that is not the user's.
const REPORT: &str = "this is an error of multibody: please report it with the model";

/// Why there is no code for a model.
pub enum Trouble {
    /// What is wrong with its mechanics.
    Complaints(Vec<Complaint>),
    Refused(Refusal),
    /// An error of this compiler that one of its stages has found.
    Fault(Fault),
}

impl Trouble {
    /// Whether this compiler is to blame.
    fn is_fault(&self) -> bool {
        match self {
            Trouble::Complaints(_) | Trouble::Refused(Refusal::TooLarge(_) | Refusal::NotFinite) => false,
            Trouble::Fault(_) | Trouble::Refused(_) => true,
        }
    }

    /// The first thing that is said against a model.
    fn reason(&self) -> String {
        match self {
            Trouble::Complaints(complaints) if !complaints.is_empty() => complaints[0].message.clone(),
            Trouble::Refused(Refusal::NotFinite) => "its equations hold a number that is not finite".to_owned(),
            _ => "its equations are too large".to_owned(),
        }
    }

    /// Adds what is to be said of it, at the user's tokens.
    pub fn report(self, model: &Model, diagnostics: &mut Diagnostics) {
        let span = model.name.span();
        match self {
            Trouble::Complaints(complaints) => {
                for Complaint { at, message, help } in complaints {
                    match help {
                        Some(help) => diagnostics.error_help(at.span(), message, help),
                        None => diagnostics.error(at.span(), message),
                    }
                }
            }
            Trouble::Fault(fault) => {
                diagnostics.error_help(span, fault_of(&format!("`{}`", model.name), &fault), REPORT);
            }
            Trouble::Refused(Refusal::TooLarge(excess)) => {
                let (message, help) = too_large(model, excess);
                diagnostics.error_help(span, message, help);
            }
            Trouble::Refused(Refusal::NotFinite) => diagnostics.error_help(
                span,
                format!("the equations of `{}` hold a number that is not finite", model.name),
                "literals multiply out of the range of f64, or something is divided by what is always zero",
            ),
            Trouble::Refused(Refusal::Wrong(kind)) => diagnostics.error_help(
                span,
                format!(
                    "`{}` of `{}` does not have the values of its equations",
                    emit::function_name(model, kind),
                    model.name
                ),
                REPORT,
            ),
            Trouble::Refused(Refusal::WrongAt(kind)) => diagnostics.error_help(
                span,
                format!(
                    "`At::{}` of `{}` does not have the values of its equations",
                    emit::function_name(model, kind),
                    model.name
                ),
                REPORT,
            ),
            Trouble::Refused(Refusal::WrongChecks) => diagnostics.error_help(
                span,
                format!("`Params::check` of `{}` does not have the values of its equations", model.name),
                REPORT,
            ),
            Trouble::Refused(Refusal::WrongInertia) => diagnostics.error_help(
                span,
                format!("the mass matrix of `{}` does not have the values of its equations", model.name),
                REPORT,
            ),
            Trouble::Refused(Refusal::Misfit(kind)) => diagnostics.error_help(
                span,
                format!(
                    "`{}` of `{}` does not give as many numbers as its type holds",
                    emit::function_name(model, kind),
                    model.name
                ),
                REPORT,
            ),
            Trouble::Refused(Refusal::Contradiction(a, b)) => {
                let [a, b] = [a, b].map(|kind| emit::function_name(model, kind));
                let message = match a == b {
                    true => format!("`{a}` of `{}` contradicts itself", model.name),
                    false => format!("`{a}` and `{b}` of `{}` contradict each other", model.name),
                };
                diagnostics.error_help(span, message, REPORT);
            }
        }
    }
}

fn fault_of(subject: &str, Fault { stage, place, what }: &Fault) -> String {
    let place = place.as_ref().map_or_else(String::new, |place| format!(" ({place})"));
    format!("the stage `{stage}`{place} has failed for {subject}: {what}")
}

/// What is said of it, and what to do.
fn too_large(model: &Model, excess: Excess) -> (String, &'static str) {
    let name = &model.name;
    match excess {
        Excess::Coordinates(found) => (
            format!("`{name}` has {found} coordinates, more than {}", mechanics::MOST_FREEDOMS),
            "declare fewer bodies, or several models that act on each other by inputs and outputs",
        ),
        Excess::Operations(kind, found) => (
            format!(
                "the function `{}` of `{name}` has {found} operations before optimisation, more than {}",
                emit::function_name(model, kind),
                optimize::MOST_OPERATIONS
            ),
            instead(kind),
        ),
        Excess::Expressions => (
            format!("the equations of `{name}` have more than {} expressions", symbolic::graph::MOST_NODES),
            "ask for less in `emit`, or declare fewer bodies",
        ),
    }
}

/// What to do about a function that is too large.
fn instead(kind: FunctionKind) -> &'static str {
    match kind {
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics | FunctionKind::Bias => "declare fewer bodies",
        FunctionKind::MassMatrix
        | FunctionKind::MassMatrixLower
        | FunctionKind::ConstraintJacobian
        | FunctionKind::PositionJacobian => {
            "leave it out of `emit`: a matrix grows with the square of the coordinates; or declare fewer bodies"
        }
        FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives => {
            "leave `derivatives` out of `emit`: they grow with the square of the coordinates; or declare fewer bodies"
        }
        FunctionKind::Linearization => {
            "leave `linearize` out of `emit`: it grows with the square of the coordinates; or declare fewer bodies"
        }
        FunctionKind::Outputs | FunctionKind::OutputGroup(_) => {
            "declare fewer outputs, or simpler ones: accelerations and reactions are dear"
        }
        FunctionKind::Guess | FunctionKind::DeadCentres | FunctionKind::Kinematics(_) => {
            "solve the loops by `solve (..) from ..`, or hold them by multipliers, `constraints: Multipliers`"
        }
        _ => "leave it out of `emit`, or declare fewer bodies",
    }
}

#[cfg(test)]
mod tests {
    use proc_macro2::TokenStream;

    use super::diagnostics::Diagnostics;
    use super::syntax::tree::Source;
    use super::{Followed, emit, expand_by, robots};

    fn fails(_: TokenStream, _: &mut Diagnostics) -> Source {
        panic!("no token is left")
    }

    #[test]
    fn a_panic_of_the_parser_is_one_error_that_names_the_stage() {
        let output =
            expand_by(TokenStream::new(), "", fails, &robots::no_file, emit::emit, Followed::Sound).to_string();
        assert_eq!(output.matches("compile_error").count(), 1, "{output}");
        assert!(output.contains("the stage `syntax` has failed for the call: no token is left"), "{output}");
        assert!(output.contains("please report it with the model"), "{output}");
    }
}
