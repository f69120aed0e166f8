//! Stage `mechanics`: coordinates of joints that close loops, measured between their frames.
//!
//! In: a joint between two bodies that have coordinates of their own, such as absolute ones. Out: its coordinates, their
//! rates and accelerations, so that a spring, a motor or a coupling on it is the same whatever the coordinates. With d the
//! way from the parent's point to the child's and w the angular velocity of the child relative to the parent, a travel
//! along n, fixed to the parent, is n . d at the rate n . (d' - w_P x d), and an angle that turns x away from u about n
//! is that of the point (u . x, (n x u) . x), between minus and plus a half turn. The angle of a screw is its travel over
//! its pitch, which counts turns. The rate of an angle is a . w, where the a of all angles of the joint are dual to
//! their axes; an effort on it is the moment along the same a.

use std::rc::Rc;

use crate::contracts::call::Call;
use crate::dynamics::point_kinematics::PointKinematics;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::directions::Axis;
use crate::mechanics::translate::symbols::Symbols;
use crate::model::joint_kinds::Motion;
use crate::model::types::{Coordinate, Directions, Joint, JointId, Order};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{Scalar, Vector};

use super::Writing;

/// What a coordinate's rate is taken from the relative motion with, and its effort acts along; in the axes of the parent's
/// link.
#[derive(Clone, Copy)]
pub(in crate::mechanics) enum Dual {
    Slides(Vector),
    Turns(Vector),
}

/// How an angle is measured: by a direction of one frame against two of the other.
struct Angle {
    u: (FixedFrame, Vector),
    /// n x u
    v: (FixedFrame, Vector),
    x: (FixedFrame, Vector),
}

impl Equations<'_> {
    /// A coordinate of the tree, or one that is measured.
    pub(in crate::mechanics) fn coordinate(&mut self, coordinate: Coordinate, order: Order) -> Scalar {
        let Coordinate { joint, index } = coordinate;
        if order == Order::Position && self.stands_apart() {
            return self.read_coordinate(coordinate);
        }
        if order == Order::Rate && self.stands_apart() {
            return self.read_rate(coordinate);
        }
        if self.scene.model.cuts.contains(&joint) {
            return match order {
                Order::Position => self.measured_position(coordinate),
                Order::Rate => self.measured_rate(coordinate),
                Order::Acceleration => self.measured_acceleration(coordinate),
            };
        }
        match order {
            Order::Position => Symbols::of(&self.scene.symbols.positions, joint)[index],
            Order::Rate => Symbols::of(&self.scene.symbols.velocities, joint)[index],
            Order::Acceleration => {
                let freedom = self.freedom(coordinate);
                self.accelerations()[freedom]
            }
        }
    }

    pub(in crate::mechanics) fn measured_position(&mut self, Coordinate { joint, index }: Coordinate) -> Scalar {
        let model = self.scene.model;
        let joint = &model.joints[joint];
        let ends = [self.place(&joint.parent), self.place(&joint.child)];
        let axes = self.joint_axes(joint);
        if let Some(pitch) = &joint.pitch {
            let pitch = self.scalar(pitch);
            if pitch != Scalar::ZERO {
                let along = self.along(axes[0], Scalar::ONE);
                let travel = self.travel(&ends, along);
                return self.g.div(travel, pitch);
            }
        }
        if let Some(freedom) = joint.kind.freedoms.get(index).filter(|freedom| freedom.motion == Motion::Slides) {
            let along = self.along(axes[freedom.direction % 3], Scalar::ONE);
            return self.travel(&ends, along);
        }
        if joint.kind.has_angles() {
            return self.roll_pitch_yaw_between(&ends, index - joint.kind.turning().start);
        }
        match self.angle_of(joint, &ends, index) {
            Some(angle) => {
                let [cos, sin] = self.point_of(&ends, &angle);
                self.g.call(Call::Atan2, &[sin, cos])
            }
            None => Scalar::ZERO,
        }
    }

    /// Whether a measured coordinate is an angle that is known up to whole turns. A pitch is none: it never passes a
    /// quarter.
    pub(super) fn is_angle(&mut self, Coordinate { joint, index }: Coordinate) -> bool {
        let model = self.scene.model;
        let joint = &model.joints[joint];
        let turns = joint.kind.freedoms.get(index).is_some_and(|freedom| freedom.motion == Motion::Turns);
        let travels = joint.pitch.as_ref().is_some_and(|pitch| self.scalar(pitch) != Scalar::ZERO);
        turns && !travels && joint.kind.pitch() != Some(index)
    }

    /// A component of the way along a direction of the parent's frame.
    fn travel(&mut self, ends: &[FixedFrame; 2], along: Vector) -> Scalar {
        let view = self.view(ends, Writing::PLAIN);
        let way = self.see_way(&view, ends);
        let along = self.g.rotate(ends[0].rotation, along);
        let along = self.see_vector(&view, ends[0].link, along);
        self.g.dot(way, along)
    }

    fn angle_of(&mut self, joint: &Joint, ends: &[FixedFrame; 2], index: usize) -> Option<Angle> {
        let [parent, child] = *ends;
        let freedom = joint.kind.freedoms.get(index).filter(|freedom| freedom.motion == Motion::Turns)?;
        let axes = self.joint_axes(joint);
        match &joint.directions {
            Directions::Crossed(_) => {
                let [first, second] = [axes[0], axes[1]].map(|axis| self.along(axis, Scalar::ONE));
                let v = self.g.cross(first, second);
                Some(if index == 0 {
                    Angle { u: (parent, second), v: (parent, v), x: (child, second) }
                } else {
                    // The parent's axis as the child sees it turns the other way round.
                    Angle { u: (child, first), v: (child, v), x: (parent, first) }
                })
            }
            Directions::Frame | Directions::Axis(_) | Directions::Plane(_) | Directions::Slot(_) => {
                let axis = axes[freedom.direction % 3];
                let [u, v] = [1, 2].map(|next| self.along(axis.next(next), Scalar::ONE));
                let v = if axis.flipped { -v } else { v };
                Some(Angle { u: (parent, u), v: (parent, v), x: (child, u) })
            }
        }
    }

    fn point_of(&mut self, ends: &[FixedFrame; 2], angle: &Angle) -> [Scalar; 2] {
        let view = self.view(ends, Writing::PLAIN);
        let [u, v, x] = [&angle.u, &angle.v, &angle.x].map(|(place, direction)| {
            let direction = self.g.rotate(place.rotation, *direction);
            self.see_vector(&view, place.link, direction)
        });
        [self.g.dot(u, x), self.g.dot(v, x)]
    }

    /// An axis of the child along one of the parent's.
    fn cosine_between(&mut self, ends: &[FixedFrame; 2], child: usize, parent: usize) -> Scalar {
        let view = self.view(ends, Writing::PLAIN);
        let (c, p) = (self.see_axis(&view, &ends[1], child), self.see_axis(&view, &ends[0], parent));
        self.g.dot(c, p)
    }

    /// Angles of Rz(yaw) Ry(pitch) Rx(roll).
    fn roll_pitch_yaw_between(&mut self, ends: &[FixedFrame; 2], index: usize) -> Scalar {
        let [sin, cos] = match index {
            0 => [self.cosine_between(ends, 1, 2), self.cosine_between(ends, 2, 2)],
            1 => {
                let [x, y] = [0, 1].map(|k| self.cosine_between(ends, 0, k));
                let squares = [self.g.mul(x, x), self.g.mul(y, y)];
                let square = self.g.sum(&squares);
                [-self.cosine_between(ends, 0, 2), self.g.sqrt(square)]
            }
            _ => [self.cosine_between(ends, 0, 1), self.cosine_between(ends, 0, 0)],
        };
        self.g.call(Call::Atan2, &[sin, cos])
    }

    pub(in crate::mechanics) fn dual(&mut self, Coordinate { joint, index }: Coordinate) -> Option<Dual> {
        let model = self.scene.model;
        let joint = &model.joints[joint];
        let [parent, child] = [self.place(&joint.parent), self.place(&joint.child)];
        let Some(freedom) = joint.kind.freedoms.get(index) else {
            let own = self.axis_in_link(&child, index - joint.kind.freedoms.len());
            return Some(Dual::Turns(self.between(child.link, parent.link, own)));
        };
        let axes = self.joint_axes(joint);
        let axis = axes[freedom.direction % 3];
        let direction = match freedom.motion {
            Motion::Slides => return Some(Dual::Slides(self.direction_in(&parent, axis))),
            Motion::Turns if joint.kind.has_angles() => {
                self.gimbal(&[parent, child], index - joint.kind.turning().start)
            }
            Motion::Turns if joint.directions.is_of_child(freedom.direction) => {
                let own = self.direction_in(&child, axis);
                return Some(Dual::Turns(self.between(child.link, parent.link, own)));
            }
            Motion::Turns => self.along(axis, Scalar::ONE),
        };
        Some(Dual::Turns(self.g.rotate(parent.rotation, direction)))
    }

    fn direction_in(&mut self, place: &FixedFrame, axis: Axis) -> Vector {
        let along = self.along(axis, Scalar::ONE);
        self.g.rotate(place.rotation, along)
    }

    /// With c the child's x axis in the parent's, the axes of roll, pitch and yaw are c, (-c_y, c_x, 0) / k and z, with
    /// k^2 = c_x^2 + c_y^2; these are dual to them.
    fn gimbal(&mut self, ends: &[FixedFrame; 2], index: usize) -> Vector {
        let [x, y, z] = [0, 1, 2].map(|k| self.cosine_between(ends, 0, k));
        let g = &mut self.g;
        let squares = [g.mul(x, x), g.mul(y, y)];
        let square = g.sum(&squares);
        let flat = g.vector([x, y, Scalar::ZERO]);
        let inverse = g.reciprocal(square);
        match index {
            0 => g.scale(inverse, flat),
            1 => {
                let root = g.sqrt(square);
                let inverse = g.reciprocal(root);
                let across = g.vector([-y, x, Scalar::ZERO]);
                g.scale(inverse, across)
            }
            _ => {
                let tilt = g.mul(z, inverse);
                let (back, up) = (g.scale(tilt, flat), g.along(2, Scalar::ONE));
                g.sub_vectors(up, back)
            }
        }
    }

    pub(in crate::mechanics) fn measured_rate(&mut self, coordinate: Coordinate) -> Scalar {
        let model = self.scene.model;
        let Some(dual) = self.dual(coordinate) else { return Scalar::ZERO };
        let joint = &model.joints[coordinate.joint];
        let ends = [self.place(&joint.parent), self.place(&joint.child)];
        let (common, [way, rate], [parent, child]) = self.motion_between(&ends);
        let g = &mut self.g;
        let (direction, motion) = match dual {
            Dual::Slides(direction) => {
                let carried = g.cross(parent, way);
                (direction, g.sub_vectors(rate, carried))
            }
            Dual::Turns(direction) => (direction, g.sub_vectors(child, parent)),
        };
        let direction = self.between(ends[0].link, common, direction);
        self.g.dot(direction, motion)
    }

    /// The way between two frames and its rate, and their angular velocities, in the axes of the last link that carries both,
    /// as that link sees them.
    fn motion_between(&mut self, ends: &[FixedFrame; 2]) -> (Option<usize>, [Vector; 2], [Vector; 2]) {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let common = self.common(ends[0].link, ends[1].link);
        let [from, to] = [0, 1].map(|k| {
            let mut kinematics = PointKinematics::new(&mechanism.tree, ends[k].offset, 1, &[]);
            kinematics.up_to(&mut self.g, ends[k].link, common);
            (kinematics.local(&mut self.g), kinematics.angular)
        });
        let way = [0, 1].map(|k| self.g.sub_vectors(to.0[k], from.0[k]));
        (common, way, [from.1, to.1])
    }

    fn measured_acceleration(&mut self, coordinate: Coordinate) -> Scalar {
        let rate = self.measured_rate(coordinate);
        let accelerations = self.accelerations();
        let mut seeds = self.seeds(1);
        seeds.extend(self.scene.symbols.velocities.concat().into_iter().zip(accelerations.iter().copied()));
        Differentiator::new(&seeds).scalar(&mut self.g, rate)
    }

    /// The child's angular velocity relative to the parent, in the axes of the joint's child frame.
    pub(in crate::mechanics) fn measured_angular_velocity(&mut self, joint: JointId) -> Vector {
        let model = self.scene.model;
        let joint = &model.joints[joint];
        let ends = [self.place(&joint.parent), self.place(&joint.child)];
        let (common, _, [parent, child]) = self.motion_between(&ends);
        let angular = self.g.sub_vectors(child, parent);
        let angular = self.between(common, ends[1].link, angular);
        self.g.rotate(ends[1].rotation.transpose(), angular)
    }
}
