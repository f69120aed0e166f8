//! The semi-implicit (symplectic) Euler method (Hairer, Lubich and Wanner, section I.1.2).

use super::method::{Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::{Slope, SlopeOf};
use crate::{StateSpace, System, Tangent};

/// The semi-implicit Euler method: first order, one evaluation. New velocities move the position, so that the energy
/// of a conservative system stays bounded; the method of games and of hard real time.
#[derive(Clone, Copy, Debug, Default)]
pub struct SemiImplicitEuler;

impl<S: System> Method<S> for SemiImplicitEuler {
    const ORDER: u32 = 1;
    type Memory = SlopeOf<S>;
    type Details = ();

    #[inline]
    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> SlopeOf<S> {
        problem.slope(t, state)
    }

    #[inline]
    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, first: &SlopeOf<S>) -> Attempt<S, ()> {
        let (q, v, x) = step.state.split();
        let kicked = step.state.join(q, v.add_scaled(step.dt, &first.v), x);
        let slope = Slope { q: problem.position_rates(step.t, &kicked), ..*first };
        Attempt::new(slope.scale(step.dt), ())
    }
}

inherent!(SemiImplicitEuler);
