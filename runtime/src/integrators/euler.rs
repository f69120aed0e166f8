//! The explicit Euler method.

use super::method::{Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::SlopeOf;
use crate::{System, Tangent};

/// The explicit Euler method: first order, one evaluation. Energy grows; a reference, seldom a choice.
#[derive(Clone, Copy, Debug, Default)]
pub struct Euler;

impl<S: System> Method<S> for Euler {
    const ORDER: u32 = 1;
    type Memory = SlopeOf<S>;
    type Details = ();

    #[inline]
    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> SlopeOf<S> {
        problem.slope(t, state)
    }

    #[inline]
    fn attempt(&self, _problem: &Problem<'_, S>, step: &Step<'_, S>, first: &SlopeOf<S>) -> Attempt<S, ()> {
        Attempt::new(first.scale(step.dt), ())
    }
}

inherent!(Euler);
