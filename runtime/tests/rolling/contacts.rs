//! `Contact` against closed solutions, conserved quantities and differences.

use multibody::nalgebra::{Rotation3, Unit, UnitQuaternion, Vector3};
use multibody::{Dop853, Integrator, Radau, multibody};

multibody! {
    /// A ball that falls on a plane without gravity: a bounce alone.
    pub mod bounce {
        param damping = 0.4;
        param exponent = 1.5;
        param stiffness = 2e5;
        body ball { mass: 0.7, inertia: sphere(0.7, 0.1) }
        joint rail: Prismatic { parent: ground, child: ball, axis: Z }
        force foot: Contact { at: ball, radius: 0.1, stiffness: stiffness, damping: damping, exponent: exponent }
        output gap = foot.gap;
        output stored = foot.stored;
        emit forward_dynamics, derivatives, energy;
    }
    /// A ball that is thrown along a slope.
    pub mod bowl {
        param friction = 0.3;
        world { gravity: [0.0, 0.0, -9.81] }
        body ball { mass: 1.3, inertia: sphere(1.3, 0.11) }
        joint float: Free { parent: ground, child: ball }
        force lane: Contact {
            at: ball, radius: 0.11, stiffness: 1e6, damping: 0.5, exponent: 1, friction: friction, slip_speed: 1e-3
        }
        output force = lane.force;
        output slip = lane.slip;
        emit forward_dynamics, derivatives;
    }
    /// Two balls, a disc and a point on a plate, all free: what they lose is what the contacts take.
    pub mod heap {
        body one { mass: 1.3, com: [0.01, 0.02, -0.01], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
        body two { mass: 0.9, com: [-0.02, 0.01, 0.01], inertia: inertia(0.02, 0.025, 0.03, 0.001, -0.002, 0.001) }
        body coin { mass: 0.4, inertia: diag(0.011, 0.0219, 0.011) }
        body plate { mass: 4.0, com: [0.1, -0.05, 0.02], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
        joint free_one: Free { parent: ground, child: one }
        joint free_two: Free { parent: ground, child: two }
        joint free_coin: Free { parent: ground, child: coin }
        joint free_plate: Free { parent: ground, child: plate }
        let top = plate.at([0.1, 0.2, 0.05]).rotated([1.0, 2.0, 3.0], 0.4);
        let hub = coin.rotated(X, 0.3).at([0.01, 0.02, 0.0]);
        force balls: Contact {
            at: one.at([0.01, 0.0, 0.02]), radius: 0.2, ball: two, ball_radius: 0.15,
            stiffness: 3e3, damping: 0.2, friction: 0.4, slip_speed: 0.05
        }
        force rim: Contact {
            at: hub, axis: [0.3, 2.0, -0.4], radius: 0.25, on: top,
            stiffness: 2e3, damping: 0.3, friction: 0.5, exponent: 2, slip_speed: 0.05
        }
        force tip: Contact {
            at: two.at([0.1, 0.1, -0.2]), on: top, stiffness: 1e3, damping: 0.3, friction: 0.5, slip_speed: 0.05
        }
        output momentum = linear_momentum();
        output turning = angular_momentum() + cross(centre_of_mass(), linear_momentum());
        output gaps = [balls.gap, rim.gap, tip.gap];
        output contact = rim.contact;
        output centre = hub.position;
        output axle = hub.rotation * [0.3, 2.0, -0.4];
        output normal = top.rotation * Z;
        output on = top.position;
        output powers = [balls.power, rim.power, tip.power];
        output forces = [balls.force, rim.force, tip.force];
        /// [J]
        state lost: rate = balls.power + rim.power + tip.power, start: 0;
        output energy = kinetic();
        emit forward_dynamics, derivatives;
    }
}

/// Between depth and its rate v stands v / c - ln(1 + c v) / c^2 + k / m x^(n + 1) / (n + 1) = constant.
#[test]
fn a_bounce() {
    for (damping, exponent, speed) in [(0.4, 1.5, 1.7), (1.3, 2.0, 0.8), (0.05, 1.0, 3.0), (0.0, 1.5, 2.0)] {
        let model = bounce::Model::<f64>::new(&bounce::Params { damping, exponent, stiffness: 2e5 });
        let mut start = bounce::State::<f64>::default();
        (start.q.rail, start.v.rail) = (0.1, -speed);
        // Long enough to come off again.
        let (end, _) =
            Integrator::adaptive(Dop853, 1e-12, 1e-12).integrate(&model, 0.0, 1.0, &start, &(), |_, _| ()).unwrap();
        assert!(end.q.rail > 0.1 && model.outputs(0.0, &end, &()).gap > 0.0);
        let level = |v: f64| {
            if damping == 0.0 { v * v / 2.0 } else { v / damping - (damping * v).ln_1p() / (damping * damping) }
        };
        let (before, after) = (level(speed), level(-end.v.rail));
        assert!((before / after - 1.0).abs() < 1e-9, "{damping} {exponent}: {before} {after}");
        assert!(damping == 0.0 || end.v.rail < 0.99 * speed);
        // Half way the elastic share is what the ball has lost.
        if damping == 0.0 {
            let integrator = Integrator::adaptive(Dop853, 1e-12, 1e-12);
            let (mid, _) = integrator.integrate(&model, 0.0, 5e-3, &start, &(), |_, _| ()).unwrap();
            let stored = model.outputs(0.0, &mid, &()).stored;
            let kinetic = |v: f64| 0.35 * v * v;
            assert!(stored > 0.1 && (stored + kinetic(mid.v.rail) - kinetic(speed)).abs() < 1e-10);
        }
    }
}

/// The implicit method goes through a bounce as the explicit one does.
#[test]
fn a_bounce_by_radau() {
    let model = bounce::Model::<f64>::default();
    let mut start = bounce::State::<f64>::default();
    (start.q.rail, start.v.rail) = (0.13, -1.0);
    let (one, _) =
        Integrator::adaptive(Dop853, 1e-12, 1e-12).integrate(&model, 0.0, 0.1, &start, &(), |_, _| ()).unwrap();
    let (other, _) =
        Integrator::adaptive(Radau, 1e-10, 1e-10).integrate(&model, 0.0, 0.1, &start, &(), |_, _| ()).unwrap();
    assert!((one.v.rail - other.v.rail).abs() < 1e-7 && (one.q.rail - other.q.rail).abs() < 1e-8, "{one:?} {other:?}");
}

/// Sliding slows down by friction alone; from 5/7 of the first speed on the ball rolls.
#[test]
fn a_ball_that_comes_to_roll() {
    let model = bowl::Model::<f64>::new(&bowl::Params { friction: 0.25 });
    let mut start = bowl::State::<f64>::default();
    start.q.float.position.z = 0.11 - 1.3 * 9.81 / 1e6;
    start.v.float.linear = Vector3::new(3.0, -4.0, 0.0);
    let integrator = Integrator::adaptive(Dop853, 1e-10, 1e-10);
    let (sliding, _) = integrator.integrate(&model, 0.0, 0.3, &start, &(), |_, _| ()).unwrap();
    let speed = sliding.v.float.linear.norm();
    // Less by the smoothing: one over the square of slip over slip speed.
    assert!((speed - (5.0 - 0.25 * 9.81 * 0.3)).abs() < 1e-5, "{speed}");
    // 2 v / (7 mu g) = 0.58 s
    let (rolling, _) = integrator.integrate(&model, 0.0, 1.5, &start, &(), |_, _| ()).unwrap();
    assert!((rolling.v.float.linear - Vector3::new(3.0, -4.0, 0.0) * (5.0 / 7.0)).amax() < 2e-4);
    let out = model.outputs(0.0, &rolling, &());
    assert!(out.slip.norm() < 1e-4 && (out.force.z - 1.3 * 9.81).abs() < 1e-4);
}

fn heaped() -> heap::State {
    let mut state = heap::State::<f64>::default();
    state.q.free_one.position = Vector3::new(0.0, 0.1, 0.62);
    state.q.free_two.position = Vector3::new(0.13, 0.1, 0.31);
    state.q.free_coin.position = Vector3::new(-0.2, 0.3, 0.25);
    state.q.free_plate.orientation = UnitQuaternion::from_euler_angles(-0.2, 0.1, 0.7);
    state.q.free_one.orientation = UnitQuaternion::from_euler_angles(0.4, 2.0, -1.0);
    state.q.free_two.orientation = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.5);
    state.q.free_coin.orientation = UnitQuaternion::from_euler_angles(0.3, 0.1, 0.4);
    state.v.free_one.linear = Vector3::new(0.3, -0.1, -1.5);
    state.v.free_one.angular = Vector3::new(3.0, -1.0, 2.0);
    state.v.free_two.linear = Vector3::new(0.0, 0.4, -0.8);
    state.v.free_coin.linear = Vector3::new(0.2, -0.1, -0.7);
    state.v.free_coin.angular = Vector3::new(0.5, -6.0, 0.2);
    state.v.free_plate.angular = Vector3::new(0.1, 0.3, -0.4);
    state
}

/// Forces are equal and opposite at one point; energy goes where the power says.
#[test]
fn momentum_and_energy() {
    let model = heap::Model::<f64>::default();
    let start = heaped();
    let before = model.outputs(0.0, &start, &());
    let mut touched = [false; 3];
    let (end, _) = Integrator::adaptive(Dop853, 1e-12, 1e-12)
        .integrate(&model, 0.0, 0.6, &start, &(), |t, state| {
            let gaps = model.outputs(t, state, &()).gaps;
            touched.iter_mut().zip(gaps).for_each(|(touched, gap)| *touched |= gap < -1e-3);
        })
        .unwrap();
    assert_eq!(touched, [true; 3], "{:?}", before.gaps);
    let after = model.outputs(0.6, &end, &());
    assert!((after.momentum - before.momentum).amax() < 1e-11, "{}", after.momentum - before.momentum);
    assert!((after.turning - before.turning).amax() < 1e-11, "{}", after.turning - before.turning);
    assert!(
        (after.energy - before.energy - end.x.lost).abs() < 1e-8,
        "{} {}",
        after.energy - before.energy,
        end.x.lost
    );
    assert!(end.x.lost < -0.1);
}

/// The point of contact of a disc is the lowest of its rim, found by search.
#[test]
fn the_deepest_point_of_a_disc() {
    let model = heap::Model::<f64>::default();
    let out = model.outputs(0.0, &heaped(), &());
    let axle = Unit::new_normalize(out.axle);
    let radius = axle.cross(&out.normal).normalize() * 0.25;
    let height =
        |angle: f64| (out.centre + Rotation3::from_axis_angle(&axle, angle) * radius - out.on).dot(&out.normal);
    let lowest = (0..100_000).map(|k| height(f64::from(k) * 6.3e-5)).fold(f64::INFINITY, f64::min);
    assert!((out.gaps[1] - lowest).abs() < 1e-9, "{} {lowest}", out.gaps[1]);
    assert!(
        ((out.contact - out.centre).norm() - 0.25).abs() < 1e-14 && (out.contact - out.centre).dot(&axle).abs() < 1e-14
    );
}

/// Apart, at the very touch, and deep in: derivatives are numbers, and those of differences where the law is smooth.
#[test]
fn derivatives_at_the_touch() {
    let model = bounce::Model::<f64>::default();
    for (height, speed) in [(0.2, -1.0), (0.1, -1.0), (0.1, 0.0), (0.098, -1.0), (0.098, 1.0)] {
        let mut state = bounce::State::<f64>::default();
        (state.q.rail, state.v.rail) = (height, speed);
        let slopes = model.forward_derivatives(0.0, &state, &());
        let accel = |height: f64, speed: f64| {
            let mut state = bounce::State::<f64>::default();
            (state.q.rail, state.v.rail) = (height, speed);
            model.forward_dynamics(0.0, &state, &()).rail
        };
        let h = 1e-7;
        let stiffness = (accel(height + h, speed) - accel(height - h, speed)) / (2.0 * h);
        let damping = (accel(height, speed + h) - accel(height, speed - h)) / (2.0 * h);
        let found = [slopes.position[(0, 0)], slopes.velocity[(0, 0)]];
        assert!(found.iter().all(|x| x.is_finite()));
        let scale = 1.0 + stiffness.abs() + damping.abs();
        // At the touch the difference is off by the root of its step; the slopes are zero there.
        if height == 0.1 {
            assert_eq!(found, [0.0; 2]);
            continue;
        }
        let close = 1e-6 * scale;
        assert!(
            (found[0] - stiffness).abs() < close && (found[1] - damping).abs() < close,
            "{height}: {found:?} {stiffness} {damping}"
        );
    }
}

/// Four states at once, pressed, apart and at the touch, are what each is alone; so is `f32` to its digits.
#[test]
fn in_lanes() {
    use multibody::simba::simd::{SimdValue, WideF64x4};
    let (one, four) = (bounce::Model::<f64>::default(), bounce::Model::<WideF64x4>::default());
    let (heights, speeds) = ([0.2, 0.1, 0.097, 0.09], [-1.0, 0.5, -2.0, 60.0]);
    let mut state = bounce::State::<WideF64x4>::default();
    (state.q.rail, state.v.rail) = (heights.into(), speeds.into());
    let found = four.forward_dynamics(WideF64x4::splat(0.0), &state, &()).rail;
    let short = bounce::Model::<f32>::default();
    for lane in 0..4 {
        let mut alone = bounce::State::<f64>::default();
        (alone.q.rail, alone.v.rail) = (heights[lane], speeds[lane]);
        let wanted = one.forward_dynamics(0.0, &alone, &()).rail;
        assert!((found.extract(lane) - wanted).abs() <= 1e-12 * wanted.abs(), "{lane}");
        // What comes off faster than 1 / damping is not pulled back.
        assert!(wanted >= 0.0 && (lane != 3 || wanted == 0.0));
        let mut single = bounce::State::<f32>::default();
        (single.q.rail, single.v.rail) = (heights[lane] as f32, speeds[lane] as f32);
        let rough = f64::from(short.forward_dynamics(0.0, &single, &()).rail);
        assert!((rough - wanted).abs() <= 1e-4 * (10.0 + wanted.abs()), "{lane}: {rough} {wanted}");
    }
}
