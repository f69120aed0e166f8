//! Whipple's bicycle against data that were computed without any library of the kind: accelerations, forces of contact, a motion.
//! Source: `tests/data/rolling`, after Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955-1982.

use multibody::{Dop853, Free, Integrator, Projection, System, Tangent, WithProjection, multibody, trim};
use serde_json::Value;

use crate::speeds;

bicycle!(whipple, {
    formulation { constraints: Multipliers }
    emit forward_dynamics, derivatives, constraints;
});
// Three velocities, the height in closed form, and the pitch by an iteration.
bicycle!(reduced, {
    output at = [x.rate, y.rate, z.rate, yaw.rate, roll.rate, pitch.rate, spin_rear.rate, steer.rate, spin_front.rate];
    output moved = [
        x.accel, y.accel, z.accel, yaw.accel, roll.accel, pitch.accel,
        spin_rear.accel, steer.accel, spin_front.accel
    ];
    output place = [x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front];
    output momentum = linear_momentum();
    formulation { constraints: Reduced, independent: [roll, steer, spin_rear] }
    emit forward_dynamics, mass_matrix, bias, derivatives, energy;
});
use whipple::{Input, Model, Position, State, Velocity};

fn data(name: &str) -> Value {
    let path = format!("{}/../tests/data/rolling/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap_or(0.0), |text| text.parse().unwrap())
}

fn velocity(value: &Value) -> Velocity {
    let at = |name: &str| number(&value[name]);
    Velocity {
        x: at("x"),
        y: at("y"),
        z: at("z"),
        yaw: at("yaw"),
        roll: at("roll"),
        pitch: at("pitch"),
        spin_rear: at("spin_rear"),
        steer: at("steer"),
        spin_front: at("spin_front"),
    }
}

fn position(value: &Value) -> Position {
    let Velocity { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front } = velocity(value);
    Position { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front }
}

fn list(v: &Velocity) -> [f64; 9] {
    [v.x, v.y, v.z, v.yaw, v.roll, v.pitch, v.spin_rear, v.steer, v.spin_front]
}

fn sample(sample: &Value) -> (State, Input) {
    let effort = |name: &str| number(&sample["effort"][name]);
    let state = State { q: position(&sample["q"]), v: velocity(&sample["v"]) };
    (state, Input { lean: effort("roll"), turn: effort("steer"), pedal: effort("spin_rear") })
}

/// A difference over one plus the greatest.
fn apart(found: &[f64], wanted: &[f64]) -> f64 {
    let greatest = wanted.iter().fold(1.0_f64, |most, x| most.max(1.0 + x.abs()));
    found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / greatest
}

#[test]
fn accelerations_and_forces_of_contact() {
    let model = Model::<f64>::default();
    let data = data("whipple_nonlinear");
    let samples = data["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 20);
    let (mut worst, mut worst_force) = (0.0_f64, 0.0_f64);
    for one in samples {
        let (state, input) = sample(one);
        let found = model.forward_dynamics(0.0, &state, &input);
        assert_eq!(found.rank, 6.0, "{}", one["label"]);
        assert!(model.constraints(0.0, &state.q).amax() < 1e-13 && model.constraint_rate(0.0, &state).amax() < 1e-12);
        worst = worst.max(apart(&list(&found.v), &list(&velocity(&one["a"]))));
        let outputs = model.outputs(0.0, &state, &input);
        let wanted = ["force_rear", "force_front"].map(|name| [0, 1, 2].map(|k| number(&one[name][k])));
        let forces: Vec<f64> = outputs.rear_force.iter().chain(&outputs.front_force).copied().collect();
        worst_force = worst_force.max(apart(&forces, &wanted.concat()));
        assert!(outputs.contacts.iter().all(|at| at.z.abs() < 1e-13) && outputs.slips.iter().all(|v| v.amax() < 1e-12));
    }
    println!("accelerations {worst:.1e}, forces {worst_force:.1e}");
    assert!(worst < 1e-11 && worst_force < 1e-11, "{worst:e}, {worst_force:e}");
}

/// Ten seconds, in which it goes from side to side and comes to run upright.
#[test]
fn a_motion() {
    let model = WithProjection::new(Model::<f64>::default(), Projection::default());
    let data = data("whipple_nonlinear");
    let points = data["trajectory"]["points"].as_array().unwrap();
    let energy = number(&data["trajectory"]["energy"]);
    let start = State {
        q: position(&points[0]["q"]),
        v: Velocity {
            x: 4.6,
            y: 0.15,
            roll: 0.5,
            spin_rear: -4.6 / 0.3,
            spin_front: -4.6 / 0.35,
            ..Velocity::default()
        },
    };
    let (mut state, mut t, mut worst) = (start, 0.0, 0.0_f64);
    let integrator = Integrator::adaptive(Dop853, 1e-13, 1e-13);
    for point in points {
        let until = number(&point["t"]);
        if until > t {
            state = integrator.integrate(&model, t, until, &state, &Input::default(), |_, _| ()).unwrap().0;
            t = until;
        }
        let wanted = list(&{
            let Position { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front } = position(&point["q"]);
            Velocity { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front }
        });
        let Position { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front } = state.q;
        worst = worst.max(apart(&[x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front], &wanted));
        let rates = [state.v.roll, state.v.steer, state.v.spin_rear];
        worst = worst.max(apart(&rates, &["roll", "steer", "spin_rear"].map(|name| number(&point["rates"][name]))));
        // The reference counts height from the ground, downwards.
        let found = Model::<f64>::default().outputs(t, &state, &Input::default()).energy;
        assert!((found / energy - 1.0).abs() < 1e-12, "{t}: {found} against {energy}");
    }
    println!("{worst:.1e}");
    assert!(worst < 1e-10, "{worst:e}");
}

/// The same state, in the velocities that are left.
fn reduced_state(position: Position, rates: &Velocity) -> reduced::State {
    let Position { x, y, yaw, roll, pitch, spin_rear, steer, spin_front, .. } = position;
    reduced::State {
        q: reduced::Position { x, y, yaw, roll, spin_rear, steer, spin_front },
        v: reduced::Velocity { roll: rates.roll, spin_rear: rates.spin_rear, steer: rates.steer },
        guess: reduced::Guess { pitch },
    }
}

/// Accelerations, forces of contact and rates without multipliers.
#[test]
fn three_velocities() {
    let model = reduced::Model::<f64>::default();
    let data = data("whipple_nonlinear");
    let (mut worst, mut worst_force) = (0.0_f64, 0.0_f64);
    for one in data["samples"].as_array().unwrap() {
        let (State { q, v }, input) = sample(one);
        let input = reduced::Input { lean: input.lean, turn: input.turn, pedal: input.pedal };
        let state = model.accepted(0.0, &reduced_state(q, &v), &input);
        let outputs = model.outputs(0.0, &state, &input);
        let places = [q.x, q.y, q.z, q.yaw, q.roll, q.pitch, q.spin_rear, q.steer, q.spin_front];
        assert!(apart(&outputs.place, &places) < 1e-13, "{}", one["label"]);
        assert!(apart(&outputs.at, &list(&v)) < 1e-12, "{}", one["label"]);
        worst = worst.max(apart(&outputs.moved, &list(&velocity(&one["a"]))));
        let wanted = ["force_rear", "force_front"].map(|name| [0, 1, 2].map(|k| number(&one[name][k])));
        let forces: Vec<f64> = outputs.rear_force.iter().chain(&outputs.front_force).copied().collect();
        worst_force = worst_force.max(apart(&forces, &wanted.concat()));
    }
    println!("accelerations {worst:.1e}, forces {worst_force:.1e}");
    assert!(worst < 1e-11 && worst_force < 1e-11, "{worst:e}, {worst_force:e}");
}

/// Ten seconds in them, without a projection.
#[test]
fn a_motion_in_three_velocities() {
    let model = reduced::Model::<f64>::default();
    let data = data("whipple_nonlinear");
    let points = data["trajectory"]["points"].as_array().unwrap();
    let energy = number(&data["trajectory"]["energy"]);
    let rates = Velocity { roll: 0.5, spin_rear: -4.6 / 0.3, ..Velocity::default() };
    let (mut state, mut t, mut worst) = (reduced_state(position(&points[0]["q"]), &rates), 0.0, 0.0_f64);
    let integrator = Integrator::adaptive(Dop853, 1e-13, 1e-13);
    for point in points {
        let until = number(&point["t"]);
        if until > t {
            state = integrator.integrate(&model, t, until, &state, &reduced::Input::default(), |_, _| ()).unwrap().0;
            t = until;
        }
        let Position { x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front } = position(&point["q"]);
        let outputs = model.outputs(t, &state, &reduced::Input::default());
        worst = worst.max(apart(&outputs.place, &[x, y, z, yaw, roll, pitch, spin_rear, steer, spin_front]));
        let rates = [state.v.roll, state.v.steer, state.v.spin_rear];
        worst = worst.max(apart(&rates, &["roll", "steer", "spin_rear"].map(|name| number(&point["rates"][name]))));
        assert!((outputs.energy / energy - 1.0).abs() < 1e-12, "{t}: {} against {energy}", outputs.energy);
        assert!(outputs.slips.iter().all(|slip| slip.amax() < 1e-11));
    }
    println!("{worst:.1e}");
    assert!(worst < 1e-10, "{worst:e}");
}

/// Upright and straight ahead: roll and steer against the linear equations of the benchmark, and their eigenvalues.
#[cfg(feature = "num-dual")]
#[test]
fn small_motions() {
    use multibody::nalgebra::{Matrix2, Matrix4, SMatrix, SVector};
    use num_dual::Dual64;

    const ROLL: usize = 4;
    const STEER: usize = 7;
    /// The others follow from the constraints, but for the speed of the rear wheel, which stays.
    const FOLLOW: [usize; 6] = [0, 1, 2, 3, 5, 8];
    let reference = data("whipple");
    let matrix = |name: &str| Matrix2::from_fn(|i, j| number(&reference["matrices"][name][i][j]));
    let [mass, c1, k0, k2] = ["M", "C1", "K0", "K2"].map(matrix);
    let model = Model::<f64>::default();
    let dual = Model::<Dual64>::default();
    let (mut worst, mut worst_root, mut speeds) = (0.0_f64, 0.0_f64, 0);
    for entry in reference["eigenvalues"].as_array().unwrap() {
        let speed = number(&entry["v"]);
        let state = State {
            q: Position { z: -0.3, ..Position::default() },
            v: Velocity { x: speed, spin_rear: -speed / 0.3, spin_front: -speed / 0.35, ..Velocity::default() },
        };
        let slopes = model.forward_derivatives(0.0, &state, &Input::default());
        let jacobian = model.constraint_jacobian(0.0, &state.q);
        let follow = SMatrix::<f64, 6, 6>::from_fn(|i, j| jacobian[(i, FOLLOW[j])]).try_inverse().unwrap();
        // How accelerations change along a displacement or a rate that the constraints are kept with.
        let along = |position: usize, rate: usize| {
            let seeded = |x: f64, on: bool| Dual64::new(x, if on { 1.0 } else { 0.0 });
            let mut moved = whipple::State::<Dual64>::default();
            moved.q.z = seeded(-0.3, false);
            moved.q.roll = seeded(0.0, position == ROLL);
            moved.q.steer = seeded(0.0, position == STEER);
            moved.v.x = seeded(speed, false);
            moved.v.spin_rear = seeded(-speed / 0.3, false);
            moved.v.spin_front = seeded(-speed / 0.35, false);
            moved.v.roll = seeded(0.0, rate == ROLL);
            moved.v.steer = seeded(0.0, rate == STEER);
            let gap = dual.constraint_rate(Dual64::from(0.0), &moved).map(|x| x.eps);
            let following = -(follow * gap);
            let (mut q, mut v) = (SVector::<f64, 9>::zeros(), SVector::<f64, 9>::zeros());
            FOLLOW.iter().zip(following.iter()).for_each(|(&k, &x)| v[k] = x);
            for k in [ROLL, STEER] {
                q[k] = if position == k { 1.0 } else { 0.0 };
                v[k] = if rate == k { 1.0 } else { 0.0 };
            }
            let change = slopes.position * q + slopes.velocity * v;
            [change[ROLL], change[STEER]]
        };
        let none = usize::MAX;
        let columns = [along(ROLL, none), along(STEER, none), along(none, ROLL), along(none, STEER)];
        let inverse = mass.try_inverse().unwrap();
        let (stiff, damp) = (-inverse * (k0 * 9.81 + k2 * (speed * speed)), -inverse * c1 * speed);
        let greatest = stiff.amax().max(damp.amax());
        for (j, column) in columns.iter().enumerate() {
            for i in 0..2 {
                let wanted = if j < 2 { stiff[(i, j)] } else { damp[(i, j - 2)] };
                worst = worst.max((column[i] - wanted).abs() / greatest);
            }
        }
        let a = Matrix4::from_fn(|i, j| if i < 2 { f64::from(j == i + 2) } else { columns[j][i - 2] });
        let found = a.complex_eigenvalues();
        for root in entry["eig"].as_array().unwrap() {
            let [re, im] = [0, 1].map(|k| number(&root[k]));
            let near = found.iter().map(|x| (x.re - re).hypot(x.im - im)).fold(f64::INFINITY, f64::min);
            worst_root = worst_root.max(near / (1.0 + re.hypot(im)));
        }
        speeds += 1;
    }
    println!("rows {worst:.1e}, eigenvalues {worst_root:.1e}");
    assert_eq!(speeds, 21);
    assert!(worst < 1e-12 && worst_root < 1e-13, "{worst:e}, {worst_root:e}");
}

/// The same rows from the derivatives of the model in three velocities, whose height and pitch follow.
#[test]
fn small_motions_in_three_velocities() {
    use multibody::nalgebra::{Matrix2, SVector};

    let reference = data("whipple");
    let matrix = |name: &str| Matrix2::from_fn(|i, j| number(&reference["matrices"][name][i][j]));
    let [mass, c1, k0, k2] = ["M", "C1", "K0", "K2"].map(matrix);
    let inverse = mass.try_inverse().unwrap();
    let model = reduced::Model::<f64>::default();
    let place = |list: SVector<f64, 3>| list.iter().position(|&x| x == 1.0).unwrap();
    let velocity = |change: fn(&mut reduced::Velocity<f64>)| {
        let mut one = reduced::Velocity::zero();
        change(&mut one);
        place(one.into())
    };
    let [roll, steer] = [velocity(|v| v.roll = 1.0), velocity(|v| v.steer = 1.0)];
    let displacement = |change: fn(&mut reduced::Rates<f64>)| {
        let mut one = reduced::Rates::zero();
        change(&mut one);
        speeds::flat(&one).iter().position(|&x| x == 1.0).unwrap()
    };
    let [along_roll, along_steer] = [displacement(|q| q.roll = 1.0), displacement(|q| q.steer = 1.0)];
    let (mut worst, mut speeds) = (0.0_f64, 0);
    for entry in reference["eigenvalues"].as_array().unwrap() {
        let speed = number(&entry["v"]);
        let mut state = reduced::State::<f64>::default();
        state.v.spin_rear = -speed / 0.3;
        let state = model.accepted(0.0, &state, &reduced::Input::default());
        let slopes = model.forward_derivatives(0.0, &state, &reduced::Input::default());
        let (stiff, damp) = (-inverse * (k0 * 9.81 + k2 * (speed * speed)), -inverse * c1 * speed);
        let greatest = stiff.amax().max(damp.amax());
        for (i, row) in [roll, steer].into_iter().enumerate() {
            for (j, (along, by)) in [(along_roll, roll), (along_steer, steer)].into_iter().enumerate() {
                let apart = [slopes.position[(row, along)] - stiff[(i, j)], slopes.velocity[(row, by)] - damp[(i, j)]];
                worst = apart.iter().fold(worst, |worst, x| worst.max(x.abs() / greatest));
            }
        }
        speeds += 1;
    }
    assert_eq!(speeds, 21);
    assert!(worst < 1e-12, "{worst:e}");
}

/// Round in circles: the lean and the moments at handlebar and pedals that hold a steer angle and a speed, found while the place, the
/// heading and the wheels' angles run. The motion keeps them, about a centre that stays; what both contacts carry is the weight.
#[test]
fn steady_turns() {
    let model = reduced::Model::<f64>::default();
    for (steer, speed, yaw) in [(0.1, 4.0, 0.3), (-0.25, 3.0, -2.0), (0.02, 7.0, 1.1), (0.6, 2.0, 5.0)] {
        let mut guess = reduced::State::<f64>::default();
        (guess.q.yaw, guess.q.steer, guess.v.spin_rear) = (yaw, steer, -speed / 0.3);
        guess = model.accepted(0.0, &guess, &reduced::Input::default());
        let mut free = Free {
            position: reduced::Rates::<f64>::zero(),
            velocity: reduced::Velocity::zero(),
            states: (),
            input: reduced::Input { lean: 0.0, turn: 1.0, pedal: 1.0 },
        };
        free.position.roll = 1.0;
        let found = trim(&model, 0.0, &guess, &reduced::Input::default(), &free).unwrap();
        let (start, input) = (found.state, found.input);
        assert!((start.q.steer, start.v.spin_rear, start.v.roll) == (steer, -speed / 0.3, 0.0) && found.rank == 3.0);
        // Leaning into the turn.
        assert!(start.q.roll * steer > 0.0 && start.q.roll.abs() < 0.8, "{}", start.q.roll);
        let outputs = model.outputs(0.0, &start, &input);
        let yaw_rate = outputs.at[3];
        let (mut state, mut t) = (start, 0.0);
        let integrator = Integrator::adaptive(Dop853, 1e-13, 1e-13);
        while t < 2.0 {
            state = integrator.integrate(&model, t, t + 0.25, &state, &input, |_, _| ()).unwrap().0;
            t += 0.25;
            let error = (state.q.roll - start.q.roll).abs().max((state.q.steer - steer).abs());
            assert!(error < 1e-8, "{steer}: {error:e} off after {t} s");
            // The centre of the circle stays: it is a quarter turn to the side of the way.
            let centre = |state: &reduced::State| {
                let rates = model.outputs(0.0, state, &input).at;
                [state.q.x - rates[1] / yaw_rate, state.q.y + rates[0] / yaw_rate]
            };
            let ([ax, ay], [bx, by]) = (centre(&start), centre(&state));
            let moved = (ax - bx).hypot(ay - by) * yaw_rate.abs() / speed;
            assert!(moved < 1e-7, "{steer}: the centre moves by {moved:e} of the radius");
        }
        // What both contacts and the weight do turns the momentum with the heading, about the axis that points downwards.
        let [px, py, _] = outputs.momentum.into();
        let wanted = [-yaw_rate * py, yaw_rate * px, -94.0 * 9.81];
        let forces = outputs.rear_force + outputs.front_force;
        for (found, wanted) in forces.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-8, "{found} instead of {wanted}");
        }
    }
}
