//! Stage `model`: branch ends without mass.
//!
//! In: bodies, joints, the tree. Out: an error per joint beyond which nothing has mass or inertia at the declared
//! defaults: its coordinate's equation would have no acceleration in it.

use super::checker::Checker;
use super::types::{Body, BodyRef, Joint, JointId};

impl Checker<'_, '_> {
    /// Whether every joint that moves has something to move.
    pub(super) fn check_massless(&mut self, bodies: &[Body], joints: &[Joint], tree: &[JointId]) -> bool {
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
            let wrong = light && joint.kind.freedoms() > 0 && !driven;
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
