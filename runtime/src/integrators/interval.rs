//! An accepted step with all states within it: [`Interval`].

use super::dense::Dense;
use super::error::IntegrationError;
use super::method::{Attempt, Method};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advanced, displaced};
use crate::{Real, System};
use core::cell::OnceCell;

/// An accepted step, with all states within it.
pub struct Interval<'a, S: System, M: Method<S>> {
    method: &'a M,
    problem: &'a Problem<'a, S>,
    memory: &'a M::Memory,
    step: Step<'a, S>,
    start: f64,
    end: f64,
    length: f64,
    attempt: &'a Attempt<S, M::Details>,
    next: &'a S::State,
    /// What compensated summation owes the state at the start.
    rest: Option<&'a SlopeOf<S>>,
    dense: OnceCell<Dense<S>>,
}

/// A shorter step from the start of an interval.
pub(super) struct Part<S: System, M: Method<S>> {
    /// Share of the interval.
    pub(super) share: f64,
    /// `[s]` time at its end.
    pub(super) time: f64,
    /// State at its end.
    pub(super) state: S::State,
    /// The step; none for the whole interval.
    attempt: Option<Attempt<S, M::Details>>,
}

impl<'a, S: System, M: Method<S>> Interval<'a, S, M> {
    /// A step from a time to a time, of a signed length.
    pub(super) const fn new(
        (method, problem, memory): (&'a M, &'a Problem<'a, S>, &'a M::Memory),
        step: Step<'a, S>,
        (start, end, length): (f64, f64, f64),
        attempt: &'a Attempt<S, M::Details>,
        next: &'a S::State,
        rest: Option<&'a SlopeOf<S>>,
    ) -> Self {
        Self { method, problem, memory, step, start, end, length, attempt, next, rest, dense: OnceCell::new() }
    }

    /// `[s]` time at its start.
    pub const fn start(&self) -> f64 {
        self.start
    }

    /// `[s]` time at its end.
    pub const fn end(&self) -> f64 {
        self.end
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
        if t == self.end { self.share(1.0) } else { self.share((t - self.start) / self.length) }
    }

    /// The state at a share of it, from zero at the start to one at the end.
    pub fn share(&self, c: f64) -> S::State {
        let dense = self.dense.get_or_init(|| self.method.dense(self.problem, &self.step, self.memory, self.attempt));
        dense.state(S::Scalar::lit(c))
    }

    /// The state at a time within it, by a step of the method that ends there: as accurate as the states between steps,
    /// projected as they are, at the cost of a step.
    ///
    /// # Errors
    /// [`NoConvergence`](IntegrationError::NoConvergence) where an implicit method finds no solution.
    pub fn step_to(&self, t: f64) -> Result<S::State, IntegrationError> {
        self.part(if t == self.end { 1.0 } else { (t - self.start) / self.length }).map(|part| part.state)
    }

    /// `[s]` the time at a share.
    pub(super) fn time(&self, c: f64) -> f64 {
        if c == 1.0 { self.end } else { self.start + c * self.length }
    }

    /// `[s]` the signed length.
    pub(super) const fn length(&self) -> f64 {
        self.length
    }

    /// A step of the method to a share of the interval.
    pub(super) fn part(&self, share: f64) -> Result<Part<S, M>, IntegrationError> {
        let time = self.time(share);
        if share == 1.0 {
            return Ok(Part { share, time, state: *self.next, attempt: None });
        }
        let step = self.shorter(share);
        let attempt = self.method.attempt(self.problem, &step, self.memory);
        if !attempt.converged {
            return Err(IntegrationError::NoConvergence { time: self.start });
        }
        let state = match self.rest {
            Some(rest) => advanced(step.state, &attempt.displacement, rest).0,
            None => displaced(step.state, &attempt.displacement),
        };
        let state = self.problem.accepted(step.end, &state);
        Ok(Part { share, time, state, attempt: Some(attempt) })
    }

    fn shorter(&self, share: f64) -> Step<'a, S> {
        Step { end: S::Scalar::lit(self.time(share)), dt: S::Scalar::lit(share * self.length), ..Step { ..self.step } }
    }

    /// The interval of a shorter step.
    pub(super) fn cut<'b>(&'b self, part: &'b Part<S, M>) -> Interval<'b, S, M> {
        let (step, length) = match part.attempt {
            Some(_) => (self.shorter(part.share), part.share * self.length),
            None => (Step { ..self.step }, self.length),
        };
        Interval::new(
            (self.method, self.problem, self.memory),
            step,
            (self.start, part.time, length),
            part.attempt.as_ref().unwrap_or(self.attempt),
            &part.state,
            self.rest,
        )
    }

    /// What an integration goes on from after a jump.
    pub(super) fn accepted(&self, time: f64, state: &S::State) -> S::State {
        self.problem.accepted(S::Scalar::lit(time), state)
    }
}
