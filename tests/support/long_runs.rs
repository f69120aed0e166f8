//! Long motions, for tests in short and for `benches/long_runs.rs` in full.

use super::energy::{Drift, drift};
use crate::models::energy::{double_swing, swing};
use multibody::{Integrator, Method, Real};

/// A pendulum of one metre at 9.81 m/s^2, let go at one radian; its energy above rest, over that at the start.
pub fn pendulum<T: Real + Into<f64>, M: Method<swing::Model<T>>>(
    integrator: Integrator<M>,
    dt: f64,
    steps: u32,
) -> Drift {
    let model = swing::Model::new(&swing::Params::default());
    let mut start = swing::State::default();
    start.q.hinge = T::lit(1.0);
    // Of the state's own numbers in double precision, with 1 - cos as a sine: no digit is lost.
    let above = |x: &swing::State<T>| {
        let (q, v): (f64, f64) = (x.q.hinge.into(), x.v.hinge.into());
        0.5 * v * v + 2.0 * 9.81 * (0.5 * q).sin().powi(2)
    };
    let whole = above(&start);
    drift(&integrator, &model, &start, (dt, steps), |x| above(x) / whole - 1.0)
}

/// Two pendulums in a row from rest at absolute angles `[rad]`, steps of 1e-2 s; energy above rest, over that at the start.
pub fn double_pendulum<M: Method<double_swing::Model>>(integrator: M, angles: [f64; 2], steps: u32) -> Drift {
    let model = double_swing::Model::new(&double_swing::Params::default());
    let mut start = double_swing::State::default();
    start.q.shoulder = angles[0];
    start.q.elbow = angles[1] - angles[0];
    let above = |x: &double_swing::State| model.kinetic_energy(x) + model.potential_energy(&x.q) + 3.0 * 9.81;
    let whole = above(&start);
    drift(&Integrator::fixed(integrator, 1e-2), &model, &start, (1e-2, steps), |x| above(x) / whole - 1.0)
}

/// The names and starts `[rad]` of double pendulums, regular ones first.
pub const DOUBLE_STARTS: [(&str, [f64; 2]); 3] = [
    ("regular, 0.3 and 0.2 rad", [0.3, 0.2]),
    ("regular, 1.0 and 0.5 rad", [1.0, 0.5]),
    ("chaotic, 2.0 and 1.0 rad", [2.0, 1.0]),
];
