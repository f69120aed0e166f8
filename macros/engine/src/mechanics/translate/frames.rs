//! Stage `mechanics`: what expressions ask of frames.
//!
//! In: a frame's place on the tree. Out: its position, orientation, velocity and acceleration in world axes, written in
//! the derivation's style; vectors from the axes of one frame to those of another.

use std::collections::HashMap;
use std::rc::Rc;

use crate::dynamics::point_kinematics::PointKinematics;
use crate::dynamics::velocities::{LinkVelocity, velocities};
use crate::dynamics::world;
use crate::mechanics::equations::Equations;
use crate::mechanics::scene::Style;
use crate::model::types::{Expr, ExprNode, FrameQuantity, JointId};
use crate::symbolic::graph::{Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::build::FixedFrame;
use super::values::Value;

/// Size of a sum, shared parts counted as often as they occur, up to which it is looked into for quantities of frames;
/// beyond, a vector is turned as a whole.
const MOST_TERMS: usize = 64;

/// Motion of a frame in world axes.
struct FrameMotion {
    position: Vector,
    velocity: Vector,
    acceleration: Vector,
    angular: Vector,
    angular_rate: Vector,
}

/// How links are turned and move.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Links {
    /// Rotations to world axes.
    rotations: HashMap<usize, Rotation>,
    velocities: Option<Rc<[LinkVelocity]>>,
}

impl Equations<'_> {
    /// A quantity of a frame.
    pub(in crate::mechanics) fn of_place(&mut self, place: &FixedFrame, quantity: FrameQuantity) -> Value {
        match quantity {
            FrameQuantity::Position => Value::Vector(self.frame_motion(place, 0).position),
            FrameQuantity::Rotation => Value::Rotation(Rc::new(self.frame_rows(place))),
            FrameQuantity::Pose => {
                let position = self.frame_motion(place, 0).position;
                Value::Pose(position, self.quaternion(place))
            }
            FrameQuantity::Velocity => Value::Vector(self.frame_motion(place, 1).velocity),
            FrameQuantity::AngularVelocity => Value::Vector(self.frame_motion(place, 1).angular),
            FrameQuantity::Twist => {
                let motion = self.frame_motion(place, 1);
                Value::Pair(motion.velocity, motion.angular)
            }
            FrameQuantity::Acceleration => Value::Vector(self.frame_motion(place, 2).acceleration),
            FrameQuantity::AngularAcceleration => Value::Vector(self.frame_motion(place, 2).angular_rate),
        }
    }

    /// `order` 0: position; 1: velocities too; 2: accelerations too.
    fn frame_motion(&mut self, place: &FixedFrame, order: u8) -> FrameMotion {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let acceleration = (order > 1).then(|| {
            let user = self.accelerations();
            let mut list = mechanism.sign(&user);
            list.resize(tree.freedoms(), Scalar::ZERO);
            Rc::from(list)
        });
        match self.scene.way.style {
            Style::Nested => {
                let still: Rc<[Scalar]> = Rc::from([]);
                let acceleration = acceleration.unwrap_or(still);
                let mut kinematics = PointKinematics::new(tree, place.offset, order, &acceleration);
                kinematics.up_to(&mut self.g, place.link, None);
                let [position, velocity, acceleration] = kinematics.local(&mut self.g);
                let (angular, angular_rate) = (kinematics.angular, kinematics.angular_rate);
                FrameMotion { position, velocity, acceleration, angular, angular_rate }
            }
            Style::World => {
                let (g, columns) = (&mut self.g, &mut self.caches.world);
                let arm = columns.rotate(g, tree, place.link, place.offset);
                let origin = columns.origin(g, tree, place.link);
                let position = g.add_vectors(origin, arm);
                let (mut velocity, mut acceleration_of) = (Vector::ZERO, Vector::ZERO);
                let (mut angular, mut angular_rate) = (Vector::ZERO, Vector::ZERO);
                if order > 0 {
                    let motion = world::motion(g, tree, columns, place.link, acceleration.as_ref());
                    let swing = g.cross(motion.angular, arm);
                    velocity = g.add_vectors(motion.linear, swing);
                    let tangential = g.cross(motion.angular_rate, arm);
                    if order > 1 {
                        let centripetal = g.cross(motion.angular, swing);
                        acceleration_of = g.sum_vectors(&[motion.linear_rate, tangential, centripetal]);
                    }
                    (angular, angular_rate) = (motion.angular, motion.angular_rate);
                }
                FrameMotion { position, velocity, acceleration: acceleration_of, angular, angular_rate }
            }
        }
    }

    /// Angular velocity of a frame and velocity of its origin in world axes.
    pub(in crate::mechanics) fn world_velocity(&mut self, place: &FixedFrame) -> (Vector, Vector) {
        let motion = self.frame_motion(place, 1);
        (motion.angular, motion.velocity)
    }

    /// Rotation from a frame to the world, row by row.
    pub(in crate::mechanics) fn frame_rows(&mut self, place: &FixedFrame) -> [[Scalar; 3]; 3] {
        match self.scene.way.style {
            Style::Nested => {
                let link = self.rotation(place.link);
                let rotation = self.g.compose(link, place.rotation);
                rotations::rows(&mut self.g, rotation)
            }
            Style::World => {
                let mechanism = Rc::clone(&self.scene.mechanism);
                let rows = rotations::rows(&mut self.g, place.rotation);
                let columns = rotations::transpose(&rows).map(|column| {
                    let column = self.g.vector(column);
                    let column = self.caches.world.rotate(&mut self.g, &mechanism.tree, place.link, column);
                    self.g.components(column)
                });
                rotations::transpose(&columns)
            }
        }
    }

    /// Rotation from a link to the world, as a chain that vectors pass turn by turn.
    pub(in crate::mechanics) fn rotation(&mut self, link: Option<usize>) -> Rotation {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let rotations = &self.caches.links.rotations;
        let known = tree.support(link).find(|index| rotations.contains_key(index));
        let mut rotation = known.map_or(Rotation::IDENTITY, |index| rotations[&index]);
        for index in tree.path(known, link) {
            rotation = self.outwards(rotation, index);
            self.caches.links.rotations.insert(index, rotation);
        }
        rotation
    }

    /// A rotation followed outwards through one joint: placement and turn one by one, so that parallel turns meet.
    fn outwards(&mut self, rotation: Rotation, index: usize) -> Rotation {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let link = &mechanism.tree.links[index];
        let placed = self.g.compose(rotation, link.rotation);
        let turn = link.turn(&mut self.g);
        self.g.compose(placed, turn)
    }

    /// Components in link `to`'s axes of a vector in link `from`'s, by way of the last link that carries both.
    pub(in crate::mechanics) fn between(&mut self, from: Option<usize>, to: Option<usize>, v: Vector) -> Vector {
        if from == to || v == Vector::ZERO {
            return v;
        }
        let common = self.common(from, to);
        let up = self.relative(from, common);
        let down = self.relative(to, common);
        let v = self.g.rotate(up, v);
        self.g.rotate(down.transpose(), v)
    }

    /// Rotation from a link's axes to those of one that carries it.
    fn relative(&mut self, link: Option<usize>, carrier: Option<usize>) -> Rotation {
        if carrier.is_none() {
            return self.rotation(link);
        }
        let mechanism = Rc::clone(&self.scene.mechanism);
        let path = mechanism.tree.path(carrier, link);
        path.into_iter().fold(Rotation::IDENTITY, |rotation, index| self.outwards(rotation, index))
    }

    /// The outermost link that carries both.
    pub(in crate::mechanics) fn common(&self, a: Option<usize>, b: Option<usize>) -> Option<usize> {
        self.scene.mechanism.tree.common(a, b)
    }

    /// Components in a frame's axes of a world vector. Quantities of frames on the same link need no way through the
    /// world, and sums are looked into for them.
    pub(super) fn express(&mut self, axes: &FixedFrame, vector: &Expr) -> Vector {
        let v = self.in_link(axes.link, vector);
        self.g.rotate(axes.rotation.transpose(), v)
    }

    /// Components in a link's axes of a world vector.
    pub(super) fn in_link(&mut self, link: Option<usize>, vector: &Expr) -> Vector {
        if link.is_some() && self.reaches(link, vector) {
            match &*vector.node {
                ExprNode::Add(a, b) => {
                    let (a, b) = (self.in_link(link, a), self.in_link(link, b));
                    return self.g.add_vectors(a, b);
                }
                ExprNode::Sub(a, b) => {
                    if let Some(difference) = self.difference(link, a, b) {
                        return difference;
                    }
                    let (a, b) = (self.in_link(link, a), self.in_link(link, b));
                    return self.g.sub_vectors(a, b);
                }
                ExprNode::Neg(a) => return -self.in_link(link, a),
                ExprNode::Mul(a, b) => {
                    let (factor, v) = if a.ty == crate::model::types::Type::Vec3 { (b, a) } else { (a, b) };
                    let factor = self.scalar(factor);
                    let v = self.in_link(link, v);
                    return self.g.scale(factor, v);
                }
                ExprNode::OfFrame(frame, quantity) => {
                    let place = self.place(frame);
                    let (w, v) = self.point_velocity(&place);
                    return if *quantity == FrameQuantity::Velocity { v } else { w };
                }
                _ => {}
            }
        }
        let v = self.vector(vector);
        self.between(None, link, v)
    }

    /// Whether a vector holds something that is at hand in this link's axes, and not too many terms.
    fn reaches(&self, link: Option<usize>, vector: &Expr) -> bool {
        let (mut found, mut terms) = (false, 0);
        let mut stack = vec![vector];
        while let Some(vector) = stack.pop() {
            terms += 1;
            if terms > MOST_TERMS {
                return false;
            }
            match &*vector.node {
                ExprNode::Add(a, b) | ExprNode::Mul(a, b) => stack.extend([a, b]),
                ExprNode::Sub(a, b) => {
                    let position = |e: &Expr| matches!(&*e.node, ExprNode::OfFrame(_, FrameQuantity::Position));
                    found |= position(a) && position(b);
                    stack.extend([a, b]);
                }
                ExprNode::Neg(a) => stack.push(a),
                ExprNode::OfFrame(frame, FrameQuantity::Velocity | FrameQuantity::AngularVelocity) => {
                    found |= self.scene.mechanism.body(frame.body).link == link;
                }
                _ => {}
            }
        }
        found
    }

    /// The way from one frame to another, measured from the last link that carries both.
    fn difference(&mut self, link: Option<usize>, to: &Expr, from: &Expr) -> Option<Vector> {
        let (ExprNode::OfFrame(to, FrameQuantity::Position), ExprNode::OfFrame(from, FrameQuantity::Position)) =
            (&*to.node, &*from.node)
        else {
            return None;
        };
        let (to, from) = (self.place(to), self.place(from));
        let ([d, _], common) = self.way(&from, &to, 0);
        Some(self.between(common, link, d))
    }

    /// The vector from one frame's origin to another's and its rate (for order 1), in the axes of the last link that
    /// carries both, as that link sees them.
    pub(in crate::mechanics) fn way(
        &mut self,
        from: &FixedFrame,
        to: &FixedFrame,
        order: u8,
    ) -> ([Vector; 2], Option<usize>) {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let common = self.common(from.link, to.link);
        let ends = [from, to].map(|place| {
            let mut kinematics = PointKinematics::new(&mechanism.tree, place.offset, order, &[]);
            kinematics.up_to(&mut self.g, place.link, common);
            kinematics.local(&mut self.g)
        });
        let way = [0, 1].map(|k| self.g.sub_vectors(ends[1][k], ends[0][k]));
        (way, common)
    }

    /// Velocities of all links, in link axes.
    pub(in crate::mechanics) fn link_velocities(&mut self) -> Rc<[LinkVelocity]> {
        if let Some(velocities) = &self.caches.links.velocities {
            return Rc::clone(velocities);
        }
        let velocities: Rc<[LinkVelocity]> = velocities(&mut self.g, &self.scene.mechanism.tree).into();
        self.caches.links.velocities = Some(Rc::clone(&velocities));
        velocities
    }

    /// Angular velocity of a frame and velocity of its origin, in its link's axes.
    pub(super) fn point_velocity(&mut self, place: &FixedFrame) -> (Vector, Vector) {
        let velocities = self.link_velocities();
        let Some(&(w, v)) = place.link.and_then(|link| velocities.get(link)) else {
            return (Vector::ZERO, Vector::ZERO);
        };
        let swing = self.g.cross(w, place.offset);
        (w, self.g.add_vectors(v, swing))
    }

    /// The child's angular velocity relative to the parent, in the axes of the joint's child frame.
    pub(super) fn relative_angular_velocity(&mut self, joint: JointId) -> Vector {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        if self.scene.model.cuts.contains(&joint) {
            return self.measured_angular_velocity(joint);
        }
        let joint = &mechanism.joints[joint.0];
        // By link of the joint. A ball on hinges hangs on what carries these, and not on the link before it.
        let mut angular: Vec<Vector> = Vec::with_capacity(joint.links.len());
        for link in &tree.links[joint.links.clone()] {
            let before = link.parent.and_then(|parent| parent.checked_sub(joint.links.start));
            let carried = before.and_then(|at| angular.get(at)).copied().unwrap_or(Vector::ZERO);
            let carried = tree.to_link(&mut self.g, link, carried);
            let (turn, _) = tree.joint_motion(&mut self.g, link, &tree.velocity);
            angular.push(self.g.add_vectors(carried, turn));
        }
        let last = angular.last().copied().unwrap_or(Vector::ZERO);
        match joint.child {
            Some(child) => self.g.rotate(child.rotation.transpose(), last),
            None => last,
        }
    }
}
