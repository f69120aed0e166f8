//! Stage `model`: the units of what the language itself has.
//!
//! In: nothing. Out: one constant for each kind of quantity: what it is, and its unit, in which the generated code
//! computes.

use crate::model::joint_kinds::JointKind;
use crate::model::types::{FrameQuantity, Order, SystemQuantity};

use super::dimension::Unit;

/// A quantity of the language.
#[derive(Clone, Copy, Debug)]
pub(in crate::model) struct Quantity {
    /// With its article, for messages.
    pub(super) what: &'static str,
    /// As people write it.
    pub(super) text: &'static str,
    pub(super) unit: Unit,
}

/// By exponents of m, kg, s.
const fn quantity(what: &'static str, text: &'static str, [m, kg, s]: [i32; 3]) -> Quantity {
    Quantity { what, text, unit: Unit::si([m, kg, s, 0, 0, 0, 0]) }
}

pub(in crate::model) const MASS: Quantity = quantity("a mass", "kg", [0, 1, 0]);
pub(in crate::model) const INERTIA: Quantity = quantity("an inertia", "kg m^2", [2, 1, 0]);
pub(in crate::model) const LENGTH: Quantity = quantity("a length", "m", [1, 0, 0]);
pub(super) const ANGLE: Quantity = quantity("an angle", "rad", [0, 0, 0]);
pub(super) const NUMBER: Quantity = quantity("a number", "1", [0, 0, 0]);
pub(super) const TIME: Quantity = quantity("time", "s", [0, 0, 1]);
pub(super) const VELOCITY: Quantity = quantity("a velocity", "m/s", [1, 0, -1]);
pub(super) const ANGULAR_VELOCITY: Quantity = quantity("an angular velocity", "rad/s", [0, 0, -1]);
pub(super) const ACCELERATION: Quantity = quantity("an acceleration", "m/s^2", [1, 0, -2]);
pub(super) const ANGULAR_ACCELERATION: Quantity = quantity("an angular acceleration", "rad/s^2", [0, 0, -2]);
pub(super) const FORCE: Quantity = quantity("a force", "N", [1, 1, -2]);
pub(super) const TORQUE: Quantity = quantity("a torque", "N m", [2, 1, -2]);
pub(super) const MOMENTUM: Quantity = quantity("a momentum", "kg m/s", [1, 1, -1]);
pub(super) const ANGULAR_MOMENTUM: Quantity = quantity("an angular momentum", "kg m^2/s", [2, 1, -1]);
pub(super) const ENERGY: Quantity = quantity("an energy", "J", [2, 1, -2]);
pub(super) const POWER: Quantity = quantity("a power", "W", [2, 1, -3]);
pub(super) const PITCH: Quantity = quantity("a pitch", "m/rad", [1, 0, 0]);
pub(super) const STABILISING_RATE: Quantity = quantity("the stabilisation's `rate`", "1/s", [0, 0, -1]);
pub(super) const STABILISING_POSITION: Quantity = quantity("the stabilisation's `position`", "1/s^2", [0, 0, -2]);

/// What belongs to a coordinate that slides, or turns.
pub(super) struct OfCoordinate {
    pub(super) position: Quantity,
    pub(super) rate: Quantity,
    acceleration: Quantity,
    pub(super) effort: Quantity,
    pub(super) stiffness: Quantity,
    pub(super) damping: Quantity,
    pub(super) armature: Quantity,
}

pub(super) static SLIDES: OfCoordinate = OfCoordinate {
    position: LENGTH,
    rate: VELOCITY,
    acceleration: ACCELERATION,
    effort: FORCE,
    stiffness: quantity("the stiffness along a line", "N/m", [0, 1, -2]),
    damping: quantity("the damping along a line", "N s/m", [0, 1, -1]),
    armature: quantity("the armature of a coordinate that slides", "kg", [0, 1, 0]),
};

static TURNS: OfCoordinate = OfCoordinate {
    position: ANGLE,
    rate: ANGULAR_VELOCITY,
    acceleration: ANGULAR_ACCELERATION,
    effort: TORQUE,
    stiffness: quantity("the stiffness about an axis", "N m/rad", [2, 1, -2]),
    damping: quantity("the damping about an axis", "N m s/rad", [2, 1, -1]),
    armature: quantity("the armature of a coordinate that turns", "kg m^2", [2, 1, 0]),
};

impl OfCoordinate {
    /// By the number of a velocity coordinate.
    pub(super) fn of(kind: &JointKind, index: usize) -> &'static OfCoordinate {
        if kind.is_slide(index) { &SLIDES } else { &TURNS }
    }

    pub(super) fn order(&self, order: Order) -> Quantity {
        match order {
            Order::Position => self.position,
            Order::Rate => self.rate,
            Order::Acceleration => self.acceleration,
        }
    }
}

/// `None`: several units, or none.
pub(super) fn of_frame(quantity: FrameQuantity) -> Option<Quantity> {
    match quantity {
        FrameQuantity::Position => Some(LENGTH),
        FrameQuantity::Velocity => Some(VELOCITY),
        FrameQuantity::AngularVelocity => Some(ANGULAR_VELOCITY),
        FrameQuantity::Acceleration => Some(ACCELERATION),
        FrameQuantity::AngularAcceleration => Some(ANGULAR_ACCELERATION),
        FrameQuantity::Rotation | FrameQuantity::Pose | FrameQuantity::Twist => None,
    }
}

/// Of several bodies as one.
pub(super) fn of_system(quantity: SystemQuantity) -> Quantity {
    match quantity {
        SystemQuantity::TotalMass => MASS,
        SystemQuantity::CentreOfMass => LENGTH,
        SystemQuantity::CentreOfMassVelocity => VELOCITY,
        SystemQuantity::CentreOfMassAcceleration => ACCELERATION,
        SystemQuantity::LinearMomentum => MOMENTUM,
        SystemQuantity::AngularMomentum => ANGULAR_MOMENTUM,
    }
}
