//! Stage `verify`: one program against the equations that it was made from.
//!
//! In: the tape of a function, its program, a state. Out: a [`Verdict`]. A result is right if it is no further from the
//! exact value than a few errors that the derived equations make themselves in double precision at this state, or, if that is not
//! enough to tell, than what one rounding of each of their operations can do at worst. Both come from the derived equations:
//! the operations of the program under test, and the size of its coefficients, excuse nothing; what is written as derived
//! may lose [`FORMS`] times as much.

use std::ops::Range;

use super::arithmetic::Arithmetic;
use super::machine::{self, Reads};
use super::states::{State, States};
use super::tape::Tape;
use super::trace::Trace;
use crate::optimize::program::{Doubt, Program};
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::SymbolId;

/// As many times its own error, or rounding, a result may be off without being looked at closely.
const PLAIN: f64 = 64.0;

/// As many times the greatest error by one rounding of every operation it may be off at all.
pub(super) const WORST: f64 = 4.0;

/// As many times all this a program may be off that stands as it was derived: the form in which its operations are written may
/// lose more digits than the equations do.
const FORMS: f64 = 1e4;

/// What may be missing of what is left where parameters open a loop.
const OPEN: f64 = 0.1;

/// What is zero up to the rounding of 31 digits beside the largest result, such as the square of a cosine of axes that the state
/// has at right angles, has no digits: a program that is off by one rounding of the largest is neither right nor wrong there.
const LOST: f64 = 1e-28;

/// Results that keep fewer digits than this are not worth a comparison.
const POOR: f64 = 1e-6;

/// Operations of sweeps, at most, with which the results of a function are looked at one by one at one state and what is drawn
/// in its place; the worst result of each is looked at whatever it takes.
pub(super) const CLOSELY: usize = 200_000_000;

/// What a comparison says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    Right,
    /// The result with this number is wrong.
    Wrong(usize),
    /// Not at this state.
    Unclear(Doubt),
}

/// A function, its program and what is left out of the comparison.
pub(super) struct Subject<'a> {
    pub tape: &'a Tape,
    /// Of a program that is written as derived, its own operations: vectors component by component, and one form for equal
    /// expressions, which may be worse than another. These must have the values of the equations; the program must
    /// have the values of these, within the error that they make, and those of the equations within a multiple of theirs.
    pub lowered: Option<&'a Tape>,
    /// What computes the fields of the model, where the program reads them.
    pub prelude: Option<&'a Program>,
    pub program: &'a Program,
    /// Whether the last result is what an iteration has left: nothing but rounding where loops are closed.
    pub residual: bool,
}

impl Subject<'_> {
    /// What is left of `closely`, operations with which results are looked at one by one, is given back.
    pub(super) fn compare(&self, states: &States<'_>, state: &State, closely: &mut usize) -> Verdict {
        let count = self.tape.roots.len().saturating_sub(usize::from(self.residual));
        self.compare_roots(states, state, 0..count, usize::MAX, closely)
    }

    /// What iterations leave, where they have left something: after one round from a guess at which loops are open.
    pub(super) fn compare_residual(&self, states: &States<'_>, state: &State) -> Verdict {
        let count = self.tape.roots.len();
        self.compare_roots(states, state, count.saturating_sub(1)..count, 1, &mut 0)
    }

    /// What tells that parameters open a loop, where they do. Closed forms rest on all equations there are, and what follows from
    /// them otherwise is off by squares of what these leave: as long as much less is missing than is left, it is noticed.
    pub(super) fn compare_open(&self, states: &States<'_>, state: &State) -> Verdict {
        let symbol = |id: SymbolId| state.value(id);
        let exact = Trace::<Doubled>::new(self.tape, &symbol).roots();
        let look = |symbol| states.value(state, symbol);
        let nothing = Reads { symbol: &look, fields: &[], deficient: &[], rounds: usize::MAX };
        let fields = self.prelude.map_or_else(Vec::new, |prelude| machine::run(prelude, &nothing));
        let results = machine::run(self.program, &Reads { fields: &fields, ..nothing });
        let largest = exact.iter().fold(0.0_f64, |largest, x| largest.max(x.high.abs()));
        let clear = exact.iter().all(|x| x.high.is_finite()) && largest > POOR;
        let off = |(result, exact): (&f64, &Doubled)| (Doubled::of(*result).sub(*exact)).high.abs();
        let worst = results
            .iter()
            .zip(&exact)
            .map(off)
            .fold(0.0_f64, |worst, x| if x > worst || x.is_nan() { x } else { worst });
        match clear {
            false => Verdict::Unclear(Doubt::Open),
            true if worst <= OPEN * largest => Verdict::Right,
            true => Verdict::Wrong(0),
        }
    }

    fn compare_roots(
        &self,
        states: &States<'_>,
        state: &State,
        which: Range<usize>,
        rounds: usize,
        closely: &mut usize,
    ) -> Verdict {
        let symbol = |id: SymbolId| state.value(id);
        let exact: Trace<'_, Doubled> = Trace::rounds(self.tape, &symbol, rounds);
        let deficient = exact.deficient();
        let look = |symbol| states.value(state, symbol);
        let nothing = Reads { symbol: &look, fields: &[], deficient: &[], rounds };
        let fields = self.prelude.map_or_else(Vec::new, |prelude| machine::run(prelude, &nothing));
        let reads = Reads { symbol: &look, fields: &fields, deficient: &deficient, rounds };
        let results = machine::run(self.program, &reads);
        let own = |tape| Trace::<f64>::rounds(tape, &symbol, rounds).roots();
        // What a system of lesser rank leaves open depends on the order of pivots, which others may take otherwise.
        match self.lowered.filter(|_| deficient.is_empty()) {
            None => judge(&exact, &own(self.tape), &results, which, 1.0, closely),
            Some(lowered) => {
                let between: Trace<'_, Doubled> = Trace::rounds(lowered, &symbol, rounds);
                let values: Vec<f64> = between.roots().iter().map(|x| x.high).collect();
                let derived = own(self.tape);
                let mut verdict = judge(&exact, &derived, &values, which.clone(), 1.0, closely);
                if verdict == Verdict::Right {
                    verdict = judge(&between, &own(lowered), &results, which.clone(), 1.0, closely);
                }
                if verdict == Verdict::Right {
                    verdict = judge(&exact, &derived, &results, which, FORMS, closely);
                }
                verdict
            }
        }
    }
}

/// Results with these numbers against exact values, within the error that the operations of these make; `own` are their values in
/// double precision. They may be off by so many `times` what is allowed else.
fn judge(
    exact: &Trace<'_, Doubled>,
    own: &[f64],
    results: &[f64],
    which: Range<usize>,
    times: f64,
    closely: &mut usize,
) -> Verdict {
    let derived = exact.roots();
    if results.len() != derived.len() {
        return Verdict::Wrong(results.len().min(derived.len()));
    }
    let doubt = match (exact.kink, exact.unclear) {
        (true, _) => Some(Doubt::Comparison),
        (_, true) => Some(Doubt::Rank),
        _ => None,
    };
    let wrong = |at: usize| doubt.map_or(Verdict::Wrong(at), Verdict::Unclear);
    let mut scales = vec![0.0; derived.len()];
    let (mut largest, mut lost) = (0.0_f64, 0.0_f64);
    for at in which.clone() {
        let (exact, own) = (derived[at], own[at]);
        if !exact.high.is_finite() || !own.is_finite() {
            return Verdict::Unclear(Doubt::NotFinite);
        }
        let error = (Doubled::of(own).sub(exact)).high.abs();
        (largest, lost) = (largest.max(exact.high.abs()), lost.max(error));
        scales[at] = exact.high.abs().max(error / f64::EPSILON);
    }
    if lost > POOR * largest {
        return Verdict::Unclear(Doubt::Rounding);
    }
    let (mut suspects, mut open): (Vec<(f64, usize, f64)>, bool) = (Vec::new(), false);
    for at in which {
        let (exact, result) = (derived[at], results[at]);
        if !result.is_finite() {
            return wrong(at);
        }
        let error = Doubled::of(result).sub(exact).high;
        // Below what single numbers can hold there are no relative errors.
        let scale = scales[at].max(f64::MIN_POSITIVE / f64::EPSILON);
        let ratio = error.abs() / (f64::EPSILON * scale);
        if ratio <= times * PLAIN {
            continue;
        }
        let no_digits = exact.high != 0.0 && exact.high.abs() <= LOST * largest;
        if no_digits && result.abs() <= PLAIN * f64::EPSILON * largest {
            open = true;
        } else {
            suspects.push((ratio, at, error.signum() / scale));
        }
    }
    // Each for itself: of a sum large bounds would hide what is wrong beside them, and bounds that cancel would accuse.
    suspects.sort_by(|a, b| b.0.total_cmp(&a.0));
    let cost = exact.tape.nodes.len().max(1);
    let count = (*closely / cost).max(1).min(suspects.len());
    *closely = closely.saturating_sub(count * cost);
    open |= count < suspects.len();
    for &(ratio, at, weight) in &suspects[..count] {
        let mut single = vec![0.0; derived.len()];
        single[at] = weight;
        let bound = exact.slopes::<f64>(&single, 0).bound;
        if !bound.is_finite() {
            open = true;
        } else if ratio > times * WORST * bound {
            return wrong(at);
        }
    }
    if open { Verdict::Unclear(Doubt::Rounding) } else { Verdict::Right }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::graph::Graph;

    /// What is accepted of sines of large angles that are off by these shares of a rounding of the angle.
    fn verdict(shares: &[f64], mut closely: usize) -> Verdict {
        let mut g = Graph::new();
        let x = g.symbol();
        let (steep, mut roots, mut results) = (134_217_728.0, Vec::new(), Vec::new());
        for (k, share) in shares.iter().enumerate() {
            // Powers of two have no rounding, so the equations as derived are better than their bound.
            let times = steep * f64::powi(2.0, k as i32);
            let factor = g.decimal(times);
            let angle = g.mul(factor, x);
            roots.push(g.sin(angle));
            results.push((0.3 * times * (1.0 + share * f64::EPSILON)).sin());
        }
        let tape = Tape::new(&g, &roots);
        let symbol = |_: SymbolId| Doubled::new(0.3);
        let exact: Trace<'_, Doubled> = Trace::new(&tape, &symbol);
        let own = Trace::<f64>::new(&tape, &symbol).roots();
        judge(&exact, &own, &results, 0..results.len(), 1.0, &mut closely)
    }

    /// More suspects than there is time for are no excuse for the worst of them.
    #[test]
    fn the_worst_is_always_looked_at() {
        let most = usize::MAX;
        assert_eq!(verdict(&[1.0, 1.0, 1.0], most), Verdict::Right);
        assert_eq!(verdict(&[1.0, 1.0, 1.0], 0), Verdict::Unclear(Doubt::Rounding));
        for closely in [most, 0] {
            assert_eq!(verdict(&[1.0, 1e4, 1.0], closely), Verdict::Wrong(1));
            assert!(matches!(verdict(&[1e4, 1e4, 1e4], closely), Verdict::Wrong(_)));
        }
    }
}
