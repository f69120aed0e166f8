//! Stage `model`: spatial vectors and inertias in f64 (Featherstone 2008, chapter 2), angular part first.
//!
//! In: numbers. Out: the few products that the check of the mass matrix needs.

use super::configuration::Motion;
use super::evaluate::cross;
use super::matrix3::{Matrix3, Vector3, add, scale, sub, times, transpose};

pub(super) type Vector6 = [f64; 6];
pub(super) type Matrix6 = [[f64; 6]; 6];

pub(in crate::model) fn join([a, b, c]: Vector3, [d, e, f]: Vector3) -> Vector6 {
    [a, b, c, d, e, f]
}

fn parts([a, b, c, d, e, f]: Vector6) -> (Vector3, Vector3) {
    ([a, b, c], [d, e, f])
}

pub(super) fn dot6(a: &Vector6, b: &Vector6) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(in crate::model) fn apply(matrix: &Matrix6, vector: &Vector6) -> Vector6 {
    matrix.map(|row| dot6(&row, vector))
}

/// `|v|' |M| |v|`: the size of `v' M v` if nothing cancelled.
pub(in crate::model) fn magnitude(matrix: &Matrix6, vector: &Vector6) -> f64 {
    let size = vector.map(f64::abs);
    let rows = matrix.map(|row| dot6(&row.map(f64::abs), &size));
    dot6(&rows, &size)
}

pub(super) fn accumulate(sum: &mut Matrix6, term: &Matrix6) {
    for (a, b) in sum.iter_mut().flatten().zip(term.iter().flatten()) {
        *a += b;
    }
}

/// Subtracts `f f' / pivot`.
pub(super) fn deflate(matrix: &mut Matrix6, force: &Vector6, pivot: f64) {
    for (row, x) in matrix.iter_mut().zip(force) {
        for (entry, y) in row.iter_mut().zip(force) {
            *entry -= x * y / pivot;
        }
    }
}

/// Inertia of a body about the origin, from mass, centre of mass and the tensor about it.
pub(in crate::model) fn inertia(mass: f64, com: Vector3, tensor: &Matrix3) -> Matrix6 {
    columns(|velocity| {
        let (angular, linear) = parts(velocity);
        let momentum = scale(mass, add(linear, cross(angular, com)));
        join(add(times(tensor, angular), cross(com, momentum)), momentum)
    })
}

/// The inertia of a child, seen in the axes and at the origin of its parent's frame.
pub(super) fn shifted(matrix: &Matrix6, motion: &Motion) -> Matrix6 {
    let (rotation, back, p) = (motion.rotation, transpose(motion.rotation), motion.position);
    columns(|velocity| {
        let (angular, linear) = parts(velocity);
        let here = join(times(&back, angular), times(&back, add(linear, cross(angular, p))));
        let (moment, force) = parts(apply(matrix, &here));
        let force = times(&rotation, force);
        let moment = sub(times(&rotation, moment), cross(force, p));
        join(moment, force)
    })
}

/// A symmetric matrix from its columns.
fn columns(column: impl Fn(Vector6) -> Vector6) -> Matrix6 {
    let mut matrix = [[0.0; 6]; 6];
    for (k, row) in matrix.iter_mut().enumerate() {
        let mut basis = [0.0; 6];
        basis[k] = 1.0;
        *row = column(basis);
    }
    matrix
}
