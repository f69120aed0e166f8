//! Mechanisms with closed loops; `loops.hpp` builds the same trees.

use multibody::multibody;

multibody! {
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
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// The Stewart-Gough manipulator with Tsai's data: platform absolute, legs relative.
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
        formulation { constraints: Multipliers }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics;
    }
    /// The platform alone is the state.
    pub mod stewart_reduced {
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
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
        emit kinematics { given: platform.pose, find: legs.stroke };
    }
    /// The same with legs in packs.
    pub mod stewart_packed {
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
        formulation { constraints: Reduced, packs: Four }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
        emit kinematics { given: platform.pose, find: legs.stroke };
    }
}

multibody! {
    mod limb {
        port hip: Frame;
        port left: Frame;
        port right: Frame;
        /// [N m]
        input torque;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut]
        joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut]
        joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right }
        force motor: Effort { joint: shoulder, value: torque }
    }
    /// Delta robot whose rods are bodies.
    pub mod delta {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Multipliers }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };
        emit forward_dynamics;
    }
}

multibody! {
    /// The same limb, its rods parallel.
    mod limb {
        port hip: Frame;
        port pin: Frame;
        /// [N m]
        input torque;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut]
        joint wrist: Ball { parent: rod_a.at(0.8 * X), child: pin }
        constraint parallel_first = elbow_b.first - elbow_a.first;
        constraint parallel_second = elbow_b.second - elbow_a.second;
        solve (shoulder, elbow_a) from wrist { cos(elbow_a.second) > 0.0, sin(elbow_a.first) > 0.0 }
        force motor: Effort { joint: shoulder, value: torque }
    }
    /// The Delta robot in the plate's position: six rods hold the plate level, so the rods of a pair stay parallel.
    pub mod delta_reduced {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            pin: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
        };
        drive plate.orientation = identity();
        emit forward_dynamics;
    }
}

multibody! {
    /// Three hinges at the hip, one at the knee; a crank on the shank turns the foot through a rod.
    mod leg {
        port hip: Frame;
        /// [N m] at the three hinges of the hip, the knee and the crank
        input torque: [Scalar; 5];
        body yoke { mass: 0.8, com: [0.01, 0.0, -0.02], inertia: diag(0.002, 0.0021, 0.0015) }
        body fork { mass: 0.9, com: [-0.01, 0.0, 0.0], inertia: diag(0.0018, 0.002, 0.0022) }
        body thigh {
            mass: 4.0, com: [0.005, 0.01, -0.17], inertia: inertia(0.06, 0.062, 0.009, 0.0003, 0.0011, -0.0006),
        }
        body shank {
            mass: 2.5, com: [0.004, -0.002, -0.16], inertia: inertia(0.035, 0.0355, 0.003, 0.0001, 0.0007, 0.0002),
        }
        body crank { mass: 0.15, com: -0.02 * X, inertia: diag(0.00002, 0.0001, 0.0001) }
        body rod { mass: 0.2, com: -0.175 * Z, inertia: diag(0.002, 0.002, 0.00001) }
        body foot { mass: 0.9, com: [0.04, 0.0, -0.04], inertia: inertia(0.0012, 0.004, 0.0042, 0.0, 0.0005, 0.0) }
        joint yaw: Revolute { parent: hip, child: yoke, axis: Z }
        joint roll: Revolute { parent: yoke.at(-0.05 * Z), child: fork, axis: X }
        joint pitch: Revolute { parent: fork, child: thigh, axis: Y }
        joint knee: Revolute { parent: thigh.at(-0.4 * Z), child: shank, axis: Y }
        joint drive: Revolute { parent: shank.at([-0.01, 0.03, -0.05]), child: crank, axis: Y }
        joint hinge: Revolute { parent: crank.at(-0.05 * X), child: rod, axis: Y }
        joint ankle: Revolute { parent: shank.at(-0.4 * Z), child: foot, axis: Y }
        #[cut]
        joint coupling: Revolute { parent: rod.at(-0.35 * Z), child: foot.at([-0.06, 0.03, 0.0]), axis: Y }
        force at_yaw: Effort { joint: yaw, value: torque[0] }
        force at_roll: Effort { joint: roll, value: torque[1] }
        force at_pitch: Effort { joint: pitch, value: torque[2] }
        force at_knee: Effort { joint: knee, value: torque[3] }
        force motor: Effort { joint: drive, value: torque[4] }
        solve (hinge, ankle) from coupling { cos(drive.angle + hinge.angle - ankle.angle) > 0.0 }
    }
    /// A biped whose ankles are driven through four-bar linkages, all coordinates in the state.
    pub mod biped {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Multipliers }
        body pelvis {
            mass: 12.0, com: [0.01, 0.0, 0.12], inertia: inertia(0.21, 0.17, 0.13, 0.002, -0.006, 0.001),
            coordinates: Absolute(Quaternion),
        }
        part legs: [leg; 2] = |i| leg { hip: pelvis.at([0.0, 0.1 - 0.2 * i, -0.05]) };
        emit forward_dynamics;
    }
    /// The biped without the coordinates that its linkages decide.
    pub mod biped_reduced {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body pelvis {
            mass: 12.0, com: [0.01, 0.0, 0.12], inertia: inertia(0.21, 0.17, 0.13, 0.002, -0.006, 0.001),
            coordinates: Absolute(Quaternion),
        }
        part legs: [leg; 2] = |i| leg { hip: pelvis.at([0.0, 0.1 - 0.2 * i, -0.05]) };
        emit forward_dynamics;
    }
    /// The same with legs in packs.
    pub mod biped_packed {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced, packs: Four }
        body pelvis {
            mass: 12.0, com: [0.01, 0.0, 0.12], inertia: inertia(0.21, 0.17, 0.13, 0.002, -0.006, 0.001),
            coordinates: Absolute(Quaternion),
        }
        part legs: [leg; 2] = |i| leg { hip: pelvis.at([0.0, 0.1 - 0.2 * i, -0.05]) };
        emit forward_dynamics;
    }
}
