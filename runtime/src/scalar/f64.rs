//! [`Real`] for `f64`: the functions of [`super::float`].

use super::Real;
use super::float::double;

impl Real for f64 {
    type Mask = bool;
    #[cfg(feature = "wide")]
    type Two = super::packs::Vector<wide::f64x2>;
    #[cfg(not(feature = "wide"))]
    type Two = super::Two<f64>;
    #[cfg(feature = "wide")]
    type Four = simba::simd::WideF64x4;
    #[cfg(not(feature = "wide"))]
    type Four = super::Four<f64>;

    #[inline(always)]
    fn lit(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        double::mul_add(self, factor, addend)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        double::sin_cos(self)
    }
    #[cfg(all(feature = "std", feature = "wide", not(any(feature = "reproducible", feature = "std-sines"))))]
    #[inline]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        super::vectors::f64::sin_cos(angles)
    }
    #[inline]
    fn tan(self) -> Self {
        double::tan(self)
    }
    #[inline]
    fn asin(self) -> Self {
        double::asin(self)
    }
    #[inline]
    fn acos(self) -> Self {
        double::acos(self)
    }
    #[inline]
    fn atan(self) -> Self {
        double::atan(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        double::atan2(self, x)
    }
    #[inline]
    fn sinh(self) -> Self {
        double::sinh(self)
    }
    #[inline]
    fn cosh(self) -> Self {
        double::cosh(self)
    }
    #[inline]
    fn tanh(self) -> Self {
        double::tanh(self)
    }
    #[inline]
    fn exp(self) -> Self {
        double::exp(self)
    }
    #[inline]
    fn ln(self) -> Self {
        double::ln(self)
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        double::powf(self, exponent)
    }
    #[inline]
    fn sqrt(self) -> Self {
        double::sqrt(self)
    }
    #[inline]
    fn hypot(self, other: Self) -> Self {
        double::hypot(self, other)
    }
    #[inline]
    fn abs(self) -> Self {
        f64::abs(self)
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
        double::floor(self)
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
        self
    }
}
