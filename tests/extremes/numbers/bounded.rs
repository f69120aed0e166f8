//! A system that counts what is asked of it, and fails where no bounded method would ask so much.

use multibody::*;
use std::cell::Cell;

/// A system that may be asked only so often between two calls of [`Bounded::reset`].
pub(super) struct Bounded<'a, S> {
    system: &'a S,
    bound: u32,
    asked: Cell<u32>,
    most: Cell<u32>,
}

impl<'a, S> Bounded<'a, S> {
    pub(super) const fn new(system: &'a S, bound: u32) -> Self {
        Self { system, bound, asked: Cell::new(0), most: Cell::new(0) }
    }

    /// Another piece of work begins.
    pub(super) fn reset(&self) {
        self.asked.set(0);
    }

    /// The greatest work of one piece.
    pub(super) fn most(&self) -> u32 {
        self.most.get()
    }

    pub(super) fn count(&self) {
        self.asked.set(self.asked.get() + 1);
        self.most.set(self.most.get().max(self.asked.get()));
        assert!(self.asked.get() <= self.bound, "work without a bound: asked {} times", self.asked.get());
    }
}

impl<S: System> System for Bounded<'_, S> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.count();
        self.system.derivative(t, state, input)
    }
    fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        self.system.position_rates(t, state)
    }
    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        self.count();
        self.system.accepted(t, state, input)
    }
    fn reached(&self, t: S::Scalar, state: &S::State) {
        self.count();
        self.system.reached(t, state);
    }
    fn horizon(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        self.system.horizon(t, state)
    }
    fn margins(
        &self,
        t: S::Scalar,
        state: &S::State,
        input: &S::Input,
        visit: &mut dyn FnMut(Margin<S::Scalar>),
    ) -> S::Scalar {
        self.system.margins(t, state, input, visit)
    }
    fn opening(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Opening<S::Scalar> {
        self.system.opening(t, state, input)
    }
    fn without_inertia(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Option<&'static str> {
        self.system.without_inertia(t, state, input)
    }
}

impl<S: Constrained> Constrained for Bounded<'_, S> {
    type Residual = S::Residual;
    fn constraints(&self, t: S::Scalar, q: &PositionOf<S>) -> S::Residual {
        self.count();
        self.system.constraints(t, q)
    }
    fn constraint_rate(&self, t: S::Scalar, state: &S::State) -> S::Residual {
        self.count();
        self.system.constraint_rate(t, state)
    }
    fn correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &DisplacementOf<S>,
    ) -> (DisplacementOf<S>, S::Scalar) {
        self.count();
        self.system.correction(t, state, residual, weights)
    }
    fn velocity_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &VelocityOf<S>,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.count();
        self.system.velocity_correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: S::Scalar, state: &S::State, d: &DisplacementOf<S>) -> S::Residual {
        self.count();
        self.system.constraints_along(t, state, d)
    }
    fn least_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> Option<(DisplacementOf<S>, S::Scalar)> {
        self.count();
        self.system.least_correction(t, state, residual)
    }
    fn least_velocity_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> Option<(VelocityOf<S>, S::Scalar)> {
        self.count();
        self.system.least_velocity_correction(t, state, residual)
    }
}

impl<S: Differentiable> Differentiable for Bounded<'_, S> {
    type Matrix = S::Matrix;
    fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> JacobianOf<S> {
        self.count();
        self.system.jacobian(t, state, input)
    }
    fn input_derivative(
        &self,
        t: S::Scalar,
        state: &S::State,
        input: &S::Input,
        change: &S::Input,
    ) -> (VelocityOf<S>, ExtraOf<S>) {
        self.count();
        self.system.input_derivative(t, state, input, change)
    }
}

impl<S: Canonical> Canonical for Bounded<'_, S> {
    fn momentum(&self, state: &S::State) -> VelocityOf<S> {
        self.count();
        self.system.momentum(state)
    }
    fn velocity(&self, q: &PositionOf<S>, momentum: &VelocityOf<S>) -> VelocityOf<S> {
        self.count();
        self.system.velocity(q, momentum)
    }
    fn momentum_rate(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> VelocityOf<S> {
        self.count();
        self.system.momentum_rate(t, state, input)
    }
}

impl<S: Impulsive> Impulsive for Bounded<'_, S> {
    type Rates = S::Rates;
    fn jump(
        &self,
        t: S::Scalar,
        state: &S::State,
        impulse: &VelocityOf<S>,
        rates: &S::Rates,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.count();
        self.system.jump(t, state, impulse, rates)
    }
}

impl<S: Separable> Separable for Bounded<'_, S> {}
