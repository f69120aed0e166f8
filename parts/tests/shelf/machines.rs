//! Machines of parts alone, and their balance of energy: what is stored and lost is what was there and what was supplied.

use multibody::multibody;
use multibody::nalgebra::Vector3;

use super::{after, close};

multibody! {
    use multibody_parts::{bump_stops, dc_motor, gear, hydraulic_cylinder, inductive_motor, low_pass, pid, rotor, stribeck_friction};

    /// A winch that holds a load at a height: motor, gear, friction and controller.
    pub mod electric_drive {
        /// [m]
        input wanted;
        formulation { constraints: Reduced }
        world { gravity: -9.81 * Z }
        body drum { mass: 3, inertia: diag(0.02, 0.03, 0.02) }
        joint axle: Revolute { parent: ground, child: drum, axis: Y }
        part gear: gear { housing: ground.rotated(X, 1.1), shaft: axle, ratio: 30, mass: 0.3, inertia: 4e-5 };
        part controller: pid { wanted: 10.0 * wanted, measured: axle.angle, proportional: 20, integral: 6, derivative: 2, filter: 0.05 };
        part motor: inductive_motor { shaft: gear.spin, supply: controller.command, constant: 0.06, resistance: 0.7, inductance: 0.002 };
        part bearing: stribeck_friction { joint: axle, coulomb: 0.4, breakaway: 0.6, stribeck: 0.2, passage: 0.02 };
        // A rope of the drum lifts the load.
        body load { mass: 8 }
        joint height: Prismatic { parent: ground.at(X), child: load, axis: Z }
        constraint rope = height - 0.1 * axle;
        state supplied: rate = motor.power, start: 0;
        state lost: rate = motor.loss + bearing.loss, start: 0;
        output angle = axle.angle;
        output stored = kinetic() + potential() + motor.energy;
        output gone = lost - supplied;
    }

    /// A wheel and a quarter of a car over a bumpy road, with stops at both ends of the strut.
    pub mod quarter_car {
        world { gravity: -9.81 * Z }
        body wheel { mass: 38 }
        body corner { mass: 310 }
        joint hop: Prismatic { parent: ground, child: wheel, axis: Z }
        joint strut: Prismatic { parent: wheel, child: corner, axis: Z }
        let road = 0.04 * sin(9 * t);
        let road_rate = 0.36 * cos(9 * t);
        let squeeze = 1.9e5 * (road - hop);
        force tyre: Effort { joint: hop, value: squeeze }
        force spring: Spring { joint: strut, stiffness: 2.2e4, rest: 0.12 }
        force damper: Effort { joint: strut, value: -1400 * strut.rate }
        part ends: bump_stops { joint: strut, lower: -0.05, upper: 0.06, stiffness: 4e6, damping: 2e4 };
        state supplied: rate = squeeze * road_rate, start: 0;
        state lost: rate = 1400 * strut.rate * strut.rate + ends.loss, start: 0;
        output stored = kinetic() + potential() + 0.95e5 * (road - hop) * (road - hop) + ends.energy;
        output gone = lost - supplied;
    }

    /// Four rotors on arms askew, whose speeds follow their wanted ones with a lag.
    pub mod quadrotor {
        /// [rad/s]
        input wanted: [Scalar; 4];
        const AT = [[0.2, 0.1, 0.02], [-0.1, 0.2, 0.03], [-0.2, -0.1, 0.02], [0.1, -0.2, 0.01]];
        const TURN = [1, -1, 1, -1];
        world { gravity: -9.81 * Z }
        body frame { mass: 1.1, com: [0.01, -0.02, 0.005], inertia: inertia(0.012, 0.013, 0.021, 4e-4, -3e-4, 2e-4) }
        joint free: Free { parent: ground, child: frame }
        part motors: [low_pass; 4] = |i| low_pass { signal: wanted[i], time: 0.04 };
        part rotors: [rotor; 4] = |i| rotor { hub: frame.at(AT[i]).rotated([0.1, 0.2, 1], 0.3 * i), speed: TURN[i] * abs(motors[i].value), thrust: TURN[i] * 1.2e-5, drag: 2e-7 };
        state work: rate = rotors[0].power + rotors[1].power + rotors[2].power + rotors[3].power, start: 0;
        output stored = kinetic() + potential();
        output gone = -work;
    }

    /// The arm of an excavator on two cylinders.
    pub mod excavator {
        input spools: [Scalar; 2];
        formulation { constraints: Reduced }
        world { gravity: -9.81 * Z }
        body boom { mass: 900, com: [1.4, 0, 0.1], inertia: diag(60, 900, 900) }
        body stick { mass: 450, com: [0.9, 0, -0.1], inertia: diag(20, 250, 250) }
        joint swing: Revolute { parent: ground.at(0.8 * Z), child: boom, axis: -Y }
        joint fold: Revolute { parent: boom.at(2.9 * X), child: stick, axis: -Y }
        part lift: ram { foot: ground.at([0.5, 0, 0.3]), eye: boom.at([1.3, 0, 0.45]), closed: 1.0, spool: spools[0] };
        part crowd: ram { foot: boom.at([1.2, 0, 0.5]), eye: stick.at([-0.35, 0, 0.3]), closed: 1.1, spool: spools[1] };
        state work: rate = lift.power + crowd.power, start: 0;
        output stored = kinetic() + potential();
        output gone = -work;
        output lengths = [lift.length, crowd.length];
    }

    /// A cylinder between two points of a plane.
    mod ram {
        port foot: Frame;
        port eye: Frame;
        port spool: Scalar;
        /// [m] between its ends where it is in
        param closed = 1.0;
        body barrel { mass: 30, com: 0.3 * X, inertia: diag(0.5, 2, 2) }
        body rod { mass: 20, com: -0.3 * X, inertia: diag(0.3, 1, 1) }
        joint pin: Revolute { parent: foot, child: barrel, axis: -Y }
        joint travel: Prismatic { parent: barrel.at(closed * X), child: rod, axis: X }
        #[cut]
        joint hook: Revolute { parent: rod, child: eye, axis: -Y }
        solve (pin, travel) from hook { travel > -closed }
        part cylinder: hydraulic_cylinder { rod: travel, spool: spool, stroke: 0.9, piston: 8e-3, ring: 5e-3, leak: 1e-13 };
        let power = cylinder.push * travel.rate;
        let length = closed + travel;
    }
}

#[test]
fn an_electric_drive_balances() {
    let input = electric_drive::Input { wanted: 0.5 };
    let model = electric_drive::Model::<f64>::default();
    let x = balanced!("drive", model, electric_drive::State::default(), input, 3.0, 150_000);
    close("height", 0.1 * electric_drive::Model::default().outputs(3.0, &x, &input).angle, 0.5, 0.2);
}

#[test]
fn a_quarter_car_balances() {
    balanced!("car", quarter_car::Model::<f64>::default(), quarter_car::State::default(), (), 3.0, 20_000);
}

#[test]
fn a_quadrotor_balances() {
    let mut x = quadrotor::State::<f64>::default();
    x.v.free.angular = Vector3::new(0.3, -0.2, 0.5);
    let input = quadrotor::Input { wanted: [480.0, 470.0, 490.0, 475.0] };
    balanced!("quadrotor", quadrotor::Model::<f64>::default(), x, input, 1.0, 2_000);
}

#[test]
fn an_excavator_balances() {
    let mut x = excavator::State::<f64>::default();
    (x.q.swing, x.q.fold) = (0.35, -1.2);
    for ram in [&mut x.x.lift, &mut x.x.crowd] {
        (ram.cylinder.pressure_a, ram.cylinder.pressure_b) = (6e6, 4e6);
    }
    let input = excavator::Input { spools: [0.5, -0.4] };
    balanced!("excavator", excavator::Model::<f64>::default(), x, input, 1.0, 20_000);
}

/// What a motor draws is what it gives and what it heats.
#[test]
fn a_motor_gives_what_it_draws() {
    multibody! {
        use multibody_parts::dc_motor;
        mod fan {
            input voltage;
            body rotor { mass: 1, inertia: diag(1, 1, 2e-4) }
            joint axle: Revolute { parent: ground, child: rotor, axis: Z }
            part motor: dc_motor { shaft: axle, supply: voltage };
            output rest = motor.power - motor.loss - motor.torque * axle.rate;
        }
    }
    let model = fan::Model::<f64>::default();
    let input = fan::Input { voltage: 7.0 };
    let end = after(&model, &fan::State::default(), &input, 0.05, 100);
    assert!(model.outputs(0.0, &end, &input).rest.abs() < 1e-13);
}
