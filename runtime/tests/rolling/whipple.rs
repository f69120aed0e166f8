//! Whipple's bicycle against data that were computed without any library of the kind: accelerations, forces of contact, a motion.
//! Source: `tests/data/rolling`, after Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955-1982.

use multibody::{Dop853, Integrator, Projection, WithProjection, multibody};
use serde_json::Value;

multibody! {
    /// Whipple's bicycle: x ahead, y to the right, z down; wheels that roll without slip on the plane z = 0.
    pub mod whipple {
        const W = 1.02;
        const C = 0.08;
        const TILT = PI / 10;
        const REAR = 0.3;
        const FRONT = 0.35;
        world { gravity: 9.81 * Z }
        body ahead { mass: 0 }
        body aside { mass: 0 }
        body below { mass: 0 }
        body headed { mass: 0 }
        body leaning { mass: 0 }
        body frame { mass: 85, com: [0.3, 0, -0.9 + REAR], inertia: inertia(9.2, 11, 2.8, 0, 2.4, 0) }
        body rear { mass: 2, inertia: diag(0.0603, 0.12, 0.0603) }
        body fork { mass: 4, com: [0.9 - W - C, 0, -0.7], inertia: inertia(0.05892, 0.06, 0.00708, 0, -0.00756, 0) }
        body front { mass: 3, inertia: diag(0.1405, 0.28, 0.1405) }
        joint x: Prismatic { parent: ground, child: ahead, axis: X }
        joint y: Prismatic { parent: ahead, child: aside, axis: Y }
        joint z: Prismatic { parent: aside, child: below, axis: Z }
        joint yaw: Revolute { parent: below, child: headed, axis: Z }
        joint roll: Revolute { parent: headed, child: leaning, axis: X }
        joint pitch: Revolute { parent: leaning, child: frame, axis: Y }
        joint spin_rear: Revolute { parent: frame, child: rear, axis: Y }
        joint steer: Revolute { parent: frame.at([W + C, 0, REAR]), child: fork, axis: [sin(TILT), 0, cos(TILT)] }
        joint spin_front: Revolute { parent: fork.at([-C, 0, -FRONT]), child: front, axis: Y }
        input lean;
        input turn;
        input pedal;
        force on_roll: Effort { joint: roll, value: lean }
        force on_steer: Effort { joint: steer, value: turn }
        force on_rear: Effort { joint: spin_rear, value: pedal }

        let rear_axle = frame.at(Y).position - frame.position;
        let rear_low = (Z - rear_axle * rear_axle.z) * (REAR / sqrt(1 - rear_axle.z * rear_axle.z));
        let rear_slip = rear.velocity + cross(rear.angular_velocity, rear_low);
        let front_axle = fork.at(Y).position - fork.position;
        let front_low = (Z - front_axle * front_axle.z) * (FRONT / sqrt(1 - front_axle.z * front_axle.z));
        let front_slip = front.velocity + cross(front.angular_velocity, front_low);
        constraint rear_touch = rear.position.z + rear_low.z;
        constraint front_touch = front.position.z + front_low.z;
        constraint rear_along = rear_slip.x;
        constraint rear_across = rear_slip.y;
        constraint front_along = front_slip.x;
        constraint front_across = front_slip.y;
        output energy = kinetic() + potential();
        formulation { constraints: Multipliers }
        emit forward_dynamics, derivatives, constraints;
    }
}
use whipple::{Input, Model, Position, State, Velocity};

fn data() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/rolling/whipple_nonlinear.json");
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
    let data = data();
    let samples = data["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 20);
    let (mut worst, mut worst_force) = (0.0_f64, 0.0_f64);
    for one in samples {
        let (state, input) = sample(one);
        let found = model.forward_dynamics(0.0, &state, &input);
        assert_eq!(found.rank, 6.0, "{}", one["label"]);
        assert!(model.constraints(0.0, &state.q).amax() < 1e-13 && model.constraint_rate(0.0, &state).amax() < 1e-12);
        worst = worst.max(apart(&list(&found.v), &list(&velocity(&one["a"]))));
        // Equations in the order of the constraints: touch behind, touch ahead, slip along and across behind, then ahead.
        let [rear_z, front_z, rear_x, rear_y, front_x, front_y] = found.multipliers.data.0[0].map(|m: f64| -m);
        let wanted = ["force_rear", "force_front"].map(|name| [0, 1, 2].map(|k| number(&one[name][k])));
        let forces = [rear_x, rear_y, rear_z, front_x, front_y, front_z];
        worst_force = worst_force.max(apart(&forces, &wanted.concat()));
    }
    println!("accelerations {worst:.1e}, forces {worst_force:.1e}");
    assert!(worst < 1e-11 && worst_force < 1e-11, "{worst:e}, {worst_force:e}");
}

/// Ten seconds, in which it goes from side to side and comes to run upright.
#[test]
fn a_motion() {
    let model = WithProjection::new(Model::<f64>::default(), Projection::default());
    let data = data();
    let points = data["trajectory"]["points"].as_array().unwrap();
    let energy = number(&data["trajectory"]["energy"]);
    let mut start = State::default();
    start.q = position(&points[0]["q"]);
    start.v = Velocity { x: 4.6, y: 0.15, roll: 0.5, spin_rear: -4.6 / 0.3, spin_front: -4.6 / 0.35, ..Velocity::default() };
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
