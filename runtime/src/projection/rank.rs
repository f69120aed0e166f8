//! How many equations are independent: [`rank`] at one state, [`WithRank`] over an integration.

use super::handed_on::{handed_on, watched};
use super::{Plain, Weighting};
use crate::integrators::SlopeOf;
use crate::{
    Canonical, Constrained, Differentiable, DisplacementOf, ExtraOf, Impulsive, JacobianOf, PositionOf, Real,
    Separable, System, Tangent, VelocityOf,
};
use core::cell::Cell;

/// How many of the constraints are independent at a position, in each lane: fewer than there are where some repeat
/// others, fewer still in a singular pose.
pub fn rank<S: Constrained>(system: &S, t: S::Scalar, state: &S::State) -> S::Scalar {
    Plain.correction(system, t, state, &S::Residual::zero()).1
}

/// A system that remembers the least rank of its constraints at the end of any step that was kept, and when that was.
///
/// It is a wrapper like [`WithProjection`](super::WithProjection), and goes around it:
/// `WithRank::new(WithProjection::new(&model, projection))`. The motion is not changed.
///
/// Only ends of steps are looked at, and a rank drops in the singular pose itself, to rounding. A pose that is passed
/// within a step goes unseen, however short the step, and steps seldom end in one by chance. Where such a pose can be
/// told by a function that crosses zero there, an [event](crate::integrators::Event) on it makes a step end in it, which
/// is then reported.
#[derive(Clone, Debug)]
pub struct WithRank<S: System> {
    /// The system.
    pub system: S,
    least: Cell<Option<(S::Scalar, S::Scalar)>>,
}

impl<S: Constrained> WithRank<S> {
    /// No step is taken yet.
    pub const fn new(system: S) -> Self {
        Self { system, least: Cell::new(None) }
    }

    /// The least rank so far and the time `[s]` at which it was met first, in each lane; `None` before the first step.
    pub fn least(&self) -> Option<(S::Scalar, S::Scalar)> {
        self.least.get()
    }
}

impl<S: Constrained> System for WithRank<S> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, state, input)
    }
    #[inline]
    fn slope(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> SlopeOf<S> {
        self.system.slope(t, state, input)
    }

    #[inline]
    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        self.system.accepted(t, state, input)
    }

    fn reached(&self, t: S::Scalar, state: &S::State) {
        self.system.reached(t, state);
        let now = rank(&self.system, t, state);
        let (least, when) = self.least.get().unwrap_or((now, t));
        let lower = Real::lt(now, least);
        self.least.set(Some((Real::select(lower, now, least), Real::select(lower, t, when))));
    }

    #[inline]
    fn ambiguity(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::Scalar {
        self.system.ambiguity(t, state, input)
    }

    watched!();
}

handed_on!(WithRank<S>, [], Constrained, Impulsive, Differentiable, Canonical, Separable);
