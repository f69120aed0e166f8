//! Models whose derivatives are tested: everything that equations of motion can hold.

use multibody::multibody;

multibody! {
    /// A finger of the craft below: own inputs, and a filter.
    mod finger {
        port base: Frame;
        /// [N m]
        input torque;
        body phalanx { mass: 0.4, com: 0.2 * X, inertia: diag(0.01, 0.03, 0.02) }
        joint knuckle: Revolute { parent: base, child: phalanx, axis: [0.0, 0.6, 0.8] }
        force motor: Effort { joint: knuckle, value: torque - 0.3 * knuckle.rate }
        state heat: rate = torque * torque - 0.2 * heat * knuckle.rate, start: 0.5;
    }
    /// A body that floats, with a ball, a wheel and two fingers; own states, inputs, forces of many kinds.
    pub mod craft {
        /// [kg]
        param payload = 1.7;
        /// [N/m]
        param stiffness = 12.0;
        world { gravity: [0.3, -0.2, -9.81] }
        /// [N] along the axes of the hull
        input thrust: Vec3;
        /// wheel torque, valve
        input commands: [Scalar; 2];
        body hull { mass: 4.0, com: [0.1, -0.2, 0.05], inertia: inertia(0.8, 0.9, 1.1, 0.05, -0.03, 0.02) }
        body head { mass: payload, com: [0.0, 0.1, 0.3], inertia: diag(0.2, 0.15, 0.1) }
        body wheel { mass: 0.8, com: [0.02, 0.0, 0.01], inertia: diag(0.05, 0.05, 0.08) }
        joint float: Free { parent: ground, child: hull }
        joint neck: Ball { parent: hull.at([0.0, 0.3, 0.2]), child: head.at([0.0, 0.0, -0.1]) }
        part fingers: [finger; 2] = |i| finger { base: hull.at([0.2, 0.0, 0.1]).rotated(X, [0.3, -0.7][i]) };
        joint axle: Revolute { parent: hull.at([0.4, 0.0, 0.0]), child: wheel, axis: Y, armature: 0.02 }

        force jet: Force { at: hull.at([0.0, 0.1, -0.2]), value: thrust, axes: hull }
        force wind: Force { at: head.at(0.1 * X), value: [0.4 * sin(2.0 * t), 0.1, 0.0], axes: ground }
        force twist: Torque { at: head, value: [0.0, 0.2 * lag, 0.1], axes: hull }
        force motor: Effort { joint: axle, value: commands[0] - 0.1 * abs(axle.rate) * axle.rate }
        force bush: SpringDamper {
            between: [wheel.at(0.2 * X), head.at(0.1 * Z)], stiffness: stiffness, damping: 0.7, length: 0.3,
        }
        force rubber: Spring { between: [head, ground], stiffness: 3.0, length: 0.0 }

        /// follows the valve, and feels the wheel
        state lag: rate = 3.0 * (commands[1] - lag) + 0.2 * axle.rate * cos(axle.angle), start: 0.3;
        /// [W]
        state work: rate = commands[0] * axle.rate + lag * powf(1.0 + work * work, 0.3), start: 0.1;
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
}

multibody! {
    /// Joints of the other kinds, one on the other, and efforts with kinks.
    pub mod rack {
        world { gravity: [0.3, -0.2, -9.81] }
        body sled { mass: 1.2, com: [0.1, 0.0, 0.1], inertia: diag(0.07, 0.08, 0.09) }
        body puck { mass: 0.6, com: [0.05, 0.02, 0.0], inertia: diag(0.03, 0.04, 0.05) }
        body bolt { mass: 0.5, com: [0.0, 0.03, 0.1], inertia: diag(0.02, 0.03, 0.01) }
        body piston { mass: 0.3, com: [0.0, 0.0, 0.2], inertia: diag(0.02, 0.02, 0.01) }
        body lamp { mass: 0.7, com: [0.05, 0.0, -0.2], inertia: diag(0.03, 0.02, 0.04) }
        joint gimbal: Universal { parent: ground.at([-0.4, 0.1, 0.0]), child: sled, axes: [X, Y] }
        joint table: Planar { parent: sled.at([0.0, 0.2, 0.0]), child: puck, axis: -Z }
        joint thread: Screw { parent: sled.at(0.2 * X), child: bolt, axis: Z, pitch: 0.05 }
        joint sleeve: Cylindrical { parent: puck.at(0.1 * Y), child: piston, axis: Y }
        joint cord: Ball { parent: piston.at([0.0, -0.3, 0.0]), child: lamp, coordinates: RollPitchYaw }
        force coil: SpringDamper { joint: thread, stiffness: 2.0, damping: 0.3 }
        force stop: Effort {
            joint: table,
            value: [
                -2.0 * max(table.x - 0.1, 0.0),
                min(table.y, 0.3) * table.x,
                select(table.angle > 0.2, -1.5, 0.4) * table.angle,
            ],
        }
        force oil: Effort {
            joint: sleeve, value: [-exp(0.5 * sleeve.travel) * gimbal.first, atan2(sleeve.angle, 2.0 + sleeve.travel)],
        }
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
}

multibody! {
    /// A four-bar in gravity on a cart that floats on a spring; its loop is solved.
    pub mod reduced {
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
        force spring: SpringDamper { between: [link.at(2.0 * Y), ground], stiffness: 8.0, damping: 0.4, length: 0.5 }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        state lag: rate = torque - 2.0 * lag * rocker.rate, start: 0.0;
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
    /// By Newton's method.
    pub mod iterated {
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
        force spring: SpringDamper { between: [link.at(2.0 * Y), ground], stiffness: 8.0, damping: 0.4, length: 0.5 }
        state lag: rate = torque - 2.0 * lag * rocker.rate, start: 0.0;
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
    /// With multipliers, stabilised.
    pub mod held {
        world { gravity: -9.81 * Y }
        formulation { constraints: Stabilised, rate: 4.0, position: 7.0 }
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
        force spring: SpringDamper { between: [link.at(2.0 * Y), ground], stiffness: 8.0, damping: 0.4, length: 0.5 }
        state lag: rate = torque - 2.0 * lag * rocker.rate, start: 0.0;
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
}

multibody! {
    /// A lever and a crank in space, joined by a rod without inertia about its own line; the crank's base is shaken.
    pub mod shaken {
        formulation { constraints: Reduced }
        world { gravity: -9.81 * Z }
        body base { mass: 2.0, inertia: diag(0.2, 0.2, 0.2) }
        body disc { mass: 1.0, com: 0.25 * X, inertia: diag(0.1, 0.1, 0.1) }
        body rod { mass: 0.5, com: 0.5 * X, inertia: diag(0.0, 0.05, 0.05) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint shaker: Prismatic { parent: ground, child: base, axis: X }
        joint driver: Revolute { parent: base, child: disc, axis: Z }
        joint gimbal: Universal { parent: disc.at(0.5 * X), child: rod, axes: [Z, Y] }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        #[cut]
        joint ball: Ball { parent: rod.at(X), child: lever.at(0.7 * Y) }
        drive shaker.travel = 0.05 * sin(3.0 * t);
        solve (shaft, gimbal) from ball {
            0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) > 0.0, cos(gimbal.second) > 0.0
        }
        force drag: Damper { joint: shaft, damping: 0.3 }
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
    /// A free rod without inertia about its own line between two balls: a mass matrix that is singular by structure.
    pub mod tied {
        formulation { constraints: Multipliers }
        world { gravity: -9.81 * Z }
        body left { mass: 1.0, com: 0.4 * X, inertia: diag(0.02, 0.1, 0.1) }
        body right { mass: 1.5, com: 0.3 * X, inertia: diag(0.03, 0.1, 0.1) }
        joint a: Revolute { parent: ground, child: left, axis: Z }
        joint b: Universal { parent: ground.at([1.5, 0.2, 0.1]), child: right, axes: [X, Z] }
        constraint tie: Rod { between: [left.at(0.8 * X), right.at(0.6 * X)], length: 1.0 }
        constraint gear = 0.5 * sin(a.angle) - b.second * b.first;
        emit forward_dynamics, inverse_dynamics, derivatives;
    }
}
