//! Poses of frames, the velocities that belong to them, and forces with moments.

use super::fields::field_by_field;
use crate::{Configuration, Real, Tangent, rotation};
use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};

/// Where a frame is: position and orientation. Coordinates of a free body, and the type of pose outputs.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pose<T = f64> {
    /// `[m]` position of the origin, in parent (or world) axes
    pub position: Vector3<T>,
    /// orientation; it maps child to parent (or world) components
    pub orientation: UnitQuaternion<T>,
}

/// Where a body is, as the function `poses` of generated models gives it: its rotation as the matrix that it is worked
/// out as, no quaternion taken from it. A point `p` of the body is at `rotation * p + position`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Placement<T = f64> {
    /// `[m]` position of the body's origin, in world axes
    pub position: Vector3<T>,
    /// rotation; it maps body to world components
    pub rotation: Rotation3<T>,
}

/// How a frame moves. As the velocity of a free body it mixes axes: the linear part is in parent axes, the angular
/// part in child axes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<T = f64> {
    /// `[m/s]` velocity of the origin
    pub linear: Vector3<T>,
    /// `[rad/s]` angular velocity
    pub angular: Vector3<T>,
}

/// A force and a moment about the point where the force acts: the type of reactions.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T = f64> {
    /// `[N]` force
    pub force: Vector3<T>,
    /// `[N m]` moment about the frame's origin
    pub moment: Vector3<T>,
}

field_by_field! { tangent Twist { linear, angular } }
field_by_field! { tangent Wrench { force, moment } }

/// The identity, at the origin.
impl<T: Real> Default for Pose<T> {
    #[inline]
    fn default() -> Self {
        let (zero, one) = (T::lit(0.0), T::lit(1.0));
        Self {
            position: Tangent::zero(),
            orientation: UnitQuaternion::new_unchecked(Quaternion::new(one, zero, zero, zero)),
        }
    }
}

/// The identity, at the origin.
impl<T: Real> Default for Placement<T> {
    #[inline]
    fn default() -> Self {
        Self { position: Tangent::zero(), rotation: Rotation3::identity() }
    }
}

/// Equality of components.
impl<T: nalgebra::Scalar> PartialEq for Placement<T> {
    fn eq(&self, other: &Self) -> bool {
        self.position == other.position && self.rotation == other.rotation
    }
}

/// Equality of components: `q` and `-q` are the same rotation and yet two poses.
impl<T: PartialEq> PartialEq for Pose<T> {
    fn eq(&self, other: &Self) -> bool {
        self.position == other.position && self.orientation.as_ref().coords == other.orientation.as_ref().coords
    }
}

impl<T: Real> Configuration<T> for UnitQuaternion<T> {
    /// Angular velocity of the child relative to the parent, in child axes.
    type Velocity = Vector3<T>;

    #[inline]
    fn displace(&self, d: &Vector3<T>) -> Self {
        rotation::displace(self, d)
    }
    #[inline]
    fn advance(&self, d: &Vector3<T>, rest: &Vector3<T>) -> (Self, Vector3<T>) {
        rotation::advance(self, d, rest)
    }
    #[inline]
    fn dexp_inv(d: &Vector3<T>, v: &Vector3<T>) -> Vector3<T> {
        rotation::dexp_inv(d, v)
    }
    #[inline]
    fn compose(first: &Vector3<T>, second: &Vector3<T>) -> Vector3<T> {
        rotation::compose(first, second)
    }
    /// The square of the quaternion's length: one, or NaN where the quaternion is no longer a number.
    #[inline]
    fn magnitude(&self) -> Vector3<T> {
        let c = &self.as_ref().coords;
        let square = c.w * c.w + c.x * c.x + c.y * c.y + c.z * c.z;
        Vector3::new(square, square, square)
    }
}

impl<T: Real> Configuration<T> for Pose<T> {
    type Velocity = Twist<T>;

    #[inline]
    fn displace(&self, d: &Twist<T>) -> Self {
        Self {
            position: Configuration::displace(&self.position, &d.linear),
            orientation: Configuration::displace(&self.orientation, &d.angular),
        }
    }
    #[inline]
    fn advance(&self, d: &Twist<T>, rest: &Twist<T>) -> (Self, Twist<T>) {
        let (position, linear) = Configuration::advance(&self.position, &d.linear, &rest.linear);
        let (orientation, angular) = Configuration::advance(&self.orientation, &d.angular, &rest.angular);
        (Self { position, orientation }, Twist { linear, angular })
    }
    #[inline]
    fn dexp_inv(d: &Twist<T>, v: &Twist<T>) -> Twist<T> {
        Twist { linear: v.linear, angular: rotation::dexp_inv(&d.angular, &v.angular) }
    }
    #[inline]
    fn compose(first: &Twist<T>, second: &Twist<T>) -> Twist<T> {
        Twist {
            linear: Tangent::add(&first.linear, &second.linear),
            angular: rotation::compose(&first.angular, &second.angular),
        }
    }
    #[inline]
    fn magnitude(&self) -> Twist<T> {
        Twist { linear: self.position, angular: Configuration::magnitude(&self.orientation) }
    }
}
