//! The scalar trait of generated code: [`Real`].
//!
//! It stands beside simba's [`SimdRealField`] and does not lean on it for functions, for three reasons: which of
//! simba's functions are exact depends on the features that anyone in the build turned on, its lanes reduce large
//! angles wrongly, and its `min` and `max` lose NaN. A scalar implements this trait one by one: `f32` and `f64`, the
//! lanes of simba, and, with the feature `num-dual`, dual numbers.
//!
//! Generated code calls every method by its path, `multibody::Real::sin_cos(x)`, so that no name can clash with a
//! trait that a user brings into scope.

#[cfg(any(feature = "wide", feature = "reproducible", not(feature = "std")))]
mod circle;
#[cfg(feature = "num-dual")]
mod dual;
mod f32;
mod f64;
pub(crate) mod float;
#[cfg(all(
    feature = "hardware-root",
    not(feature = "std"),
    any(target_arch = "arm", target_arch = "riscv32", target_arch = "riscv64")
))]
mod hardware_root;
#[cfg(all(feature = "wide", not(feature = "reproducible")))]
mod lanes;
mod packs;
mod root;
#[cfg(any(not(feature = "std"), feature = "reproducible"))]
mod software;
mod together;
#[cfg(all(feature = "std", feature = "wide", not(any(feature = "reproducible", feature = "std-sines"))))]
mod vectors;
#[cfg(feature = "wide")]
mod wide;

use nalgebra::{RealField, SimdRealField};
use simba::simd::SimdBool;

pub use packs::{Four, Pack, Packed, Two};

/// A real number, several of them in lanes, or a dual number.
///
/// Comparisons give a [`Real::Mask`], one boolean for each lane, and [`Real::select`] takes it; there is no branch on
/// a value anywhere in generated code. A comparison with NaN is false. Dual numbers compare by their real part.
///
/// ```
/// use multibody::Real;
///
/// fn saturated<T: Real>(x: T) -> T {
///     Real::select(Real::lt(x, T::lit(1.0)), x, T::lit(1.0))
/// }
/// assert_eq!(saturated(0.5_f32), 0.5);
/// assert_eq!(saturated(2.0_f64), 1.0);
/// ```
pub trait Real: SimdRealField<Element: RealField + Copy> + Copy {
    /// The result of a comparison: `bool`, or one boolean for each lane. Masks combine with `&`, `|` and `!`.
    type Mask: SimdBool;
    /// Two of this scalar, see [`Packed`]: a vector of the processor, which has no name of its own, or [`Two<Self>`](Two) for any scalar that
    /// knows no better.
    type Two: Packed<Self, 2>;
    /// Four of this scalar: a vector of the processor, or [`Four<Self>`](Four).
    type Four: Packed<Self, 4>;

    /// A literal, rounded to this scalar's precision and repeated in every lane.
    fn lit(value: f64) -> Self;

    /// The distance from one to the next greater number: 2.2e-16 in double, 1.2e-7 in single precision.
    #[inline]
    fn epsilon() -> Self {
        Self::simd_default_epsilon()
    }

    /// Sine and cosine of one angle in radians, reduced correctly for every finite argument.
    fn sin_cos(self) -> (Self, Self);
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Arcsine, in radians from -pi/2 to pi/2.
    fn asin(self) -> Self;
    /// Arccosine, in radians from 0 to pi.
    fn acos(self) -> Self;
    /// Arctangent, in radians from -pi/2 to pi/2.
    fn atan(self) -> Self;
    /// The angle of the point `(x, self)`, in radians from -pi to pi.
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// The exponential function.
    fn exp(self) -> Self;
    /// The natural logarithm.
    fn ln(self) -> Self;
    /// `self` to the power of `exponent`.
    fn powf(self, exponent: Self) -> Self;
    /// The square root.
    fn sqrt(self) -> Self;
    /// The length of the hypotenuse over `self` and `other`.
    fn hypot(self, other: Self) -> Self;
    /// The absolute value.
    fn abs(self) -> Self;
    /// One with the sign of `self`; unlike Rust's, zero gives zero, so that friction at rest pushes nowhere. NaN gives NaN.
    fn signum(self) -> Self;
    /// The largest integer that is not above `self`.
    fn floor(self) -> Self;

    /// Whether `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// Whether `self <= other`.
    fn le(self, other: Self) -> Self::Mask;
    /// Whether `self == other`.
    fn eq(self, other: Self) -> Self::Mask;
    /// `a` where `mask` is true, `b` elsewhere. What is not selected leaves no trace, not even a NaN.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// The greatest lane (the real part of it, for dual numbers), NaN if any lane is NaN. Error norms end here.
    fn greatest(self) -> f64;

    /// Sines and cosines of several angles in radians, known at the same time.
    ///
    /// `f64` and `f32` put them in vectors, where the features `std` and `wide` are on and neither `std-sines` nor
    /// `reproducible` is; other scalars go one by one. A value may differ from that of [`Real::sin_cos`] by rounding then.
    ///
    /// ```
    /// use multibody::Real;
    ///
    /// let [(sin_a, _), (_, cos_b)] = Real::sin_cos_all([0.5_f64, -1.25]);
    /// assert!((sin_a - 0.5_f64.sin()).abs() < 1e-15 && (cos_b - 1.25_f64.cos()).abs() < 1e-15);
    /// ```
    #[inline]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        together::one_by_one(angles)
    }

    /// `self * factor + addend`: rounded once where the feature `fma` is on and the target has an instruction for it, as fast as
    /// a product then; rounded twice, as it is written, everywhere else.
    ///
    /// One rounding are `f64`, `f32` and their lanes on 64-bit Arm and, with `target-feature=+fma` or a `target-cpu` that has it, on x86, with
    /// `std` and without `reproducible`. Nothing ever calls a function for it.
    ///
    /// ```
    /// use multibody::Real;
    ///
    /// assert_eq!(Real::mul_add(2.0_f64, 3.0, 4.0), 10.0);
    /// ```
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    /// A pack of two.
    #[inline(always)]
    fn two(members: [Self; 2]) -> Self::Two {
        Packed::of(members)
    }
    /// A pack of twice the same.
    #[inline(always)]
    fn two_of(self) -> Self::Two {
        Packed::of([self; 2])
    }
    /// A pack of four.
    #[inline(always)]
    fn four(members: [Self; 4]) -> Self::Four {
        Packed::of(members)
    }
    /// A pack of four times the same.
    #[inline(always)]
    fn four_of(self) -> Self::Four {
        Packed::of([self; 4])
    }
    /// What is in a pack.
    #[inline(always)]
    fn members<const N: usize>(pack: impl Packed<Self, N>) -> [Self; N] {
        pack.members()
    }
    /// The square root of each member.
    #[inline(always)]
    fn roots<const N: usize, P: Packed<Self, N>>(pack: P) -> P {
        pack.roots()
    }
    /// [`Real::mul_add`] of each member.
    #[inline(always)]
    fn mul_adds<const N: usize, P: Packed<Self, N>>(pack: P, factors: P, addends: P) -> P {
        pack.mul_add(factors, addends)
    }
    /// Sines and cosines of each member in radians, by [`Real::sin_cos_all`].
    ///
    /// ```
    /// use multibody::Real;
    ///
    /// let (sines, cosines) = f64::sines(f64::four([0.5, -1.25, 0.0, 2.0]));
    /// assert!((f64::members(sines)[1] + 1.25_f64.sin()).abs() < 1e-15);
    /// assert_eq!(f64::members(cosines)[2], 1.0);
    /// ```
    #[inline(always)]
    fn sines<const N: usize, P: Packed<Self, N>>(angles: P) -> (P, P) {
        let all = Self::sin_cos_all(angles.members());
        (P::of(all.map(|one| one.0)), P::of(all.map(|one| one.1)))
    }

    /// Sine of an angle in radians.
    #[inline]
    fn sin(self) -> Self {
        Real::sin_cos(self).0
    }
    /// Cosine of an angle in radians.
    #[inline]
    fn cos(self) -> Self {
        Real::sin_cos(self).1
    }
    /// `self` to a whole power, by repeated squaring.
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let mut rest = exponent.unsigned_abs();
        let mut square = self;
        let mut power = Self::lit(1.0);
        while rest != 0 {
            if rest & 1 == 1 {
                power *= square;
            }
            square *= square;
            rest >>= 1;
        }
        if exponent < 0 { Self::lit(1.0) / power } else { power }
    }
    /// Whether `self > other`.
    #[inline]
    fn gt(self, other: Self) -> Self::Mask {
        Real::lt(other, self)
    }
    /// Whether `self >= other`.
    #[inline]
    fn ge(self, other: Self) -> Self::Mask {
        Real::le(other, self)
    }
    /// Whether `self != other`; true for NaN.
    #[inline]
    fn ne(self, other: Self) -> Self::Mask {
        !Real::eq(self, other)
    }
    /// The lesser of two, NaN if either is NaN.
    #[inline]
    fn min(self, other: Self) -> Self {
        Real::select(Real::lt(self, other) | Real::ne(self, self), self, other)
    }
    /// The greater of two, NaN if either is NaN.
    #[inline]
    fn max(self, other: Self) -> Self {
        Real::select(Real::lt(other, self) | Real::ne(self, self), self, other)
    }
    /// Whether this is neither infinite nor NaN. Dual numbers answer for their real part.
    #[inline]
    fn is_finite(self) -> Self::Mask {
        Real::lt(Real::abs(self), Self::lit(f64::INFINITY))
    }
}

/// Whether a mask is true in any lane.
#[inline]
pub fn any<M: SimdBool>(mask: M) -> bool {
    mask.any()
}

/// Whether a mask is true in every lane.
#[inline]
pub fn all<M: SimdBool>(mask: M) -> bool {
    mask.all()
}
