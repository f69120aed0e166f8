//! [`Real`] for `f32`: the functions of [`super::float`].

use super::Real;
use super::float::single;

impl Real for f32 {
    type Mask = bool;
    #[cfg(feature = "wide")]
    type Two = super::packs::Vector<wide::f32x4>;
    #[cfg(not(feature = "wide"))]
    type Two = super::Two<f32>;
    #[cfg(feature = "wide")]
    type Four = simba::simd::WideF32x4;
    #[cfg(not(feature = "wide"))]
    type Four = super::Four<f32>;

    #[inline(always)]
    fn lit(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        single::mul_add(self, factor, addend)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        single::sin_cos(self)
    }
    #[cfg(all(feature = "std", feature = "wide", not(any(feature = "reproducible", feature = "std-sines"))))]
    #[inline]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        super::vectors::f32::sin_cos(angles)
    }
    #[inline]
    fn tan(self) -> Self {
        single::tan(self)
    }
    #[inline]
    fn asin(self) -> Self {
        single::asin(self)
    }
    #[inline]
    fn acos(self) -> Self {
        single::acos(self)
    }
    #[inline]
    fn atan(self) -> Self {
        single::atan(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        single::atan2(self, x)
    }
    #[inline]
    fn sinh(self) -> Self {
        single::sinh(self)
    }
    #[inline]
    fn cosh(self) -> Self {
        single::cosh(self)
    }
    #[inline]
    fn tanh(self) -> Self {
        single::tanh(self)
    }
    #[inline]
    fn exp(self) -> Self {
        single::exp(self)
    }
    #[inline]
    fn ln(self) -> Self {
        single::ln(self)
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        single::powf(self, exponent)
    }
    #[inline]
    fn sqrt(self) -> Self {
        single::sqrt(self)
    }
    #[inline]
    fn hypot(self, other: Self) -> Self {
        single::hypot(self, other)
    }
    #[inline]
    fn abs(self) -> Self {
        f32::abs(self)
    }
    #[inline]
    fn signum(self) -> Self {
        if self > 0.0 {
            1.0
        } else if self < 0.0 {
            -1.0
        } else {
            self
        }
    }
    #[inline]
    fn floor(self) -> Self {
        single::floor(self)
    }
    #[inline]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline]
    fn eq(self, other: Self) -> bool {
        self == other
    }
    #[inline]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline]
    fn greatest(self) -> f64 {
        f64::from(self)
    }
}
