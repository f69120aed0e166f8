//! What a Gauss method integrates beside positions: velocities or momenta.

use crate::integrators::problem::Problem;
use crate::{Canonical, DisplacementOf, ExtraOf, PositionOf, Real, StateSpace, System, Tangent, VelocityOf};

/// The second half of the variables, `w`.
pub(super) trait Variables<S: System> {
    /// Those of a state.
    fn of(system: &S, state: &S::State) -> VelocityOf<S>;

    /// The velocities that belong to them at a position.
    fn velocity(system: &S, q: &PositionOf<S>, w: &VelocityOf<S>) -> VelocityOf<S>;

    /// The rates of the position at a state.
    fn position_rates(system: &S, t: S::Scalar, state: &S::State) -> DisplacementOf<S>;

    /// The change of velocities from `v`, where `w` at the end, at the position `q`, differs from that at the start by
    /// `change`.
    fn change(
        system: &S,
        v: &VelocityOf<S>,
        q: &PositionOf<S>,
        w: &VelocityOf<S>,
        change: &VelocityOf<S>,
    ) -> VelocityOf<S>;

    /// Their rates and those of own states.
    fn rates(problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> (VelocityOf<S>, ExtraOf<S>);
}

/// Velocities themselves.
pub(super) struct Velocities;

impl<S: System> Variables<S> for Velocities {
    #[inline]
    fn of(_system: &S, state: &S::State) -> VelocityOf<S> {
        state.split().1
    }
    #[inline]
    fn velocity(_system: &S, _q: &PositionOf<S>, w: &VelocityOf<S>) -> VelocityOf<S> {
        *w
    }
    #[inline]
    fn position_rates(system: &S, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        system.position_rates(t, state)
    }
    /// With the digits that the sum has no place for.
    #[inline]
    fn change(
        _system: &S,
        _v: &VelocityOf<S>,
        _q: &PositionOf<S>,
        _w: &VelocityOf<S>,
        change: &VelocityOf<S>,
    ) -> VelocityOf<S> {
        *change
    }
    #[inline]
    fn rates(problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> (VelocityOf<S>, ExtraOf<S>) {
        problem.derivative(t, state)
    }
}

/// Momenta `M(q) v`.
pub(super) struct Momenta;

impl<S: Canonical> Variables<S> for Momenta {
    #[inline]
    fn of(system: &S, state: &S::State) -> VelocityOf<S> {
        system.momentum(state)
    }
    #[inline]
    fn velocity(system: &S, q: &PositionOf<S>, w: &VelocityOf<S>) -> VelocityOf<S> {
        system.velocity(q, w)
    }
    #[inline]
    fn position_rates(_system: &S, _t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        S::as_displacement(state.split().1)
    }
    #[inline]
    fn change(
        system: &S,
        v: &VelocityOf<S>,
        q: &PositionOf<S>,
        w: &VelocityOf<S>,
        _change: &VelocityOf<S>,
    ) -> VelocityOf<S> {
        system.velocity(q, w).add_scaled(S::Scalar::lit(-1.0), v)
    }
    #[inline]
    fn rates(problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> (VelocityOf<S>, ExtraOf<S>) {
        let own = if ExtraOf::<S>::zero().is_empty() { ExtraOf::<S>::zero() } else { problem.derivative(t, state).1 };
        (problem.momentum_rate(t, state), own)
    }
}
