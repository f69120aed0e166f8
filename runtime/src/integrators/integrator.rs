//! A method with its steps: [`Integrator`].

use super::control::Tolerance;
use super::error::IntegrationError;
use super::interval::Interval;
use super::method::Method;
use super::problem::Problem;
use super::run::{Run, Verdict};
use super::sampling::Samples;
use crate::System;

/// How long steps are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// `[s]` all of one length; the last one may be shorter.
    Fixed(f64),
    /// Chosen by their error, for methods that estimate it.
    Adaptive(Tolerance),
}

/// A method with its steps: integrates any system in time.
///
/// Time is kept in `f64` for every scalar, steps of one length do not drift, and the end is met exactly. Lanes share
/// their steps, chosen for the worst of them. The number of steps is bounded, so nothing hangs.
///
/// ```
/// use multibody::{DormandPrince, Integrator, Rk4, StateSpace, System};
///
/// #[derive(Clone, Copy)]
/// struct State { q: f64, v: f64 }
///
/// impl StateSpace for State {
///     type Scalar = f64;
///     type Position = f64;
///     type Velocity = f64;
///     type Extra = ();
///     fn split(&self) -> (f64, f64, ()) { (self.q, self.v, ()) }
///     fn join(&self, q: f64, v: f64, (): ()) -> Self { Self { q, v } }
/// }
///
/// struct Oscillator;
///
/// impl System for Oscillator {
///     type Scalar = f64;
///     type State = State;
///     type Input = ();
///     fn derivative(&self, _t: f64, state: &State, (): &()) -> (f64, ()) { (-state.q, ()) }
///     fn position_rates(&self, _t: f64, state: &State) -> f64 { state.v }
/// }
///
/// # fn main() -> Result<(), multibody::IntegrationError> {
/// let start = State { q: 1.0, v: 0.0 };
/// let adaptive = Integrator::adaptive(DormandPrince, 1e-9, 1e-9);
/// let (end, statistics) = adaptive.integrate(&Oscillator, 0.0, 10.0, &start, &(), |_, _| ())?;
/// assert!((end.q - 10.0_f64.cos()).abs() < 1e-7);
/// assert!(statistics.accepted < 200);
///
/// let fixed = Integrator::fixed(Rk4, 1e-2);
/// let (end, _) = fixed.integrate(&Oscillator, 0.0, 10.0, &start, &(), |_, _| ())?;
/// assert!((end.q - 10.0_f64.cos()).abs() < 1e-7);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrator<M> {
    /// The method.
    pub method: M,
    /// The steps.
    pub steps: Steps,
    /// Greatest number of steps, accepted and rejected together.
    pub max_steps: u32,
    /// Whether what rounding leaves out of a state is kept and added to the next step (compensated summation): the
    /// rounding of long integrations then doesn't grow.
    pub compensated: bool,
}

/// What an integration took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Evaluations of the system.
    pub evaluations: u32,
    /// Evaluations of its derivatives, by implicit methods that use them.
    pub jacobians: u32,
    /// Factorisations by implicit methods.
    pub factorisations: u32,
    /// Accepted steps.
    pub accepted: u32,
    /// Rejected steps.
    pub rejected: u32,
}

impl<M> Integrator<M> {
    /// Steps of `step` `[s]`, at most 2^32 - 1 of them.
    pub const fn fixed(method: M, step: f64) -> Self {
        Self { method, steps: Steps::Fixed(step), max_steps: u32::MAX, compensated: false }
    }

    /// Steps chosen so that the error of each stays within the tolerance `absolute + relative * |y|` in the mean square
    /// over all coordinates; at most 100,000 steps. The tolerance for a rotation is that of an angle of one radian.
    pub const fn adaptive(method: M, relative: f64, absolute: f64) -> Self {
        Self::within(method, Tolerance::new(relative, absolute))
    }

    /// The same with bounds on the steps too.
    pub const fn within(method: M, tolerance: Tolerance) -> Self {
        Self { method, steps: Steps::Adaptive(tolerance), max_steps: 100_000, compensated: false }
    }

    /// The same with compensated summation. The `Symplectic` Gauss methods keep the rounding of positions and own states
    /// alone.
    #[must_use]
    pub fn compensated(self) -> Self {
        Self { compensated: true, ..self }
    }

    /// The same with another bound on the number of steps.
    #[must_use]
    pub fn max_steps(self, max_steps: u32) -> Self {
        Self { max_steps, ..self }
    }

    /// A system with these steps' tolerance, which implicit methods look at.
    pub(super) fn problem<'a, S: System>(&self, system: &'a S, input: &'a S::Input) -> Problem<'a, S> {
        let tolerance = match self.steps {
            Steps::Fixed(_) => None,
            Steps::Adaptive(tolerance) => Some(tolerance),
        };
        Problem::new(system, input).within(tolerance)
    }

    /// The state at `t1` `[s]`, from `state` at `t0` `[s]`, which may be later than `t1`, with the input held throughout.
    ///
    /// `observe` is called after every accepted step with the time and the state.
    ///
    /// # Errors
    /// See [`IntegrationError`]. The last call of `observe` had the last good state.
    pub fn integrate<S: System>(
        &self,
        system: &S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &S::Input,
        mut observe: impl FnMut(f64, &S::State),
    ) -> Result<(S::State, Statistics), IntegrationError>
    where
        M: Method<S>,
    {
        self.intervals(system, t0, t1, state, input, |interval| observe(interval.end(), interval.last()))
    }

    /// The same; `observe` sees every accepted step as an [`Interval`], with all states within it.
    ///
    /// # Errors
    /// See [`IntegrationError`].
    pub fn intervals<S: System>(
        &self,
        system: &S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &S::Input,
        mut observe: impl FnMut(&Interval<'_, S, M>),
    ) -> Result<(S::State, Statistics), IntegrationError>
    where
        M: Method<S>,
    {
        let problem = self.problem(system, input);
        let mut run = Run::new(self, &problem, t0, t1, state)?;
        while !run.arrived() {
            run.advance(|interval| {
                observe(interval);
                Ok(Verdict::Continue)
            })?;
        }
        Ok((*run.state(), run.statistics()))
    }

    /// The same; `observe` is called at the given times, which follow each other from `t0` to `t1`, with states from
    /// dense output. Steps are not changed by it. Times outside are left out; at `t0` it is the first state.
    ///
    /// ```
    /// # use multibody::{DormandPrince, Integrator, multibody};
    /// # multibody! { mod ball { world { gravity: -9.81 * Y } body ball { mass: 1.0 }
    /// #     joint height: Prismatic { parent: ground, child: ball, axis: Y } } }
    /// let tolerant = Integrator::adaptive(DormandPrince, 1e-6, 1e-6);
    /// let (mut k, start) = (0, ball::State::<f64>::default());
    /// let tenths = (0..=10).map(|k| 0.1 * f64::from(k));
    /// tolerant.sampled(&ball::Model::default(), 0.0, 1.0, &start, &(), tenths, |t, x| {
    ///     let fallen: f64 = x.q.height + 0.5 * 9.81 * t * t;
    ///     assert!(fallen.abs() < 1e-12);
    ///     k += 1;
    /// })?;
    /// assert_eq!(k, 11);
    /// # Ok::<(), multibody::IntegrationError>(())
    /// ```
    ///
    /// # Errors
    /// See [`IntegrationError`].
    #[expect(clippy::too_many_arguments, reason = "what an integration takes, and the times")]
    pub fn sampled<S: System>(
        &self,
        system: &S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &S::Input,
        times: impl IntoIterator<Item = f64>,
        mut observe: impl FnMut(f64, &S::State),
    ) -> Result<(S::State, Statistics), IntegrationError>
    where
        M: Method<S>,
    {
        let mut samples = Samples::new(times);
        samples.first(t0, state, &mut observe);
        self.intervals(system, t0, t1, state, input, |interval| samples.within(interval, &mut observe))
    }
}
