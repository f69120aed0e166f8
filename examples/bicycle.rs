//! A bicycle that balances itself: its small motions over speed, and what it does after a push.
//!
//! `cargo run --release --example bicycle`
//!
//! Between the speeds of weave and of capsize all small motions die out. There the bicycle is pushed from the side, hands off: it leans,
//! steers into the fall by itself, and goes on upright in another direction. Pictures go into `target/bicycle.svg`.

use multibody::nalgebra::{Complex, Matrix4, SMatrix, SVector};
use multibody::{Dop853, Integrator, Projection, WithProjection};

mod charts;
#[path = "models/bicycle.rs"]
mod model;

use charts::{BLUE, Chart, Curve, GREY, RED, draw};
use model::bicycle::{Input, Model, Position, State, Velocity};

/// Places among the coordinates.
const ROLL: usize = 4;
const STEER: usize = 7;
/// Velocities that follow from those of roll and steer; that of the rear wheel, the speed, stays.
const FOLLOWS: [usize; 6] = [0, 1, 2, 3, 5, 8];

/// Upright and straight ahead at a speed in m/s.
fn riding(speed: f64) -> State {
    State {
        q: Position { z: -0.3, ..Position::default() },
        v: Velocity { x: speed, spin_rear: -speed / 0.3, spin_front: -speed / 0.35, ..Velocity::default() },
    }
}

/// Rates of small changes of roll, steer and their rates beside the straight motion: the linearised equations along what both
/// wheels allow. A change of the slips is one of `x` that the wheels don't.
fn small_motions(model: &Model, speed: f64) -> Matrix4<f64> {
    let linear = model.linearize(0.0, &riding(speed), &Input::default());
    // Slips of both wheels are the first six outputs; velocities stand behind the nine coordinates.
    let following = SMatrix::<f64, 6, 6>::from_fn(|i, j| linear.c[(i, 9 + FOLLOWS[j])]);
    let solve = following.try_inverse().expect("velocities that both wheels give");
    let column = |given: usize| {
        let mut change = SVector::<f64, 18>::zeros();
        change[given] = 1.0;
        let slips = (linear.c * change).fixed_rows::<6>(0).into_owned();
        for (&k, follows) in FOLLOWS.iter().zip(&(-(solve * slips))) {
            change[9 + k] = *follows;
        }
        let rates = linear.a * change;
        [rates[ROLL], rates[STEER], rates[9 + ROLL], rates[9 + STEER]]
    };
    let columns = [ROLL, STEER, 9 + ROLL, 9 + STEER].map(column);
    Matrix4::from_fn(|i, j| columns[j][i])
}

/// [m/s] where the sign of a function changes between two speeds.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(low) < 0.0) == (f(middle) < 0.0) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::default();
    let roots = |speed: f64| small_motions(&model, speed).complex_eigenvalues();
    // How fast the worst motion grows that swings, or that doesn't.
    let growth = |speed: f64, swings: bool| {
        roots(speed).iter().filter(|x| (x.im != 0.0) == swings).map(|x| x.re).fold(f64::NEG_INFINITY, f64::max)
    };
    let weave = bisect(3.0, 5.0, |speed| growth(speed, true));
    let capsize = bisect(5.0, 8.0, |speed| growth(speed, false));
    println!(
        "Stable by itself from {weave:.6} m/s (weave) to {capsize:.6} m/s (capsize); published 4.292383 and 6.024262."
    );
    assert!((weave - 4.292_382_536_341).abs() < 1e-9 && (capsize - 6.024_262_015_388).abs() < 1e-9);

    // A push of 60 N for a fifth of a second.
    let speed = 4.9;
    let system = WithProjection::new(model, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-10, 1e-10);
    let (mut run, mut state, mut energy) = (Vec::new(), riding(speed), 0.0);
    for k in 0..200 {
        let (t, is_pushed) = (0.04 * f64::from(k), k < 5);
        let out = model.outputs(t, &state, &Input::default());
        run.push((t, state.q, out.rear_track, out.front_track));
        if k == 5 {
            energy = out.energy;
        }
        let input = Input { push: if is_pushed { 60.0 } else { 0.0 } };
        (state, _) = integrator.integrate(&system, t, t + 0.04, &state, &input, |_, _| ())?;
    }
    let left = model.outputs(8.0, &state, &Input::default()).energy / energy - 1.0;
    let lean = run.iter().map(|point| point.1.roll.abs()).fold(0.0, f64::max);
    let [most, yaw, roll] = [lean, state.q.yaw, state.q.roll].map(f64::to_degrees);
    println!(
        "Pushed at {speed} m/s it leans up to {most:.1} degrees; after 8 s it rides {yaw:.1} degrees off its course,"
    );
    println!("{roll:.2} degrees from upright. Energy after the push is kept to {:.0e}.", left.abs());
    assert!(lean > 0.02 && state.q.roll.abs() < 0.1 * lean && left.abs() < 1e-9);

    let speeds = (1..=200).map(|k| 0.05 * f64::from(k));
    let points: Vec<(f64, Complex<f64>)> =
        speeds.flat_map(|v| roots(v).iter().map(|root| (v, *root)).collect::<Vec<_>>()).collect();
    let waves = points.iter().filter(|(_, root)| root.im > 0.0).map(|(v, root)| (*v, root.im)).collect();
    let real = points.iter().map(|(v, root)| (*v, root.re)).collect();
    let eigenvalues = Chart {
        title: "Eigenvalues over speed",
        axes: ["speed [m/s]", "[1/s]"],
        curves: vec![
            Curve { name: "imaginary", colour: GREY, points: waves, is_dotted: true },
            Curve { name: "real", colour: BLUE, points: real, is_dotted: true },
        ],
        band: Some((weave, capsize, "stable by itself")),
        limits: Some(-10.0..10.0),
        is_map: false,
    };
    let angle = |of: fn(&Position) -> f64| run.iter().map(|(t, q, ..)| (*t, of(q).to_degrees())).collect();
    let after = Chart {
        title: "After a push from the side",
        axes: ["t [s]", "[degrees]"],
        curves: vec![
            Curve { name: "lean", colour: BLUE, points: angle(|q| q.roll), is_dotted: false },
            Curve { name: "steer", colour: RED, points: angle(|q| q.steer), is_dotted: false },
        ],
        band: None,
        limits: None,
        is_map: false,
    };
    let tracks = Chart {
        title: "Tracks of the wheels, from above",
        axes: ["ahead [m]", "to the left [m]"],
        curves: vec![
            Curve {
                name: "front",
                colour: RED,
                points: run.iter().map(|p| (p.3.x, -p.3.y)).collect(),
                is_dotted: false,
            },
            Curve {
                name: "rear",
                colour: BLUE,
                points: run.iter().map(|p| (p.2.x, -p.2.y)).collect(),
                is_dotted: false,
            },
        ],
        band: None,
        limits: None,
        is_map: true,
    };
    draw("target/bicycle.svg", &[eigenvalues, after, tracks])
}
