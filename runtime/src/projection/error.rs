//! How projection and assembly can fail: [`ProjectionError`], [`AssemblyError`].

use core::fmt;

/// Why a state could not be brought back to where the constraints are satisfied.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ProjectionError {
    /// The state, the constraints or a correction are infinite or NaN.
    NotFinite,
    /// The bound on iterations was reached: the state is too far away, or nothing near it satisfies the constraints.
    NoConvergence {
        /// `[m]` or `[rad]` greatest component of what is left.
        residual: f64,
        /// Iterations made.
        iterations: u32,
    },
    /// No velocities satisfy the rates of the constraints at this position: it is singular, and a constraint that
    /// depends on time asks for a motion it does not have.
    NoVelocity {
        /// `[m/s]` or `[rad/s]` greatest component of the rate that is left.
        rate: f64,
    },
}

impl fmt::Display for ProjectionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("the state or its constraints are not finite"),
            Self::NoConvergence { residual, iterations } => {
                write!(f, "the constraints are still violated by {residual:e} after {iterations} iterations")
            }
            Self::NoVelocity { rate } => {
                write!(f, "no velocities satisfy the constraints at this position: they change at {rate:e} per second")
            }
        }
    }
}

impl core::error::Error for ProjectionError {}

/// Why a mechanism could not be assembled.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AssemblyError {
    /// The guess, the weights, the constraints or a correction are infinite or NaN.
    NotFinite,
    /// The loops cannot be closed from this guess: no small displacement of what is free brings the ends closer, and
    /// neither does it after shaking the guess. Lengths do not fit, or coordinates that are held stand in the way.
    CannotClose {
        /// `[m]` or `[rad]` greatest component of what is left, at the best position found.
        residual: f64,
        /// How many equations are independent there.
        rank: usize,
        /// How many there are.
        equations: usize,
    },
    /// The bound on iterations was reached while the ends were still coming closer: a better guess may help.
    NoConvergence {
        /// `[m]` or `[rad]` greatest component of what is left, at the best position found.
        residual: f64,
        /// Iterations made.
        iterations: u32,
    },
    /// The loops are closed, but no velocities of what is free satisfy the rates of the constraints.
    CannotMove {
        /// `[m/s]` or `[rad/s]` greatest component of the rate that is left.
        rate: f64,
        /// The equation whose rate that is, by its place among them.
        equation: usize,
        /// How many equations are independent there.
        rank: usize,
        /// How many there are.
        equations: usize,
    },
}

impl fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("the guess or its constraints are not finite"),
            Self::CannotClose { residual, rank, equations } => write!(
                f,
                "the loops cannot be closed from this guess: {residual:e} remain, and there {rank} of {equations} \
                 equations are independent"
            ),
            Self::NoConvergence { residual, iterations } => {
                write!(f, "the loops are still open by {residual:e} after {iterations} iterations")
            }
            Self::CannotMove { rate, equation, rank, equations } => write!(
                f,
                "no velocities keep the loops closed: a rate of {rate:e} per second remains in the equation at place {equation}, and \
                 {rank} of {equations} equations are independent"
            ),
        }
    }
}

impl core::error::Error for AssemblyError {}
