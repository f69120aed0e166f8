//! Systems whose velocities are speeds, `q' = N(q) u + n(q, t)`, each beside one of the same motion with `q' = v`.

use core::cell::Cell;
use core::marker::PhantomData;

use multibody::integrators::{Slope, SlopeOf};
use multibody::linear::least_norm;
use multibody::nalgebra::{Matrix3, SMatrix, SVector, UnitQuaternion, Vector1, Vector2, Vector3, Vector4};
use multibody::{
    Configuration, Constrained, Differentiable, ExtraOf, FullJacobian, Impulsive, Real, StateSpace, System, Tangent,
    VelocityOf, Verifiable,
};

use crate::common::loops::{Coordinates, Rod};
use crate::common::rotate;

/// A position and velocities of any kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct State<T, Q, U> {
    pub(super) q: Q,
    pub(super) u: U,
    scalar: PhantomData<T>,
}

pub(super) const fn state<T, Q, U>(q: Q, u: U) -> State<T, Q, U> {
    State { q, u, scalar: PhantomData }
}

impl<T: Real, Q: Configuration<T>, U: Tangent<T>> StateSpace for State<T, Q, U> {
    type Scalar = T;
    type Position = Q;
    type Velocity = U;
    type Extra = ();
    fn split(&self) -> (Q, U, ()) {
        (self.q, self.u, ())
    }
    fn join(&self, q: Q, u: U, (): ()) -> Self {
        state(q, u)
    }
}

/// The derivatives of a slope by central differences.
pub(super) fn differences<S: System<Scalar = f64>, const W: usize>(
    system: &S,
    t: f64,
    at: &S::State,
    input: &S::Input,
) -> [[f64; W]; W] {
    let (q, v, x) = at.split();
    let mut matrix = [[0.0; W]; W];
    for j in 0..W {
        let mut place = 0..;
        let step = 1e-6;
        let d = SlopeOf::<S>::zero().map(&mut |_| if place.next() == Some(j) { step } else { 0.0 });
        let moved = |d: SlopeOf<S>| system.slope(t, &at.join(q.displace(&d.q), v.add(&d.v), x.add(&d.x)), input);
        let change = moved(d).add_scaled(-1.0, &moved(d.scale(-1.0))).scale(0.5 / step);
        let mut rows = matrix.iter_mut();
        change.fold((), &mut |(), entry| rows.next().unwrap()[j] = entry);
    }
    matrix
}

/// A pendulum of length one, pushed and damped, whose drive turns with `0.3 clock cos(t)` beside `u = (2 + sin q) (q' - ..)`.
#[derive(Clone, Copy)]
pub(super) struct Geared<T> {
    pub(super) clock: T,
    pub(super) damping: T,
}

impl<T: Real> Geared<T> {
    /// The acceleration of the angle.
    fn accel(&self, t: T, q: T, rate: T, moment: T) -> T {
        let (sin, cos) = Real::sin_cos(q);
        let (push, _) = Real::sin_cos(T::lit(3.0) * t);
        moment - T::lit(9.81) * sin + self.clock * T::lit(4.0) * push * cos - self.damping * rate
    }
    /// What the drive turns by itself, and the rate of that.
    fn drive(&self, t: T) -> [T; 2] {
        let (sin, cos) = Real::sin_cos(t);
        [T::lit(0.3) * self.clock * cos, T::lit(-0.3) * self.clock * sin]
    }
    /// The speed that belongs to a rate.
    pub(super) fn speed(&self, t: T, q: T, rate: T) -> T {
        (T::lit(2.0) + Real::sin(q)) * (rate - self.drive(t)[0])
    }
}

impl<T: Real> System for Geared<T> {
    type Scalar = T;
    type State = State<T, T, T>;
    type Input = T;
    fn derivative(&self, t: T, x: &Self::State, moment: &T) -> (T, ()) {
        let (sin, cos) = Real::sin_cos(x.q);
        let rate = self.position_rates(t, x);
        let [n, n1] = self.drive(t);
        (cos * rate * (rate - n) + (T::lit(2.0) + sin) * (self.accel(t, x.q, rate, *moment) - n1), ())
    }
    fn position_rates(&self, t: T, x: &Self::State) -> T {
        x.u / (T::lit(2.0) + Real::sin(x.q)) + self.drive(t)[0]
    }
}

impl Differentiable for Geared<f64> {
    type Matrix = FullJacobian<[[f64; 2]; 2]>;
    fn jacobian(&self, t: f64, x: &Self::State, moment: &f64) -> FullJacobian<[[f64; 2]; 2]> {
        let (sin, cos) = x.q.sin_cos();
        let (ratio, rate) = (2.0 + sin, self.position_rates(t, x));
        let w = x.u / ratio;
        let [by_q, by_u] = [-x.u * cos / (ratio * ratio), 1.0 / ratio];
        let accel = self.accel(t, x.q, rate, *moment) - self.drive(t)[1];
        let accel_by_q = -9.81 * cos - self.clock * 4.0 * (3.0 * t).sin() * sin - self.damping * by_q;
        let by_q_u = -sin * rate * w + cos * by_q * (w + rate) + cos * accel + ratio * accel_by_q;
        let by_u_u = cos * by_u * (w + rate) - ratio * self.damping * by_u;
        FullJacobian([[by_q, by_u], [by_q_u, by_u_u]])
    }
    fn input_derivative(&self, _t: f64, x: &Self::State, _moment: &f64, change: &f64) -> (f64, ()) {
        ((2.0 + x.q.sin()) * change, ())
    }
}

/// The same pendulum with `q' = v`.
#[derive(Clone, Copy)]
pub(super) struct Direct<T>(pub(super) Geared<T>);

impl<T: Real> System for Direct<T> {
    type Scalar = T;
    type State = State<T, T, T>;
    type Input = T;
    fn derivative(&self, t: T, x: &Self::State, moment: &T) -> (T, ()) {
        (self.0.accel(t, x.q, x.u, *moment), ())
    }
    fn position_rates(&self, _t: T, x: &Self::State) -> T {
        x.u
    }
}

/// A heavy body of oblique inertia that turns about a point, damped: what its angular velocity does in its own axes.
#[derive(Clone, Copy)]
pub(super) struct Top {
    pub(super) damping: f64,
}

impl Top {
    pub(super) fn inertia<T: Real>() -> Matrix3<T> {
        Matrix3::new(1.0, 0.1, -0.2, 0.1, 2.0, 0.3, -0.2, 0.3, 2.5).map(T::lit)
    }
    pub(super) fn inverse<T: Real>() -> Matrix3<T> {
        Self::inertia::<f64>().try_inverse().unwrap().map(T::lit)
    }
    /// The moment of the weight, with the upward axis in body axes, and of the damper.
    fn moment<T: Real>(&self, up: &Vector3<T>, w: &Vector3<T>) -> Vector3<T> {
        up.cross(&Vector3::new(0.3, -0.6, 1.2).map(T::lit)) - w * T::lit(self.damping)
    }
    fn accel<T: Real>(&self, up: &Vector3<T>, w: &Vector3<T>) -> Vector3<T> {
        Self::inverse::<T>() * (self.moment(up, w) - w.cross(&(Self::inertia::<T>() * w)))
    }
    /// The derivative of [`Top::accel`] along a change of the axis and one of the angular velocity.
    fn along(&self, w: &Vector3<f64>, up: &Vector3<f64>, d: &Vector3<f64>) -> Vector3<f64> {
        let inertia = Self::inertia::<f64>();
        Self::inverse::<f64>() * (self.moment(up, d) - d.cross(&(inertia * w)) - w.cross(&(inertia * d)))
    }
}

/// The upward axis in the axes of a body with roll, pitch and yaw.
fn upward<T: Real>(q: &Vector3<T>) -> Vector3<T> {
    let ((s, c), (sp, cp)) = (Real::sin_cos(q.x), Real::sin_cos(q.y));
    Vector3::new(-sp, s * cp, c * cp)
}

/// Angular velocity in body axes for rates of roll, pitch and yaw, and the same for the rates of that matrix.
pub(super) fn turning<T: Real>(q: &Vector3<T>, rates: &Vector3<T>) -> [Vector3<T>; 2] {
    let ((s, c), (sp, cp)) = (Real::sin_cos(q.x), Real::sin_cos(q.y));
    let [roll, pitch, yaw] = [rates.x, rates.y, rates.z];
    let w = Vector3::new(roll - sp * yaw, c * pitch + s * cp * yaw, c * cp * yaw - s * pitch);
    let bias = Vector3::new(
        -cp * pitch * yaw,
        -s * roll * pitch + (c * cp * roll - s * sp * pitch) * yaw,
        -(s * cp * roll + c * sp * pitch) * yaw - c * roll * pitch,
    );
    [w, bias]
}

/// Rates of roll, pitch and yaw for an angular velocity in body axes.
fn rates<T: Real>(q: &Vector3<T>, w: &Vector3<T>) -> Vector3<T> {
    let ((s, c), (sp, cp)) = (Real::sin_cos(q.x), Real::sin_cos(q.y));
    let across = s * w.y + c * w.z;
    Vector3::new(w.x + across * sp / cp, c * w.y - s * w.z, across / cp)
}

/// The top in roll, pitch and yaw with angular velocities about body axes.
#[derive(Clone, Copy)]
pub(super) struct Bodily<T>(pub(super) Top, pub(super) PhantomData<T>);

impl<T: Real> System for Bodily<T> {
    type Scalar = T;
    type State = State<T, Vector3<T>, Vector3<T>>;
    type Input = ();
    fn derivative(&self, _t: T, x: &Self::State, (): &()) -> (Vector3<T>, ()) {
        (self.0.accel(&upward(&x.q), &x.u), ())
    }
    fn position_rates(&self, _t: T, x: &Self::State) -> Vector3<T> {
        rates(&x.q, &x.u)
    }
}

impl Differentiable for Bodily<f64> {
    type Matrix = FullJacobian<[[f64; 6]; 6]>;
    fn jacobian(&self, _t: f64, x: &Self::State, (): &()) -> FullJacobian<[[f64; 6]; 6]> {
        let ((s, c), (sp, cp)) = (x.q.x.sin_cos(), x.q.y.sin_cos());
        let (across, along) = (s * x.u.y + c * x.u.z, c * x.u.y - s * x.u.z);
        let none = Vector3::zeros();
        let columns = [0, 1, 2, 3, 4, 5].map(|column| {
            let (rates, up, d) = match column {
                0 => (Vector3::new(along * sp / cp, -across, along / cp), Vector3::new(0.0, c * cp, -s * cp), none),
                1 => {
                    let up = Vector3::new(-cp, -s * sp, -c * sp);
                    (Vector3::new(across, 0.0, across * sp) / (cp * cp), up, none)
                }
                2 => (none, none, none),
                k => {
                    let unit = Vector3::from_fn(|i, _| if i + 3 == k { 1.0 } else { 0.0 });
                    (rates(&x.q, &unit), none, unit)
                }
            };
            let w = self.0.along(&x.u, &up, &d);
            [rates.x, rates.y, rates.z, w.x, w.y, w.z]
        });
        FullJacobian(core::array::from_fn(|i| columns.map(|column| column[i])))
    }
    fn input_derivative(&self, _t: f64, _x: &Self::State, (): &(), (): &()) -> (Vector3<f64>, ()) {
        (Vector3::zeros(), ())
    }
}

/// The same top with the rates of roll, pitch and yaw.
#[derive(Clone, Copy)]
pub(super) struct Angled(pub(super) Top);

impl System for Angled {
    type Scalar = f64;
    type State = State<f64, Vector3<f64>, Vector3<f64>>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Self::State, (): &()) -> (Vector3<f64>, ()) {
        let [w, bias] = turning(&x.q, &x.u);
        (rates(&x.q, &(self.0.accel(&upward(&x.q), &w) - bias)), ())
    }
    fn position_rates(&self, _t: f64, x: &Self::State) -> Vector3<f64> {
        x.u
    }
}

/// The top on a quaternion, with its angular momentum in body axes.
#[derive(Clone, Copy)]
pub(super) struct Loaded<T>(pub(super) Top, pub(super) PhantomData<T>);

impl<T: Real> System for Loaded<T> {
    type Scalar = T;
    type State = State<T, UnitQuaternion<T>, Vector3<T>>;
    type Input = ();
    fn derivative(&self, t: T, x: &Self::State, (): &()) -> (Vector3<T>, ()) {
        let up = rotate(&x.q.inverse(), &Vector3::new(0.0, 0.0, 1.0).map(T::lit));
        let w = self.position_rates(t, x);
        (self.0.moment(&up, &w) - w.cross(&x.u), ())
    }
    fn position_rates(&self, _t: T, x: &Self::State) -> Vector3<T> {
        Top::inverse::<T>() * x.u
    }
}

impl Differentiable for Loaded<f64> {
    type Matrix = FullJacobian<[[f64; 6]; 6]>;
    fn jacobian(&self, t: f64, x: &Self::State, (): &()) -> FullJacobian<[[f64; 6]; 6]> {
        let up = rotate(&x.q.inverse(), &Vector3::z());
        let w = self.position_rates(t, x);
        let none = Vector3::zeros();
        let columns = [0, 1, 2, 3, 4, 5].map(|column| {
            let unit = Vector3::from_fn(|i, _| if i == column % 3 { 1.0 } else { 0.0 });
            let (rate, change) = if column < 3 {
                (none, self.0.moment(&up.cross(&unit), &none))
            } else {
                let d = Top::inverse::<f64>() * unit;
                (d, self.0.moment(&none, &d) - d.cross(&x.u) - w.cross(&unit))
            };
            [rate.x, rate.y, rate.z, change.x, change.y, change.z]
        });
        FullJacobian(core::array::from_fn(|i| columns.map(|column| column[i])))
    }
    fn input_derivative(&self, _t: f64, _x: &Self::State, (): &(), (): &()) -> (Vector3<f64>, ()) {
        (Vector3::zeros(), ())
    }
}

/// Momenta have the inverse of the inertia for a mass matrix.
impl Verifiable<3> for Loaded<f64> {
    fn free_motion(&self, t: f64, x: &Self::State, (): &()) -> (Vector3<f64>, Vector3<f64>) {
        (self.derivative(t, x, &()).0, Vector3::zeros())
    }
    fn efforts(&self, t: f64, x: &Self::State, (): &(), accelerations: &Vector3<f64>) -> Vector3<f64> {
        Top::inverse::<f64>() * (accelerations - self.derivative(t, x, &()).0)
    }
    fn inertia(&self, _t: f64, _x: &Self::State, (): &()) -> Matrix3<f64> {
        Top::inverse()
    }
    fn kinetic(&self, t: f64, x: &Self::State, (): &()) -> f64 {
        0.5 * x.u.dot(&self.position_rates(t, x))
    }
}

/// The same top on a quaternion with `q' = v`.
#[derive(Clone, Copy)]
pub(super) struct Turned(pub(super) Top);

impl System for Turned {
    type Scalar = f64;
    type State = State<f64, UnitQuaternion<f64>, Vector3<f64>>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Self::State, (): &()) -> (Vector3<f64>, ()) {
        (self.0.accel(&rotate(&x.q.inverse(), &Vector3::z()), &x.u), ())
    }
    fn position_rates(&self, _t: f64, x: &Self::State) -> Vector3<f64> {
        x.u
    }
}

/// A disc of radius 0.5 m that rolls upright: where it touches, its heading and its angle, with the rates of the latter two,
/// damped and driven. Without both it rolls in a circle.
#[derive(Clone, Copy)]
pub(super) struct Disc<T> {
    pub(super) damping: T,
}

impl<T: Real> System for Disc<T> {
    type Scalar = T;
    type State = State<T, Vector4<T>, Vector2<T>>;
    type Input = Vector2<T>;
    fn derivative(&self, _t: T, x: &Self::State, moments: &Vector2<T>) -> (Vector2<T>, ()) {
        (Vector2::new(moments.x - self.damping * x.u.x, T::lit(2.0) * (moments.y - self.damping * x.u.y)), ())
    }
    fn position_rates(&self, _t: T, x: &Self::State) -> Vector4<T> {
        let (sin, cos) = Real::sin_cos(x.q.z);
        let speed = T::lit(0.5) * x.u.y;
        Vector4::new(speed * cos, speed * sin, x.u.x, x.u.y)
    }
}

impl Differentiable for Disc<f64> {
    type Matrix = FullJacobian<[[f64; 6]; 6]>;
    fn jacobian(&self, _t: f64, x: &Self::State, _moments: &Vector2<f64>) -> FullJacobian<[[f64; 6]; 6]> {
        let (sin, cos) = x.q.z.sin_cos();
        let mut rows = [[0.0; 6]; 6];
        (rows[0][2], rows[0][5]) = (-0.5 * x.u.y * sin, 0.5 * cos);
        (rows[1][2], rows[1][5]) = (0.5 * x.u.y * cos, 0.5 * sin);
        (rows[2][4], rows[3][5]) = (1.0, 1.0);
        (rows[4][4], rows[5][5]) = (-self.damping, -2.0 * self.damping);
        FullJacobian(rows)
    }
    fn input_derivative(
        &self,
        _t: f64,
        _x: &Self::State,
        _moments: &Vector2<f64>,
        change: &Vector2<f64>,
    ) -> (Vector2<f64>, ()) {
        (Vector2::new(change.x, 2.0 * change.y), ())
    }
}

/// A blade on ice: its place, and the cosine and sine of its heading, a coordinate more than it has. Its speeds are ahead,
/// aside, which its edge doesn't allow, and turning.
#[derive(Clone, Copy)]
pub(super) struct Skate;

impl System for Skate {
    type Scalar = f64;
    type State = State<f64, Vector4<f64>, Vector3<f64>>;
    type Input = ();
    fn derivative(&self, _t: f64, _x: &Self::State, (): &()) -> (Vector3<f64>, ()) {
        (Vector3::zeros(), ())
    }
    fn position_rates(&self, _t: f64, x: &Self::State) -> Vector4<f64> {
        let [c, s] = [x.q.z, x.q.w];
        let [ahead, aside, turn] = [x.u.x, x.u.y, x.u.z];
        Vector4::new(c * ahead - s * aside, s * ahead + c * aside, -s * turn, c * turn)
    }
}

impl Constrained for Skate {
    type Residual = Vector2<f64>;
    fn constraints(&self, _t: f64, q: &Vector4<f64>) -> Vector2<f64> {
        Vector2::new(0.5 * (q.z * q.z + q.w * q.w - 1.0), 0.0)
    }
    fn constraint_rate(&self, t: f64, x: &Self::State) -> Vector2<f64> {
        let rates = self.position_rates(t, x);
        Vector2::new(x.q.z * rates.z + x.q.w * rates.w, x.u.y)
    }
    fn correction(&self, _t: f64, state: &Self::State, r: &Vector2<f64>, w: &Vector4<f64>) -> (Vector4<f64>, f64) {
        let row = Vector4::new(0.0, 0.0, state.q.z, state.q.w).transpose();
        least_norm(&row, &Vector1::new(r.x), w)
    }
    fn velocity_correction(
        &self,
        _t: f64,
        _x: &Self::State,
        r: &Vector2<f64>,
        w: &Vector3<f64>,
    ) -> (Vector3<f64>, f64) {
        least_norm(&Vector3::y().transpose(), &Vector1::new(r.y), w)
    }
    fn constraints_along(&self, _t: f64, x: &Self::State, d: &Vector4<f64>) -> Vector2<f64> {
        Vector2::new(x.q.z * d.z + x.q.w * d.w, 0.0)
    }
}

/// A bob on a rod in x and y with speeds `u_i = (2 + sin q_i) (q_i' - n_i(t))`, counting how often its slope is asked for.
pub(super) struct Tilted {
    pub(super) rod: Rod<f64>,
    pub(super) clock: f64,
    pub(super) slopes: Cell<u32>,
}

impl Tilted {
    pub(super) fn of(rod: Rod<f64>, clock: f64) -> Self {
        Self { rod, clock, slopes: Cell::new(0) }
    }
    /// The speeds for rates of one.
    pub(super) fn ratios(q: &Vector2<f64>) -> Vector2<f64> {
        q.map(|q| 2.0 + q.sin())
    }
    /// What moves by itself, and the rate of that.
    fn own(&self, t: f64) -> [Vector2<f64>; 2] {
        let (sin, cos) = t.sin_cos();
        [Vector2::new(0.3 * cos, -0.2 * sin) * self.clock, Vector2::new(-0.3 * sin, -0.2 * cos) * self.clock]
    }
    pub(super) fn speeds(&self, t: f64, q: &Vector2<f64>, v: &Vector2<f64>) -> Vector2<f64> {
        Self::ratios(q).component_mul(&(v - self.own(t)[0]))
    }
    pub(super) fn plain(&self, t: f64, x: &State<f64, Vector2<f64>, Vector2<f64>>) -> Coordinates<f64, 2> {
        Coordinates { q: x.q, v: x.u.component_div(&Self::ratios(&x.q)) + self.own(t)[0] }
    }
}

impl System for Tilted {
    type Scalar = f64;
    type State = State<f64, Vector2<f64>, Vector2<f64>>;
    type Input = ();
    fn derivative(&self, t: f64, x: &Self::State, (): &()) -> (Vector2<f64>, ()) {
        let plain = self.plain(t, x);
        let (accel, ()) = self.rod.derivative(t, &plain, &());
        let [own, change] = self.own(t);
        let turning = x.q.map(f64::cos).component_mul(&plain.v).component_mul(&(plain.v - own));
        (turning + Self::ratios(&x.q).component_mul(&(accel - change)), ())
    }
    fn position_rates(&self, t: f64, x: &Self::State) -> Vector2<f64> {
        self.plain(t, x).v
    }
    fn slope(&self, t: f64, x: &Self::State, (): &()) -> SlopeOf<Self> {
        self.slopes.set(self.slopes.get() + 1);
        Slope { q: self.position_rates(t, x), v: self.derivative(t, x, &()).0, x: () }
    }
}

impl Differentiable for Tilted {
    type Matrix = FullJacobian<[[f64; 4]; 4]>;
    fn jacobian(&self, t: f64, x: &Self::State, (): &()) -> FullJacobian<[[f64; 4]; 4]> {
        FullJacobian(differences(self, t, x, &()))
    }
    fn input_derivative(&self, _t: f64, _x: &Self::State, (): &(), (): &()) -> (Vector2<f64>, ()) {
        (Vector2::zeros(), ())
    }
}

impl Constrained for Tilted {
    type Residual = f64;
    fn constraints(&self, t: f64, q: &Vector2<f64>) -> f64 {
        self.rod.constraints(t, q)
    }
    fn constraint_rate(&self, t: f64, x: &Self::State) -> f64 {
        self.rod.constraint_rate(t, &self.plain(t, x))
    }
    fn correction(&self, t: f64, state: &Self::State, residual: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
        self.rod.correction(t, &self.plain(t, state), residual, weights)
    }
    fn velocity_correction(&self, _t: f64, x: &Self::State, r: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
        least_norm(&x.q.component_div(&Self::ratios(&x.q)).transpose(), &Vector1::new(*r), weights)
    }
    fn constraints_along(&self, _t: f64, x: &Self::State, d: &Vector2<f64>) -> f64 {
        x.q.dot(d)
    }
}

impl Impulsive for Tilted {
    type Rates = f64;
    fn jump(&self, t: f64, state: &Self::State, impulse: &Vector2<f64>, rates: &f64) -> (Vector2<f64>, f64) {
        let ratios = Self::ratios(&state.q);
        let (jump, rank) = self.rod.jump(t, &self.plain(t, state), &ratios.component_mul(impulse), rates);
        (ratios.component_mul(&jump), rank)
    }
}

/// A wrapper that leaves everything as it is but the derivatives by displacement, which it scales.
#[derive(Clone, Copy)]
pub(super) struct Misled<S>(pub(super) S, pub(super) f64);

impl<S: System<Scalar = f64>> System for Misled<S> {
    type Scalar = f64;
    type State = S::State;
    type Input = S::Input;
    fn derivative(&self, t: f64, x: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.0.derivative(t, x, input)
    }
    fn position_rates(&self, t: f64, x: &S::State) -> multibody::DisplacementOf<S> {
        self.0.position_rates(t, x)
    }
}

impl<S, const W: usize> Differentiable for Misled<S>
where
    S: Differentiable<Scalar = f64, Matrix = FullJacobian<[[f64; W]; W]>>,
{
    type Matrix = FullJacobian<[[f64; W]; W]>;
    fn jacobian(&self, t: f64, x: &S::State, input: &S::Input) -> FullJacobian<[[f64; W]; W]> {
        let FullJacobian(rows) = self.0.jacobian(t, x, input);
        FullJacobian(rows.map(|row| row.map(|entry| self.1 * entry)))
    }
    fn input_derivative(
        &self,
        t: f64,
        x: &S::State,
        input: &S::Input,
        change: &S::Input,
    ) -> (VelocityOf<S>, ExtraOf<S>) {
        self.0.input_derivative(t, x, input, change)
    }
}

/// Lists as vectors, for weights.
pub(super) fn weights<const N: usize>(list: [f64; N]) -> SVector<f64, N> {
    SMatrix::from(list)
}
