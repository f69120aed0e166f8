//! What integrators ask of positions: [`Configuration`].
//!
//! Positions need not form a vector space: a rotation has no sum. They form a manifold on which a velocity, held for
//! a while, displaces a position. Runge-Kutta methods then work in the coordinates of that displacement (Munthe-Kaas
//! 1998; Hairer, Lubich and Wanner, Geometric Numerical Integration, section IV.8).

use crate::{Real, Tangent};
use nalgebra::SVector;

/// A position: the coordinates of one joint, or of a whole model.
///
/// Scalars and vectors are displaced by a sum, unit quaternions by the exponential of a rotation. Generated structs
/// implement the trait field by field.
pub trait Configuration<T: Real>: Copy {
    /// The velocities that belong to these coordinates.
    type Velocity: Tangent<T>;

    /// The position after the displacement `d`: `self + d`, or `self * exp(d)` for rotations.
    fn displace(&self, d: &Self::Velocity) -> Self;

    /// The rate of the displacement `d` while the velocity is `v`: `v` itself where a displacement is a sum, the
    /// inverse of the exponential's differential where it is a rotation. With `v` in its place there, every
    /// Runge-Kutta method falls to second order.
    fn dexp_inv(d: &Self::Velocity, v: &Self::Velocity) -> Self::Velocity;

    /// The size of every coordinate, for relative tolerances: the coordinate itself (its sign does not matter), or
    /// one (radian) for rotations, which have no size.
    fn magnitude(&self) -> Self::Velocity;
}

impl<T: Real> Configuration<T> for () {
    type Velocity = ();

    #[inline]
    fn displace(&self, _: &()) -> Self {}
    #[inline]
    fn dexp_inv(_: &(), _: &()) {}
    #[inline]
    fn magnitude(&self) {}
}

impl<T: Real> Configuration<T> for T {
    type Velocity = T;

    #[inline]
    fn displace(&self, d: &T) -> Self {
        *self + *d
    }
    #[inline]
    fn dexp_inv(_: &T, v: &T) -> T {
        *v
    }
    #[inline]
    fn magnitude(&self) -> T {
        *self
    }
}

impl<T: Real, const N: usize> Configuration<T> for SVector<T, N> {
    type Velocity = Self;

    #[inline]
    fn displace(&self, d: &Self) -> Self {
        Tangent::add(self, d)
    }
    #[inline]
    fn dexp_inv(_: &Self, v: &Self) -> Self {
        *v
    }
    #[inline]
    fn magnitude(&self) -> Self {
        *self
    }
}

impl<T: Real, Q: Configuration<T>, const N: usize> Configuration<T> for [Q; N] {
    type Velocity = [Q::Velocity; N];

    #[inline]
    fn displace(&self, d: &Self::Velocity) -> Self {
        let mut result = *self;
        for (q, d) in result.iter_mut().zip(d) {
            *q = q.displace(d);
        }
        result
    }
    #[inline]
    fn dexp_inv(d: &Self::Velocity, v: &Self::Velocity) -> Self::Velocity {
        let mut result = *v;
        for (v, d) in result.iter_mut().zip(d) {
            *v = Q::dexp_inv(d, v);
        }
        result
    }
    #[inline]
    fn magnitude(&self) -> Self::Velocity {
        self.map(|q| q.magnitude())
    }
}
