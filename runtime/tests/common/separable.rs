//! Systems whose accelerations depend on time and position alone, written by hand.

use super::loops::Coordinates;
use super::{Flight, Oscillator, Pendulum, rotate};
use multibody::nalgebra::{UnitQuaternion, Vector2, Vector3};
use multibody::{Canonical, Pose, Real, Separable, System, Twist};

impl<T: Real> Separable for Oscillator<T> {}
impl<T: Real> Separable for Pendulum<T> {}

/// A mass of one in the potential of Henon and Heiles (1964).
pub(crate) struct Star;

impl System for Star {
    type Scalar = f64;
    type State = Coordinates<f64, 2>;
    type Input = ();
    fn derivative(&self, _t: f64, state: &Coordinates<f64, 2>, (): &()) -> (Vector2<f64>, ()) {
        let [x, y] = state.q.into();
        (Vector2::new(-x - 2.0 * x * y, -y - x * x + y * y), ())
    }
    fn position_rates(&self, _t: f64, state: &Coordinates<f64, 2>) -> Vector2<f64> {
        state.v
    }
}

impl Separable for Star {}

/// A ball with a magnet along x in a field that turns about z once in 2 pi seconds, on a spring that pulls its pole
/// `(0.5, 0, 0)` to the origin. Its mass is one.
pub(crate) struct Compass {
    pub(crate) inertia: Vector3<f64>,
}

impl Compass {
    pub(crate) fn ball() -> Self {
        Self { inertia: Vector3::new(0.4, 0.4, 0.4) }
    }
    pub(crate) fn top() -> Self {
        Self { inertia: Vector3::new(0.3, 0.5, 0.6) }
    }
    pub(crate) fn start() -> Flight<f64> {
        let v = Twist { linear: Vector3::new(0.2, -0.3, 0.4), angular: Vector3::new(1.1, -0.7, 0.9) };
        Flight { q: Pose::default(), v }
    }
    /// Force on the centre in world axes and moment about it in the ball's.
    fn efforts(t: f64, q: &Pose<f64>) -> Twist<f64> {
        let arm = Vector3::new(0.5, 0.0, 0.0);
        let pull = -(q.position + rotate(&q.orientation, &arm)) * 3.0;
        let inverse: UnitQuaternion<f64> = q.orientation.inverse();
        let field = rotate(&inverse, &Vector3::new(t.cos(), t.sin(), 0.5));
        Twist { linear: pull, angular: Vector3::x().cross(&field) * 0.8 + arm.cross(&rotate(&inverse, &pull)) }
    }
}

impl System for Compass {
    type Scalar = f64;
    type State = Flight<f64>;
    type Input = ();
    fn derivative(&self, t: f64, state: &Flight<f64>, (): &()) -> (Twist<f64>, ()) {
        let efforts = Self::efforts(t, &state.q);
        let w = state.v.angular;
        let moment = efforts.angular - w.cross(&self.inertia.component_mul(&w));
        (Twist { linear: efforts.linear, angular: moment.component_div(&self.inertia) }, ())
    }
    fn position_rates(&self, _t: f64, state: &Flight<f64>) -> Twist<f64> {
        state.v
    }
}

/// For [`Compass::ball`], whose angular momentum is along its angular velocity.
impl Separable for Compass {}

/// Momenta in the axes of the velocities: body axes for the angular one.
impl Canonical for Compass {
    fn momentum(&self, state: &Flight<f64>) -> Twist<f64> {
        Twist { linear: state.v.linear, angular: self.inertia.component_mul(&state.v.angular) }
    }
    fn velocity(&self, _q: &Pose<f64>, momentum: &Twist<f64>) -> Twist<f64> {
        Twist { linear: momentum.linear, angular: momentum.angular.component_div(&self.inertia) }
    }
    fn momentum_rate(&self, t: f64, state: &Flight<f64>, (): &()) -> Twist<f64> {
        let efforts = Self::efforts(t, &state.q);
        let w = state.v.angular;
        Twist { linear: efforts.linear, angular: efforts.angular + self.inertia.component_mul(&w).cross(&w) }
    }
}
