//! The semi-implicit (symplectic) Euler method (Hairer, Lubich and Wanner, section I.1.2).

use super::method::{Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::SlopeOf;
use crate::{System, Tangent};

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
    fn attempt(&self, _problem: &Problem<'_, S>, step: &Step<'_, S>, first: &SlopeOf<S>) -> Attempt<S, ()> {
        let mut slope = *first;
        slope.q = slope.q.add_scaled(step.dt, &slope.v);
        Attempt::new(slope.scale(step.dt), ())
    }
}

inherent!(SemiImplicitEuler);
