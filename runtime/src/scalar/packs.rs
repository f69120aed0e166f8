//! Four numbers that are worked with together: [`Four`], [`Packed`].
//!
//! Generated code puts what several limbs compute alike into one pack. Of `f64` and `f32` a pack is a vector of the processor, with
//! the feature `wide`; of any other scalar it is an array, member by member, so dual numbers, lanes and small machines take the
//! same code. Every operation is that of the scalar on each member, rounded as it is there: no value depends on what a pack is.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;
#[cfg(feature = "wide")]
use super::float::FUSED;

/// Four of a scalar, whose operations are those of the scalar on each of them.
pub trait Packed<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// From its members.
    fn of(members: [T; 4]) -> Self;
    /// Its members.
    fn members(self) -> [T; 4];
    /// The square root of each.
    #[must_use]
    fn roots(self) -> Self;
    /// [`Real::mul_add`] of each.
    #[must_use]
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}

/// A pack of any scalar: an array, worked with member by member.
///
/// ```
/// use multibody::{Four, Packed};
///
/// let sum = Four::of([1.0, 2.0, 3.0, 4.0]) + Four::of([0.5; 4]);
/// assert_eq!(sum.members(), [1.5, 2.5, 3.5, 4.5]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Four<T>([T; 4]);

macro_rules! member_by_member {
    ($($trait:ident $name:ident $operator:tt)+) => { $(
        impl<T: Real> $trait for Four<T> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // Written out: a loop over arrays stays one in code that is optimised for size.
                let ([a, b, c, d], [x, y, z, w]) = (self.0, other.0);
                Four([a $operator x, b $operator y, c $operator z, d $operator w])
            }
        }
    )+ };
}

member_by_member! { Add add +  Sub sub -  Mul mul *  Div div / }

impl<T: Real> Neg for Four<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let [a, b, c, d] = self.0;
        Four([-a, -b, -c, -d])
    }
}

impl<T: Real> Packed<T> for Four<T> {
    #[inline(always)]
    fn of(members: [T; 4]) -> Self {
        Four(members)
    }
    #[inline(always)]
    fn members(self) -> [T; 4] {
        self.0
    }
    #[inline(always)]
    fn roots(self) -> Self {
        let [a, b, c, d] = self.0;
        Four([Real::sqrt(a), Real::sqrt(b), Real::sqrt(c), Real::sqrt(d)])
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        let ([a, b, c, d], [x, y, z, w], [p, q, r, s]) = (self.0, factor.0, addend.0);
        Four([Real::mul_add(a, x, p), Real::mul_add(b, y, q), Real::mul_add(c, z, r), Real::mul_add(d, w, s)])
    }
}

#[cfg(feature = "wide")]
macro_rules! vectors {
    ($($float:ident $lanes:ident $vector:ident)+) => { $(
        impl Packed<$float> for simba::simd::$lanes {
            #[inline(always)]
            fn of(members: [$float; 4]) -> Self {
                Self(wide::$vector::new(members))
            }
            #[inline(always)]
            fn members(self) -> [$float; 4] {
                self.0.to_array()
            }
            #[inline(always)]
            fn roots(self) -> Self {
                Self(self.0.sqrt())
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if FUSED { Self(self.0.mul_add(factor.0, addend.0)) } else { self * factor + addend }
            }
        }
    )+ };
}

#[cfg(feature = "wide")]
vectors! { f64 WideF64x4 f64x4  f32 WideF32x4 f32x4 }
