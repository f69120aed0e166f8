//! [`Real`] for simba's lanes: `WideF64x4`, `WideF32x4`, `WideF32x8`.
//!
//! Arithmetic, roots, comparisons and `sin_cos` run in lanes. Functions that models seldom call go lane by lane through
//! the scalar ones, so that they agree with them to the last bit. The vector `sin_cos` reduces by Cody and Waite's
//! three-part pi/2, which is exact only while the multiple of pi/2 is small; beyond [`DOUBLE_LIMIT`] and
//! [`SINGLE_LIMIT`] all lanes take the scalar function, one branch that ordinary angles never enter. So do they
//! with the feature `reproducible`.

use super::Real;
use simba::simd::{SimdPartialOrd, SimdValue, WideBoolF32x4, WideBoolF32x8, WideBoolF64x4};
use simba::simd::{WideF32x4, WideF32x8, WideF64x4};

/// [rad] largest angle that four lanes of `f64` reduce themselves.
const DOUBLE_LIMIT: f64 = 1.0e6;
/// [rad] largest angle that lanes of `f32` reduce themselves.
const SINGLE_LIMIT: f32 = 1.0e3;

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

macro_rules! lanes {
    ($lanes:ident, $mask:ident, $element:ident, $limit:ident) => {
        impl Real for $lanes {
            type Mask = $mask;

            #[inline(always)]
            fn lit(value: f64) -> Self {
                Self::splat(value as $element)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                if cfg!(feature = "reproducible") || self.0.abs().simd_gt(Self::splat($limit).0).any() {
                    return (self.map(Real::sin), self.map(Real::cos));
                }
                let (sin, cos) = self.0.sin_cos();
                (Self(sin), Self(cos))
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

lanes!(WideF64x4, WideBoolF64x4, f64, DOUBLE_LIMIT);
lanes!(WideF32x4, WideBoolF32x4, f32, SINGLE_LIMIT);
lanes!(WideF32x8, WideBoolF32x8, f32, SINGLE_LIMIT);
