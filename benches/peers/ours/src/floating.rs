//! A floating base in the common coordinates, which are Pinocchio's, and in this library's.
//!
//! Angular velocities are in the base's own axes in both. Of its origin this library takes velocity and acceleration in the
//! ground's axes, the others in the base's, where a = R (a' + w x v').

use multibody::nalgebra::{DMatrix, Matrix3, Quaternion, UnitQuaternion, Vector3};
use multibody::{Pose, Twist};

/// From a point and a quaternion, real part last.
pub fn pose(q: &[f64]) -> Pose<f64> {
    Pose {
        position: Vector3::from_column_slice(&q[..3]),
        orientation: UnitQuaternion::new_unchecked(Quaternion::new(q[6], q[3], q[4], q[5])),
    }
}

/// From linear and angular velocity in the base's axes.
pub fn velocity(pose: &Pose<f64>, v: &[f64]) -> Twist<f64> {
    let (linear, angular) = (Vector3::from_column_slice(&v[..3]), Vector3::from_column_slice(&v[3..6]));
    Twist { linear: pose.orientation * linear, angular }
}

/// Acceleration, to the base's axes.
pub fn accel(pose: &Pose<f64>, v: &Twist<f64>, a: &Twist<f64>) -> [f64; 6] {
    let linear = pose.orientation.inverse() * a.linear - v.angular.cross(&(pose.orientation.inverse() * v.linear));
    [linear.x, linear.y, linear.z, a.angular.x, a.angular.y, a.angular.z]
}

/// The matrix that takes the others' velocities to ours.
fn turned(pose: &Pose<f64>, size: usize) -> DMatrix<f64> {
    let mut turned = DMatrix::identity(size, size);
    turned.fixed_view_mut::<3, 3>(0, 0).copy_from(pose.orientation.to_rotation_matrix().matrix());
    turned
}

/// The mass matrix that goes with the others' velocities.
pub fn mass(pose: &Pose<f64>, ours: &DMatrix<f64>) -> DMatrix<f64> {
    let turned = turned(pose, ours.nrows());
    turned.transpose() * ours * &turned
}

/// Derivatives of accelerations by displacement, velocity and efforts of joints, from ours to the others'.
///
/// The base is displaced in its own axes there, and takes its velocities along: a displacement by an angle d changes our
/// linear velocity by R (d x v').
pub fn derivatives(pose: &Pose<f64>, v: &Twist<f64>, a: &Twist<f64>, ours: [DMatrix<f64>; 3]) -> [DMatrix<f64>; 3] {
    let [by_position, by_velocity, by_effort] = ours;
    let turned = turned(pose, by_position.nrows());
    let matrix: Matrix3<f64> = *pose.orientation.to_rotation_matrix().matrix();
    let back = matrix.transpose();
    let (own_v, own_a) = (back * v.linear, back * a.linear);
    let mut moved = by_position * &turned;
    let carried = by_velocity.columns(0, 3) * (-matrix * own_v.cross_matrix());
    moved.columns_mut(3, 3).zip_apply(&carried, |entry, more| *entry += more);
    let by_velocity = by_velocity * &turned;
    // a' = R^T a - w x v', whose parts are differentiated one by one.
    let mut position = turned.transpose() * moved;
    let mut velocity = turned.transpose() * by_velocity;
    let add = |matrix: &mut DMatrix<f64>, column: usize, block: Matrix3<f64>| {
        let mut view = matrix.fixed_view_mut::<3, 3>(0, column);
        view += block;
    };
    add(&mut position, 3, own_a.cross_matrix());
    add(&mut velocity, 0, -v.angular.cross_matrix());
    add(&mut velocity, 3, own_v.cross_matrix());
    [position, velocity, turned.transpose() * by_effort]
}
