//! Extremes of rotation, by generated code: a body that flips for 20 s, one that spins at 1000 rad/s, and the length of
//! quaternions over very many steps. Against solutions of 30 digits (`data/motion`).

use multibody::integrators::{Action, Event, Events, Samples};
use multibody::nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};
use multibody::{Dop853, DormandPrince, Integrator, Method, Pose, Rk4, Twist};
use multibody_tests::models::motion::free_body::{Model, Params, Position, State, Velocity};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
use multibody_tests::support::length::length_gap;
use serde_json::Value;

/// The body of a file at its start.
fn start(file: &Value) -> (Model, State) {
    let model = Model::new(&Params { i: array(&file["inertia"]), ..Params::default() });
    let angular = array::<3>(&file["omega0_body"]).into();
    let q = Position { free: Pose::default() };
    (model, State { q, v: Velocity { free: Twist { linear: Vector3::zeros(), angular } } })
}

/// Of the rotation matrix (a quaternion and its negative are one rotation), and of the angular velocity, each relative to
/// one and the greatest entry.
fn error(point: &Value, x: &State) -> f64 {
    let matrix = |q: &UnitQuaternion<f64>| -> Rotation3<f64> { q.to_rotation_matrix() };
    let [w, i, j, k] = array(&point["q"]);
    let exact = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
    let rotation = mixed(matrix(&x.q.free.orientation).matrix().as_slice(), matrix(&exact).matrix().as_slice());
    worse(rotation, mixed(x.v.free.angular.as_slice(), &flat(&point["omega"])))
}

/// The angle between the orientation and that of the point, in rad.
fn angle(point: &Value, x: &State) -> f64 {
    let exact = array::<4>(&point["q"]);
    let q = x.q.free.orientation.as_ref().coords;
    let gap = |sign: f64| {
        let [w, i, j, k] = exact.map(|entry| sign * entry);
        (q.w - w).hypot(q.x - i).hypot((q.y - j).hypot(q.z - k))
    };
    2.0 * f64::min(gap(1.0), gap(-1.0))
}

/// The greatest of what `measure` gives over all points of the file, by steps that meet them.
fn worst<M: Method<Model>>(file: &Value, integrator: Integrator<M>, measure: impl Fn(&Value, &State) -> f64) -> f64 {
    let (model, start) = start(file);
    let points = list(&file["points"]);
    let end = number(&points[points.len() - 1]["t"]);
    let (mut most, mut next) = (0.0, 1);
    let mut times = Samples::new(points.iter().map(|point| number(&point["t"])).collect::<Vec<_>>());
    times.first(0.0, &start, |_, _| ());
    integrator
        .intervals(&model, 0.0, end, &start, &(), |interval| {
            times.within(interval, |_, x| {
                most = worse(most, measure(&points[next], x));
                next += 1;
            });
        })
        .unwrap();
    assert_eq!(next, points.len());
    most
}

/// Flips: the spin about the middle axis turns over.
struct Flips(Vec<f64>);

impl Events<Model, 1> for Flips {
    fn values(&self, _t: f64, x: &State) -> [f64; 1] {
        [x.v.free.angular.y]
    }
    fn happened(&mut self, event: &Event, _x: &State) -> Action<State> {
        self.0.push(event.time);
        Action::Continue
    }
}

/// The greatest error of the times of the flips, in s.
fn flip_error<M: Method<Model>>(file: &Value, integrator: Integrator<M>) -> f64 {
    let (model, start) = start(file);
    let mut seen = Flips(Vec::new());
    integrator.with_events(&model, 0.0, 20.0, &start, &(), &mut seen, |_| ()).unwrap();
    let expected = flat(&read("motion/rigid_dzhanibekov_flips")["flips"]);
    assert_eq!(seen.0.len(), expected.len());
    seen.0.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, worse)
}

#[test]
fn flipping_wing_nut() {
    let file = read("motion/rigid_dzhanibekov");
    println!("greatest error at 40 points to 20 s, and of the times of three flips in s");
    let measured = |name: &str, integrator: Integrator<Dop853>| {
        let (states, flips) = (worst(&file, integrator, error), flip_error(&file, integrator));
        println!("{name}: {states:.1e}, {flips:.1e} s");
        (states, flips)
    };
    // The motion multiplies errors by up to 1e9: what is left of rounding varies with the step.
    let plain = measured("plain, steps of 5e-3", Integrator::fixed(Dop853, 5e-3));
    assert!(plain.0 <= 2e-7 && plain.1 <= 2e-8);
    let compensated = measured("compensated, steps of 5e-4", Integrator::fixed(Dop853, 5e-4).compensated());
    assert!(compensated.0 <= 1e-9 && compensated.1 <= 1e-9);
    let fifth = worst(&file, Integrator::fixed(DormandPrince, 1e-3).compensated(), error);
    println!("DormandPrince, compensated, steps of 1e-3: {fifth:.1e}");
    assert!(fifth <= 1e-9);
}

#[test]
fn a_thousand_radians_per_second() {
    let file = read("motion/rigid_fastspin");
    let plain = worst(&file, Integrator::fixed(Dop853, 5e-4), angle);
    let compensated = worst(&file, Integrator::fixed(Dop853, 2.5e-4).compensated(), angle);
    println!(
        "1 s at 1000 rad/s: {plain:.1e} rad in steps of 5e-4 (half a radian), {compensated:.1e} rad in half of them"
    );
    assert!(plain <= 1e-10 && compensated <= 1e-12);
    let velocity = worst(&file, Integrator::fixed(Dop853, 2.5e-4).compensated(), error);
    assert!(velocity <= 1e-12, "{velocity:e}");
}

/// Half a million steps of a tumbling body (ten million in `benches/rotation_length.rs`).
#[test]
fn quaternions_stay_unit() {
    fn gap<M: Method<Model>>(integrator: Integrator<M>) -> f64 {
        let model = Model::new(&Params::default());
        let angular = Vector3::new(1.0, 5.0, -3.0);
        let v = Velocity { free: Twist { linear: Vector3::zeros(), angular } };
        let start = State { q: Position { free: Pose::default() }, v };
        let mut most = 0.0;
        let look = |_: f64, x: &State| most = f64::max(most, length_gap(&x.q.free.orientation));
        integrator.integrate(&model, 0.0, 500.0, &start, &(), look).unwrap();
        most
    }
    let gaps = [gap(Integrator::fixed(Rk4, 1e-3)), gap(Integrator::fixed(Rk4, 1e-3).compensated())];
    println!("length of a quaternion over 500,000 steps: within {gaps:?}");
    assert!(gaps.iter().all(|gap| *gap <= 4e-16));
}
