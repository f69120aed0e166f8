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
    /// A step comes to a dead centre of a loop, or would jump over it: two solutions of the loop meet there, so the
    /// coordinates of a reduced model end. The mechanism itself may go on with the other solution, which the same model
    /// with `constraints: Multipliers` and [`WithProjection`](crate::WithProjection) follows. A fixed step that is too long
    /// to tell a near miss from a dead centre ends so too; shorter steps, or steps chosen by error, go on.
    DeadCentre {
        /// `[s]` the time reached.
        time: f64,
        /// The coordinate that the solution of the loop finds.
        coordinate: &'static str,
    },
    /// The loops of the state are open: at the start, or in a run because Newton's method no longer converges.
    OpenLoops {
        /// `[s]` the time.
        time: f64,
        /// The greatest residual: in rad, or in lengths of the mechanism's size; in a run over the greatest unit of the
        /// equations, as [`System::margins`](crate::System::margins) tells.
        residual: f64,
        /// What closes them.
        remedy: &'static str,
    },
    /// A step ends in a pose in which constraints come to depend on each other and motions cross, as in a parallelogram that
    /// lies flat, or so near to one that rounding decides which motion goes on. Other steps may lead over it, and looser
    /// tolerances do so more easily; the same model with `constraints: Reduced`, where a loop has a closed form, knows its
    /// branch.
    Ambiguous {
        /// `[s]` the time reached.
        time: f64,
    },
    /// The loops of a start are closed, but its velocities open them.
    OpenVelocities {
        /// `[s]` the time.
        time: f64,
        /// `[1/s]` how fast, in rad or lengths of the mechanism's size.
        rate: f64,
        /// What gives velocities that keep them closed.
        remedy: &'static str,
    },
    /// An equation of the loops that was left out, since the declared parameters make it hold, does not hold with these.
    UnfitParameters {
        /// Its name: a constraint, or a joint with a direction.
        equation: &'static str,
        /// What is left of it, in rad or lengths of the mechanism's size.
        residual: f64,
        /// What makes it hold.
        remedy: &'static str,
    },
    /// The mass matrix is singular: nothing that moves with this coordinate has inertia, so no equation gives its
    /// acceleration.
    NoInertia {
        /// `[s]` the last time at which all was finite, or the start.
        time: f64,
        /// The coordinate.
        coordinate: &'static str,
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
            Self::DeadCentre { time, coordinate } => write!(
                f,
                "after t = {time} s the loop that gives `{coordinate}` comes to a dead centre, where its coordinates end: \
                 take `constraints: Multipliers` with projection, or a coordinate that goes through, or shorter steps"
            ),
            Self::OpenLoops { time, residual, remedy } => {
                write!(
                    f,
                    "at t = {time} s the loops are open by {residual:e} (rad, or lengths of the mechanism; in a run over \
                     the greater unit): {remedy}"
                )
            }
            Self::OpenVelocities { time, rate, remedy } => {
                write!(
                    f,
                    "at t = {time} s the velocities open the loops, by {rate:e} (rad, or lengths of the mechanism) per \
                     second: {remedy}"
                )
            }
            Self::UnfitParameters { equation, residual, remedy } => {
                write!(
                    f,
                    "with these parameters `{equation}` does not hold, by {residual:e} (rad, or lengths of the mechanism): \
                     {remedy}"
                )
            }
            Self::Ambiguous { time } => write!(
                f,
                "after t = {time} s constraints depend on each other, and rounding would decide which of two motions goes on: \
                 take steps of another length, or a looser tolerance, or `constraints: Reduced`"
            ),
            Self::NoInertia { time, coordinate } => write!(
                f,
                "after t = {time} s the mass matrix is singular: nothing that moves with `{coordinate}` has inertia"
            ),
            Self::EventsAccumulate { time } => {
                write!(f, "events follow each other too fast and accumulate at t = {time} s")
            }
            Self::TooManySteps { time } => write!(f, "the bound on the number of steps was reached at t = {time} s"),
        }
    }
}

impl core::error::Error for IntegrationError {}
