//! Stage `mechanics`: a joint as a chain of primitive motions with massless links between.
//!
//! In: a joint. Out: its links, one for each freedom of its kind from the parent to the child, then a ball where it turns in
//! all directions. Velocity coordinates keep the order of the language whatever the order of links. Where one axis is
//! written the directions that follow it are coordinate axes k + 1 and k + 2 in cyclic order, whatever its sign, or what
//! these become when any other axis is turned into place (see [`directions::axis`]).

use crate::dynamics::inertia::Inertia;
use crate::dynamics::tree::{Link, Motion, Orientation};
use crate::invariant::injection::{Break, broken};
use crate::mechanics::equations::Equations;
use crate::model::joint_kinds;
use crate::model::types::{Directions, Expr, Joint, JointId};
use crate::symbolic::graph::{Graph, Scalar, Vector};
use crate::symbolic::rotations;

use super::build::{FixedFrame, Mechanism};
use super::directions;
use super::directions::Axis;
use super::symbols::Symbols;

/// The joint under construction.
pub(in crate::mechanics) struct Chain<'a> {
    mechanism: &'a mut Mechanism,
    /// The joint's frame as it leaves the last link so far.
    pub end: FixedFrame,
    name: String,
}

/// A primitive motion along or about an axis.
struct Step {
    axis: Axis,
    motion: Motion,
    freedom: usize,
    q: Scalar,
}

impl<'a> Chain<'a> {
    pub(in crate::mechanics) fn new(mechanism: &'a mut Mechanism, start: FixedFrame, name: String) -> Self {
        Chain { mechanism, end: start, name }
    }

    /// Appends a link. `suffix` names it unless it is the joint's last.
    fn push(&mut self, g: &mut Graph, suffix: &str, step: &Step) {
        let name = if suffix.is_empty() { self.name.clone() } else { format!("{}_{suffix}", self.name) };
        if let Some(flipped) = self.mechanism.flipped.get_mut(step.freedom) {
            *flipped = step.axis.flipped;
        }
        let links = &mut self.mechanism.tree.links;
        let index = links.len();
        links.push(Link {
            name,
            parent: self.end.link,
            rotation: rotations::compose(g, self.end.rotation, step.axis.turn),
            offset: self.end.offset,
            motion: step.motion,
            freedom: step.freedom,
            q: if step.axis.flipped { -step.q } else { step.q },
            inertia: Inertia::ZERO,
            armature: Scalar::ZERO,
        });
        self.end = FixedFrame { link: Some(index), rotation: step.axis.turn.transpose(), offset: Vector::ZERO };
    }
}

impl Equations<'_> {
    /// Appends the links of a joint.
    pub(in crate::mechanics) fn append(&mut self, chain: &mut Chain<'_>, id: JointId, joint: &Joint, kept: bool) {
        let q = Symbols::of(&self.scene.symbols.positions, id).to_vec();
        let q = |k: usize| q[k];
        let first = self.scene.symbols.first[id.0];
        let kind = joint.kind;
        if kind.freedoms() == 0 && kept {
            let tree = &mut chain.mechanism.tree;
            let freedom = tree.velocity.len();
            tree.velocity.push(Scalar::ZERO);
            tree.acceleration.push(Scalar::ZERO);
            let axis = Axis::coordinate(0);
            let motion = Motion::Prismatic(axis.index);
            chain.push(&mut self.g, "", &Step { axis, motion, freedom, q: Scalar::ZERO });
        }
        let axes = self.joint_axes(joint);
        let sequence = kind.sequence();
        let last = sequence.last().copied().filter(|_| !kind.has_quaternion());
        for index in sequence {
            let (axis, motion) = self.freedom_motion(joint, &axes, index);
            let suffix = if last == Some(index) { "" } else { kind.freedoms[index].name };
            chain.push(&mut self.g, suffix, &Step { axis, motion, freedom: first + index, q: q(index) });
        }
        if kind.has_quaternion() {
            let start = kind.turning().start;
            let motion = Motion::Ball(Orientation::Quaternion([0, 1, 2, 3].map(|k| q(start + k))));
            let axis = Axis::coordinate(0);
            chain.push(&mut self.g, "", &Step { axis, motion, freedom: first + start, q: Scalar::ZERO });
        }
    }

    /// The primitive motion of a freedom, and the axis along or about which it goes.
    pub(in crate::mechanics) fn freedom_motion(
        &mut self,
        joint: &Joint,
        axes: &[Axis; 3],
        index: usize,
    ) -> (Axis, Motion) {
        let freedom = &joint.kind.freedoms[index];
        let axis = axes[freedom.direction % 3];
        let motion = match (freedom.motion, &joint.pitch) {
            (joint_kinds::Motion::Slides, _) => Motion::Prismatic(axis.index),
            (joint_kinds::Motion::Turns, None) => Motion::Revolute(axis.index),
            (joint_kinds::Motion::Turns, Some(pitch)) => {
                let pitch = self.scalar(pitch);
                Motion::Screw(axis.index, if broken(Break::Pitch) { -pitch } else { pitch })
            }
        };
        (axis, motion)
    }

    /// The directions of a joint's freedoms, in its parent's frame.
    pub(in crate::mechanics) fn joint_axes(&mut self, joint: &Joint) -> [Axis; 3] {
        match &joint.directions {
            Directions::Frame => [0, 1, 2].map(Axis::coordinate),
            Directions::Axis(axis) => {
                let axis = self.axis(axis);
                [axis, axis.next(1), axis.next(2)]
            }
            Directions::Crossed(axes) => {
                let [first, second] = axes.each_ref().map(|axis| self.axis(axis));
                [first, second, first.next(2)]
            }
            Directions::Plane(axes) => {
                let [x, y, normal] = self.frame_of(axes);
                [normal, x, y]
            }
            Directions::Slot(axes) => self.frame_of(axes),
        }
    }

    /// Two perpendicular directions and their normal.
    fn frame_of(&mut self, axes: &[Expr; 2]) -> [Axis; 3] {
        let [first, second] = axes.each_ref().map(|axis| {
            let axis = self.vector(axis);
            self.g.components(axis)
        });
        directions::frame(&mut self.g, first, second)
    }

    /// The axis that an expression means.
    pub(in crate::mechanics) fn axis(&mut self, axis: &Expr) -> Axis {
        let direction = self.vector(axis);
        let direction = self.g.components(direction);
        directions::axis(&mut self.g, direction)
    }
}
