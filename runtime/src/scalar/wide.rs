//! [`Real`] for simba's lanes: `WideF64x4`, `WideF32x4`, `WideF32x8`.
//!
//! Arithmetic, roots, comparisons and `sin_cos` run in lanes. Functions that models seldom call go lane by lane through
//! the scalar ones, so that they agree with them to the last bit. Sine and cosine are those of [`super::lanes`] where
//! every lane is an ordinary angle; where one is beyond them all take the scalar function, one branch that ordinary angles
//! never enter. So do they with the feature `reproducible`.

use super::Real;
use super::float::FUSED;
use simba::simd::{SimdPartialOrd, SimdValue, WideBoolF32x4, WideBoolF32x8, WideBoolF64x4};
use simba::simd::{WideF32x4, WideF32x8, WideF64x4};

macro_rules! lane_by_lane {
    ($($name:ident)+) => {
        $(
            #[inline]
            fn $name(self) -> Self {
                self.map(Real::$name)
            }
        )+
    };
}

/// Sine and cosine by the scalar function. Out of the way of code that never comes here.
#[cold]
fn one_by_one<L: SimdValue<Element: Real> + Copy>(angles: L) -> (L, L) {
    let (mut sin, mut cos) = (angles, angles);
    for lane in 0..L::LANES {
        let (s, c) = Real::sin_cos(angles.extract(lane));
        sin.replace(lane, s);
        cos.replace(lane, c);
    }
    (sin, cos)
}

macro_rules! lanes {
    ($lanes:ident, $mask:ident, $element:ident, $kernel:ident) => {
        impl Real for $lanes {
            type Mask = $mask;
            type Two = super::Two<Self>;
            type Four = super::Four<Self>;

            #[inline(always)]
            fn lit(value: f64) -> Self {
                Self::splat(value as $element)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                #[cfg(not(feature = "reproducible"))]
                if !super::lanes::$kernel::is_far(self.0) {
                    let (sin, cos) = super::lanes::$kernel::sin_cos(self.0);
                    return (Self(sin), Self(cos));
                }
                one_by_one(self)
            }
            #[inline]
            fn tan(self) -> Self {
                let (sin, cos) = Real::sin_cos(self);
                sin / cos
            }
            lane_by_lane! { asin acos atan sinh cosh tanh exp ln signum }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                self.zip_map(x, Real::atan2)
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                self.zip_map(exponent, Real::powf)
            }
            #[inline]
            fn hypot(self, other: Self) -> Self {
                self.zip_map(other, Real::hypot)
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if FUSED { Self(self.0.mul_add(factor.0, addend.0)) } else { self * factor + addend }
            }
            #[inline]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }
            #[inline]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }
            #[inline]
            fn floor(self) -> Self {
                Self(self.0.floor())
            }
            #[inline]
            fn lt(self, other: Self) -> $mask {
                self.simd_lt(other)
            }
            #[inline]
            fn le(self, other: Self) -> $mask {
                self.simd_le(other)
            }
            #[inline]
            fn eq(self, other: Self) -> $mask {
                self.simd_eq(other)
            }
            #[inline]
            fn select(mask: $mask, a: Self, b: Self) -> Self {
                SimdValue::select(a, mask, b)
            }
            #[inline]
            fn greatest(self) -> f64 {
                self.into_arr().into_iter().fold(f64::NEG_INFINITY, |greatest, lane| Real::max(greatest, lane.into()))
            }
        }
    };
}

lanes!(WideF64x4, WideBoolF64x4, f64, quad);
lanes!(WideF32x4, WideBoolF32x4, f32, single_quad);
lanes!(WideF32x8, WideBoolF32x8, f32, single_octet);
