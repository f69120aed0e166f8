//! The models of `examples/`, each with the power of all its forces: springs too. Energy is that of motion and gravity.

use multibody::multibody;

multibody! {
    /// `examples/double_pendulum.rs`
    pub mod double_pendulum {
        const G = 9.81;
        param m1 = 1.0;
        param m2 = 1.0;
        param l1 = 1.0;
        param l2 = 1.0;
        world { gravity: -G * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        let drag = -0.01 * elbow.rate;
        force friction: Effort { joint: elbow, value: drag }
        output power = friction.power;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/cart_pole.rs`
    pub mod cart_pole {
        param g = 9.81;
        param cart_mass = 1.0;
        param pole_mass = 0.2;
        param length = 0.8;
        input push;
        world { gravity: -g * Y }
        body cart { mass: cart_mass }
        body pole { mass: pole_mass, com: 0.5 * length * Y, inertia: rod(pole_mass, length, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }
        output power = motor.power;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/four_bar.rs`, free
    pub mod four_bar {
        const CRANK = 1.0;
        const COUPLER = 3.5;
        const ROCKER = 3.0;
        const BASE = 4.0;
        input torque;
        world { gravity: -9.81 * Y }
        body crank { mass: 1.0, com: 0.5 * CRANK * X, inertia: rod(1.0, CRANK, X) }
        body coupler { mass: 3.5, com: 0.5 * COUPLER * X, inertia: rod(3.5, COUPLER, X) }
        body rocker { mass: 3.0, com: 0.5 * ROCKER * X, inertia: rod(3.0, ROCKER, X) }
        joint drive_shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(CRANK * X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(BASE * X), child: rocker, axis: Z }
        #[cut]
        joint pin: Revolute { parent: coupler.at(COUPLER * X), child: rocker.at(ROCKER * X), axis: Z }
        formulation { constraints: Reduced }
        solve (knee, pivot) from pin { sin(pivot - drive_shaft - knee) > 0.0 }
        force motor: Effort { joint: drive_shaft, value: torque }
        output power = motor.power;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/slider_crank.rs`
    pub mod slider_crank {
        const CRANK = 0.04;
        const ROD = 0.14;
        input gas;
        param load = 0.05;
        body crank { mass: 2.0, inertia: diag(0.005, 0.005, 0.01) }
        body rod { mass: 0.3, com: 0.05 * X, inertia: rod(0.3, ROD, X) }
        body piston { mass: 0.4 }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint big_end: Revolute { parent: crank.at(CRANK * X), child: rod, axis: Z }
        joint cylinder: Prismatic { parent: ground, child: piston, axis: X }
        #[cut]
        joint small_end: Revolute { parent: rod.at(ROD * X), child: piston, axis: Z }
        formulation { constraints: Reduced }
        solve (big_end, cylinder) from small_end { cylinder > 0.0 }
        force pressure: Effort { joint: cylinder, value: -gas }
        force dynamometer: Damper { joint: shaft, damping: load }
        output power = pressure.power + dynamometer.power;
        output energy = kinetic();
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/panda.rs`, with the viscous friction that `examples/tradeoff` gives it
    pub mod panda {
        /// as a share of what it is there
        param friction = 1.0;
        /// [kg] what the hand holds
        param payload = 0.0;
        /// [N m] of the seven motors
        input torque: [Scalar; 7];

        world { gravity: -9.81 * Z }

        body link1 {
            mass: 4.970684,
            com: [0.003875, 0.002081, -0.04762],
            inertia: inertia(0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169),
        }
        body link2 {
            mass: 0.646926,
            com: [-0.003141, -0.02872, 0.003495],
            inertia: inertia(0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704),
        }
        body link3 {
            mass: 3.228604,
            com: [0.027518, 0.039252, -0.066502],
            inertia: inertia(0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805),
        }
        body link4 {
            mass: 3.587895,
            com: [-0.05317, 0.104419, 0.027454],
            inertia: inertia(0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641),
        }
        body link5 {
            mass: 1.225946,
            com: [-0.011953, 0.041065, -0.038437],
            inertia: inertia(0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229),
        }
        body link6 {
            mass: 1.666555,
            com: [0.060149, -0.014117, -0.010517],
            inertia: inertia(0.001964, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341),
        }
        /// The last link and the hand.
        body link7 {
            mass: 1.495522,
            com: [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578],
            inertia: inertia(
                0.016529853712634629, 0.014107248642161839, 0.0066769555566409556,
                0.00039489229711917772, -0.00070669571061450173, -0.001051105327046708,
            ),
        }
        body load { mass: payload }

        joint q1: Revolute { parent: ground.at(0.333 * Z), child: link1, axis: Z }
        joint q2: Revolute { parent: link1.rotated(X, deg(-90.0)), child: link2, axis: Z }
        joint q3: Revolute { parent: link2.at(-0.316 * Y).rotated(X, deg(90.0)), child: link3, axis: Z }
        joint q4: Revolute { parent: link3.at(0.0825 * X).rotated(X, deg(90.0)), child: link4, axis: Z }
        joint q5: Revolute { parent: link4.at([-0.0825, 0.384, 0.0]).rotated(X, deg(-90.0)), child: link5, axis: Z }
        joint q6: Revolute { parent: link5.rotated(X, deg(90.0)), child: link6, axis: Z }
        joint q7: Revolute { parent: link6.at(0.088 * X).rotated(X, deg(90.0)), child: link7, axis: Z }
        joint grip: Fixed { parent: link7.at(0.2104 * Z), child: load }

        force motor1: Effort { joint: q1, value: torque[0] }
        force motor2: Effort { joint: q2, value: torque[1] }
        force motor3: Effort { joint: q3, value: torque[2] }
        force motor4: Effort { joint: q4, value: torque[3] }
        force motor5: Effort { joint: q5, value: torque[4] }
        force motor6: Effort { joint: q6, value: torque[5] }
        force motor7: Effort { joint: q7, value: torque[6] }

        force friction1: Damper { joint: q1, damping: 2.0 * friction }
        force friction2: Damper { joint: q2, damping: 2.0 * friction }
        force friction3: Damper { joint: q3, damping: friction }
        force friction4: Damper { joint: q4, damping: friction }
        force friction5: Damper { joint: q5, damping: 0.4 * friction }
        force friction6: Damper { joint: q6, damping: 0.4 * friction }
        force friction7: Damper { joint: q7, damping: 0.2 * friction }

        let motors =
            motor1.power + motor2.power + motor3.power + motor4.power + motor5.power + motor6.power + motor7.power;
        let dampers = friction1.power + friction2.power + friction3.power + friction4.power + friction5.power
            + friction6.power + friction7.power;
        output power = motors + dampers;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/andrews.rs`
    pub mod andrews {
        /// [m] the motor's pin is the origin
        const A = [-0.06934, -0.00227, 0.0];
        const B = [-0.03635, 0.03273, 0.0];
        const C = [0.014, 0.072, 0.0];

        body k1 { mass: 0.04325, com: 92e-5 * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
        body k2 { mass: 0.00365, com: -115e-4 * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
        body k3 { mass: 0.02373, com: [0.01043, -0.01874, 0.0], inertia: diag(0.0, 5.255e-6, 5.255e-6) }
        body k4 { mass: 0.00706, com: -0.00579 * Y, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body k5 { mass: 0.07050, com: [0.02308, 0.00916, 0.0], inertia: diag(0.0, 1.169e-5, 1.169e-5) }
        body k6 { mass: 0.00706, com: 0.00579 * X, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body k7 { mass: 0.05498, com: [-0.00449, -0.01228, 0.0], inertia: diag(0.0, 1.912e-5, 1.912e-5) }

        joint beta: Revolute { parent: ground, child: k1, axis: Z }
        joint theta: Revolute { parent: k1.at(0.007 * X), child: k2, axis: Z }
        joint gamma: Revolute { parent: ground.at(B), child: k3, axis: Z }
        joint delta: Revolute { parent: ground.at(A), child: k5, axis: Z }
        joint phi: Revolute { parent: k5.at(0.04 * X), child: k4, axis: Z }
        joint epsilon: Revolute { parent: ground.at(A), child: k7, axis: Z }
        joint omega: Revolute { parent: k7.at(-0.04 * Y), child: k6, axis: Z }

        // One point carries four bodies.
        #[cut]
        joint p3: Revolute { parent: k2.at(-0.028 * X), child: k3.at(-0.035 * Y), axis: Z }
        #[cut]
        joint p4: Revolute { parent: k2.at(-0.028 * X), child: k4.at(-0.02 * Y), axis: Z }
        #[cut]
        joint p6: Revolute { parent: k2.at(-0.028 * X), child: k6.at(0.02 * X), axis: Z }

        force motor: Effort { joint: beta, value: 0.033 }
        force spring: Spring { between: [k3.at([0.02, -0.018, 0.0]), ground.at(C)], stiffness: 4530.0, length: 0.07785 }

        formulation { constraints: Multipliers }
        output power = motor.power + spring.power;
        output energy = kinetic();
        emit forward_dynamics;
    }
}

multibody! {
    /// A leg.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force spring: SpringDamper { joint: stroke, stiffness: 200.0, damping: 5.0, rest: 0.262 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// `examples/stewart`, reduced, on the springs of `examples/tradeoff`
    pub mod stewart {
        const FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0], [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0],
            [0.0, 0.15, 0.0],
        ];
        const PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4], [0.17, -0.595, -0.4], [0.43, -0.445, -0.4],
            [0.43, 0.445, -0.4],
        ];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        let motors = legs[0].actuator.power + legs[1].actuator.power + legs[2].actuator.power + legs[3].actuator.power
            + legs[4].actuator.power + legs[5].actuator.power;
        let springs = legs[0].spring.power + legs[1].spring.power + legs[2].spring.power + legs[3].spring.power
            + legs[4].spring.power + legs[5].spring.power;
        let pins = platform.at(PINS[0]).position.z + platform.at(PINS[1]).position.z + platform.at(PINS[2]).position.z
            + platform.at(PINS[3]).position.z + platform.at(PINS[4]).position.z + platform.at(PINS[5]).position.z;
        output power = motors + springs;
        // The two bodies of a leg weigh the same, and their centres are as far from its ends: as one at the pin.
        output energy = kinetic() + 9.80665 * (1.5 * platform.position.z + 0.1 * pins);
        emit forward_dynamics;
    }
}

multibody! {
    /// `examples/impacts.rs`: dry friction
    pub mod block {
        const MU = 0.3;
        const SLOW = 0.01;
        const MASS = 1.5;
        body block { mass: MASS }
        joint slide: Prismatic { parent: ground, child: block, axis: X }
        force friction: Effort { joint: slide, value: -MU * MASS * 9.81 * tanh(slide.rate / SLOW) }
        output power = friction.power;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
    /// `examples/impacts.rs`: a bushing, whose springs are forces of the user's
    pub mod mount {
        const K = [4e4, 4e4, 9e4];
        const C = [200.0, 200.0, 450.0];
        const KT = [300.0, 250.0, 120.0];
        const CT = [1.5, 1.0, 0.6];
        body engine { mass: 40.0, inertia: diag(1.2, 1.0, 0.8) }
        joint free: Free { parent: ground, child: engine, coordinates: RollPitchYaw }
        force shift: Force {
            at: engine, axes: ground,
            value: [
                -K[0] * free.x - C[0] * free.x.rate, -K[1] * free.y - C[1] * free.y.rate, -K[2] * free.z - C[2] * free.z.rate,
            ],
        }
        force turn: Torque {
            at: engine, axes: ground,
            value: [
                -KT[0] * free.roll - CT[0] * free.roll.rate, -KT[1] * free.pitch - CT[1] * free.pitch.rate,
                -KT[2] * free.yaw - CT[2] * free.yaw.rate,
            ],
        }
        output power = shift.power + turn.power;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}

multibody! {
    /// The governor of `examples/tradeoff` and `examples/diffsol`.
    pub mod governor {
        const K = 1e7;
        const C = 5e4;
        world { gravity: -9.81 * Z }
        body spindle { mass: 1.0, inertia: diag(0.05, 0.05, 0.05) }
        body right { mass: 0.5, com: -0.3 * Z }
        body left { mass: 0.5, com: -0.3 * Z }
        body sleeve { mass: 1.0 }
        joint shaft: Revolute { parent: ground, child: spindle, axis: Z }
        joint right_arm: Revolute { parent: spindle.at(0.05 * X), child: right, axis: -Y }
        joint left_arm: Revolute { parent: spindle.at(-0.05 * X), child: left, axis: Y }
        joint slide: Prismatic { parent: spindle, child: sleeve, axis: Z }
        force drive: Effort { joint: shaft, value: 0.5 * (9.0 - shaft.rate) }
        force right_link: SpringDamper {
            between: [right.at(-0.2 * Z), sleeve.at(0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        force left_link: SpringDamper {
            between: [left.at(-0.2 * Z), sleeve.at(-0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        let balls = right.at(-0.3 * Z).position.z + left.at(-0.3 * Z).position.z;
        output power = drive.power + right_link.power + left_link.power;
        output energy = kinetic() + 9.81 * (0.5 * balls + slide.travel);
        emit forward_dynamics;
    }
}
