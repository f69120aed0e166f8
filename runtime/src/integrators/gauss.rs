//! Gauss-Legendre collocation with one, two and three stages (Kuntzmann 1961, Butcher 1964; Hairer, Lubich and Wanner,
//! Geometric Numerical Integration, section II.1.3), in position and velocity or in position and momentum.
//!
//! All of them are time-symmetric. In position and momentum they are symplectic too, and keep the energy of a
//! conservative mechanism within bounds for exponentially long times; in position and velocity they do so where the
//! motion is regular and reversible. Over 2e6 steps of 1e-2 s of the midpoint rule, a line fitted to the relative energy
//! of a regular double pendulum rises by 1.3e-8 in momenta and falls by 9e-9 in velocities, both less than the fit's
//! own error; in chaos it rises by 2e-6 and falls by 6e-4 (`docs/long_runs.md`). The cost of a step is nearly the same.
//!
//! Steps are solved by fixed-point iteration, which converges where the step is shorter than about the inverse of the
//! fastest angular frequency or damping rate: not for stiff systems, where steps end in
//! [`NoConvergence`](super::IntegrationError::NoConvergence). [`Radau`](super::Radau) is for those.
//!
//! [`Integrator::compensated`](super::Integrator::compensated) keeps the rounding of positions and velocities where these
//! are integrated. In momenta it keeps that of positions and own states alone: momenta are taken anew from every accepted
//! state.

mod stages;
mod tableau;
mod variables;

use super::dense::Dense;
use super::method::{Accepted, Attempt, Method, inherent};
use super::problem::{Problem, Step};
use stages::Stages;
use tableau::{ONE, THREE, TWO};
use variables::{Momenta, Velocities};

/// The implicit midpoint rule in position and velocity: second order, time-symmetric, for any system that is
/// not stiff.
#[derive(Clone, Copy, Debug, Default)]
pub struct ImplicitMidpoint;

/// The Gauss method with two stages in position and velocity: fourth order, time-symmetric, for any system that is
/// not stiff.
#[derive(Clone, Copy, Debug, Default)]
pub struct GaussLegendre4;

/// The Gauss method with three stages in position and velocity: sixth order, time-symmetric, for any system that is
/// not stiff.
#[derive(Clone, Copy, Debug, Default)]
pub struct GaussLegendre6;

/// The implicit midpoint rule in position and momentum: second order, time-symmetric, symplectic, for
/// [`Canonical`](crate::Canonical) systems.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymplecticMidpoint;

/// The Gauss method with two stages in position and momentum: fourth order, time-symmetric, symplectic, for
/// [`Canonical`](crate::Canonical) systems.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymplecticGauss4;

/// The Gauss method with three stages in position and momentum: sixth order, time-symmetric, symplectic, for
/// [`Canonical`](crate::Canonical) systems.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymplecticGauss6;

macro_rules! gauss {
    ($method:ident: $bound:ident, order $order:literal, $variables:ident, $tableau:ident $(, $dense:ident)?) => {
        impl<S: crate::$bound> Method<S> for $method {
            const ORDER: u32 = $order;
            type Memory = Stages<S, { $tableau.stages() }, { $tableau.history() }>;
            type Details = Stages<S, { $tableau.stages() }, { $tableau.history() }>;

            #[inline]
            fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> Self::Memory {
                $tableau.begin::<S, $variables>(problem, t, state)
            }

            #[inline]
            fn attempt(
                &self,
                problem: &Problem<'_, S>,
                step: &Step<'_, S>,
                memory: &Self::Memory,
            ) -> Attempt<S, Self::Details> {
                $tableau.attempt::<S, $variables>(problem, step, memory)
            }

            #[inline]
            fn proceed(
                &self,
                problem: &Problem<'_, S>,
                step: &Step<'_, S>,
                _memory: &Self::Memory,
                attempt: &Attempt<S, Self::Details>,
                next: &Accepted<S>,
            ) -> Self::Memory {
                $tableau.proceed::<S, $variables>(problem, step, attempt, &next.state)
            }

            $(
                fn dense(
                    &self,
                    problem: &Problem<'_, S>,
                    step: &Step<'_, S>,
                    _memory: &Self::Memory,
                    attempt: &Attempt<S, Self::Details>,
                ) -> Dense<S> {
                    Dense::$dense(problem, step, &attempt.displacement)
                }
            )?
        }

        inherent!($method: crate::$bound);
    };
}

gauss!(ImplicitMidpoint: System, order 2, Velocities, ONE);
gauss!(GaussLegendre4: System, order 4, Velocities, TWO, quintic);
gauss!(GaussLegendre6: System, order 6, Velocities, THREE, quintic);
gauss!(SymplecticMidpoint: Canonical, order 2, Momenta, ONE);
gauss!(SymplecticGauss4: Canonical, order 4, Momenta, TWO, quintic);
gauss!(SymplecticGauss6: Canonical, order 6, Momenta, THREE, quintic);
