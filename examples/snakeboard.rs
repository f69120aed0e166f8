//! A snakeboard: it gathers speed though nothing pushes it.
//!
//! `cargo run --release --example snakeboard`
//!
//! The rider swings against the board and steers both trucks in step with it (Lewis, Ostrowski, Burdick and Murray 1994). The
//! wheels hold across and run along; of their forces comes the speed. Work of the rider is the energy of the whole.

use multibody::nalgebra::SVector;
use multibody::{Dop853, Integrator, Projection, WithProjection};

mod charts;
#[path = "models/snakeboard.rs"]
mod model;

use charts::{BLUE, Chart, Curve, GREY, RED, draw};
use model::snakeboard::{Input, Model, State, Velocity};

/// [rad/s] of the gait
const RATE: f64 = 4.0;

/// Angle, rate and acceleration of a sine.
fn wave(size: f64, phase: f64, t: f64) -> [f64; 3] {
    let (sin, cos) = (RATE * t + phase).sin_cos();
    [size * sin, size * RATE * cos, -size * RATE * RATE * sin]
}

/// Torques that follow both waves: computed torque. Accelerations are affine in torques, so three evaluations give the law.
fn law(model: &Model, t: f64, x: &State) -> Input {
    let [swing, steer] = [wave(0.7, 0.0, t), wave(0.4, 0.3, t)];
    let wanted = |[angle, rate, accel]: [f64; 3], q: f64, v: f64| accel - 16.0 * (v - rate) - 64.0 * (q - angle);
    let accel = |twist: f64, turn: f64| {
        let Velocity { swing, steer, .. } = model.forward_dynamics(t, x, &Input { twist, turn }).v;
        [swing, steer]
    };
    let (none, by_twist, by_turn) = (accel(0.0, 0.0), accel(1.0, 0.0), accel(0.0, 1.0));
    let rest = [wanted(swing, x.q.swing, x.v.swing) - none[0], wanted(steer, x.q.steer, x.v.steer) - none[1]];
    let [[a, c], [b, d]] = [by_twist, by_turn].map(|by| [by[0] - none[0], by[1] - none[1]]);
    let det = a * d - b * c;
    Input { twist: (d * rest[0] - b * rest[1]) / det, turn: (a * rest[1] - c * rest[0]) / det }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::default();
    let system = WithProjection::new(model, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-10, 1e-10);
    let mut start = State::default();
    let ([swing, swing_rate, _], [steer, steer_rate, _]) = (wave(0.7, 0.0, 0.0), wave(0.4, 0.3, 0.0));
    (start.q.swing, start.q.steer, start.v.swing, start.v.steer) = (swing, steer, swing_rate, steer_rate);
    let mut state = Projection::default().project(&model, 0.0, &start)?.state;
    let before = model.outputs(0.0, &state, &Input::default()).energy;
    let (mut track, mut speeds, mut work, mut slip) = (Vec::new(), Vec::new(), 0.0, 0.0_f64);
    let period = 0.01;
    for k in 0..1000 {
        let t = period * f64::from(k);
        // Held from one sample to the next, as a controller would.
        let input = law(&model, t, &state);
        let out = model.outputs(t, &state, &input);
        let heading = state.q.place.angle;
        speeds.push((t, state.v.place.x * heading.cos() + state.v.place.y * heading.sin()));
        track.push((state.q.place.x, state.q.place.y));
        // Across is what the wheels hold: all of a slip is along.
        for (slipping, steered) in out.slips.iter().zip([state.q.steer, -state.q.steer]) {
            let across = SVector::<f64, 3>::from([-(heading + steered).sin(), (heading + steered).cos(), 0.0]);
            slip = slip.max(slipping.dot(&across).abs());
        }
        let q = state.q;
        (state, _) = integrator.integrate(&system, t, t + period, &state, &input, |_, _| ())?;
        work += input.twist * (state.q.swing - q.swing) + input.turn * (state.q.steer - q.steer);
    }
    let gained = model.outputs(10.0, &state, &Input::default()).energy - before;
    let speed = speeds.iter().rev().take(157).map(|point| point.1).sum::<f64>() / 157.0;
    println!(
        "After ten seconds the board goes at {speed:.3} m/s on average, {:.2} m from where it began.",
        state.q.place.x.hypot(state.q.place.y)
    );
    println!(
        "Work of the rider {work:.6} J, energy gained {gained:.6} J; the wheels slip sideways by {slip:.0e} m/s at most."
    );
    assert!(speed.abs() > 0.3 && (work - gained).abs() < 1e-7 * gained.abs().max(1.0) && slip < 1e-9);

    let gait = |size, phase| speeds.iter().map(|(t, _)| (*t, wave(size, phase, *t)[0])).collect();
    draw(
        "target/snakeboard.svg",
        &[
            Chart {
                title: "The middle of the board, from above",
                axes: ["[m]", "[m]"],
                curves: vec![Curve { name: "board", colour: BLUE, points: track, is_dotted: false }],
                band: None,
                limits: None,
                is_map: true,
            },
            Chart {
                title: "Speed along the board, and the gait",
                axes: ["t [s]", "[m/s], [rad]"],
                curves: vec![
                    Curve { name: "swing", colour: GREY, points: gait(0.7, 0.0), is_dotted: false },
                    Curve { name: "steer", colour: RED, points: gait(0.4, 0.3), is_dotted: false },
                    Curve { name: "speed", colour: BLUE, points: speeds.clone(), is_dotted: false },
                ],
                band: None,
                limits: None,
                is_map: false,
            },
        ],
    )
}
