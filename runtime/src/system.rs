//! What integrators see of a model: [`System`], and of its state: [`StateSpace`].
//!
//! The space is one thing and the law of motion another. A generated `State` implements [`StateSpace`], which only
//! says what it is made of. `System` adds the one function that the mechanics decide. A wrapper, such as a controller
//! around a model, borrows the state of its model and writes that one function.

use crate::integrators::{Slope, SlopeOf};
use crate::{Configuration, Opening, Real, Tangent};

/// A state made of a position, a velocity, and the model's own states where it has any.
///
/// What else a state holds (a guess for a loop that Newton's method closes) is not integrated; [`StateSpace::join`]
/// keeps it from `self`, and [`System::accepted`] renews it.
pub trait StateSpace: Copy {
    /// The scalar.
    type Scalar: Real;
    /// Positions.
    type Position: Configuration<Self::Scalar>;
    /// Velocities, one component for each degree of freedom: the rates of coordinates, or speeds of which
    /// [`System::position_rates`] makes these rates.
    type Velocity: Tangent<Self::Scalar>;
    /// The states of the user's own differential equations; `()` where there are none.
    type Extra: Tangent<Self::Scalar>;

    /// Position, velocity and own states.
    fn split(&self) -> (Self::Position, Self::Velocity, Self::Extra);

    /// This state with another position, velocity and own states.
    fn join(&self, q: Self::Position, v: Self::Velocity, x: Self::Extra) -> Self;
}

/// How far the solution of a system's loops is from a dead centre, where two solutions meet: what [`System::margins`] tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin<T> {
    /// The coordinate that the solution finds.
    pub coordinate: &'static str,
    /// Zero in the dead centre, and regular around it: the square root in a closed form, the determinant of the equations
    /// that Newton's method solves. NaN where there is no solution. Its unit does not matter.
    pub root: T,
    /// The rate of the square of the root along the motion, which is finite in the dead centre too.
    pub rate: T,
}

/// The position type of a system.
pub type PositionOf<S> = <<S as System>::State as StateSpace>::Position;

/// What displaces the position of a system, and the type of its rate. It has a component for each coordinate, a rotation
/// three, where velocities may be fewer.
pub type DisplacementOf<S> = <PositionOf<S> as Configuration<<S as System>::Scalar>>::Velocity;

/// The velocity type of a system: that of [`DisplacementOf`] where velocities are the rates of coordinates.
pub type VelocityOf<S> = <<S as System>::State as StateSpace>::Velocity;

/// The type of a system's own states, `()` where it has none.
pub type ExtraOf<S> = <<S as System>::State as StateSpace>::Extra;

/// A mechanical system that can be integrated in time.
///
/// Generated models with forward dynamics implement it. A feedback law that is to be evaluated at every stage of a step, not
/// held over the step as an input is, is a [`closed_loop`](crate::closed_loop) around the model; one that acts once in a
/// period is [`sampled`](crate::sampled). Other wrappers implement the trait; around a model with loops they have to hand on every function of it, as all of the crate do, since without them
/// integrators don't see open loops, dead centres and crossing motions. A controller around a system without loops:
///
/// ```
/// use multibody::{ExtraOf, Real, Rk4, StateSpace, System, VelocityOf};
///
/// #[derive(Clone, Copy)]
/// struct State<T> { q: T, v: T }
///
/// impl<T: Real> StateSpace for State<T> {
///     type Scalar = T;
///     type Position = T;
///     type Velocity = T;
///     type Extra = ();
///     fn split(&self) -> (T, T, ()) { (self.q, self.v, ()) }
///     fn join(&self, q: T, v: T, (): ()) -> Self { Self { q, v } }
/// }
///
/// /// A mass, pushed by a force.
/// struct Cart<T> { mass: T }
///
/// impl<T: Real> System for Cart<T> {
///     type Scalar = T;
///     type State = State<T>;
///     type Input = T;
///     fn derivative(&self, _t: T, _state: &State<T>, force: &T) -> (T, ()) { (*force / self.mass, ()) }
///     fn position_rates(&self, _t: T, state: &State<T>) -> T { state.v }
/// }
///
/// /// A proportional-derivative controller around any system with the state and the input of a cart.
/// struct Controlled<S> { plant: S }
///
/// impl<T: Real, S: System<Scalar = T, State = State<T>, Input = T>> System for Controlled<S> {
///     type Scalar = T;
///     type State = State<T>;
///     type Input = ();
///     fn derivative(&self, t: T, state: &State<T>, (): &()) -> (VelocityOf<S>, ExtraOf<S>) {
///         let force = -(state.q + T::lit(2.0) * state.v);
///         self.plant.derivative(t, state, &force)
///     }
///     fn position_rates(&self, t: T, state: &State<T>) -> T { self.plant.position_rates(t, state) }
/// }
///
/// let system = Controlled { plant: Cart { mass: 1.0 } };
/// let mut x = State { q: 1.0, v: 0.0 };
/// for k in 0..2000 {
///     x = Rk4::step(&system, 0.01 * f64::from(k), &x, &(), 0.01);
/// }
/// assert!(x.q.abs() < 1e-6); // the double pole at -1 brings it to rest
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no accelerations to integrate",
    label = "this has to be a `multibody::System`",
    note = "a model of `multibody!` is one with `emit forward_dynamics`, which is what it emits if it says nothing; the model itself is to be passed, `Model<T>` and not its module or its parameters"
)]
pub trait System {
    /// The scalar.
    type Scalar: Real;
    /// What is integrated.
    type State: StateSpace<Scalar = Self::Scalar>;
    /// What acts from outside and is held over a step; `()` where nothing does.
    type Input;

    /// Accelerations, and the rates of the system's own states, at the time `t` `[s]`.
    fn derivative(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
    ) -> (VelocityOf<Self>, ExtraOf<Self>);

    /// The rates of the position at the time `t` `[s]`: `q' = N(q) u + n(q, t)`, linear in the velocities `u`. Where
    /// velocities are the rates of coordinates, that is the velocity itself, `state.v`.
    ///
    /// Of rotations it is the angular velocity about the child's own axes.
    fn position_rates(&self, t: Self::Scalar, state: &Self::State) -> DisplacementOf<Self>;

    /// [`System::position_rates`] and [`System::derivative`] together: what methods integrate. Written by default as
    /// these two; systems in which both share work write it anew, with the same values.
    #[inline]
    fn slope(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> SlopeOf<Self> {
        let q = self.position_rates(t, state);
        let (v, x) = self.derivative(t, state, input);
        Slope { q, v, x }
    }

    /// Called with the state at the end of every step before anyone sees it: renews what the state holds besides its
    /// coordinates, and brings coordinates back to where they belong. Wrappers of a model that has such things hand the
    /// call on.
    ///
    /// A state that it has returned is left as it is if it comes again at the same time. Not all of these states are kept: the
    /// search for an event tries many, and so does that for an equilibrium. What counts steps does so in [`System::reached`].
    #[inline]
    fn accepted(&self, _t: Self::Scalar, state: &Self::State, _input: &Self::Input) -> Self::State {
        *state
    }

    /// Called with the state at the end of every step that an integration keeps, the same ones and in the same order as an
    /// observer sees; where an event ends a step, with the state before the event changes it. By default nothing happens.
    /// Wrappers hand the call on.
    #[inline]
    fn reached(&self, _t: Self::Scalar, _state: &Self::State) {}

    /// `[s]` the time until which the motion from a state goes on by one law: where it changes at a time that is known before,
    /// as the input that [`Sampled`](crate::Sampled) holds does. No step goes past it, and [`System::accepted`] of a state at that
    /// time gives one with the next law and a later horizon; such a system goes forwards in time alone. By default there is
    /// none. Wrappers hand the call on.
    #[inline]
    fn horizon(&self, _t: Self::Scalar, _state: &Self::State) -> Self::Scalar {
        Self::Scalar::lit(f64::INFINITY)
    }

    /// How far the loops are from each of their dead centres, and how fast they come nearer, at a state that
    /// [`System::accepted`] gave. Returns the greatest residual that Newton's method has left in a loop, over the greatest of
    /// those that amount to a radian or to the mechanism's size.
    ///
    /// Where two solutions of a loop meet, the coordinates of a reduced model end: the mechanism goes on with the other
    /// solution, a step that jumps over comes back with the same one, and nothing in accelerations or energy tells.
    /// Integrators ask after every step, and end in [`IntegrationError::DeadCentre`](crate::IntegrationError) instead.
    /// By default there are none. Wrappers hand the call on.
    #[inline]
    fn margins(
        &self,
        _t: Self::Scalar,
        _state: &Self::State,
        _input: &Self::Input,
        _visit: &mut dyn FnMut(Margin<Self::Scalar>),
    ) -> Self::Scalar {
        Self::Scalar::lit(0.0)
    }

    /// How far the loops are open at a state that a motion is to start from, by its positions, its velocities or the
    /// parameters; integrators refuse more than the tolerance.
    /// By default nothing is open. Wrappers hand the call on.
    #[inline]
    fn opening(&self, _t: Self::Scalar, _state: &Self::State, _input: &Self::Input) -> Opening<Self::Scalar> {
        Opening::none()
    }

    /// How unclear it is which motion goes on at a state that [`System::accepted`] gave: zero where there is no doubt, one or
    /// more where rounding decides.
    ///
    /// Where constraints come to depend on each other, as in a parallelogram that lies flat, two motions cross. Integrators
    /// lead steps over such a pose, and end in [`IntegrationError::Ambiguous`](crate::IntegrationError) where they can't. By
    /// default there is never a doubt. Wrappers hand the call on.
    #[inline]
    fn ambiguity(&self, _t: Self::Scalar, _state: &Self::State, _input: &Self::Input) -> Self::Scalar {
        Self::Scalar::lit(0.0)
    }

    /// A coordinate without inertia, whose acceleration no equation gives: asked for only where a derivative isn't finite,
    /// to name the cause. By default none is known. Wrappers hand the call on.
    #[inline]
    fn without_inertia(&self, _t: Self::Scalar, _state: &Self::State, _input: &Self::Input) -> Option<&'static str> {
        None
    }
}

impl<S: System + ?Sized> System for &S {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        (**self).derivative(t, state, input)
    }
    #[inline]
    fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        (**self).position_rates(t, state)
    }
    #[inline]
    fn slope(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> SlopeOf<S> {
        (**self).slope(t, state, input)
    }
    #[inline]
    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        (**self).accepted(t, state, input)
    }
    #[inline]
    fn reached(&self, t: S::Scalar, state: &S::State) {
        (**self).reached(t, state);
    }
    #[inline]
    fn horizon(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
        (**self).horizon(t, state)
    }
    #[inline]
    fn margins(
        &self,
        t: S::Scalar,
        state: &S::State,
        input: &S::Input,
        visit: &mut dyn FnMut(Margin<S::Scalar>),
    ) -> S::Scalar {
        (**self).margins(t, state, input, visit)
    }
    #[inline]
    fn opening(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Opening<S::Scalar> {
        (**self).opening(t, state, input)
    }
    #[inline]
    fn ambiguity(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::Scalar {
        (**self).ambiguity(t, state, input)
    }
    #[inline]
    fn without_inertia(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Option<&'static str> {
        (**self).without_inertia(t, state, input)
    }
}

/// How a change of the velocities displaces the position in a unit of time: `N(q) d`. Where velocities are the rates of
/// coordinates, that is `d` to the last bit.
#[inline]
pub(crate) fn displacement_by<S: System>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    d: &VelocityOf<S>,
) -> DisplacementOf<S> {
    let (q, _, x) = state.split();
    let at = |v: VelocityOf<S>| system.position_rates(t, &state.join(q, v, x));
    at(*d).add_scaled(S::Scalar::lit(-1.0), &at(Tangent::zero()))
}
