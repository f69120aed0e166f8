//! Integration in time: one method in each file.
//!
//! An [`Integrator`] is a [`Method`] with its steps, of one length or chosen by error. All methods hold the input over a
//! step and keep unit quaternions of unit length: rotations move by exponentials. None of them panics or hangs, whatever
//! the numbers.
//!
//! The common methods have `step` and `integrate` of their own (`Rk4::step(..)`), for loops of one's own and for
//! microcontrollers: such steps cost no more than their stages.

mod control;
mod dense;
mod dop853;
mod dormand_prince;
mod error;
mod euler;
mod integrator;
mod method;
mod problem;
mod rk4;
mod semi_implicit_euler;
mod slope;

pub use control::Tolerance;
pub use dense::Dense;
pub use dop853::Dop853;
pub use dormand_prince::DormandPrince;
pub use error::IntegrationError;
pub use euler::Euler;
pub use integrator::{Integrator, Interval, Statistics, Steps};
pub use method::{Attempt, Method};
pub use problem::{Problem, Step};
pub use rk4::Rk4;
pub use semi_implicit_euler::SemiImplicitEuler;
pub use slope::{Slope, SlopeOf};
