//! Coordinates of joints that have several of them, and the poses, twists and wrenches of bodies.
//!
//! The joint structs hold positions and, with the same names, velocities: their velocities are the rates of the
//! coordinates. [`Pose`] is different, its velocity is a [`Twist`]; so is nalgebra's unit quaternion, whose velocity is
//! an angular velocity in child axes.

mod fields;
mod joint;
mod spatial;

pub use joint::{Cylindrical, FreeRollPitchYaw, PinSlot, Planar, RollPitchYaw, Universal};
pub use spatial::{Placement, Pose, Twist, Wrench};
