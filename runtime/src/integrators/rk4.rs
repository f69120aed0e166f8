//! The classical Runge-Kutta method (Kutta 1901), on manifolds after Munthe-Kaas (1998).

use super::dense::Dense;
use super::method::{Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advance_by};
use crate::{Real, System, Tangent};

/// The classical Runge-Kutta method: fourth order, four evaluations. The first choice for a fixed step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rk4;

impl<S: System> Method<S> for Rk4 {
    const ORDER: u32 = 4;
    type Memory = SlopeOf<S>;
    type Details = ();

    #[inline]
    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> SlopeOf<S> {
        problem.slope(t, state)
    }

    #[inline]
    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, k1: &SlopeOf<S>) -> Attempt<S, ()> {
        let Step { dt, state, .. } = *step;
        let half = S::Scalar::lit(0.5) * dt;
        let k2 = problem.stage(step.time(0.5), state, &k1.scale(half));
        let k3 = problem.stage(step.time(0.5), state, &k2.scale(half));
        let k4 = problem.stage(step.end, state, &k3.scale(dt));
        // Converted one by one: no loop over constants of double precision is left where size is optimised for.
        let (third, sixth) = (S::Scalar::lit(1.0 / 3.0), S::Scalar::lit(1.0 / 6.0));
        let d = advance_by(dt, k1, [third, third, sixth], [&k2, &k3, &k4]);
        Attempt::new(d, ())
    }

    fn dense(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        first: &SlopeOf<S>,
        attempt: &Attempt<S, ()>,
    ) -> Dense<S> {
        let last = problem.stage(step.end, step.state, &attempt.displacement);
        Dense::cubic(step, &attempt.displacement, first, &last)
    }
}

inherent!(Rk4);
