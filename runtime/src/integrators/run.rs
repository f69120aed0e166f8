//! The loop over steps: [`Run`], one attempt at a time.

use super::course::Course;
use super::error::IntegrationError;
use super::integrator::{Integrator, Statistics, Steps};
use super::interval::Interval;
use super::method::{Accepted, Attempt, Method, OVER, proceed};
use super::outlook::{check_horizon, check_start};
use super::problem::{Problem, Step};
use super::scope::Scope;
use super::slope::{SlopeOf, advanced, displaced, is_finite, magnitude, owed};
use crate::{Real, System, Tangent};

/// At most so many events with a jump interrupt one step of given length: whatever a function does, a step is bounded work.
/// Steps chosen by error are bounded by their number.
const INTERRUPTIONS: u32 = 10_000;

/// What an observer makes of an accepted step.
pub(super) enum Verdict<Z> {
    /// The integration goes on from its end.
    Continue,
    /// It goes on from another state, at a time within the step. The end of the shorter step is reported to the system by who
    /// found it.
    Restart { time: f64, state: Z },
    /// It ends there.
    Stop { time: f64, state: Z },
}

/// The end of a step that is to be tried.
struct Target {
    /// `[s]`
    time: f64,
    /// `[s]` of the step, with its sign.
    length: f64,
    /// Whether steps of one length count it: false where it ends early.
    on_grid: bool,
}

/// Where an integration stands.
pub(super) struct Run<'a, S: System, M: Method<S>> {
    settings: &'a Integrator<M>,
    problem: &'a Problem<'a, S>,
    t0: f64,
    state: S::State,
    /// What compensated summation still owes the state.
    rest: SlopeOf<S>,
    memory: M::Memory,
    /// Of all lanes together.
    course: Course<S::Scalar>,
    /// Steps since `t0`, for steps of one length.
    count: u32,
    /// Whether the time reached is the end of so many steps, and not a time between at which the run was restarted.
    on_grid: bool,
    /// Restarts since such a time.
    interruptions: u32,
}

impl<'a, S: System, M: Method<S>> Run<'a, S, M> {
    pub(super) fn new(
        settings: &'a Integrator<M>,
        problem: &'a Problem<'a, S>,
        t0: f64,
        t1: f64,
        state: &S::State,
    ) -> Result<Self, IntegrationError> {
        if let Steps::Fixed(step) = settings.steps
            && step > 0.0
            && step.is_finite()
            && (t1 - t0).abs() / step > f64::from(settings.max_steps) + 0.5
        {
            return Err(IntegrationError::TooManySteps { time: t0 });
        }
        let mut memory = begin(settings, problem, (t0, t1), state)?;
        let slope = || settings.method.first_slope(problem, S::Scalar::lit(t0), state, &mut memory);
        let control = (problem.tolerance(), M::ESTIMATE);
        let course = Course::start(control, problem, (t0, t1), state, slope, Scope::whole())?;
        Ok(Self {
            settings,
            problem,
            t0,
            state: *state,
            rest: SlopeOf::<S>::zero(),
            memory,
            course,
            count: 0,
            on_grid: true,
            interruptions: 0,
        })
    }

    pub(super) fn arrived(&self) -> bool {
        self.course.arrived()
    }

    /// `[s]` the time reached.
    pub(super) const fn time(&self) -> f64 {
        self.course.t
    }

    /// The state reached.
    pub(super) const fn state(&self) -> &S::State {
        &self.state
    }

    pub(super) fn statistics(&self) -> Statistics {
        Statistics {
            evaluations: self.problem.evaluations(),
            jacobians: self.problem.jacobians(),
            factorisations: self.problem.factorisations(),
            accepted: self.course.accepted,
            rejected: self.course.rejected,
        }
    }

    /// Where the next step ends: where its length leads to, or before it at the horizon.
    fn target(&self) -> Result<Target, IntegrationError> {
        let target = self.target_alone()?;
        let scope = self.course.scope();
        let t = S::Scalar::lit(self.course.t);
        let horizon = -scope.greatest(-self.problem.horizon(t, &self.state));
        if horizon.is_nan() {
            let what = "lanes came to a sample at different times";
            return Err(IntegrationError::InvalidArgument { what });
        }
        // With steps of one length a difference of rounding is none.
        let near = match self.settings.steps {
            Steps::Fixed(step) => horizon + OVER * step,
            Steps::Adaptive(_) => horizon,
        };
        if near < target.time {
            return Ok(Target { time: horizon, length: horizon - self.course.t, on_grid: false });
        }
        Ok(target)
    }

    fn target_alone(&self) -> Result<Target, IntegrationError> {
        let Steps::Fixed(step) = self.settings.steps else {
            let (time, length) = self.course.target(self.problem, &self.state)?;
            return Ok(Target { time, length, on_grid: true });
        };
        let (t, end) = (self.course.t, self.course.end);
        let remaining = end - t;
        // A remainder of less than a millionth of a step is rounding.
        let target = self.t0 + (f64::from(self.count) + 1.0) * step.copysign(remaining);
        let last = (end - target).abs() <= 1e-6 * step || (end - target) * remaining < 0.0;
        let rounding = 4.0 * f64::EPSILON * (t.abs() + end.abs());
        let whole = self.on_grid && (!last || (remaining.abs() - step).abs() <= rounding);
        let target = if last { end } else { target };
        Ok(Target { time: target, length: if whole { step.copysign(remaining) } else { target - t }, on_grid: true })
    }

    /// One attempt of a step; if it is accepted, the run goes on as `observe` says.
    pub(super) fn advance(
        &mut self,
        observe: impl FnOnce(&Interval<'_, S, M>) -> Result<Verdict<S::State>, IntegrationError>,
    ) -> Result<(), IntegrationError> {
        let start = self.course.t;
        if self.course.tried() >= self.settings.max_steps {
            return Err(IntegrationError::TooManySteps { time: start });
        }
        let Target { time: target, length, on_grid } = self.target()?;
        self.course.look_ahead(length)?;
        let state = self.state;
        let step = Step {
            t: S::Scalar::lit(start),
            end: S::Scalar::lit(target),
            dt: S::Scalar::lit(length),
            state: &state,
            full: true,
        };
        let (method, problem) = (&self.settings.method, self.problem);
        let attempt = method.attempt(problem, &step, &self.memory);

        let (end, rest) = if self.settings.compensated {
            advanced(&state, &attempt.displacement, &self.rest)
        } else {
            (displaced(&state, &attempt.displacement), self.rest)
        };
        let error = error(method, problem, &step, &attempt, &end).greatest();
        if !self.course.judge((method, problem), (&step, length), &attempt, &end, error)? {
            self.memory = method.repeat(&self.memory, &attempt);
            return Ok(());
        }
        let next = Accepted::new(problem, &step, &end);
        let rest = if self.settings.compensated { owed(&next.state, &rest) } else { rest };
        let Some(kept) = self.course.inspect(problem, (&step, length), &end, &next.state)? else {
            self.memory = method.repeat(&self.memory, &attempt);
            return Ok(());
        };
        let verdict = observe(&Interval::new(
            (method, problem, &self.memory),
            Step { ..step },
            (start, target, length),
            &attempt,
            &next.state,
            self.settings.compensated.then_some(&self.rest),
        ))?;
        self.course.keep(kept, length);
        match verdict {
            Verdict::Continue => {
                problem.reached(step.end, &next.state);
                if target != self.course.end {
                    self.memory = proceed(method, problem, &step, &self.memory, &attempt, &next);
                }
                self.state = next.state;
                self.rest = rest;
                self.course.t = target;
                self.count = self.count.saturating_add(on_grid.into());
                self.on_grid = on_grid;
                self.interruptions = 0;
            }
            Verdict::Restart { time, state } => {
                if time != self.course.end {
                    self.memory = method.begin(problem, S::Scalar::lit(time), &state);
                }
                self.course.restart(length);
                self.on_grid = on_grid && time == target;
                self.interruptions = if self.on_grid { 0 } else { self.interruptions + 1 };
                if self.interruptions > INTERRUPTIONS && matches!(self.settings.steps, Steps::Fixed(_)) {
                    return Err(IntegrationError::EventsAccumulate { time });
                }
                self.count = self.count.saturating_add(self.on_grid.into());
                self.jump(time, state);
            }
            Verdict::Stop { time, state } => {
                self.course.end = time;
                self.jump(time, state);
            }
        }
        Ok(())
    }

    /// A state that no step led to.
    fn jump(&mut self, time: f64, state: S::State) {
        self.course.jump(self.problem, time, &state);
        self.state = state;
        self.rest = SlopeOf::<S>::zero();
    }
}

/// The memory of a method at a start with which nothing is wrong.
pub(super) fn begin<S: System, M: Method<S>>(
    settings: &Integrator<M>,
    problem: &Problem<'_, S>,
    (t0, t1): (f64, f64),
    state: &S::State,
) -> Result<M::Memory, IntegrationError> {
    let what = if !(t1 - t0).is_finite() {
        Some("the times of an integration must be finite, and so must their difference")
    } else {
        match settings.steps {
            Steps::Fixed(step) if step > 0.0 && step.is_finite() => None,
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
    let start = S::Scalar::lit(t0);
    let memory = settings.method.begin(problem, start, state);
    if !is_finite(&magnitude(state)) {
        return Err(IntegrationError::NonFinite { time: t0 });
    }
    check_start(problem, start, state)?;
    check_horizon(problem, start, state, t1 < t0)?;
    Ok(memory)
}

/// The size of a step's error, one where it is just tolerable, in each lane; zero for steps of one length.
pub(super) fn error<S: System, M: Method<S>>(
    method: &M,
    problem: &Problem<'_, S>,
    step: &Step<'_, S>,
    attempt: &Attempt<S, M::Details>,
    end: &S::State,
) -> S::Scalar {
    let Some(tolerance) = problem.tolerance() else { return S::Scalar::lit(0.0) };
    let (size, other_size) = (magnitude(step.state), magnitude(end));
    method.error(step, attempt, |vector| tolerance.norm(vector, &size, &other_size))
}
