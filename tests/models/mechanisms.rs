//! Mechanisms with loops, each in several formulations that must agree.

use multibody::multibody;

multibody! {
    /// A four-bar in gravity, with a spring; its loop is solved.
    pub mod four_bar {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        force spring: Spring { between: [link.at(2.0 * Y), ground], stiffness: 8.0, length: 0.5 }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        output angles = [crank.angle, coupler.angle, rocker.angle];
        output rates = [crank.rate, coupler.rate, rocker.rate];
        output accels = [crank.accel, coupler.accel, rocker.accel];
        /// of the arm's tip against the ground, and of the pin
        output reactions = [coupler.reaction.force, pin.reaction.force];
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// Its loop is solved by Newton's method.
    pub mod four_bar_newton {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced, independent: [crank] }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        force spring: Spring { between: [link.at(2.0 * Y), ground], stiffness: 8.0, length: 0.5 }
        output angles = [crank.angle, coupler.angle, rocker.angle];
        output rates = [crank.rate, coupler.rate, rocker.rate];
        output accels = [crank.accel, coupler.accel, rocker.accel];
        /// of the arm's tip against the ground, and of the pin
        output reactions = [coupler.reaction.force, pin.reaction.force];
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// Its loop keeps its equations.
    pub mod four_bar_multipliers {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        force spring: Spring { between: [link.at(2.0 * Y), ground], stiffness: 8.0, length: 0.5 }
        output angles = [crank.angle, coupler.angle, rocker.angle];
        output rates = [crank.rate, coupler.rate, rocker.rate];
        output accels = [crank.accel, coupler.accel, rocker.accel];
        /// of the arm's tip against the ground, and of the pin
        output reactions = [coupler.reaction.force, pin.reaction.force];
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, residual;
    }
}

multibody! {
    /// The crank is driven.
    pub mod four_bar_driven {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        force spring: Spring { between: [link.at(2.0 * Y), ground], stiffness: 8.0, length: 0.5 }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        drive crank.angle = 0.4 + 1.5 * t + 0.3 * sin(2.0 * t);
        output effort = crank.effort;
        output energy = kinetic() + potential();
        output pin_force = pin.reaction.force;
        emit forward_dynamics;
    }
    /// The crank is driven, the loop keeps its equations.
    pub mod four_bar_driven_multipliers {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        force spring: Spring { between: [link.at(2.0 * Y), ground], stiffness: 8.0, length: 0.5 }
        drive crank.angle = 0.4 + 1.5 * t + 0.3 * sin(2.0 * t);
        output effort = crank.effort;
        output energy = kinetic() + potential();
        output pin_force = pin.reaction.force;
        emit forward_dynamics, residual;
    }
}

multibody! {
    /// A spatial four-bar, its loop solved.
    pub mod spatial {
        world { gravity: [0.5, -1.0, -9.7] }
        formulation { constraints: Reduced }
        input torque;
        body disc { mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.3) }
        body rod { mass: 0.5, com: 0.4 * X, inertia: inertia(0.012, 0.055, 0.06, 0.002, 0.003, -0.001) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint gimbal: Universal { parent: disc.at(0.5 * X), child: rod, axes: [Z, Y] }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        #[cut]
        joint ball: Ball { parent: rod.at(X), child: lever.at(0.7 * Y) }
        force motor: Effort { joint: driver, value: torque }
        force spring: Spring { joint: shaft, stiffness: 0.7, rest: 0.2 }
        solve (shaft, gimbal) from ball {
            0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) > 0.0, cos(gimbal.second) > 0.0
        }
        output angles = [driver.angle, shaft.angle, gimbal.first, gimbal.second];
        output rates = [driver.rate, shaft.rate, gimbal.first.rate, gimbal.second.rate];
        output accels = [driver.accel, shaft.accel, gimbal.first.accel, gimbal.second.accel];
        output reaction = ball.reaction.force;
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// Its loop is solved by Newton's method.
    pub mod spatial_newton {
        world { gravity: [0.5, -1.0, -9.7] }
        formulation { constraints: Reduced, independent: [driver] }
        input torque;
        body disc { mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.3) }
        body rod { mass: 0.5, com: 0.4 * X, inertia: inertia(0.012, 0.055, 0.06, 0.002, 0.003, -0.001) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint gimbal: Universal { parent: disc.at(0.5 * X), child: rod, axes: [Z, Y] }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        #[cut]
        joint ball: Ball { parent: rod.at(X), child: lever.at(0.7 * Y) }
        force motor: Effort { joint: driver, value: torque }
        force spring: Spring { joint: shaft, stiffness: 0.7, rest: 0.2 }
        output angles = [driver.angle, shaft.angle, gimbal.first, gimbal.second];
        output rates = [driver.rate, shaft.rate, gimbal.first.rate, gimbal.second.rate];
        output accels = [driver.accel, shaft.accel, gimbal.first.accel, gimbal.second.accel];
        output reaction = ball.reaction.force;
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// Its loop keeps its equations.
    pub mod spatial_multipliers {
        world { gravity: [0.5, -1.0, -9.7] }
        formulation { constraints: Multipliers }
        input torque;
        body disc { mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.3) }
        body rod { mass: 0.5, com: 0.4 * X, inertia: inertia(0.012, 0.055, 0.06, 0.002, 0.003, -0.001) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint gimbal: Universal { parent: disc.at(0.5 * X), child: rod, axes: [Z, Y] }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        #[cut]
        joint ball: Ball { parent: rod.at(X), child: lever.at(0.7 * Y) }
        force motor: Effort { joint: driver, value: torque }
        force spring: Spring { joint: shaft, stiffness: 0.7, rest: 0.2 }
        output angles = [driver.angle, shaft.angle, gimbal.first, gimbal.second];
        output rates = [driver.rate, shaft.rate, gimbal.first.rate, gimbal.second.rate];
        output accels = [driver.accel, shaft.accel, gimbal.first.accel, gimbal.second.accel];
        output reaction = ball.reaction.force;
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, residual;
    }
}

multibody! {
    /// Wheels, a rack and a pendulum: linear couplings.
    pub mod geared {
        world { gravity: -9.81 * Z }
        formulation { constraints: Reduced }
        input torque;
        body sun { mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }
        body wheel { mass: 2.0, com: 0.1 * Y, inertia: diag(0.05, 0.05, 0.1) }
        body carriage { mass: 3.0 }
        body bob { mass: 0.5, com: -0.4 * Z, inertia: diag(0.01, 0.02, 0.01) }
        joint a: Revolute { parent: ground, child: sun, axis: X }
        joint b: Revolute { parent: ground.at(0.3 * Y), child: wheel, axis: X }
        joint slide: Prismatic { parent: ground, child: carriage, axis: [0.0, 0.6, 0.8] }
        joint swing: Revolute { parent: carriage, child: bob, axis: X }
        constraint mesh = 3.0 * b.angle + a.angle;
        constraint rack = b.angle * 0.2 - slide.travel + 0.05;
        force motor: Effort { joint: a, value: torque }
        output angles = [a.angle, b.angle, slide.travel, swing.angle];
        output rates = [a.rate, b.rate, slide.rate, swing.rate];
        output accels = [a.accel, b.accel, slide.accel, swing.accel];
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// The same with equations kept.
    pub mod geared_multipliers {
        world { gravity: -9.81 * Z }
        formulation { constraints: Multipliers }
        input torque;
        body sun { mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }
        body wheel { mass: 2.0, com: 0.1 * Y, inertia: diag(0.05, 0.05, 0.1) }
        body carriage { mass: 3.0 }
        body bob { mass: 0.5, com: -0.4 * Z, inertia: diag(0.01, 0.02, 0.01) }
        joint a: Revolute { parent: ground, child: sun, axis: X }
        joint b: Revolute { parent: ground.at(0.3 * Y), child: wheel, axis: X }
        joint slide: Prismatic { parent: ground, child: carriage, axis: [0.0, 0.6, 0.8] }
        joint swing: Revolute { parent: carriage, child: bob, axis: X }
        constraint mesh = 3.0 * b.angle + a.angle;
        constraint rack = b.angle * 0.2 - slide.travel + 0.05;
        force motor: Effort { joint: a, value: torque }
        output angles = [a.angle, b.angle, slide.travel, swing.angle];
        output rates = [a.rate, b.rate, slide.rate, swing.rate];
        output accels = [a.accel, b.accel, slide.accel, swing.accel];
        output energy = kinetic() + potential();
        emit forward_dynamics, residual;
    }
}

multibody! {
    /// Equations that change with time, and a rod.
    pub mod shaken {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body bob { mass: 0.7, com: 0.3 * X, inertia: rod(0.7, 0.6, X) }
        body cart { mass: 2.0 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint elbow: Revolute { parent: arm.at(X), child: bob, axis: Z }
        joint rail: Prismatic { parent: ground, child: cart, axis: X }
        /// the cart follows the elbow, and shakes
        constraint follow = rail.travel - cos(crank.angle) * cos(crank.angle) - 0.1 * sin(3.0 * t);
        constraint link: Rod { between: [bob.at(0.6 * X), cart.at(-Y)], length: 1.4 }
        output tip = bob.at(0.6 * X).position;
        emit forward_dynamics, residual, energy;
    }
}

multibody! {
    /// A Delta robot whose plate cannot turn.
    pub mod delta {
        const ANGLES: [Scalar; 3] = [0.0, 2.0943951023931953, 4.1887902047863905];
        world { gravity: -9.81 * Z }
        formulation { constraints: Reduced }
        input torque: [Scalar; 3];
        body plate {
            mass: 0.8, com: [0.01, 0.02, -0.03], inertia: diag(0.01, 0.01, 0.02), coordinates: Absolute(RollPitchYaw),
        }
        body arm0 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor0: Revolute { parent: ground.rotated(Z, ANGLES[0]).at(0.25 * X), child: arm0, axis: -Y }
        force torque0: Effort { joint: motor0, value: torque[0] }
        constraint rod0_left: Rod {
            between: [arm0.at([0.3, 0.0, 0.0]), plate.rotated(Z, ANGLES[0]).at([0.08, 0.0, 0.0])], length: 0.7,
        }
        let pin0 = plate.rotated(Z, ANGLES[0]).at(0.08 * X).position;
        let out0 = dot(pin0, [cos(ANGLES[0]), sin(ANGLES[0]), 0.0]) - 0.25;
        solve (motor0) from rod0_left { cos(motor0.angle) * pin0.z - sin(motor0.angle) * out0 < 0.0 }
        body arm1 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor1: Revolute { parent: ground.rotated(Z, ANGLES[1]).at(0.25 * X), child: arm1, axis: -Y }
        force torque1: Effort { joint: motor1, value: torque[1] }
        constraint rod1_left: Rod {
            between: [arm1.at([0.3, 0.0, 0.0]), plate.rotated(Z, ANGLES[1]).at([0.08, 0.0, 0.0])], length: 0.7,
        }
        let pin1 = plate.rotated(Z, ANGLES[1]).at(0.08 * X).position;
        let out1 = dot(pin1, [cos(ANGLES[1]), sin(ANGLES[1]), 0.0]) - 0.25;
        solve (motor1) from rod1_left { cos(motor1.angle) * pin1.z - sin(motor1.angle) * out1 < 0.0 }
        body arm2 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor2: Revolute { parent: ground.rotated(Z, ANGLES[2]).at(0.25 * X), child: arm2, axis: -Y }
        force torque2: Effort { joint: motor2, value: torque[2] }
        constraint rod2_left: Rod {
            between: [arm2.at([0.3, 0.0, 0.0]), plate.rotated(Z, ANGLES[2]).at([0.08, 0.0, 0.0])], length: 0.7,
        }
        let pin2 = plate.rotated(Z, ANGLES[2]).at(0.08 * X).position;
        let out2 = dot(pin2, [cos(ANGLES[2]), sin(ANGLES[2]), 0.0]) - 0.25;
        solve (motor2) from rod2_left { cos(motor2.angle) * pin2.z - sin(motor2.angle) * out2 < 0.0 }
        drive plate.orientation = identity();
        output angles = [motor0.angle, motor1.angle, motor2.angle];
        output rates = [motor0.rate, motor1.rate, motor2.rate];
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics;
    }
    /// The same with six rods, which keep the plate from turning.
    pub mod delta_rods {
        const ANGLES: [Scalar; 3] = [0.0, 2.0943951023931953, 4.1887902047863905];
        world { gravity: -9.81 * Z }
        formulation { constraints: Multipliers }
        input torque: [Scalar; 3];
        body plate {
            mass: 0.8, com: [0.01, 0.02, -0.03], inertia: diag(0.01, 0.01, 0.02), coordinates: Absolute(RollPitchYaw),
        }
        body arm0 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor0: Revolute { parent: ground.rotated(Z, ANGLES[0]).at(0.25 * X), child: arm0, axis: -Y }
        force torque0: Effort { joint: motor0, value: torque[0] }
        constraint rod0_left: Rod {
            between: [arm0.at([0.3, 0.06, 0.0]), plate.rotated(Z, ANGLES[0]).at([0.08, 0.06, 0.0])], length: 0.7,
        }
        constraint rod0_right: Rod {
            between: [arm0.at([0.3, -0.06, 0.0]), plate.rotated(Z, ANGLES[0]).at([0.08, -0.06, 0.0])], length: 0.7,
        }
        body arm1 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor1: Revolute { parent: ground.rotated(Z, ANGLES[1]).at(0.25 * X), child: arm1, axis: -Y }
        force torque1: Effort { joint: motor1, value: torque[1] }
        constraint rod1_left: Rod {
            between: [arm1.at([0.3, 0.06, 0.0]), plate.rotated(Z, ANGLES[1]).at([0.08, 0.06, 0.0])], length: 0.7,
        }
        constraint rod1_right: Rod {
            between: [arm1.at([0.3, -0.06, 0.0]), plate.rotated(Z, ANGLES[1]).at([0.08, -0.06, 0.0])], length: 0.7,
        }
        body arm2 { mass: 0.4, com: 0.15 * X, inertia: rod(0.4, 0.3, X) }
        joint motor2: Revolute { parent: ground.rotated(Z, ANGLES[2]).at(0.25 * X), child: arm2, axis: -Y }
        force torque2: Effort { joint: motor2, value: torque[2] }
        constraint rod2_left: Rod {
            between: [arm2.at([0.3, 0.06, 0.0]), plate.rotated(Z, ANGLES[2]).at([0.08, 0.06, 0.0])], length: 0.7,
        }
        constraint rod2_right: Rod {
            between: [arm2.at([0.3, -0.06, 0.0]), plate.rotated(Z, ANGLES[2]).at([0.08, -0.06, 0.0])], length: 0.7,
        }
        emit forward_dynamics, residual;
    }
}

multibody! {
    mod limb {
        port base: Frame;
        port tip: Frame;
        input torque;
        body upper { mass: 0.5, com: 0.2 * X, inertia: rod(0.5, 0.4, X) }
        body lower { mass: 0.3, com: 0.25 * X, inertia: rod(0.3, 0.5, X) }
        joint shoulder: Revolute { parent: base, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(0.4 * X), child: lower, axis: Z }
        #[cut]
        joint wrist: Revolute { parent: lower.at(0.5 * X), child: tip, axis: Z }
        force motor: Effort { joint: shoulder, value: torque }
        solve (shoulder, elbow) from wrist { sin(elbow.angle) > 0.0 }
    }
    /// A planar platform on three limbs, solved.
    pub mod planar_platform {
        const FEET: [Vec3; 3] = [[0.6, 0.0, 0.0], [-0.3, 0.52, 0.0], [-0.3, -0.52, 0.0]];
        const PINS: [Vec3; 3] = [[0.1, 0.02, 0.0], [-0.06, 0.09, 0.0], [-0.05, -0.1, 0.0]];
        world { gravity: [0.3, -9.7, 0.0] }
        formulation { constraints: Reduced }
        body plate { mass: 0.9, com: [0.02, 0.01, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        joint plane: Planar { parent: ground, child: plate, axis: Z }
        part limbs: [limb; 3] = |i| limb { base: ground.at(FEET[i]), tip: plate.at(PINS[i]) };
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics { solve_for: limbs.torque };
        emit kinematics { given: plane, find: [limbs.shoulder, limbs.elbow] };
    }
    /// Equations kept.
    pub mod planar_platform_multipliers {
        const FEET: [Vec3; 3] = [[0.6, 0.0, 0.0], [-0.3, 0.52, 0.0], [-0.3, -0.52, 0.0]];
        const PINS: [Vec3; 3] = [[0.1, 0.02, 0.0], [-0.06, 0.09, 0.0], [-0.05, -0.1, 0.0]];
        world { gravity: [0.3, -9.7, 0.0] }
        formulation { constraints: Multipliers }
        body plate { mass: 0.9, com: [0.02, 0.01, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        joint plane: Planar { parent: ground, child: plate, axis: Z }
        part limbs: [limb; 3] = |i| limb { base: ground.at(FEET[i]), tip: plate.at(PINS[i]) };
        emit forward_dynamics, inverse_dynamics { solve_for: limbs.torque }, residual;
    }
}

multibody! {
    mod leg {
        port base: Frame;
        port tip: Frame;
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Feet in general position, and a leg too many: more forces than freedoms.
    pub mod seven_legs {
        const FEET: [Vec3; 7] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.1], [-2.38, -1.224, 0.0], [-2.12, -1.374, -0.2], [0.0, -0.15, 0.0],
            [0.0, 0.15, 0.3], [-1.2, 0.3, -0.1],
        ];
        const PINS: [Vec3; 7] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.3], [0.17, -0.595, -0.4], [0.43, -0.445, -0.4],
            [0.43, 0.445, -0.45], [0.1, 0.0, -0.35],
        ];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body platform {
            mass: 1.5, com: [0.03, -0.02, 0.05], inertia: diag(0.08, 0.09, 0.1), coordinates: Absolute(Quaternion),
        }
        part legs: [leg; 7] = |i| leg { base: ground.at(FEET[i]).rotated(Z, 0.3 * i), tip: platform.at(PINS[i]) };
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
        emit kinematics { given: platform.pose, find: [legs.gimbal, legs.stroke] };
    }
    /// Equations kept.
    pub mod seven_legs_multipliers {
        const FEET: [Vec3; 7] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.1], [-2.38, -1.224, 0.0], [-2.12, -1.374, -0.2], [0.0, -0.15, 0.0],
            [0.0, 0.15, 0.3], [-1.2, 0.3, -0.1],
        ];
        const PINS: [Vec3; 7] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.3], [0.17, -0.595, -0.4], [0.43, -0.445, -0.4],
            [0.43, 0.445, -0.45], [0.1, 0.0, -0.35],
        ];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Multipliers }
        body platform {
            mass: 1.5, com: [0.03, -0.02, 0.05], inertia: diag(0.08, 0.09, 0.1), coordinates: Absolute(Quaternion),
        }
        part legs: [leg; 7] = |i| leg { base: ground.at(FEET[i]).rotated(Z, 0.3 * i), tip: platform.at(PINS[i]) };
        emit forward_dynamics;
    }
}

multibody! {
    /// Eight bodies, each on a joint of another kind.
    pub mod chain {
        world { gravity: [0.2, -0.3, -9.7] }

        body b0 { mass: 0.5, com: [0.02, 0.01, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j0: Revolute { parent: ground, child: b0.at([0.0, 0.05, 0.02]).rotated(Y, -0.2), axis: [0.3, 1.0, -0.2] }
        body b1 { mass: 0.6, com: [0.02, 0.02, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j1: Prismatic {
            parent: b0.at([0.1, 0.2, -0.1]).rotated(X, 0.2), child: b1.at([0.0, 0.05, 0.02]).rotated(Y, -0.3),
            axis: [1.0, 0.2, 0.0],
        }
        body b2 { mass: 0.7, com: [0.02, 0.03, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j2: Cylindrical {
            parent: b1.at([0.1, 0.2, -0.1]).rotated(X, 0.3), child: b2.at([0.0, 0.05, 0.02]).rotated(Y, -0.4),
            axis: [0.0, 1.0, 1.0],
        }
        body b3 { mass: 0.8, com: [0.02, 0.04, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j3: Universal {
            parent: b2.at([0.1, 0.2, -0.1]).rotated(X, 0.4), child: b3.at([0.0, 0.05, 0.02]).rotated(Y, -0.5),
            axes: [X, Y],
        }
        body b4 { mass: 0.9, com: [0.02, 0.05, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j4: Planar {
            parent: b3.at([0.1, 0.2, -0.1]).rotated(X, 0.5), child: b4.at([0.0, 0.05, 0.02]).rotated(Y, -0.6), axis: Z,
        }
        body b5 { mass: 1.0, com: [0.02, 0.06, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j5: Screw {
            parent: b4.at([0.1, 0.2, -0.1]).rotated(X, 0.6), child: b5.at([0.0, 0.05, 0.02]).rotated(Y, -0.7),
            axis: [1.0, 0.0, 2.0], pitch: 0.05,
        }
        body b6 { mass: 1.1, com: [0.02, 0.07, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j6: Ball {
            parent: b5.at([0.1, 0.2, -0.1]).rotated(X, 0.7), child: b6.at([0.0, 0.05, 0.02]).rotated(Y, -0.8),
        }
        body b7 { mass: 1.2, com: [0.02, 0.08, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j7: Fixed {
            parent: b6.at([0.1, 0.2, -0.1]).rotated(X, 0.8), child: b7.at([0.0, 0.05, 0.02]).rotated(Y, -0.9),
        }
        output p0 = b0.pose;
        output v0 = b0.velocity;
        output w0 = b0.express(b0.angular_velocity);
        output a0 = b0.acceleration;
        output e0 = b0.express(b0.angular_acceleration);
        output p1 = b1.pose;
        output v1 = b1.velocity;
        output w1 = b1.express(b1.angular_velocity);
        output a1 = b1.acceleration;
        output e1 = b1.express(b1.angular_acceleration);
        output p2 = b2.pose;
        output v2 = b2.velocity;
        output w2 = b2.express(b2.angular_velocity);
        output a2 = b2.acceleration;
        output e2 = b2.express(b2.angular_acceleration);
        output p3 = b3.pose;
        output v3 = b3.velocity;
        output w3 = b3.express(b3.angular_velocity);
        output a3 = b3.acceleration;
        output e3 = b3.express(b3.angular_acceleration);
        output p4 = b4.pose;
        output v4 = b4.velocity;
        output w4 = b4.express(b4.angular_velocity);
        output a4 = b4.acceleration;
        output e4 = b4.express(b4.angular_acceleration);
        output p5 = b5.pose;
        output v5 = b5.velocity;
        output w5 = b5.express(b5.angular_velocity);
        output a5 = b5.acceleration;
        output e5 = b5.express(b5.angular_acceleration);
        output p6 = b6.pose;
        output v6 = b6.velocity;
        output w6 = b6.express(b6.angular_velocity);
        output a6 = b6.acceleration;
        output e6 = b6.express(b6.angular_acceleration);
        output p7 = b7.pose;
        output v7 = b7.velocity;
        output w7 = b7.express(b7.angular_velocity);
        output a7 = b7.acceleration;
        output e7 = b7.express(b7.angular_acceleration);
        emit forward_dynamics;
    }
    /// The same with every joint cut.
    pub mod chain_absolute {
        world { gravity: [0.2, -0.3, -9.7] }
        formulation { coordinates: Absolute(Quaternion), constraints: Multipliers }
        body b0 { mass: 0.5, com: [0.02, 0.01, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j0: Revolute { parent: ground, child: b0.at([0.0, 0.05, 0.02]).rotated(Y, -0.2), axis: [0.3, 1.0, -0.2] }
        body b1 { mass: 0.6, com: [0.02, 0.02, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j1: Prismatic {
            parent: b0.at([0.1, 0.2, -0.1]).rotated(X, 0.2), child: b1.at([0.0, 0.05, 0.02]).rotated(Y, -0.3),
            axis: [1.0, 0.2, 0.0],
        }
        body b2 { mass: 0.7, com: [0.02, 0.03, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j2: Cylindrical {
            parent: b1.at([0.1, 0.2, -0.1]).rotated(X, 0.3), child: b2.at([0.0, 0.05, 0.02]).rotated(Y, -0.4),
            axis: [0.0, 1.0, 1.0],
        }
        body b3 { mass: 0.8, com: [0.02, 0.04, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j3: Universal {
            parent: b2.at([0.1, 0.2, -0.1]).rotated(X, 0.4), child: b3.at([0.0, 0.05, 0.02]).rotated(Y, -0.5),
            axes: [X, Y],
        }
        body b4 { mass: 0.9, com: [0.02, 0.05, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j4: Planar {
            parent: b3.at([0.1, 0.2, -0.1]).rotated(X, 0.5), child: b4.at([0.0, 0.05, 0.02]).rotated(Y, -0.6), axis: Z,
        }
        body b5 { mass: 1.0, com: [0.02, 0.06, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j5: Screw {
            parent: b4.at([0.1, 0.2, -0.1]).rotated(X, 0.6), child: b5.at([0.0, 0.05, 0.02]).rotated(Y, -0.7),
            axis: [1.0, 0.0, 2.0], pitch: 0.05,
        }
        body b6 { mass: 1.1, com: [0.02, 0.07, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j6: Ball {
            parent: b5.at([0.1, 0.2, -0.1]).rotated(X, 0.7), child: b6.at([0.0, 0.05, 0.02]).rotated(Y, -0.8),
        }
        body b7 { mass: 1.2, com: [0.02, 0.08, -0.03], inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        joint j7: Fixed {
            parent: b6.at([0.1, 0.2, -0.1]).rotated(X, 0.8), child: b7.at([0.0, 0.05, 0.02]).rotated(Y, -0.9),
        }
        emit forward_dynamics;
    }
}
