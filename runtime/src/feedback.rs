//! A law that acts on a system at every stage of a step: [`Feedback`].

use crate::integrators::SlopeOf;
use crate::{DisplacementOf, ExtraOf, Margin, Opening, System, VelocityOf};

/// A system whose input is what a law makes of time and state, evaluated at every stage of a step and not held over it.
///
/// All else that the system says of itself (loops that open, dead centres, crossing motions, coordinates without inertia) is
/// handed on, which a wrapper written by hand would have to do function by function: see [`System`].
///
/// ```
/// use multibody::{Rk4, closed_loop, multibody};
///
/// multibody! {
///     mod cart {
///         input force;
///         body frame { mass: 2.0 }
///         joint x: Prismatic { parent: ground, child: frame, axis: X }
///         force motor: Effort { joint: x, value: force }
///     }
/// }
/// let controlled = closed_loop(cart::Model::<f64>::default(), |_t, state: &cart::State<f64>| {
///     cart::Input { force: -8.0 * state.q.x - 8.0 * state.v.x }
/// });
/// let start = cart::State { q: cart::Position { x: 1.0 }, ..cart::State::default() };
/// let end = Rk4::integrate(&controlled, 0.0, &start, &(), 0.01, 2000, |_, _| ()).unwrap();
/// assert!(end.q.x.abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Feedback<S, F> {
    /// The system.
    pub system: S,
    /// The law.
    pub law: F,
}

/// A system with the input that a law gives at every time and state: see [`Feedback`]. [`sampled`](crate::sampled) is the same with a
/// law that acts once in a period.
pub const fn closed_loop<S: System, F: Fn(S::Scalar, &S::State) -> S::Input>(system: S, law: F) -> Feedback<S, F> {
    Feedback { system, law }
}

impl<S: System, F: Fn(S::Scalar, &S::State) -> S::Input> System for Feedback<S, F> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = ();

    #[inline]
    fn derivative(&self, t: S::Scalar, state: &S::State, (): &()) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, state, &(self.law)(t, state))
    }
    #[inline]
    fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        self.system.position_rates(t, state)
    }
    #[inline]
    fn slope(&self, t: S::Scalar, state: &S::State, (): &()) -> SlopeOf<S> {
        self.system.slope(t, state, &(self.law)(t, state))
    }
    #[inline]
    fn accepted(&self, t: S::Scalar, state: &S::State, (): &()) -> S::State {
        self.system.accepted(t, state, &(self.law)(t, state))
    }
    #[inline]
    fn reached(&self, t: S::Scalar, state: &S::State) {
        self.system.reached(t, state);
    }
    #[inline]
    fn horizon(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        self.system.horizon(t, state)
    }
    #[inline]
    fn margins(&self, t: S::Scalar, state: &S::State, (): &(), visit: &mut dyn FnMut(Margin<S::Scalar>)) -> S::Scalar {
        self.system.margins(t, state, &(self.law)(t, state), visit)
    }
    #[inline]
    fn opening(&self, t: S::Scalar, state: &S::State, (): &()) -> Opening<S::Scalar> {
        self.system.opening(t, state, &(self.law)(t, state))
    }
    #[inline]
    fn ambiguity(&self, t: S::Scalar, state: &S::State, (): &()) -> S::Scalar {
        self.system.ambiguity(t, state, &(self.law)(t, state))
    }
    #[inline]
    fn without_inertia(&self, t: S::Scalar, state: &S::State, (): &()) -> Option<&'static str> {
        self.system.without_inertia(t, state, &(self.law)(t, state))
    }
}
