//! A method with its steps: [`Integrator`].

use super::control::{Control, Tolerance};
use super::dense::Dense;
use super::error::IntegrationError;
use super::method::{Attempt, Method};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advanced, displaced, is_finite, magnitude};
use crate::{Real, System, Tangent};
use core::cell::OnceCell;

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
    /// Accepted steps.
    pub accepted: u32,
    /// Rejected steps.
    pub rejected: u32,
}

/// An accepted step, with all states within it.
pub struct Interval<'a, S: System, M: Method<S>> {
    method: &'a M,
    problem: &'a Problem<'a, S>,
    step: Step<'a, S>,
    times: (f64, f64),
    memory: &'a M::Memory,
    attempt: &'a Attempt<S, M::Details>,
    next: &'a S::State,
    dense: OnceCell<Dense<S>>,
}

impl<S: System, M: Method<S>> Interval<'_, S, M> {
    /// `[s]` time at its start.
    pub const fn start(&self) -> f64 {
        self.times.0
    }

    /// `[s]` time at its end.
    pub const fn end(&self) -> f64 {
        self.times.1
    }

    /// The state at its start.
    pub const fn first(&self) -> &S::State {
        self.step.state
    }

    /// The state at its end.
    pub const fn last(&self) -> &S::State {
        self.next
    }

    /// The state at a time within it, by the dense output of the method. Times outside are extrapolated.
    ///
    /// States within are not projected and hold no renewed guess, as [`System::accepted`] gives at the end.
    pub fn at(&self, t: f64) -> S::State {
        let (start, end) = self.times;
        self.share(if t == end { 1.0 } else { (t - start) / (end - start) })
    }

    /// The state at a share of it, from zero at the start to one at the end.
    pub fn share(&self, c: f64) -> S::State {
        let dense = self.dense.get_or_init(|| self.method.dense(self.problem, &self.step, self.memory, self.attempt));
        dense.state(S::Scalar::lit(c))
    }
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

    /// The same with compensated summation.
    #[must_use]
    pub fn compensated(self) -> Self {
        Self { compensated: true, ..self }
    }

    /// The same with another bound on the number of steps.
    #[must_use]
    pub fn max_steps(self, max_steps: u32) -> Self {
        Self { max_steps, ..self }
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
        let problem = Problem::new(system, input);
        let mut run = Run::new(self, &problem, t0, t1, state)?;
        while !run.arrived() {
            run.advance(&mut observe)?;
        }
        Ok((run.state, run.statistics()))
    }
}

/// Where an integration stands.
struct Run<'a, S: System, M: Method<S>> {
    settings: &'a Integrator<M>,
    problem: &'a Problem<'a, S>,
    t0: f64,
    t: f64,
    end: f64,
    state: S::State,
    /// What compensated summation still owes the state.
    rest: SlopeOf<S>,
    memory: M::Memory,
    /// None for steps of one length.
    control: Option<Control>,
    /// Steps since `t0`, for steps of one length.
    count: u32,
    accepted: u32,
    rejected: u32,
}

impl<'a, S: System, M: Method<S>> Run<'a, S, M> {
    fn new(
        settings: &'a Integrator<M>,
        problem: &'a Problem<'a, S>,
        t0: f64,
        t1: f64,
        state: &S::State,
    ) -> Result<Self, IntegrationError> {
        let what = if !(t1 - t0).is_finite() {
            Some("the times of an integration must be finite, and so must their difference")
        } else {
            match settings.steps {
                Steps::Fixed(step) if step > 0.0 && step.is_finite() => {
                    if (t1 - t0).abs() / step > f64::from(settings.max_steps) + 0.5 {
                        return Err(IntegrationError::TooManySteps { time: t0 });
                    }
                    None
                }
                Steps::Fixed(_) => Some("a step must be finite and positive"),
                Steps::Adaptive(_) if M::ESTIMATE == 0 => {
                    Some("this method does not estimate its error: its steps have to be given")
                }
                Steps::Adaptive(tolerance) => tolerance.complaint::<S::Scalar>(),
            }
        };
        if let Some(what) = what {
            return Err(IntegrationError::InvalidArgument { what });
        }
        let memory = settings.method.begin(problem, S::Scalar::lit(t0), state);
        if !is_finite(&magnitude(state)) {
            return Err(IntegrationError::NonFinite { time: t0 });
        }
        let control = match settings.steps {
            Steps::Fixed(_) => None,
            Steps::Adaptive(tolerance) => Some(Control::start(tolerance, M::ESTIMATE, problem, t0, t1, state)?),
        };
        Ok(Self {
            settings,
            problem,
            t0,
            t: t0,
            end: t1,
            state: *state,
            rest: SlopeOf::<S>::zero(),
            memory,
            control,
            count: 0,
            accepted: 0,
            rejected: 0,
        })
    }

    fn arrived(&self) -> bool {
        self.t == self.end
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            evaluations: self.problem.evaluations(),
            jacobians: self.problem.jacobians(),
            accepted: self.accepted,
            rejected: self.rejected,
        }
    }

    /// The time at which the next step ends, and its signed length.
    fn target(&self) -> Result<(f64, f64), IntegrationError> {
        let remaining = self.end - self.t;
        if let Steps::Fixed(step) = self.settings.steps {
            // A remainder of less than a millionth of a step is rounding.
            let target = self.t0 + (f64::from(self.count) + 1.0) * step.copysign(remaining);
            let last = (self.end - target).abs() <= 1e-6 * step || (self.end - target) * remaining < 0.0;
            let rounding = 4.0 * f64::EPSILON * (self.t.abs() + self.end.abs());
            let whole = !last || (remaining.abs() - step).abs() <= rounding;
            return Ok((
                if last { self.end } else { target },
                if whole { step.copysign(remaining) } else { remaining },
            ));
        }
        let Some(control) = &self.control else {
            return Ok((self.end, remaining)); // never: steps that are not of one length have a controller
        };
        let target = control.target(self.t, self.end);
        let length = target - self.t; // with the rounding of the time, so that steps add up to it
        if target != self.end && control.is_too_short(self.t, length) {
            return Err(IntegrationError::StepTooSmall { time: self.t, step: length.abs() });
        }
        Ok((target, length))
    }

    /// One attempt of a step; if it is accepted, the run goes on from its end.
    fn advance(&mut self, observe: &mut impl FnMut(&Interval<'_, S, M>)) -> Result<(), IntegrationError> {
        if self.accepted.saturating_add(self.rejected) >= self.settings.max_steps {
            return Err(IntegrationError::TooManySteps { time: self.t });
        }
        let (target, length) = self.target()?;
        let state = self.state;
        let step = Step {
            t: S::Scalar::lit(self.t),
            end: S::Scalar::lit(target),
            dt: S::Scalar::lit(length),
            state: &state,
            full: true,
        };
        let method = &self.settings.method;
        let attempt = method.attempt(self.problem, &step, &self.memory);

        let (next, rest) = if self.settings.compensated {
            advanced(&state, &attempt.displacement, &self.rest)
        } else {
            (displaced(&state, &attempt.displacement), self.rest)
        };
        if let (Steps::Adaptive(tolerance), Some(control)) = (self.settings.steps, &mut self.control) {
            let (size, next_size) = (magnitude(&state), magnitude(&next));
            let error = method.error(&step, &attempt, |vector| tolerance.norm(vector, &size, &next_size)).greatest();
            let error = if attempt.converged { error } else { f64::NAN };
            if !control.judge(error, length) {
                self.rejected += 1;
                return if error.is_finite() || !control.is_too_short(self.t, control.step()) {
                    Ok(())
                } else {
                    Err(stopped(attempt.converged, self.t))
                };
            }
        } else if !attempt.converged {
            return Err(stopped(!is_finite(&magnitude(&next)), self.t));
        }
        let next = self.problem.accepted(step.end, &next);
        if !is_finite(&magnitude(&next)) {
            return Err(IntegrationError::NonFinite { time: self.t });
        }
        observe(&Interval {
            method,
            problem: self.problem,
            step: Step { ..step },
            times: (self.t, target),
            memory: &self.memory,
            attempt: &attempt,
            next: &next,
            dense: OnceCell::new(),
        });
        if target != self.end {
            self.memory = method.proceed(self.problem, &step, &self.memory, &attempt, &next);
        }
        self.state = next;
        self.rest = rest;
        self.t = target;
        self.count = self.count.saturating_add(1);
        self.accepted += 1;
        Ok(())
    }
}

/// Why a step gave no state.
const fn stopped(converged: bool, time: f64) -> IntegrationError {
    if converged { IntegrationError::NonFinite { time } } else { IntegrationError::NoConvergence { time } }
}
