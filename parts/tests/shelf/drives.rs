//! Motors, gears, friction.

use multibody::multibody;

use super::{after, close};

multibody! {
    use multibody_parts::{dc_motor, gear, gearbox, harmonic_drive, inductive_motor, stribeck_friction};

    /// Two fans side by side.
    pub mod fans {
        /// [V]
        input voltage;
        body fast { mass: 1, inertia: diag(2e-4, 2e-4, 3e-4) }
        body slow { mass: 1, inertia: diag(2e-4, 2e-4, 3e-4) }
        joint a: Revolute { parent: ground, child: fast, axis: Z }
        joint b: Revolute { parent: ground, child: slow, axis: Z }
        part direct: dc_motor { shaft: a, supply: voltage, constant: 0.07, resistance: 1.3 };
        part inductive: inductive_motor { shaft: b, supply: voltage, constant: 0.07, resistance: 1.3, inductance: 0.011 };
    }

    /// A rotor behind a gear on an oblique axis, and the torque of a lossy one.
    pub mod geared {
        /// [N m]
        input torque;
        formulation { constraints: Reduced }
        body load { mass: 1, inertia: diag(0.3, 0.2, 0.1) }
        joint shaft: Revolute { parent: ground, child: load, axis: X }
        part gear: gear { housing: ground.rotated([1, 2, 2], 0.7), shaft: shaft, ratio: -13.5, mass: 0.2, inertia: 2e-3 };
        force motor: Effort { joint: gear.spin, value: torque }
        body wheel { mass: 1, inertia: diag(0.3, 0.2, 0.1) }
        joint axle: Revolute { parent: ground, child: wheel, axis: Y }
        part lossy: gearbox { shaft: axle, torque: torque, ratio: 7, efficiency: 0.8, passage: 1e-3 };
        output delivered = lossy.delivered;
        output acceleration = shaft.accel;
    }

    /// Two inertias with a strain-wave gear between them.
    pub mod elastic {
        body rotor { mass: 1, inertia: diag(1e-4, 1e-4, 2e-4) }
        body arm { mass: 1, inertia: diag(0.7, 0.5, 0.6) }
        joint motor: Revolute { parent: ground, child: rotor, axis: Z }
        joint shaft: Revolute { parent: ground, child: arm, axis: [1, 2, 2] }
        part drive: harmonic_drive { motor: motor, shaft: shaft, ratio: 80, stiffness: 900, damping: 0 };
        output wound = drive.wound;
    }

    /// A wheel that friction brakes.
    pub mod braked {
        body wheel { mass: 1, inertia: diag(1, 1, 0.4) }
        joint axle: Revolute { parent: ground, child: wheel, axis: Z }
        part bearing: stribeck_friction { joint: axle, coulomb: 0.3, breakaway: 0.5, viscous: 0.2, stribeck: 0.4, passage: 0.01 };
        /// [J]
        state lost: rate = bearing.loss, start: 0;
        output energy = kinetic() + lost;
    }
}

/// A fan's speed is w (1 - exp(-t / T)), T = J R / k^2; with inductance there are two exponentials.
#[test]
fn motors_speed_up_as_their_time_constants_say() {
    let model = fans::Model::<f64>::default();
    let (inertia, k, r, l, u, t): (f64, f64, f64, f64, f64, f64) = (3e-4, 0.07, 1.3, 0.011, 12.0, 0.09);
    let end = after(&model, &fans::State::default(), &fans::Input { voltage: u }, t, 4000);
    close("direct", end.v.a, u / k * (1.0 - (-t * k * k / (inertia * r)).exp()), 1e-11);
    let root = (r * r / (4.0 * l * l) - k * k / (inertia * l)).sqrt();
    let [one, other] = [root, -root].map(|root| root - r / (2.0 * l));
    let passing = (other * (one * t).exp() - one * (other * t).exp()) / (other - one);
    close("inductive", end.v.b, u / k * (1.0 - passing), 1e-10);
}

#[test]
fn a_rotor_counts_by_the_square_of_its_ratio() {
    let model = geared::Model::<f64>::default();
    let input = geared::Input { torque: 0.4 };
    let mut x = geared::State::default();
    close("gear", model.outputs(0.0, &x, &input).acceleration, -13.5 * 0.4 / (0.3 + 13.5 * 13.5 * 2e-3), 1e-12);
    for (speed, share) in [(3.0, 0.8), (-3.0, 1.0 / 0.8)] {
        x.v.axle = speed;
        close("gearbox", model.outputs(0.0, &x, &input).delivered, 7.0 * 0.4 * share, 1e-12);
    }
}

/// The frequency of two inertias and a spring: w^2 = k (1 / I + 1 / (n^2 J)).
#[test]
fn a_strain_wave_gear_swings() {
    let model = elastic::Model::<f64>::default();
    let about = [1.0_f64, 2.0, 2.0].map(|x| x / 3.0);
    let inertia: f64 = [0.7, 0.5, 0.6].iter().zip(about).map(|(i, x)| i * x * x).sum();
    let frequency = (900.0 * (1.0 / inertia + 1.0 / (80.0 * 80.0 * 2e-4))).sqrt();
    let mut x = elastic::State::default();
    x.q.motor = 4.0;
    let end = after(&model, &x, &(), 0.1, 2000);
    close("wound", model.outputs(0.0, &end, &()).wound, 0.05 * (frequency * 0.1).cos(), 1e-8);
}

#[test]
fn friction_falls_from_breakaway_to_coulombs() {
    let model = braked::Model::<f64>::default();
    for speed in [-2.0_f64, -0.3, -0.004, 0.0, 0.02, 0.5, 4.0] {
        let mut x = braked::State::default();
        x.v.axle = speed;
        let dry = 0.3 + 0.2 * (-(speed / 0.4) * (speed / 0.4)).exp();
        let wanted = -(dry * (speed / 0.01).tanh() + 0.2 * speed) / 0.4;
        close("friction", model.forward_dynamics(0.0, &x, &()).v.axle, wanted, 1e-13);
    }
    let mut x = braked::State::default();
    x.v.axle = 3.0;
    let end = after(&model, &x, &(), 3.0, 30_000);
    assert!(end.v.axle.abs() < 1e-6);
    close("energy", model.outputs(0.0, &end, &()).energy, 0.5 * 0.4 * 9.0, 1e-9);
}
