//! A sleigh, a car on four wheels and a closed chain in all ways: with multipliers and reduced, in rates and in speeds, the same motion.

use multibody::projection::{SeparateWeights, assemble_by};
use multibody::{
    Configuration, Constrained, Dop853, EquilibriumError, Integrator, Projection, System, Tangent, WithProjection,
    constrained_equilibrium, multibody,
};

use crate::speeds::{Random, agree, derivatives_are_slopes, flat, projections_agree, with_rates};

four_ways!([sleigh_held, sleigh, sleigh_chosen, sleigh_beside], [plane], {
    /// [m]
    param ahead = 0.3;
    world { gravity: [0.4, -0.7, -9.0] }
    body sled { mass: 2.0, com: [ahead, 0.05, 0.1], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
    joint plane: Planar { parent: ground.rotated([1.0, 0.4, 0.2], 0.3), child: sled, axis: [0.1, -0.2, 1.0] }
    let blade_axes = sled.rotated(Z, 0.4);
    constraint blade = blade_axes.express(sled.velocity).y;
    output moved = [sled.acceleration, sled.angular_acceleration];
    output forces = [plane.reaction.force, plane.reaction.moment];
    output energy = kinetic() + potential();
}, {
    /// [m/s]
    speed along = blade_axes.express(sled.velocity).x;
    /// [rad/s]
    speed turning = 0.5 * plane.angle.rate - 0.1 * blade_axes.express(sled.velocity).x;
}, {
    /// [m/s]
    speed across = blade_axes.express(sled.velocity).y;
});

four_ways!([car_held, car, car_chosen, car_beside], [], {
    const TRACK = 0.8;
    const BASE = 1.3;
    const R = 0.3;
    body chassis { mass: 20.0, com: [0.6, 0.03, 0.2], inertia: diag(2.0, 3.0, 4.0) }
    body left { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
    body right { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
    body left_fork { mass: 0.5, inertia: diag(0.02, 0.03, 0.02) }
    body right_fork { mass: 0.5, inertia: diag(0.02, 0.03, 0.02) }
    body left_front { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
    body right_front { mass: 1.0, inertia: diag(0.02, 0.03, 0.02) }
    joint plane: Planar { parent: ground.at(R * Z), child: chassis, axis: Z }
    joint spin_left: Revolute { parent: chassis.at([0.0, 0.5 * TRACK, 0.0]), child: left, axis: Y }
    joint spin_right: Revolute { parent: chassis.at([0.0, -0.5 * TRACK, 0.0]), child: right, axis: Y }
    joint steer_left: Revolute { parent: chassis.at([BASE, 0.5 * TRACK, 0.0]), child: left_fork, axis: Z }
    joint steer_right: Revolute { parent: chassis.at([BASE, -0.5 * TRACK, 0.0]), child: right_fork, axis: Z }
    joint roll_left: Revolute { parent: left_fork, child: left_front, axis: Y }
    joint roll_right: Revolute { parent: right_fork, child: right_front, axis: Y }
    input push;
    input turn;
    force motor: Effort { joint: spin_left, value: push }
    force wheel: Effort { joint: steer_left, value: turn }
    // cot(right) - cot(left) = TRACK / BASE, where the left wheel is the inner one.
    constraint steering = sin(steer_left - steer_right) * BASE - TRACK * sin(steer_left) * sin(steer_right);
    constraint rear_left: Rolling { wheel: left, axis: Y, radius: R }
    constraint rear_right: Rolling { wheel: right, axis: Y, radius: R }
    constraint front_left: Rolling { wheel: left_front, axis: Y, radius: R }
    constraint front_right: Rolling { wheel: right_front, axis: Y, radius: R }
    output moved = [chassis.acceleration, left_front.angular_acceleration, right.angular_acceleration, right_fork.angular_acceleration];
    output slips = [rear_left.slip, rear_right.slip, front_left.slip, front_right.slip];
    output energy = kinetic();
}, {
    /// [m/s]
    speed ahead = chassis.express(chassis.velocity).x;
    /// [rad/s]
    speed steered = steer_left.rate + 0.2 * chassis.express(chassis.velocity).x;
}, {
    /// [m/s]
    speed aside = chassis.express(chassis.velocity).y;
    /// [rad/s]
    speed yaw = plane.angle.rate + 0.1 * steer_right.rate;
    /// [rad/s]
    speed rolled = roll_left.rate - roll_right.rate;
    /// [rad/s]
    speed toe = steer_right.rate - 0.5 * steer_left.rate;
    /// [rad/s]
    speed ran = roll_left.rate + 0.5 * roll_right.rate + spin_left.rate;
    /// [rad/s]
    speed spun = spin_left.rate;
});

/// One mechanism that keeps its equations, in rates and in speeds.
macro_rules! two_ways {
    ($held:ident: [$($of_held:tt)*], $beside:ident: [$($of_beside:tt)*], { $($items:tt)* }, { $($speeds:tt)* }) => {
        multibody! {
            pub(crate) mod $held {
                $($items)*
                formulation { constraints: Multipliers }
                emit $($of_held)*;
            }
            pub(crate) mod $beside {
                $($items)*
                $($speeds)*
                formulation { constraints: Multipliers }
                emit $($of_beside)*;
            }
        }
    };
}

// A spatial four-bar linkage on oblique axes, whose rod ends in two balls, on a base that is pulled along a rail; in speeds that time moves
// too.
two_ways!(chain_held: [forward_dynamics, derivatives, impulse], chain: [
    forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize, impulse
], {
    param reach = 0.7;
    world { gravity: [0.3, -9.7, -1.2] }
    body base { mass: 4.0, com: [0.1, 0.0, 0.02], inertia: diag(0.1, 0.1, 0.1) }
    body crank { mass: 1.0, com: [0.15, 0.01, 0.0], inertia: inertia(0.01, 0.02, 0.02, 0.001, 0.0, -0.001) }
    body rod { mass: 0.6, com: [0.0, 0.3, 0.02], inertia: diag(0.02, 0.01, 0.02) }
    body rocker { mass: 1.5, com: [0.25, 0.02, 0.0], inertia: inertia(0.02, 0.04, 0.05, 0.0, 0.003, 0.001) }
    joint rail: Prismatic { parent: ground, child: base, axis: [1.0, 0.2, -0.1] }
    joint a: Revolute { parent: base, child: crank, axis: [0.1, 0.2, 1.0] }
    joint d: Revolute { parent: base.at([reach, 0.1, -0.2]), child: rocker, axis: [0.3, -0.1, 1.0] }
    joint b: Ball { parent: crank.at([0.3, 0.0, 0.05]), child: rod }
    joint c: Ball { parent: rod.at([0.0, 0.75, 0.0]), child: rocker.at([0.5, 0.05, 0.0]) }
    input pull;
    force hand: Effort { joint: rail, value: pull }
    force back: SpringDamper { joint: rail, stiffness: 60.0, damping: 2.0 }
    output moved = [rod.acceleration, rod.angular_acceleration, rocker.angular_acceleration, base.acceleration];
    output forces = [c.reaction.force, d.reaction.moment];
    output energy = kinetic() + potential();
}, {
    /// [rad/s]
    param moved_by = 0.2;
    /// [rad/s]
    speed turned_x = rod.angular_velocity.x;
    /// [rad/s]
    speed turned_y = rod.angular_velocity.y + moved_by * sin(t);
    /// [rad/s]
    speed turned_z = rod.angular_velocity.z;
    /// [rad/s]
    speed rocked = d.rate + 0.4 * sin(a) * a.rate - 2.0 * rail.rate;
    /// [m/s]
    speed along = rail.rate + 0.3 * a.rate;
    /// [rad/s]
    speed cranked = (1.3 + cos(a)) * a.rate;
});

// A plate on three legs with balls at both ends, in absolute coordinates: so many equations that projections go by their zeros.
two_ways!(plate_held: [forward_dynamics, impulse], plate: [forward_dynamics, impulse], {
    world { gravity: [0.3, -0.7, -9.2] }
    body top { mass: 3.0, com: [0.01, 0.02, 0.1], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03), coordinates: Absolute(Quaternion) }
    body one { mass: 0.3, com: [0.0, 0.02, 0.4], inertia: diag(0.02, 0.02, 0.005) }
    body two { mass: 0.3, com: [0.0, 0.0, 0.4], inertia: diag(0.02, 0.02, 0.005) }
    body three { mass: 0.4, com: [0.01, 0.0, 0.4], inertia: diag(0.02, 0.02, 0.005) }
    joint foot_one: Ball { parent: ground.at([1.0, 0.0, 0.0]), child: one }
    joint foot_two: Ball { parent: ground.at([-0.505, 0.863, 0.1]), child: two }
    joint foot_three: Ball { parent: ground.at([-0.49, -0.872, 0.0]), child: three }
    joint end_one: Ball { parent: one.at([0.0, 0.0, 1.1]), child: top.at([0.6, 0.0, 0.0]) }
    joint end_two: Ball { parent: two.at([0.0, 0.0, 1.0]), child: top.at([-0.3, 0.55, 0.0]) }
    joint end_three: Ball { parent: three.at([0.0, 0.0, 1.05]), child: top.at([-0.35, -0.5, 0.05]) }
    output moved = [top.acceleration, top.angular_acceleration, two.angular_acceleration];
    output forces = [end_one.reaction.force, foot_three.reaction.force];
}, {
    /// [rad/s]
    speed turning_x = top.angular_velocity.x;
    /// [rad/s]
    speed turning_y = top.angular_velocity.y - 0.1 * top.velocity.x;
    /// [rad/s]
    speed turning_z = top.angular_velocity.z;
    /// [m/s]
    speed going_x = top.velocity.x + 0.3 * top.angular_velocity.y + 0.1 * t;
    /// [m/s]
    speed going_y = top.express(top.velocity).y;
    /// [m/s]
    speed going_z = top.velocity.z;
});

/// In four ways: at random poses, and along a run.
#[test]
fn a_sleigh() {
    let (held, reduced) = (sleigh_held::Model::<f64>::default(), sleigh::Model::<f64>::default());
    let (chosen, beside) = (sleigh_chosen::Model::<f64>::default(), sleigh_beside::Model::<f64>::default());
    assert_eq!((sleigh_held::DOF, sleigh::DOF, sleigh_chosen::DOF, sleigh_beside::DOF), (3, 2, 2, 3));
    let mut random = Random(5);
    for round in 0..20 {
        let mut other = sleigh_chosen::State::<f64>::default();
        other.q = other.q.displace(&random.vector::<sleigh_chosen::Rates>().scale(3.0));
        other.v = random.vector();
        let rates = chosen.position_rates(0.0, &other);
        let mut all = sleigh_held::State::<f64>::default();
        (all.q.plane, all.v.plane) = (other.q.plane, rates.plane);
        assert!(held.constraint_rate(0.0, &all).amax() < 1e-12);
        let same = held.outputs(0.0, &all, &());
        let wanted = [&same.moved[..], &same.forces[..]].concat();
        let out = chosen.outputs(0.0, &other, &());
        agree(&[&out.moved[..], &out.forces[..]].concat(), &wanted);
        let mut more = sleigh_beside::State::<f64>::default();
        more.q.plane = other.q.plane;
        let more = with_rates(&beside, 0.0, &more, &flat(&rates));
        assert!(more.v.across.abs() < 1e-12 && (more.v.along - other.v.along).abs() < 1e-12);
        let out = beside.outputs(0.0, &more, &());
        agree(&[&out.moved[..], &out.forces[..]].concat(), &wanted);
        derivatives_are_slopes(&beside, 0.0, &more, &());
        projections_agree(&mut random, 0.0, (&held, &all), (&beside, &more), true);
        if round >= 3 {
            continue;
        }
        let to = |q: &multibody::Planar<f64>| [q.x, q.y, q.angle];
        let run = Integrator::adaptive(Dop853, 1e-13, 1e-13);
        let wanted = to(&run.integrate(&chosen, 0.0, 1.0, &other, &(), |_, _| ()).unwrap().0.q.plane);
        let by_rates = WithProjection::new(held, Projection::default());
        let by_speeds = WithProjection::new(beside, Projection::default());
        let found = [
            to(&run.integrate(&by_rates, 0.0, 1.0, &all, &(), |_, _| ()).unwrap().0.q.plane),
            to(&run.integrate(&by_speeds, 0.0, 1.0, &more, &(), |_, _| ()).unwrap().0.q.plane),
        ];
        for ends in found {
            let apart = ends.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-10, "{ends:?} {wanted:?}");
        }
        // In rates of which the blade's axes know nothing there may be a pose without motion ahead.
        let mut state = sleigh::State::<f64>::default();
        state.q.plane = other.q.plane;
        let state = with_rates(&reduced, 0.0, &state, &flat(&rates));
        agree(&reduced.outputs(0.0, &state, &()).moved, &same.moved);
    }
}

/// Of sixteen equations seven are kept; two speeds are left. All four ways give one motion where the car heads anywhere.
#[test]
fn a_car() {
    let (held, reduced) = (car_held::Model::<f64>::default(), car::Model::<f64>::default());
    let (chosen, beside) = (car_chosen::Model::<f64>::default(), car_beside::Model::<f64>::default());
    assert_eq!((car_held::DOF, car_beside::DOF, car_chosen::DOF, car::DOF), (9, 9, 2, 2));
    let mut random = Random(6);
    for round in 0..8 {
        let mut all = car_held::State::<f64>::default();
        let inner: f64 = 0.45 + 0.2 * random.next();
        (all.q.steer_left, all.q.steer_right) = (inner, 1.0_f64.atan2(1.0 / inner.tan() + 0.8 / 1.3));
        all.q.plane = multibody::Planar { x: random.next(), y: random.next(), angle: 3.0 * random.next() };
        // Not so fast that a front wheel comes to stand across, where the car can't go ahead.
        all.v = random.vector::<car_held::Velocity>().scale(0.3);
        let all = Projection::default().project(&held, 0.0, &all).unwrap().state;
        let input = car_held::Input { push: random.next(), turn: 0.05 * random.next() };
        let out = held.outputs(0.0, &all, &input);
        let mut more = car_beside::State::<f64>::default();
        (more.q.plane, more.q.spin_left, more.q.spin_right) = (all.q.plane, all.q.spin_left, all.q.spin_right);
        (more.q.steer_left, more.q.steer_right) = (all.q.steer_left, all.q.steer_right);
        (more.q.roll_left, more.q.roll_right) = (all.q.roll_left, all.q.roll_right);
        let more = with_rates(&beside, 0.0, &more, &flat(&all.v));
        let same = beside.outputs(0.0, &more, &car_beside::Input { push: input.push, turn: input.turn });
        agree(&same.moved, &out.moved);
        assert!((same.energy - out.energy).abs() < 1e-12 * (1.0 + out.energy));
        assert!(more.v.aside.abs() < 1e-11);
        let input_beside = car_beside::Input { push: input.push, turn: input.turn };
        derivatives_are_slopes(&beside, 0.0, &more, &input_beside);
        projections_agree(&mut random, 0.0, (&held, &all), (&beside, &more), true);
        // Without the angle that the linkage gives.
        let mut rates = flat(&all.v);
        rates.remove(6);
        let mut other = car_chosen::State::<f64>::default();
        (other.q.plane, other.q.spin_left, other.q.spin_right) = (all.q.plane, all.q.spin_left, all.q.spin_right);
        (other.q.steer_left, other.q.roll_left, other.q.roll_right) =
            (all.q.steer_left, all.q.roll_left, all.q.roll_right);
        let input_chosen = car_chosen::Input { push: input.push, turn: input.turn };
        let other = with_rates(&chosen, 0.0, &chosen.accepted(0.0, &other, &input_chosen), &rates);
        agree(&chosen.outputs(0.0, &other, &input_chosen).moved, &out.moved);
        let mut state = car::State::<f64>::default();
        (state.q.plane, state.q.spin_left, state.q.spin_right) = (all.q.plane, all.q.spin_left, all.q.spin_right);
        (state.q.steer_left, state.q.roll_left, state.q.roll_right) =
            (all.q.steer_left, all.q.roll_left, all.q.roll_right);
        let input_reduced = car::Input { push: input.push, turn: input.turn };
        let state = with_rates(&reduced, 0.0, &reduced.accepted(0.0, &state, &input_reduced), &rates);
        agree(&reduced.outputs(0.0, &state, &input_reduced).moved, &out.moved);
        if round >= 2 {
            continue;
        }
        let run = Integrator::adaptive(Dop853, 1e-13, 1e-13);
        let by_rates = WithProjection::new(held, Projection::default());
        let by_speeds = WithProjection::new(beside, Projection::default());
        let three = run.integrate(&chosen, 0.0, 0.5, &other, &input_chosen, |_, _| ()).unwrap().0.q;
        let four = run.integrate(&reduced, 0.0, 0.5, &state, &input_reduced, |_, _| ()).unwrap().0.q;
        let one = run.integrate(&by_rates, 0.0, 0.5, &all, &input, |_, _| ()).unwrap().0.q;
        let two = run.integrate(&by_speeds, 0.0, 0.5, &more, &input_beside, |_, _| ()).unwrap().0.q;
        let apart = [
            one.plane.x - two.plane.x,
            one.plane.y - two.plane.y,
            one.plane.angle - two.plane.angle,
            one.roll_right - two.roll_right,
            one.steer_right - two.steer_right,
            one.plane.x - three.plane.x,
            one.plane.angle - three.plane.angle,
            one.spin_right - three.spin_right,
            one.plane.y - four.plane.y,
            one.steer_left - four.steer_left,
            one.roll_left - four.roll_left,
        ];
        assert!(apart.iter().all(|x| x.abs() < 1e-10), "{apart:?}");
    }
}

/// Loops of positions beside speeds: forces and accelerations are those in rates, wherever the chain stands.
#[test]
fn a_closed_chain() {
    let (held, chain) = (chain_held::Model::<f64>::default(), chain::Model::<f64>::default());
    assert_eq!((chain_held::DOF, chain::DOF), (6, 6));
    let mut random = Random(7);
    let mut seen = 0;
    for round in 0..30 {
        let t = 2.0 * random.next();
        let mut all = chain_held::State::<f64>::default();
        all.q = all.q.displace(&random.vector::<chain_held::Velocity>().scale(0.3));
        all.v = random.vector();
        let Ok(found) = Projection::default().project(&held, t, &all) else { continue };
        let all = found.state;
        seen += 1;
        let input = chain_held::Input { pull: random.next() };
        let out = held.outputs(t, &all, &input);
        let mut more = chain::State::<f64>::default();
        (more.q.rail, more.q.a, more.q.d, more.q.b) = (all.q.rail, all.q.a, all.q.d, all.q.b);
        let more = with_rates(&chain, t, &more, &flat(&all.v));
        let given = chain::Input { pull: input.pull };
        let same = chain.outputs(t, &more, &given);
        agree(&[&same.moved[..], &same.forces[..]].concat(), &[&out.moved[..], &out.forces[..]].concat());
        assert!((same.energy - out.energy).abs() < 1e-12 * (1.0 + out.energy.abs()));
        derivatives_are_slopes(&chain, t, &more, &given);
        projections_agree(&mut random, t, (&held, &all), (&chain, &more), false);
        assert!(!chain.opening(t, &more, &given).is_open());
        if round < 3 {
            let run = Integrator::adaptive(Dop853, 1e-13, 1e-13);
            let by_rates = WithProjection::new(held, Projection::default());
            let by_speeds = WithProjection::new(chain, Projection::default());
            let one = run.integrate(&by_rates, t, t + 0.4, &all, &input, |_, _| ()).unwrap().0.q;
            let two = run.integrate(&by_speeds, t, t + 0.4, &more, &given, |_, _| ()).unwrap().0.q;
            let apart = [one.rail - two.rail, one.a - two.a, one.d - two.d, one.b.angle_to(&two.b)];
            assert!(apart.iter().all(|x| x.abs() < 1e-10), "{apart:?}");
        }
        // A start off the loop, or one whose velocities open it, is told.
        let mut open = more;
        open.q.a += 0.01;
        assert!(chain.opening(t, &open, &given).is_open());
        open = more;
        open.v.rocked += 0.1;
        assert!(chain.opening(t, &open, &given).is_open());
    }
    assert!(seen > 20, "{seen}");
}

/// A large model: what corrects velocities by the zeros of the equations does what the general way does.
#[test]
fn a_plate_on_legs() {
    let (held, plate) = (plate_held::Model::<f64>::default(), plate::Model::<f64>::default());
    assert_eq!((plate::DOF, plate::CONSTRAINTS), (15, 9));
    let mut random = Random(8);
    let mut seen = 0;
    for _ in 0..20 {
        let t = 2.0 * random.next();
        let mut all = plate_held::State::<f64>::default();
        all.q.top.position.z = 1.0;
        all.q = all.q.displace(&random.vector::<plate_held::Velocity>().scale(0.2));
        all.v = random.vector();
        let Ok(found) = Projection::default().project(&held, t, &all) else { continue };
        let all = found.state;
        seen += 1;
        let out = held.outputs(t, &all, &());
        let mut more = plate::State::<f64>::default();
        (more.q.top, more.q.foot_one, more.q.foot_two, more.q.foot_three) =
            (all.q.top, all.q.foot_one, all.q.foot_two, all.q.foot_three);
        let more = with_rates(&plate, t, &more, &flat(&all.v));
        let same = plate.outputs(t, &more, &());
        agree(&[&same.moved[..], &same.forces[..]].concat(), &[&out.moved[..], &out.forces[..]].concat());
        projections_agree(&mut random, t, (&held, &all), (&plate, &more), false);
        let residual = random.vector();
        let (by_zeros, rank) = plate.least_velocity_correction(t, &more, &residual).unwrap();
        let ones = plate::Velocity::zero().map(&mut |_| 1.0);
        let (wanted, full) = plate.velocity_correction(t, &more, &residual, &ones);
        assert_eq!((rank, full), (9.0, 9.0));
        let size = flat(&wanted).iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let apart = flat(&by_zeros).iter().zip(flat(&wanted)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9 * size, "{apart} of {size}");
        assert!(plate.least_correction(t, &more, &residual).is_none());
    }
    assert!(seen > 10, "{seen}");
}

/// What finds states, on models in speeds beside multipliers: the same as in rates, and no rest where time moves what speeds stand for.
#[test]
fn a_closed_chain_is_assembled_and_rests() {
    let held = chain_held::Model::<f64>::default();
    let chain = chain::Model::<f64>::new(&chain::Params { moved_by: 0.0, ..Default::default() });
    let mut ones = |_: f64| 1.0;
    let mut guess = chain_held::State::<f64>::default();
    guess.q.a = 0.2;
    let found = multibody::assemble(&held, 0.0, &guess, &chain_held::Velocity::zero().map(&mut ones)).unwrap();
    let mut same = chain::State::<f64>::default();
    same.q.a = 0.2;
    let free = SeparateWeights {
        position: chain::Rates::zero().map(&mut ones),
        velocity: chain::Velocity::zero().map(&mut ones),
    };
    let again = assemble_by(&chain, 0.0, &same, &free).unwrap();
    let [one, two] = [
        [found.state.q.rail, found.state.q.a, found.state.q.d],
        [again.state.q.rail, again.state.q.a, again.state.q.d],
    ];
    assert!(one.iter().zip(&two).all(|(a, b)| (a - b).abs() < 1e-11), "{one:?} {two:?}");
    let free = chain_held::Velocity::zero().map(&mut ones);
    let rest =
        constrained_equilibrium(&held, 0.0, &found.state, &chain_held::Input { pull: 0.4 }, &free).unwrap().state;
    let free = chain::Rates::zero().map(&mut ones);
    let input = chain::Input { pull: 0.4 };
    // Of several such poses the one nearby.
    let mut near = again.state;
    (near.q.rail, near.q.a, near.q.d, near.q.b) = (rest.q.rail + 0.01, rest.q.a - 0.02, rest.q.d + 0.01, rest.q.b);
    let stands = constrained_equilibrium(&chain, 0.0, &near, &input, &free).unwrap().state;
    let [one, two] = [[rest.q.rail, rest.q.a, rest.q.d], [stands.q.rail, stands.q.a, stands.q.d]];
    assert!(one.iter().zip(&two).all(|(a, b)| (a - b).abs() < 1e-9), "{one:?} {two:?}");
    assert!(flat(&chain.forward_dynamics(0.0, &stands, &input).v).iter().all(|a| a.abs() < 1e-9));
    // The rod turns while its speed about y is zero, but for an instant.
    let moving = |t: f64| constrained_equilibrium(&chain::Model::default(), t, &near, &input, &free).map(|_| ());
    assert!(matches!(moving(0.0), Err(EquilibriumError::Leaving { .. })), "{:?}", moving(0.0));
    assert!(matches!(moving(0.3), Err(EquilibriumError::Open { .. })), "{:?}", moving(0.3));
}

/// Four lanes, and single precision.
#[test]
fn a_closed_chain_in_lanes_and_in_single_precision() {
    use multibody::Rk4;
    use multibody::simba::simd::{SimdValue, WideF64x4};
    let model = chain::Model::<f64>::default();
    let mut start = chain::State::<f64>::default();
    start.v.along = 0.3;
    let start = Projection::default().project(&model, 0.0, &start).unwrap().state;
    let input = chain::Input { pull: 0.7 };
    let by = Projection::default();
    let end = Rk4::integrate(&WithProjection::fixed(model, by), 0.0, &start, &input, 1e-3, 200, |_, _| ()).unwrap();
    let wide = chain::Model::<WideF64x4>::default();
    let mut lanes = chain::State::<WideF64x4>::default();
    lanes.v.along = WideF64x4::splat(0.3);
    let zero = WideF64x4::splat(0.0);
    let lanes = Projection::default().project(&wide, zero, &lanes).unwrap().state;
    let given = chain::Input { pull: WideF64x4::splat(0.7) };
    let step = WideF64x4::splat(1e-3);
    let found = Rk4::integrate(&WithProjection::fixed(wide, by), zero, &lanes, &given, step, 200, |_, _| ()).unwrap();
    for lane in 0..4 {
        assert!((found.q.a.extract(lane) - end.q.a).abs() < 1e-11, "{lane} {} {}", found.q.a.extract(lane), end.q.a);
    }
    let single = chain::Model::<f32>::default();
    let mut start = chain::State::<f32>::default();
    start.v.along = 0.3;
    let start = Projection::default().project(&single, 0.0, &start).unwrap().state;
    let given = chain::Input { pull: 0.7 };
    let found = Rk4::integrate(&WithProjection::fixed(single, by), 0.0, &start, &given, 1e-3, 200, |_, _| ()).unwrap();
    assert!((f64::from(found.q.a) - end.q.a).abs() < 1e-4, "{} {}", found.q.a, end.q.a);
}
