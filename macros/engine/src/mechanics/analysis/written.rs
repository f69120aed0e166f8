//! Stage `mechanics`: in which axes the equations that were kept say as much as where they were chosen.
//!
//! In: a model with its structure. Out: whether a [`Writing`] will do. The analysis picks equations in one writing: of the
//! three components of a way in a planar loop it leaves out the one across the plane. The components of other axes mix
//! these, and the places of those that were kept may hold the very one that says nothing. So the kept equations must have
//! the rank there that they have here, at every closed configuration that was found.

use crate::model::types::{Closing, Model};

use super::super::closings::{Writing, is_component};
use super::super::structure::{Row, Structure};
use super::problem::Problem;
use super::rank;
use super::tape::Values;

/// Judges writings of one model.
pub(in super::super) struct Writings<'m> {
    model: &'m Model,
    structure: &'m Structure,
    /// Ranks in the axes of the analysis at closed configurations; nothing where any axes will do.
    ranks: Option<Vec<usize>>,
}

impl<'m> Writings<'m> {
    pub(in super::super) fn new(model: &'m Model, structure: &'m Structure) -> Self {
        let mut writings = Writings { model, structure, ranks: None };
        if writings.is_partial() {
            writings.ranks = Some(writings.ranks_in(Writing::PLAIN));
        }
        writings
    }

    pub(in super::super) fn will_do(&self, writing: Writing) -> bool {
        let Some(ranks) = &self.ranks else { return true };
        // Without a closed configuration nothing is known of other axes.
        writing == Writing::PLAIN || (!ranks.is_empty() && *ranks == self.ranks_in(writing))
    }

    /// Whether some components of a way are kept and others are not. All three say the same in any axes.
    fn is_partial(&self) -> bool {
        let mut counts: Vec<(Closing, usize)> = Vec::new();
        for row in self.structure.rows.iter().filter(|row| is_component(self.model, row.closing, row.index)) {
            match counts.iter_mut().find(|one| one.0 == row.closing) {
                Some(one) => one.1 += 1,
                None => counts.push((row.closing, 1)),
            }
        }
        counts.iter().any(|one| one.1 < 3)
    }

    fn ranks_in(&self, writing: Writing) -> Vec<usize> {
        let problem = Problem::written(self.model, writing);
        let place = |row: &Row| problem.equation_of(*row);
        let equations: Vec<usize> = self.structure.rows.iter().filter_map(place).collect();
        let (all, mut values) = ((0..equations.len()).collect::<Vec<_>>(), Values::default());
        let rank = |closed: &super::super::structure::Closed| {
            let at = problem.linearise(&problem.at(&closed.positions), &equations, &mut values);
            let jacobian: Vec<Vec<f64>> = at.rows.iter().map(|row| problem.unit_row(row)).collect();
            rank::of(&jacobian, &all)
        };
        self.structure.closed.iter().map(rank).collect()
    }
}
