//! Coordinates of joints with more than one, by name. Angles are in radians, lengths in metres; where a struct holds
//! velocities, all is per second.

use super::fields::field_by_field;
use nalgebra::Vector3;

/// Coordinates of a universal joint: it turns about its first axis, then about the second, which the first carries
/// along.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Universal<T = f64> {
    /// `[rad]` angle about the first axis, which the parent carries
    pub first: T,
    /// `[rad]` angle about the second axis
    pub second: T,
}

/// Coordinates of a cylindrical joint: it slides along its axis and turns about it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylindrical<T = f64> {
    /// `[m]` displacement along the axis
    pub travel: T,
    /// `[rad]` angle about the axis
    pub angle: T,
}

/// Coordinates of a planar joint: it slides in a plane and turns about the plane's normal.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planar<T = f64> {
    /// `[m]` first displacement, in parent axes: along the first of `axes`, if these are given
    pub x: T,
    /// `[m]` second displacement, in parent axes: along the second of `axes`
    pub y: T,
    /// `[rad]` angle about the normal
    pub angle: T,
}

/// Coordinates of a pin in a slot: it slides along the slot, which the parent carries, and turns about an axis across it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinSlot<T = f64> {
    /// `[m]` displacement along the slot
    pub travel: T,
    /// `[rad]` angle about the axis
    pub angle: T,
}

/// Roll, pitch and yaw: the rotation `Rz(yaw) * Ry(pitch) * Rx(roll)` from child to parent components.
///
/// Singular at a pitch of a right angle, where roll and yaw turn about one axis.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollPitchYaw<T = f64> {
    /// `[rad]` angle about x, applied first
    pub roll: T,
    /// `[rad]` angle about y
    pub pitch: T,
    /// `[rad]` angle about z, applied last
    pub yaw: T,
}

/// Coordinates of a free body with [`RollPitchYaw`] angles, or their rates.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRollPitchYaw<T = f64> {
    /// `[m]` position of the child's origin, in parent axes
    pub position: Vector3<T>,
    /// `[rad]` orientation of the child in the parent
    pub orientation: RollPitchYaw<T>,
}

field_by_field! { coordinates Universal { first, second } }
field_by_field! { coordinates Cylindrical { travel, angle } }
field_by_field! { coordinates Planar { x, y, angle } }
field_by_field! { coordinates PinSlot { travel, angle } }
field_by_field! { coordinates RollPitchYaw { roll, pitch, yaw } }
field_by_field! { coordinates FreeRollPitchYaw { position, orientation } }
