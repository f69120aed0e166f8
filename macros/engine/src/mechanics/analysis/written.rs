//! Stage `mechanics`: in which axes the equations that were kept say as much as where they were chosen.
//!
//! In: a model with its structure. Out: whether a [`Writing`] will do. The analysis picks equations in one writing: of the
//! three components of a way in a planar loop it leaves out the one across the plane. The components of other axes mix
//! these, and the places of those that were kept may hold the very one that says nothing. So the kept equations must have
//! the rank there that they have here, at every closed configuration that was found.
//!
//! Where the plane turns against the axes, which component says nothing changes with the pose: in axes of the world two of three are enough
//! until the plane stands upright. Near there the kept equations are nearly dependent though all of them together are regular, and accelerations
//! lose their digits. So what the kept equations have of the volume that as many of all span has to be much the same at all configurations.

use crate::mechanics::loops::constraints::{Writing, is_component};
use crate::mechanics::loops::structure::{Closed, Means, Role, Row, Structure};
use crate::model::types::{ConstraintKind, Coordinate, JointId, LoopClosure, Model};

use super::problem::Problem;
use super::rank;
use super::singular::dot;
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

/// How steady what is kept has to be where there is a choice. Of rows of unit length the least share was 0.7 and more in axes that go with the plane,
/// 0.01 and less in others, in all models that were looked at; as they are scaled here that was not measured.
pub(super) const STEADY: f64 = 0.5;

/// The least share of the volume that is kept over the greatest, in the axes of the analysis; one where nothing is left out of a way between points.
pub(super) fn steadiness(model: &Model, structure: &Structure) -> f64 {
    Writings::new(model, structure).own.map_or(1.0, |own| own.steadiness)
}

impl<'m> Writings<'m> {
    pub(in super::super) fn new(model: &'m Model, structure: &'m Structure) -> Self {
        let mut writings = Writings { model, structure, own: None };
        if writings.is_partial() {
            let (ranks, steadiness) = (writings.ranks_in(structure.writing), writings.steadiness_in(structure.writing));
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
                && self.steadiness_in(writing) >= STEADY.min(*steadiness)
                && are_determined(self.model, self.structure, writing))
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

    /// The least share of the volume that is kept over the greatest, in these axes.
    fn steadiness_in(&self, writing: Writing) -> f64 {
        let (kept, _) = self.systems().swap_remove(0);
        let is_of_kept = |row: &&Row| kept.iter().any(|one| one.closing == row.closing);
        let left_out: Vec<Row> = self.structure.dropped.iter().filter(is_of_kept).copied().collect();
        if left_out.is_empty() {
            return 1.0;
        }
        let problem = Problem::written(self.model, writing);
        let mut values = Values::default();
        let equations: Vec<usize> = kept.iter().chain(&left_out).filter_map(|row| problem.equation_of(*row)).collect();
        let count = kept.iter().filter(|row| problem.equation_of(**row).is_some()).count();
        let mut poses: Vec<Vec<Vec<f64>>> = Vec::with_capacity(self.structure.closed.len());
        for closed in &self.structure.closed {
            let at = problem.linearise(&problem.at(&closed.positions), &equations, &mut values);
            poses.push(at.rows.iter().map(|row| problem.dense_row(row)).collect());
        }
        // One scale for all poses: what vanishes at one of them counts for nothing there.
        for number in 0..equations.len() {
            let longest = poses.iter().map(|rows| dot(&rows[number], &rows[number]).sqrt()).fold(0.0, f64::max);
            let factor = if longest > 0.0 { 1.0 / longest } else { 0.0 };
            poses.iter_mut().for_each(|rows| rows[number].iter_mut().for_each(|x| *x *= factor));
        }
        // Without a closed configuration nothing is known.
        if poses.is_empty() {
            return 1.0;
        }
        let volumes: Vec<[f64; 2]> =
            poses.iter().map(|rows| [&rows[..count], rows].map(|rows| rank::greatest_volume(rows, count))).collect();
        // A singular pose has no volume to share.
        let regular = 1e-6 * volumes.iter().map(|one| one[1]).fold(0.0, f64::max);
        let shares = volumes.iter().filter(|one| one[1] > regular).map(|[kept, all]| kept / all);
        let (least, greatest) = shares.fold((f64::INFINITY, 0.0_f64), |(a, b), share| (a.min(share), b.max(share)));
        // What has no volume anywhere is no choice.
        if greatest > 0.0 { least / greatest } else { 0.0 }
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
