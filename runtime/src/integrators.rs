//! Integration in time: one method in each file.
//!
//! An [`Integrator`] is a [`Method`] with its steps, of one length or chosen by error. All methods hold the input over a
//! step and keep unit quaternions of unit length: rotations move by exponentials. None of them panics or hangs, whatever
//! the numbers.
//!
//! | method | order | evaluations for a step | asks of the model | steps by error | dense output | take it for |
//! |---|---|---|---|---|---|---|
//! | [`Euler`] | 1 | 1 | | no | cubic | comparisons |
//! | [`SemiImplicitEuler`] | 1 | 1 | | no | cubic | rough motion in hard real time; its energy stays bounded |
//! | [`Rk4`] | 4 | 4 | | no | cubic | steps of one length |
//! | [`DormandPrince`] | 5 | 6 | | yes | order 4, at no cost | errors down to 1e-3; many states within steps |
//! | [`Dop853`] | 8 | 12 | | yes | order 7, by 3 evaluations | errors from 1e-3 down to rounding; fast rotations |
//! | [`Radau`] | 5 | 3 for each iteration | [`Differentiable`](crate::Differentiable) | yes | order 3 | stiff systems |
//! | [`GeneralisedAlpha`] | 2 | 1 for each iteration | see there | no | cubic | vibrations to be damped; constraints |
//! | [`Verlet`] | 2 | 1 | [`Separable`](crate::Separable) | no | cubic | bounded energy, cheaply |
//! | [`Composition4`] | 4 | 6 | [`Separable`](crate::Separable) | no | quintic | bounded energy over very many steps |
//! | [`Composition6`] | 6 | 11 | [`Separable`](crate::Separable) | no | quintic | the same to rounding |
//! | [`ImplicitMidpoint`] | 2 | 1 for each iteration | | no | cubic | time-symmetric, any system that is not stiff |
//! | [`GaussLegendre4`] | 4 | 2 for each iteration | | no | quintic | the same, more accurate |
//! | [`GaussLegendre6`] | 6 | 3 for each iteration | | no | quintic | the same to rounding |
//! | [`SymplecticMidpoint`] | 2 | 1 for each iteration | [`Canonical`](crate::Canonical) | no | cubic | bounded energy, in chaos too |
//! | [`SymplecticGauss4`] | 4 | 2 for each iteration | [`Canonical`](crate::Canonical) | no | quintic | the same, more accurate |
//! | [`SymplecticGauss6`] | 6 | 3 for each iteration | [`Canonical`](crate::Canonical) | no | quintic | the same to rounding |
//!
//! All take systems whose velocities are speeds of their own, `q' = N(q) u` ([`System::position_rates`](crate::System::position_rates)),
//! but [`GeneralisedAlpha`] and those that ask for [`Separable`](crate::Separable) or [`Canonical`](crate::Canonical), which
//! rest on `q' = v` ([`SecondOrder`](crate::SecondOrder)).
//!
//! The error within a step of dense output shrinks with the power of the step that is one above its order; a cubic is of
//! order 3, a quintic of order 5. States within a step are never better than its ends: with a cubic, those of methods of
//! second order are of second order throughout.
//!
//! What an [`Integrator`] runs with any of them:
//!
//! | you want | take |
//! |---|---|
//! | the end, and to see every step | [`Integrator::integrate`] |
//! | states at given times | [`Integrator::sampled`] |
//! | all states within each step | [`Integrator::intervals`] |
//! | stops, impacts, switches: what happens where a function crosses zero | [`Integrator::with_events`] and [`Events`] |
//! | rounding that does not grow over very many steps | [`Integrator::compensated`] |
//! | many motions, one in each lane of the scalar, each with its own steps | [`Integrator::integrate_lanes`] |
//! | bounds on the length of steps | [`Integrator::within`] a [`Tolerance`] |
//!
//! The common methods have `step` and `integrate` of their own (`Rk4::step(..)`), for loops of one's own and for
//! microcontrollers: such steps cost no more than their stages.

mod composition;
mod control;
mod course;
mod dense;
mod dop853;
mod dormand_prince;
mod doubt;
mod error;
mod euler;
mod events;
mod gauss;
pub mod generalised_alpha;
mod hermite;
mod integrator;
mod interval;
mod lanes;
mod method;
mod outlook;
mod problem;
mod radau;
mod rk4;
mod run;
mod sampling;
mod scope;
mod semi_implicit_euler;
mod slope;

pub use composition::{Composition4, Composition6, Verlet};
pub use control::Tolerance;
pub use dense::Dense;
pub use dop853::Dop853;
pub use dormand_prince::DormandPrince;
pub use error::IntegrationError;
pub use euler::Euler;
pub use events::{Action, Direction, Event, Events};
pub use gauss::{
    GaussLegendre4, GaussLegendre6, ImplicitMidpoint, SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint,
};
pub use generalised_alpha::GeneralisedAlpha;
pub use integrator::{Integrator, Statistics, Steps};
pub use interval::Interval;
pub use lanes::{LaneEnd, LaneEnds};
pub use method::{Accepted, Attempt, Method};
pub use problem::{Problem, Step};
pub use radau::Radau;
pub(crate) use radau::{Eliminated, Entire, Matrices};
pub use rk4::Rk4;
pub use sampling::Samples;
pub use semi_implicit_euler::SemiImplicitEuler;
pub use slope::{Slope, SlopeOf};
