//! Stage `model`: frames and the directions of joints in f64, at what an evaluator takes for the params.
//!
//! In: expressions of literals and params. Out: poses and unit vectors; nothing where an expression has no value.

use crate::model::types::{Directions, Frame, FrameStep};

use super::evaluate::{Evaluator, cross, dot};
use super::matrix3::{IDENTITY, Matrix3, Vector3, add, product, rotation, scale, sub, times, transpose, unit};

/// Orientation (columns are the axes) and origin of a frame.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) rotation: Matrix3,
    pub(crate) position: Vector3,
}

impl Pose {
    pub(super) const IDENTITY: Pose = Pose { rotation: IDENTITY, position: [0.0; 3] };

    pub(super) fn then(&self, next: &Pose) -> Pose {
        Pose {
            rotation: product(&self.rotation, &next.rotation),
            position: add(self.position, times(&self.rotation, next.position)),
        }
    }

    pub(super) fn inverse(&self) -> Pose {
        let rotation = transpose(self.rotation);
        Pose { rotation, position: scale(-1.0, times(&rotation, self.position)) }
    }
}

/// Of a frame in its body.
pub(crate) fn pose(evaluator: &mut Evaluator, frame: &Frame) -> Option<Pose> {
    let mut pose = Pose::IDENTITY;
    for step in &frame.steps {
        let mut next = Pose::IDENTITY;
        match step {
            FrameStep::At(offset) => next.position = evaluator.vector(offset)?,
            FrameStep::Rotated(axis, angle) => {
                let axis = evaluator.vector(axis)?;
                next.rotation = rotation(axis, evaluator.scalar(angle)?);
            }
            FrameStep::Oriented(rows) => {
                for (row, exprs) in next.rotation.iter_mut().zip(rows.iter()) {
                    for (entry, expr) in row.iter_mut().zip(exprs) {
                        *entry = evaluator.scalar(expr)?;
                    }
                }
            }
        }
        pose = pose.then(&next);
    }
    Some(pose)
}

/// How far what stands in a frame is from the rotation that it is meant to be: for matrices the largest entry of the sum of
/// M M' - 1, for angles their last digit.
pub(crate) fn defect(evaluator: &mut Evaluator, frame: &Frame) -> Option<f64> {
    let mut most = 0.0;
    for step in &frame.steps {
        match step {
            FrameStep::At(_) => continue,
            FrameStep::Rotated(_, angle) => {
                most += evaluator.scalar(angle)?.abs() * f64::EPSILON;
                continue;
            }
            FrameStep::Oriented(_) => {}
        }
        let alone = Frame { steps: vec![step.clone()], ..frame.clone() };
        let m = pose(evaluator, &alone)?.rotation;
        let square = product(&m, &transpose(m));
        let off = square.iter().flatten().zip(IDENTITY.iter().flatten()).map(|(x, one)| (x - one).abs());
        most += off.fold(0.0, f64::max);
    }
    Some(most)
}

/// Unit vectors along a joint's directions. Of one axis that is written the two others are any across it.
pub(crate) fn directions(evaluator: &mut Evaluator, directions: &Directions) -> Option<[Vector3; 3]> {
    let mut axis = |axis| evaluator.vector(axis).map(unit);
    Some(match directions {
        Directions::Frame => IDENTITY,
        Directions::Axis(written) => {
            let axis = axis(written)?;
            let [second, third] = across(axis);
            [axis, second, third]
        }
        Directions::Crossed(axes) => {
            let [first, second] = axes.each_ref().map(axis);
            let (first, second) = (first?, second?);
            [first, second, cross(first, second)]
        }
        Directions::Slot(axes) => {
            let [axis, slide] = axes.each_ref().map(axis);
            let axis = axis?;
            let third = unit(cross(axis, slide?));
            [axis, cross(third, axis), third]
        }
        Directions::Plane(axes) => {
            let [first, second] = axes.each_ref().map(axis);
            let first = first?;
            let normal = unit(cross(first, second?));
            [normal, first, cross(normal, first)]
        }
    })
}

/// Two directions across a third: the axis that follows its largest component, cyclically, then the last one.
fn across(n: Vector3) -> [Vector3; 2] {
    let [a, b, c] = n.map(f64::abs);
    let [x, y, z] = IDENTITY;
    let near = if c >= a && c >= b {
        x
    } else if a >= b {
        y
    } else {
        z
    };
    let first = unit(sub(near, scale(dot(near, n), n)));
    [first, cross(n, first)]
}
