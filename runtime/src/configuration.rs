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
/// implement the trait field by field. Equality is that of all components.
pub trait Configuration<T: Real>: Copy + PartialEq {
    /// The velocities that belong to these coordinates.
    type Velocity: Tangent<T>;

    /// The position after the displacement `d`: `self + d`, or `self * exp(d)` for rotations.
    fn displace(&self, d: &Self::Velocity) -> Self;

    /// The position after the displacements `rest` and `d`, and what rounding left out of it, as a displacement that is
    /// still to come: compensated summation. `rest` is of the size of a rounding.
    ///
    /// Written by default as a plain displacement that leaves no rest.
    #[inline]
    fn advance(&self, d: &Self::Velocity, rest: &Self::Velocity) -> (Self, Self::Velocity) {
        (self.displace(&d.add(rest)), Self::Velocity::zero())
    }

    /// The rate of the displacement `d` while the velocity is `v`: `v` itself where a displacement is a sum, the
    /// inverse of the exponential's differential where it is a rotation. With `v` in its place there, every
    /// Runge-Kutta method falls to second order.
    fn dexp_inv(d: &Self::Velocity, v: &Self::Velocity) -> Self::Velocity;

    /// The displacement that does the work of two, `first` and then `second`: their sum, or `log(exp(first) exp(second))`
    /// for rotations.
    ///
    /// Written by default as a sum.
    #[inline]
    fn compose(first: &Self::Velocity, second: &Self::Velocity) -> Self::Velocity {
        first.add(second)
    }

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
    fn advance(&self, d: &T, rest: &T) -> (T, T) {
        compensated_sum(*self, *d + *rest)
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
    fn advance(&self, d: &Self, rest: &Self) -> (Self, Self) {
        advanced(self, d, rest)
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
    fn advance(&self, d: &Self::Velocity, rest: &Self::Velocity) -> (Self, Self::Velocity) {
        let (mut result, mut left) = (*self, *rest);
        for ((q, left), d) in result.iter_mut().zip(left.iter_mut()).zip(d) {
            (*q, *left) = q.advance(d, left);
        }
        (result, left)
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
    fn compose(first: &Self::Velocity, second: &Self::Velocity) -> Self::Velocity {
        let mut result = *second;
        for (second, first) in result.iter_mut().zip(first) {
            *second = Q::compose(first, second);
        }
        result
    }
    #[inline]
    fn magnitude(&self) -> Self::Velocity {
        self.map(|q| q.magnitude())
    }
}

/// `a + b` and its rounding error, whichever is greater (Knuth's two-sum).
#[inline]
pub(crate) fn compensated_sum<T: Real>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The compensated sum of a vector and two displacements.
#[inline]
pub(crate) fn advanced<T: Real, V: Tangent<T>>(v: &V, d: &V, rest: &V) -> (V, V) {
    let d = d.add(rest);
    (v.add(&d), v.zip(&d, &mut |v, d| compensated_sum(v, d).1))
}
