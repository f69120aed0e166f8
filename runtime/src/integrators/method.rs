//! What a method is: [`Method`], one attempt of a step at a time; and the loop over steps of one length.

use super::dense::Dense;
use super::doubt::Doubt;
use super::error::IntegrationError;
use super::outlook::{Soundness, cause, check_horizon, check_start};
use super::problem::{Problem, Step};
use super::scope::Scope;
use super::slope::{SlopeOf, displaced, is_finite, magnitude};
use crate::{Real, StateSpace, System, Tangent, all, any};

/// A step that was tried.
pub struct Attempt<S: System, D> {
    /// Displacement of the state over the step.
    pub displacement: SlopeOf<S>,
    /// Estimate of its error, if the step is a [full](Step::full) one; zero from methods without an estimate.
    pub error: SlopeOf<S>,
    /// False where an implicit method found no solution.
    pub converged: bool,
    /// What [`Method::proceed`] and [`Method::dense`] make use of.
    pub details: D,
}

impl<S: System, D> Attempt<S, D> {
    /// A step without an estimate.
    #[inline]
    pub fn new(displacement: SlopeOf<S>, details: D) -> Self {
        Self { displacement, error: SlopeOf::<S>::zero(), converged: true, details }
    }
}

/// The end of an accepted step.
pub struct Accepted<S: System> {
    /// What the integration goes on from.
    pub state: S::State,
    /// Whether [`System::accepted`] changed coordinates, so that what is known of the step's end does not hold for `state`.
    pub changed: bool,
    /// Whether another law holds from here on, since the step has come to the [horizon](System::horizon).
    pub renewed: bool,
}

impl<S: System> Accepted<S> {
    /// What the system makes of the end of a step.
    #[inline]
    pub(super) fn new(problem: &Problem<'_, S>, step: &Step<'_, S>, end: &S::State) -> Self {
        let state = problem.accepted(step.end, end);
        let (before, now) = (problem.horizon(step.t, step.state), problem.horizon(step.end, &state));
        Self { state, changed: !same(end, &state), renewed: any(Real::ne(before, now)) }
    }
}

/// A step over a horizon by this share of it is rounding.
pub(super) const OVER: f64 = 1e-6;

/// Whether a step goes past the horizon, or nobody knows where that is, in each lane.
#[inline]
fn overshoots<S: System>(problem: &Problem<'_, S>, step: &Step<'_, S>) -> <S::Scalar as Real>::Mask {
    let horizon = problem.horizon(step.t, step.state);
    Real::gt(step.end - S::Scalar::lit(OVER) * Real::abs(step.dt), horizon) | Real::ne(horizon, horizon)
}

/// The memory for the step after an accepted one; where another law holds, that of a first step.
#[inline]
pub(super) fn proceed<S: System, M: Method<S>>(
    method: &M,
    problem: &Problem<'_, S>,
    step: &Step<'_, S>,
    memory: &M::Memory,
    attempt: &Attempt<S, M::Details>,
    next: &Accepted<S>,
) -> M::Memory {
    if next.renewed {
        return method.begin(problem, step.end, &next.state);
    }
    method.proceed(problem, step, memory, attempt, next)
}

/// Whether two states have the same coordinates, exactly. Opposite quaternions are the same rotation.
#[inline]
fn same<Z: StateSpace>(a: &Z, b: &Z) -> bool {
    fn equal<T: Real, V: Tangent<T>>(a: &V, b: &V) -> bool {
        // Infinite components differ, which does no harm.
        a.add_scaled(T::lit(-1.0), b).fold(true, &mut |equal, d| equal & all(Real::eq(d, T::lit(0.0))))
    }
    let ((q, v, x), (other_q, other_v, other_x)) = (a.split(), b.split());
    q == other_q && equal(&v, &other_v) && equal(&x, &other_x)
}

/// A one-step method for the system `S`.
///
/// Methods are values, with their settings where they have any. `step` and `integrate` exist on the common ones
/// themselves (`Rk4::step(..)`); [`Integrator`](super::Integrator) runs any of them with steps of one length or with
/// steps chosen by error.
pub trait Method<S: System>: Copy {
    /// Order of convergence.
    const ORDER: u32;
    /// The estimate of the error shrinks with this power of the step; zero where there is none, and steps are given.
    const ESTIMATE: u32 = 0;

    /// What passes from one step to the next, such as the slope that one ends and the other starts with.
    type Memory: Copy;
    /// What a step leaves behind for the next one and for dense output.
    type Details;

    /// The memory at a first step, or at the first one after a jump.
    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> Self::Memory;

    /// Tries a step.
    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, memory: &Self::Memory)
    -> Attempt<S, Self::Details>;

    /// The size of a step's error, in each lane; a step is accepted at one or less. `norm` is the mean square of a vector,
    /// each component divided by its tolerance. By default it is the norm of [`Attempt::error`].
    #[inline]
    fn error(
        &self,
        _step: &Step<'_, S>,
        attempt: &Attempt<S, Self::Details>,
        norm: impl Fn(&SlopeOf<S>) -> S::Scalar,
    ) -> S::Scalar {
        norm(&attempt.error)
    }

    /// The slope at a first state, by which a first step is chosen; what the memory holds is not evaluated again.
    #[inline]
    fn first_slope(
        &self,
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
        _memory: &mut Self::Memory,
    ) -> SlopeOf<S> {
        problem.slope(t, state)
    }

    /// The memory for the step after an accepted one.
    #[inline]
    fn proceed(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &Self::Memory,
        _attempt: &Attempt<S, Self::Details>,
        next: &Accepted<S>,
    ) -> Self::Memory {
        self.begin(problem, step.end, &next.state)
    }

    /// The memory for the attempt after a rejected one, at the same time and state.
    #[inline]
    fn repeat(&self, memory: &Self::Memory, _attempt: &Attempt<S, Self::Details>) -> Self::Memory {
        *memory
    }

    /// The length of the next step `[s]`, after an attempt of the signed length `length`: what the control of steps
    /// proposes, or what suits the method better. After an attempt that found no solution, a tenth is proposed.
    #[inline]
    fn next_step(&self, _attempt: &Attempt<S, Self::Details>, _length: f64, proposed: f64) -> f64 {
        proposed
    }

    /// The states within an accepted step. By default a cubic through the states and slopes at both ends.
    fn dense(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &Self::Memory,
        attempt: &Attempt<S, Self::Details>,
    ) -> Dense<S> {
        let first = problem.slope(step.t, step.state);
        let last = problem.stage(step.end, step.state, &attempt.displacement);
        Dense::cubic(step, &attempt.displacement, &first, &last)
    }
}

/// One step of a method from its beginning.
#[inline]
pub(super) fn step<S: System, M: Method<S>>(
    method: &M,
    system: &S,
    t: S::Scalar,
    state: &S::State,
    input: &S::Input,
    dt: S::Scalar,
) -> S::State {
    let problem = Problem::new(system, input);
    let memory = method.begin(&problem, t, state);
    let step = Step { t, end: t + dt, dt, state, full: false };
    let mut attempt = method.attempt(&problem, &step, &memory);
    if !attempt.converged {
        attempt.displacement = attempt.displacement.scale(S::Scalar::lit(f64::NAN)); // no state rather than a wrong one
    }
    let next = problem.accepted(step.end, &displaced(state, &attempt.displacement));
    let sound = Soundness::at(&problem, step.end, &next, dt, &Scope::whole()).mask & !overshoots(&problem, &step);
    let (q, v, x) = next.split();
    let next = next.join(q, v.map(&mut |v| Real::select(sound, v, S::Scalar::lit(f64::NAN))), x);
    problem.reached(step.end, &next);
    next
}

/// `steps` steps of one length, lane by lane.
pub(super) fn integrate<S: System, M: Method<S>>(
    method: &M,
    system: &S,
    (t0, dt, steps): (S::Scalar, S::Scalar, u32),
    state: &S::State,
    input: &S::Input,
    mut observe: impl FnMut(S::Scalar, &S::State),
) -> Result<S::State, IntegrationError> {
    let problem = Problem::new(system, input);
    let mut state = *state;
    let mut t = t0;
    let (mut memory, mut signs, mut doubt) = (None, None, Doubt::None);
    let scope = Scope::whole();
    check_start(&problem, t, &state)?;
    check_horizon(&problem, t, &state, any(Real::lt(dt, S::Scalar::lit(0.0))))?;
    for k in 1..=steps {
        let end = t0 + S::Scalar::lit(f64::from(k)) * dt;
        let now = memory.unwrap_or_else(|| method.begin(&problem, t, &state));
        let step = Step { t, end, dt, state: &state, full: false };
        if any(overshoots(&problem, &step)) {
            let what = "a step goes past a sample: take steps that divide the period, or an `Integrator`, which ends steps there";
            return Err(IntegrationError::InvalidArgument { what });
        }
        let attempt = method.attempt(&problem, &step, &now);
        let reached = displaced(&state, &attempt.displacement);
        let next = Accepted::new(&problem, &step, &reached);
        let found = Doubt::at(&problem, end, &reached, &next.state, &scope);
        if found.stops(doubt) {
            return Err(IntegrationError::Ambiguous { time: t.greatest() });
        }
        doubt = found;
        if !is_finite(&magnitude(&next.state)) {
            return Err(cause(&problem, t, &state, dt, &scope));
        }
        if !attempt.converged {
            return Err(IntegrationError::NoConvergence { time: t.greatest() });
        }
        let soundness = Soundness::at(&problem, end, &next.state, dt, &scope);
        signs = Some(soundness.check(t, signs, &problem, &next.state)?);
        if k < steps {
            memory = Some(proceed(method, &problem, &step, &now, &attempt, &next));
        }
        state = next.state;
        t = end;
        observe(t, &state);
        problem.reached(t, &state);
    }
    Ok(state)
}

/// `step` and `integrate` on a method without settings, callable without a trait or a value.
macro_rules! inherent {
    ($method:ident $(: $bound:path)?) => {
        impl $method {
            /// The state after one step of `dt` `[s]` from the time `t` `[s]`, with the input held; NaN where an implicit
            /// method finds no solution, or a loop comes to a dead centre.
            #[inline]
            pub fn step<S: $crate::System $(+ $bound)?>(
                system: &S,
                t: S::Scalar,
                state: &S::State,
                input: &S::Input,
                dt: S::Scalar,
            ) -> S::State {
                $crate::integrators::method::step(&Self, system, t, state, input, dt)
            }

            /// The state after `steps` steps of `dt` `[s]`, with the input held throughout.
            ///
            /// `observe` is called after every step with the time and the state. Time is `t0 + k * dt` and does not
            /// drift. Lanes may have times of their own.
            ///
            /// # Errors
            /// [`NonFinite`](crate::IntegrationError::NonFinite) as soon as the state is infinite or NaN (in any lane);
            /// [`NoConvergence`](crate::IntegrationError::NoConvergence) where an implicit method finds no solution;
            /// [`DeadCentre`](crate::IntegrationError::DeadCentre),
            /// [`Ambiguous`](crate::IntegrationError::Ambiguous) and
            /// [`OpenLoops`](crate::IntegrationError::OpenLoops) of loops.
            pub fn integrate<S: $crate::System $(+ $bound)?>(
                system: &S,
                t0: S::Scalar,
                state: &S::State,
                input: &S::Input,
                dt: S::Scalar,
                steps: u32,
                observe: impl FnMut(S::Scalar, &S::State),
            ) -> Result<S::State, $crate::IntegrationError> {
                $crate::integrators::method::integrate(&Self, system, (t0, dt, steps), state, input, observe)
            }
        }
    };
}

pub(super) use inherent;
