//! The Stewart-Gough manipulator with Tsai's data (`data/stewart`), in the coordinates that one may choose.

use multibody::multibody;

multibody! {
    /// A leg; its spring is part of the actuator.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust - k * (stroke.travel - s0) - c * stroke.rate }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// The platform alone is the state.
    pub mod reduced {
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
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
        emit kinematics { given: platform.pose, find: [legs.gimbal, legs.stroke] };
    }
    /// The platform is kept level.
    pub mod level {
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
        drive platform.orientation = identity();
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
    }
}

multibody! {
    /// A leg with a spring on its stroke.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force strut: SpringDamper { joint: stroke, stiffness: k, damping: c, rest: s0 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Platform absolute, legs relative.
    pub mod hybrid {
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
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust }, residual;
    }
}

multibody! {
    /// A leg with a spring between its ends.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force strut: SpringDamper { between: [base, tip], stiffness: k, damping: c, length: 1.0 + s0 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Six coordinates for each of the thirteen bodies.
    pub mod absolute {
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
        formulation { coordinates: Absolute(RollPitchYaw), constraints: Multipliers }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust }, residual;
    }
}

multibody! {
    /// A leg with a spring between its ends.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force strut: SpringDamper { between: [base, tip], stiffness: k, damping: c, length: 1.0 + s0 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Coordinates of joints alone: the platform hangs on a leg.
    pub mod joint_coordinates {
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
        formulation { coordinates: Joint, constraints: Multipliers }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        output pose = platform.pose;
        output velocity = platform.velocity;
        output spin = platform.angular_velocity;
        output accel = platform.acceleration;
        output spin_accel = platform.angular_acceleration;
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust }, residual;
    }
}

multibody! {
    /// A leg that turns and has moments of inertia about its axis.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.35, com: 0.45 * Z, inertia: diag(0.015, 0.012, 0.004) }
        body piston { mass: 0.22, com: -0.55 * Z, inertia: diag(0.0095, 0.008, 0.002) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force strut: SpringDamper { joint: stroke, stiffness: k, damping: c, rest: s0 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// The platform alone is the state.
    pub mod heavy {
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
        body platform {
            mass: 1.5, inertia: inertia(0.08, 0.1, 0.13, 0.004, -0.003, 0.002), coordinates: Absolute(RollPitchYaw),
        }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
        emit kinematics { given: platform.pose, find: [legs.gimbal, legs.stroke] };
    }
    /// Platform absolute, legs relative.
    pub mod heavy_hybrid {
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
        body platform {
            mass: 1.5, inertia: inertia(0.08, 0.1, 0.13, 0.004, -0.003, 0.002), coordinates: Absolute(RollPitchYaw),
        }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics;
    }
}

multibody! {
    /// A leg that is known to stay long, and never to lie along the first axis of its gimbal.
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N/m] of a spring along the leg
        param k = 0.0;
        /// [N s/m] of a damper along the leg
        param c = 0.0;
        /// [m] stroke at which the spring is at rest
        param s0 = 0.0;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        assume stroke > -0.5;
        assume cos(gimbal.second) > 0.3;
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        force strut: SpringDamper { joint: stroke, stiffness: k, damping: c, rest: s0 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Platform absolute, legs relative.
    pub mod assumed_hybrid {
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
    /// Coordinates of joints alone: the platform hangs on a leg.
    pub mod assumed_joints {
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
        formulation { coordinates: Joint, constraints: Multipliers }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics;
    }
}
