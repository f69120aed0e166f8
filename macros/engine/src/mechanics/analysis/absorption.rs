//! Stage `mechanics`: which equations of loops some coordinates can absorb in every pose.
//!
//! In: a model with its structure, a writing. Out: whether rows of the Jacobian are independent in some coordinates alone,
//! wherever these stand ([`crate::dynamics::elimination`] asks).
//!
//! No number of poses shows that nothing vanishes between them. So only what doesn't depend on the pose counts: the volume that
//! rows span in some coordinates. A body that moves freely takes any point along, however it is turned: the volume is one.
//! An analytic function that is the same at random poses, and with random parameters, is constant. It need be so only where the
//! loops in question are closed, whatever becomes of others. What depends on one coordinate alone is seen whole, and so is a
//! product of functions of two, each of one coordinate; it is looked at where the user assumes something of these: a strut can
//! have the length zero, and a gimbal its axes in one line, unless `assume` says that it is longer and that they are not.
//! Where what is assumed does not hold, the rank tells (`dynamics::saddle`).
//!
//! Rows of several loops are taken apart: those that read a joint's coordinates are independent there, and the others in the
//! rest.

mod hope;
mod limb;

use std::collections::{BTreeMap, HashMap};

use crate::mechanics::loops::constraints::Writing;
use crate::mechanics::loops::structure::{Role, Structure};
use crate::model::types::{Coordinate, LoopClosure, Model};

use super::problem::{Point, Problem, Source};
use super::tape::Values;
use limb::{Along, Drawn, Limb, Loop};

pub use hope::Hope;

/// Poses in which loops are closed. They are the same in all axes in which the same coordinates are read.
#[derive(Default)]
pub(in super::super) struct Poses {
    random: HashMap<Loop, Drawn>,
    along: HashMap<(Loop, Vec<usize>), Along>,
}

/// Judges rows of one model in one writing.
pub(in super::super) struct Absorption<'p> {
    problem: Problem,
    /// Parameters that loops close for as declared only, by number and element.
    pinned: Vec<(usize, usize)>,
    /// By row its equation.
    equations: Vec<usize>,
    /// By coordinate of the state its column.
    columns: Vec<usize>,
    /// Columns of what is in the state, or follows time alone.
    own: Vec<bool>,
    /// The closed configuration that is nearest to where coordinates stand by default.
    first: Point,
    poses: &'p mut Poses,
    /// What was found of equations and columns, with nothing more assumed and with it.
    known: HashMap<(Vec<usize>, Vec<usize>, bool), bool>,
    values: Values,
    /// Where more may be assumed than is: how much of a volume has to be left then.
    hoping: Option<f64>,
    /// What would have to be assumed, by column.
    hopes: BTreeMap<usize, Hope>,
}

impl<'p> Absorption<'p> {
    /// Nothing where no closed configuration is known.
    pub(in super::super) fn new(
        model: &Model,
        structure: &Structure,
        writing: Writing,
        poses: &'p mut Poses,
    ) -> Option<Self> {
        let problem = Problem::written(model, writing);
        let equations: Option<Vec<usize>> = structure.rows.iter().map(|&row| problem.equation_of(row)).collect();
        let column = |coordinate| problem.columns.iter().position(|column| column.coordinate == coordinate);
        let columns: Option<Vec<usize>> = structure.state.iter().map(|&coordinate| column(coordinate)).collect();
        let (equations, columns) = (equations?, columns?);
        let own = problem.columns.iter().map(|column| !matches!(structure.role(column.coordinate), Role::Dependent(_)));
        let own = own.collect();
        let first = problem.at(&structure.closed.first()?.positions);
        let pinned = structure.pinned.clone();
        let (known, values, hoping, hopes) = Default::default();
        Some(Absorption { problem, pinned, equations, columns, own, first, poses, known, values, hoping, hopes })
    }

    /// The same where the user may assume more of single coordinates than is assumed, as long as so much of a volume is left.
    pub(in super::super) fn hoping(self, share: f64) -> Self {
        Absorption { hoping: Some(share), ..self }
    }

    /// What has to be assumed for all that was absorbed.
    pub(in super::super) fn hopes(self) -> Vec<(Coordinate, Hope)> {
        let Absorption { problem, hopes, .. } = self;
        hopes.into_iter().map(|(column, hope)| (problem.columns[column].coordinate, hope)).collect()
    }

    /// Whether a row, with others that are, is independent in some coordinates of the state, in all poses. So it is where more
    /// rows are: in axes that don't turn with a strut only the three components at its end together have a volume that says
    /// something. Proposals are looked for in the largest set first: what it asks for follows from the limb's own pose, whereas a
    /// single row would ask for angles at which it happens to stand well in fixed axes.
    pub(in super::super) fn absorbs(&mut self, row: usize, others: &[usize], coordinates: &[usize]) -> bool {
        let columns: Vec<usize> = coordinates.iter().map(|&k| self.columns[k]).collect();
        let others: Vec<usize> = others.iter().map(|&k| self.equations[k]).collect();
        let row = self.equations[row];
        let rows = |equation: usize| matches!(self.problem.equations[equation].source, Source::Row(_));
        let alike = |&other: &usize| other != row && rows(other) && self.closing(other) == self.closing(row);
        let siblings: Vec<usize> = self.equations.iter().copied().filter(alike).collect();
        let mut with: Vec<Vec<usize>> = vec![Vec::new()];
        with.extend(siblings.iter().map(|&sibling| vec![sibling]));
        with.extend((siblings.len() > 1).then_some(siblings));
        let mut sets: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        for mut more in with {
            more.extend(&others);
            more.sort_unstable();
            more.dedup();
            let set = self.concerned(row, &more, &columns);
            if !sets.contains(&set) {
                sets.push(set);
            }
        }
        let hoping = self.hoping.take();
        let absorbed = sets.iter().any(|(equations, columns)| self.independent(equations.clone(), columns.clone()));
        self.hoping = hoping;
        absorbed
            || hoping.is_some()
                && sets.into_iter().rev().any(|(equations, columns)| self.independent(equations, columns))
    }

    /// Whether equations are independent in some columns, both in order.
    fn independent(&mut self, equations: Vec<usize>, columns: Vec<usize>) -> bool {
        if equations.is_empty() {
            return true;
        }
        if equations.len() > columns.len() {
            return false;
        }
        let key = (equations, columns, self.hoping.is_some());
        if let Some(&known) = self.known.get(&key) {
            return known;
        }
        let found = self.apart(&key.0, &key.1) || self.together(&key.0, &key.1);
        self.known.insert(key, found);
        found
    }

    /// By the rows of one joint's coordinates, or of its travels or angles alone, and the others in the rest.
    fn apart(&mut self, equations: &[usize], columns: &[usize]) -> bool {
        let joint = |column: usize| self.problem.columns[column].coordinate.joint;
        let mut parts: Vec<Vec<usize>> = Vec::new();
        for &column in columns {
            let whole: Vec<usize> = columns.iter().copied().filter(|&other| joint(other) == joint(column)).collect();
            let travels = self.problem.columns[column].travels;
            let alike = |&other: &usize| self.problem.columns[other].travels == travels;
            let part: Vec<usize> = whole.iter().copied().filter(alike).collect();
            for part in [whole, part] {
                if part.len() < columns.len() && !parts.contains(&part) {
                    parts.push(part);
                }
            }
        }
        for own in parts {
            let reads = |&equation: &usize| self.reads(equation, &own);
            let (here, there): (Vec<usize>, Vec<usize>) = equations.iter().copied().partition(reads);
            let rest = columns.iter().copied().filter(|column| !own.contains(column)).collect();
            if !here.is_empty() && self.independent(here, own) {
                // What else is read there makes no difference: the others are independent in the rest, or not at all.
                return self.independent(there, rest);
            }
        }
        false
    }

    /// Rows of one loop, or of two at one joint, by their volume.
    fn together(&mut self, equations: &[usize], columns: &[usize]) -> bool {
        // What coordinates that follow do to a row is not known here, and a function in pieces is none that few poses show.
        let known = |&row: &usize| {
            self.problem.is_analytic(row) && self.problem.equations[row].columns.iter().all(|&k| self.own[k])
        };
        let mut closings: Vec<LoopClosure> = equations.iter().filter_map(|&row| self.closing(row)).collect();
        closings.dedup();
        let joint = |column: usize| self.problem.columns[column].coordinate.joint;
        let one = columns.iter().all(|&column| joint(column) == joint(columns[0]));
        if !equations.iter().all(known) || closings.len() > if one { 2 } else { 1 } {
            return false;
        }
        let of_these = |&k: &usize| self.closing(k).is_some_and(|closing| closings.contains(&closing));
        let loops: Vec<usize> = (0..self.problem.equations.len()).filter(of_these).collect();
        let Absorption { problem, pinned, first, poses, values, own, hoping, hopes, .. } = self;
        let limb = Limb::new(problem, pinned, &loops, equations, columns);
        let key = Loop { closings, moving: limb.moving.clone() };
        let drawn = poses.random.entry(key.clone()).or_insert_with(|| Drawn::new(first));
        limb.is_constant(drawn, values).unwrap_or_else(|| {
            let assumed = problem.assumed().into_iter().filter(|column| limb.moving.contains(column));
            let stays = sets(&assumed.collect::<Vec<_>>()).into_iter().any(|columns| {
                let new = || Along::new(columns.clone());
                let along = poses.along.entry((key.clone(), columns.clone())).or_insert_with(new);
                limb.stays(along, drawn, values)
            });
            let Some(share) = hoping.filter(|_| !stays) else { return stays };
            let single = limb.moving.iter().copied().filter(|&column| own[column] && !problem.columns[column].turns);
            let mut single: Vec<usize> = single.collect();
            // The fewer columns there is something to assume of, the better.
            single.sort_by_key(|column| !hopes.contains_key(column));
            sets(&single).into_iter().filter(|set| limb.may_hope_of(set)).any(|columns| {
                let new = || Along::new(columns.clone());
                let along = poses.along.entry((key.clone(), columns.clone())).or_insert_with(new);
                let depends = limb.depends(along, drawn, values);
                let Some(found) = depends.then(|| limb.hopes(&columns, first, share, values)).flatten() else {
                    return false;
                };
                for (column, hope) in found {
                    let hope = hopes.get(&column).map_or(hope, |known| known.and(hope));
                    hopes.insert(column, hope);
                }
                true
            })
        })
    }

    fn reads(&self, equation: usize, columns: &[usize]) -> bool {
        self.problem.equations[equation].columns.iter().any(|column| columns.contains(column))
    }

    fn closing(&self, equation: usize) -> Option<LoopClosure> {
        match self.problem.equations[equation].source {
            Source::Row(row) => Some(row.closing),
            Source::Formula(..) => None,
        }
    }

    /// An equation with others and columns that hang together with it, in order.
    fn concerned(&self, equation: usize, others: &[usize], columns: &[usize]) -> (Vec<usize>, Vec<usize>) {
        let (mut equations, mut near): (Vec<usize>, Vec<usize>) = (vec![equation], Vec::new());
        let mut next = 0;
        while let Some(&equation) = equations.get(next) {
            next += 1;
            for &column in columns.iter().filter(|&&column| self.reads(equation, &[column])) {
                if !near.contains(&column) {
                    near.push(column);
                    let new = others.iter().filter(|&&other| self.reads(other, &[column]));
                    let new: Vec<usize> = new.copied().filter(|other| !equations.contains(other)).collect();
                    equations.extend(new);
                }
            }
        }
        equations.sort_unstable();
        near.sort_unstable();
        (equations, near)
    }
}

/// Columns by themselves, then each with one of the others.
fn sets(columns: &[usize]) -> Vec<Vec<usize>> {
    let pair = |k: usize| columns[k + 1..].iter().map(move |&other| vec![columns[k], other]);
    columns.iter().map(|&column| vec![column]).chain((0..columns.len()).flat_map(pair)).collect()
}
