//! Mechanisms with every joint and every force, for the laws that all motions keep.

use multibody::multibody;

multibody! {
    /// A tree with joints of all kinds in gravity, with springs: its energy stays.
    pub mod tree {
        /// [kg] of most bodies
        param m = 0.7;
        /// [m] reach of most bodies
        param reach: Vec3 = [0.2, -0.3, 0.25];
        /// N/m, and N m/rad, of all springs
        param k = 20.0;
        /// [N m] or [N], effort on every one-coordinate joint
        input push: [Scalar; 3];

        world { gravity: [0.3, -0.2, -9.7] }
        body cart { mass: 2.0, com: [0.05, 0.0, 0.02], inertia: cuboid(2.0, [0.4, 0.3, 0.1]) }
        body arm { mass: m, com: 0.5 * reach, inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        body slide { mass: m, com: [0.0, 0.1, 0.0], inertia: cylinder(m, 0.05, 0.3, Y) }
        body screw { mass: 0.3, com: [0.01, 0.0, 0.0], inertia: sphere(0.3, 0.08) }
        body drum { mass: 0.4, inertia: diag(0.01, 0.02, 0.015) }
        body gimbal { mass: 0.5, com: 0.3 * X, inertia: diag(0.01, 0.012, 0.013) }
        body hook { mass: 0.6, com: -0.2 * Z, inertia: diag(0.004, 0.005, 0.006) }
        body plate { mass: 0.2, com: [0.02, 0.03, 0.0], inertia: diag(0.001, 0.001, 0.002) }
        body weight { mass: 0.1, com: 0.1 * Y }

        joint floor: Planar { parent: ground.at([0.0, 0.0, 0.1]).rotated(X, 0.2), child: cart, axis: Z }
        joint shoulder: Revolute {
            parent: cart.at([0.1, 0.0, 0.2]).rotated(Y, 0.4), child: arm.at([0.02, 0.0, 0.0]), axis: [1.0, 2.0, -0.5],
            armature: 0.01,
        }
        joint rail: Prismatic { parent: arm.at(reach), child: slide.rotated(Z, -0.3), axis: [0.0, 1.0, 1.0] }
        joint thread: Screw { parent: cart.at(-0.2 * X), child: screw, axis: Z, pitch: 0.03 }
        joint sleeve: Cylindrical { parent: screw.at(0.1 * Z), child: drum, axis: Y }
        joint neck: Universal { parent: slide.at(0.2 * Y), child: gimbal, axes: [X, Y] }
        joint eye: Ball { parent: gimbal.at(0.4 * X), child: hook.at(0.05 * Z) }
        joint wrist: Ball { parent: arm.at(0.5 * reach), child: plate, coordinates: RollPitchYaw }
        joint weld: Fixed { parent: drum.at(0.1 * X), child: weight }
        force drive: Effort { joint: shoulder, value: push[0] }
        force lift: Effort { joint: rail, value: push[1] }
        force turn: Effort { joint: thread, value: push[2] }
        force stay: Spring { joint: shoulder, stiffness: k, rest: 0.3 }
        force rope: Spring { between: [plate.at(0.1 * X), ground.at(Z)], stiffness: k, length: 0.2 }
        force soft: Spring { between: [hook, cart.at(0.1 * Y)], stiffness: 3.0, length: 0.0 }
        force back: Spring { joint: rail, stiffness: k }
        force centre: Spring { joint: floor.x, stiffness: k }
        force other: Spring { joint: floor.y, stiffness: k }

        /// [J] of all motion, gravity and springs
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Two bodies without gravity, and forces of every kind: what they feed in is what moves. The cylinder's travel is
    /// damped, the dashpot ends at the ground.
    pub mod driven {
        /// [N]
        input thrust: Vec3;
        world { gravity: [0.0, 0.0, 0.0] }
        body first { mass: 1.3, com: 0.2 * X, inertia: diag(0.05, 0.06, 0.07) }
        body second { mass: 0.8, com: [0.1, 0.2, 0.0], inertia: inertia(0.02, 0.03, 0.04, 0.001, 0.002, 0.003) }
        joint pivot: Universal { parent: ground, child: first, axes: [Z, Y] }
        joint slide: Cylindrical { parent: first.at(0.4 * X), child: second, axis: [1.0, 1.0, 0.0] }
        force motor: Effort { joint: pivot.first, value: 0.5 * sin(3.0 * t) - 0.1 * pivot.first.rate }
        force pair: Effort { joint: slide, value: [0.3 * cos(t), 0.05] }
        force spring: Spring { joint: pivot.second, stiffness: 4.0, rest: 0.2 }
        force damper: Damper { joint: slide.travel, damping: 0.3 }
        force both: SpringDamper { joint: slide.angle, stiffness: 0.4, damping: 0.02 }
        force line: SpringDamper {
            between: [second.at(0.3 * Y), ground.at([0.5, 0.5, 0.5])], stiffness: 6.0, damping: 0.4, length: 0.3,
        }
        force elastic: Spring { between: [first.at(X), second], stiffness: 5.0, length: 0.4 }
        force dashpot: Damper { between: [first.at(X), ground.at(-Y)], damping: 0.2 }
        force jet: Force { at: second.at([0.1, 0.0, 0.3]), value: thrust, axes: second }
        force wind: Force { at: first.at(0.5 * X), value: [0.2, min(t, 1.0), -0.1], axes: ground }
        force gyro: Torque { at: second, value: [0.02, -0.03, select(t < 0.5, 0.01, 0.04)], axes: first }
        /// [W] of all forces
        output power = motor.power + pair.power + spring.power + damper.power + both.power + line.power + elastic.power
            + dashpot.power + jet.power + wind.power + gyro.power;
        /// [W] of the springs alone
        output of_springs = spring.power + elastic.power + both.power + line.power
            + 0.02 * powi(slide.angle.rate, 2) + 0.4 * powi(stretching, 2);
        let arm = second.at(0.3 * Y).position - [0.5, 0.5, 0.5];
        let stretching = dot(arm, second.at(0.3 * Y).velocity) / norm(arm);
        /// [J]
        output moving = kinetic();
        /// [J]
        output stored = potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
}

multibody! {
    /// A satellite with two arms that move by motors of their own: nothing from outside.
    pub mod satellite {
        input motors: [Scalar; 2];
        body hull { mass: 5.0, com: [0.1, 0.0, -0.05], inertia: diag(0.4, 0.5, 0.6) }
        body left { mass: 1.0, com: 0.5 * X, inertia: diag(0.01, 0.1, 0.1) }
        body right { mass: 1.5, com: 0.4 * Y, inertia: diag(0.12, 0.02, 0.13) }
        joint free: Free { parent: ground, child: hull }
        joint one: Revolute { parent: hull.at(0.3 * X), child: left, axis: Z }
        joint two: Revolute { parent: hull.at(-0.3 * X).rotated(Z, 0.7), child: right, axis: X }
        force a: Effort { joint: one, value: motors[0] }
        force b: Effort { joint: two, value: motors[1] }
        /// [m] centres of mass
        output centres = [hull.at([0.1, 0.0, -0.05]).position, left.at(0.5 * X).position, right.at(0.4 * Y).position];
        /// [m/s] of the centres of mass
        output velocities = [hull.at([0.1, 0.0, -0.05]).velocity, left.at(0.5 * X).velocity, right.at(0.4 * Y).velocity];
        /// [kg m^2/s] of every body about its centre of mass, in its axes
        output spins = [
            [0.4 * w_hull.x, 0.5 * w_hull.y, 0.6 * w_hull.z],
            [0.01 * w_left.x, 0.1 * w_left.y, 0.1 * w_left.z],
            [0.12 * w_right.x, 0.02 * w_right.y, 0.13 * w_right.z],
        ];
        let w_hull = hull.express(hull.angular_velocity);
        let w_left = left.express(left.angular_velocity);
        let w_right = right.express(right.angular_velocity);
        /// of the hull
        output hull_axes = hull.rotation;
        /// of the left arm
        output left_axes = left.rotation;
        /// of the right arm
        output right_axes = right.rotation;
        emit forward_dynamics, mass_matrix, energy;
    }
}

multibody! {
    /// A pendulum on a ball joint with a quaternion, and what hangs from it.
    pub mod by_quaternion {
        world { gravity: -9.81 * Z }
        body bob { mass: 1.2, com: [0.1, 0.2, -0.5], inertia: inertia(0.05, 0.06, 0.03, 0.002, 0.003, -0.004) }
        body tail { mass: 0.4, com: 0.2 * X, inertia: diag(0.002, 0.004, 0.005) }
        joint support: Ball { parent: ground.rotated(Y, 0.3), child: bob.at(0.1 * X).rotated(X, -0.2) }
        joint hinge: Revolute { parent: bob.at(-Z), child: tail, axis: Y }
        /// [m]
        output tip = tail.at(0.4 * X).position;
        /// [m/s]
        output velocity = tail.at(0.4 * X).velocity;
        /// [m/s^2]
        output acceleration = tail.at(0.4 * X).acceleration;
        /// at the support, in world axes
        output reaction = support.reaction;
        /// [J]
        output energy = kinetic() + potential();
        emit forward_dynamics, energy;
    }
    /// The same with roll, pitch and yaw.
    pub mod by_angles {
        world { gravity: -9.81 * Z }
        body bob { mass: 1.2, com: [0.1, 0.2, -0.5], inertia: inertia(0.05, 0.06, 0.03, 0.002, 0.003, -0.004) }
        body tail { mass: 0.4, com: 0.2 * X, inertia: diag(0.002, 0.004, 0.005) }
        joint support: Ball {
            parent: ground.rotated(Y, 0.3), child: bob.at(0.1 * X).rotated(X, -0.2), coordinates: RollPitchYaw,
        }
        joint hinge: Revolute { parent: bob.at(-Z), child: tail, axis: Y }
        /// [m]
        output tip = tail.at(0.4 * X).position;
        /// [m/s]
        output velocity = tail.at(0.4 * X).velocity;
        /// [m/s^2]
        output acceleration = tail.at(0.4 * X).acceleration;
        /// at the support, in world axes
        output reaction = support.reaction;
        /// [rad/s] in child axes
        output omega = support.angular_velocity;
        /// [J]
        output energy = kinetic() + potential();
        emit forward_dynamics, energy;
    }
}

multibody! {
    /// A limb of two rods.
    mod limb {
        port base: Frame;
        param m = 0.5;
        param l = 0.4;
        input torque;
        body thigh { mass: m, com: -0.5 * l * Z, inertia: rod(m, l, Z) }
        body shank { mass: 0.8 * m, com: -0.5 * l * Z, inertia: rod(0.8 * m, l, Z) }
        joint hip: Revolute { parent: base, child: thigh, axis: Y }
        joint knee: Revolute { parent: thigh.at(-l * Z), child: shank, axis: Y }
        force motor: Effort { joint: knee, value: torque }
    }
    /// A body with three limbs.
    pub mod walker {
        const HIPS: [Vec3; 3] = [[0.3, 0.0, 0.0], [-0.2, 0.2, 0.0], [-0.2, -0.2, 0.1]];
        world { gravity: -9.81 * Z }
        body trunk { mass: 3.0, inertia: diag(0.1, 0.2, 0.25) }
        joint rail: Prismatic { parent: ground, child: trunk, axis: Z }
        part limbs: [limb; 3] = |i| limb { base: trunk.at(HIPS[i]).rotated(Z, 0.5 + i), l: 0.3 + 0.1 * i };
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// The same without parts.
    pub mod walker_by_hand {
        input torque: [Scalar; 3];
        world { gravity: -9.81 * Z }
        body trunk { mass: 3.0, inertia: diag(0.1, 0.2, 0.25) }
        joint rail: Prismatic { parent: ground, child: trunk, axis: Z }
        body thigh0 { mass: 0.5, com: -0.15 * Z, inertia: rod(0.5, 0.3, Z) }
        body shank0 { mass: 0.4, com: -0.15 * Z, inertia: rod(0.4, 0.3, Z) }
        joint hip0: Revolute { parent: trunk.at([0.3, 0.0, 0.0]).rotated(Z, 0.5), child: thigh0, axis: Y }
        joint knee0: Revolute { parent: thigh0.at(-0.3 * Z), child: shank0, axis: Y }
        force motor0: Effort { joint: knee0, value: torque[0] }
        body thigh1 { mass: 0.5, com: -0.2 * Z, inertia: rod(0.5, 0.4, Z) }
        body shank1 { mass: 0.4, com: -0.2 * Z, inertia: rod(0.4, 0.4, Z) }
        joint hip1: Revolute { parent: trunk.at([-0.2, 0.2, 0.0]).rotated(Z, 1.5), child: thigh1, axis: Y }
        joint knee1: Revolute { parent: thigh1.at(-0.4 * Z), child: shank1, axis: Y }
        force motor1: Effort { joint: knee1, value: torque[1] }
        body thigh2 { mass: 0.5, com: -0.25 * Z, inertia: rod(0.5, 0.5, Z) }
        body shank2 { mass: 0.4, com: -0.25 * Z, inertia: rod(0.4, 0.5, Z) }
        joint hip2: Revolute { parent: trunk.at([-0.2, -0.2, 0.1]).rotated(Z, 2.5), child: thigh2, axis: Y }
        joint knee2: Revolute { parent: thigh2.at(-0.5 * Z), child: shank2, axis: Y }
        force motor2: Effort { joint: knee2, value: torque[2] }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
}

multibody! {
    /// A direct-current motor: the current is a state of its own.
    pub mod motor {
        /// [ohm]
        param resistance = 0.5;
        /// [H]
        param inductance = 0.02;
        /// [N m/A] and [V s]
        param constant = 0.1;
        /// [V]
        input voltage;
        body rotor { mass: 0.3, inertia: diag(0.01, 0.01, 0.004) }
        joint shaft: Revolute { parent: ground, child: rotor, axis: Z }
        /// [A]
        state current: rate = (voltage - resistance * current - constant * shaft.rate) / inductance, start: 0.0;
        force torque: Effort { joint: shaft, value: constant * current }
        emit forward_dynamics;
    }
}
