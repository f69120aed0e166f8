//! A robot as links and joints, as URDF and its kin have it. Numbers are the text of the file.

use std::ops::Range;

use super::number::Number;

/// Something with its place in the file, in bytes.
#[derive(Clone, Debug)]
pub(super) struct Placed<T> {
    pub(super) value: T,
    pub(super) at: Range<usize>,
}

#[derive(Debug)]
pub(super) struct Robot {
    pub(super) name: Placed<String>,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
}

#[derive(Debug)]
pub(super) struct Link {
    pub(super) name: Placed<String>,
    /// Nothing where the link is a frame alone.
    pub(super) inertial: Option<Inertial>,
}

#[derive(Debug)]
pub(super) struct Inertial {
    /// The frame of the inertia, whose origin is the centre of mass.
    pub(super) origin: Origin,
    pub(super) mass: Number,
    /// xx, yy, zz, xy, xz, yz in the axes of `origin`.
    pub(super) inertia: [Number; 6],
    pub(super) at: Range<usize>,
}

/// A frame in another one.
#[derive(Debug)]
pub(super) struct Origin {
    /// `[m]`
    pub(super) xyz: [Number; 3],
    /// `[rad]` roll, pitch, yaw: the rotation is Rz(yaw) Ry(pitch) Rx(roll).
    pub(super) rpy: [Number; 3],
}

#[derive(Debug)]
pub(super) struct Joint {
    pub(super) name: Placed<String>,
    pub(super) kind: Kind,
    /// The child's frame in the parent's, where all coordinates are zero.
    pub(super) origin: Origin,
    pub(super) parent: Placed<String>,
    pub(super) child: Placed<String>,
    pub(super) axis: [Number; 3],
    /// `[N m s/rad]` or `[N s/m]`
    pub(super) damping: Option<Placed<Number>>,
    pub(super) mimic: Option<Mimic>,
    pub(super) at: Range<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Revolute,
    Prismatic,
    Fixed,
    Floating,
    Planar,
}

/// The coordinate is `multiplier` times that of `joint`, plus `offset`.
#[derive(Debug)]
pub(super) struct Mimic {
    pub(super) joint: Placed<String>,
    pub(super) multiplier: Number,
    pub(super) offset: Number,
    pub(super) at: Range<usize>,
}
