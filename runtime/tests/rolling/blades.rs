//! Equations of velocities with multipliers: a disc and a sphere against closed solutions, joints, loops, starts.

use multibody::nalgebra::{SVector, Unit, UnitQuaternion, Vector3};
use multibody::{
    Dop853, IntegrationError, Integrator, Projection, Twist, WithProjection, constrained_equilibrium, multibody,
};

multibody! {
    /// A blade along a body.
    pub mod sled {
        body sled { mass: 2.0, com: 0.3 * X, inertia: diag(0.3, 0.3, 0.5) }
        joint plane: Planar { parent: ground, child: sled, axis: Z }
        constraint blade = sled.express(sled.velocity).y;
        emit forward_dynamics;
    }
    /// A thin disc on a plane.
    pub mod disc {
        const R = 0.25;
        world { gravity: -9.81 * Z }
        body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
        joint float: Free { parent: ground, child: disc }
        let axle = disc.at(Y).position - disc.position;
        let low = (axle * axle.z - Z) * (R / sqrt(1 - axle.z * axle.z));
        let slip = disc.velocity + cross(disc.angular_velocity, low);
        constraint touch = disc.position.z + low.z;
        constraint along = slip.x;
        constraint across = slip.y;
        output energy = kinetic() + potential();
        emit forward_dynamics, derivatives, constraints;
    }
    /// Two bodies on oblique axes, each behind a blade, one of which is moved to and fro.
    pub mod trailer {
        param tilt = 0.3;
        world { gravity: [0.1, -0.3, -9.7] }
        body chassis { mass: 3.0, com: [0.2, 0.1, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint plane: Planar { parent: ground, child: chassis, axis: [0.2, 0.1, 1.0] }
        body arm { mass: 0.7, com: [0.1, 0.02, 0.0], inertia: inertia(0.03, 0.02, 0.03, 0.001, 0.002, -0.003) }
        joint hinge: Revolute { parent: chassis.at([0.5, 0.0, 0.1]).rotated(X, tilt), child: arm, axis: Z }
        constraint blade = chassis.express(chassis.velocity).y - 0.3 * hinge.rate;
        constraint nose = arm.express(arm.at([0.3, 0.1, 0.0]).velocity).y + 0.1 * cos(t);
        output moved = arm.at([0.1, 0.02, 0.0]).acceleration;
        output turned = arm.angular_acceleration;
        output turning = arm.angular_velocity;
        output rotation = arm.rotation;
        output load = hinge.reaction;
        output chassis_pose = chassis.pose;
        output arm_pose = arm.pose;
        output chassis_twist = chassis.twist;
        output arm_twist = arm.twist;
        emit forward_dynamics, derivatives, constraints, residual, bias, mass_matrix, inverse_dynamics;
    }
    /// The same in absolute coordinates.
    pub mod apart {
        param tilt = 0.3;
        world { gravity: [0.1, -0.3, -9.7] }
        body chassis { mass: 3.0, com: [0.2, 0.1, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint plane: Planar { parent: ground, child: chassis, axis: [0.2, 0.1, 1.0] }
        body arm { mass: 0.7, com: [0.1, 0.02, 0.0], inertia: inertia(0.03, 0.02, 0.03, 0.001, 0.002, -0.003) }
        joint hinge: Revolute { parent: chassis.at([0.5, 0.0, 0.1]).rotated(X, tilt), child: arm, axis: Z }
        constraint blade = chassis.express(chassis.velocity).y - 0.3 * hinge.rate;
        constraint nose = arm.express(arm.at([0.3, 0.1, 0.0]).velocity).y + 0.1 * cos(t);
        output moved = arm.at([0.1, 0.02, 0.0]).acceleration;
        output turned = arm.angular_acceleration;
        output turning = arm.angular_velocity;
        output rotation = arm.rotation;
        output load = hinge.reaction;
        formulation { coordinates: Absolute(Quaternion), constraints: Multipliers }
        emit forward_dynamics, derivatives, constraints;
    }
    /// A slider-crank's rod, by its length, and by the rate of that.
    pub mod by_length {
        world { gravity: [0.1, -9.7, 0.3] }
        body crank { mass: 1.1, com: [0.1, 0.02, 0.03], inertia: inertia(0.03, 0.04, 0.05, 0.001, 0.002, -0.003) }
        joint turn: Revolute { parent: ground.rotated(X, 0.2), child: crank, axis: [0.1, 0.2, 1.0] }
        body slider { mass: 0.8, inertia: diag(0.01, 0.01, 0.01) }
        joint slide: Prismatic { parent: ground.at([0.1, 0.2, 0.1]), child: slider, axis: [1.0, 0.3, -0.2] }
        let way = crank.at([0.3, 0.1, 0.05]).position - slider.at([0.05, 0.0, 0.02]).position;
        constraint rod = 0.5 * dot(way, way) - 0.245;
        output load = turn.reaction;
        emit forward_dynamics, derivatives, impulse, constraints;
        formulation { constraints: Multipliers }
    }
    pub mod by_rate {
        world { gravity: [0.1, -9.7, 0.3] }
        body crank { mass: 1.1, com: [0.1, 0.02, 0.03], inertia: inertia(0.03, 0.04, 0.05, 0.001, 0.002, -0.003) }
        joint turn: Revolute { parent: ground.rotated(X, 0.2), child: crank, axis: [0.1, 0.2, 1.0] }
        body slider { mass: 0.8, inertia: diag(0.01, 0.01, 0.01) }
        joint slide: Prismatic { parent: ground.at([0.1, 0.2, 0.1]), child: slider, axis: [1.0, 0.3, -0.2] }
        let way = crank.at([0.3, 0.1, 0.05]).position - slider.at([0.05, 0.0, 0.02]).position;
        constraint rod = dot(way, crank.at([0.3, 0.1, 0.05]).velocity - slider.at([0.05, 0.0, 0.02]).velocity);
        output load = turn.reaction;
        emit forward_dynamics, derivatives, impulse, constraints;
        formulation { constraints: Multipliers }
    }
    /// A sled whose blade a loop of four bars steers, in the crank's angle, and with all equations.
    pub mod in_the_crank {
        world { gravity: [0.1, -0.2, -9.7] }
        body sled { mass: 3.0, com: [0.2, 0.1, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint plane: Planar { parent: ground, child: sled, axis: [0.2, 0.1, 1.0] }
        body crank { mass: 0.3, com: 0.05 * X, inertia: diag(0.01, 0.01, 0.01) }
        body coupler { mass: 0.4, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.02) }
        body rocker { mass: 0.5, com: [0.1, 0.03, 0.0], inertia: diag(0.03, 0.02, 0.04) }
        joint one: Revolute { parent: sled.rotated(X, 0.3), child: crank, axis: Z }
        joint two: Revolute { parent: crank.at(0.15 * X), child: coupler, axis: Z }
        joint three: Revolute { parent: sled.rotated(X, 0.3).at(0.5 * X), child: rocker, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(0.45 * X), child: rocker.at(0.3 * X), axis: Z }
        solve (two, three) from pin { sin(three - one - two) > 0.0 }
        constraint blade = rocker.express(rocker.velocity).y + 0.2 * two.rate - 0.1 * sin(t);
        output angles = [two, three];
        output rates = [two.rate, three.rate];
        let load = three.reaction.express(sled.rotated(X, 0.3)).force;
        output load = [load.x, load.y];
        output cut = blade.multiplier;
        emit forward_dynamics, derivatives;
        formulation { independent: [plane, one], constraints: Reduced }
    }
    pub mod in_all {
        world { gravity: [0.1, -0.2, -9.7] }
        body sled { mass: 3.0, com: [0.2, 0.1, 0.05], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint plane: Planar { parent: ground, child: sled, axis: [0.2, 0.1, 1.0] }
        body crank { mass: 0.3, com: 0.05 * X, inertia: diag(0.01, 0.01, 0.01) }
        body coupler { mass: 0.4, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.02) }
        body rocker { mass: 0.5, com: [0.1, 0.03, 0.0], inertia: diag(0.03, 0.02, 0.04) }
        joint one: Revolute { parent: sled.rotated(X, 0.3), child: crank, axis: Z }
        joint two: Revolute { parent: crank.at(0.15 * X), child: coupler, axis: Z }
        joint three: Revolute { parent: sled.rotated(X, 0.3).at(0.5 * X), child: rocker, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(0.45 * X), child: rocker.at(0.3 * X), axis: Z }
        constraint blade = rocker.express(rocker.velocity).y + 0.2 * two.rate - 0.1 * sin(t);
        let load = three.reaction.express(sled.rotated(X, 0.3)).force;
        output load = [load.x, load.y];
        emit forward_dynamics, constraints;
        formulation { constraints: Multipliers }
    }
    /// A solid sphere on a plane that turns about the vertical through the origin.
    pub mod sphere {
        const R = 0.2;
        /// [rad/s]
        param turning = 1.7;
        world { gravity: -9.81 * Z }
        body ball { mass: 1.3, inertia: diag(0.4 * 1.3 * R * R, 0.4 * 1.3 * R * R, 0.4 * 1.3 * R * R) }
        joint float: Free { parent: ground, child: ball }
        let slip = ball.velocity + cross(ball.angular_velocity, -R * Z) - cross(turning * Z, ball.position);
        constraint touch = ball.position.z - R;
        constraint along = slip.x;
        constraint across = slip.y;
        emit forward_dynamics, derivatives, constraints;
    }
}

/// (C + m r^2) w W cos p - A W^2 sin p cos p + m g r sin p = 0 for the rate W of the heading, the lean p and the whole spin w.
#[test]
fn a_disc_on_its_circle() {
    let model = disc::Model::<f64>::default();
    let (m, r, a, c, g, lean, heading) = (0.7, 0.25, 0.011, 0.0219, 9.81, 0.6_f64, 2.1);
    let (sin, cos) = lean.sin_cos();
    let spin = (a * heading * heading * sin * cos - m * g * r * sin) / ((c + m * r * r) * heading * cos);
    assert!((spin + 8.320_466_103_334_473).abs() < 1e-14);
    // The reference has its z axis down: its lean about x is one about -x here, its heading one about -z; y points to the left.
    for yaw in [0.0, 2.4] {
        for turned in [0.0, 1.1, 7.0] {
            let about =
                |axis: Vector3<f64>, angle: f64| UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), angle);
            let upright = about(Vector3::z(), yaw) * about(Vector3::x(), lean);
            let mut state = disc::State::<f64>::default();
            let axle = upright * Vector3::y();
            // Angular velocity: heading about -z, and spin about the axle such that the whole share along it is -w.
            let vertical = Vector3::z() * -heading;
            let along = -spin;
            let omega = vertical + axle * (along - vertical.dot(&axle));
            let low = (axle * axle.z - Vector3::z()) * (r / (1.0 - axle.z * axle.z).sqrt());
            state.q.float.position = Vector3::new(0.3, -0.4, -low.z);
            state.q.float.orientation = upright * about(Vector3::y(), turned);
            state.v.float.linear = low.cross(&omega);
            state.v.float.angular = state.q.float.orientation.inverse() * omega;
            assert!(model.constraints(0.0, &state.q).amax() < 1e-15);
            assert!(model.constraint_rate(0.0, &state).amax() < 1e-14);
            let found = model.forward_dynamics(0.0, &state, &());
            // In steady motion all turns about the vertical together: the angular velocity changes by W x w, the velocity too.
            let change = state.q.float.orientation * found.v.float.angular;
            let wanted = vertical.cross(&omega);
            assert!((change - wanted).amax() < 1e-12, "{change} {wanted}");
            let wanted = vertical.cross(&state.v.float.linear);
            assert!((found.v.float.linear - wanted).amax() < 1e-12);
        }
    }
}

/// Its centre runs on a circle at two sevenths of the rate of the plane, about a point that the start sets.
#[test]
fn a_sphere_on_a_turning_plane() {
    let model = sphere::Model::<f64>::default();
    let system = WithProjection::new(model, Projection::default());
    let (r, turning) = (0.2, 1.7);
    let mut start = sphere::State::<f64>::default();
    start.q.float.position = Vector3::new(0.5, 0.2, r);
    start.q.float.orientation = UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0);
    start.v.float.linear = Vector3::new(0.3, -0.2, 0.0);
    // w x (-r z) = plane - v, that is w = z x (plane - v) / -r for the share across z.
    let plane = Vector3::z().cross(&start.q.float.position) * turning;
    let omega = Vector3::z().cross(&(plane - start.v.float.linear)) / -r + Vector3::z() * 0.7;
    start.v.float.angular = start.q.float.orientation.inverse() * omega;
    assert!(model.constraint_rate(0.0, &start).amax() < 1e-14);
    let rate = 2.0 / 7.0 * turning;
    let end =
        Integrator::adaptive(Dop853, 1e-13, 1e-13).integrate(&system, 0.0, 9.0, &start, &(), |_, _| ()).unwrap().0;
    // v' = rate z x v.
    let centre = start.q.float.position + Vector3::z().cross(&start.v.float.linear) / rate;
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), rate * 9.0);
    let wanted = centre + turn * (start.q.float.position - centre);
    assert!((end.q.float.position - wanted).amax() < 1e-10, "{} {wanted}", end.q.float.position);
    assert!((end.v.float.linear - turn * start.v.float.linear).amax() < 1e-10);
}

/// Newton and Euler of the arm alone: what the joint does and what the blade does move it.
#[test]
fn what_acts_on_bodies_loads_their_joints() {
    let model = trailer::Model::<f64>::new(&trailer::Params { tilt: 0.43 });
    for k in 0..8 {
        let x = f64::from(k);
        let mut state = trailer::State::<f64>::default();
        state.q.plane.x = 0.3 - 0.2 * x;
        state.q.plane.y = 0.1 * x;
        state.q.plane.angle = 2.0 * x - 5.0;
        state.q.hinge = 1.3 * x - 2.0;
        state.v.plane.x = 0.7 - 0.3 * x;
        state.v.plane.y = -0.4 + 0.2 * x;
        state.v.plane.angle = 1.1 - 0.7 * x;
        state.v.hinge = -0.6 + 0.5 * x;
        let t = 0.37 * x;
        let found = model.forward_dynamics(t, &state, &());
        assert_eq!(found.rank, 2.0);
        let out = model.outputs(t, &state, &());
        let gravity = Vector3::new(0.1, -0.3, -9.7);
        let blade = out.rotation * Vector3::y() * -found.multipliers[1];
        let force = out.load.force + blade + gravity * 0.7;
        assert!((force - out.moved * 0.7).amax() < 1e-11, "{k}: {force} {}", out.moved * 0.7);
        // About the centre of mass; the hinge exerts no moment about its axis but what the other blade asks of its rate.
        let inertia = multibody::nalgebra::Matrix3::new(0.03, 0.001, 0.002, 0.001, 0.02, -0.003, 0.002, -0.003, 0.03);
        let world = out.rotation.into_inner() * inertia * out.rotation.inverse().into_inner();
        let com = out.rotation * Vector3::new(0.1, 0.02, 0.0);
        let at = out.rotation * Vector3::new(0.3, 0.1, 0.0);
        let moment = out.load.moment - com.cross(&out.load.force) + (at - com).cross(&blade);
        let wanted = world * out.turned + out.turning.cross(&(world * out.turning));
        assert!((moment - wanted).amax() < 1e-11, "{k}: {moment} {wanted}");
        let about = (out.rotation * Vector3::z()).dot(&out.load.moment);
        assert!((about - 0.3 * found.multipliers[0]).abs() < 1e-11, "{about} {}", found.multipliers[0]);
    }
}

/// The rate of a constraint of positions says the same of accelerations, forces and jumps.
#[test]
fn a_rate_that_integrates() {
    let one = by_length::Model::<f64>::default();
    let other = by_rate::Model::<f64>::default();
    for k in 0..6 {
        let mut state = by_length::State::<f64>::default();
        state.q.turn = 0.9 * f64::from(k) - 2.0;
        state.q.slide = 0.4 - 0.3 * f64::from(k);
        state.v.turn = 1.3 - f64::from(k);
        state.v.slide = 0.2 + 0.7 * f64::from(k);
        let mut same = by_rate::State::<f64>::default();
        (same.q.turn, same.q.slide, same.v.turn, same.v.slide) =
            (state.q.turn, state.q.slide, state.v.turn, state.v.slide);
        let (a, b) = (one.forward_dynamics(0.0, &state, &()), other.forward_dynamics(0.0, &same, &()));
        assert!((a.v.turn - b.v.turn).abs() < 1e-12 * (1.0 + a.v.turn.abs()));
        assert!((a.v.slide - b.v.slide).abs() < 1e-12 * (1.0 + a.v.slide.abs()));
        assert!((a.multipliers - b.multipliers).amax() < 1e-12 * (1.0 + a.multipliers.amax()));
        let (c, d) = (one.outputs(0.0, &state, &()).load, other.outputs(0.0, &same, &()).load);
        assert!((c.force - d.force).amax() + (c.moment - d.moment).amax() < 1e-11 * (1.0 + c.force.amax()));
        let (c, d) = (one.forward_derivatives(0.0, &state, &()), other.forward_derivatives(0.0, &same, &()));
        assert!(
            (c.position - d.position).amax() + (c.velocity - d.velocity).amax() < 1e-11 * (1.0 + c.position.amax())
        );
        assert!((one.constraint_rate(0.0, &state) - other.constraint_rate(0.0, &same)).amax() < 1e-14);
        assert_eq!(other.constraints(0.0, &same.q).amax(), 0.0);
        // A blow, and a rate that is given to the rod.
        let (blow, rate) = (by_length::Velocity { turn: 0.3, slide: -1.1 }, SVector::from([0.2]));
        let (c, d) = (
            one.impulse(&state.q, &blow, &rate),
            other.impulse(&same.q, &by_rate::Velocity { turn: 0.3, slide: -1.1 }, &rate),
        );
        assert!((c.v.turn - d.v.turn).abs() + (c.v.slide - d.v.slide).abs() < 1e-12);
        assert!((other.constraint_jacobian(0.0, &same.q) * SVector::from([d.v.turn, d.v.slide]) - rate).amax() < 1e-12);
    }
}

/// A loop that is solved and one that is held move the same blade.
#[test]
fn beside_a_loop() {
    let reduced = in_the_crank::Model::<f64>::default();
    let held = in_all::Model::<f64>::default();
    for k in 0..6 {
        let x = f64::from(k);
        let t = 0.4 * x;
        // The blade leaves three velocities of four.
        let mut state = in_the_crank::State::<f64>::default();
        (state.q.plane.x, state.q.plane.y, state.q.plane.angle, state.q.one) =
            (0.2 - x, 0.3 * x, 1.9 * x - 4.0, 1.1 * x - 3.0);
        (state.v.plane.x, state.v.plane.y, state.v.plane.angle) = (0.5 - 0.2 * x, 0.3, 0.7 * x - 1.0);
        let rates = reduced.position_rates(t, &state);
        let out = reduced.outputs(t, &state, &());
        let mut all = in_all::State::<f64>::default();
        (all.q.plane, all.v.plane, all.q.one, all.v.one) = (state.q.plane, state.v.plane, state.q.one, rates.one);
        [all.q.two, all.q.three] = out.angles;
        [all.v.two, all.v.three] = out.rates;
        assert!(held.constraints(t, &all.q).amax() < 1e-14 && out.angles.iter().all(|x| x.is_finite()));
        let (a, b) = (reduced.forward_dynamics(t, &state, &()), held.forward_dynamics(t, &all, &()));
        let apart = [a.v.plane.x - b.v.plane.x, a.v.plane.y - b.v.plane.y, a.v.plane.angle - b.v.plane.angle];
        assert!(apart.iter().all(|x| x.abs() < 1e-10), "{k}: {apart:?}");
        let [one, other]: [SVector<f64, 4>; 2] = [a.q.into(), rates.into()];
        assert!((one - other).amax() < 1e-12 * (1.0 + one.amax()));
        let last = b.multipliers.len() - 1;
        assert!((out.cut - b.multipliers[last]).abs() < 1e-10 * (1.0 + out.cut.abs()));
        // What the four bars share across their plane is not determined.
        let [one, other] = [out.load, held.outputs(t, &all, &()).load];
        assert!((0..2).all(|k| (one[k] - other[k]).abs() < 1e-9), "{one:?} {other:?}");
    }
}

/// Absolute coordinates, in which joints are equations and the rate of the hinge is measured.
#[test]
fn in_absolute_coordinates() {
    let relative = trailer::Model::<f64>::new(&trailer::Params { tilt: 0.43 });
    let absolute = apart::Model::<f64>::new(&apart::Params { tilt: 0.43 });
    for k in 0..6 {
        let x = f64::from(k);
        let mut state = trailer::State::<f64>::default();
        (state.q.plane.x, state.q.plane.y, state.q.plane.angle, state.q.hinge) =
            (0.3 - 0.2 * x, 0.1 * x, 2.0 * x - 5.0, 1.3 * x - 2.0);
        (state.v.plane.x, state.v.plane.y, state.v.plane.angle, state.v.hinge) =
            (0.7 - 0.3 * x, 0.2 * x, 1.1 - 0.7 * x, 0.5 * x - 0.6);
        let t = 0.37 * x;
        let out = relative.outputs(t, &state, &());
        let mut other = apart::State::<f64>::default();
        (other.q.chassis, other.q.arm) = (out.chassis_pose, out.arm_pose);
        let (chassis, arm) = (out.chassis_twist, out.arm_twist);
        (other.v.chassis.linear, other.v.arm.linear) = (chassis.linear, arm.linear);
        other.v.chassis.angular = other.q.chassis.orientation.inverse() * chassis.angular;
        other.v.arm.angular = other.q.arm.orientation.inverse() * arm.angular;
        assert!(absolute.constraints(t, &other.q).amax() < 1e-14);
        let gaps = (absolute.constraint_rate(t, &other), relative.constraint_rate(t, &state));
        let same = absolute.outputs(t, &other, &());
        assert!((out.moved - same.moved).amax() < 1e-9, "{k}: {} {} {gaps:?}", out.moved, same.moved);
        assert!((out.turned - same.turned).amax() < 1e-9);
        assert!((out.load.force - same.load.force).amax() < 1e-9, "{k}: {} {}", out.load.force, same.load.force);
        assert!((out.load.moment - same.load.moment).amax() < 1e-9, "{k}: {} {}", out.load.moment, same.load.moment);
    }
}

/// On a plane that turns a sphere is nowhere at rest; on one that stands it is.
#[test]
fn rest_on_what_moves() {
    let at = |turning: f64| {
        let model = sphere::Model::<f64>::new(&sphere::Params { turning });
        let mut guess = sphere::State::<f64>::default();
        guess.q.float.position = Vector3::new(0.3, 0.1, 0.2);
        let free = sphere::Velocity { float: Twist { linear: Vector3::repeat(1.0), angular: Vector3::repeat(1.0) } };
        constrained_equilibrium(&model, 0.0, &guess, &(), &free)
    };
    assert!(at(0.0).is_ok());
    assert!(at(1.7).is_err());
}

/// A start that slips is no start.
#[test]
fn a_start_that_slips() {
    let model = sled::Model::<f64>::default();
    let mut start = sled::State::<f64>::default();
    start.q.plane.angle = 0.4;
    start.v.plane.x = 0.5;
    let end = Integrator::fixed(Dop853, 0.01).integrate(&model, 0.0, 0.1, &start, &(), |_, _| ());
    assert!(matches!(end, Err(IntegrationError::OpenVelocities { .. })), "{end:?}");
    // Projected, it keeps what it has along the blade.
    let kept = Projection::default().project(&model, 0.0, &start).unwrap().state;
    let wanted = Vector3::new(0.4_f64.cos(), 0.4_f64.sin(), 0.0) * (0.5 * 0.4_f64.cos());
    let found = Vector3::new(kept.v.plane.x, kept.v.plane.y, kept.v.plane.angle);
    assert!((found - wanted).amax() < 1e-14 && kept.q == start.q);
    assert!(Integrator::fixed(Dop853, 0.01).integrate(&model, 0.0, 0.1, &kept, &(), |_, _| ()).is_ok());
}
