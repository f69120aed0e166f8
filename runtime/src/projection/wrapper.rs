//! A projection after each step of any integrator: [`WithProjection`].

use super::{Mask, Projection, finite, ones};
use crate::{
    Constrained, Differentiable, ExtraOf, Jacobian, PositionOf, Real, StateSpace, System, Tangent, VelocityOf,
};

/// A system whose states are projected at the end of every accepted step, whatever the integrator.
///
/// It is a [`System`] with the state and the input of the one it holds:
/// `Rk4::integrate(&WithProjection::new(&model, Projection::default()), ..)`. The start is not projected; see
/// [`assemble`](super::assemble).
///
/// A step has no place for an error, so where a projection fails, in one lane or in all, the velocities become NaN
/// there, and `integrate` ends in [`IntegrationError::NonFinite`](crate::IntegrationError). Loops over
/// [`Projection::project`] say why.
#[derive(Clone, Copy, Debug)]
pub struct WithProjection<S> {
    /// The system.
    pub system: S,
    projection: Projection,
    fixed: bool,
}

impl<S: Constrained> WithProjection<S> {
    /// Projects as [`Projection::project`] does, to a tolerance.
    pub const fn new(system: S, projection: Projection) -> Self {
        Self { system, projection, fixed: false }
    }

    /// Projects as [`Projection::project_fixed`] does, by a fixed number of corrections: every step costs the same.
    pub const fn fixed(system: S, projection: Projection) -> Self {
        Self { system, projection, fixed: true }
    }
}

impl<S: Constrained> System for WithProjection<S> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, state, input)
    }

    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        if self.fixed {
            return self.system.accepted(t, &self.projection.project_fixed(&self.system, t, state).state, input);
        }
        let run = self.projection.run(&self.system, t, state, &ones());
        let good: Mask<S> = run.closed & run.motion.consistent & finite::<S>(&run.motion.state);
        let (q, v, x) = run.motion.state.split();
        let v = v.map(&mut |v| Real::select(good, v, S::Scalar::lit(f64::NAN)));
        self.system.accepted(t, &state.join(q, v, x), input)
    }
}

impl<S: Constrained> Constrained for WithProjection<S> {
    type Residual = S::Residual;

    #[inline]
    fn constraints(&self, t: S::Scalar, q: &PositionOf<S>) -> S::Residual {
        self.system.constraints(t, q)
    }
    #[inline]
    fn constraint_rate(&self, t: S::Scalar, state: &S::State) -> S::Residual {
        self.system.constraint_rate(t, state)
    }
    #[inline]
    fn correction(
        &self,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
        weights: &VelocityOf<S>,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.system.correction(t, q, residual, weights)
    }
}

/// A projection comes after a step and is no part of the equations.
impl<S: Constrained + Differentiable> Differentiable for WithProjection<S> {
    type Matrix = S::Matrix;

    #[inline]
    fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Jacobian<S::Matrix> {
        self.system.jacobian(t, state, input)
    }
    #[inline]
    fn input_derivative(
        &self,
        t: S::Scalar,
        state: &S::State,
        input: &S::Input,
        change: &S::Input,
    ) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.input_derivative(t, state, input, change)
    }
}
