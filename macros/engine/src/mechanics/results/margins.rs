//! Stage `mechanics`: how far reduced loops are from their dead centres, and how fast they come nearer: what integrators look
//! at around every step.
//!
//! In: the reduction of a model at its solution. Out: for each closed form with a root this root, for each iteration the
//! determinant of its equations, and of the equations by which rates follow from velocities, each followed by the rate of its square; behind them the residual that iterations have
//! left. In a dead centre a root, or a determinant, goes through zero; the rate of its square is finite there, since
//! the square is regular in coordinates of the state. Iterations are not made anew: their solution stands in the guess.
//!
//! Determinants of up to [`MOST_MINORS`] equations are expanded by minors, each set of columns once. Larger ones are
//! replaced by what vanishes with them: with two fixed vectors b and c, the last unknown g of (J, b; c, 0) is the
//! determinant of J over that of the bordered matrix, and g / sqrt(1 + g^2) is regular in the poles of g too.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::contracts::results::{Results, Slot};
use crate::invariant::fault::OrFault;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::{Means, Role, Structure};
use crate::model::types::Coordinate;
use crate::symbolic::graph::{Graph, Scalar};

/// Equations whose determinant is written out.
const MOST_MINORS: usize = 8;

impl Structure {
    /// The coordinates whose dead centres integrators look for: those found by closed forms with a root, the first of
    /// every iteration, and of those whose rates follow from velocities.
    pub fn margins(&self) -> Vec<Coordinate> {
        let dependent = |c: &Coordinate| matches!(self.role(*c), Role::Dependent(_));
        let closed = self.dead_centres.iter().copied().filter(dependent);
        let newton = self.steps.iter().filter(|step| matches!(step.means, Means::Newton { .. }));
        let newton = newton.filter_map(|step| step.unknowns.first().copied());
        closed.chain(newton).chain(self.rates.unknowns.first().copied()).collect()
    }
}

impl Equations<'_> {
    /// Roots with the rates of their squares, then the greatest residual if there are iterations. The reduction has to be one
    /// at the guess.
    pub(in crate::mechanics) fn margins(&mut self, reduction: &Reduction) -> Results<Scalar> {
        let mut roots: Vec<Scalar> = reduction.dead_centres.iter().map(|centre| centre.1).collect();
        for entries in &reduction.matrices {
            let size = entries.len().isqrt();
            let root = if size <= MOST_MINORS {
                determinant(&mut self.g, size, entries)
            } else {
                self.bordered(size, entries)
            };
            roots.push(root);
        }
        let squares: Vec<Scalar> = roots.iter().map(|&root| self.g.mul(root, root)).collect();
        let rates = self.time_derivative(&squares);
        let pairs = roots.into_iter().zip(rates).flat_map(|(root, rate)| [root, rate]).collect();
        let mut results = Results::vector(pairs);
        if !reduction.residuals.is_empty() {
            results = results.with_scalar(Slot::Residual, self.worst_residual(reduction));
        }
        Results { list: self.finish(reduction, &results.list), ..results }
    }

    /// What vanishes with the determinant of a large matrix.
    fn bordered(&mut self, size: usize, entries: &[Scalar]) -> Scalar {
        let one = |k: usize| 1.0 + 0.618_033_988_75 * (k % 3) as f64 - 0.25 * (k % 5) as f64;
        let (mut matrix, mut rhs) = (Vec::new(), Vec::new());
        for (k, row) in entries.chunks(size).enumerate() {
            matrix.extend_from_slice(row);
            matrix.push(self.g.decimal(one(k)));
            rhs.push(Scalar::ZERO);
        }
        matrix.extend((0..size).map(|k| self.g.decimal(one(2 * k + 1))));
        matrix.push(Scalar::ZERO);
        rhs.push(Scalar::ONE);
        let found = self.eliminate(size + 1, &matrix, &rhs);
        let g = found.last().copied().or_fault("a margin is one expression");
        let square = self.g.mul(g, g);
        let sum = self.g.add(Scalar::ONE, square);
        let root = self.g.call(Call::Sqrt, &[sum]);
        let inverse = self.g.reciprocal(root);
        let share = self.g.mul(g, inverse);
        // Its sign changes in the poles too, where nothing meets: integrators see it by its rate alone.
        self.g.call(Call::Abs, &[share])
    }
}

/// By minors of the first rows, each set of columns once.
fn determinant(g: &mut Graph, size: usize, entries: &[Scalar]) -> Scalar {
    let mut minors: HashMap<u32, Scalar> = HashMap::from([(0, Scalar::ONE)]);
    for row in entries.chunks(size.max(1)) {
        let mut terms: HashMap<u32, Vec<Scalar>> = HashMap::new();
        let mut known: Vec<(u32, Scalar)> = minors.into_iter().collect();
        known.sort_unstable_by_key(|entry| entry.0);
        for (columns, minor) in known {
            for (column, &entry) in row.iter().enumerate() {
                let bit = 1 << column;
                if columns & bit != 0 || entry == Scalar::ZERO || minor == Scalar::ZERO {
                    continue;
                }
                let is_odd = (columns >> column).count_ones() % 2 == 1;
                let term = g.mul(minor, entry);
                terms.entry(columns | bit).or_default().push(if is_odd { -term } else { term });
            }
        }
        let mut sums: Vec<(u32, Vec<Scalar>)> = terms.into_iter().collect();
        sums.sort_unstable_by_key(|entry| entry.0);
        minors = sums.into_iter().map(|(columns, terms)| (columns, g.sum(&terms))).collect();
    }
    let all = (1_u32 << size).wrapping_sub(1);
    minors.get(&all).copied().or_fault("the minor of all rows is the last")
}
