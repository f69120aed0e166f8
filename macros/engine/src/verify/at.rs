//! Stage `verify`: functions that go on from what `Model::at` computes.
//!
//! In: the derivation and what was compiled of it. Out: what is wrong, what is not clear. Each program is run behind that of
//! `Model::at`, and compared with the equations that it was made from, as any function is. These may be derived in another way
//! than those of the method of `Model` that has the same name: then both are evaluated with 31 digits, and must agree. What is
//! computed at a position may read nothing that is known later, which no comparison at one state shows.

use crate::contracts::function::FunctionKind;
use crate::mechanics::Derivation;
use crate::optimize::program::{At, Compiled, Doubt, Expression, Part, Unchecked};
use crate::optimize::stage::Stage;
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::SymbolId;

use super::arithmetic::Arithmetic;
use super::programs::{Lowered, Subject, Verdict};
use super::states::State;
use super::tape::Tape;
use super::trace::Trace;
use super::{ATTEMPTS, Drawn, Found, numbers, of};

/// By which share of the greatest result two ways to a function may differ at 31 digits.
const SAME: f64 = 1e-12;

/// `tapes` are the functions of the model, `has_residual` tells whose last result is what iterations leave.
pub(super) fn check(
    derivation: &Derivation,
    compiled: &Compiled,
    plain: bool,
    tapes: &[Tape],
    drawn: &mut Drawn<'_>,
    found: &mut Found,
    has_residual: impl Fn(FunctionKind) -> bool,
) {
    let Some(at) = &compiled.at else { return };
    // At one state the program has the same values, whatever it reads.
    if !is_early(at) {
        found.wrong_at = at.functions.first().map(|function| function.kind);
    }
    for function in &at.functions {
        let results = of(derivation, function);
        let tape = Tape::new(&derivation.graph, results);
        let lowered = Lowered::new(&derivation.graph, results);
        let (prelude, before, residual) = (Some(&compiled.prelude), Some(&at.program), has_residual(function.kind));
        let program = &function.program;
        let subject = Subject { tape: &tape, lowered: &lowered, plain, prelude, at: before, program, residual };
        let verdict = drawn.compare(&subject, numbers(&tape));
        let alone = compiled.functions.iter().zip(tapes).find(|(alone, _)| alone.kind == function.kind);
        let other = alone.filter(|(alone, _)| alone.candidate != function.candidate).map(|(_, tape)| tape);
        if other.is_some_and(|other| contradicts(&tape, other, residual, drawn)) {
            found.broken = Some((function.kind, function.kind));
        }
        match verdict {
            Verdict::Right => {}
            Verdict::Wrong(_) => found.wrong_at = found.wrong_at.or(Some(function.kind)),
            Verdict::Unclear(doubt) => open(found, function.kind, doubt),
        }
    }
}

/// Whether `Model::at` reads nothing that is known later than the position.
fn is_early(at: &At) -> bool {
    let mut early = true;
    for expression in at.program.expressions() {
        expression.each_leaf(&mut |leaf| {
            early &= !matches!(leaf, Expression::Symbol(symbol) if Stage::of(*symbol) > Stage::Position);
        });
    }
    early
}

fn open(found: &mut Found, kind: FunctionKind, doubt: Doubt) {
    found.unchecked.push(Unchecked { part: Part::At(kind), doubt });
}

/// Whether two ways to a function differ at the first state at which both are clear.
fn contradicts(a: &Tape, b: &Tape, residual: bool, drawn: &mut Drawn<'_>) -> bool {
    if a.roots.len() != b.roots.len() {
        return true;
    }
    let count = a.roots.len() - usize::from(residual);
    for attempt in 0..ATTEMPTS {
        let Some(state) = drawn.get(1, attempt) else { continue };
        let Some((a, b)) = exact(a, state).zip(exact(b, state)) else { continue };
        let largest = a[..count].iter().fold(0.0_f64, |most, x| most.max(x.high.abs()));
        return a[..count].iter().zip(&b[..count]).any(|(&a, &b)| a.sub(b).high.abs() > SAME * largest);
    }
    false
}

/// Nothing where a comparison or a rank decides.
fn exact(tape: &Tape, state: &State) -> Option<Vec<Doubled>> {
    let symbol = |id: SymbolId| state.value(id);
    let trace = Trace::<Doubled>::new(tape, &symbol);
    let roots = trace.roots();
    let clear = !trace.kink && !trace.unclear && trace.deficient().is_empty();
    (clear && roots.iter().all(|x| x.high.is_finite())).then_some(roots)
}
