//! Stage `mechanics`: a joint as a chain of primitive motions with massless links between.
//!
//! In: a joint's kind. Out: its links. Universal is two revolute motions, Cylindrical a prismatic and a revolute one,
//! Planar two prismatic and a revolute one, roll-pitch-yaw is Rz(yaw) Ry(pitch) Rx(roll), Free is three prismatic motions
//! along the parent's axes and a ball. Velocity coordinates keep the order of the language whatever the order of links.
//!
//! Planar about coordinate axis k moves along the axes k + 1 and k + 2 in cyclic order, whatever the sign of the axis;
//! about any other axis along what these become when the axis is turned into place (see [`constants::axis`]).

use crate::dynamics::inertia::Inertia;
use crate::dynamics::tree::{Link, Motion};
use crate::mechanics::equations::Equations;
use crate::model::types::{Expr, Joint, JointId, JointKind, Orientation};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::build::{Mechanism, Place};
use super::directions;
use super::directions::Axis;
use super::symbols::Symbols;

/// The joint under construction.
pub(in crate::mechanics) struct Chain<'a> {
    mechanism: &'a mut Mechanism,
    /// The joint's frame as it leaves the last link so far.
    pub end: Place,
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
    pub(in crate::mechanics) fn new(mechanism: &'a mut Mechanism, start: Place, name: String) -> Self {
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
        self.end = Place { link: Some(index), rotation: step.axis.turn.transpose(), offset: Vector::ZERO };
    }

    fn revolute(&mut self, g: &mut Graph, suffix: &str, axis: Axis, freedom: usize, q: Scalar) {
        self.push(g, suffix, &Step { axis, motion: Motion::Revolute(axis.index), freedom, q });
    }

    fn prismatic(&mut self, g: &mut Graph, suffix: &str, axis: Axis, freedom: usize, q: Scalar) {
        self.push(g, suffix, &Step { axis, motion: Motion::Prismatic(axis.index), freedom, q });
    }
}

/// A coordinate axis.
fn coordinate(index: usize) -> Axis {
    Axis { turn: Rotation::IDENTITY, index, flipped: false }
}

impl Equations<'_> {
    /// Appends the links of a joint.
    pub(in crate::mechanics) fn append(&mut self, chain: &mut Chain<'_>, id: JointId, joint: &Joint, kept: bool) {
        let q = Symbols::of(&self.symbols.positions, id).to_vec();
        let q = |k: usize| q.get(k).copied().unwrap_or(Scalar::ZERO);
        let first = self.symbols.first.get(id.0).copied().unwrap_or(0);
        match &joint.kind {
            JointKind::Fixed if kept => {
                let tree = &mut chain.mechanism.tree;
                let freedom = tree.velocity.len();
                tree.velocity.push(Scalar::ZERO);
                tree.acceleration.push(Scalar::ZERO);
                chain.prismatic(&mut self.g, "", coordinate(0), freedom, Scalar::ZERO);
            }
            JointKind::Fixed => {}
            JointKind::Revolute { axis } => {
                let axis = self.axis(axis);
                chain.revolute(&mut self.g, "", axis, first, q(0));
            }
            JointKind::Prismatic { axis } => {
                let axis = self.axis(axis);
                chain.prismatic(&mut self.g, "", axis, first, q(0));
            }
            JointKind::Screw { axis, pitch } => {
                let axis = self.axis(axis);
                let pitch = self.scalar(pitch);
                let motion = Motion::Screw(axis.index, pitch);
                chain.push(&mut self.g, "", &Step { axis, motion, freedom: first, q: q(0) });
            }
            JointKind::Cylindrical { axis } => {
                let axis = self.axis(axis);
                chain.prismatic(&mut self.g, "travel", axis, first, q(0));
                chain.revolute(&mut self.g, "", axis, first + 1, q(1));
            }
            JointKind::Universal { axes } => {
                let [one, two] = [self.axis(&axes[0]), self.axis(&axes[1])];
                chain.revolute(&mut self.g, "first", one, first, q(0));
                chain.revolute(&mut self.g, "", two, first + 1, q(1));
            }
            JointKind::Planar { axis } => {
                let axis = self.axis(axis);
                let along = |k: usize| Axis { index: (axis.index + k) % 3, flipped: false, ..axis };
                chain.prismatic(&mut self.g, "x", along(1), first, q(0));
                chain.prismatic(&mut self.g, "y", along(2), first + 1, q(1));
                chain.revolute(&mut self.g, "", axis, first + 2, q(2));
            }
            JointKind::Ball(orientation) => self.ball(chain, *orientation, first, q),
            JointKind::Free(orientation) => {
                for (k, suffix) in ["x", "y", "z"].into_iter().enumerate() {
                    chain.prismatic(&mut self.g, suffix, coordinate(k), first + k, q(k));
                }
                self.ball(chain, *orientation, first + 3, |k| q(k + 3));
            }
        }
    }

    fn ball(&mut self, chain: &mut Chain<'_>, orientation: Orientation, first: usize, q: impl Fn(usize) -> Scalar) {
        let g = &mut self.g;
        match orientation {
            Orientation::Quaternion => {
                let motion = Motion::Ball([0, 1, 2, 3].map(&q));
                chain.push(g, "", &Step { axis: coordinate(0), motion, freedom: first, q: Scalar::ZERO });
            }
            Orientation::RollPitchYaw => {
                for (suffix, k) in [("yaw", 2), ("pitch", 1), ("", 0)] {
                    chain.revolute(g, suffix, coordinate(k), first + k, q(k));
                }
            }
        }
    }

    /// The axis that an expression means.
    pub(in crate::mechanics) fn axis(&mut self, axis: &Expr) -> Axis {
        let direction = self.vector(axis);
        let direction = self.g.components(direction);
        directions::axis(&mut self.g, direction)
    }
}
