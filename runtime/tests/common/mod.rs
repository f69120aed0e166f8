//! Systems written by hand, as generated code would be: an oscillator, a pendulum, a free rigid body, a motor.
#![allow(dead_code)] // every test file uses some of them

pub(crate) mod canonical;
pub(crate) mod loops;
pub(crate) mod separable;
pub(crate) mod stiff;

use core::cell::Cell;
use multibody::nalgebra::{UnitQuaternion, Vector3};
use multibody::{Configuration, Pose, Real, StateSpace, System, Tangent, Twist};

/// Position and velocity of one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scalar<T> {
    pub(crate) q: T,
    pub(crate) v: T,
}

impl<T: Real> StateSpace for Scalar<T> {
    type Scalar = T;
    type Position = T;
    type Velocity = T;
    type Extra = ();
    fn split(&self) -> (T, T, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: T, v: T, (): ()) -> Self {
        Self { q, v }
    }
}

/// `q'' = -q + u`.
pub(crate) struct Oscillator<T>(pub(crate) core::marker::PhantomData<T>);

impl<T: Real> System for Oscillator<T> {
    type Scalar = T;
    type State = Scalar<T>;
    type Input = T;
    fn derivative(&self, _t: T, state: &Scalar<T>, input: &T) -> (T, ()) {
        (*input - state.q, ())
    }
    fn position_rates(&self, _t: T, state: &Scalar<T>) -> T {
        state.v
    }
}

/// A pendulum of length one, with a pivot that is shaken in time.
pub(crate) struct Pendulum<T> {
    pub(crate) gravity: T,
    pub(crate) shake: T,
}

impl<T: Real> System for Pendulum<T> {
    type Scalar = T;
    type State = Scalar<T>;
    type Input = ();
    fn derivative(&self, t: T, state: &Scalar<T>, (): &()) -> (T, ()) {
        let (sin, cos) = Real::sin_cos(state.q);
        let (sin_t, _) = Real::sin_cos(T::lit(3.0) * t);
        (-self.gravity * sin + self.shake * sin_t * cos, ())
    }
    fn position_rates(&self, _t: T, state: &Scalar<T>) -> T {
        state.v
    }
}

/// State of a free rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flight<T> {
    pub(crate) q: Pose<T>,
    pub(crate) v: Twist<T>,
}

impl<T: Real> StateSpace for Flight<T> {
    type Scalar = T;
    type Position = Pose<T>;
    type Velocity = Twist<T>;
    type Extra = ();
    fn split(&self) -> (Pose<T>, Twist<T>, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: Pose<T>, v: Twist<T>, (): ()) -> Self {
        Self { q, v }
    }
}

/// A rigid body in free flight: no moment, a constant force on a mass of one.
pub(crate) struct Body<T: Real> {
    pub(crate) inertia: Vector3<T>,
    pub(crate) force: Vector3<T>,
}

impl<T: Real> Body<T> {
    /// No force, and three different moments of inertia.
    pub(crate) fn floating() -> Self {
        Self { inertia: Vector3::new(T::lit(1.0), T::lit(2.0), T::lit(2.5)), force: Tangent::zero() }
    }
    /// Turns about all three axes.
    pub(crate) fn spinning() -> Flight<T> {
        Flight {
            q: Pose::default(),
            v: Twist {
                linear: Vector3::new(T::lit(0.1), T::lit(0.2), T::lit(0.3)),
                angular: Vector3::new(T::lit(0.3), T::lit(1.5), T::lit(-0.7)),
            },
        }
    }
    /// Angular momentum in world axes.
    pub(crate) fn momentum(&self, state: &Flight<T>) -> Vector3<T> {
        rotate(&state.q.orientation, &self.inertia.component_mul(&state.v.angular))
    }
    pub(crate) fn energy(&self, state: &Flight<T>) -> T {
        let w = state.v.angular;
        T::lit(0.5) * w.component_mul(&w).dot(&self.inertia)
    }
}

/// `R v`, in plain arithmetic so that every scalar can do it.
pub(crate) fn rotate<T: Real>(q: &UnitQuaternion<T>, v: &Vector3<T>) -> Vector3<T> {
    let c = q.as_ref().coords;
    let u = Vector3::new(c.x, c.y, c.z);
    let cross = u.cross(v) * T::lit(2.0);
    v + cross * c.w + u.cross(&cross)
}

impl<T: Real> System for Body<T> {
    type Scalar = T;
    type State = Flight<T>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Flight<T>, (): &()) -> (Twist<T>, ()) {
        let (w, i) = (state.v.angular, self.inertia);
        let angular =
            Vector3::new((i.y - i.z) * w.y * w.z / i.x, (i.z - i.x) * w.z * w.x / i.y, (i.x - i.y) * w.x * w.y / i.z);
        (Twist { linear: self.force, angular }, ())
    }
    fn position_rates(&self, _t: T, state: &Flight<T>) -> Twist<T> {
        state.v
    }
}

/// A motor with its current as a state of its own, on an arm that gravity pulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Driven<T> {
    pub(crate) q: T,
    pub(crate) v: T,
    pub(crate) x: Currents<T>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Currents<T> {
    pub(crate) current: T,
}

impl<T: Real> Tangent<T> for Currents<T> {
    fn zero() -> Self {
        Self { current: Tangent::zero() }
    }
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        Self { current: Tangent::zip(&self.current, &other.current, f) }
    }
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        Tangent::fold(&self.current, start, f)
    }
}

impl<T: Real> StateSpace for Driven<T> {
    type Scalar = T;
    type Position = T;
    type Velocity = T;
    type Extra = Currents<T>;
    fn split(&self) -> (T, T, Currents<T>) {
        (self.q, self.v, self.x)
    }
    fn join(&self, q: T, v: T, x: Currents<T>) -> Self {
        Self { q, v, x }
    }
}

pub(crate) struct Motor;

impl System for Motor {
    type Scalar = f64;
    type State = Driven<f64>;
    type Input = f64;
    fn derivative(&self, _t: f64, state: &Driven<f64>, voltage: &f64) -> (f64, Currents<f64>) {
        let torque = 0.5 * state.x.current;
        let current = (voltage - 2.0 * state.x.current - 0.5 * state.v) / 0.5;
        (torque - state.q.sin(), Currents { current })
    }
    fn position_rates(&self, _t: f64, state: &Driven<f64>) -> f64 {
        state.v
    }
}

/// Components of a displacement between two states, for errors.
pub(crate) fn distance<Z: StateSpace<Scalar = f64>>(
    a: &Z,
    b: &Z,
    position: impl Fn(&Z::Position, &Z::Position) -> f64,
) -> f64
where
    Z::Position: Configuration<f64>,
{
    let ((qa, va, xa), (qb, vb, xb)) = (a.split(), b.split());
    let worst = |sum: f64, e: f64| sum.max(e.abs());
    let mut e = position(&qa, &qb);
    e = va.add_scaled(-1.0, &vb).fold(e, &mut { worst });
    xa.add_scaled(-1.0, &xb).fold(e, &mut { worst })
}

/// Counts evaluations; becomes NaN from a given time on.
pub(crate) struct Counted<S> {
    system: S,
    pub(crate) evaluations: Cell<u32>,
    nan_from: f64,
}

impl<S: System<Scalar = f64, State = Scalar<f64>>> System for Counted<S> {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = S::Input;
    fn derivative(&self, t: f64, state: &Scalar<f64>, input: &S::Input) -> (f64, ()) {
        self.evaluations.set(self.evaluations.get() + 1);
        let (a, ()) = self.system.derivative(t, state, input);
        (if t >= self.nan_from { f64::NAN } else { a }, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

pub(crate) fn counted<S>(system: S, nan_from: f64) -> Counted<S> {
    Counted { system, evaluations: Cell::new(0), nan_from }
}
