//! Stage `verify`: one program against the equations that it was made from.
//!
//! In: the tape of a function, its program, a state. Out: a [`Verdict`]. A result is right if it is no further from the
//! exact value than a few errors that the derived equations make themselves in double precision at this state, or, if that is not
//! enough to tell, than what one rounding of each of their operations can do at worst. Both come from the derived equations:
//! the operations of the program under test, and the size of its coefficients, excuse nothing; what is written as derived
//! may lose [`FORMS`] times as much.

use std::cell::{LazyCell, OnceCell};
use std::ops::Range;

use super::arithmetic::Arithmetic;
use super::machine::{self, Reads};
use super::states::{State, States};
use super::tape::Tape;
use super::trace::Trace;
use crate::optimize::program::{Doubt, Program};
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::{Graph, Scalar, SymbolId};
use crate::symbolic::lower::Lowering;

/// As many times its own error, or rounding, a result may be off without being looked at closely.
const PLAIN: f64 = 64.0;

/// As many times the greatest error by one rounding of every operation it may be off at all.
pub(super) const WORST: f64 = 4.0;

/// As many times all this a program may be off that stands as it was derived: the form in which its operations are written may
/// lose more digits than the equations do.
const FORMS: f64 = 1e4;

/// What may be missing of what is left where parameters open a loop.
const OPEN: f64 = 0.1;

/// A result that is zero up to the rounding of 31 digits beside its own terms, such as the square of a cosine of axes that the
/// state has at right angles, has no digits in any form but that in which it was derived; nor has one that is zero there because its terms
/// are equal and opposite, which they are to rounding alone in others.
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

/// The operations of equations that stand as they were derived, component by component; made if they are asked for.
pub(super) struct Lowered<'a> {
    graph: &'a Graph,
    roots: &'a [Scalar],
    tape: OnceCell<Tape>,
}

impl<'a> Lowered<'a> {
    pub(super) fn new(graph: &'a Graph, roots: &'a [Scalar]) -> Lowered<'a> {
        Lowered { graph, roots, tape: OnceCell::new() }
    }

    fn tape(&self) -> &Tape {
        self.tape.get_or_init(|| {
            let mut lowering = Lowering::new(self.graph);
            let roots = lowering.run(self.roots);
            Tape::new(&lowering.to, &roots)
        })
    }
}

/// By how much a result may be off.
struct Margin<'a> {
    /// As many times what is allowed else.
    times: f64,
    /// What a result without digits may be off, in units of the terms that it is the sum of.
    lost: f64,
    /// The sum of the sizes of these terms; zero where results have the digits that their operations leave them.
    terms: &'a dyn Fn(usize) -> f64,
}

/// A function, its program and what is left out of the comparison.
pub(super) struct Subject<'a> {
    pub tape: &'a Tape,
    /// The operations of a program that is written as derived: vectors component by component, and one form for equal
    /// expressions, which may be worse than another. How large the terms of a result are is known from these too.
    pub lowered: &'a Lowered<'a>,
    /// Whether the program is written as derived. Then these operations must have the values of the equations; the program must
    /// have the values of these, within the error that they make, and those of the equations within a multiple of theirs.
    pub plain: bool,
    /// What computes the fields of the model, where the program reads them.
    pub prelude: Option<&'a Program>,
    /// What is computed for a position before it, whose values stand behind the fields of the model.
    pub at: Option<&'a Program>,
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

    /// What iterations leave, where they have left something: after one round from a guess at which loops are open. A single round of third
    /// order may leave nothing but rounding; its residual is evaluated after the loop, so it can be compared at the guess instead.
    pub(super) fn compare_residual(&self, states: &States<'_>, state: &State) -> Verdict {
        let count = self.tape.roots.len();
        let after = |rounds| self.compare_roots(states, state, count.saturating_sub(1)..count, rounds, &mut 0);
        let verdict = after(1);
        if !matches!(verdict, Verdict::Unclear(_)) {
            return verdict;
        }
        // An iteration with several unknowns has no residual before its first round: the zero that stands there is no evidence.
        let at_guess = Trace::<Doubled>::rounds(self.tape, &|id| state.value(id), 0).roots();
        if at_guess.last().is_some_and(|residual| residual.high != 0.0) { after(0) } else { verdict }
    }

    /// What tells that parameters open a loop, where they do. Closed forms rest on all equations there are, and what follows from
    /// them otherwise is off by squares of what these leave: as long as much less is missing than is left, it is noticed.
    pub(super) fn compare_open(&self, states: &States<'_>, state: &State) -> Verdict {
        let symbol = |id: SymbolId| state.value(id);
        let exact = Trace::<Doubled>::new(self.tape, &symbol).roots();
        let look = |symbol| states.value(state, symbol);
        let nothing = Reads { symbol: &look, fields: &[], deficient: &[], rounds: usize::MAX };
        let results = self.run(&nothing);
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

    /// Results of the program, and of what runs before it; `reads` without fields.
    fn run(&self, reads: &Reads<'_>) -> Vec<f64> {
        let mut fields = Vec::new();
        for before in self.prelude.into_iter().chain(self.at) {
            let values = machine::run(before, &Reads { fields: &fields, ..*reads });
            fields.extend(values);
        }
        machine::run(self.program, &Reads { fields: &fields, ..*reads })
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
        let results = self.run(&Reads { deficient: &deficient, ..nothing });
        let own = |tape| Trace::<f64>::rounds(tape, &symbol, rounds).roots();
        let count = self.tape.roots.len();
        let sizes = LazyCell::new(|| Trace::<f64>::rounds(self.lowered.tape(), &symbol, rounds));
        let terms = |at: usize| {
            let mut single = vec![0.0; count];
            single[at] = 1.0;
            sizes.slopes::<f64>(&single, 0).bound
        };
        let rounded = PLAIN * f64::EPSILON;
        let derived = own(self.tape);
        // What a system of lesser rank leaves open depends on the order of pivots, which others may take otherwise.
        if !self.plain || !deficient.is_empty() {
            let margin = Margin { times: 1.0, lost: rounded, terms: &terms };
            return judge(&exact, &derived, &results, which, &margin, closely);
        }
        let mut between: Trace<'_, Doubled> = Trace::rounds(self.lowered.tape(), &symbol, rounds);
        // What one form of the equations leaves open, no other decides.
        between.kink |= exact.kink;
        between.unclear |= exact.unclear;
        let values: Vec<f64> = between.roots().iter().map(|x| x.high).collect();
        let form = Margin { times: 1.0, lost: LOST, terms: &terms };
        let program = Margin { times: 1.0, lost: 0.0, terms: &|_| 0.0 };
        let both = Margin { times: FORMS, lost: rounded, terms: &terms };
        // What is unclear in one of them is no reason to leave out another.
        judge(&exact, &derived, &values, which.clone(), &form, closely)
            .and(judge(&between, &own(self.lowered.tape()), &results, which.clone(), &program, closely))
            .and(judge(&exact, &derived, &results, which, &both, closely))
    }
}

impl Margin<'_> {
    /// Whether a result without digits is off by no more than its terms may be.
    fn excuses(&self, at: usize, exact: f64, error: f64) -> bool {
        let terms = (self.terms)(at);
        terms.is_finite() && exact.abs() <= LOST * terms && error <= self.lost * terms
    }
}

impl Verdict {
    /// What is wrong in one comparison is wrong.
    fn and(self, other: Verdict) -> Verdict {
        match (self, other) {
            (Verdict::Wrong(_), _) | (Verdict::Unclear(_), Verdict::Right | Verdict::Unclear(_)) => self,
            _ => other,
        }
    }
}

/// Results with these numbers against exact values, within the error that the operations of these make; `own` are their values in
/// double precision.
fn judge(
    exact: &Trace<'_, Doubled>,
    own: &[f64],
    results: &[f64],
    which: Range<usize>,
    margin: &Margin<'_>,
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
    let mut suspects: Vec<(f64, usize, f64)> = Vec::new();
    for at in which {
        let (exact, result) = (derived[at], results[at]);
        if !result.is_finite() {
            return wrong(at);
        }
        let error = Doubled::of(result).sub(exact).high;
        // Below what single numbers can hold there are no relative errors.
        let scale = scales[at].max(f64::MIN_POSITIVE / f64::EPSILON);
        let ratio = error.abs() / (f64::EPSILON * scale);
        if ratio > margin.times * PLAIN {
            suspects.push((ratio, at, error.signum() / scale));
        }
    }
    // Each for itself: of a sum large bounds would hide what is wrong beside them, and bounds that cancel would accuse.
    suspects.sort_by(|a, b| b.0.total_cmp(&a.0));
    let cost = exact.tape.nodes.len().max(1);
    let mut count = (*closely / cost).max(1);
    let mut open = false;
    for &(ratio, at, weight) in &suspects {
        if count == 0 {
            open = true;
            break;
        }
        let mut single = vec![0.0; derived.len()];
        single[at] = weight;
        let bound = exact.slopes::<f64>(&single, 0).bound;
        let error = Doubled::of(results[at]).sub(derived[at]).high.abs();
        if !bound.is_finite() {
            open = true;
        } else if ratio > margin.times * WORST * bound {
            if !margin.excuses(at, derived[at].high, error) {
                return wrong(at);
            }
            // Others are no less looked at.
            continue;
        }
        count -= 1;
        *closely = closely.saturating_sub(cost);
    }
    if open { Verdict::Unclear(Doubt::Rounding) } else { Verdict::Right }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let margin = Margin { times: 1.0, lost: 0.0, terms: &|_| 0.0 };
        judge(&exact, &own, &results, 0..results.len(), &margin, &mut closely)
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
