//! How an integration can fail: [`IntegrationError`].

use core::fmt;

/// Why an integration stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationError {
    /// An argument that no integration can work with: not a number, infinite, or of the wrong sign.
    InvalidArgument {
        /// What is wrong with which argument.
        what: &'static str,
    },
    /// The state or its derivative became infinite or NaN.
    NonFinite {
        /// `[s]` the last time at which all was finite, or the start.
        time: f64,
    },
    /// The tolerance asks for steps shorter than the least one allowed.
    StepTooSmall {
        /// `[s]` the time reached.
        time: f64,
        /// `[s]` the step that would have been needed.
        step: f64,
    },
    /// The equations of an implicit method found no solution with the given step.
    NoConvergence {
        /// `[s]` the time reached.
        time: f64,
    },
    /// Events of one function, each with a jump, follow each other ever faster: a ball that comes to rest. Or functions
    /// cross zero more than a hundred times between two points at which they are looked at, or jump more than ten thousand
    /// times within one step of given length.
    EventsAccumulate {
        /// `[s]` the time of the last one.
        time: f64,
    },
    /// The bound on the number of steps was reached.
    TooManySteps {
        /// `[s]` the time reached.
        time: f64,
    },
}

impl fmt::Display for IntegrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidArgument { what } => f.write_str(what),
            Self::NonFinite { time } => {
                write!(f, "the state is no longer finite after t = {time} s")
            }
            Self::StepTooSmall { time, step } => {
                write!(f, "at t = {time} s the tolerance asks for a step of {step} s, below the least one")
            }
            Self::NoConvergence { time } => {
                write!(f, "at t = {time} s the equations of the step have no solution near its start: it is too long")
            }
            Self::EventsAccumulate { time } => {
                write!(f, "events follow each other too fast and accumulate at t = {time} s")
            }
            Self::TooManySteps { time } => write!(f, "the bound on the number of steps was reached at t = {time} s"),
        }
    }
}

impl core::error::Error for IntegrationError {}
