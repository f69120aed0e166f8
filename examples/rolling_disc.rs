//! A thin disc that rolls: on its circle, and beside it.
//!
//! `cargo run --release --example rolling_disc`
//!
//! With lean p, rate W of its heading and whole spin w, a disc runs on a circle where
//! `(C + m r^2) w W cos p - A W^2 sin p cos p + m g r sin p = 0` (Routh 1905, article 241). Faster or slower it nods about such a
//! motion; energy is kept. Tracks and lean go into `target/rolling_disc.svg`.

use multibody::nalgebra::{Unit, UnitQuaternion, Vector3};
use multibody::{Dop853, Integrator, Projection, WithProjection};

mod charts;
#[path = "models/rolling_disc.rs"]
mod model;

use charts::{BLUE, Chart, Curve, GREY, RED, draw};
use model::disc::{Model, Params, State};

/// [m/s^2]
const G: f64 = 9.81;

/// On its circle: leaning by `lean`, its heading turning at `turning`; as much is added to the spin.
fn circling(params: &Params, lean: f64, turning: f64, added: f64) -> State {
    let (m, r) = (params.mass, params.radius);
    let (across, along) = (0.25 * m * r * r, 0.5 * m * r * r);
    let (sin, cos) = lean.sin_cos();
    let spin =
        (across * turning * turning * sin * cos - m * G * r * sin) / ((along + m * r * r) * turning * cos) + added;
    // The heading turns downwards, as does the lean about x: so the disc leans to the inside.
    let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), angle);
    let mut state = State::default();
    state.q.float.orientation = about(Vector3::x(), lean);
    let axle = state.q.float.orientation * Vector3::y();
    let vertical = -turning * Vector3::z();
    let omega = vertical + axle * (-spin - vertical.dot(&axle));
    let low = (axle * axle.z - Vector3::z()) * (r / (1.0 - axle.z * axle.z).sqrt());
    state.q.float.position = Vector3::z() * -low.z;
    state.v.float.linear = low.cross(&omega);
    state.v.float.angular = state.q.float.orientation.inverse() * omega;
    state
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let params = Params::default();
    let model = Model::new(&params);
    let system = WithProjection::new(model, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-12, 1e-12);
    let mut curves = Vec::new();
    let mut nods = Vec::new();
    for (name, added, colour) in [("steady", 0.0, GREY), ("faster by 2 %", -0.17, BLUE), ("slower by 10 %", 0.83, RED)]
    {
        let mut state = circling(&params, 0.6, 2.1, added);
        let energy = model.outputs(0.0, &state, &()).energy;
        let (mut track, mut leans, mut worst) = (Vec::new(), Vec::new(), 0.0_f64);
        for k in 0..600 {
            let t = 0.01 * f64::from(k);
            let out = model.outputs(t, &state, &());
            track.push((out.contact.x, out.contact.y));
            leans.push((t, out.axle.z.asin().to_degrees()));
            worst = worst.max((out.energy / energy - 1.0).abs());
            (state, _) = integrator.integrate(&system, t, t + 0.01, &state, &(), |_, _| ())?;
        }
        let (low, high) = leans.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.1), high.max(p.1)));
        println!("{name:<15} leans {low:.6} to {high:.6} degrees; energy kept to {worst:.0e}");
        assert!(worst < 1e-11 && (added != 0.0 || (high - low) < 1e-8));
        curves.push(Curve { name, colour, points: track, is_dotted: false });
        nods.push(Curve { name, colour, points: leans, is_dotted: false });
    }
    let tracks = Chart {
        title: "Where the disc touches, from above",
        axes: ["[m]", "[m]"],
        curves,
        band: None,
        limits: None,
        is_map: true,
    };
    let nods = Chart {
        title: "Lean from upright",
        axes: ["t [s]", "[degrees]"],
        curves: nods,
        band: None,
        limits: None,
        is_map: false,
    };
    draw("target/rolling_disc.svg", &[tracks, nods])
}
