//! Steps chosen by error: [`Adaptive`], a proportional-integral controller around the pair of Dormand and Prince.
//!
//! After Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4 (error norm, first step),
//! and Hairer and Wanner, volume II, section IV.2 (stabilised step control, after Gustafsson 1988), with the constants
//! of their program `dopri5`.

use super::dormand_prince::Stages;
use super::error::IntegrationError;
use super::slope::{SlopeOf, displaced, is_finite, magnitude, rate_of_displacement, slope};
use crate::{Real, StateSpace, System, Tangent, any};

/// Weight of the integral part, `beta` in `dopri5`.
const INTEGRAL: f64 = 0.04;
/// Exponent of the proportional part: 1/5 less three quarters of the integral part.
const PROPORTIONAL: f64 = 0.2 - 0.75 * INTEGRAL;
/// Steps aim at this share of what the estimate allows.
const SAFETY: f64 = 0.9;
/// A step shrinks at most to this share of the last one..
const SHRINK: f64 = 0.2;
/// ..and grows at most by this factor.
const GROW: f64 = 10.0;
/// What remains is taken in one step if it exceeds the step by less than this factor.
const STRETCH: f64 = 1.01;

/// Integration with the pair 5(4) of Dormand and Prince and steps chosen so that the error of each stays within the
/// tolerance `absolute + relative * |y|` in the mean square over all coordinates.
///
/// Time is kept in `f64` for every scalar, and the end is met exactly. The tolerance for a rotation is that of an angle
/// of one radian. Lanes share their steps, chosen for the worst of them.
///
/// ```
/// use multibody::{Adaptive, StateSpace, System};
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
/// let (end, statistics) = Adaptive::new(1e-9, 1e-9).integrate(&Oscillator, 0.0, 10.0, &start, &(), |_, _| ())?;
/// assert!((end.q - 10.0_f64.cos()).abs() < 1e-7);
/// assert!(statistics.accepted < 200);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive {
    /// Relative tolerance, zero or more.
    pub relative: f64,
    /// Absolute tolerance, more than zero.
    pub absolute: f64,
    /// `[s]` length of the first step; zero to have it chosen.
    pub first_step: f64,
    /// `[s]` least length of a step (the last one may be shorter); never below ten roundings of the time.
    pub min_step: f64,
    /// `[s]` greatest length of a step.
    pub max_step: f64,
    /// Greatest number of steps, accepted and rejected together.
    pub max_steps: u32,
}

/// What an adaptive integration took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Evaluations of the system.
    pub evaluations: u32,
    /// Accepted steps.
    pub accepted: u32,
    /// Rejected steps.
    pub rejected: u32,
}

/// How one step went.
enum Attempt {
    Rejected,
    Accepted,
    Arrived,
}

/// Where an integration stands.
struct Run<'a, S: System> {
    settings: &'a Adaptive,
    system: &'a S,
    input: &'a S::Input,
    t: f64,
    end: f64,
    /// Signed length of the next step.
    step: f64,
    state: S::State,
    slope: SlopeOf<S>,
    /// Error of the last accepted step, at least 1e-4: the memory of the integral part.
    memory: f64,
    after_rejection: bool,
    statistics: Statistics,
}

impl Adaptive {
    /// Tolerances `relative` and `absolute`; at most 100,000 steps of any length.
    pub const fn new(relative: f64, absolute: f64) -> Self {
        Self { relative, absolute, first_step: 0.0, min_step: 0.0, max_step: f64::INFINITY, max_steps: 100_000 }
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
    ) -> Result<(S::State, Statistics), IntegrationError> {
        self.check::<S::Scalar>(t0, t1)?;
        let mut run = Run::new(self, system, t0, t1, state, input)?;
        if t0 == t1 {
            return Ok((run.state, run.statistics));
        }
        for _ in 0..self.max_steps {
            match run.attempt()? {
                Attempt::Rejected => {}
                Attempt::Accepted => observe(run.t, &run.state),
                Attempt::Arrived => {
                    observe(run.t, &run.state);
                    return Ok((run.state, run.statistics));
                }
            }
        }
        Err(IntegrationError::TooManySteps { time: run.t })
    }

    /// Refuses arguments that no integration can work with, NaN among them.
    fn check<T: Real>(&self, t0: f64, t1: f64) -> Result<(), IntegrationError> {
        let what = if !(t1 - t0).is_finite() {
            "the times of an integration must be finite, and so must their difference"
        } else if !(self.relative >= 0.0 && self.relative.is_finite()) {
            "a relative tolerance must be finite and not negative"
        } else if !self.absolute.is_finite() || any(Real::le(T::lit(self.absolute), T::lit(0.0))) {
            "an absolute tolerance must be finite and, in the precision of the scalar, positive"
        } else if !(self.first_step >= 0.0 && self.first_step.is_finite()) {
            "a first step must be finite and not negative"
        } else if self.min_step.is_nan() || self.min_step < 0.0 {
            "a least step must not be negative"
        } else if self.max_step.is_nan() || self.max_step <= 0.0 {
            "a greatest step must be positive"
        } else {
            return Ok(());
        };
        Err(IntegrationError::InvalidArgument { what })
    }

    /// The mean square of an error, divided by the tolerance at states of the given sizes; the worst of all lanes.
    fn norm<T: Real, V: Tangent<T>>(&self, error: &V, size: &V, other_size: &V) -> f64 {
        let (relative, absolute) = (T::lit(self.relative), T::lit(self.absolute));
        let greater = size.zip(other_size, &mut |a, b| Real::max(Real::abs(a), Real::abs(b)));
        let weighted = error.zip(&greater, &mut |error, size| error / (absolute + relative * size));
        let (sum, count) = weighted.fold((T::lit(0.0), 0.0), &mut |(sum, count), e| (sum + e * e, count + 1.0));
        Real::sqrt(Real::greatest(sum) / Real::max(count, 1.0))
    }
}

impl<'a, S: System> Run<'a, S> {
    fn new(
        settings: &'a Adaptive,
        system: &'a S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &'a S::Input,
    ) -> Result<Self, IntegrationError> {
        let slope = slope(system, S::Scalar::lit(t0), state, input);
        if !(is_finite(&magnitude(state)) && is_finite(&slope)) {
            return Err(IntegrationError::NonFinite { time: t0 });
        }
        let statistics = Statistics { evaluations: 1, ..Statistics::default() };
        let mut run = Self {
            settings,
            system,
            input,
            t: t0,
            end: t1,
            step: 0.0,
            state: *state,
            slope,
            memory: 1e-4,
            after_rejection: false,
            statistics,
        };
        let length = if settings.first_step > 0.0 { settings.first_step } else { run.first_step() };
        run.step = Real::min(length, settings.max_step).copysign(t1 - t0);
        Ok(run)
    }

    /// A first step from the size of the slope and, by one Euler step, of its change.
    fn first_step(&mut self) -> f64 {
        let span = (self.end - self.t).abs();
        let size = magnitude(&self.state);
        let norm = |vector: &SlopeOf<S>| self.settings.norm(vector, &size, &size);
        let (d0, d1) = (norm(&size), norm(&self.slope));
        let guess = if d0 < 1e-5 || d1 < 1e-5 { 1e-6 } else { 0.01 * d0 / d1 };
        let euler = clamp(guess, span * 1e-12, Real::min(span, self.settings.max_step));

        let dt = euler.copysign(self.end - self.t);
        let d = self.slope.scale(S::Scalar::lit(dt));
        let next = slope(self.system, S::Scalar::lit(self.t + dt), &displaced(&self.state, &d), self.input);
        let change = norm(&next.add_scaled(S::Scalar::lit(-1.0), &self.slope)) / euler;
        self.statistics.evaluations += 1;

        let steepest = if change > d1 { change } else { d1 };
        let step = if steepest <= 1e-15 { Real::max(1e-6, euler * 1e-3) } else { Real::powf(0.01 / steepest, 0.2) };
        clamp(step, span * 1e-12, Real::min(100.0 * euler, span))
    }

    /// One step, accepted or not.
    fn attempt(&mut self) -> Result<Attempt, IntegrationError> {
        let remaining = self.end - self.t;
        let last = self.step.abs() * STRETCH >= remaining.abs();
        let target = if last { self.end } else { self.t + self.step };
        // What the rounding of the time leaves of the step, so that steps add up to the time.
        let step = target - self.t;
        let least = Real::max(self.settings.min_step, 10.0 * f64::EPSILON * self.t.abs());
        if !last && step.abs() <= least {
            return Err(IntegrationError::StepTooSmall { time: self.t, step: self.step.abs() });
        }

        let dt = S::Scalar::lit(step);
        let time = |c: f64| S::Scalar::lit(if c == 1.0 { target } else { self.t + c * step });
        let stages = Stages::new(self.system, time, &self.state, self.input, dt, &self.slope);
        let next = displaced(&self.state, &stages.displacement);
        let slope = slope(self.system, time(1.0), &next, self.input);
        let error = stages.error(dt, &rate_of_displacement::<S>(&stages.displacement, &slope));
        let error = self.settings.norm(&error, &magnitude(&self.state), &magnitude(&next));
        self.statistics.evaluations = self.statistics.evaluations.saturating_add(6);

        if error <= 1.0 {
            let mut factor = Real::powf(error, PROPORTIONAL) / Real::powf(self.memory, INTEGRAL) / SAFETY;
            factor = clamp(factor, 1.0 / GROW, 1.0 / SHRINK);
            let mut length = step.abs() / factor;
            if self.after_rejection {
                length = Real::min(length, step.abs());
            }
            self.memory = Real::max(error, 1e-4);
            self.state = self.system.accepted(S::Scalar::lit(target), &next, self.input);
            if !is_finite(&magnitude(&self.state)) {
                return Err(IntegrationError::NonFinite { time: self.t });
            }
            self.t = target;
            let (_, velocity, _) = self.state.split(); // a projection has changed it
            self.slope = SlopeOf::<S> { q: velocity, ..slope };
            self.step = Real::min(length, self.settings.max_step).copysign(step);
            self.after_rejection = false;
            self.statistics.accepted += 1;
            return Ok(if last { Attempt::Arrived } else { Attempt::Accepted });
        }

        let shrink = if error.is_finite() {
            1.0 / Real::min(Real::powf(error, PROPORTIONAL) / SAFETY, 1.0 / SHRINK)
        } else {
            0.1 // no estimate: far outside of what the model can do
        };
        self.step = step * shrink;
        self.after_rejection = true;
        self.statistics.rejected += 1;
        if error.is_finite() || self.step.abs() > least {
            return Ok(Attempt::Rejected);
        }
        Err(IntegrationError::NonFinite { time: self.t })
    }
}

/// `x` kept within bounds, the lower one for NaN; unlike `f64::clamp` it has no panic for bounds out of order.
fn clamp(x: f64, low: f64, high: f64) -> f64 {
    let x = if x > low { x } else { low };
    if x < high { x } else { high }
}
