//! What closes loops while an equilibrium is searched for: nothing ([`Open`]), or constraints ([`Loops`]).

use crate::tangent::greatest;
use crate::{Constrained, DisplacementOf, Real, StateSpace, System, Tangent, VelocityOf};

/// What closes loops.
pub(super) trait Closing<S: System> {
    /// Whether there are any loops.
    const LOOPS: bool;
    /// The greatest residual of a position, and of what equations ask of velocities at rest.
    fn gap(&self, t: S::Scalar, state: &S::State) -> S::Scalar;
    /// The displacement that closes the loops.
    fn correction(&self, t: S::Scalar, state: &S::State, weights: &DisplacementOf<S>) -> DisplacementOf<S>;
    /// The part of a displacement that opens them.
    fn across(
        &self,
        t: S::Scalar,
        state: &S::State,
        d: &DisplacementOf<S>,
        weights: &DisplacementOf<S>,
    ) -> DisplacementOf<S>;
    /// The part of a change of velocities, or of accelerations, that opens them, by the least sum of squares.
    fn rates_across(&self, t: S::Scalar, state: &S::State, d: &VelocityOf<S>) -> VelocityOf<S>;
}

/// There are no loops.
pub(super) struct Open;

impl<S: System> Closing<S> for Open {
    const LOOPS: bool = false;
    fn gap(&self, _: S::Scalar, _: &S::State) -> S::Scalar {
        S::Scalar::lit(0.0)
    }
    fn correction(&self, _: S::Scalar, _: &S::State, _: &DisplacementOf<S>) -> DisplacementOf<S> {
        Tangent::zero()
    }
    fn across(&self, _: S::Scalar, _: &S::State, _: &DisplacementOf<S>, _: &DisplacementOf<S>) -> DisplacementOf<S> {
        Tangent::zero()
    }
    fn rates_across(&self, _: S::Scalar, _: &S::State, _: &VelocityOf<S>) -> VelocityOf<S> {
        Tangent::zero()
    }
}

/// The loops of a constrained system.
pub(super) struct Loops<'a, S>(pub(super) &'a S);

impl<S: Constrained> Closing<S> for Loops<'_, S> {
    const LOOPS: bool = true;
    fn gap(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        // At rest nothing is left of rates but what moves by itself: a plate that turns below a wheel.
        let open = greatest(&self.0.constraints(t, &state.split().0));
        open.max(greatest(&self.0.constraint_rate(t, state)))
    }
    fn correction(&self, t: S::Scalar, state: &S::State, weights: &DisplacementOf<S>) -> DisplacementOf<S> {
        let (q, _, _) = state.split();
        let minus = self.0.constraints(t, &q).scale(S::Scalar::lit(-1.0));
        self.0.correction(t, state, &minus, weights).0
    }
    fn across(
        &self,
        t: S::Scalar,
        state: &S::State,
        d: &DisplacementOf<S>,
        weights: &DisplacementOf<S>,
    ) -> DisplacementOf<S> {
        let opened = self.0.constraints_along(t, state, d);
        self.0.correction(t, state, &opened, weights).0
    }
    fn rates_across(&self, t: S::Scalar, state: &S::State, d: &VelocityOf<S>) -> VelocityOf<S> {
        let opened = self.0.constraint_rate_along(t, state, d);
        let ones = d.map(&mut |_| S::Scalar::lit(1.0));
        self.0.velocity_correction(t, state, &opened, &ones).0
    }
}
