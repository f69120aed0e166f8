//! Steps chosen by error: [`Tolerance`], and a proportional-integral controller.
//!
//! After Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4 (error norm, first step),
//! and Hairer and Wanner, volume II, section IV.2 (stabilised step control, after Gustafsson 1988), with the constants
//! of their program `dopri5`.

use super::error::IntegrationError;
use super::problem::Problem;
use super::scope::Scope;
use super::slope::{SlopeOf, displaced, finite, magnitude};
use crate::{Real, System, Tangent, any};

/// Weight of the integral part, `beta` in `dopri5`, for an estimate of fifth order; in proportion for others.
const INTEGRAL: f64 = 0.2;
/// Steps aim at this share of what the estimate allows.
const SAFETY: f64 = 0.9;
/// A step shrinks at most to this share of the last one..
const SHRINK: f64 = 0.2;
/// ..and grows at most by this factor.
const GROW: f64 = 10.0;
/// What remains is taken in one step if it exceeds the step by less than this factor.
const STRETCH: f64 = 1.01;

/// Which error a step may have, and how long it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative tolerance, zero or more.
    pub relative: f64,
    /// Absolute tolerance, more than zero.
    pub absolute: f64,
    /// `[s]` length of the first step; zero to have it chosen.
    pub first_step: f64,
    /// `[s]` least length of a step (the last one may be shorter), not above the greatest; never below ten roundings of the
    /// time.
    pub min_step: f64,
    /// `[s]` greatest length of a step.
    pub max_step: f64,
}

impl Tolerance {
    /// Steps of any length.
    pub const fn new(relative: f64, absolute: f64) -> Self {
        Self { relative, absolute, first_step: 0.0, min_step: 0.0, max_step: f64::INFINITY }
    }

    /// What is wrong with these numbers, NaN among them, if anything is.
    pub(super) fn complaint<T: Real>(&self) -> Option<&'static str> {
        if !(self.relative >= 0.0 && self.relative.is_finite()) {
            Some("a relative tolerance must be finite and not negative")
        } else if !self.absolute.is_finite() || any(Real::le(T::lit(self.absolute), T::lit(0.0))) {
            Some("an absolute tolerance must be finite and, in the precision of the scalar, positive")
        } else if !(self.first_step >= 0.0 && self.first_step.is_finite()) {
            Some("a first step must be finite and not negative")
        } else if self.min_step.is_nan() || self.min_step < 0.0 {
            Some("a least step must not be negative")
        } else if self.max_step.is_nan() || self.max_step <= 0.0 {
            Some("a greatest step must be positive")
        } else if self.min_step > self.max_step {
            Some("a least step must not exceed the greatest one")
        } else {
            None
        }
    }

    /// The root of the mean square of an error, divided by the tolerance at states of the given sizes, in each lane.
    pub(super) fn norm<T: Real, V: Tangent<T>>(&self, error: &V, size: &V, other_size: &V) -> T {
        let (relative, absolute) = (T::lit(self.relative), T::lit(self.absolute));
        let greater = size.zip(other_size, &mut |a, b| Real::max(Real::abs(a), Real::abs(b)));
        let weighted = error.zip(&greater, &mut |error, size| error / (absolute + relative * size));
        let (zero, one) = (T::lit(0.0), T::lit(1.0));
        let (sum, count) = weighted.fold((zero, zero), &mut |(sum, count), e| (sum + e * e, count + one));
        Real::sqrt(sum / Real::max(count, one))
    }

    /// A first step from the size of the slope and, by one Euler step, of its change.
    fn choose_first_step<S: System>(
        &self,
        order: f64,
        problem: &Problem<'_, S>,
        (t0, t1): (f64, f64),
        state: &S::State,
        slope: &SlopeOf<S>,
        scope: &Scope<S::Scalar>,
    ) -> f64 {
        let span = (t1 - t0).abs();
        let size = magnitude(state);
        let norm = |vector: &SlopeOf<S>| scope.greatest(self.norm(vector, &size, &size));
        let (d0, d1) = (norm(&size), norm(slope));
        let guess = if d0 < 1e-5 || d1 < 1e-5 { 1e-6 } else { 0.01 * d0 / d1 };
        let euler = clamp(guess, span * 1e-12, Real::min(span, self.max_step));

        let dt = euler.copysign(t1 - t0);
        let d = slope.scale(S::Scalar::lit(dt));
        let next = problem.slope(S::Scalar::lit(t0 + dt), &displaced(state, &d));
        let change = norm(&next.add_scaled(S::Scalar::lit(-1.0), slope)) / euler;

        let steepest = if change > d1 { change } else { d1 };
        let step =
            if steepest <= 1e-15 { Real::max(1e-6, euler * 1e-3) } else { Real::powf(0.01 / steepest, 1.0 / order) };
        clamp(step, span * 1e-12, Real::min(100.0 * euler, span))
    }
}

/// The length of the next step and what it is chosen by.
pub(super) struct Control {
    /// `[s]` signed length of the next step.
    step: f64,
    min_step: f64,
    max_step: f64,
    /// Exponents of the error of this step and of the one before.
    proportional: f64,
    integral: f64,
    /// Error of the last accepted step, at least 1e-4: the memory of the integral part.
    memory: f64,
    after_rejection: bool,
}

impl Control {
    /// Steps by error, the first one chosen by the slope at the start if none is given.
    pub(super) fn start<S: System>(
        tolerance: Tolerance,
        order: u32,
        problem: &Problem<'_, S>,
        (t0, t1): (f64, f64),
        state: &S::State,
        slope: impl FnOnce() -> SlopeOf<S>,
        scope: &Scope<S::Scalar>,
    ) -> Result<Self, IntegrationError> {
        let order = f64::from(order);
        let length = if tolerance.first_step > 0.0 {
            tolerance.first_step
        } else {
            let slope = slope();
            if !scope.all(finite(&slope)) {
                return Err(IntegrationError::NonFinite { time: t0 });
            }
            tolerance.choose_first_step(order, problem, (t0, t1), state, &slope, scope)
        };
        let integral = INTEGRAL / order;
        Ok(Self {
            step: Real::min(length, tolerance.max_step).copysign(t1 - t0),
            min_step: tolerance.min_step,
            max_step: tolerance.max_step,
            proportional: 1.0 / order - 0.75 * integral,
            integral,
            memory: 1e-4,
            after_rejection: false,
        })
    }

    /// The time at which the next step ends.
    pub(super) fn target(&self, t: f64, end: f64) -> f64 {
        if self.step.abs() * STRETCH >= (end - t).abs() { end } else { t + self.step }
    }

    /// `[s]` signed length of the next step.
    pub(super) const fn step(&self) -> f64 {
        self.step
    }

    /// Takes another length for the next step.
    pub(super) const fn change_step(&mut self, step: f64) {
        self.step = step;
    }

    /// After a jump that followed a step of this length: what was learnt from errors is void, the scale remains.
    pub(super) fn restart(&mut self, length: f64) {
        self.step = Real::min(self.step.abs(), length.abs()).copysign(length);
        self.memory = 1e-4;
        self.after_rejection = false;
    }

    /// After a step that its error would have allowed, and yet can't be kept.
    pub(super) fn refuse(&mut self, length: f64) {
        self.step = 0.5 * length;
        self.after_rejection = true;
    }

    /// Whether a step is below the least one.
    pub(super) fn is_too_short(&self, t: f64, length: f64) -> bool {
        let (t, length) = (t.abs(), length.abs());
        // A step has the rounding of the times between which it lies.
        length + f64::EPSILON * (t + length) < self.min_step || length <= 10.0 * f64::EPSILON * t
    }

    /// Whether a step with this error is accepted; chooses the next one.
    pub(super) fn judge(&mut self, error: f64, length: f64) -> bool {
        if error <= 1.0 {
            let factor = Real::powf(error, self.proportional) / Real::powf(self.memory, self.integral) / SAFETY;
            let mut next = length.abs() / clamp(factor, 1.0 / GROW, 1.0 / SHRINK);
            if self.after_rejection {
                next = Real::min(next, length.abs());
            }
            self.memory = Real::max(error, 1e-4);
            self.step = Real::min(next, self.max_step).copysign(length);
            self.after_rejection = false;
            return true;
        }
        let shrink = if error.is_finite() {
            1.0 / Real::min(Real::powf(error, self.proportional) / SAFETY, 1.0 / SHRINK)
        } else {
            0.1 // no estimate: far outside of what the model can do
        };
        self.step = length * shrink;
        self.after_rejection = true;
        false
    }
}

/// `x` kept within bounds, the lower one for NaN; unlike `f64::clamp` it has no panic for bounds out of order.
fn clamp(x: f64, low: f64, high: f64) -> f64 {
    let x = if x > low { x } else { low };
    if x < high { x } else { high }
}
