//! What a method works on: a [`Problem`], and one [`Step`] of it.

use super::control::Tolerance;
use super::slope::{SlopeOf, displaced, rate_of_displacement};
use crate::{
    Canonical, Differentiable, DisplacementOf, ExtraOf, JacobianOf, Margin, Opening, Real, System, VelocityOf,
};
use core::cell::Cell;

/// A system with the input that is held, counting its evaluations.
#[derive(Debug)]
pub struct Problem<'a, S: System> {
    /// The system.
    pub system: &'a S,
    /// The input.
    pub input: &'a S::Input,
    evaluations: Cell<u32>,
    jacobians: Cell<u32>,
    factorisations: Cell<u32>,
    tolerance: Option<Tolerance>,
}

impl<'a, S: System> Problem<'a, S> {
    /// Nothing is evaluated yet.
    #[inline]
    pub const fn new(system: &'a S, input: &'a S::Input) -> Self {
        Self {
            system,
            input,
            evaluations: Cell::new(0),
            jacobians: Cell::new(0),
            factorisations: Cell::new(0),
            tolerance: None,
        }
    }

    /// The same, to be solved within a tolerance.
    #[inline]
    #[must_use]
    pub fn within(self, tolerance: Option<Tolerance>) -> Self {
        Self { tolerance, ..self }
    }

    /// The tolerance that steps are chosen by; none for steps of one length, whose equations implicit methods solve to
    /// rounding.
    #[inline]
    pub const fn tolerance(&self) -> Option<Tolerance> {
        self.tolerance
    }

    /// The slope at a state.
    #[inline]
    pub fn slope(&self, t: S::Scalar, state: &S::State) -> SlopeOf<S> {
        self.evaluations.set(self.evaluations.get().saturating_add(1));
        self.system.slope(t, state, self.input)
    }

    /// Accelerations and rates of own states alone, which count as an evaluation: see [`System::derivative`].
    #[inline]
    pub fn derivative(&self, t: S::Scalar, state: &S::State) -> (VelocityOf<S>, ExtraOf<S>) {
        self.evaluations.set(self.evaluations.get().saturating_add(1));
        self.system.derivative(t, state, self.input)
    }

    /// The rates of the position, which don't count: see [`System::position_rates`].
    #[inline]
    pub fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        self.system.position_rates(t, state)
    }

    /// The slope at the end of the displacement `d` from `state`, as the rate of that displacement.
    #[inline]
    pub fn stage(&self, t: S::Scalar, state: &S::State, d: &SlopeOf<S>) -> SlopeOf<S> {
        rate_of_displacement::<S>(d, &self.slope(t, &displaced(state, d)))
    }

    /// What an integration goes on from after a step to `state`: see [`System::accepted`].
    #[inline]
    pub fn accepted(&self, t: S::Scalar, state: &S::State) -> S::State {
        self.system.accepted(t, state, self.input)
    }

    /// To be called with the end of a step that is kept: see [`System::reached`].
    #[inline]
    pub fn reached(&self, t: S::Scalar, state: &S::State) {
        self.system.reached(t, state);
    }

    /// Until when one law holds: see [`System::horizon`].
    #[inline]
    pub fn horizon(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        self.system.horizon(t, state)
    }

    /// Calls with every dead centre that the loops have: see [`System::margins`].
    #[inline]
    pub fn margins(&self, t: S::Scalar, state: &S::State, visit: &mut dyn FnMut(Margin<S::Scalar>)) -> S::Scalar {
        self.system.margins(t, state, self.input, visit)
    }

    /// How far the loops are open at a start: see [`System::opening`].
    #[inline]
    pub fn opening(&self, t: S::Scalar, state: &S::State) -> Opening<S::Scalar> {
        self.system.opening(t, state, self.input)
    }

    /// How unclear it is which motion goes on: see [`System::ambiguity`].
    #[inline]
    pub fn ambiguity(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        self.system.ambiguity(t, state, self.input)
    }

    /// A coordinate without inertia: see [`System::without_inertia`].
    #[inline]
    pub fn without_inertia(&self, t: S::Scalar, state: &S::State) -> Option<&'static str> {
        self.system.without_inertia(t, state, self.input)
    }

    /// Evaluations of the system so far.
    #[inline]
    pub const fn evaluations(&self) -> u32 {
        self.evaluations.get()
    }

    /// Evaluations of its derivatives so far.
    #[inline]
    pub const fn jacobians(&self) -> u32 {
        self.jacobians.get()
    }

    /// To be called where an implicit method factors its matrices.
    #[inline]
    pub fn count_factorisation(&self) {
        self.factorisations.set(self.factorisations.get().saturating_add(1));
    }

    /// Factorisations of an implicit method's matrices so far.
    #[inline]
    pub const fn factorisations(&self) -> u32 {
        self.factorisations.get()
    }
}

impl<S: Differentiable> Problem<'_, S> {
    /// Derivatives of the system: see [`Differentiable::jacobian`].
    #[inline]
    pub fn jacobian(&self, t: S::Scalar, state: &S::State) -> JacobianOf<S> {
        self.jacobians.set(self.jacobians.get().saturating_add(1));
        self.system.jacobian(t, state, self.input)
    }
}

impl<S: Canonical> Problem<'_, S> {
    /// The rate of the momenta, which counts as an evaluation.
    #[inline]
    pub fn momentum_rate(&self, t: S::Scalar, state: &S::State) -> VelocityOf<S> {
        self.evaluations.set(self.evaluations.get().saturating_add(1));
        self.system.momentum_rate(t, state, self.input)
    }
}

/// A step that is to be taken.
#[derive(Debug)]
pub struct Step<'a, S: System> {
    /// `[s]` time at its start.
    pub t: S::Scalar,
    /// `[s]` time at its end.
    pub end: S::Scalar,
    /// `[s]` its length; negative backwards in time.
    pub dt: S::Scalar,
    /// State at its start.
    pub state: &'a S::State,
    /// Whether the estimate of the error and dense output may be asked for. Without, a step costs no more than its
    /// stages.
    pub full: bool,
}

impl<S: System> Step<'_, S> {
    /// The time at the node `c`, from zero at the start to one at the end.
    #[inline]
    pub fn time(&self, c: f64) -> S::Scalar {
        if c == 1.0 { self.end } else { self.t + S::Scalar::lit(c) * self.dt }
    }
}
