//! Stage `solve`: the links of a cycle, and what passes through them unchanged.
//!
//! In: vectors given on one side of a link. Out: the same on its other side, provided that the link's unknown motion
//! doesn't matter: an axis passes through its own revolute joint, a direction through a prismatic one. Unknown symbols
//! therefore never get into what is measured.

use crate::dynamics::tree::Motion;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

/// One element of the cycle. Left is the parent's side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Link {
    /// The right frame in the left one's.
    Known { rotation: Rotation, offset: Vector },
    /// The unknown with this number.
    Free { motion: Motion, unknown: usize },
}

/// Which way a vector is carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

/// What kind of vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Point,
    Direction,
}

impl Link {
    /// A motion whose coordinate is known.
    pub(super) fn moved(g: &mut Graph, motion: Motion, coordinate: Scalar) -> Link {
        match motion {
            Motion::Revolute(axis) => Link::Known { rotation: g.axis_rotation(axis, coordinate), offset: Vector::ZERO },
            Motion::Prismatic(axis) => Link::Known { rotation: Rotation::IDENTITY, offset: g.along(axis, coordinate) },
            Motion::Screw(axis, pitch) => {
                let travel = g.mul(pitch, coordinate);
                Link::Known { rotation: g.axis_rotation(axis, coordinate), offset: g.along(axis, travel) }
            }
            Motion::Ball(orientation) => Link::Known { rotation: orientation.rotation(g), offset: Vector::ZERO },
        }
    }

    /// Whether it is the unknown with this number.
    pub(super) fn is_open(&self, number: usize) -> bool {
        matches!(self, Link::Free { unknown, .. } if *unknown == number)
    }

    /// A vector on the other side, or nothing if that depends on an unknown.
    pub(super) fn carry(self, g: &mut Graph, way: Side, kind: Kind, v: Vector) -> Option<Vector> {
        match self {
            Link::Known { rotation, offset } => Some(match (way, kind) {
                (Side::Left, Kind::Direction) => g.rotate(rotation, v),
                (Side::Right, Kind::Direction) => g.rotate(rotation.transpose(), v),
                (Side::Left, Kind::Point) => {
                    let turned = g.rotate(rotation, v);
                    g.add_vectors(offset, turned)
                }
                (Side::Right, Kind::Point) => {
                    let moved = g.sub_vectors(v, offset);
                    g.rotate(rotation.transpose(), moved)
                }
            }),
            Link::Free { motion, .. } => {
                let passes = match (motion, kind) {
                    (Motion::Prismatic(_), Kind::Direction) => true,
                    (Motion::Revolute(axis), _) | (Motion::Screw(axis, _), Kind::Direction) => is_along(g, v, axis),
                    (Motion::Ball(_), Kind::Point) => v == Vector::ZERO,
                    _ => false,
                };
                passes.then_some(v)
            }
        }
    }
}

/// Whether a vector has no other component.
pub(super) fn is_along(g: &mut Graph, v: Vector, axis: usize) -> bool {
    [1, 2].iter().all(|k| g.component(v, (axis + k) % 3) == Scalar::ZERO)
}

/// A coordinate axis.
pub(super) fn unit(g: &mut Graph, axis: usize) -> Vector {
    g.along(axis, Scalar::ONE)
}
