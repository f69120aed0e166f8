//! `Rolling` and `Skate` against closed solutions, laws of motion and equations that are typed in.

use multibody::nalgebra::{Matrix3, Rotation3, SVector, UnitQuaternion, Vector3};
use multibody::{Dop853, Integrator, Projection, WithProjection, multibody};

multibody! {
    /// A solid ball on a slope that lies obliquely in space, and gravity as oblique.
    pub mod slope {
        param pull: Vec3 = [0.3, -1.2, -9.1];
        param radius = 0.2;
        world { gravity: pull }
        body ball { mass: 1.3, inertia: sphere(1.3, 0.2) }
        joint float: Free { parent: ground, child: ball }
        let plane = ground.at([0.3, -0.2, 0.7]).rotated([1.0, -2.0, 0.5], 0.4);
        constraint roll: Rolling { wheel: ball, radius: radius, on: plane }
        output force = roll.force;
        output contact = roll.contact;
        output slip = roll.slip;
        output axes = plane.rotation;
        emit forward_dynamics, constraints, energy;
    }
    /// A ball on a plate that turns freely about an oblique axis, off its bearing: what moves is what is set free.
    pub mod table {
        body plate { mass: 2.0, com: [0.1, -0.05, 0.02], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint bearing: Revolute { parent: ground.rotated(X, 0.7), child: plate, axis: Z }
        body ball { mass: 1.3, inertia: diag(0.02, 0.025, 0.03) }
        joint float: Free { parent: ground, child: ball }
        constraint roll: Rolling { wheel: ball, radius: 0.2, on: plate.at(0.1 * Z) }
        output energy = kinetic();
        // About the bearing, which stands at the origin.
        let whole = angular_momentum() + cross(centre_of_mass(), linear_momentum());
        output turning = dot(whole, ground.rotated(X, 0.7).rotation * Z);
        output force = roll.force;
        output contact = roll.contact;
        output load = bearing.reaction;
        output ball_acceleration = ball.acceleration;
        emit forward_dynamics, constraints, derivatives;
    }
    /// A thin disc of which neither the axle nor the hub lies along its body's axes, on a plane that does not either.
    pub mod oblique_disc {
        world { gravity: [0.0, 9.81 * sin(0.5), -9.81 * cos(0.5)] }
        body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
        joint float: Free { parent: ground, child: disc }
        let road = ground.rotated(X, 0.5).rotated(Z, 2.0);
        let hub = disc.rotated(Z, 0.8);
        constraint roll: Rolling { wheel: hub, axis: [3.0 * sin(0.8), 3.0 * cos(0.8), 0.0], radius: 0.25, on: road }
        output contact = roll.contact;
        output force = roll.force;
        emit forward_dynamics, constraints;
    }
    pub mod upright_disc {
        world { gravity: -9.81 * Z }
        body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
        joint float: Free { parent: ground, child: disc }
        constraint roll: Rolling { wheel: disc, axis: Y, radius: 0.25 }
        output contact = roll.contact;
        output force = roll.force;
        output energy = kinetic() + potential();
        emit forward_dynamics, constraints;
    }
    /// A snakeboard: a rotor on the board, and both wheel sets steered alike against each other.
    pub mod snakeboard {
        const L = 0.4;
        body board { mass: 3.0, inertia: diag(0.1, 0.1, 0.1) }
        body rotor { mass: 0.5, inertia: diag(0.13, 0.13, 0.25) }
        body front { mass: 0.2, inertia: diag(0.01, 0.01, 0.01) }
        body back { mass: 0.2, inertia: diag(0.01, 0.01, 0.01) }
        joint plane: Planar { parent: ground, child: board, axis: Z }
        joint swing: Revolute { parent: board, child: rotor, axis: Z }
        joint fore: Revolute { parent: board.at(L * X), child: front, axis: Z }
        joint aft: Revolute { parent: board.at(-L * X), child: back, axis: Z }
        constraint alike = fore + aft;
        constraint front_blade: Skate { blade: front, along: 2.0 * X }
        constraint back_blade: Skate { blade: back, along: X }
        input twist;
        input steer;
        force by_rotor: Effort { joint: swing, value: twist }
        force by_foot: Effort { joint: fore, value: steer }
        output energy = kinetic();
        output forces = [front_blade.force, back_blade.force];
        output places = [front.position, back.position];
        emit forward_dynamics, constraints;
    }
}

/// A ball whose height is eliminated in every formulation, since it is a coupling of its centre's coordinates.
macro_rules! ball_in_angles {
    ($name:ident, $constraints:ident) => {
        multibody! {
            mod $name {
                param radius = 0.2;
                world { gravity: [0.3, -1.2, -9.1] }
                body ball { mass: 1.3, inertia: inertia(0.03, 0.035, 0.028, 0.002, -0.001, 0.003) }
                joint float: Free { parent: ground.at(0.1 * X), child: ball, coordinates: RollPitchYaw }
                let plane = ground.at([0.3, -0.2, 0.7]).rotated([1.0, -2.0, 0.5], 0.4);
                constraint roll: Rolling { wheel: ball, radius: radius, on: plane }
                force wind: Force { at: ball.at([0.05, 0.1, -0.02]), value: [3.0, -1.0, 2.0], axes: ground }
                output height = plane.express(ball.position - plane.position).z;
                output load = [roll.force, roll.touch.multiplier * (plane.rotation * Z)];
                output arms = [roll.contact - ball.position, ball.rotation * [0.05, 0.1, -0.02]];
                output moved = [ball.acceleration, ball.angular_acceleration, ball.angular_velocity];
                output axes = ball.rotation;
                output up = plane.rotation * Z;
                formulation { constraints: $constraints }
                emit forward_dynamics;
            }
        }
    };
}
ball_in_angles!(in_angles, Multipliers);
ball_in_angles!(in_angles_reduced, Reduced);

/// Newton and Euler of a ball on a plane: what the plane does is known, though its height keeps no multiplier.
#[test]
fn what_holds_a_height_that_is_eliminated() {
    macro_rules! check {
        ($name:ident, $freedoms:literal) => {
            for k in 0..6 {
                let number = |at: usize| 0.7 * ((7 * k + 3 * at) as f64).sin();
                let state = $name::State {
                    q: SVector::<f64, 5>::from_fn(|at, _| number(at)).into(),
                    v: SVector::<f64, $freedoms>::from_fn(|at, _| number(at + 5)).into(),
                };
                let out = $name::Model::<f64>::default().outputs(0.0, &state, &());
                let ([force, normal], [lever, arm]) = (out.load, out.arms);
                let [acceleration, alpha, omega] = out.moved;
                let (body, up) = (*out.axes.matrix(), out.up);
                let (wind, gravity) = (Vector3::new(3.0, -1.0, 2.0), Vector3::new(0.3, -1.2, -9.1));
                assert!((out.height - 0.2).abs() < 1e-14);
                assert!((force + wind + gravity * 1.3 - acceleration * 1.3).amax() < 1e-12);
                let own = Matrix3::new(0.03, 0.002, -0.001, 0.002, 0.035, 0.003, -0.001, 0.003, 0.028);
                let inertia = body * own * body.transpose();
                let moment = lever.cross(&force) + arm.cross(&wind);
                assert!((moment - inertia * alpha - omega.cross(&(inertia * omega))).amax() < 1e-12);
                assert!((normal + up * up.dot(&force)).amax() < 1e-12 && force.norm() > 1.0);
            }
        };
    }
    check!(in_angles, 5);
    check!(in_angles_reduced, 3);
}

/// A solid ball takes five sevenths of what pulls it down the slope; friction is the rest.
#[test]
fn a_ball_on_a_slope() {
    let params = slope::Params { pull: Vector3::new(0.7, -2.1, -8.3), radius: 0.2 };
    let model = slope::Model::<f64>::new(&params);
    let mut state = slope::State::<f64>::default();
    let axes = model.outputs(0.0, &state, &()).axes;
    let [x, y, z] = [0, 1, 2].map(|k| axes.matrix().column(k).into_owned());
    assert!((axes.matrix() - Rotation3::new(Vector3::new(1.0, -2.0, 0.5).normalize() * 0.4).matrix()).amax() < 1e-15);
    let origin = Vector3::new(0.3, -0.2, 0.7);
    state.q.float.position = origin + x * 0.4 - y * 1.3 + z * 0.2;
    state.q.float.orientation = UnitQuaternion::from_euler_angles(0.4, 2.0, -1.0);
    state.v.float.linear = x * 0.5 + y * 0.8;
    // The share about the normal is free.
    let omega = z.cross(&state.v.float.linear) / 0.2 + z * 3.0;
    state.v.float.angular = state.q.float.orientation.inverse() * omega;
    let found = model.forward_dynamics(0.0, &state, &());
    let down = params.pull - z * params.pull.dot(&z);
    assert!((found.v.float.linear - down * (5.0 / 7.0)).amax() < 1e-13);
    let out = model.outputs(0.0, &state, &());
    let wanted = -(z * params.pull.dot(&z) + down * (2.0 / 7.0)) * 1.3;
    assert!((out.force - wanted).amax() < 1e-13, "{} {wanted}", out.force);
    assert!((out.contact - (state.q.float.position - z * 0.2)).amax() < 1e-15 && out.slip.amax() < 1e-15);
    assert!(params.check().is_ok());
    let why = slope::Params { radius: -0.1, ..params }.check().unwrap_err();
    assert_eq!(why.what, "`radius > 0.0` does not hold");
}

/// Nothing does work, and nothing turns both about the bearing's axis; of the ball alone Newton's law.
#[test]
fn a_ball_on_a_free_table() {
    let model = table::Model::<f64>::default();
    let system = WithProjection::new(model, Projection::default());
    let mut start = table::State::<f64>::default();
    let axes = Rotation3::new(Vector3::x() * 0.7) * Rotation3::new(Vector3::z() * 0.9);
    start.q.bearing = 0.9;
    start.v.bearing = 1.1;
    start.q.float.position = axes * Vector3::new(0.3, 0.1, 0.3);
    start.q.float.orientation = UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0);
    start.v.float.angular = Vector3::new(0.5, -2.0, 1.0);
    let start = Projection::default().project(&model, 0.0, &start).unwrap().state;
    let before = model.outputs(0.0, &start, &());
    let (end, _) = Integrator::adaptive(Dop853, 1e-13, 1e-13)
        .integrate(&system, 0.0, 3.0, &start, &(), |t, state| {
            let out = model.outputs(t, state, &());
            assert!((out.force - out.ball_acceleration * 1.3).amax() < 1e-12 * (1.0 + out.force.amax()));
        })
        .unwrap();
    let after = model.outputs(3.0, &end, &());
    assert!((end.q.bearing - start.q.bearing).abs() > 0.5 && (after.contact - before.contact).amax() > 0.1);
    assert!((after.energy / before.energy - 1.0).abs() < 1e-12, "{} {}", after.energy, before.energy);
    assert!((after.turning / before.turning - 1.0).abs() < 1e-12, "{} {}", after.turning, before.turning);
}

/// The same disc in a world that is turned about, with frames that are turned in the body and on the plane.
#[test]
fn a_disc_in_oblique_frames() {
    let (one, other) = (upright_disc::Model::<f64>::default(), oblique_disc::Model::<f64>::default());
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5);
    for k in 0..5 {
        let x = f64::from(k);
        let mut state = upright_disc::State::<f64>::default();
        state.q.float.orientation = UnitQuaternion::from_euler_angles(0.9 - 0.4 * x, 1.3 * x, 2.0 - x);
        state.q.float.position = Vector3::new(0.3 * x, -0.4, 0.2);
        state.v.float.angular = Vector3::new(0.7, -3.0 + x, 0.4 * x);
        let state = Projection::default().project(&one, 0.0, &state).unwrap().state;
        let mut same = oblique_disc::State::<f64>::default();
        same.q.float.orientation = turn * state.q.float.orientation;
        same.q.float.position = turn * state.q.float.position;
        same.v.float.angular = state.v.float.angular;
        same.v.float.linear = turn * state.v.float.linear;
        assert!((other.constraints(0.0, &same.q) - one.constraints(0.0, &state.q)).amax() < 1e-14);
        assert!(other.constraint_rate(0.0, &same).amax() < 1e-13);
        let (a, b) = (one.forward_dynamics(0.0, &state, &()), other.forward_dynamics(0.0, &same, &()));
        assert!((turn * a.v.float.linear - b.v.float.linear).amax() < 1e-11 * (1.0 + a.v.float.linear.amax()));
        assert!((a.v.float.angular - b.v.float.angular).amax() < 1e-11 * (1.0 + a.v.float.angular.amax()));
        let (a, b) = (one.outputs(0.0, &state, &()), other.outputs(0.0, &same, &()));
        assert!((turn * a.contact - b.contact).amax() < 1e-13);
        assert!((turn * a.force - b.force).amax() < 1e-11 * (1.0 + a.force.amax()));
    }
}

/// Work of the rider is what the board gains; forces are across the blades, and about their common centre nothing turns.
#[test]
fn a_snakeboard() {
    let model = snakeboard::Model::<f64>::default();
    let system = WithProjection::new(model, Projection::default());
    let mut start = snakeboard::State::<f64>::default();
    (start.q.plane.angle, start.q.fore) = (0.7, 0.4);
    start.v.swing = 1.0;
    let start = Projection::default().project(&model, 0.0, &start).unwrap().state;
    let input = snakeboard::Input { twist: 0.3, steer: -0.02 };
    let (end, _) = Integrator::adaptive(Dop853, 1e-13, 1e-13)
        .integrate(&system, 0.0, 2.0, &start, &input, |t, state| {
            let out = model.outputs(t, state, &input);
            for (force, steered) in out.forces.iter().zip([state.q.fore, -state.q.fore]) {
                let heading = state.q.plane.angle + steered;
                let along = Vector3::new(heading.cos(), heading.sin(), 0.0);
                assert!(force.dot(&along).abs() < 1e-13 * (1.0 + force.amax()) && force.z.abs() < 1e-15);
            }
        })
        .unwrap();
    let [before, after] = [&start, &end].map(|state| model.outputs(0.0, state, &input).energy);
    let work = input.twist * (end.q.swing - start.q.swing) + input.steer * (end.q.fore - start.q.fore);
    assert!((after - before - work).abs() < 1e-12 * after.max(1.0), "{} {work}", after - before);
    let way = (end.q.plane.x - start.q.plane.x).hypot(end.q.plane.y - start.q.plane.y);
    assert!(way > 0.03, "{way}");
}
