//! The loop over steps: [`Run`], one attempt at a time.

use super::control::Control;
use super::doubt::Doubt;
use super::error::IntegrationError;
use super::integrator::{Integrator, Statistics, Steps};
use super::interval::Interval;
use super::method::{Attempt, Method};
use super::outlook::{Outlook, Reached, STUCK, cause, check_start};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advanced, displaced, is_finite, magnitude, owed};
use crate::{Real, System, Tangent};

/// At most so many events with a jump interrupt one step of given length: whatever a function does, a step is bounded work.
/// Steps chosen by error are bounded by their number.
const INTERRUPTIONS: u32 = 10_000;
/// A step of this share of the longest that ends too near to a pose in which motions cross leads to nothing.
const CREEPING: f64 = 1e-3;

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

/// Where an integration stands.
pub(super) struct Run<'a, S: System, M: Method<S>> {
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
    /// Whether `t` is the end of so many steps, and not a time between at which the run was restarted.
    on_grid: bool,
    /// Restarts since such a time.
    interruptions: u32,
    accepted: u32,
    rejected: u32,
    /// Motions that cross near the state.
    doubt: Doubt,
    /// Dead centres around the state.
    outlook: Outlook,
    /// `[s]` length of the last step and of the longest, without a sign.
    last: f64,
    longest: f64,
}

impl<'a, S: System, M: Method<S>> Run<'a, S, M> {
    pub(super) fn new(
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
        let start = S::Scalar::lit(t0);
        let mut memory = settings.method.begin(problem, start, state);
        if !is_finite(&magnitude(state)) {
            return Err(IntegrationError::NonFinite { time: t0 });
        }
        check_start(problem, start, state)?;
        let control = match settings.steps {
            Steps::Fixed(_) => None,
            Steps::Adaptive(tolerance) => {
                let slope = || settings.method.first_slope(problem, start, state, &mut memory);
                match Control::start(tolerance, M::ESTIMATE, problem, (t0, t1), state, slope) {
                    Err(IntegrationError::NonFinite { .. }) => {
                        return Err(cause(problem, start, state, S::Scalar::lit(0.0)));
                    }
                    control => Some(control?),
                }
            }
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
            on_grid: true,
            interruptions: 0,
            accepted: 0,
            rejected: 0,
            doubt: Doubt::None,
            outlook: Outlook::unknown(),
            last: 0.0,
            longest: 0.0,
        })
    }

    pub(super) fn arrived(&self) -> bool {
        self.t == self.end
    }

    /// `[s]` the time reached.
    pub(super) const fn time(&self) -> f64 {
        self.t
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
            let whole = self.on_grid && (!last || (remaining.abs() - step).abs() <= rounding);
            let target = if last { self.end } else { target };
            return Ok((target, if whole { step.copysign(remaining) } else { target - self.t }));
        }
        let Some(control) = &self.control else {
            return Ok((self.end, remaining)); // never: steps that are not of one length have a controller
        };
        let target = control.target(self.t, self.end);
        let length = target - self.t; // with the rounding of the time, so that steps add up to it
        let cut = self.outlook.cut(length);
        let (target, length) = if cut == length { (target, length) } else { (self.t + cut, self.t + cut - self.t) };
        if target != self.end && control.is_too_short(self.t, length) {
            let error = IntegrationError::StepTooSmall { time: self.t, step: length.abs() };
            return Err(self.explained(error, length));
        }
        Ok((target, length))
    }

    /// One attempt of a step; if it is accepted, the run goes on as `observe` says.
    pub(super) fn advance(
        &mut self,
        observe: impl FnOnce(&Interval<'_, S, M>) -> Result<Verdict<S::State>, IntegrationError>,
    ) -> Result<(), IntegrationError> {
        if self.accepted.saturating_add(self.rejected) >= self.settings.max_steps {
            return Err(IntegrationError::TooManySteps { time: self.t });
        }
        let (target, length) = self.target()?;
        if let Some(coordinate) = self.outlook.ahead(length) {
            return Err(self.dead_centre(coordinate));
        }
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
            let mut error = if attempt.converged { error } else { f64::NAN };
            if error <= 1.0 && self.outlook.is_near(Real::max(length.abs(), self.longest)) {
                let tolerance = tolerance.relative + tolerance.absolute;
                let end = (step.end, length);
                let spread = Outlook::spread(self.problem, end, &next, &attempt.error, tolerance);
                error = if spread <= error { error } else { spread }; // NaN counts as more
                if (error.is_nan() || error > 1.0) && self.outlook.is_rounding(length) {
                    return Err(self.dead_centre(self.outlook.name_ahead(length)));
                }
            }
            let accepted = control.judge(error, length);
            control.change_step(method.next_step(&attempt, length, control.step()));
            if !accepted {
                self.rejected += 1;
                self.memory = method.repeat(&self.memory, &attempt);
                return if error.is_finite() || !control.is_too_short(self.t, control.step()) {
                    Ok(())
                } else {
                    Err(self.explained(stopped(attempt.converged || !is_finite(&magnitude(&next)), self.t), length))
                };
            }
        } else if !attempt.converged {
            return Err(self.explained(stopped(!is_finite(&magnitude(&next)), self.t), length));
        }
        let end = next;
        let Reached { end: next, outlook } = Reached::new(self.problem, step.end, &end);
        let rest = if self.settings.compensated { owed(&next.state, &rest) } else { rest };
        let doubt = Doubt::at(self.problem, step.end, &end, &next.state);
        let stops = if self.control.is_some() { doubt != Doubt::None } else { doubt.stops(self.doubt) };
        if stops {
            let error = IntegrationError::Ambiguous { time: self.t };
            // Steps that creep up to the pose would never come over it.
            let creeps = length.abs() < CREEPING * self.longest;
            return if creeps { Err(error) } else { self.refuse(error, length, &attempt) };
        }
        if !is_finite(&magnitude(&next.state)) {
            return Err(self.explained(IntegrationError::NonFinite { time: self.t }, length));
        }
        let passed = outlook.behind(length, &self.outlook, self.problem, (target, &next.state));
        let passed = passed.map(|coordinate| self.dead_centre(coordinate));
        let open = outlook.open().map(|residual| IntegrationError::OpenLoops { time: self.t, residual, remedy: STUCK });
        if let Some(error) = passed.or(open) {
            return self.refuse(error, length, &attempt);
        }
        let verdict = observe(&Interval::new(
            (method, self.problem, &self.memory),
            Step { ..step },
            (self.t, target, length),
            &attempt,
            &next.state,
            self.settings.compensated.then_some(&self.rest),
        ))?;
        self.accepted += 1;
        self.doubt = doubt;
        self.last = length.abs();
        self.longest = Real::max(self.longest, self.last);
        self.outlook = outlook;
        match verdict {
            Verdict::Continue => {
                self.problem.reached(step.end, &next.state);
                if target != self.end {
                    self.memory = method.proceed(self.problem, &step, &self.memory, &attempt, &next);
                }
                self.state = next.state;
                self.rest = rest;
                self.t = target;
                self.count = self.count.saturating_add(1);
                self.on_grid = true;
                self.interruptions = 0;
            }
            Verdict::Restart { time, state } => {
                if time != self.end {
                    self.memory = method.begin(self.problem, S::Scalar::lit(time), &state);
                }
                if let Some(control) = &mut self.control {
                    control.restart(length);
                }
                self.on_grid = time == target;
                self.interruptions = if self.on_grid { 0 } else { self.interruptions + 1 };
                if self.interruptions > INTERRUPTIONS && self.control.is_none() {
                    return Err(IntegrationError::EventsAccumulate { time });
                }
                self.count = self.count.saturating_add(self.on_grid.into());
                self.jump(time, state);
            }
            Verdict::Stop { time, state } => {
                self.end = time;
                self.jump(time, state);
            }
        }
        Ok(())
    }

    /// A shorter step in place of one whose end is not to be kept, or the error where there is none.
    fn refuse(
        &mut self,
        error: IntegrationError,
        length: f64,
        attempt: &Attempt<S, M::Details>,
    ) -> Result<(), IntegrationError> {
        let Some(control) = &mut self.control else { return Err(error) };
        control.refuse(length);
        self.rejected += 1;
        self.memory = self.settings.method.repeat(&self.memory, attempt);
        if control.is_too_short(self.t, control.step()) { Err(error) } else { Ok(()) }
    }

    fn dead_centre(&self, coordinate: &'static str) -> IntegrationError {
        IntegrationError::DeadCentre { time: self.t, coordinate }
    }

    /// What is behind an error after a step of this length: a dead centre, or no inertia.
    fn explained(&self, error: IntegrationError, length: f64) -> IntegrationError {
        if let Some(coordinate) = self.outlook.blamed(Real::max(length.abs(), self.last).copysign(length)) {
            return self.dead_centre(coordinate);
        }
        if !matches!(error, IntegrationError::NonFinite { .. }) {
            return error;
        }
        match cause(self.problem, S::Scalar::lit(self.t), &self.state, S::Scalar::lit(length)) {
            IntegrationError::DeadCentre { coordinate, .. } => self.dead_centre(coordinate),
            IntegrationError::NoInertia { coordinate, .. } => IntegrationError::NoInertia { time: self.t, coordinate },
            _ => error,
        }
    }

    /// A state that no step led to.
    fn jump(&mut self, time: f64, state: S::State) {
        self.outlook = Outlook::at(self.problem, S::Scalar::lit(time), &state);
        self.doubt = Doubt::None;
        self.t = time;
        self.state = state;
        self.rest = SlopeOf::<S>::zero();
    }
}

/// Why a step gave no state.
const fn stopped(converged: bool, time: f64) -> IntegrationError {
    if converged { IntegrationError::NonFinite { time } } else { IntegrationError::NoConvergence { time } }
}
