//! Stage `mechanics`: from the checked model to the tree of primitive motions.
//!
//! In: bodies, joints, frames. Out: a [`Mechanism`]: the [`Tree`], and where every body's frame stands on it. The link
//! beyond a joint is oriented along the joint's axis and stands at the joint's child frame, so the child body is placed
//! on it by a constant rotation and offset; a body on a `Fixed` joint shares its parent's link.

use crate::dynamics::inertia::Inertia;
use crate::dynamics::tree::{Motion, Tree};
use crate::invariant::injection::{Break, broken};
use crate::mechanics::equations::Equations;
use crate::model::types::{Body, BodyRef, Frame, FrameStep, Joint, JointId};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::balls::HingedBall;
use super::chain::Chain;
use super::{directions, names, typed};

/// A frame that is fixed to a link, or to the ground.
#[derive(Clone, Copy, Debug)]
pub struct FixedFrame {
    pub link: Option<usize>,
    /// From the frame's axes to the link's; constant.
    pub rotation: Rotation,
    /// m, in link axes; constant.
    pub offset: Vector,
}

impl FixedFrame {
    pub const GROUND: FixedFrame = FixedFrame { link: None, rotation: Rotation::IDENTITY, offset: Vector::ZERO };

    /// A frame that is placed in this one.
    pub fn then(&self, g: &mut Graph, rotation: Rotation, offset: Vector) -> FixedFrame {
        let moved = rotations::rotate(g, self.rotation, offset);
        FixedFrame {
            link: self.link,
            rotation: rotations::compose(g, self.rotation, rotation),
            offset: g.add_vectors(self.offset, moved),
        }
    }
}

/// The links of one joint.
#[derive(Clone, Debug, Default)]
pub struct JointLinks {
    pub links: std::ops::Range<usize>,
    /// The joint's child frame.
    pub child: Option<FixedFrame>,
}

/// The tree, and where the model's things stand on it.
#[derive(Clone, Debug, Default)]
pub struct Mechanism {
    /// Its coordinates are those of the user up to signs, then speeds of the user's choice. Behind them stand the unmoving coordinates of
    /// `Fixed` joints
    /// that were kept for their reactions.
    pub tree: Tree,
    /// By body.
    pub bodies: Vec<FixedFrame>,
    /// By joint.
    pub joints: Vec<JointLinks>,
    /// By velocity coordinate: the tree's is minus the user's, since the axis is a negative coordinate axis.
    pub flipped: Vec<bool>,
    /// Balls on hinges, whose velocities are speeds of the user's choice.
    pub balls: Vec<HingedBall>,
}

impl Mechanism {
    pub fn body(&self, body: BodyRef) -> FixedFrame {
        match body {
            BodyRef::Ground => FixedFrame::GROUND,
            BodyRef::Body(id) => self.bodies[id.0],
        }
    }

    /// Coordinates, rates or efforts of the tree from the user's, or the other way round.
    pub fn sign(&self, list: &[Scalar]) -> Vec<Scalar> {
        let flipped = self.flipped.iter().copied().chain(std::iter::repeat(false));
        list.iter().zip(flipped).map(|(&x, flip)| if flip { -x } else { x }).collect()
    }

    /// Elimination from the leaves to the ground, which fills nothing in. With `floating` the translations of what floats
    /// in the world go first: their pivots are constant masses, and what is left of a body is its inertia about the
    /// centre of mass, constant too.
    pub fn elimination(&self, floating: bool) -> Vec<usize> {
        let mut first: Vec<bool> = Vec::with_capacity(self.tree.links.len());
        for link in &self.tree.links {
            let carried = link.parent.is_none_or(|parent| first.get(parent) == Some(&true));
            first.push(floating && carried && matches!(link.motion, Motion::Prismatic(_)));
        }
        let mut order = Vec::with_capacity(self.flipped.len());
        for now in [true, false] {
            for (link, _) in self.tree.links.iter().zip(&first).rev().filter(|&(_, &first)| first == now) {
                let freedoms = link.freedom..link.freedom + link.motion.freedoms();
                order.extend(freedoms.filter(|&k| k < self.flipped.len()));
            }
        }
        order
    }
}

impl Equations<'_> {
    /// Builds the tree.
    pub(in crate::mechanics) fn build(&mut self) -> Mechanism {
        let model = self.scene.model;
        let (velocity, acceleration) = (self.all_velocities(), self.all_accelerations());
        let mut mechanism = Mechanism {
            bodies: vec![FixedFrame::GROUND; model.bodies.len()],
            joints: vec![JointLinks::default(); model.joints.len()],
            flipped: vec![false; velocity.len()],
            ..Mechanism::default()
        };
        mechanism.tree.velocity = velocity;
        mechanism.tree.acceleration = acceleration;
        for &id in &model.tree {
            let kept = self.scene.kept.contains(&id);
            self.attach(&mut mechanism, id, &model.joints[id], kept);
        }
        self.merge_hinges(&mut mechanism);
        for (body, place) in model.bodies.iter().zip(mechanism.bodies.clone()) {
            self.load(&mut mechanism.tree, body, place);
        }
        mechanism.tree.velocity = mechanism.sign(&mechanism.tree.velocity);
        mechanism.tree.acceleration = mechanism.sign(&mechanism.tree.acceleration);
        mechanism.tree.gravity = model.gravity.as_ref().map(|gravity| {
            let gravity = self.vector(gravity);
            self.g.components(gravity)
        });
        mechanism
    }

    /// Appends a joint's links and places its child.
    fn attach(&mut self, mechanism: &mut Mechanism, id: JointId, joint: &Joint, kept: bool) {
        let (rotation, offset) = self.steps(&joint.parent);
        let parent = mechanism.body(joint.parent.body).then(&mut self.g, rotation, offset);
        let name = names::path(self.scene.model, &joint.place);
        let start = mechanism.tree.links.len();
        let mut chain = Chain::new(mechanism, parent, name);
        self.append(&mut chain, id, joint, kept);
        let end = chain.end;
        if let (Some(armature), Some(link)) = (&joint.armature, end.link) {
            let armature = self.scalar(armature);
            mechanism.tree.links[link].armature = armature;
        }
        mechanism.joints[id.0] = JointLinks { links: start..mechanism.tree.links.len(), child: Some(end) };
        // The child frame, R and p in the body, is the chain's end: the body is R^T and -R^T p in that.
        let (rotation, offset) = self.steps(&joint.child);
        let back = rotations::rotate(&mut self.g, rotation.transpose(), offset);
        let place = end.then(&mut self.g, rotation.transpose(), -back);
        if let BodyRef::Body(body) = joint.child.body {
            mechanism.bodies[body.0] = place;
        }
    }

    /// Adds a body's moments to its link.
    pub(in crate::mechanics) fn load(&mut self, tree: &mut Tree, body: &Body, place: FixedFrame) {
        let mass = self.scalar(&body.mass);
        let com = self.vector(&body.com);
        let com = self.g.components(com);
        let tensor = match &body.inertia {
            Some(entries) => std::array::from_fn(|k| self.scalar(&entries[k])),
            None => [Scalar::ZERO; 6],
        };
        let g = &mut self.g;
        let offset = g.components(place.offset);
        let inertia = Inertia::from_tensor(g, mass, com, tensor).rotate(g, place.rotation).shift(g, offset);
        match place.link.and_then(|link| tree.links.get_mut(link)) {
            Some(link) => link.inertia = link.inertia.add(g, &inertia),
            None => tree.ground = Some(tree.ground.unwrap_or(Inertia::ZERO).add(g, &inertia)),
        }
    }

    /// A frame's constant pose in its body.
    pub(super) fn steps(&mut self, frame: &Frame) -> (Rotation, Vector) {
        let mut place = FixedFrame::GROUND;
        for step in &frame.steps {
            let (rotation, offset) = match step {
                FrameStep::At(offset) => (Rotation::IDENTITY, self.vector(offset)),
                FrameStep::Rotated(axis, angle) => {
                    let axis = self.vector(axis);
                    let axis = self.g.components(axis);
                    let angle = self.scalar(angle);
                    let angle = if broken(Break::FrameTurn) { -angle } else { angle };
                    (directions::about(&mut self.g, axis, angle), Vector::ZERO)
                }
                FrameStep::Oriented(rows) => {
                    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| self.scalar(&rows[i][j])));
                    (typed::oriented(&mut self.g, rows), Vector::ZERO)
                }
            };
            place = place.then(&mut self.g, rotation, offset);
        }
        (place.rotation, place.offset)
    }

    /// Where a frame stands on the tree.
    pub(in crate::mechanics) fn place(&mut self, frame: &Frame) -> FixedFrame {
        let (rotation, offset) = self.steps(frame);
        let body = self.scene.mechanism.body(frame.body);
        body.then(&mut self.g, rotation, offset)
    }
}
