//! How an impulse or an impact can fail: [`ImpactError`].

use core::fmt;

/// Why there is no state after an impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImpactError {
    /// The state, the direction, the coefficient of restitution or the answer of the system is infinite or NaN, in any
    /// lane. The answer is where the mass matrix is singular.
    NotFinite,
}

impl fmt::Display for ImpactError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str(
                "the state after the impulse is not finite: so is something that was handed over, or the mass matrix is \
                 singular here",
            ),
        }
    }
}

impl core::error::Error for ImpactError {}
