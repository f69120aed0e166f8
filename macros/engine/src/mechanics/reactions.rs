//! Stage `mechanics`: what joints transmit.
//!
//! In: the tree with its original inertias, accelerations, forces. Out: force and moment that the parent exerts on the
//! child at the joint's child frame, by the Newton-Euler recursion; the efforts of the joint itself are part of them.

use std::rc::Rc;

use crate::model::types::JointId;
use crate::symbolic::graph::Scalar;

use super::build::Place;
use super::equations::Equations;
use super::kinematics::motions;
use super::newton_euler::{Wrench, transmitted};
use super::values::Value;

impl Equations<'_> {
    /// In the axes of a frame.
    pub(super) fn reaction(&mut self, joint: JointId, axes: &Place) -> Value {
        let wrenches = self.wrenches();
        let link = self.mechanism.joints.get(joint.0).and_then(|joint| joint.child).and_then(|child| child.link);
        let Some(&wrench) = link.and_then(|index| wrenches.get(index)) else {
            return Value::Pair(crate::symbolic::graph::Vector::ZERO, crate::symbolic::graph::Vector::ZERO);
        };
        let [force, moment] = [wrench.force, wrench.moment].map(|v| {
            let v = self.between(link, axes.link, v);
            self.g.rotate(axes.rotation.transpose(), v)
        });
        Value::Pair(force, moment)
    }

    /// Of all joints, at the links' origins in their axes.
    fn wrenches(&mut self) -> Rc<[Wrench]> {
        if let Some(wrenches) = &self.transmitted {
            return Rc::clone(wrenches);
        }
        let mechanism = Rc::clone(&self.mechanism);
        let tree = &mechanism.tree;
        let user = self.accelerations();
        let mut acceleration = mechanism.sign(&user);
        acceleration.resize(tree.freedoms(), Scalar::ZERO);
        let loads = self.loads();
        let base = self.base();
        let motions = motions(&mut self.g, tree, &tree.velocity, &acceleration, base);
        let wrenches: Rc<[Wrench]> = transmitted(&mut self.g, tree, &motions, &loads.applied).into();
        self.transmitted = Some(Rc::clone(&wrenches));
        wrenches
    }
}
