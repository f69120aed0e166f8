//! Stage `model`: branch ends without mass.
//!
//! In: bodies, joints, the tree. Out: an error per joint beyond which nothing has mass or inertia at the declared
//! defaults: its coordinate's equation would have no acceleration in it.

use crate::invariant::fault::raise;
use crate::invariant::index_vec::IndexVec;
use crate::model::changing::each_node;
use crate::model::checker::Checker;
use crate::model::topology::Topology;
use crate::model::types::{
    Bodies, BodyId, BodyRef, Constraint, ConstraintKind, Drive, ExprNode, Joint, JointId, Joints,
};

impl Checker<'_, '_> {
    /// Bodies beyond which a loop closes, a constraint holds or a drive moves something. The coordinates up to there obey
    /// more than the equations of motion, so a mass matrix that is singular in them may be well: what is said of the
    /// others stays true, since a motion in which nothing but bodies beyond a joint takes part is not hindered by what
    /// happens elsewhere. An expression that is held at zero holds what it reads.
    pub(in crate::model) fn held(
        &self,
        bodies: &Bodies,
        joints: &Joints,
        topology: &Topology,
        constraints: &[Constraint],
        drives: &[Drive],
    ) -> IndexVec<BodyId, bool> {
        let mut held: IndexVec<BodyId, bool> = bodies.iter().map(|_| false).collect();
        let mut hold = |body: BodyRef| {
            if let BodyRef::Body(id) = body {
                held[id] = true;
            }
        };
        for joint in topology.cuts.iter().map(|id| &joints[*id]) {
            hold(joint.parent.body);
            hold(joint.child.body);
        }
        for constraint in constraints {
            match &constraint.kind {
                ConstraintKind::Rod { between, .. } => between.iter().for_each(|frame| hold(frame.body)),
                ConstraintKind::Value(value) | ConstraintKind::Rate(value) => {
                    let mut all = false;
                    each_node([value], &mut |expr| match &*expr.node {
                        ExprNode::Coordinate { joint, .. } | ExprNode::RelativeAngularVelocity(joint) => {
                            hold(joints[*joint].parent.body);
                            hold(joints[*joint].child.body);
                        }
                        ExprNode::OfFrame(frame, _)
                        | ExprNode::Express { frame, .. }
                        | ExprNode::Jacobian { frame, .. } => {
                            hold(frame.body);
                        }
                        ExprNode::OfBodies(Some(list), _) => list.iter().for_each(|id| hold(BodyRef::Body(*id))),
                        ExprNode::OfBodies(None, _) => all = true,
                        _ => {}
                    });
                    if all {
                        return bodies.iter().map(|_| true).collect();
                    }
                }
            }
        }
        let driven = drives.iter().flat_map(|drive| self.driven(drive.target));
        for coordinate in driven {
            hold(joints[coordinate.joint].child.body);
        }
        for joint in topology.tree.iter().rev().map(|id| &joints[*id]) {
            if let (BodyRef::Body(child), BodyRef::Body(parent)) = (joint.child.body, joint.parent.body)
                && held[child]
            {
                held[parent] = true;
            }
        }
        held
    }

    /// Whether every joint that moves has something to move.
    pub(in crate::model) fn check_massless(
        &mut self,
        bodies: &Bodies,
        joints: &Joints,
        tree: &[JointId],
        held: &IndexVec<BodyId, bool>,
    ) -> bool {
        let mut heavy: IndexVec<BodyId, bool> = bodies
            .iter()
            .map(|body| {
                let mut values = vec![&body.mass];
                values.extend(body.inertia.iter().flat_map(|tensor| tensor.iter()));
                let mut values = values.into_iter();
                values.any(|value| self.evaluator.scalar(value) != Some(0.0))
            })
            .collect();
        for id in tree.iter().rev() {
            let joint = &joints[*id];
            if let (BodyRef::Body(child), BodyRef::Body(parent)) = (joint.child.body, joint.parent.body) {
                heavy[parent] |= heavy[child];
            }
        }
        let mut sound = true;
        // Bodies beyond a joint that has been reported.
        let mut told: IndexVec<BodyId, bool> = bodies.iter().map(|_| false).collect();
        for id in tree {
            let joint = &joints[*id];
            let child = carried(joint);
            let inherited = matches!(joint.parent.body, BodyRef::Body(parent) if told[parent]);
            let armature = joint.armature.as_ref();
            let driven = armature.is_some_and(|a| self.evaluator.scalar(a) != Some(0.0));
            let wrong = !heavy[child] && joint.kind.freedoms() > 0 && !driven && !held[child];
            told[child] = inherited || wrong;
            if wrong && !inherited {
                sound = false;
                let (name, body) = (&joint.place.field, &bodies[child].place.field);
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

/// The body that a joint of the tree carries.
pub(super) fn carried(joint: &Joint) -> BodyId {
    match joint.child.body {
        BodyRef::Body(body) => body,
        BodyRef::Ground => raise("no joint of the tree carries the ground"),
    }
}
