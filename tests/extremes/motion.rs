//! Motions at the edges: masses far apart, chaos, fast tops, poles and gimbal lock, against exact or 25-digit solutions.
//! Errors are largest differences over one plus the largest entry.

use multibody::integrators::{Action, Event, Events};
use multibody::nalgebra::{Quaternion, Rotation3, SVector, UnitQuaternion, Vector3};
use multibody::{Dop853, DormandPrince, IntegrationError, Integrator, Method, Rk4, RollPitchYaw, System};
use multibody_tests::models::extremes::{gimballed, turning};
use multibody_tests::models::motion::{chain, pendulum_on_ball, top, two_masses};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
use serde_json::Value;

/// From point to point with steps chosen by error; gives the evaluations.
fn follow<S>(system: &S, start: S::State, points: &[Value], mut check: impl FnMut(&Value, &S::State)) -> u32
where
    S: System<Scalar = f64, Input = ()>,
{
    let integrator = Integrator::adaptive(Dop853, 1e-14, 1e-14).compensated();
    let (mut state, mut t, mut evaluations) = (start, 0.0, 0);
    for point in points {
        let end = number(&point["t"]);
        if end > t {
            let (next, statistics) = integrator.integrate(system, t, end, &state, &(), |_, _| ()).unwrap();
            (state, evaluations) = (next, evaluations + statistics.evaluations);
        }
        t = end;
        check(point, &state);
    }
    evaluations
}

/// Error of absolute angles and rates.
fn planar(point: &Value, q: &[f64], v: &[f64]) -> f64 {
    let absolute = |relative: &[f64]| {
        let mut sum = 0.0;
        let sums = relative.iter().map(|angle| {
            sum += angle;
            sum
        });
        sums.collect::<Vec<f64>>()
    };
    let angles = mixed(&absolute(q), &flat(&point["theta"]));
    worse(angles, mixed(&absolute(v), &flat(&point["omega"])))
}

fn two(x: &two_masses::State) -> ([f64; 2], [f64; 2]) {
    ([x.q.shoulder, x.q.elbow], [x.v.shoulder, x.v.elbow])
}

fn leaning(angles: [f64; 2]) -> two_masses::State {
    let q = two_masses::Position { shoulder: angles[0], elbow: angles[1] - angles[0] };
    two_masses::State { q, ..Default::default() }
}

#[test]
fn tips_lighter_and_heavier() {
    let file = read("motion/massratio_double_pendulum");
    let mut errors = Vec::new();
    for name in ["light_tip_1e6", "light_tip_1e9", "light_tip_1e12", "heavy_tip_1e2"] {
        let data = &file["data"][name];
        let [m1, m2] = array(&data["masses"]);
        let model = two_masses::Model::new(&two_masses::Params { m1, m2, ..Default::default() });
        let mut most = 0.0;
        let evaluations = follow(&model, leaning([1.0, 0.5]), list(&data["points"]), |point, x| {
            let (q, v) = two(x);
            most = worse(most, planar(point, &q, &v));
        });
        println!("{name}: {most:.1e} with {evaluations} evaluations");
        assert!(most <= 1e-11, "{name}: {most:e}");
        // Each evaluation rounds, and heavy tips take eight times as many.
        errors.push(most.max(f64::EPSILON) / f64::from(evaluations));
    }
    let (least, most) =
        (errors.iter().fold(f64::MAX, |a, &b| a.min(b)), errors.iter().fold(0.0, |a: f64, &b| a.max(b)));
    println!("mass ratios: errors of one evaluation are within {:.1} times of each other", most / least);
    assert!(most <= 10.0 * least, "{errors:?}");
}

/// The pull of a tip a million times heavier turns the light mass fast.
#[test]
fn tip_a_million_times_heavier() {
    let model = two_masses::Model::new(&two_masses::Params { m1: 1.0, m2: 1e6, ..Default::default() });
    let start = leaning([1.0, 0.5]);
    let energy = |x: &two_masses::State| model.kinetic_energy(x) + model.potential_energy(&x.q);
    let first = energy(&start);
    // Above the lowest point, which is what the motion has to share.
    let scale = first - energy(&leaning([0.0, 0.0]));
    let mut most = 0.0;
    let (_, statistics) = Integrator::adaptive(Dop853, 1e-13, 1e-13)
        .integrate(&model, 0.0, 1.0, &start, &(), |_, x| most = worse(most, ((energy(x) - first) / scale).abs()))
        .unwrap();
    println!("heavy tip 1e6: energy {most:.1e} relative over 1 s, {} evaluations", statistics.evaluations);
    assert!(most <= 1e-8);
}

#[test]
fn chaos() {
    let file = read("motion/double_pendulum");
    let points = list(&file["points"]);
    let model = two_masses::Model::new(&two_masses::Params::default());
    let (mut at_five, mut at_ten) = (0.0, 0.0);
    let evaluations = follow(&model, leaning(array(&points[0]["theta"])), points, |point, x| {
        let (q, v) = two(x);
        let error = planar(point, &q, &v);
        let t = number(&point["t"]);
        if t <= 5.0 {
            at_five = worse(at_five, error);
        }
        at_ten = worse(at_ten, error);
    });
    println!("chaotic double pendulum: {at_five:.1e} to 5 s, {at_ten:.1e} to 10 s, {evaluations} evaluations");
    assert!(at_five <= 2e-10 && at_ten <= 1e-4);
}

#[test]
fn ten_rods() {
    let file = read("motion/chain10_rod");
    let model = chain::Model::new(&chain::Params::default());
    let mut start = chain::State::default();
    start.q.hinge1 = 1.5;
    let mut most = 0.0;
    let evaluations = follow(&model, start, list(&file["points"]), |point, x| {
        let (q, v): (SVector<f64, 10>, SVector<f64, 10>) = (x.q.into(), x.v.into());
        most = worse(most, planar(point, q.as_slice(), v.as_slice()));
    });
    println!("chain of ten rods: {most:.1e} at 1 s with {evaluations} evaluations");
    assert!(most <= 1e-12);
}

/// The quaternion w, i, j, k of a point.
fn orientation(value: &Value) -> UnitQuaternion<f64> {
    let [w, i, j, k] = array(value);
    UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k))
}

fn matrix(q: &UnitQuaternion<f64>) -> Rotation3<f64> {
    q.to_rotation_matrix()
}

/// Of the rotation matrix (a quaternion and its negative are one rotation), and of the angular velocity.
fn turned(q: &UnitQuaternion<f64>, omega: &Vector3<f64>, want: &UnitQuaternion<f64>, rates: &[f64]) -> f64 {
    let rotation = mixed(matrix(q).matrix().as_slice(), matrix(want).matrix().as_slice());
    worse(rotation, mixed(omega.as_slice(), rates))
}

fn spinning_top(name: &str) -> f64 {
    let file = read(name);
    let model = top::Model::new(&top::Params::default());
    let start = top::State {
        q: top::Position { point: orientation(&file["initial"]["q"]) },
        v: top::Velocity { point: array::<3>(&file["initial"]["omega_body"]).into() },
    };
    let mut most = 0.0;
    let evaluations = follow(&model, start, list(&file["points"]), |point, x| {
        most = worse(most, turned(&x.q.point, &x.v.point, &orientation(&point["q"]), &flat(&point["omega"])));
    });
    println!("{name}: {most:.1e} with {evaluations} evaluations");
    most
}

#[test]
fn tops() {
    assert!(spinning_top("motion/top_steady") <= 1e-11);
    assert!(spinning_top("motion/top_nutation") <= 1e-10);
}

#[test]
fn spherical_pendulum_past_its_pole() {
    let file = read("motion/spherical_pendulum_nearpole");
    let (r, v): (Vector3<f64>, Vector3<f64>) =
        (array::<3>(&file["initial"]["r"]).into(), array::<3>(&file["initial"]["v"]).into());
    let model = pendulum_on_ball::Model::new(&pendulum_on_ball::Params::default());
    let support = UnitQuaternion::rotation_between(&-Vector3::z(), &r).unwrap();
    let start = pendulum_on_ball::State {
        q: pendulum_on_ball::Position { support },
        v: pendulum_on_ball::Velocity { support: support.inverse() * r.cross(&v) },
    };
    let mut most = 0.0;
    let evaluations = follow(&model, start, list(&file["points"]), |point, x| {
        let output = model.outputs(0.0, x, &());
        let error = mixed(output.tip.as_slice(), &flat(&point["r"]));
        most = worse(most, worse(error, mixed(output.velocity.as_slice(), &flat(&point["v"]))));
    });
    println!("spherical pendulum past its pole: {most:.1e} with {evaluations} evaluations");
    assert!(most <= 1e-11);
}

/// A symmetric body without torque, exactly: it turns about its angular momentum, and spins about its own axis. At t = 0
/// its pitch is a right angle less `miss`, and grows no further.
struct Free {
    there: UnitQuaternion<f64>,
    omega: Vector3<f64>,
    a: f64,
    c: f64,
}

impl Free {
    fn new(miss: f64) -> Self {
        let there = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2 - miss);
        // The body's own y is the axis of the pitch here: its rate changes sign if the body turns about x and z alone,
        // and passes through if it turns about y.
        Self { there, omega: Vector3::new(0.7, if miss == 0.0 { 1.3 } else { 0.0 }, 0.4), a: 1.0, c: 1.6 }
    }

    fn at(&self, t: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let momentum = self.there * self.omega.component_mul(&Vector3::new(self.a, self.a, self.c));
        let spin = (1.0 - self.c / self.a) * self.omega.z * t;
        let turn = |axis: Vector3<f64>| UnitQuaternion::from_scaled_axis(axis);
        let q = turn(momentum * (t / self.a)) * self.there * turn(Vector3::z() * spin);
        (q, turn(Vector3::z() * -spin) * self.omega)
    }
}

/// How near a motion by roll, pitch and yaw comes to the lock: at the ends of steps, and where the pitch turns round or the
/// lock is crossed.
struct Lock<'a> {
    model: &'a gimballed::Model,
    nearest: f64,
}

impl Lock<'_> {
    fn see(&mut self, x: &gimballed::State) {
        assert!(x.q.centre.roll.is_finite() && x.v.centre.yaw.is_finite());
        self.nearest = self.nearest.min(self.model.dead_centres(0.0, &x.q)[0].abs());
    }
}

impl Events<gimballed::Model, 2> for Lock<'_> {
    fn values(&self, _t: f64, x: &gimballed::State) -> [f64; 2] {
        [self.model.dead_centres(0.0, &x.q)[0], x.v.centre.pitch]
    }
    fn happened(&mut self, _event: &Event, x: &gimballed::State) -> Action<gimballed::State> {
        self.see(x);
        Action::Continue
    }
}

/// A motion past the lock by roll, pitch and yaw: the error of the orientation at its end, or why it has none; and how near
/// to the lock it was told to be.
fn past_the_lock<M: Method<gimballed::Model>>(
    integrator: Integrator<M>,
    exact: &Free,
) -> (Result<f64, IntegrationError>, f64) {
    let model = gimballed::Model::default();
    let ((q, omega), (end, _)) = (exact.at(-1.0), exact.at(1.0));
    let start = gimballed_state(&model, &q, &omega);
    let (mut lock, mut steps) = (Lock { model: &model, nearest: 1.0 }, Lock { model: &model, nearest: 1.0 });
    let run = integrator.with_events(&model, -1.0, 1.0, &start, &(), &mut lock, |interval| steps.see(interval.last()));
    let error = run.map(|(x, ..)| {
        let pose = model.outputs(0.0, &x, &()).pose.orientation;
        mixed(matrix(&pose).matrix().as_slice(), matrix(&end).matrix().as_slice())
    });
    (error, lock.nearest.min(steps.nearest))
}

#[test]
fn gimbal_lock() {
    assert_eq!(gimballed::DEAD_CENTRES, ["centre.pitch"]);
    for miss in [0.0, 1e-9, 1e-6, 1e-3, 1e-2, 0.1] {
        let exact = Free::new(miss);
        let ((q, omega), (end, rates)) = (exact.at(-1.0), exact.at(1.0));

        let model = turning::Model::default();
        let mut start = turning::State::default();
        (start.q.centre, start.v.centre) = (q, omega);
        let precise = Integrator::adaptive(Dop853, 1e-14, 1e-14);
        let (x, _) = precise.integrate(&model, -1.0, 1.0, &start, &(), |_, _| ()).unwrap();
        let error = turned(&x.q.centre, &x.v.centre, &end, rates.as_slice());
        println!("gimbal lock missed by {miss:.0e}: quaternion {error:.1e}");
        assert!(error <= 1e-11);

        // By roll, pitch and yaw, with the distance from the lock that is reported: right to the tolerance and a thousand
        // roundings over that distance, or a typed error. Long steps are right where they stay away from it; near it the
        // states within a step are noise, and the crossings in them have no end.
        let chosen = past_the_lock(Integrator::adaptive(DormandPrince, 1e-10, 1e-10), &exact);
        let leaping = past_the_lock(Integrator::fixed(Rk4, 0.01), &exact);
        let bound = 1e-8 + 1e3 * f64::EPSILON / chosen.1;
        let rough = if leaping.1 >= 0.05 { 1e-4 } else { f64::INFINITY };
        for (name, (error, nearest), bound) in [("steps by error", chosen, bound), ("steps of 0.01 s", leaping, rough)]
        {
            println!("  roll-pitch-yaw, {name}: {error:?} of {bound:.1e}, nearest {nearest:.1e}");
            assert!(nearest <= 1.5 * miss.max(1e-3), "the lock went unseen");
            match error {
                Ok(error) => assert!(error <= bound, "{error:e} without a word"),
                Err(error) => assert!(!matches!(error, IntegrationError::InvalidArgument { .. })),
            }
        }
    }
    let mut locked = gimballed::State::default();
    locked.q.centre.pitch = std::f64::consts::FRAC_PI_2;
    locked.v.centre = RollPitchYaw { roll: 0.3, pitch: 0.2, yaw: 0.1 };
    let model = gimballed::Model::default();
    assert!(model.dead_centres(0.0, &locked.q)[0].abs() < 1e-16);
}

/// Angles and rates of an orientation that turns with a velocity in its own axes.
fn gimballed_state(model: &gimballed::Model, q: &UnitQuaternion<f64>, omega: &Vector3<f64>) -> gimballed::State {
    let (roll, pitch, yaw) = q.euler_angles();
    let mut state = gimballed::State::default();
    state.q.centre = RollPitchYaw { roll, pitch, yaw };
    // omega = (roll' - yaw' sin p, pitch' cos r + yaw' sin r cos p, -pitch' sin r + yaw' cos r cos p)
    let yaw_rate = (omega.y * roll.sin() + omega.z * roll.cos()) / pitch.cos();
    let pitch_rate = omega.y * roll.cos() - omega.z * roll.sin();
    state.v.centre = RollPitchYaw { roll: omega.x + yaw_rate * pitch.sin(), pitch: pitch_rate, yaw: yaw_rate };
    let seen = model.outputs(0.0, &state, &()).spin;
    assert!((q.inverse() * seen - omega).norm() < 1e-9 || (seen - omega).norm() < 1e-9);
    state
}
