//! A law that acts at whole multiples of a period, as a program on a controller does: [`Sampled`].
//!
//! What is held between two samples is part of the state, as the guess of a loop is: it is not integrated, [`System::accepted`]
//! renews it where a step ends at a sample, and the [horizon](System::horizon) has steps end there. So a sampled system is a
//! function of its state like every other, which a search for events may evaluate as often as it likes.

use core::marker::PhantomData;

use crate::integrators::SlopeOf;
use crate::{
    Differentiable, DisplacementOf, ExtraOf, JacobianOf, Margin, Opening, Real, StateSpace, System, Tangent,
    VelocityOf, all, any,
};

/// A sample is due this share of a period before its time: sums of steps are rounded.
const EARLY: f64 = 1e-9;

/// A system whose input is renewed by a law at whole multiples of a period, and held in between.
///
/// The law sees time, state and a memory of its own, which it may change: the sum of an integral term, the last measurement,
/// an estimate. What it gives holds until the next sample. It may be called more often than there are samples, so all that it
/// remembers belongs in that memory. Integrations by [`Integrator`](crate::Integrator), [`simulate`](crate::simulate) and the
/// like end a step at each sample. Steps that are taken one by one have to divide the period: where they don't, `Rk4::step`
/// gives NaN and `Rk4::integrate` an error. Time goes forwards, and lanes sample together.
///
/// ```
/// use multibody::{Dop853, Integrator, multibody, sampled};
///
/// multibody! {
///     mod cart {
///         input force;
///         body frame { mass: 2.0 }
///         joint x: Prismatic { parent: ground, child: frame, axis: X }
///         force load: Effort { joint: x, value: 3.0 }
///         force motor: Effort { joint: x, value: force }
///     }
/// }
///
/// // A PID controller at 100 Hz; its memory is the integral of the position.
/// let controlled = sampled(cart::Model::<f64>::default(), 0.01, |_t, state: &cart::State<f64>, sum: &mut f64| {
///     *sum += 0.01 * state.q.x;
///     cart::Input { force: -60.0 * state.q.x - 20.0 * state.v.x - 40.0 * *sum }
/// });
/// let start = controlled.start(0.0, &cart::State::default(), 0.0);
/// let tolerant = Integrator::adaptive(Dop853, 1e-9, 1e-9);
/// let (end, _) = tolerant.integrate(&controlled, 0.0, 20.0, &start, &(), |_, _| ())?;
/// assert!(end.state.q.x.abs() < 1e-4); // the integral term holds the load
/// assert!((end.input.force + 3.0).abs() < 1e-3);
/// # Ok::<(), multibody::IntegrationError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sampled<S: System, F, M> {
    /// The system.
    pub system: S,
    /// The law.
    pub law: F,
    /// `[s]` from one sample to the next.
    pub period: S::Scalar,
    memory: PhantomData<fn(&mut M)>,
}

/// A system with a law that renews its input with the given period: see [`Sampled`]. [`closed_loop`](crate::closed_loop) is the same
/// in continuous time.
pub const fn sampled<S, F, M>(system: S, period: S::Scalar, law: F) -> Sampled<S, F, M>
where
    S: System,
    F: Fn(S::Scalar, &S::State, &mut M) -> S::Input,
{
    Sampled { system, law, period, memory: PhantomData }
}

/// The state of a [`Sampled`] system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held<Z: StateSpace, I, M> {
    /// The state of the system.
    pub state: Z,
    /// The input since the last sample.
    pub input: I,
    /// The memory of the law.
    pub memory: M,
    /// `[s]` the time of the first sample.
    first: Z::Scalar,
    /// The number of the next one, from zero.
    next: Z::Scalar,
}

impl<Z: StateSpace, I: Copy, M: Copy> StateSpace for Held<Z, I, M> {
    type Scalar = Z::Scalar;
    type Position = Z::Position;
    type Velocity = Z::Velocity;
    type Extra = Z::Extra;

    #[inline]
    fn split(&self) -> (Z::Position, Z::Velocity, Z::Extra) {
        self.state.split()
    }
    #[inline]
    fn join(&self, q: Z::Position, v: Z::Velocity, x: Z::Extra) -> Self {
        Self { state: self.state.join(q, v, x), ..*self }
    }
}

impl<S, F, M> Sampled<S, F, M>
where
    S: System<Input: Copy>,
    F: Fn(S::Scalar, &S::State, &mut M) -> S::Input,
    M: Copy,
{
    /// The state at the time of the first sample `[s]`, where an integration starts, with what the law remembers before it.
    pub fn start(&self, t: S::Scalar, state: &S::State, mut memory: M) -> Held<S::State, S::Input, M> {
        let input = (self.law)(t, state, &mut memory);
        Held { state: *state, input, memory, first: t, next: S::Scalar::lit(1.0) }
    }

    /// The state from the end of a step on: with a new input if a sample is due.
    fn renewed(&self, t: S::Scalar, held: Held<S::State, S::Input, M>) -> Held<S::State, S::Input, M> {
        let lit = S::Scalar::lit;
        let periods = (t - held.first) / self.period + lit(EARLY);
        let due = Real::ge(periods, held.next);
        if !any(due) {
            return held;
        }
        let Held { state, mut memory, first, .. } = held;
        let input = (self.law)(t, &state, &mut memory);
        // No input can be put together from those of several lanes: where one samples without the others, nothing goes on.
        let next = if all(due) { Real::floor(periods) + lit(1.0) } else { lit(f64::NAN) };
        Held { state, input, memory, first, next }
    }
}

impl<S, F, M> System for Sampled<S, F, M>
where
    S: System<Input: Copy>,
    F: Fn(S::Scalar, &S::State, &mut M) -> S::Input,
    M: Copy,
{
    type Scalar = S::Scalar;
    type State = Held<S::State, S::Input, M>;
    type Input = ();

    #[inline]
    fn derivative(&self, t: S::Scalar, held: &Self::State, (): &()) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, &held.state, &held.input)
    }
    #[inline]
    fn position_rates(&self, t: S::Scalar, held: &Self::State) -> DisplacementOf<S> {
        self.system.position_rates(t, &held.state)
    }
    #[inline]
    fn slope(&self, t: S::Scalar, held: &Self::State, (): &()) -> SlopeOf<S> {
        self.system.slope(t, &held.state, &held.input)
    }
    #[inline]
    fn accepted(&self, t: S::Scalar, held: &Self::State, (): &()) -> Self::State {
        self.renewed(t, Held { state: self.system.accepted(t, &held.state, &held.input), ..*held })
    }
    #[inline]
    fn reached(&self, t: S::Scalar, held: &Self::State) {
        self.system.reached(t, &held.state);
    }
    #[inline]
    fn horizon(&self, t: S::Scalar, held: &Self::State) -> S::Scalar {
        let sample = held.first + held.next * self.period;
        let other = self.system.horizon(t, &held.state);
        Real::select(Real::lt(other, sample), other, sample)
    }
    #[inline]
    fn margins(
        &self,
        t: S::Scalar,
        held: &Self::State,
        (): &(),
        visit: &mut dyn FnMut(Margin<S::Scalar>),
    ) -> S::Scalar {
        self.system.margins(t, &held.state, &held.input, visit)
    }
    #[inline]
    fn opening(&self, t: S::Scalar, held: &Self::State, (): &()) -> Opening<S::Scalar> {
        self.system.opening(t, &held.state, &held.input)
    }
    #[inline]
    fn ambiguity(&self, t: S::Scalar, held: &Self::State, (): &()) -> S::Scalar {
        self.system.ambiguity(t, &held.state, &held.input)
    }
    #[inline]
    fn without_inertia(&self, t: S::Scalar, held: &Self::State, (): &()) -> Option<&'static str> {
        self.system.without_inertia(t, &held.state, &held.input)
    }
}

/// The input is held, so derivatives are those of the system.
impl<S, F, M> Differentiable for Sampled<S, F, M>
where
    S: Differentiable<Input: Copy>,
    F: Fn(S::Scalar, &S::State, &mut M) -> S::Input,
    M: Copy,
{
    type Matrix = S::Matrix;

    #[inline]
    fn jacobian(&self, t: S::Scalar, held: &Self::State, (): &()) -> JacobianOf<S> {
        self.system.jacobian(t, &held.state, &held.input)
    }
    #[inline]
    fn input_derivative(&self, _t: S::Scalar, _held: &Self::State, (): &(), (): &()) -> (VelocityOf<S>, ExtraOf<S>) {
        (Tangent::zero(), Tangent::zero())
    }
}
