//! Two properties that symplectic methods rest on: [`Separable`] and [`Canonical`].

use crate::{PositionOf, SecondOrder, VelocityOf};

/// A system whose accelerations depend on time, position and input alone, not on velocities, and whose velocities are the
/// rates of its coordinates.
///
/// Generated models for which this is so implement it: the mass matrix is constant and so is every damping, which is
/// none. Explicit symmetric compositions apply to such systems alone.
#[diagnostic::on_unimplemented(
    message = "the accelerations of `{Self}` depend on velocities, or its velocities are not the rates of its coordinates",
    label = "this has to be `Separable`",
    note = "`multibody!` finds by itself where accelerations depend on time, positions and inputs alone: no damping, and a mass matrix that is constant",
    note = "for any other model take `ImplicitMidpoint` or `Rk4`, or, where velocities are the rates of coordinates, `SymplecticMidpoint` with `emit momentum`",
    note = "a model with `speed` items, or with speeds that are eliminated, never is: its velocities are not the rates of coordinates"
)]
pub trait Separable: SecondOrder {}

impl<S: Separable + ?Sized> Separable for &S {}

/// A system that can be written in positions and momenta `p = M(q) v`.
///
/// Models with `emit momentum` implement it. Symplectic Runge-Kutta methods keep the structure of phase space in these
/// variables only.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not written in momenta",
    label = "this has to be `Canonical`",
    note = "a model of `multibody!` is with `emit forward_dynamics, momentum`, where its velocities are the rates of coordinates",
    note = "a model with `speed` items, or with speeds that are eliminated, never is: take `ImplicitMidpoint`, `GaussLegendre4` or `GaussLegendre6`"
)]
pub trait Canonical: SecondOrder {
    /// The momenta `M(q) v` of a state.
    fn momentum(&self, state: &Self::State) -> VelocityOf<Self>;

    /// The velocities that belong to momenta: `M(q)^-1 p`.
    fn velocity(&self, q: &PositionOf<Self>, momentum: &VelocityOf<Self>) -> VelocityOf<Self>;

    /// The rate of the momenta: efforts of all declared forces and gravity, plus the derivative of the kinetic energy by
    /// the position at fixed velocity.
    fn momentum_rate(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> VelocityOf<Self>;
}

impl<S: Canonical + ?Sized> Canonical for &S {
    #[inline]
    fn momentum(&self, state: &S::State) -> VelocityOf<S> {
        (**self).momentum(state)
    }
    #[inline]
    fn velocity(&self, q: &PositionOf<S>, momentum: &VelocityOf<S>) -> VelocityOf<S> {
        (**self).velocity(q, momentum)
    }
    #[inline]
    fn momentum_rate(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> VelocityOf<S> {
        (**self).momentum_rate(t, state, input)
    }
}
