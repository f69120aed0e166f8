//! Stages broken on purpose, one line at a time: every break is told.
//!
//! `cargo test -p multibody-engine --lib faults`; `FAULTS_ONLY=LaneSign,LostSide` tries these alone. A model is
//! told of a break where it is refused, or where a check has found a program wrong and what was derived stands in its place. A
//! break that changes a model which is accepted without a word must be told by what a test compares, and each of these is named
//! in [`BY_TESTS`].

#[path = "../common/corpus.rs"]
#[allow(dead_code)]
mod corpus;
mod models;

use std::collections::BTreeMap;

use super::{Break, reached_by, with};
use crate::model::types::Model;
use crate::{Trouble, compile, emit, mechanics, optimize, verify};

/// Breaks that a model alone cannot tell of, and what a test sees of them in the emitted code: text that stands there, and does
/// not where the stage is broken.
const BY_TESTS: [(Break, &str, &str); 1] =
    // `emit::expressions` has all functions in their place.
    [(Break::PrintedArguments, "pointer", "atan2 (T :: lit (1.0) + T :: lit (2.0) * q . hinge ,")];

/// What becomes of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Outcome {
    Accepted(String),
    /// A program was found wrong, and what it had been made from stands in its place.
    GivenBack,
    Refused(String),
}

fn outcome(model: &Model, line: Option<Break>) -> Outcome {
    with(line, || match compile(model) {
        Ok(_) if given_back(model) => Outcome::GivenBack,
        Ok((structure, compiled)) => Outcome::Accepted(emit::emit(model, &structure, &compiled).to_string()),
        Err(Trouble::Fault(fault)) => Outcome::Refused(format!("fault of {}: {}", fault.stage, fault.what)),
        Err(Trouble::Refused(refusal)) => Outcome::Refused(format!("{refusal:?}")),
        Err(Trouble::Complaints(list)) => Outcome::Refused(list[0].message.clone()),
    })
}

/// Whether the checks tell of what the optimiser has made: all tests over the project's models demand that they do not.
fn given_back(model: &Model) -> bool {
    let (structure, derivation) = mechanics::of(model).expect("equations");
    let compiled = optimize::compile(&derivation).expect("programs");
    !compiled.sound || !verify::check(model, &structure, &derivation, &compiled).wrong.is_empty()
}

/// In two halves, which run side by side: minutes each where the engine is not optimised.
#[test]
fn every_break_is_told() {
    breaks_are_told(0);
}

#[test]
fn every_other_break_is_told() {
    breaks_are_told(1);
}

fn breaks_are_told(first: usize) {
    let models = models::MODELS.map(|(name, text)| (name, corpus::model(text)));
    let plain: BTreeMap<&str, (Outcome, Vec<Break>)> =
        models.iter().map(|(name, model)| (*name, reached_by(|| outcome(model, None)))).collect();
    for (name, (found, _)) in &plain {
        assert!(matches!(found, Outcome::Accepted(_)), "{name} without a break: {found:?}");
    }
    let only = std::env::var("FAULTS_ONLY").unwrap_or_default();
    let is_asked = |line: &Break| only.is_empty() || only.split(',').any(|name| name == format!("{line:?}"));
    let mut holes = Vec::new();
    for line in Break::ALL.into_iter().skip(first).step_by(2).filter(is_asked) {
        let mut told = false;
        for (name, model) in models.iter().filter(|model| plain[model.0].1.contains(&line)) {
            let found = outcome(model, Some(line));
            let how = match &found {
                Outcome::Accepted(_) if found == plain[name].0 => continue,
                Outcome::Accepted(_) if BY_TESTS.iter().any(|by| by.0 == line) => "a test of what is emitted",
                Outcome::Accepted(_) => "nothing",
                Outcome::GivenBack => "the check of programs, which stand as they were derived",
                Outcome::Refused(what) => what,
            };
            println!("{line:?} of {name} is told by {how}");
            told = true;
            if how == "nothing" {
                holes.push((line, *name));
            }
        }
        if !told {
            holes.push((line, "no model"));
        }
    }
    assert!(holes.is_empty(), "{holes:#?}");
}

/// What a test finds in the emitted code, and does not where the stage is broken.
#[test]
fn tests_tell() {
    for (line, name, text) in BY_TESTS {
        let model = corpus::model(models::MODELS.into_iter().find(|model| model.0 == name).expect("a model").1);
        let emitted = |line| match outcome(&model, line) {
            Outcome::Accepted(emitted) => emitted,
            other => panic!("{name}: {other:?}"),
        };
        assert!(emitted(None).contains(text), "{}", emitted(None).split("fn outputs").nth(1).unwrap_or_default());
        assert!(!emitted(Some(line)).contains(text));
    }
}

/// As users see it.
#[test]
fn a_fault_is_one_error_that_names_the_stage() {
    let tokens = models::MODELS[3].1.parse().expect("tokens");
    let output = with(Some(Break::LoweredSymbol), || crate::expand(tokens)).to_string();
    assert_eq!(output.matches("compile_error").count(), 1);
    assert!(output.contains("the stage `symbolic` (lower.rs:"), "{output}");
    assert!(output.contains("has failed for `pointer`") && output.contains("please report it with the model"));
}

/// The others go on.
#[test]
fn a_broken_pass_is_left_out() {
    for (name, text) in models::MODELS {
        let (_, derivation) = mechanics::of(&corpus::model(text)).expect("equations");
        let compiled = with(Some(Break::FactoredSign), || optimize::compile(&derivation)).expect("programs");
        if compiled.sound {
            continue;
        }
        let whole = optimize::compile(&derivation).expect("programs");
        let work = |compiled: &optimize::program::Compiled| -> u32 {
            compiled.functions.iter().map(|function| function.after.weight()).sum()
        };
        let derived: u32 = whole.functions.iter().map(|function| function.before.weight()).sum();
        println!("{name}: {} as derived, {} without the pass, {} with it", derived, work(&compiled), work(&whole));
        // Of what all passes save, most is saved.
        assert!(2 * (derived - work(&compiled)) > derived - work(&whole), "{name}");
        return;
    }
    panic!("no model has a factor");
}
