//! Motions of emitted models against exact or 25-digit solutions (`data/motion`), by Dormand and Prince's fifth-order
//! method with fixed steps.

use multibody::nalgebra::{Quaternion, Rotation3, SVector, UnitQuaternion, Vector3};
use multibody::{DormandPrince, Pose, System, Twist, Universal};
use multibody_tests::models::motion::{chain, free_body, pendulum_on_ball, pendulum_on_universal, top, two_masses};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
use serde_json::Value;

/// Rounding of `f64`, relative to one.
const ROUNDING: f64 = 1.1e-16;

/// Steps of at most `dt` from point to point; `check` gets every point with the state there, the first one included.
fn follow<S>(system: &S, start: S::State, points: &[Value], dt: f64, mut check: impl FnMut(&Value, &S::State))
where
    S: System<Scalar = f64, Input = ()>,
{
    let (mut state, mut t) = (start, 0.0);
    for point in points {
        let end = number(&point["t"]);
        let steps = ((end - t) / dt).ceil();
        if steps > 0.0 {
            let dt = (end - t) / steps;
            state = DormandPrince::integrate(system, t, &state, &(), dt, steps as u32, |_, _| ()).unwrap();
        }
        t = end;
        check(point, &state);
    }
}

/// The sum of relative angles up to each joint.
fn absolute(relative: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    relative
        .iter()
        .map(|angle| {
            sum += angle;
            sum
        })
        .collect()
}

/// Error of absolute angles and rates.
fn planar(point: &Value, q: &[f64], v: &[f64]) -> f64 {
    let angles = mixed(&absolute(q), &flat(&point["theta"]));
    worse(angles, mixed(&absolute(v), &flat(&point["omega"])))
}

fn double(params: &two_masses::Params, angles: [f64; 2], points: &[Value], dt: f64, bound: impl Fn(&Value) -> f64) {
    let model = two_masses::Model::new(params);
    let q = two_masses::Position { shoulder: angles[0], elbow: angles[1] - angles[0] };
    let start = two_masses::State { q, ..Default::default() };
    let mut most = 0.0;
    follow(&model, start, points, dt, |point, x| {
        let error = planar(point, &[x.q.shoulder, x.q.elbow], &[x.v.shoulder, x.v.elbow]);
        let bound = bound(point);
        most = worse(most, error / bound);
        assert!(error <= bound, "t = {}: error {error:e}, allowed {bound:e}", point["t"]);
    });
    println!("double pendulum: at most {most:.2} of what is allowed");
}

fn from_rest(name: &str, dt: f64) {
    let file = read(name);
    let points = list(&file["points"]);
    let start = array(&points[0]["theta"]);
    double(&two_masses::Params::default(), start, points, dt, |point| {
        1e3 * point.get("amplification").map_or(1.0, number) * ROUNDING
    });
}

#[test]
fn chaotic_double_pendulum() {
    from_rest("motion/double_pendulum", 2e-4);
}

#[test]
fn mild_double_pendulum() {
    from_rest("motion/double_pendulum_mild", 5e-4);
}

#[test]
fn mass_ratios() {
    let file = read("motion/massratio_double_pendulum");
    for name in ["light_tip_1e6", "light_tip_1e9", "light_tip_1e12", "heavy_tip_1e2"] {
        let data = &file["data"][name];
        let [m1, m2] = array(&data["masses"]);
        let params = two_masses::Params { m1, m2, ..Default::default() };
        double(&params, [1.0, 0.5], list(&data["points"]), 5e-5, |_| 1e-11);
    }
}

#[test]
fn chain_of_ten_rods() {
    let file = read("motion/chain10_rod");
    let points = list(&file["points"]);
    let model = chain::Model::new(&chain::Params::default());
    let mut start = chain::State::default();
    start.q.hinge1 = 1.5;
    let mut most = 0.0;
    follow(&model, start, points, 5e-4, |point, x| {
        let (q, v): (SVector<f64, 10>, SVector<f64, 10>) = (x.q.into(), x.v.into());
        most = worse(most, planar(point, q.as_slice(), v.as_slice()));
    });
    println!("chain: {most:e}");
    assert!(most <= 1e-11, "error {most:e}");
}

/// Place and velocity at the start.
fn spherical() -> (Value, Vector3<f64>, Vector3<f64>) {
    let file = read("motion/spherical_pendulum");
    let (r, v) = (array::<3>(&file["initial"]["r"]), array::<3>(&file["initial"]["v"]));
    (file, r.into(), v.into())
}

fn tip_error(point: &Value, tip: &Vector3<f64>, velocity: &Vector3<f64>) -> f64 {
    worse(mixed(tip.as_slice(), &flat(&point["r"])), mixed(velocity.as_slice(), &flat(&point["v"])))
}

#[test]
fn spherical_pendulum_on_a_ball() {
    let (file, r, v) = spherical();
    let model = pendulum_on_ball::Model::new(&pendulum_on_ball::Params::default());
    let support = UnitQuaternion::rotation_between(&-Vector3::z(), &r).unwrap();
    let start = pendulum_on_ball::State {
        q: pendulum_on_ball::Position { support },
        v: pendulum_on_ball::Velocity { support: support.inverse() * r.cross(&v) },
    };
    let mut most = 0.0;
    follow(&model, start, list(&file["points"]), 1e-3, |point, x| {
        let output = model.outputs(0.0, x, &());
        most = worse(most, tip_error(point, &output.tip, &output.velocity));
        assert!((x.q.support.as_ref().norm() - 1.0).abs() <= 1e-15);
    });
    println!("pendulum on a ball: {most:e}");
    assert!(most <= 1e-11, "error {most:e}");
}

#[test]
fn spherical_pendulum_on_a_universal() {
    let (file, r, v) = spherical();
    let model = pendulum_on_universal::Model::new(&pendulum_on_universal::Params::default());
    // r = (-sin b, sin a cos b, -cos a cos b)
    let (a, b) = (r.y.atan2(-r.z), -r.x.asin());
    let second = -v.x / b.cos();
    let first = (v.y * a.cos() + v.z * a.sin()) / b.cos();
    let start = pendulum_on_universal::State {
        q: pendulum_on_universal::Position { support: Universal { first: a, second: b } },
        v: pendulum_on_universal::Velocity { support: Universal { first, second } },
    };
    let mut most = 0.0;
    follow(&model, start, list(&file["points"]), 2.5e-4, |point, x| {
        let output = model.outputs(0.0, x, &());
        most = worse(most, tip_error(point, &output.tip, &output.velocity));
    });
    println!("pendulum on a universal: {most:e}");
    assert!(most <= 1e-11, "error {most:e}");
}

/// The quaternion w, i, j, k of a point.
fn orientation(value: &Value) -> UnitQuaternion<f64> {
    let [w, i, j, k] = array(value);
    UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
}

/// Of the rotation matrix (a quaternion and its negative are one rotation), and of the angular velocity.
fn turning(point: &Value, q: &UnitQuaternion<f64>, omega: &Vector3<f64>) -> f64 {
    let matrix = |q: &UnitQuaternion<f64>| -> Rotation3<f64> { q.to_rotation_matrix() };
    let rotation = mixed(matrix(q).matrix().as_slice(), matrix(&orientation(&point["q"])).matrix().as_slice());
    worse(rotation, mixed(omega.as_slice(), &flat(&point["omega"])))
}

#[test]
fn steady_top() {
    let file = read("motion/top_steady");
    let model = top::Model::new(&top::Params::default());
    let start = top::State {
        q: top::Position { point: orientation(&file["initial"]["q"]) },
        v: top::Velocity { point: array::<3>(&file["initial"]["omega_body"]).into() },
    };
    let mut most = 0.0;
    follow(&model, start, list(&file["points"]), 5e-5, |point, x| {
        most = worse(most, turning(point, &x.q.point, &x.v.point));
        assert!((x.q.point.as_ref().norm() - 1.0).abs() <= 1e-15);
    });
    println!("top: {most:e}");
    assert!(most <= 1e-11, "error {most:e}");
}

#[test]
fn flipping_wing_nut() {
    let file = read("motion/rigid_dzhanibekov");
    let model = free_body::Model::new(&free_body::Params::default());
    let linear = Vector3::new(0.3, -0.2, 0.1);
    let start = free_body::State {
        q: free_body::Position { free: Pose::default() },
        v: free_body::Velocity { free: Twist { linear, angular: array::<3>(&file["omega0_body"]).into() } },
    };
    let mut most = 0.0;
    follow(&model, start, list(&file["points"]), 5e-4, |point, x| {
        most = worse(most, turning(point, &x.q.free.orientation, &x.v.free.angular));
        assert_eq!(x.v.free.linear, linear);
        let path = linear * number(&point["t"]);
        assert!(mixed(x.q.free.position.as_slice(), path.as_slice()) <= 1e-12);
    });
    println!("wing nut: {most:e}");
    assert!(most <= 2e-7, "error {most:e}");
}
