//! Stage `verify`: every compiled program in numbers, in every user's build.
//!
//! In: the derivation and what was compiled of it. Out: the same, or a [`Refusal`] where it is wrong. The identity test of
//! `optimize` compares residues; what it cannot see is how residues were given their values: a literal that should be zero and
//! has a value of 8e-17, or coefficients of which nothing is left when they cancel. Here each function is evaluated as it will run, at several states,
//! and compared with its derived equations (`tape`) in double-double precision, within a bound from these equations alone
//! (`programs`). A function that fails is given back as it was derived; if that fails too, the model is refused. What has no clear
//! value at any state that was tried is accepted, and said in the module's documentation ([`Compiled::unchecked`]).

mod arithmetic;
mod at;
mod laws;
mod linear;
mod machine;
mod programs;
mod states;
mod tape;
mod trace;

use std::collections::HashMap;

use crate::contracts::function::FunctionKind;
use crate::invariant::fault::OrFault;
use crate::mechanics::loops::structure::Structure;
use crate::mechanics::{Derivation, Inertia};
use crate::model::types::Model;
use crate::optimize::program::{Compiled, Doubt, Function, Part, Unchecked};
use crate::optimize::{self, Plain, Refusal};
use crate::symbolic::graph::Scalar;

use laws::{Known, Laws, Outcome};
use programs::{CLOSELY, Lowered, Subject, Verdict};
use states::{State, States};
use tape::Tape;

/// As often a state is drawn again.
const ATTEMPTS: usize = 8;

/// As often again for what has no clear value at any of these, from where the model stands by default and with numbers of other sizes.
const FURTHER: usize = 16;

/// Compiles a derivation, and checks what comes of it.
pub fn compile(model: &Model, structure: &Structure, derivation: &Derivation) -> Result<Compiled, Refusal> {
    let mut compiled = optimize::compile_with(derivation, Plain::default(), model.fused)?;
    let (mut functions, mut at, mut checks) = (Vec::new(), false, false);
    loop {
        let plain = Plain { functions: &functions, at, checks };
        let found = check_with(model, structure, derivation, &compiled, plain);
        if let Some((a, b)) = found.broken {
            return Err(Refusal::Contradiction(a, b));
        }
        // What is wrong as it was derived has nothing to fall back on.
        if let Some(&kind) = found.wrong.iter().find(|kind| functions.contains(kind)) {
            return Err(Refusal::Wrong(kind));
        }
        if let Some(kind) = found.wrong_at.filter(|_| at) {
            return Err(Refusal::WrongAt(kind));
        }
        if checks && found.wrong_checks {
            return Err(Refusal::WrongChecks);
        }
        if found.wrong_inertia {
            return Err(Refusal::WrongInertia);
        }
        if found.wrong.is_empty() && found.wrong_at.is_none() && !found.wrong_checks {
            compiled.unchecked = found.unchecked;
            return Ok(compiled);
        }
        functions.extend(found.wrong);
        at |= found.wrong_at.is_some();
        checks |= found.wrong_checks;
        compiled = optimize::compile_with(derivation, Plain { functions: &functions, at, checks }, model.fused)?;
        compiled.sound = false;
    }
}

/// What the check has found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Functions whose programs don't have the values of their equations.
    pub wrong: Vec<FunctionKind>,
    /// The first of the functions of what `Model::at` gives that is one.
    pub wrong_at: Option<FunctionKind>,
    /// Whether the program of `Params::check` is one.
    pub wrong_checks: bool,
    /// Whether the mass matrix of `System::without_inertia` is one; it stands as it was derived.
    pub wrong_inertia: bool,
    /// Two functions whose derived equations contradict each other.
    pub broken: Option<(FunctionKind, FunctionKind)>,
    /// What has no clear value at any state that was tried.
    pub unchecked: Vec<Unchecked>,
}

/// Compares all programs of a model with their derived equations.
pub fn check(model: &Model, structure: &Structure, derivation: &Derivation, compiled: &Compiled) -> Found {
    check_with(model, structure, derivation, compiled, Plain::default())
}

/// States that were drawn, by number and attempt; nothing where loops don't close.
struct Drawn<'a> {
    states: &'a States<'a>,
    closing: Option<&'a Tape>,
    list: HashMap<(usize, usize), Option<State>>,
}

impl Drawn<'_> {
    fn get(&mut self, number: usize, attempt: usize) -> Option<&State> {
        let draw = || {
            let state = self.states.draw(number, attempt);
            match self.closing {
                Some(tape) => self.states.closed(state, tape),
                None => Some(state),
            }
        };
        self.list.entry((number, attempt)).or_insert_with(draw).as_ref()
    }

    /// Compares at these states: one that is clear of each number, and one at all in the end, with parameters that are not at
    /// their defaults, which may be zero and hide what they multiply.
    fn compare(&mut self, subject: &Subject<'_>, numbers: &[usize]) -> Verdict {
        let constant = self.states.has_no_parameters();
        let (mut anywhere, mut enough, mut doubt) = (false, false, None);
        let usual = numbers.iter().map(|&number| (number, 0..ATTEMPTS));
        // Another number has parameters elsewhere.
        let further = [1, 0].map(|number| (number, ATTEMPTS..ATTEMPTS + FURTHER));
        let lonely = numbers.iter().all(|&number| number != 0).then_some((0, 0..ATTEMPTS));
        for (last, (number, attempts)) in
            usual.map(|of| (false, of)).chain(lonely.into_iter().chain(further).map(|of| (true, of)))
        {
            if last && (enough || (anywhere && number == 0)) {
                continue;
            }
            let mut closely = CLOSELY;
            for attempt in attempts {
                let states = self.states;
                let (verdict, moved) = match self.get(number, attempt) {
                    Some(state) => (subject.compare(states, state, &mut closely), !state.defaults),
                    None => (Verdict::Unclear(Doubt::Open), false),
                };
                match verdict {
                    Verdict::Right => {
                        anywhere = true;
                        enough |= moved || constant;
                        break;
                    }
                    Verdict::Wrong(_) => return verdict,
                    Verdict::Unclear(why) => doubt = doubt.or(Some(why)),
                }
            }
        }
        match enough {
            true if subject.residual => self.compare_residual(subject),
            true => Verdict::Right,
            false => Verdict::Unclear(doubt.unwrap_or(Doubt::Open)),
        }
    }

    /// What tells of parameters that open loops is nothing but rounding where these are closed.
    fn compare_granted(&mut self, subject: &Subject<'_>, numbers: &[usize]) -> Verdict {
        let verdict = self.compare(subject, numbers);
        match verdict {
            Verdict::Unclear(Doubt::Rounding) if self.states.has_pinned() => {}
            _ => return verdict,
        }
        for attempt in 0..ATTEMPTS {
            match subject.compare_open(self.states, &self.states.unpinned(1, attempt)) {
                Verdict::Unclear(_) => {}
                other => return other,
            }
        }
        verdict
    }

    /// At one open guess.
    fn compare_residual(&self, subject: &Subject<'_>) -> Verdict {
        let mut doubt = Doubt::Open;
        for attempt in 0..ATTEMPTS {
            match subject.compare_residual(self.states, &self.states.open(1, attempt)) {
                Verdict::Unclear(why) => doubt = why,
                other => return other,
            }
        }
        Verdict::Unclear(doubt)
    }
}

/// The same of programs some of which stand as they were derived.
pub fn check_with(
    model: &Model,
    structure: &Structure,
    derivation: &Derivation,
    compiled: &Compiled,
    plain: Plain<'_>,
) -> Found {
    let states = States::new(model, structure, &derivation.symbols);
    let tapes: Vec<Tape> =
        compiled.functions.iter().map(|function| Tape::new(&derivation.graph, of(derivation, function))).collect();
    let closing = compiled.functions.iter().zip(&tapes).find(|(function, _)| function.kind == FunctionKind::Guess);
    let forms: Vec<Lowered<'_>> =
        compiled.functions.iter().map(|function| Lowered::new(&derivation.graph, of(derivation, function))).collect();
    let mut drawn = Drawn { states: &states, closing: closing.map(|pair| pair.1), list: HashMap::new() };
    let mut found = Found::default();
    for ((function, tape), lowered) in compiled.functions.iter().zip(&tapes).zip(&forms) {
        let residual = has_residual(function.kind, structure, closing.is_some());
        let (plain, prelude) = (plain.functions.contains(&function.kind), Some(&compiled.prelude));
        let subject = Subject { tape, lowered, plain, prelude, at: None, program: &function.program, residual };
        let numbers = numbers(tape);
        let verdict = match function.kind {
            FunctionKind::Granted => drawn.compare_granted(&subject, numbers),
            _ => drawn.compare(&subject, numbers),
        };
        match verdict {
            Verdict::Right => {}
            Verdict::Wrong(_) => found.wrong.push(function.kind),
            Verdict::Unclear(doubt) => found.unchecked.push(Unchecked { part: Part::Function(function.kind), doubt }),
        }
    }
    at::check(derivation, compiled, plain.at, &tapes, &mut drawn, &mut found, |kind| {
        has_residual(kind, structure, closing.is_some())
    });
    check_checks(derivation, compiled, plain, &mut drawn, &mut found);
    check_inertia(derivation, compiled, &mut drawn, &mut found);
    let beside: Vec<Tape> =
        derivation.witnesses.iter().map(|witness| Tape::new(&derivation.graph, &witness.results.list)).collect();
    let emitted = compiled.functions.iter().zip(&tapes);
    let emitted = emitted.map(|(function, tape)| Known { kind: function.kind, parts: &function.parts, tape });
    let witnesses = derivation.witnesses.iter().zip(&beside);
    let witnesses = witnesses.map(|(witness, tape)| Known { kind: witness.kind, parts: &witness.results.parts, tape });
    let functions: Vec<Known<'_>> = emitted.chain(witnesses).collect();
    let laws = Laws { model, structure, states: &states, functions: &functions };
    let mut pending = laws.all();
    let everywhere = [(1, 0..ATTEMPTS), (0, 0..ATTEMPTS), (0, ATTEMPTS..ATTEMPTS + FURTHER)];
    for (number, attempt) in everywhere.into_iter().flat_map(|(number, list)| list.map(move |k| (number, k))) {
        if pending.is_empty() {
            break;
        }
        let Some(state) = drawn.get(number, attempt) else { continue };
        if let Outcome::Broken(a, b) = laws.judge(state, &mut pending) {
            found.broken = Some((a, b));
            return found;
        }
    }
    let unclear = |open: &laws::Pending| Unchecked {
        part: Part::Law(open.law.between),
        doubt: open.doubt.unwrap_or(Doubt::Open),
    };
    found.unchecked.extend(pending.iter().map(unclear));
    found
}

/// Whether the last result of a function is what iterations leave; `closing` where the model's loops are closed by these.
fn has_residual(kind: FunctionKind, structure: &Structure, closing: bool) -> bool {
    match kind {
        FunctionKind::ForwardDynamics | FunctionKind::Guess | FunctionKind::Margins => closing,
        // By loops of its own, or by those of the model.
        FunctionKind::Kinematics(number) => closing || structure.closures.get(number).is_some_and(Option::is_some),
        _ => false,
    }
}

/// States for a function. A parameter of zero shows nothing of what it multiplies: where one state must do, parameters are not
/// at their defaults.
fn numbers(tape: &Tape) -> &'static [usize] {
    match tape.nodes.len() {
        0..=2_000 => &[0, 1, 2],
        2_001..=10_000 => &[0, 1],
        _ => &[1],
    }
}

/// The tests of parameters.
fn check_checks(
    derivation: &Derivation,
    compiled: &Compiled,
    plain: Plain<'_>,
    drawn: &mut Drawn<'_>,
    found: &mut Found,
) {
    if compiled.checks.list.is_empty() {
        return;
    }
    let roots: Vec<Scalar> = derivation.checks.iter().flat_map(|test| test.values.iter().copied()).collect();
    let tape = Tape::new(&derivation.graph, &roots);
    let lowered = Lowered::new(&derivation.graph, &roots);
    let (plain, program) = (plain.checks, &compiled.checks.program);
    let subject = Subject { tape: &tape, lowered: &lowered, plain, prelude: None, at: None, program, residual: false };
    match drawn.compare_granted(&subject, &[0, 1]) {
        Verdict::Right => {}
        Verdict::Wrong(_) => found.wrong_checks = true,
        Verdict::Unclear(doubt) => found.unchecked.push(Unchecked { part: Part::Checks, doubt }),
    }
}

/// The mass matrix of `System::without_inertia`.
fn check_inertia(derivation: &Derivation, compiled: &Compiled, drawn: &mut Drawn<'_>, found: &mut Found) {
    let (Inertia::Own(roots), Inertia::Own(program)) = (&derivation.inertia, &compiled.inertia) else { return };
    let tape = Tape::new(&derivation.graph, roots);
    let lowered = Lowered::new(&derivation.graph, roots);
    let (plain, prelude) = (true, Some(&compiled.prelude));
    let subject = Subject { tape: &tape, lowered: &lowered, plain, prelude, at: None, program, residual: false };
    match drawn.compare(&subject, &[0, 1]) {
        Verdict::Right => {}
        Verdict::Wrong(_) => found.wrong_inertia = true,
        Verdict::Unclear(doubt) => found.unchecked.push(Unchecked { part: Part::Inertia, doubt }),
    }
}

/// Results of a function as they were derived.
fn of<'d>(derivation: &'d Derivation, function: &Function) -> &'d [Scalar] {
    let derived = derivation.functions.iter().find(|derived| derived.kind == function.kind);
    &derived.or_fault("what is compiled was derived").candidates[function.candidate].1.list
}
