//! Integration in time: one method in each file.
//!
//! [`Euler`], [`SemiImplicitEuler`], [`Rk4`] and [`DormandPrince`] take steps of a given length and cost no more than
//! their stages. [`Adaptive`] chooses the steps of Dormand and Prince's pair by its error estimate. All hold the input
//! over a step and keep unit quaternions of unit length. None of them panics or hangs, whatever the numbers.

mod adaptive;
mod dormand_prince;
mod error;
mod euler;
mod method;
mod rk4;
mod semi_implicit_euler;
mod slope;

pub use adaptive::{Adaptive, Statistics};
pub use dormand_prince::DormandPrince;
pub use error::IntegrationError;
pub use euler::Euler;
pub use method::Method;
pub use rk4::Rk4;
pub use semi_implicit_euler::SemiImplicitEuler;
