//! Compensated summation: what rounding leaves out of a state is not lost, over a million steps, for rotations too.

use crate::common::loops::{Coordinates, Rod};
use crate::common::{Body, Flight, Oscillator, Scalar};
use core::marker::PhantomData;
use multibody::nalgebra::{Quaternion, UnitQuaternion, Vector2, Vector3};
use multibody::{
    Dop853, GaussLegendre6, Integrator, Method, Pose, Projection, Rk4, System, Tangent, Twist, WithProjection, rotation,
};

const STEPS: u32 = 1_000_000;

/// The error of the oscillator after a million steps of `dt`.
fn oscillator<M: Method<Oscillator<f64>>>(integrator: Integrator<M>, dt: f64) -> f64 {
    let end = f64::from(STEPS) * dt;
    let start = Scalar { q: 1.0, v: 0.0 };
    let (state, statistics) =
        integrator.integrate(&Oscillator(PhantomData), 0.0, end, &start, &0.0, |_, _| ()).unwrap();
    assert_eq!(statistics.accepted, STEPS);
    (state.q - end.cos()).hypot(state.v + end.sin())
}

#[test]
fn a_million_steps_of_an_oscillator() {
    // Steps of a power of two: the times are exact, and the method's own error is far below a rounding.
    let dt = 1.0 / 128.0;
    let plain = oscillator(Integrator::fixed(Dop853, dt), dt);
    let compensated = oscillator(Integrator::fixed(Dop853, dt).compensated(), dt);
    println!("a million steps: plain {plain:.1e}, compensated {compensated:.1e}");
    assert!(compensated < 5e-14 && compensated < 0.5 * plain);
}

/// Implicit methods too hand on a change of velocities with all its digits.
#[test]
fn a_million_implicit_steps_of_an_oscillator() {
    let dt = 1.0 / 256.0; // so short that the method's own error is below 1e-15
    let plain = oscillator(Integrator::fixed(GaussLegendre6, dt), dt);
    let compensated = oscillator(Integrator::fixed(GaussLegendre6, dt).compensated(), dt);
    println!("a million implicit steps: plain {plain:.1e}, compensated {compensated:.1e}");
    assert!(compensated < 5e-15 && compensated < 0.5 * plain);
}

/// A ball that spins about a fixed axis. Errors of its angle, and the greatest gap of the quaternion's length from one.
fn spin<M: Method<Body<f64>>>(integrator: Integrator<M>, dt: f64) -> (f64, f64) {
    let ball = Body { inertia: Vector3::new(0.4, 0.4, 0.4), force: Tangent::zero() };
    let angular = Vector3::new(2.0, 3.0, -6.0); // exactly 7 rad/s
    let start = Flight { q: Pose::default(), v: Twist { linear: Tangent::zero(), angular } };
    let mut gap = 0.0;
    let end = f64::from(STEPS) * dt;
    let watch = |_: f64, x: &Flight<f64>| gap = f64::max(gap, length_gap(&x.q.orientation));
    let (state, _) = integrator.integrate(&ball, 0.0, end, &start, &(), watch).unwrap();
    let (sin, cos) = (3.5 * end).sin_cos();
    let exact = UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, angular / 7.0 * sin));
    ((exact.as_ref() - state.q.orientation.as_ref()).norm() * 2.0, gap)
}

/// By how much the length of a quaternion differs from one, to the square of a rounding: squares are summed exactly.
fn length_gap(q: &UnitQuaternion<f64>) -> f64 {
    let mut sum = -1.0;
    let mut rest = 0.0;
    for x in q.as_ref().coords.iter() {
        let square = x * x;
        rest += x.mul_add(*x, -square);
        let next: f64 = sum + square;
        let part = next - sum;
        rest += (sum - (next - part)) + (square - part);
        sum = next;
    }
    0.5 * (sum + rest).abs()
}

#[test]
fn a_million_steps_of_a_rotation() {
    let dt = 1.0 / 1024.0;
    let plain = spin(Integrator::fixed(Rk4, dt), dt);
    let compensated = spin(Integrator::fixed(Rk4, dt).compensated(), dt);
    println!("angle and length after a million steps: plain {plain:?}, compensated {compensated:?}");
    assert!(plain.1 <= 4e-16 && compensated.1 <= 4e-16);
    assert!(compensated.0 < 0.5 * plain.0 && compensated.0 < 1e-16 * 7.0 * 977.0);
}

/// `rotation::advance` keeps what a quaternion can't hold: a turn in ten thousand parts, each with its rounding.
#[test]
fn displacements_of_a_rotation_add_up() {
    let part = Vector3::new(1e-4, -2e-4, 3e-5);
    let (mut q, mut rest) = (UnitQuaternion::identity(), Vector3::zeros());
    let mut plain = q;
    for _ in 0..10_000 {
        (q, rest) = rotation::advance(&q, &part, &rest);
        plain = rotation::displace(&plain, &part);
        assert!(length_gap(&q) <= 4e-16 && rest.norm() < 1e-15);
    }
    let exact = rotation::from_scaled_axis(&(part * 1e4));
    let gap = |q: &UnitQuaternion<f64>| 2.0 * (q.as_ref() - exact.as_ref()).norm();
    let with_rest = gap(&rotation::displace(&q, &rest));
    println!("ten thousand parts of a turn: plain {:.1e}, compensated {:.1e}", gap(&plain), with_rest);
    assert!(with_rest < 5e-16 && gap(&plain) > 2.0 * with_rest);
    // Great displacements and those beyond half a turn.
    for d in [Vector3::new(1.0, 2.0, -0.5), Vector3::new(0.0, 4.0, 0.0), Vector3::new(0.0, 0.0, 7.0)] {
        let (next, left) = rotation::advance(&q, &d, &Vector3::zeros());
        assert!((next.as_ref() - rotation::displace(&q, &d).as_ref()).norm() < 1e-15 && left.norm() < 1e-15);
    }
}

#[test]
fn single_precision() {
    let error = |integrator: Integrator<Rk4>| {
        let system = Oscillator(PhantomData);
        let start = Scalar { q: 1.0f32, v: 0.0 };
        let (end, _) = integrator.integrate(&system, 0.0, 1000.0, &start, &0.0, |_, _| ()).unwrap();
        (f64::from(end.q) - 1000f64.cos()).hypot(f64::from(end.v) + 1000f64.sin())
    };
    let fixed = Integrator::fixed(Rk4, 1.0 / 128.0);
    let (plain, compensated) = (error(fixed), error(fixed.compensated()));
    println!("128,000 steps in single precision: plain {plain:.1e}, compensated {compensated:.1e}");
    assert!(compensated < 0.5 * plain && compensated < 2e-6);
}

/// A projection moves a state by less than a step does, so what rounding has left out of the state is still owed to it.
#[test]
fn projections_keep_what_is_owed() {
    // A bead on a ring, without gravity: it goes round evenly.
    let (dt, steps) = (1.0 / 128.0, 20_000);
    let end = f64::from(steps) * dt;
    let once = Projection { iterations: 1, ..Projection::default() };
    let ring = WithProjection::fixed(Rod { gravity: 0.0, stretch: 0.0 }, once);
    // Rounding has its luck: the mean of the logarithms over many speeds.
    let error = |integrator: Integrator<Dop853>| {
        let sum: f64 = (0..40)
            .map(|k| {
                let speed = 0.3 + 0.017 * f64::from(k);
                let start = Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.0, speed) };
                let (state, _) = integrator.integrate(&ring, 0.0, end, &start, &(), |_, _| ()).unwrap();
                (state.q - Vector2::new((speed * end).cos(), (speed * end).sin())).norm().ln()
            })
            .sum();
        (sum / 40.0).exp()
    };
    let fixed = Integrator::fixed(Dop853, dt);
    let (plain, compensated) = (error(fixed), error(fixed.compensated()));
    println!("20,000 steps with projections: plain {plain:.1e}, compensated {compensated:.1e}");
    assert!(compensated < 0.4 * plain); // a fourth; two thirds if it were forgotten where a projection changed a state
}

/// A point that drifts, and starts anew wherever it has gone beyond a million metres.
struct Reset;

impl System for Reset {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (0.0, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
    fn accepted(&self, _t: f64, state: &Scalar<f64>, (): &()) -> Scalar<f64> {
        Scalar { q: if state.q > 1e6 { 0.0 } else { state.q }, v: state.v }
    }
}

/// What is owed to a state is less than its rounding; where a step's end becomes something far smaller, it is forgotten.
#[test]
fn what_is_owed_ends_with_the_state() {
    let fixed = Integrator::fixed(Rk4, 0.125).compensated();
    let end = |q: f64, t: f64| fixed.integrate(&Reset, t, 1.0, &Scalar { q, v: 0.1 }, &(), |_, _| ()).unwrap().0;
    assert_eq!(end(1e6, 0.0), end(0.0, 0.125));
}
