//! A half and a whole car, of parts alone, and their balance of energy; what they are made of against closed solutions.

use multibody::multibody;
use multibody::nalgebra::Vector3;

use super::{after, close};

multibody! {
    use multibody_parts::{bump_stops, carcass, combined_tyre, stribeck_friction, suspension};

    /// A wheel on its strut, with a brake, on a road whose height and rate come from outside.
    mod corner {
        port top: Frame;
        port road: Scalar;
        port road_rate: Scalar;
        /// [N m]
        param brake = 30.0;
        body hub { mass: 12, com: [0.01, 0.02, 0], inertia: diag(0.3, 0.4, 0.3) }
        body rim { mass: 22, inertia: diag(0.6, 1.1, 0.6) }
        joint strut: Prismatic { parent: top, child: hub, axis: Z }
        joint spin: Revolute { parent: hub, child: rim, axis: Y }
        part spring: suspension { strut: strut, stiffness: 2.4e4, damping: 1600, rest: -0.13 };
        part ends: bump_stops { joint: strut, lower: -0.03, upper: 0.025, stiffness: 4e6, damping: 2e4 };
        part tyre: carcass { contact: hub.at(-0.3 * Z), road: road, road_rate: road_rate, stiffness: 1.9e5, damping: 300 };
        part grip: combined_tyre { carrier: hub.at(-0.3 * Z), spin: spin, load: tyre.load, radius: 0.3, friction: 0.9 };
        part shoes: stribeck_friction { joint: spin, coulomb: brake, breakaway: 1.2 * brake, passage: 0.5 };
        let energy = spring.energy + ends.energy + tyre.energy;
        let loss = spring.loss + ends.loss + tyre.loss + grip.loss + shoes.loss;
        let power = tyre.power;
    }

    /// Two axles in a plane, over waves.
    pub mod half_car {
        world { gravity: -9.81 * Z }
        body chassis { mass: 640, com: [0.05, 0, 0.1], inertia: diag(100, 900, 900) }
        joint plane: Planar { parent: ground.at(0.48 * Z), child: chassis, axes: [X, Z] }
        let ahead = chassis.velocity.x;
        let front_at = 2 * (chassis.position.x + 1.1);
        let rear_at = 2 * (chassis.position.x - 1.4);
        part front: corner { top: chassis.at([1.1, 0, -0.2]), road: 0.012 * sin(front_at), road_rate: 0.024 * cos(front_at) * ahead, brake: 40 };
        part rear: corner { top: chassis.at([-1.4, 0, -0.2]), road: 0.012 * sin(rear_at), road_rate: 0.024 * cos(rear_at) * ahead, brake: 15 };
        state supplied: rate = front.power + rear.power, start: 0;
        state lost: rate = front.loss + rear.loss, start: 0;
        output stored = kinetic() + potential() + front.energy + rear.energy;
        output gone = lost - supplied;
        output load = front.tyre.load;
    }

    /// Four wheels and a body that is free in space; the front wheels are steered.
    pub mod full_car {
        /// [rad]
        param steer = 0.03;
        world { gravity: -9.81 * Z }
        body chassis { mass: 1300, com: [0.02, 0.01, 0.1], inertia: inertia(500, 1900, 2100, 5, -20, 3) }
        joint free: Free { parent: ground.at(0.48 * Z), child: chassis }
        part front: [corner; 2] = |i| corner { top: chassis.at([1.1, 0.75 - 1.5 * i, -0.2]).rotated(Z, steer), road: 0, road_rate: 0, brake: 40 };
        part rear: [corner; 2] = |i| corner { top: chassis.at([-1.5, 0.74 - 1.48 * i, -0.2]), road: 0, road_rate: 0, brake: 15 };
        let loss = front[0].loss + front[1].loss + rear[0].loss + rear[1].loss;
        state lost: rate = loss, start: 0;
        output stored = kinetic() + potential() + front[0].energy + front[1].energy + rear[0].energy + rear[1].energy;
        output gone = lost;
        output yaw_rate = chassis.angular_velocity.z;
    }

    /// A wheel that slides as it is told, and a mass on a carcass.
    pub mod rig {
        body slider { mass: 1, inertia: diag(1, 1, 1) }
        body rim { mass: 1, inertia: diag(1, 1, 1) }
        body load { mass: 300 }
        joint plane: Planar { parent: ground.rotated([1, 2, 2], 0.7), child: slider, axis: Z }
        joint spin: Revolute { parent: slider, child: rim, axis: Y }
        part tyre: combined_tyre { carrier: slider, spin: spin, load: 4000, radius: 0.32, friction: 0.9, stiffness: 11, shape: 1.4, curvature: -0.6, passage: 1e-9 };
        joint height: Prismatic { parent: ground.at([0.3, 0.2, 0.5]), child: load, axis: Z }
        part carcass: carcass { contact: load.at([0.1, 0.2, -0.5]), road: 0.02, road_rate: 0, stiffness: 1.8e5, damping: 900 };
        joint along: Prismatic { parent: ground, child: bob, axis: [2, 1, -2] }
        body bob { mass: 50 }
        part spring: suspension { strut: along, stiffness: 3200, damping: 120, rest: 0.07 };
        output push = tyre.push;
        output loss = tyre.loss;
        output carried = carcass.load;
        output spring_energy = spring.energy;
    }
}

#[test]
fn a_half_car_balances() {
    let mut x = half_car::State::<f64>::default();
    let model = half_car::Model::<f64>::default();
    x.v.plane.x = 14.0;
    (x.v.front.spin, x.v.rear.spin) = (14.0 / 0.3, 14.0 / 0.3);
    let end = balanced!("half car", model, x, (), 1.5, 30_000);
    // The wheels have stayed on the road: half the weight, more or less.
    let load = model.outputs(1.5, &end, &()).load;
    assert!((1e3..8e3).contains(&load), "{load}");
}

#[test]
fn a_whole_car_balances_and_turns() {
    let mut x = full_car::State::<f64>::default();
    x.v.free.linear = Vector3::new(16.0, 0.0, 0.0);
    for corner in x.v.front.iter_mut().chain(&mut x.v.rear) {
        corner.spin = 16.0 / 0.3;
    }
    let model = full_car::Model::<f64>::default();
    let end = balanced!("whole car", model, x, (), 1.0, 20_000);
    let yaw_rate = model.outputs(1.0, &end, &()).yaw_rate;
    // V delta / L, less what a car that slides takes from it.
    assert!((0.1..0.2).contains(&yaw_rate), "{yaw_rate}");
}

/// The force is against the sliding, its size a function of the slip alone: slope B C D at zero, D at most.
#[test]
fn a_combined_tyre_is_alike_in_all_directions() {
    let model = rig::Model::<f64>::default();
    let (rolling, peak) = (17.0, 0.9 * 4000.0);
    let push = |slip: f64, angle: f64| {
        let mut x = rig::State::default();
        x.q.plane.angle = 0.4;
        let (sliding, turn) = (rolling * slip, 0.4_f64);
        let [ahead, aside] = [rolling + sliding * angle.cos(), sliding * angle.sin()];
        x.v.plane.x = ahead * turn.cos() - aside * turn.sin();
        x.v.plane.y = ahead * turn.sin() + aside * turn.cos();
        x.v.spin = rolling / 0.32;
        let y = model.outputs(0.0, &x, &());
        let along = -(y.push.x * angle.cos() + y.push.y * angle.sin());
        let across = y.push.y * angle.cos() - y.push.x * angle.sin();
        close("loss", y.loss, along * sliding, 1e-9);
        assert!(across.abs() < 1e-6 * peak, "{across} across");
        along
    };
    for angle in [0.0, 0.7, 1.9, 3.1, 4.6] {
        close("slope", push(1e-5, angle) / 1e-5, 11.0 * 1.4 * peak, 1e-4);
        close("alike", push(0.13, angle), push(0.13, 0.0), 1e-9);
        let greatest = (1..2000).map(|k| push(2e-4 * f64::from(k), angle)).fold(0.0, f64::max);
        close("peak", greatest, peak, 1e-6);
        // The formula by its terms.
        let steep = 11.0 * 0.13_f64;
        let bent = steep + 0.6 * (steep - steep.atan());
        close("formula", push(0.13, angle), peak * (1.4 * bent.atan()).sin(), 1e-9);
    }
}

/// A mass that is let go above the road falls free, and once pressed swings with the carcass's frequency.
#[test]
fn a_carcass_pushes_and_never_pulls() {
    let model = rig::Model::<f64>::default();
    let mut x = rig::State::<f64>::default();
    (x.q.height, x.v.height) = (0.05, -1.0);
    assert_eq!(model.outputs(0.0, &x, &()).carried, 0.0);
    (x.q.height, x.v.height) = (0.018, 5.0);
    assert_eq!(model.outputs(0.0, &x, &()).carried, 0.0);
    (x.q.height, x.v.height) = (0.01, -0.2);
    let end = after(&model, &x, &(), 0.03, 3000);
    let (rate, share) = ((1.8e5_f64 / 300.0).sqrt(), 900.0 / 600.0);
    let (w, t) = ((rate * rate - share * share).sqrt(), 0.03);
    let (s, v) = (0.01, 0.2);
    let squeeze = (-share * t).exp() * (s * (w * t).cos() + (v + share * s) / w * (w * t).sin());
    close("squeeze", 0.02 - end.q.height, squeeze, 1e-8);
}

/// `m q'' + d q' + k (q - rest) = 0`.
#[test]
fn a_suspension_swings_as_its_equation_says() {
    let model = rig::Model::<f64>::default();
    let mut x = rig::State::<f64>::default();
    (x.q.along, x.v.along) = (0.12, 0.4);
    let t = 0.9_f64;
    let end = after(&model, &x, &(), t, 9000);
    let (share, w) = (1.2_f64, (64.0_f64 - 1.44).sqrt());
    let (s, v) = (0.05, 0.4);
    let swing = (-share * t).exp() * (s * (w * t).cos() + (v + share * s) / w * (w * t).sin());
    close("swing", end.q.along - 0.07, swing, 1e-9);
    close("energy", model.outputs(t, &end, &()).spring_energy, 1600.0 * swing * swing, 1e-8);
}
