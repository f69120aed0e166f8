//! Stiff systems written by hand, with their derivatives, as `emit derivatives` would give them.

use super::{Body, Currents, Driven, Flight, Scalar};
use multibody::nalgebra::{Vector2, Vector3};
use multibody::{Differentiable, Jacobian, Pose, Real, StateSpace, System, Tangent, Twist};

/// Accelerations of one coordinate that are differentiated by dual parts written out: value, by position, by velocity.
type Partials<T> = (T, T, T);

/// `(1 - q^2) v - q`, divided by a small number: Van der Pol's oscillator in its slow time.
pub(crate) struct VanDerPol<T>(pub(crate) T);

/// A damped spring towards a point that moves as `cos t`, with the acceleration that keeps `cos t` a solution (Prothero
/// and Robinson 1974, for a mechanical system).
pub(crate) struct Follower<T> {
    pub(crate) stiffness: T,
    pub(crate) damping: T,
}

/// `q'' = -stiffness q - damping v`.
pub(crate) struct Linear<T> {
    pub(crate) stiffness: T,
    pub(crate) damping: T,
}

macro_rules! one_coordinate {
    ($name:ident, $self:ident, $t:ident, $q:ident, $v:ident, $partials:expr) => {
        impl<T: Real> $name<T> {
            fn partials($self: &Self, $t: T, state: &Scalar<T>) -> Partials<T> {
                let Scalar { q: $q, v: $v } = *state;
                $partials
            }
        }
        impl<T: Real> System for $name<T> {
            type Scalar = T;
            type State = Scalar<T>;
            type Input = T;
            fn derivative(&self, t: T, state: &Scalar<T>, input: &T) -> (T, ()) {
                (self.partials(t, state).0 + *input, ())
            }
            fn position_rates(&self, _t: T, state: &Scalar<T>) -> T {
                state.v
            }
        }
        impl<T: Real> Differentiable for $name<T> {
            type Matrix = [[T; 1]; 1];
            fn jacobian(&self, t: T, state: &Scalar<T>, _: &T) -> Jacobian<[[T; 1]; 1]> {
                let (_, q, v) = self.partials(t, state);
                Jacobian { position: [[q]], rates: [[v]] }
            }
            fn input_derivative(&self, _t: T, _: &Scalar<T>, _: &T, change: &T) -> (T, ()) {
                (*change, ())
            }
        }
    };
}

one_coordinate!(VanDerPol, self, _t, q, v, {
    let one = T::lit(1.0);
    let by = one / self.0;
    (((one - q * q) * v - q) * by, (-T::lit(2.0) * q * v - one) * by, (one - q * q) * by)
});
one_coordinate!(Follower, self, t, q, v, {
    let (sin, cos) = Real::sin_cos(t);
    (-cos - self.damping * (v + sin) - self.stiffness * (q - cos), -self.stiffness, -self.damping)
});
one_coordinate!(Linear, self, _t, q, v, (-self.stiffness * q - self.damping * v, -self.stiffness, -self.damping));

/// `x' = rate x`, beside a coordinate that `x` accelerates.
pub(crate) struct Decay(pub(crate) f64);

impl System for Decay {
    type Scalar = f64;
    type State = Driven<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, state: &Driven<f64>, (): &()) -> (f64, Currents<f64>) {
        (state.x.current, Currents { current: self.0 * state.x.current })
    }
    fn position_rates(&self, _t: f64, state: &Driven<f64>) -> f64 {
        state.v
    }
}

impl Differentiable for Decay {
    type Matrix = [[f64; 2]; 2];
    fn jacobian(&self, _t: f64, _: &Driven<f64>, (): &()) -> Jacobian<[[f64; 2]; 2]> {
        Jacobian { position: [[0.0; 2]; 2], rates: [[0.0, 1.0], [0.0, self.0]] }
    }
    fn input_derivative(&self, _: f64, _: &Driven<f64>, (): &(), (): &()) -> (f64, Currents<f64>) {
        (0.0, Currents { current: 0.0 })
    }
}

/// A motor on an arm that gravity pulls: `common::Motor` with any inductance.
pub(crate) struct Winding {
    pub(crate) inductance: f64,
}

impl System for Winding {
    type Scalar = f64;
    type State = Driven<f64>;
    type Input = f64;
    fn derivative(&self, _t: f64, state: &Driven<f64>, voltage: &f64) -> (f64, Currents<f64>) {
        let torque = 0.5 * state.x.current - 0.1 * state.v;
        let current = (voltage - 2.0 * state.x.current - 0.5 * state.v) / self.inductance;
        (torque - state.q.sin(), Currents { current })
    }
    fn position_rates(&self, _t: f64, state: &Driven<f64>) -> f64 {
        state.v
    }
}

impl Differentiable for Winding {
    type Matrix = [[f64; 2]; 2];
    fn jacobian(&self, _t: f64, state: &Driven<f64>, _: &f64) -> Jacobian<[[f64; 2]; 2]> {
        Jacobian {
            position: [[-state.q.cos(), 0.0], [0.0, 0.0]],
            rates: [[-0.1, 0.5], [-0.5 / self.inductance, -2.0 / self.inductance]],
        }
    }
    fn input_derivative(&self, _: f64, _: &Driven<f64>, _: &f64, change: &f64) -> (f64, Currents<f64>) {
        (0.0, Currents { current: change / self.inductance })
    }
}

/// Position and velocity in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane<T> {
    pub(crate) q: Vector2<T>,
    pub(crate) v: Vector2<T>,
}

impl<T: Real> StateSpace for Plane<T> {
    type Scalar = T;
    type Position = Vector2<T>;
    type Velocity = Vector2<T>;
    type Extra = ();
    fn split(&self) -> (Vector2<T>, Vector2<T>, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: Vector2<T>, v: Vector2<T>, (): ()) -> Self {
        Self { q, v }
    }
}

/// A point mass of 1 kg on a stiff damped spring of length one, under gravity along -y.
pub(crate) struct SpringPendulum<T> {
    pub(crate) stiffness: T,
    pub(crate) damping: T,
}

impl<T: Real> System for SpringPendulum<T> {
    type Scalar = T;
    type State = Plane<T>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Plane<T>, (): &()) -> (Vector2<T>, ()) {
        let Plane { q, v } = *state;
        let length = Real::sqrt(q.x * q.x + q.y * q.y);
        let e = q / length;
        let force = self.stiffness * (length - T::lit(1.0)) + self.damping * (e.x * v.x + e.y * v.y);
        (Vector2::new(-force * e.x, -force * e.y - T::lit(9.81)), ())
    }
    fn position_rates(&self, _t: T, state: &Plane<T>) -> Vector2<T> {
        state.v
    }
}

impl<T: Real> Differentiable for SpringPendulum<T> {
    type Matrix = [[T; 2]; 2];
    fn jacobian(&self, _t: T, state: &Plane<T>, (): &()) -> Jacobian<[[T; 2]; 2]> {
        let Plane { q, v } = *state;
        let length = Real::sqrt(q.x * q.x + q.y * q.y);
        let e = [q.x / length, q.y / length];
        let v = [v.x, v.y];
        let along = e[0] * v[0] + e[1] * v[1];
        let force = self.stiffness * (length - T::lit(1.0)) + self.damping * along;
        let delta = |i: usize, j: usize| T::lit(if i == j { 1.0 } else { 0.0 });
        // of e_i by q_j: (delta - e_i e_j) / length
        let turn = |i: usize, j: usize| (delta(i, j) - e[i] * e[j]) / length;
        let by_position = |i: usize, j: usize| {
            let rate = (0..2).fold(T::lit(0.0), |sum, k| sum + turn(k, j) * v[k]);
            -e[i] * (self.stiffness * e[j] + self.damping * rate) - force * turn(i, j)
        };
        let all = [0, 1];
        Jacobian {
            position: all.map(|i| all.map(|j| by_position(i, j))),
            rates: all.map(|i| all.map(|j| -self.damping * e[i] * e[j])),
        }
    }
    fn input_derivative(&self, _: T, _: &Plane<T>, (): &(), (): &()) -> (Vector2<T>, ()) {
        (Tangent::zero(), ())
    }
}

/// A rigid body that a spring and a damper turn towards the axes of the world, whose origin a spring and a damper hold.
pub(crate) struct Held {
    pub(crate) body: Body<f64>,
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

impl System for Held {
    type Scalar = f64;
    type State = Flight<f64>;
    type Input = Vector3<f64>;
    fn derivative(&self, t: f64, state: &Flight<f64>, moment: &Vector3<f64>) -> (Twist, ()) {
        let (free, ()) = self.body.derivative(t, state, &());
        let c = state.q.orientation.as_ref().coords;
        let spring = Vector3::new(c.x, c.y, c.z) * (2.0 * c.w * self.stiffness);
        let moment = moment - spring - state.v.angular * self.damping;
        let linear = free.linear - state.q.position * self.stiffness - state.v.linear * self.damping;
        (Twist { linear, angular: free.angular + moment.component_div(&self.body.inertia) }, ())
    }
    fn position_rates(&self, _t: f64, state: &Flight<f64>) -> Twist {
        state.v
    }
}

impl Differentiable for Held {
    type Matrix = [[f64; 6]; 6];
    fn jacobian(&self, _t: f64, state: &Flight<f64>, _: &Vector3<f64>) -> Jacobian<[[f64; 6]; 6]> {
        let c = state.q.orientation.as_ref().coords;
        let (u, w, i) = (Vector3::new(c.x, c.y, c.z), state.v.angular, self.body.inertia);
        let mut position = [[0.0; 6]; 6];
        let mut rates = [[0.0; 6]; 6];
        for k in 0..3 {
            (position[k][k], rates[k][k]) = (-self.stiffness, -self.damping);
        }
        for j in 0..3 {
            // q exp(d): the vector part changes by (w d + u x d) / 2, the real part by -u.d / 2.
            let d = Vector3::from_fn(|k, _| f64::from(k == j));
            let (du, dw) = ((d * c.w + u.cross(&d)) * 0.5, -0.5 * u.dot(&d));
            let spring = (u * dw + du * c.w) * (2.0 * self.stiffness);
            // of the gyroscopic terms by w
            let gyro = Vector3::new(
                (i.y - i.z) * (d.y * w.z + w.y * d.z),
                (i.z - i.x) * (d.z * w.x + w.z * d.x),
                (i.x - i.y) * (d.x * w.y + w.x * d.y),
            );
            let damped = gyro - d * self.damping;
            for k in 0..3 {
                position[3 + k][3 + j] = -spring[k] / i[k];
                rates[3 + k][3 + j] = damped[k] / i[k];
            }
        }
        Jacobian { position, rates }
    }
    fn input_derivative(&self, _: f64, _: &Flight<f64>, _: &Vector3<f64>, change: &Vector3<f64>) -> (Twist, ()) {
        (Twist { linear: Vector3::zeros(), angular: change.component_div(&self.body.inertia) }, ())
    }
}

/// A pose from a rotation vector.
pub(crate) fn turned(d: [f64; 3]) -> Pose {
    Pose { orientation: multibody::rotation::from_scaled_axis(&Vector3::from(d)), ..Pose::default() }
}

/// Dry friction on a mass: an acceleration that jumps where the velocity changes its sign, and no derivatives.
pub(crate) struct Rubbing<T>(pub(crate) T);

impl<T: Real> System for Rubbing<T> {
    type Scalar = T;
    type State = Scalar<T>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Scalar<T>, (): &()) -> (T, ()) {
        (Real::select(Real::gt(state.v, T::lit(0.0)), -self.0, self.0), ())
    }
    fn position_rates(&self, _t: T, state: &Scalar<T>) -> T {
        state.v
    }
}

impl<T: Real> Differentiable for Rubbing<T> {
    type Matrix = [[T; 1]; 1];
    fn jacobian(&self, _t: T, _: &Scalar<T>, (): &()) -> Jacobian<[[T; 1]; 1]> {
        Jacobian { position: [[T::lit(0.0)]], rates: [[T::lit(0.0)]] }
    }
    fn input_derivative(&self, _t: T, _: &Scalar<T>, (): &(), (): &()) -> (T, ()) {
        (T::lit(0.0), ())
    }
}

/// Two masses on a line with a stiff and damped spring of length one between them.
pub(crate) struct Pair<T>(pub(crate) T);
impl<T: Real> System for Pair<T> {
    type Scalar = T;
    type State = Plane<T>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Plane<T>, (): &()) -> (Vector2<T>, ()) {
        let pull = self.0 * (state.q.y - state.q.x - T::lit(1.0)) + self.0 * T::lit(1e-3) * (state.v.y - state.v.x);
        (Vector2::new(pull, -pull), ())
    }
    fn position_rates(&self, _t: T, state: &Plane<T>) -> Vector2<T> {
        state.v
    }
}
impl<T: Real> Differentiable for Pair<T> {
    type Matrix = [[T; 2]; 2];
    fn jacobian(&self, _t: T, _: &Plane<T>, (): &()) -> Jacobian<[[T; 2]; 2]> {
        let matrix = |k: T| [[-k, k], [k, -k]];
        Jacobian { position: matrix(self.0), rates: matrix(self.0 * T::lit(1e-3)) }
    }
    fn input_derivative(&self, _t: T, _: &Plane<T>, (): &(), (): &()) -> (Vector2<T>, ()) {
        (Vector2::from([T::lit(0.0); 2]), ())
    }
}
