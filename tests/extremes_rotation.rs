//! Extremes of rotation, by generated code: a body that flips for 20 s, one that spins at 1000 rad/s, and the length of
//! quaternions over very many steps. Against solutions of 30 digits (`data/motion`).

use multibody::integrators::{Action, Event, Events, Samples};
use multibody::nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};
use multibody::{Dop853, DormandPrince, Integrator, Method, Pose, Rk4, Twist};
use multibody_tests::models::motion::free_body::{Model, Params, Position, State, Velocity};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
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
    println!("greatest error at 40 points to 20 s, greatest error of the times of three flips in s:");
    let mut table = Vec::new();
    for step in [0.02, 0.01, 0.005, 0.0025, 1e-3, 5e-4] {
        let fixed = Integrator::fixed(Dop853, step);
        let row = [
            worst(&file, fixed, error),
            worst(&file, fixed.compensated(), error),
            flip_error(&file, fixed),
            flip_error(&file, fixed.compensated()),
        ];
        println!("{step}: {row:?}");
        table.push(row);
    }
}

#[test]
fn a_thousand_radians_per_second() {
    let file = read("motion/rigid_fastspin");
    for step in [1e-3, 5e-4, 2.5e-4, 1e-4, 5e-5] {
        let fixed = Integrator::fixed(Dop853, step);
        println!(
            "{step}: {:.1e} {:.1e} rad, {:.1e} {:.1e}",
            worst(&file, fixed, angle),
            worst(&file, fixed.compensated(), angle),
            worst(&file, fixed, error),
            worst(&file, fixed.compensated(), error)
        );
    }
}
