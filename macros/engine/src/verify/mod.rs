//! Stage `verify`: every compiled program in numbers, in every user's build.
//!
//! In: the derivation and what was compiled of it. Out: the same, or a [`Refusal`] where it is wrong. The identity test of
//! `optimize` compares residues; what it cannot see is how residues were given their values: a literal that should be zero and
//! has a value of 8e-17, or coefficients of which nothing is left when they cancel. Here each function is evaluated as it will run, at several states,
//! and compared with its derived equations (`tape`) in double-double precision, within a bound from these equations alone
//! (`programs`). A function that fails is given back as it was derived; if that fails too, the model is refused.

mod arithmetic;
mod laws;
mod linear;
mod machine;
mod programs;
mod states;
mod tape;
mod trace;

use std::collections::HashMap;

use crate::mechanics::Derivation;
use crate::mechanics::structure::Structure;
use crate::model::types::Model;
use crate::optimize::program::{Compiled, Function, FunctionKind};
use crate::optimize::{self, Refusal};

use laws::{Laws, Outcome};
use programs::{Subject, Verdict};
use states::{State, States};
use tape::Tape;

/// As often a state is drawn again.
const ATTEMPTS: usize = 8;

/// A function that was given back as derived has lost digits where it misses its bound by less than this: it is refused only
/// where it misses it by more. (Components of a vector that a turn has mixed are the worst case met, at 80 times the bound.)
const LOST_DIGITS: f64 = 1e4;

/// Compiles a derivation, and checks what comes of it.
pub fn compile(model: &Model, structure: &Structure, derivation: &Derivation) -> Result<Compiled, Refusal> {
    let compiled = optimize::compile(derivation)?;
    let found = judge(model, structure, derivation, &compiled, 1.0);
    if let Some((a, b)) = found.broken {
        return Err(Refusal::Contradiction(a, b));
    }
    if found.wrong.is_empty() {
        return Ok(compiled);
    }
    let compiled = optimize::compile_with(derivation, &found.wrong)?;
    match judge(model, structure, derivation, &compiled, LOST_DIGITS).wrong.first() {
        None => Ok(compiled),
        Some(&kind) => Err(Refusal::Wrong(kind)),
    }
}

/// What the check has found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Functions whose programs don't have the values of their equations.
    pub wrong: Vec<FunctionKind>,
    /// Functions for which no state was found at which their values are clear.
    pub unchecked: Vec<FunctionKind>,
    /// Two functions whose derived equations contradict each other.
    pub broken: Option<(FunctionKind, FunctionKind)>,
    /// Whether some law has no clear value at any state that was tried.
    pub unjudged: bool,
}

/// Compares all programs of a model with their derived equations.
pub fn check(model: &Model, structure: &Structure, derivation: &Derivation, compiled: &Compiled) -> Found {
    judge(model, structure, derivation, compiled, 1.0)
}

/// The same, with as many times the bound.
fn judge(model: &Model, structure: &Structure, derivation: &Derivation, compiled: &Compiled, slack: f64) -> Found {
    let states = States::new(model, structure, &derivation.symbols);
    let tapes: Vec<Tape> = compiled.functions.iter().map(|function| tape_of(derivation, function)).collect();
    let closing = compiled.functions.iter().zip(&tapes).find(|(function, _)| function.kind == FunctionKind::Guess);
    let draw = |number: usize, attempt: usize| {
        let state = states.draw(number, attempt);
        match closing {
            Some((_, tape)) => states.closed(state, tape),
            None => Some(state),
        }
    };
    let mut drawn: HashMap<(usize, usize), Option<State>> = HashMap::new();
    let mut found = Found::default();
    for (function, tape) in compiled.functions.iter().zip(&tapes) {
        let residual = closing.is_some()
            && matches!(function.kind, FunctionKind::ForwardDynamics | FunctionKind::Guess | FunctionKind::Margins);
        let subject = Subject { tape, program: &function.program, residual, slack };
        let count = match tape.nodes.len() {
            0..=2_000 => 3,
            2_001..=10_000 => 2,
            _ => 1,
        };
        let mut checked = false;
        for number in 0..count {
            for attempt in 0..ATTEMPTS {
                let state = drawn.entry((number, attempt)).or_insert_with(|| draw(number, attempt));
                let Some(state) = state else { continue };
                match subject.compare(&states, state, &compiled.prelude) {
                    Verdict::Right => {
                        checked = true;
                        break;
                    }
                    Verdict::Wrong(_) => {
                        found.wrong.push(function.kind);
                        break;
                    }
                    Verdict::Unclear => {}
                }
            }
        }
        found.wrong.dedup();
        if !checked && !found.wrong.contains(&function.kind) {
            found.unchecked.push(function.kind);
        }
    }
    let functions: Vec<(FunctionKind, &Tape)> =
        compiled.functions.iter().map(|function| function.kind).zip(&tapes).collect();
    let laws = Laws { model, structure, states: &states, functions: &functions };
    found.unjudged = true;
    for attempt in 0..ATTEMPTS {
        let Some(state) = drawn.entry((0, attempt)).or_insert_with(|| draw(0, attempt)) else { continue };
        match laws.judge(state) {
            Outcome::Hold => found.unjudged = false,
            Outcome::Broken(a, b) => (found.broken, found.unjudged) = (Some((a, b)), false),
            Outcome::Unclear => continue,
        }
        break;
    }
    found
}

/// The derived equations of a function.
fn tape_of(derivation: &Derivation, function: &Function) -> Tape {
    let derived = derivation.functions.iter().find(|derived| derived.kind == function.kind);
    let roots = derived.and_then(|derived| derived.candidates.get(function.candidate));
    Tape::new(&derivation.graph, roots.map_or(&[], |(_, roots)| roots))
}
