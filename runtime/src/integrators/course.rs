//! What is decided about the steps of one motion: [`Course`].
//!
//! How long the next step is, whether it is kept, and why there is none. A motion is what all lanes do together, or what one of
//! them does ([`Scope`]).

use super::control::{Control, Tolerance};
use super::doubt::Doubt;
use super::error::IntegrationError;
use super::method::{Attempt, Method};
use super::outlook::{Outlook, STUCK, cause};
use super::problem::{Problem, Step};
use super::scope::Scope;
use super::slope::{SlopeOf, finite, magnitude};
use crate::{Real, System};

/// A step of this share of the longest that ends too near to a pose in which motions cross leads to nothing.
const CREEPING: f64 = 1e-3;

/// Where a motion stands, and what is known of it for its next steps.
pub(super) struct Course<T: Real> {
    scope: Scope<T>,
    /// `[s]` the time reached, and that of the end.
    pub(super) t: f64,
    pub(super) end: f64,
    /// None for steps of one length.
    control: Option<Control>,
    /// Steps so far.
    pub(super) accepted: u32,
    pub(super) rejected: u32,
    /// Motions that cross near the state.
    doubt: Doubt,
    /// Dead centres around the state.
    outlook: Outlook,
    /// `[s]` length of the last step and of the longest, without a sign.
    last: f64,
    longest: f64,
}

/// A step that is kept: what lies around its end.
pub(super) struct Kept {
    doubt: Doubt,
    outlook: Outlook,
}

impl<T: Real> Course<T> {
    /// From a time to another, nothing known. Steps are chosen by their error where there is a tolerance, the first one by the
    /// slope at the start.
    pub(super) fn start<S: System<Scalar = T>>(
        (tolerance, estimate): (Option<Tolerance>, u32),
        problem: &Problem<'_, S>,
        (t0, t1): (f64, f64),
        state: &S::State,
        slope: impl FnOnce() -> SlopeOf<S>,
        scope: Scope<T>,
    ) -> Result<Self, IntegrationError> {
        let control = match tolerance {
            None => None,
            Some(tolerance) => match Control::start(tolerance, estimate, problem, (t0, t1), state, slope, &scope) {
                Err(IntegrationError::NonFinite { .. }) => {
                    return Err(cause(problem, T::lit(t0), state, T::lit(0.0), &scope));
                }
                control => Some(control?),
            },
        };
        Ok(Self {
            scope,
            t: t0,
            end: t1,
            control,
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

    /// The lanes that this is about.
    pub(super) const fn scope(&self) -> &Scope<T> {
        &self.scope
    }

    /// Steps that were tried.
    pub(super) const fn tried(&self) -> u32 {
        self.accepted.saturating_add(self.rejected)
    }

    /// The time at which the next step ends, and its signed length, where it is chosen by its error.
    pub(super) fn target<S: System<Scalar = T>>(
        &self,
        problem: &Problem<'_, S>,
        state: &S::State,
    ) -> Result<(f64, f64), IntegrationError> {
        let Some(control) = &self.control else {
            return Ok((self.end, self.end - self.t)); // never: steps of one length are not asked for here
        };
        let target = control.target(self.t, self.end);
        let length = target - self.t; // with the rounding of the time, so that steps add up to it
        let cut = self.outlook.cut(length);
        let (target, length) = if cut == length { (target, length) } else { (self.t + cut, self.t + cut - self.t) };
        if target != self.end && control.is_too_short(self.t, length) {
            let error = IntegrationError::StepTooSmall { time: self.t, step: length.abs() };
            return Err(self.explained(error, length, problem, state));
        }
        Ok((target, length))
    }

    /// That no dead centre lies within a step of this length.
    pub(super) fn look_ahead(&self, length: f64) -> Result<(), IntegrationError> {
        self.outlook.ahead(length).map_or(Ok(()), |coordinate| Err(self.dead_centre(coordinate)))
    }

    /// Whether a step from `step.state` to `next` is within the tolerance; chooses the length of the next one. `error` is the
    /// size of its error, one if it is just tolerable.
    pub(super) fn judge<S: System<Scalar = T>, M: Method<S>>(
        &mut self,
        (method, problem): (&M, &Problem<'_, S>),
        (step, length): (&Step<'_, S>, f64),
        attempt: &Attempt<S, M::Details>,
        next: &S::State,
        error: f64,
    ) -> Result<bool, IntegrationError> {
        let (Some(tolerance), Some(control)) = (problem.tolerance(), &mut self.control) else {
            let stopped = || stopped(!self.scope.all(finite(&magnitude(next))), self.t);
            return if attempt.converged {
                Ok(true)
            } else {
                Err(self.explained(stopped(), length, problem, step.state))
            };
        };
        let mut error = if attempt.converged { error } else { f64::NAN };
        if error <= 1.0 && self.outlook.is_near(Real::max(length.abs(), self.longest)) {
            let tolerance = tolerance.relative + tolerance.absolute;
            let spread = Outlook::spread(problem, (step.end, length), next, &attempt.error, tolerance, &self.scope);
            error = if spread <= error { error } else { spread }; // NaN counts as more
            if (error.is_nan() || error > 1.0) && self.outlook.is_rounding(length) {
                return Err(self.dead_centre(self.outlook.name_ahead(length)));
            }
        }
        let accepted = control.judge(error, length);
        control.change_step(method.next_step(attempt, length, control.step()));
        if accepted {
            return Ok(true);
        }
        self.rejected += 1;
        if error.is_finite() || !control.is_too_short(self.t, control.step()) {
            return Ok(false);
        }
        let error = stopped(attempt.converged || !self.scope.all(finite(&magnitude(next))), self.t);
        Err(self.explained(error, length, problem, step.state))
    }

    /// What lies around the end of a step of this length, which the system has made `next` of; none where a shorter step is to
    /// be tried in its place.
    pub(super) fn inspect<S: System<Scalar = T>>(
        &mut self,
        problem: &Problem<'_, S>,
        (step, length): (&Step<'_, S>, f64),
        end: &S::State,
        next: &S::State,
    ) -> Result<Option<Kept>, IntegrationError> {
        let outlook = Outlook::at(problem, step.end, next, &self.scope);
        let doubt = Doubt::at(problem, step.end, end, next, &self.scope);
        let stops = if self.control.is_some() { doubt != Doubt::None } else { doubt.stops(self.doubt) };
        if stops {
            let error = IntegrationError::Ambiguous { time: self.t };
            // Steps that creep up to the pose would never come over it.
            let creeps = length.abs() < CREEPING * self.longest;
            return if creeps { Err(error) } else { self.refuse(error, length) };
        }
        if !self.scope.all(finite(&magnitude(next))) {
            return Err(self.explained(IntegrationError::NonFinite { time: self.t }, length, problem, step.state));
        }
        let passed = outlook.behind(length, &self.outlook, problem, (step.end, next));
        let passed = passed.map(|coordinate| self.dead_centre(coordinate));
        let open = outlook.open().map(|residual| IntegrationError::OpenLoops { time: self.t, residual, remedy: STUCK });
        match passed.or(open) {
            Some(error) => self.refuse(error, length),
            None => Ok(Some(Kept { doubt, outlook })),
        }
    }

    /// A shorter step in place of one whose end is not to be kept, or the error where there is none.
    fn refuse(&mut self, error: IntegrationError, length: f64) -> Result<Option<Kept>, IntegrationError> {
        let Some(control) = &mut self.control else { return Err(error) };
        control.refuse(length);
        self.rejected += 1;
        if control.is_too_short(self.t, control.step()) { Err(error) } else { Ok(None) }
    }

    /// Counts a step of this length that is kept.
    pub(super) fn keep(&mut self, kept: Kept, length: f64) {
        self.accepted += 1;
        self.doubt = kept.doubt;
        self.outlook = kept.outlook;
        self.last = length.abs();
        self.longest = Real::max(self.longest, self.last);
    }

    /// The step after one of this length starts anew: what was learnt from errors is void.
    pub(super) fn restart(&mut self, length: f64) {
        if let Some(control) = &mut self.control {
            control.restart(length);
        }
    }

    /// A state that no step led to.
    pub(super) fn jump<S: System<Scalar = T>>(&mut self, problem: &Problem<'_, S>, time: f64, state: &S::State) {
        self.outlook = Outlook::at(problem, T::lit(time), state, &self.scope);
        self.doubt = Doubt::None;
        self.t = time;
    }

    fn dead_centre(&self, coordinate: &'static str) -> IntegrationError {
        IntegrationError::DeadCentre { time: self.t, coordinate }
    }

    /// What is behind an error after a step of this length from `state`: a dead centre, or no inertia.
    fn explained<S: System<Scalar = T>>(
        &self,
        error: IntegrationError,
        length: f64,
        problem: &Problem<'_, S>,
        state: &S::State,
    ) -> IntegrationError {
        if let Some(coordinate) = self.outlook.blamed(Real::max(length.abs(), self.last).copysign(length)) {
            return self.dead_centre(coordinate);
        }
        if !matches!(error, IntegrationError::NonFinite { .. }) {
            return error;
        }
        match cause(problem, T::lit(self.t), state, T::lit(length), &self.scope) {
            IntegrationError::DeadCentre { coordinate, .. } => self.dead_centre(coordinate),
            IntegrationError::NoInertia { coordinate, .. } => IntegrationError::NoInertia { time: self.t, coordinate },
            _ => error,
        }
    }
}

/// Why a step gave no state.
const fn stopped(converged: bool, time: f64) -> IntegrationError {
    if converged { IntegrationError::NonFinite { time } } else { IntegrationError::NoConvergence { time } }
}
