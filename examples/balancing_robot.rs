//! A robot that balances on two wheels and drives a figure of eight.
//!
//! `cargo run --release --example balancing_robot`
//!
//! State feedback from the model's own derivatives: at rest upright the linearised equations, along what both wheels allow, give the
//! gains that are best for a quadratic cost (the algebraic Riccati equation, by the sign of its Hamiltonian). The law is held from one sample to the next, at 200 Hz, on the whole model.

use std::f64::consts::TAU;

use multibody::nalgebra::{Matrix2, Matrix3, SMatrix, SVector};
use multibody::{Dop853, Integrator, Projection, WithProjection};

mod charts;
#[path = "models/balancing_robot.rs"]
mod model;

use charts::{BLUE, Chart, Curve, GREY, RED, draw};
use model::balancer::{Input, Model, State};

/// What is fed back: pitch, its rate, speed, rate of the heading.
const STATES: usize = 4;
/// Velocities: x, y, heading, pitch, left and right motor.
const V: usize = 6;

/// A and B of pitch, its rate, speed and the rate of the heading, upright at rest.
fn beside_rest(model: &Model) -> (SMatrix<f64, STATES, STATES>, SMatrix<f64, STATES, 2>) {
    let linear = model.linearize(0.0, &State::default(), &Input::default());
    // Slips ahead of both wheels, and aside of one: what y and both motors follow from.
    let follows = [1, 4, 5];
    let rows = [0, 3, 1];
    let slips = Matrix3::from_fn(|i, j| linear.c[(rows[i], V + follows[j])]);
    let solve = slips.try_inverse().expect("the wheels don't roll about one point");
    // Pitch, its rate, speed, rate of the heading among displacements and velocities.
    let given = [3, V + 3, V, V + 2];
    let changes = given.map(|at| {
        let mut change = SVector::<f64, { 2 * V }>::zeros();
        change[at] = 1.0;
        let left = linear.c * change;
        let following = -(solve * SVector::from(rows.map(|row| left[row])));
        follows.iter().zip(&following).for_each(|(&at, &value)| change[V + at] = value);
        linear.a * change
    });
    let a = SMatrix::from_fn(|i, j| changes[j][given[i]]);
    let b = SMatrix::from_fn(|i, j| linear.b[(given[i], j)]);
    (a, b)
}

/// Gains K of the law u = -K x with the least integral of x' Q x + u' R u.
fn gains(model: &Model) -> SMatrix<f64, 2, STATES> {
    let (a, b) = beside_rest(model);
    let state_cost = SMatrix::<f64, STATES, STATES>::from_diagonal(&SVector::from([20.0, 1.0, 8.0, 1.0]));
    let inverse = Matrix2::identity() / 20.0;
    // The stable half of the Hamiltonian's space, by the iteration for the sign of a matrix (Roberts 1980).
    let weight = b * inverse * b.transpose();
    let mut sign = SMatrix::<f64, { 2 * STATES }, { 2 * STATES }>::zeros();
    sign.fixed_view_mut::<STATES, STATES>(0, 0).copy_from(&a);
    sign.fixed_view_mut::<STATES, STATES>(0, STATES).copy_from(&-weight);
    sign.fixed_view_mut::<STATES, STATES>(STATES, 0).copy_from(&-state_cost);
    sign.fixed_view_mut::<STATES, STATES>(STATES, STATES).copy_from(&-a.transpose());
    for _ in 0..40 {
        sign = (sign + sign.try_inverse().expect("motions that neither grow nor die out can't be stabilised")) * 0.5;
    }
    // (sign + 1) [1; P] = 0
    let whole = sign + SMatrix::identity();
    let right = whole.fixed_columns::<STATES>(STATES).into_owned();
    let left = whole.fixed_columns::<STATES>(0).into_owned();
    let normal = (right.transpose() * right).try_inverse().expect("half of the space is stable");
    let p = -(normal * right.transpose() * left);
    let rest = a.transpose() * p + p * a - p * weight * p + state_cost;
    println!("Left of the Riccati equation: {:.0e}", rest.amax());
    inverse * b.transpose() * p
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::default();
    let gains = gains(&model);
    println!("Gains on pitch, its rate, speed, rate of heading:{gains:.4}");
    let system = WithProjection::new(model, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-9, 1e-9);
    let mut state = State::default();
    state.q.pitch = 0.25; // rad, ahead
    let (mut path, mut pitches, mut speeds, mut wanted) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (period, span) = (0.005, 16.0);
    let mut slip = 0.0_f64;
    for k in 0..(span / period) as u32 {
        let t = period * f64::from(k);
        let out = model.outputs(t, &state, &Input::default());
        slip = out.slips.iter().map(|v| v.amax()).fold(slip, f64::max);
        // Two seconds to find its feet; then a circle to the left and one to the right, seven seconds each.
        let (speed, turning) = match t {
            t if t < 2.0 => (0.0, 0.0),
            t if t < 9.0 => (0.5, TAU / 7.0),
            _ => (0.5, -TAU / 7.0),
        };
        let error = SVector::from([state.q.pitch, state.v.pitch, out.speed - speed, state.v.place.angle - turning]);
        let torque = -(gains * error);
        path.push((state.q.place.x, state.q.place.y));
        pitches.push((t, state.q.pitch.to_degrees()));
        speeds.push((t, 10.0 * out.speed));
        wanted.push((t, 10.0 * speed));
        let input = Input { torque: [torque[0], torque[1]] };
        (state, _) = integrator.integrate(&system, t, t + period, &state, &input, |_, _| ())?;
    }
    let speed = model.outputs(span, &state, &Input::default()).speed;
    println!(
        "From {:.0} degrees it comes upright; after {span} s: pitch {:.3} degrees, speed {speed:.3} m/s, slip of the wheels {slip:.0e} m/s.",
        0.25_f64.to_degrees(),
        state.q.pitch.to_degrees()
    );
    assert!(state.q.pitch.abs() < 0.02 && (speed - 0.5).abs() < 0.05 && slip < 1e-8);
    draw(
        "target/balancing_robot.svg",
        &[
            Chart {
                title: "Its path, from above",
                axes: ["[m]", "[m]"],
                curves: vec![Curve { name: "axle", colour: BLUE, points: path, is_dotted: false }],
                band: None,
                limits: None,
                is_map: true,
            },
            Chart {
                title: "Pitch and speed",
                axes: ["t [s]", "[degrees], [0.1 m/s]"],
                curves: vec![
                    Curve { name: "speed wanted", colour: GREY, points: wanted, is_dotted: false },
                    Curve { name: "speed", colour: RED, points: speeds, is_dotted: false },
                    Curve { name: "pitch", colour: BLUE, points: pitches, is_dotted: false },
                ],
                band: None,
                limits: None,
                is_map: false,
            },
        ],
    )
}
