//! How the search for an equilibrium can fail: [`EquilibriumError`].

use core::fmt;

/// Why no equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// The state, its rates or their derivatives are infinite or NaN.
    NotFinite,
    /// What is free cannot make the accelerations zero: the equations depend on each other where they are smallest.
    Singular {
        /// Greatest acceleration or rate that is left, in the best of the states met. Of a model with loops, states count
        /// where these are closed.
        residual: f64,
        /// How many of the equations are independent there.
        rank: usize,
        /// How many there are: one for each velocity and each own state, less those that closed loops fulfil by
        /// themselves, which are as many as there are independent constraints.
        equations: usize,
    },
    /// None was found near the guess: accelerations have a least value there that is not zero, or the bound on
    /// iterations was reached.
    NotFound {
        /// Greatest acceleration or rate that is left, in the best of the states met. Of a model with loops, states count
        /// where these are closed.
        residual: f64,
        /// Steps made.
        iterations: u32,
    },
    /// The loops could not be closed near the guess, or move by themselves, so no state was met that could be at rest; or they are open
    /// where it was found, since what is free has opened them or they don't close for these parameters:
    /// [`assemble`](crate::assemble) tells more.
    Open {
        /// `[m]` or `[rad]` greatest residual of a position that is left, in the best of the states met, or, per second, of what
        /// equations ask of velocities at rest; where the state that was found is open, the residual of
        /// [`System::opening`](crate::System::opening).
        gap: f64,
        /// Steps made.
        iterations: u32,
    },
    /// Without velocities positions go on changing, where velocities are speeds from which rates follow with a share of their own.
    Moving {
        /// `[m/s]` or `[rad/s]` greatest rate of a position.
        rate: f64,
    },
    /// The same, but that they stand for an instant: that share is zero, and its derivative by time is not.
    Leaving {
        /// `[m/s^2]` or `[rad/s^2]` greatest acceleration of a position.
        acceleration: f64,
    },
}

impl fmt::Display for EquilibriumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("the state, its rates or their derivatives are not finite"),
            Self::Singular { residual, rank, equations } => write!(
                f,
                "what is free cannot make the accelerations zero: {residual:e} is left where {rank} of {equations} \
                 equations are independent"
            ),
            Self::NotFound { residual, iterations } => {
                write!(f, "no equilibrium near the guess: {residual:e} is left after {iterations} steps")
            }
            Self::Moving { rate } => {
                write!(f, "nothing is at rest: without velocities positions change at {rate:e} per second")
            }
            Self::Leaving { acceleration } => write!(
                f,
                "positions stand for an instant alone: without velocities and their accelerations they gain {acceleration:e} per second \
                 each second"
            ),
            Self::Open { gap, iterations } => {
                write!(f, "the loops do not close near the guess: {gap:e} is left after {iterations} steps")
            }
        }
    }
}

impl core::error::Error for EquilibriumError {}
