//! Closed chains in speeds, beside equations that keep multipliers: the same motion as in rates.

use multibody::projection::{SeparateWeights, assemble_by};
use multibody::{
    Configuration, Constrained, Dop853, EquilibriumError, Integrator, Projection, System, Tangent, WithProjection,
    constrained_equilibrium, multibody,
};

use crate::speeds::{Random, agree, derivatives_are_slopes, flat, projections_agree, with_rates};

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
