//! The Stewart-Gough manipulator against independent solutions (`data/stewart`): forces in the legs, their kinematics,
//! accelerations and trajectories, in all coordinates that the same model may have.

use multibody::nalgebra::{DMatrix, Matrix3, Rotation3, SVector, UnitQuaternion, Vector3};
use multibody::{DormandPrince, FreeRollPitchYaw, RollPitchYaw, Universal};
use multibody_tests::models::stewart::{
    absolute, assumed_hybrid, assumed_joints, heavy, heavy_hybrid, hybrid, joint_coordinates, level, reduced,
};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, list, number, read};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};

/// x, y, z, roll, pitch, yaw.
fn free(x: [f64; 6]) -> FreeRollPitchYaw {
    FreeRollPitchYaw { position: Vector3::new(x[0], x[1], x[2]), orientation: angles([x[3], x[4], x[5]]) }
}

fn angles([roll, pitch, yaw]: [f64; 3]) -> RollPitchYaw {
    RollPitchYaw { roll, pitch, yaw }
}

fn six(x: &FreeRollPitchYaw) -> [f64; 6] {
    let (p, r) = (x.position, x.orientation);
    [p.x, p.y, p.z, r.roll, r.pitch, r.yaw]
}

/// First angles, second angles and strokes (or rates of them) as the files have them: alpha, beta and s.
fn of_file(data: &Value, k: Option<usize>, suffix: &str, is_position: bool) -> SVector<f64, 18> {
    let column = |name: &str| -> [f64; 6] {
        let values = &data[format!("{name}{suffix}").as_str()];
        array(k.map_or(values, |k| &values[k]))
    };
    let (alpha, beta, s) = (column("alpha"), column("beta"), column("s"));
    let turn = if is_position { FRAC_PI_2 } else { 0.0 };
    let pairs = (0..6).flat_map(|i| [-alpha[i], turn - beta[i]]);
    SVector::from_iterator(pairs.chain(s))
}

/// Angles are the same when they differ by whole turns.
fn unturned(mut got: SVector<f64, 18>, want: &SVector<f64, 18>) -> SVector<f64, 18> {
    for k in 0..12 {
        got[k] -= TAU * ((got[k] - want[k]) / TAU).round();
    }
    got
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, worse)
}

/// Largest difference of the forces in the legs, N, and of angles, strokes, their rates and accelerations.
macro_rules! motion {
    ($model:ident, $file:expr) => {{
        let file = read($file);
        let model = $model::Model::new(&$model::Params::default());
        let (mut of_forces, mut of_legs) = (0.0, [0.0; 3]);
        let times = list(&file["t"]);
        for k in 0..times.len() {
            let mut state = $model::State::default();
            let mut accel = $model::Velocity::default();
            state.q.platform = free(array(&file["q"][k]));
            state.v.platform = free(array(&file["qd"][k]));
            accel.platform = free(array(&file["qdd"][k]));
            let t = number(&times[k]);
            let solved = model.inverse_dynamics(t, &state, &Default::default(), &accel);
            let forces = solved.input.legs.map(|leg| leg.thrust);
            of_forces = worse(of_forces, difference(&forces, &array::<6>(&file["f"][k])));
            assert_eq!(solved.rank, 6.0, "{} at {t}", $file);

            let found = model.kinematics(t, &state, &accel);
            let want = of_file(&file, Some(k), "", true);
            let errors = [
                mixed(unturned(found.position, &want).as_slice(), want.as_slice()),
                mixed(found.velocity.as_slice(), of_file(&file, Some(k), "_d", false).as_slice()),
                mixed(found.acceleration.as_slice(), of_file(&file, Some(k), "_dd", false).as_slice()),
            ];
            of_legs = [0, 1, 2].map(|k| worse(of_legs[k], errors[k]));
        }
        println!("{}: forces {of_forces:e} N, legs {of_legs:?}", $file);
        assert!(times.len() >= 21 && of_forces <= 1e-10, "{}: forces {of_forces:e} N", $file);
        assert!(of_legs.iter().all(|error| *error <= 1e-10), "{}: legs {of_legs:?}", $file);
    }};
}

#[test]
fn forces_and_legs_in_heave() {
    motion!(reduced, "stewart/heave_forces");
}

#[test]
fn forces_and_legs_in_yaw() {
    motion!(reduced, "stewart/yaw_tsai");
}

#[test]
fn forces_and_legs_in_general_motion() {
    motion!(reduced, "stewart/general_motion_tsai");
}

#[test]
fn forces_of_a_platform_kept_level() {
    let file = read("stewart/heave_forces");
    let model = level::Model::new(&level::Params::default());
    let mut most = 0.0;
    for k in 0..list(&file["t"]).len() {
        let [q, v, a] = ["q", "qd", "qdd"].map(|name| free(array(&file[name][k])).position);
        let state = level::State { q: level::Position { platform: q }, v: level::Velocity { platform: v } };
        let solved = model.inverse_dynamics(0.0, &state, &Default::default(), &level::Velocity { platform: a });
        most = worse(most, difference(&solved.input.legs.map(|leg| leg.thrust), &array::<6>(&file["f"][k])));
        assert_eq!(solved.rank, 6.0);
    }
    println!("level: forces {most:e} N");
    assert!(most <= 1e-10, "forces {most:e} N");
}

/// A state of the platform with its legs.
struct Closed {
    q: [f64; 6],
    v: [f64; 6],
    legs: SVector<f64, 18>,
    rates: SVector<f64, 18>,
}

impl Closed {
    fn new(q: [f64; 6], v: [f64; 6]) -> Closed {
        let model = reduced::Model::new(&reduced::Params::default());
        let mut state = reduced::State::default();
        (state.q.platform, state.v.platform) = (free(q), free(v));
        let found = model.kinematics(0.0, &state, &Default::default());
        Closed { q, v, legs: found.position, rates: found.velocity }
    }

    fn gimbal(x: &SVector<f64, 18>, i: usize) -> Universal {
        Universal { first: x[2 * i], second: x[2 * i + 1] }
    }
}

macro_rules! reduced_state {
    ($model:ident, $closed:expr) => {{
        let mut state = $model::State::default();
        (state.q.platform, state.v.platform) = (free($closed.q), free($closed.v));
        state
    }};
}

macro_rules! hybrid_state {
    ($model:ident, $closed:expr) => {{
        let closed = &$closed;
        let mut state = reduced_state!($model, closed);
        for i in 0..6 {
            (state.q.legs[i].gimbal, state.q.legs[i].stroke) = (Closed::gimbal(&closed.legs, i), closed.legs[12 + i]);
            (state.v.legs[i].gimbal, state.v.legs[i].stroke) = (Closed::gimbal(&closed.rates, i), closed.rates[12 + i]);
        }
        state
    }};
}

const FEET: [[f64; 2]; 6] =
    [[-2.12, 1.374], [-2.38, 1.224], [-2.38, -1.224], [-2.12, -1.374], [0.0, -0.15], [0.0, 0.15]];
const HEADING: [f64; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];

/// Rates of roll, pitch and yaw.
fn rates(r: &RollPitchYaw, w: Vector3<f64>) -> RollPitchYaw {
    let yaw = Rotation3::from_axis_angle(&Vector3::z_axis(), r.yaw);
    let pitch = yaw * Rotation3::from_axis_angle(&Vector3::y_axis(), r.pitch);
    let columns = Matrix3::from_columns(&[pitch * Vector3::x(), yaw * Vector3::y(), Vector3::z()]);
    let [roll, pitch, yaw] = (columns.try_inverse().unwrap() * w).into();
    RollPitchYaw { roll, pitch, yaw }
}

/// Cylinder and piston of a leg: poses and velocities.
fn bodies(closed: &Closed, i: usize) -> [[FreeRollPitchYaw; 2]; 2] {
    let (q, v) = (Closed::gimbal(&closed.legs, i), Closed::gimbal(&closed.rates, i));
    let heading = Rotation3::from_axis_angle(&Vector3::z_axis(), HEADING[i]);
    let first = heading * Rotation3::from_axis_angle(&Vector3::x_axis(), q.first);
    let rotation = first * Rotation3::from_axis_angle(&Vector3::y_axis(), q.second);
    let w = heading * Vector3::x() * v.first + first * Vector3::y() * v.second;
    let (roll, pitch, yaw) = rotation.euler_angles();
    let orientation = RollPitchYaw { roll, pitch, yaw };
    let turning = rates(&orientation, w);
    let foot = Vector3::new(FEET[i][0], FEET[i][1], 0.0);
    let axis = rotation * Vector3::z();
    let way = axis * (1.0 + closed.legs[12 + i]);
    let velocity = w.cross(&way) + axis * closed.rates[12 + i];
    let body = |position, velocity| {
        [FreeRollPitchYaw { position, orientation }, FreeRollPitchYaw { position: velocity, orientation: turning }]
    };
    [body(foot, Vector3::zeros()), body(foot + way, velocity)]
}

fn absolute_state(closed: &Closed) -> absolute::State {
    let mut state = reduced_state!(absolute, closed);
    for i in 0..6 {
        let [cylinder, piston] = bodies(closed, i);
        let (q, v) = (&mut state.q.legs[i], &mut state.v.legs[i]);
        [q.cylinder, v.cylinder] = cylinder;
        [q.piston, v.piston] = piston;
    }
    state
}

/// The platform's turning: axes, angular velocity, and angular acceleration for accelerations of roll, pitch and yaw.
fn turning(q: [f64; 6], v: [f64; 6], a: [f64; 6]) -> (Rotation3<f64>, Vector3<f64>, Vector3<f64>) {
    let yaw = Rotation3::from_axis_angle(&Vector3::z_axis(), q[5]);
    let (y, z) = (yaw * Vector3::y(), Vector3::z());
    let x = yaw * (Rotation3::from_axis_angle(&Vector3::y_axis(), q[4]) * Vector3::x());
    let carried = z * v[5] + y * v[4];
    let accel = z * a[5] + y * a[4] + z.cross(&y) * (v[5] * v[4]) + x * a[3] + carried.cross(&x) * v[3];
    (Rotation3::from_euler_angles(q[3], q[4], q[5]), carried + x * v[3], accel)
}

/// The first leg carries the platform.
macro_rules! joint_state {
    ($model:ident, $closed:expr) => {{
        let closed: &Closed = $closed;
        let mut state = $model::State::default();
        for i in 0..6 {
            let (q, v) = (&mut state.q.legs[i], &mut state.v.legs[i]);
            (q.gimbal, q.stroke) = (Closed::gimbal(&closed.legs, i), closed.legs[12 + i]);
            (v.gimbal, v.stroke) = (Closed::gimbal(&closed.rates, i), closed.rates[12 + i]);
        }
        let (q, v) = (Closed::gimbal(&closed.legs, 0), Closed::gimbal(&closed.rates, 0));
        let heading = Rotation3::from_axis_angle(&Vector3::z_axis(), HEADING[0]);
        let first = heading * Rotation3::from_axis_angle(&Vector3::x_axis(), q.first);
        let leg = first * Rotation3::from_axis_angle(&Vector3::y_axis(), q.second);
        let spin = heading * Vector3::x() * v.first + first * Vector3::y() * v.second;
        let (platform, w, _) = turning(closed.q, closed.v, [0.0; 6]);
        state.q.legs[0].ball = UnitQuaternion::from_rotation_matrix(&(leg.inverse() * platform));
        state.v.legs[0].ball = platform.inverse() * (w - spin);
        state
    }};
}

macro_rules! thrusts {
    ($model:ident, $forces:expr) => {{
        let mut input = $model::Input::default();
        input.legs.iter_mut().zip($forces).for_each(|(leg, force)| leg.thrust = force);
        input
    }};
}

macro_rules! springs {
    ($model:ident, $data:expr) => {{
        let mut params = $model::Params::default();
        let s0: [f64; 6] = array(&$data["s0"]);
        for (leg, s0) in params.legs.iter_mut().zip(s0) {
            (leg.k, leg.c, leg.s0) = (number(&$data["k"]), number(&$data["c"]), s0);
        }
        $model::Model::new(&params)
    }};
}

/// The forces that give back the accelerations which forces have given.
macro_rules! returned {
    ($model:ident, $state:expr, $forces:expr, $accel:expr) => {{
        let model = $model::Model::new(&$model::Params::default());
        let solved = model.inverse_dynamics(0.0, &$state, &Default::default(), &$accel);
        let error = difference(&solved.input.legs.map(|leg| leg.thrust), &$forces);
        println!("{}: forces back to {error:e} N", stringify!($model));
        assert!(error <= 1e-10, "{}: forces differ by {error:e} N", stringify!($model));
    }};
}

/// Calls `check` with the start, forces and accelerations of each of the five states of a set of parameters.
fn five_states(set: &str, mut check: impl FnMut(&str, &Value, &Closed, [f64; 6], [f64; 6])) {
    let file = read("stewart/forward");
    let mut count = 0;
    for case in list(&file["cases"]).iter().filter(|case| case["parameter_set"] == set) {
        let closed = Closed::new(array(&case["pose"]), array(&case["vel"]));
        check(case["name"].as_str().unwrap(), case, &closed, array(&case["f"]), array(&case["acc"]));
        count += 1;
    }
    assert_eq!(count, if set == "tsai" { 4 } else { 1 });
}

fn assert_accelerations(what: &str, got: &[f64], want: &[f64]) {
    let error = mixed(got, want);
    println!("{what}: {error:e}");
    assert!(error <= 1e-12, "{what}: error {error:e}");
}

#[test]
fn accelerations_reduced() {
    let model = reduced::Model::new(&reduced::Params::default());
    five_states("tsai", |name, case, closed, forces, want| {
        let state = reduced_state!(reduced, closed);
        let accel = model.forward_dynamics(0.0, &state, &thrusts!(reduced, forces));
        assert_accelerations(name, &six(&accel.platform), &want);
        let legs = model.kinematics(0.0, &state, &accel).acceleration;
        assert_accelerations("legs", legs.as_slice(), of_file(&case["legs"], None, "_dd", false).as_slice());
        let energy = model.outputs(0.0, &state, &Default::default()).energy;
        assert!((energy - number(&case["energy_T_plus_V"])).abs() <= 1e-12, "energy {energy}");
    });
    let model = heavy::Model::new(&heavy::Params::default());
    five_states("heavy", |name, _, closed, forces, want| {
        let accel = model.forward_dynamics(0.0, &reduced_state!(heavy, closed), &thrusts!(heavy, forces));
        assert_accelerations(name, &six(&accel.platform), &want);
        returned!(heavy, reduced_state!(heavy, closed), forces, accel);
    });
}

#[test]
fn accelerations_with_multipliers() {
    let model = hybrid::Model::new(&hybrid::Params::default());
    five_states("tsai", |name, _, closed, forces, want| {
        let rates = model.forward_dynamics(0.0, &hybrid_state!(hybrid, closed), &thrusts!(hybrid, forces));
        assert_accelerations(name, &six(&rates.v.platform), &want);
        assert_eq!(rates.rank, 18.0);
        returned!(hybrid, hybrid_state!(hybrid, closed), forces, rates.v);
    });
    let model = heavy_hybrid::Model::new(&heavy_hybrid::Params::default());
    five_states("heavy", |name, _, closed, forces, want| {
        let rates = model.forward_dynamics(0.0, &hybrid_state!(heavy_hybrid, closed), &thrusts!(heavy_hybrid, forces));
        assert_accelerations(name, &six(&rates.v.platform), &want);
    });
}

#[test]
fn accelerations_in_absolute_coordinates() {
    let model = absolute::Model::new(&absolute::Params::default());
    five_states("tsai", |name, _, closed, forces, want| {
        let state = absolute_state(closed);
        let gap = model.constraints(0.0, &state.q).amax();
        assert!(gap <= 1e-14, "{name} is open by {gap:e}");
        let rates = model.forward_dynamics(0.0, &state, &thrusts!(absolute, forces));
        assert_accelerations(name, &six(&rates.v.platform), &want);
        assert_eq!(rates.rank, 72.0);
        returned!(absolute, state, forces, rates.v);
    });
}

#[test]
fn accelerations_in_joint_coordinates() {
    let model = joint_coordinates::Model::new(&joint_coordinates::Params::default());
    assert_eq!((joint_coordinates::DOF, joint_coordinates::CONSTRAINTS), (21, 15));
    assert_eq!(joint_coordinates::COORDINATES[3], "legs[0].ball.x");
    five_states("tsai", |name, _, closed, forces, want| {
        let state = joint_state!(joint_coordinates, closed);
        let gap = model.constraints(0.0, &state.q).amax();
        assert!(gap <= 1e-14, "{name} is open by {gap:e}");
        let output = model.outputs(0.0, &state, &thrusts!(joint_coordinates, forces));
        let (_, _, accel) = turning(closed.q, closed.v, want);
        let want = [want[0], want[1], want[2], accel.x, accel.y, accel.z];
        let (linear, angular) = (output.accel, output.spin_accel);
        assert_accelerations(name, &[linear.as_slice(), angular.as_slice()].concat(), &want);
        let rates = model.forward_dynamics(0.0, &state, &thrusts!(joint_coordinates, forces));
        assert_eq!(rates.rank, 15.0);
        returned!(joint_coordinates, state, forces, rates.v);
    });
}

/// Where legs are known to stay long and out of their first axes all equations are absorbed, and nothing else changes.
#[test]
fn accelerations_with_all_equations_absorbed() {
    let model = assumed_hybrid::Model::new(&assumed_hybrid::Params::default());
    five_states("tsai", |name, _, closed, forces, want| {
        let rates =
            model.forward_dynamics(0.0, &hybrid_state!(assumed_hybrid, closed), &thrusts!(assumed_hybrid, forces));
        assert_accelerations(name, &six(&rates.v.platform), &want);
        assert_eq!(rates.rank, 18.0);
    });
    let joints = joint_coordinates::Model::new(&joint_coordinates::Params::default());
    let model = assumed_joints::Model::new(&assumed_joints::Params::default());
    five_states("tsai", |name, _, closed, forces, _| {
        let (state, plain) = (joint_state!(assumed_joints, closed), joint_state!(joint_coordinates, closed));
        let want = joints.forward_dynamics(0.0, &plain, &thrusts!(joint_coordinates, forces));
        let rates = model.forward_dynamics(0.0, &state, &thrusts!(assumed_joints, forces));
        let [got, want]: [SVector<f64, { assumed_joints::DOF }>; 2] = [rates.v.into(), want.v.into()];
        assert_accelerations(name, got.as_slice(), want.as_slice());
        assert_eq!(rates.rank, 15.0);
    });
}

/// The same forces where the loops keep their equations: all multipliers are found, and left aside.
#[test]
fn forces_with_multipliers() {
    let (model, legs) =
        (hybrid::Model::new(&hybrid::Params::default()), reduced::Model::new(&reduced::Params::default()));
    for name in ["stewart/heave_forces", "stewart/yaw_tsai", "stewart/general_motion_tsai"] {
        let file = read(name);
        let mut most = 0.0;
        for k in 0..list(&file["t"]).len() {
            let [q, v, a] = ["q", "qd", "qdd"].map(|name| array(&file[name][k]));
            let closed = Closed::new(q, v);
            let accel = reduced::Velocity { platform: free(a) };
            let found = legs.kinematics(0.0, &reduced_state!(reduced, closed), &accel).acceleration;
            let mut accel = hybrid::Velocity { platform: free(a), ..Default::default() };
            for (i, leg) in accel.legs.iter_mut().enumerate() {
                (leg.gimbal, leg.stroke) = (Closed::gimbal(&found, i), found[12 + i]);
            }
            let solved = model.inverse_dynamics(0.0, &hybrid_state!(hybrid, closed), &Default::default(), &accel);
            most = worse(most, difference(&solved.input.legs.map(|leg| leg.thrust), &array::<6>(&file["f"][k])));
        }
        println!("{name} with multipliers: forces {most:e} N");
        assert!(most <= 1e-10, "{name}: forces {most:e} N");
    }
}

/// What inputs and multipliers do to the equations of motion, which are linear in them.
macro_rules! reach {
    ($model:ident, $state:expr) => {{
        const N: usize = $model::DOF;
        const M: usize = $model::CONSTRAINTS;
        let (model, state) = ($model::Model::<f64>::default(), $state);
        let left = |forces: [f64; 6]| {
            let (input, none) = (thrusts!($model, forces), SVector::<f64, M>::zeros());
            model.residual(0.0, &state, &input, &$model::Velocity::default(), &none)
        };
        let rest = left([0.0; 6]);
        let jacobian = model.constraint_jacobian(0.0, &state.q);
        DMatrix::from_fn(N, N, |i, j| match j.checked_sub(6) {
            Some(row) => jacobian[(row, i)],
            None => left(std::array::from_fn(|k| if k == j { 1.0 } else { 0.0 }))[i] - rest[i],
        })
    }};
}

macro_rules! reached {
    ($model:ident, $state:expr) => {{
        let model = $model::Model::<f64>::default();
        let solved = model.inverse_dynamics(0.0, &$state, &Default::default(), &Default::default());
        let values = reach!($model, $state).singular_values();
        (solved.rank - $model::DOF as f64, values.min() / values.max())
    }};
}

/// Where the legs cannot hold the platform their forces have no full rank, in any coordinates, and have one on either side.
#[test]
fn forces_at_singular_poses() {
    let at = |start: [f64; 6], turn: f64| {
        let mut q = start;
        q[5] += turn;
        Closed::new(q, [0.1, -0.2, 0.3, 0.2, -0.1, 0.15])
    };
    let mut met = 0;
    for start in
        [[-1.5, 0.0, 1.0, 0.0, 0.0, 0.0], [-1.4, 0.1, 1.1, 0.13, -0.21, 0.0], [-1.6, -0.2, 1.3, -0.3, 0.1, 0.0]]
    {
        let volume = |turn: f64| reach!(hybrid, hybrid_state!(hybrid, at(start, turn))).determinant();
        let mut turn = -2.5;
        while turn < 2.5 {
            let (mut low, mut high) = (turn, turn + 0.1);
            turn = high;
            if volume(low) * volume(high) > 0.0 {
                continue;
            }
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if volume(low) * volume(middle) > 0.0 { low = middle } else { high = middle }
            }
            for off in [0.0, 1e-2, -1e-2] {
                let closed = at(start, high + off);
                let found = [
                    reached!(hybrid, hybrid_state!(hybrid, closed)),
                    reached!(absolute, absolute_state(&closed)),
                    reached!(joint_coordinates, joint_state!(joint_coordinates, &closed)),
                ];
                println!("{start:?} turned by {}: {found:?}", high + off);
                for (missing, least) in found {
                    assert_eq!(missing < 0.0, off == 0.0, "{found:?}");
                    assert_eq!(least < 1e-12, off == 0.0, "{found:?}");
                }
            }
            met += 1;
        }
    }
    assert!(met >= 3, "{met}");
}

/// Errors of positions and velocities of the platform over a second, in steps of `dt`.
macro_rules! trajectory {
    ($model:ident, $name:expr, $start:expr, $dt:expr, $bound:expr) => {
        trajectory!($model, $name, $start, $dt, $bound, |_, state: &$model::State| [
            six(&state.q.platform),
            six(&state.v.platform)
        ])
    };
    ($model:ident, $name:expr, $start:expr, $dt:expr, $bound:expr, $platform:expr) => {{
        let file = read("stewart/forward");
        let data = list(&file["trajectories"]).iter().find(|data| data["name"] == $name).unwrap();
        let model = springs!($model, data);
        let input = thrusts!($model, array::<6>(&data["f0"]));
        let mut state = $start(&Closed::new(array(&data["pose"][0]), array(&data["vel"][0])));
        let (mut t, mut most) = (0.0, 0.0);
        for (k, point) in list(&data["t"]).iter().enumerate() {
            let end = number(point);
            let steps = ((end - t) / $dt).round();
            if steps > 0.0 {
                let dt = (end - t) / steps;
                state = DormandPrince::integrate(&model, t, &state, &input, dt, steps as u32, |_, _| ()).unwrap();
            }
            t = end;
            let [q, v] = $platform(&model, &state);
            let q = mixed(&q, &array::<6>(&data["pose"][k]));
            let v = mixed(&v, &array::<6>(&data["vel"][k]));
            most = worse(most, worse(q, v));
        }
        println!("{} {}: {most:e}", stringify!($model), $name);
        assert!(t == 1.0 && most <= $bound, "{} {}: {most:e}", stringify!($model), $name);
    }};
}

#[test]
fn trajectories_reduced() {
    trajectory!(reduced, "spring_damper", |start: &Closed| reduced_state!(reduced, start), 5e-4, 1e-11);
    trajectory!(heavy, "heavy_spring_damper", |start: &Closed| reduced_state!(heavy, start), 2.5e-4, 1e-11);
}

#[test]
fn trajectories_with_multipliers() {
    trajectory!(hybrid, "spring_damper", |start: &Closed| hybrid_state!(hybrid, start), 5e-4, 1e-11);
}

#[test]
fn trajectories_in_absolute_coordinates() {
    trajectory!(absolute, "spring_damper", absolute_state, 5e-4, 1e-11);
}

#[test]
fn trajectories_in_joint_coordinates() {
    let platform = |model: &joint_coordinates::Model, state: &joint_coordinates::State| {
        let output = model.outputs(0.0, state, &Default::default());
        let (p, v) = (output.pose.position, output.velocity);
        let (roll, pitch, yaw) = output.pose.orientation.euler_angles();
        let r = rates(&RollPitchYaw { roll, pitch, yaw }, output.spin);
        [[p.x, p.y, p.z, roll, pitch, yaw], [v.x, v.y, v.z, r.roll, r.pitch, r.yaw]]
    };
    trajectory!(
        joint_coordinates,
        "spring_damper",
        |start: &Closed| joint_state!(joint_coordinates, start),
        5e-4,
        1e-11,
        platform
    );
}
