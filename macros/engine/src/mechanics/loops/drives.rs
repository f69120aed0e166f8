//! Stage `mechanics`: coordinates that follow a prescribed course.
//!
//! In: drives. Out: positions as expressions of time, and their derivatives as rates and accelerations. An orientation is
//! given as a rotation: as roll, pitch and yaw it is read off with a pitch between -90 and 90 degrees, angles as points of
//! the circle; as a quaternion its angular velocity is the vector part of 2 q* q'.

use crate::mechanics::equations::Equations;
use crate::mechanics::translate::orientation;
use crate::mechanics::translate::symbols::{Symbols, has_quaternion};
use crate::mechanics::translate::values::Value;
use crate::model::types::{Coordinate, Drive, DriveTarget, Expr, JointId};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

use super::reduction::Reduction;

impl Equations<'_> {
    /// Definitions of all driven coordinates.
    pub(in crate::mechanics) fn drive(&mut self, reduction: &mut Reduction) {
        let model = self.scene.model;
        for Drive { target, value, .. } in &model.drives {
            match *target {
                DriveTarget::Coordinate(coordinate) => {
                    let value = self.scalar(value);
                    self.follow(coordinate, value, reduction);
                }
                DriveTarget::Position(joint) => {
                    let value = self.vector(value);
                    self.follow_position(joint, value, reduction);
                }
                DriveTarget::Orientation(joint) => {
                    if let Value::Rotation(rows) = self.value(value) {
                        self.follow_orientation(joint, &rows, reduction);
                    }
                }
                DriveTarget::Pose(joint) => self.follow_pose(joint, value, reduction),
            }
        }
    }

    fn follow_pose(&mut self, joint: JointId, value: &Expr, reduction: &mut Reduction) {
        if let Value::Pose(position, quaternion) = self.value(value) {
            self.follow_position(joint, position, reduction);
            let rotation = self.g.quaternion_rotation(quaternion);
            let rows = self.g.rotation_rows(rotation);
            self.follow_orientation(joint, &rows, reduction);
        }
    }

    fn follow_position(&mut self, joint: JointId, value: crate::symbolic::graph::Vector, reduction: &mut Reduction) {
        for (index, value) in self.g.components(value).into_iter().enumerate() {
            self.follow(Coordinate { joint, index }, value, reduction);
        }
    }

    /// A coordinate whose rate is its velocity.
    fn follow(&mut self, coordinate: Coordinate, value: Scalar, reduction: &mut Reduction) {
        let rate = self.by_time(value);
        let acceleration = self.by_time(rate);
        let symbols = self.coordinate_symbols(coordinate);
        for (symbol, value) in symbols.into_iter().zip([value, rate, acceleration]) {
            reduction.map.extend(self.g.symbol_id(symbol).map(|id| (id, value)));
        }
    }

    fn follow_orientation(&mut self, joint: JointId, rows: &[[Scalar; 3]; 3], reduction: &mut Reduction) {
        let positions = Symbols::of(&self.scene.symbols.positions, joint).to_vec();
        let velocities = Symbols::of(&self.scene.symbols.velocities, joint).to_vec();
        let accelerations = Symbols::of(&self.scene.symbols.accelerations, joint).to_vec();
        let first = velocities.len().saturating_sub(3);
        if !has_quaternion(&self.scene.model.joints[joint]) {
            for (k, angle) in self.roll_pitch_yaw(rows).into_iter().enumerate() {
                self.follow(Coordinate { joint, index: first + k }, angle, reduction);
            }
            return;
        }
        let q = orientation::of_rows(&mut self.g, rows);
        let dq = q.map(|s| self.by_time(s));
        let angular = orientation::angular_velocity(&mut self.g, q, dq);
        let angular = self.g.components(angular);
        let mut pairs: Vec<(Scalar, Scalar)> = positions[first..].iter().copied().zip(q).collect();
        for (k, rate) in angular.into_iter().enumerate() {
            let acceleration = self.by_time(rate);
            pairs.extend([(velocities[first + k], rate), (accelerations[first + k], acceleration)]);
        }
        reduction.map.extend(self.map(&pairs));
    }

    /// Angles of Rz(yaw) Ry(pitch) Rx(roll), pitch in the right half of its circle.
    fn roll_pitch_yaw(&mut self, m: &[[Scalar; 3]; 3]) -> [Scalar; 3] {
        let g = &mut self.g;
        let squares = [g.mul(m[0][0], m[0][0]), g.mul(m[1][0], m[1][0])];
        let square = g.sum(&squares);
        let cos = g.sqrt(square);
        let inverse = g.reciprocal(cos);
        let point = |g: &mut crate::symbolic::graph::Graph, c: Scalar, s: Scalar| {
            let (c, s) = (g.mul(c, inverse), g.mul(s, inverse));
            g.angle(c, s)
        };
        let roll = point(g, m[2][2], m[2][1]);
        let yaw = point(g, m[0][0], m[1][0]);
        [roll, g.angle(cos, -m[2][0]), yaw]
    }

    fn by_time(&mut self, s: Scalar) -> Scalar {
        Differentiator::new(&[(self.scene.symbols.time, Scalar::ONE)]).scalar(&mut self.g, s)
    }
}
