//! Stage `mechanics`: what is refused once the equations are known.
//!
//! In: groups of equations with what was found about them. Out: complaints about loops that cannot close or cannot move,
//! formulas that don't close their loop, drives of what follows from the rest, quaternions that would have to be split.

use std::collections::{BTreeMap, BTreeSet};

use crate::mechanics::loops::constraints::{coordinate_name, path, row_name};
use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::site::{Site, Sited};
use crate::model::types::{Constraint, JointId, LoopClosure, Model};

use super::configurations::{Effort, Found, configurations};
use super::measure::Gap;
use super::problem::Problem;
use super::{Analysis, Complaint, CoupledRows, Looked, columns_of, driven_by, formula_of, rank, row_of};
impl Analysis<'_> {
    /// Equations without coordinates: they hold, or nothing can make them.
    pub(super) fn constants(&mut self, problem: &Problem, structure: &mut Structure) {
        let mut blamed: BTreeMap<LoopClosure, Gap> = BTreeMap::new();
        let mut rounding = Vec::new();
        for (k, gap) in problem.constants() {
            let Some(row) = row_of(problem, k) else { continue };
            let adjustable = problem.equations[k].adjustable;
            if gap.is_open(problem.size) && !adjustable {
                blamed.entry(row.closing).or_default().widen(&gap);
                continue;
            }
            structure.dropped.push(row);
            if problem.equations[k].constant {
                rounding.push(format!("`{}`", row_name(self.model, row.closing, row.index)));
            }
            if adjustable {
                structure.granted.push(row);
                structure.pinned.extend(problem.parameters_of(&[k]).into_iter().map(|one| one.1));
                let name = row_name(self.model, row.closing, row.index);
                structure.notes.push(format!("`{name}` depends on parameters alone: it must hold by their choice"));
            }
        }
        if !rounding.is_empty() {
            let names = rounding.join(", ");
            structure.notes.push(format!("constant but for rounding, and hold everywhere: {names}"));
        }
        for closing in problem.reversed() {
            blamed.entry(closing).or_default();
        }
        for (closing, gap) in blamed {
            self.complain_open(closing, &gap, problem.size);
        }
    }

    fn complain_open(&mut self, closing: LoopClosure, gap: &Gap, size: f64) {
        let (at, what) = self.thing(closing);
        let message = format!("{what} cannot close: {}", gap.text(size));
        self.complain(at, message, Some("check lengths, frames and axes"));
    }

    /// Closed configurations of a group; nothing if it cannot be closed.
    pub(super) fn close(&mut self, problem: &Problem, group: &CoupledRows, structure: &mut Structure) -> Option<Found> {
        let effort = Effort::of(group.equations.len());
        let found = configurations(problem, &group.equations, &group.columns, effort);
        if found.configurations.iter().any(|configuration| configuration.closed) {
            return Some(found);
        }
        // A narrow way to the closed loop is missed by most starts.
        let harder = configurations(problem, &group.equations, &group.columns, Effort::patient(group.equations.len()));
        if harder.configurations.iter().any(|configuration| configuration.closed) {
            return Some(harder);
        }
        let without: Vec<usize> =
            group.equations.iter().copied().filter(|&k| formula_of(problem, k).is_none()).collect();
        if without.len() < group.equations.len() {
            let alone = configurations(problem, &without, &columns_of(problem, &without), effort);
            if alone.configurations.iter().any(|configuration| configuration.closed) {
                self.complain_formulas(problem, group);
                return None;
            }
        }
        let mut closings: Vec<LoopClosure> =
            group.equations.iter().filter_map(|&k| row_of(problem, k)).map(|row| row.closing).collect();
        closings.sort_unstable();
        closings.dedup();
        let mut blamed = None;
        if closings.len() > 1 {
            for &closing in &closings {
                let own = |&k: &usize| row_of(problem, k).is_some_and(|row| row.closing == closing);
                let equations: Vec<usize> = group.equations.iter().copied().filter(own).collect();
                let columns = columns_of(problem, &equations);
                let closes = |effort: Effort| {
                    let alone = configurations(problem, &equations, &columns, effort);
                    let closed = alone.configurations.iter().any(|configuration| configuration.closed);
                    (closed, alone)
                };
                let (mut closed, mut alone) = closes(Effort::ONE);
                if !closed {
                    (closed, alone) = closes(Effort::patient(equations.len()));
                }
                if !closed {
                    blamed = Some((closing, equations, alone.gap));
                    break;
                }
            }
        }
        let sure = blamed.is_some() || group.equations.len() <= 16;
        let last = closings.last().copied();
        let (closing, equations, gap) =
            blamed.or_else(|| last.map(|closing| (closing, group.equations.clone(), found.gap)))?;
        let (_, what) = self.thing(closing);
        let adjustable = equations.iter().any(|&k| problem.equations[k].adjustable);
        if sure && !adjustable {
            self.complain_open(closing, &gap, problem.size);
            return None;
        }
        let gap = gap.text(problem.size);
        structure.notes.push(format!("{what} did not close at the declared values, and its rank is not known: {gap}"));
        Some(found)
    }

    /// Formulas that the equations don't imply, or contradict.
    pub(super) fn complain_formulas(&mut self, problem: &Problem, group: &CoupledRows) {
        let model = self.model;
        let mut numbers: Vec<usize> = group.equations.iter().filter_map(|&k| formula_of(problem, k)).collect();
        numbers.dedup();
        for solve in numbers.into_iter().filter_map(|number| model.solves.get(number)) {
            let names: Vec<String> =
                solve.unknowns.iter().map(|&unknown| format!("`{}`", coordinate_name(model, unknown))).collect();
            let message = format!("the formulas of {} do not close their loop", names.join(", "));
            self.complain(
                solve.site(),
                message,
                Some("check signs and branches, or let the macro solve: `from` a joint"),
            );
        }
    }

    /// Reduced, equations that were left out would never be looked at again.
    pub(super) fn complain_elusive(&mut self, problem: &Problem, group: &CoupledRows, evidence: &str) {
        let closing = group.equations.iter().filter_map(|&k| row_of(problem, k)).map(|row| row.closing).min();
        let Some(closing) = closing else { return };
        let (at, what) = self.thing(closing);
        let message = format!("{what} can't be reduced: how many of its equations count is not known ({evidence})");
        self.complain(at, message, Some("take `constraints: Multipliers`, which need not know"));
    }

    pub(super) fn complain_locked(&mut self, problem: &Problem, group: &CoupledRows, closed: bool) {
        let mut joints: Vec<JointId> =
            group.columns.iter().map(|&column| problem.columns[column].coordinate.joint).collect();
        joints.dedup();
        let names: Vec<String> = joints.iter().take(8).map(|joint| self.joint_name(*joint)).collect();
        let closing = group.equations.iter().filter_map(|&k| row_of(problem, k)).map(|row| row.closing).min();
        let Some(closing) = closing else { return };
        let (at, what) = self.thing(closing);
        let names = names.join(", ");
        if closed {
            let message = format!("{what} leaves no freedom: nothing can move among {names}");
            self.complain(at, message, Some("remove a constraint, or give a joint of the loop more freedom"));
        } else {
            // The rank of a loop that is open says nothing about the closed one.
            let message = format!("{what} can't be reduced: with the declared defaults it does not close ({names})");
            self.complain(at, message, Some("declare defaults with which it closes"));
        }
    }

    /// Whether drives leave the rank alone: what they prescribe must not follow from the rest.
    pub(super) fn check_drives(
        &mut self,
        problem: &Problem,
        group: &CoupledRows,
        jacobians: &[&[Vec<f64>]],
        independent: &[usize],
    ) -> bool {
        let mut free = vec![true; group.columns.len()];
        for (number, drive) in self.model.drives.iter().enumerate() {
            let before = free.clone();
            for (slot, &column) in free.iter_mut().zip(&group.columns) {
                *slot &= self.driven.get(&problem.columns[column].coordinate) != Some(&number);
            }
            if free != before && rank::rank(jacobians, independent, &free) < independent.len() {
                let names: Vec<String> = driven_by(self.model, drive.target)
                    .into_iter()
                    .map(|coordinate| format!("`{}`", coordinate_name(self.model, coordinate)))
                    .collect();
                self.complain_needless_drive(drive.site(), &names.join(", "));
                return false;
            }
        }
        true
    }

    /// The same of drives of measured coordinates, which are equations beside those of the loops: two that say the same would share an effort.
    pub(super) fn check_held_drives(&mut self, structure: &Structure) {
        let mut needless: Vec<&Constraint> = Vec::new();
        for row in structure.dropped.iter().chain(&structure.wavering) {
            let LoopClosure::Constraint(id) = row.closing else { continue };
            let constraint = &self.model.constraints[id];
            if constraint.drive.is_some() && !needless.iter().any(|other| other.drive == constraint.drive) {
                needless.push(constraint);
            }
        }
        for constraint in needless {
            let Some(coordinate) = constraint.drive else { continue };
            self.complain_needless_drive(constraint.site(), &format!("`{}`", coordinate_name(self.model, coordinate)));
        }
    }

    fn complain_needless_drive(&mut self, at: Site, names: &str) {
        let message = format!("the drive prescribes what follows from the loops and other drives: {names}");
        self.complain(at, message, Some("drive as many coordinates as the mechanism has freedoms"));
    }

    /// Position and orientation of a joint with a quaternion are in the state as a whole or not at all.
    pub(super) fn check_quaternions(&mut self, structure: &Structure) {
        let model = self.model;
        for (joint, roles) in model.joints.iter().zip(&structure.roles) {
            if !has_quaternion(joint) || roles.len() < 3 {
                continue;
            }
            let (position, orientation) = roles.split_at(roles.len() - 3);
            let states = |part: &[Role]| part.iter().filter(|&&role| role == Role::State).count();
            let split = |part: &[Role]| states(part) != 0 && states(part) != part.len();
            if split(orientation) || (split(position) && states(orientation) > 0) {
                let name = path(model, &joint.place);
                let message = format!("a part of `{name}` leaves the state, and its orientation is a quaternion");
                self.complain(
                    joint.site(),
                    message,
                    Some("write `coordinates: RollPitchYaw` at the joint or the body"),
                );
            }
        }
    }

    fn joint_name(&self, joint: JointId) -> String {
        let joint = self.model.joints.get(joint.0);
        joint.map_or_else(String::new, |joint| format!("`{}`", path(self.model, &joint.place)))
    }

    /// Where a closing was written, and how to speak of it.
    fn thing(&self, closing: LoopClosure) -> (Site, String) {
        thing(self.model, closing)
    }
}

/// Groups of what can't move at all. Equations of one closing may fall into several groups, some of which fix all their
/// coordinates: a body in absolute coordinates on a hinge stays at its place and turns. So what hangs together is taken
/// together: groups that share a closing or a joint, with all coordinates of these joints. What time prescribes moves.
/// Multipliers go with branches of any rank, so what moves on one of them is not locked; a reduced model has that of the
/// greatest.
pub(super) fn locked(problem: &Problem, looked: &[Looked], reduced: bool) -> Vec<usize> {
    let mut root: Vec<usize> = (0..looked.len()).collect();
    let (mut by_closing, mut by_joint) = (BTreeMap::new(), BTreeMap::new());
    for (number, one) in looked.iter().enumerate() {
        let closings = one.group.equations.iter().filter_map(|&k| row_of(problem, k)).map(|row| row.closing);
        let mut others: Vec<usize> = closings.map(|closing| *by_closing.entry(closing).or_insert(number)).collect();
        for joint in joints(problem, one) {
            others.push(*by_joint.entry(joint).or_insert(number));
        }
        for other in others {
            let (a, b) = (super::find(&mut root, other), super::find(&mut root, number));
            root[a.max(b)] = a.min(b);
        }
    }
    // By component: its joints, and the freedoms that equations take.
    let mut parts: BTreeMap<usize, (BTreeSet<JointId>, usize, bool)> = BTreeMap::new();
    for (number, one) in looked.iter().enumerate() {
        let part = parts.entry(super::find(&mut root, number)).or_default();
        part.0.extend(joints(problem, one));
        part.1 += if reduced { one.ranked.rank } else { one.ranked.least };
        part.2 |= one.group.equations.iter().any(|&k| problem.equations[k].timed);
    }
    let mut is_locked = |number: &usize| {
        parts.get(&super::find(&mut root, *number)).is_some_and(|(joints, rank, timed)| {
            !timed && *rank >= problem.columns.iter().filter(|column| joints.contains(&column.coordinate.joint)).count()
        })
    };
    (0..looked.len()).filter(|number| is_locked(number)).collect()
}

fn joints(problem: &Problem, looked: &Looked) -> Vec<JointId> {
    looked.group.columns.iter().map(|&column| problem.columns[column].coordinate.joint).collect()
}

/// Loops whose equations can't be reduced to the same ones at all poses.
pub(super) fn unsteady(model: &Model, needed: &[Row]) -> Vec<Complaint> {
    let mut closings: Vec<LoopClosure> = needed.iter().map(|row| row.closing).collect();
    closings.sort_unstable();
    closings.dedup();
    let complaint = |closing: LoopClosure| {
        let (at, what) = thing(model, closing);
        let names = needed.iter().filter(|row| row.closing == closing);
        let names: Vec<String> = names.map(|row| format!("`{}`", row_name(model, row.closing, row.index))).collect();
        let message = format!(
            "{what} can't be reduced: which of its equations follow from the others changes with the pose ({})",
            names.join(", ")
        );
        let help = "take `constraints: Multipliers`, which keeps all of them";
        Complaint { at, message, help: Some(help.to_owned()) }
    };
    closings.into_iter().map(complaint).collect()
}

pub(super) fn thing(model: &Model, closing: LoopClosure) -> (Site, String) {
    match closing {
        LoopClosure::Cut(id) => {
            let joint = &model.joints[id];
            (joint.site(), format!("the loop that `{}` closes", path(model, &joint.place)))
        }
        LoopClosure::Constraint(id) => {
            let constraint = &model.constraints[id];
            (constraint.site(), format!("the constraint `{}`", path(model, &constraint.place)))
        }
    }
}
