//! Stage `mechanics`: in which axes the equations that were kept say as much as where they were chosen.
//!
//! In: a model with its structure. Out: whether a [`Writing`] will do. The analysis picks equations in one writing: of the
//! three components of a way in a planar loop it leaves out the one across the plane. The components of other axes mix
//! these, and the places of those that were kept may hold the very one that says nothing. So the kept equations must have
//! the rank there that they have here, at every closed configuration that was found.
//! And they must be as steady there ([`super::steadiness`]): where the plane turns against the axes, which component says nothing changes with the
//! pose.

use crate::mechanics::loops::constraints::{Writing, is_component};
use crate::mechanics::loops::structure::{Closed, Means, Role, Row, Structure};
use crate::model::types::{ConstraintKind, Coordinate, JointId, LoopClosure, Model};

use super::problem::Problem;
use super::rank;
use super::steadiness::{STEADY, needed, steadiness};
use super::stress::are_determined;
use super::tape::Values;

/// Judges writings of one model.
pub(in super::super) struct Writings<'m> {
    model: &'m Model,
    structure: &'m Structure,
    /// Of the axes of the analysis; nothing where any axes will do.
    own: Option<Own>,
}

/// What other axes are measured by.
struct Own {
    /// By system, at closed configurations.
    ranks: Vec<Vec<usize>>,
    steadiness: f64,
}

impl<'m> Writings<'m> {
    pub(in super::super) fn new(model: &'m Model, structure: &'m Structure) -> Self {
        let mut writings = Writings { model, structure, own: None };
        if writings.is_partial() {
            let (ranks, steadiness) =
                (writings.ranks_in(structure.writing), steadiness(model, structure, structure.writing));
            writings.own = Some(Own { ranks, steadiness });
        }
        writings
    }

    /// What there is to choose from: no more than one where nothing is written in axes.
    pub(in super::super) fn ways(&self) -> Vec<Writing> {
        let all = if self.differ() { &Writing::ALL[..] } else { &Writing::ALL[..1] };
        all.iter().copied().filter(|&writing| self.will_do(writing)).collect()
    }

    /// Whether any equation is written in axes: those of cut joints and rods are, and an expression is the same in all of them.
    fn differ(&self) -> bool {
        let in_axes = |row: &Row| match row.closing {
            LoopClosure::Cut(_) => true,
            LoopClosure::Constraint(id) => matches!(self.model.constraints[id].kind, ConstraintKind::Rod { .. }),
        };
        self.systems().iter().any(|(rows, _)| rows.iter().any(in_axes))
    }

    fn will_do(&self, writing: Writing) -> bool {
        let Some(Own { ranks, steadiness }) = &self.own else { return true };
        // Without a closed configuration nothing is known of other axes.
        writing == self.structure.writing
            || (!self.structure.closed.is_empty()
                && *ranks == self.ranks_in(writing)
                && self.is_steady(writing, *steadiness)
                && are_determined(self.model, self.structure, writing))
    }

    fn is_steady(&self, writing: Writing, own: f64) -> bool {
        steadiness(self.model, self.structure, writing) >= STEADY.min(own)
            && needed(self.model, self.structure, writing).is_empty()
    }

    /// Whether some components of a way are kept and others are not. All three say the same in any axes.
    fn is_partial(&self) -> bool {
        self.systems().iter().any(|(rows, _)| {
            let mut counts: Vec<(LoopClosure, usize)> = Vec::new();
            for row in rows.iter().filter(|row| is_component(self.model, row.closing, row.index)) {
                match counts.iter_mut().find(|one| one.0 == row.closing) {
                    Some(one) => one.1 += 1,
                    None => counts.push((row.closing, 1)),
                }
            }
            counts.iter().any(|one| one.1 < 3)
        })
    }

    /// Rows that are written in axes, with the coordinates in which they must be regular: all rows in what no drive gives,
    /// and those that Newton's method solves in its unknowns.
    fn systems(&self) -> Vec<(Vec<Row>, Vec<Coordinate>)> {
        let mut systems = vec![(self.structure.rows.clone(), self.moved())];
        for step in &self.structure.steps {
            if let Means::Newton { rows, .. } = &step.means {
                systems[0].0.extend(rows);
                systems.push((rows.clone(), step.unknowns.clone()));
            }
        }
        systems
    }

    /// Coordinates that no drive gives.
    fn moved(&self) -> Vec<Coordinate> {
        let joints = self.structure.roles.iter().enumerate();
        let all = joints.flat_map(|(joint, roles)| {
            let coordinate = move |index: usize| Coordinate { joint: JointId(joint), index };
            let free = roles.iter().enumerate().filter(|(_, role)| !matches!(role, Role::Driven(_)));
            free.map(move |(index, _)| coordinate(index))
        });
        all.collect()
    }

    /// By system, at every closed configuration.
    fn ranks_in(&self, writing: Writing) -> Vec<Vec<usize>> {
        let problem = Problem::written(self.model, writing);
        let mut values = Values::default();
        let mut ranks = Vec::new();
        for (rows, coordinates) in self.systems() {
            let equations: Vec<usize> = rows.iter().filter_map(|row| problem.equation_of(*row)).collect();
            let all: Vec<usize> = (0..equations.len()).collect();
            let counts = |entry: &&(usize, f64)| {
                problem.columns.get(entry.0).is_some_and(|column| coordinates.contains(&column.coordinate))
            };
            let rank = |closed: &Closed| {
                let at = problem.linearise(&problem.at(&closed.positions), &equations, &mut values);
                let own = at.rows.iter().map(|row| row.iter().filter(counts).copied().collect::<Vec<_>>());
                let jacobian: Vec<Vec<f64>> = own.map(|row| problem.unit_row(&row)).collect();
                rank::of(&jacobian, &all)
            };
            ranks.push(self.structure.closed.iter().map(rank).collect());
        }
        ranks
    }
}
