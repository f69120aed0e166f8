//! Whether a body can have an inertia: [`inertia_violation`], and the error of parameter checks: [`ParamError`].

use crate::Real;
use core::fmt;

/// A value of a parameter that no mechanism can have; given by a generated `Params::check`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ParamError {
    /// What is wrong, with the name of the parameter or the body.
    pub what: &'static str,
}

impl fmt::Display for ParamError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.what)
    }
}

impl core::error::Error for ParamError {}

/// Whether no body can have the inertia tensor with these entries (`xy` is the entry, minus the integral of `x*y`).
///
/// An inertia is legal where half its trace times one, minus itself, has no eigenvalue below -1e-9 of the trace: that
/// matrix is the integral of `r * r^T` over the mass. NaN and infinity are violations, zero is legal.
///
/// The test is the signs of the pivots of `L D L^T`, whose backward error is a few roundings of the trace, while an
/// eigenvalue in closed form would lose half the digits where two are equal, as for every rod. Where the scalar rounds
/// coarser than 1e-9 its own rounding is the tolerance.
///
/// ```
/// use multibody::inertia_violation;
///
/// assert!(!inertia_violation(1.0_f64, 1.0, 0.0, 0.0, 0.0, 0.0)); // a rod
/// assert!(inertia_violation(1.0_f64, 1.0, 2.1, 0.0, 0.0, 0.0)); // flatter than a plate
/// ```
#[inline]
pub fn inertia_violation<T: Real>(xx: T, yy: T, zz: T, xy: T, xz: T, yz: T) -> T::Mask {
    let zero = T::lit(0.0);
    let trace = xx + yy + zz;
    let tolerance = Real::max(T::lit(1e-9), T::lit(16.0) * T::epsilon());
    // The least positive number keeps the pivots of an inertia of zero from dividing zero by zero.
    let half = T::lit(0.5) * trace + tolerance * trace + T::lit(f64::from(f32::MIN_POSITIVE));
    let (a, b, c) = (half - xx, half - yy, half - zz);

    let (l, m) = (-xy / a, -xz / a);
    let d = b + l * xy;
    let e = -yz + l * xz;
    let f = c + m * xz - e / d * e;
    !(Real::gt(a, zero) & Real::gt(d, zero) & Real::gt(f, zero) & Real::is_finite(trace))
}

/// Whether a scalar holds a number that isn't zero: it is not infinite there, and has all its digits.
///
/// ```
/// use multibody::is_held;
///
/// assert!(is_held::<f64>(1e39) && is_held::<f32>(1e38) && is_held::<f32>(1e-37));
/// assert!(!is_held::<f32>(1e39) && !is_held::<f32>(1e-40) && !is_held::<f32>(1e-46));
/// ```
#[inline]
pub fn is_held<T: Real>(value: f64) -> T::Mask {
    // 2^64: what has lost digits below the least normal number misses the multiple, which has them.
    const LARGE: f64 = 18_446_744_073_709_551_616.0;
    let held = T::lit(value);
    let (near, scale) = if value.abs() < 1.0 { (held * T::lit(LARGE), T::lit(value * LARGE)) } else { (held, held) };
    let gap = Real::abs(near - scale);
    Real::is_finite(held) & !Real::eq(held, T::lit(0.0)) & Real::le(gap, T::lit(4.0) * T::epsilon() * Real::abs(scale))
}
