//! Stage `mechanics`: what counts as open at a start.
//!
//! In: the equations as numbers, the closed configurations that were found. Out: for each equation how fast it changes
//! where the loops are closed, and for each coordinate what counts as one: travels count in the mechanism's size, as angles do in rad.
//! A residual over its scale is the least movement, in these units, that closes its equation, whatever its own unit is.

use std::collections::BTreeMap;

use crate::mechanics::loops::structure::{Row, Structure};

use super::closed::Sampled;
use super::problem::{Problem, Source};
use super::tape::Values;

/// Slopes below this share of the usual ones are those of a singular pose.
const SINGULAR: f64 = 1e-6;

impl Structure {
    pub(super) fn measure(&mut self, problem: &Problem, samples: &[Sampled]) {
        let unit = |coordinate| problem.columns.iter().find(|c| c.coordinate == coordinate).map_or(1.0, |c| c.unit);
        self.units = self.state.iter().map(|&coordinate| unit(coordinate)).collect();
        let mut greatest: BTreeMap<usize, f64> = BTreeMap::new();
        let mut values = Values::default();
        for sampled in samples {
            for configuration in sampled.configurations.iter().filter(|configuration| configuration.closed) {
                let found = problem.linearise(&configuration.point, &sampled.group.equations, &mut values);
                for (&equation, row) in sampled.group.equations.iter().zip(&found.rows) {
                    let slope = row.iter().map(|entry| entry.1 * entry.1).sum::<f64>().sqrt();
                    let known = greatest.entry(equation).or_default();
                    *known = if slope.is_finite() { known.max(slope) } else { *known };
                }
            }
        }
        for (k, equation) in problem.equations.iter().enumerate() {
            let Source::Row(row) = equation.source else { continue };
            let share = greatest.get(&k).copied().filter(|&share| share > SINGULAR).unwrap_or(1.0);
            self.scales.insert(row, share * equation.scale);
        }
    }

    /// The residual of an equation that amounts to one.
    pub fn scale(&self, row: Row) -> f64 {
        self.scales.get(&row).copied().filter(|scale| *scale > 0.0 && scale.is_finite()).unwrap_or(1.0)
    }
}
