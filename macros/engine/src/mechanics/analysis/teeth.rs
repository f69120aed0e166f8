//! Stage `mechanics`: couplings of measured angles that Newton's method could close on another tooth.
//!
//! In: the steps of a reduction. Out: a complaint where two poses satisfy a step that lie nearer to each other than what
//! can be told from its guess. An equation that counts measured angles vanishes at every whole number of its periods: two
//! angles in the ratio 47 : 13 have 13 poses of one wheel for each of the other. Multipliers hold the one of the start,
//! since they move on from it; Newton's method would go to the one nearest to its guess, which is the solution of the step
//! before, with no residual and no sign of a dead centre. It does no harm where all solutions are the same pose: where one
//! angle alone counts, or where from one to the next the unknowns go round whole times.

use std::f64::consts::TAU;

use crate::mechanics::loops::constraints::turns;
use crate::mechanics::loops::structure::{Means, Step};
use crate::model::types::{ConstraintId, LoopClosure};

use super::Complaint;
use super::checks::thing;
use super::configurations::Configuration;
use super::reduction::{PIVOT, ReductionSearch, eliminate};
use super::tape::Values;

impl ReductionSearch<'_> {
    pub(super) fn check_teeth(&self, steps: &[Step]) -> Result<(), Vec<Complaint>> {
        for step in steps {
            let Means::Newton { rows, .. } = &step.means else { continue };
            let constraints: Vec<ConstraintId> = rows
                .iter()
                .filter_map(|row| match row.closing {
                    LoopClosure::Constraint(id) => Some(id),
                    LoopClosure::Cut(_) => None,
                })
                .collect();
            let periods = turns::periods(self.model, &constraints);
            if matches!(periods[..], [] | [(_, _, 1)]) {
                continue;
            }
            let unsound = periods.iter().find(|&&(id, period, _)| !self.goes_round(steps, step, id, period));
            if let Some(&(id, ..)) = unsound {
                let (at, what) = thing(self.model, LoopClosure::Constraint(id));
                let message = format!(
                    "{what} can't be reduced: the angles that it couples are measured between bodies and known up to whole \
                     turns, so Newton's method could go to another tooth"
                );
                let help = "write `constraints: Multipliers`, or let the joints have coordinates, which count their turns: \
                            `coordinates: Joint`, or none, in the place of `Absolute(..)`";
                return Err(vec![Complaint { at, message, help: Some(help.to_owned()) }]);
            }
        }
        Ok(())
    }

    /// Whether the unknowns of a step, and what couplings give from them, go round whole times from one solution of a
    /// constraint to the next, all other equations held.
    fn goes_round(&self, steps: &[Step], step: &Step, id: ConstraintId, period: f64) -> bool {
        let unknowns = steps.iter().flat_map(|step| &step.unknowns);
        let unknowns = unknowns.chain(self.eliminations.iter().map(|one| &one.unknown));
        let columns: Vec<usize> = unknowns.filter_map(|&unknown| self.column(unknown)).collect();
        let coupled = |column: usize| self.eliminations.iter().any(|one| one.unknown == self.coordinate(column));
        let asked = |column: usize| step.unknowns.contains(&self.coordinate(column)) || coupled(column);
        let ways: Vec<Option<Vec<f64>>> =
            self.configurations.iter().map(|at| self.way_on(at, &columns, id, period)).collect();
        let mut ways = ways.into_iter().flatten().peekable();
        ways.peek().is_some()
            && ways.all(|way| {
                way.iter().zip(&columns).filter(|(_, column)| asked(**column)).all(|(way, &column)| {
                    let turns = way / TAU;
                    let whole =
                        if self.problem.columns[self.group.columns[column]].travels { 0.0 } else { turns.round() };
                    (turns - whole).abs() < 1e-6
                })
            })
    }

    /// How columns change by one period of a constraint, along the tangent; nothing where that is not determined.
    fn way_on(&self, at: &Configuration, columns: &[usize], id: ConstraintId, period: f64) -> Option<Vec<f64>> {
        let own = self.row_of_constraint(id)?;
        let equations: Vec<usize> = self.kept.iter().map(|&place| self.group.equations[place]).collect();
        let lines = self.problem.linearise(&at.point, &equations, &mut Values::default()).rows;
        let size = columns.len();
        let mut matrix: Vec<Vec<f64>> = lines
            .iter()
            .zip(self.kept)
            .map(|(line, &place)| {
                let entry = |&column: &usize| {
                    line.iter().filter(|entry| entry.0 == self.group.columns[column]).map(|entry| entry.1).sum()
                };
                let scale = self.problem.equations[self.group.equations[place]].scale;
                columns.iter().map(entry).chain([if place == own { period / scale } else { 0.0 }]).collect()
            })
            .collect();
        let (mut rows, mut found) = ((0..matrix.len()).collect::<Vec<_>>(), vec![0.0; size]);
        let mut pivots = Vec::new();
        for column in 0..size {
            let best = rows.iter().copied().max_by(|&a, &b| {
                let size = |row: usize| matrix[row][column].abs();
                size(a).total_cmp(&size(b))
            })?;
            if matrix[best][column].abs() <= PIVOT {
                return None;
            }
            eliminate(&mut matrix, best, column);
            rows.retain(|&row| row != best);
            pivots.push(best);
        }
        for (column, row) in pivots.into_iter().enumerate() {
            found[column] = matrix[row][size] / matrix[row][column];
        }
        Some(found)
    }
}
