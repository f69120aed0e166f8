//! Stage `model`: branch ends without mass.
//!
//! In: bodies, joints, the tree. Out: an error per joint beyond which nothing has mass or inertia at the declared
//! defaults: its coordinate's equation would have no acceleration in it.

use crate::model::checker::Checker;
use crate::model::topology::Topology;
use crate::model::types::{Body, BodyRef, Constraint, ConstraintKind, Drive, Joint, JointId};

impl Checker<'_, '_> {
    /// Bodies beyond which a loop closes, a constraint holds or a drive moves something. The coordinates up to there obey
    /// more than the equations of motion, so a mass matrix that is singular in them may be well: what is said of the
    /// others stays true, since a motion in which nothing but bodies beyond a joint takes part is not hindered by what
    /// happens elsewhere. An expression that is held at zero may hold anything.
    pub(in crate::model) fn held(
        &self,
        bodies: usize,
        joints: &[Joint],
        topology: &Topology,
        constraints: &[Constraint],
        drives: &[Drive],
    ) -> Vec<bool> {
        let mut held = vec![false; bodies];
        let mut hold = |body: BodyRef| {
            if let BodyRef::Body(id) = body
                && let Some(slot) = held.get_mut(id.0)
            {
                *slot = true;
            }
        };
        for joint in topology.cuts.iter().filter_map(|id| joints.get(id.0)) {
            hold(joint.parent.body);
            hold(joint.child.body);
        }
        for constraint in constraints {
            match &constraint.kind {
                ConstraintKind::Rod { between, .. } => between.iter().for_each(|frame| hold(frame.body)),
                ConstraintKind::Value(_) => return vec![true; bodies],
            }
        }
        let driven = drives.iter().flat_map(|drive| self.driven(drive.target));
        for joint in driven.filter_map(|coordinate| joints.get(coordinate.joint.0)) {
            hold(joint.child.body);
        }
        for joint in topology.tree.iter().rev().filter_map(|id| joints.get(id.0)) {
            if let (BodyRef::Body(child), BodyRef::Body(parent)) = (joint.child.body, joint.parent.body)
                && held.get(child.0) == Some(&true)
                && let Some(slot) = held.get_mut(parent.0)
            {
                *slot = true;
            }
        }
        held
    }

    /// Whether every joint that moves has something to move.
    pub(in crate::model) fn check_massless(
        &mut self,
        bodies: &[Body],
        joints: &[Joint],
        tree: &[JointId],
        held: &[bool],
    ) -> bool {
        let mut heavy: Vec<bool> = bodies
            .iter()
            .map(|body| {
                let mut values = vec![&body.mass];
                values.extend(body.inertia.iter().flat_map(|tensor| tensor.iter()));
                let mut values = values.into_iter();
                values.any(|value| self.evaluator.scalar(value) != Some(0.0))
            })
            .collect();
        let at = |body| match body {
            BodyRef::Body(id) => Some(id),
            BodyRef::Ground => None,
        };
        for id in tree.iter().rev() {
            let Some(joint) = joints.get(id.0) else {
                continue;
            };
            let child = at(joint.child.body).and_then(|id| heavy.get(id.0).copied());
            if child == Some(true)
                && let Some(parent) = at(joint.parent.body).and_then(|id| heavy.get_mut(id.0))
            {
                *parent = true;
            }
        }
        let mut sound = true;
        // Bodies beyond a joint that has been reported.
        let mut told = vec![false; bodies.len()];
        for id in tree {
            let Some(joint) = joints.get(id.0) else {
                continue;
            };
            let Some(child) = at(joint.child.body) else {
                continue;
            };
            let above = at(joint.parent.body).and_then(|id| told.get(id.0).copied());
            let inherited = above == Some(true);
            let light = heavy.get(child.0) == Some(&false);
            let armature = joint.armature.as_ref();
            let driven = armature.is_some_and(|a| self.evaluator.scalar(a) != Some(0.0));
            let wrong = light && joint.kind.freedoms() > 0 && !driven && held.get(child.0) != Some(&true);
            if let Some(told) = told.get_mut(child.0) {
                *told = inherited || wrong;
            }
            if wrong && !inherited {
                sound = false;
                let (name, body) = (&joint.place.field, bodies.get(child.0));
                let body = body.map_or_else(String::new, |b| b.place.field.to_string());
                self.report.help(
                    joint.span,
                    format!("nothing beyond the joint `{name}` has mass or inertia"),
                    format!("give `{body}` a mass, or fix it"),
                );
            }
        }
        sound
    }
}
