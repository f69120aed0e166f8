//! Parallel robots of which all assembly modes are known: by three points in turn, by polynomials, in a plane.

use multibody::multibody;

multibody! {
    mod leg {
        port base: Frame;
        port tip: Frame;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(0.9 * Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        solve (gimbal, stroke) from ball { stroke > -0.9, cos(gimbal.second) > 0.0 }
    }
    /// Two legs at each of three points of the plate: 16 modes.
    pub mod six_three {
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        const TURNS: [Scalar; 6] = [0.31, -0.52, 0.23, 0.4, -0.85, 0.65];
        param FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.07], [-2.38, 1.024, -0.13], [-2.18, -1.224, 0.21], [-2.02, -1.474, -0.05],
            [0.13, -0.25, 0.11], [0.09, 0.45, -0.17],
        ];
        param PINS: [Vec3; 3] = [[0.17, 0.595, -0.43], [-0.57, -0.15, -0.41], [0.53, -0.345, -0.32]];
        let ends = [PINS[0], PINS[0], PINS[1], PINS[1], PINS[2], PINS[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(ends[i]).rotated(AXES[5 - i], TURNS[i]),
        };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: [plate.pose, legs.gimbal] };
        emit kinematics { given: plate.pose, find: [legs.stroke, legs.gimbal] };
        emit kinematics { given: legs.stroke, find: [plate.pose, legs.gimbal] };
    }
    /// Two legs from each of three points of the ground: 16 modes.
    pub mod three_six {
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        const TURNS: [Scalar; 6] = [0.31, -0.52, 0.23, 0.4, -0.85, 0.65];
        param FEET: [Vec3; 3] = [[-2.12, 1.374, 0.07], [-2.18, -1.224, 0.21], [0.13, -0.25, 0.11]];
        param PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.43], [-0.6, 0.25, -0.36], [-0.57, -0.15, -0.41], [0.27, -0.595, -0.38],
            [0.43, -0.345, -0.47], [0.53, 0.445, -0.32],
        ];
        let from = [FEET[0], FEET[0], FEET[1], FEET[1], FEET[2], FEET[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg {
            base: ground.at(from[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: plate.pose };
        emit kinematics { given: plate.pose, find: legs.stroke };
    }
    /// An octahedron: two legs at each of three points on either side.
    pub mod octahedron {
        param FEET: [Vec3; 3] = [[-2.12, 1.374, 0.07], [-2.18, -1.224, 0.21], [0.13, -0.25, 0.11]];
        param PINS: [Vec3; 3] = [[0.17, 0.595, -0.43], [-0.57, -0.15, -0.41], [0.53, -0.345, -0.32]];
        let from = [FEET[0], FEET[1], FEET[1], FEET[2], FEET[2], FEET[0]];
        let ends = [PINS[0], PINS[0], PINS[1], PINS[1], PINS[2], PINS[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(from[i]), tip: plate.at(ends[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: plate.pose };
        emit kinematics { given: plate.pose, find: legs.stroke };
    }
    /// Flat, symmetric and with numbers that are written: several modes have the same point on the same circle.
    pub mod symmetric_octahedron {
        let foot = [X, -0.5 * X + 0.5 * sqrt(3.0) * Y, -0.5 * X - 0.5 * sqrt(3.0) * Y];
        let from = [foot[0], foot[0], foot[1], foot[1], foot[2], foot[2]];
        let pin = [-0.6 * foot[2], -0.6 * foot[0], -0.6 * foot[1]];
        let ends = [pin[0], pin[2], pin[0], pin[1], pin[1], pin[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(from[i]), tip: plate.at(ends[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: plate.pose };
    }
    /// The same of three legs at the centre and three around it.
    pub mod symmetric_hub {
        let foot = [X, -0.5 * X + 0.5 * sqrt(3.0) * Y, -0.5 * X - 0.5 * sqrt(3.0) * Y];
        let from = [0.8 * foot[0], foot[0], 0.8 * foot[1], foot[1], 0.8 * foot[2], foot[2]];
        let ends = [0.0 * X, 0.5 * foot[0], 0.0 * X, 0.5 * foot[1], 0.0 * X, 0.5 * foot[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(from[i]), tip: plate.at(ends[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: plate.pose };
    }
    /// Three legs at one point of the plate, and three at points of their own.
    pub mod three_one {
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        const TURNS: [Scalar; 6] = [0.31, -0.52, 0.23, 0.4, -0.85, 0.65];
        param FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.07], [-2.38, 1.024, -0.13], [-2.18, -1.224, 0.21], [-2.02, -1.474, -0.05],
            [0.13, -0.25, 0.11], [0.09, 0.45, -0.17],
        ];
        param PINS: [Vec3; 4] =
            [[0.17, 0.595, -0.43], [-0.57, -0.15, -0.41], [0.53, -0.345, -0.32], [0.27, -0.595, -0.38]];
        let ends = [PINS[0], PINS[1], PINS[0], PINS[2], PINS[0], PINS[3]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]), tip: plate.at(ends[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: plate.pose };
        emit kinematics { given: plate.pose, find: legs.stroke };
    }
    /// Three points of the plate in turn.
    pub mod three_two_one {
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        const TURNS: [Scalar; 6] = [0.31, -0.52, 0.23, 0.4, -0.85, 0.65];
        param FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.07], [-2.38, 1.024, -0.13], [-2.18, -1.224, 0.21], [-2.02, -1.474, -0.05],
            [0.13, -0.25, 0.11], [0.09, 0.45, -0.17],
        ];
        param PINS: [Vec3; 3] = [[0.17, 0.595, -0.43], [-0.57, -0.15, -0.41], [0.53, -0.345, -0.32]];
        let ends = [PINS[0], PINS[1], PINS[0], PINS[2], PINS[0], PINS[1]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]), tip: plate.at(ends[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: legs.stroke, find: [plate.pose, legs.gimbal] };
        emit kinematics { given: plate.pose, find: legs.stroke };
    }
}

multibody! {
    mod slide {
        port base: Frame;
        port end: Frame;
        param length = 1.3;
        body carriage { mass: 0.2, inertia: diag(0.001, 0.001, 0.001) }
        joint rail: Prismatic { parent: base, child: carriage, axis: [0.3, -0.2, 1.0] }
        constraint rod: Rod { between: [carriage.at(0.1 * X), end], length: length }
    }
    /// Rods from carriages on oblique rails: three hold a point beside the plate, three more points of their own.
    pub mod rails {
        param HUB: Vec3 = [0.21, -0.13, 0.34];
        param ENDS: [Vec3; 3] = [[0.31, 0.12, 0.05], [-0.22, 0.27, -0.04], [-0.17, -0.29, 0.11]];
        const FEET: [Vec3; 6] = [
            [1.1, 0.2, -0.9], [-0.7, 1.2, -0.8], [-0.6, -1.1, -1.1], [0.1, 0.3, -1.2], [0.8, -0.7, -0.7],
            [-0.4, 0.5, -1.3],
        ];
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        let ends = [HUB, ENDS[0], HUB, HUB, ENDS[1], ENDS[2]];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part slides: [slide; 6] = |i| slide {
            base: ground.at(FEET[i]).rotated(AXES[i], 0.3 - 0.1 * i),
            end: plate.at(ends[i]),
        };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: slides.rail, find: plate.pose };
    }
}

multibody! {
    mod arm {
        port base: Frame;
        port tip: Frame;
        param upper_length = 0.55;
        param lower_length = 0.62;
        body upper { mass: 0.3, com: 0.2 * X, inertia: diag(0.0001, 0.004, 0.004) }
        body lower { mass: 0.3, com: 0.2 * X, inertia: diag(0.0001, 0.005, 0.005) }
        joint crank: Revolute { parent: base, child: upper, axis: Z }
        joint knee: Revolute { parent: upper.at(upper_length * X), child: lower, axis: Z }
        #[cut]
        joint wrist: Revolute { parent: lower.at(lower_length * X), child: tip, axis: Z }
    }
    /// A plate in an oblique plane on three arms of two links each, their shoulders driven.
    pub mod three_arms {
        param FEET: [Vec3; 3] = [[0.0, 0.05, 0.0], [1.3, 0.1, 0.0], [0.5, 1.2, 0.0]];
        param PINS: [Vec3; 3] = [[-0.2, -0.1, 0.0], [0.25, -0.07, 0.0], [0.03, 0.21, 0.0]];
        body frame { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint stand: Fixed { parent: ground.at([0.3, -0.2, 0.7]).rotated([1.0, 2.0, 2.0], 0.7), child: frame }
        joint slide: Planar { parent: frame.at(0.4 * X), child: plate, axis: Z }
        part arms: [arm; 3] = |i| arm { base: frame.at(FEET[i]), tip: plate.at(PINS[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: arms.crank, find: slide };
    }
    /// The same with everything symmetric.
    pub mod symmetric_arms {
        let foot = [X, -0.5 * X + 0.5 * sqrt(3.0) * Y, -0.5 * X - 0.5 * sqrt(3.0) * Y];
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint slide: Planar { parent: ground, child: plate, axis: Z }
        part arms: [arm; 3] = |i| arm { base: ground.at(foot[i]), tip: plate.at(0.3 * foot[i]) };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: arms.crank, find: slide };
    }
    /// Two struts at one point of the plate, one at another, the plate's own frame turned against its joint's.
    pub mod planar_pair {
        param FEET: [Vec3; 3] = [[0.0, 0.05, 0.0], [1.3, 0.1, 0.0], [0.5, 1.2, 0.0]];
        param PINS: [Vec3; 2] = [[-0.2, -0.1, 0.0], [0.25, -0.07, 0.0]];
        let ends = [PINS[0], PINS[1], PINS[0]];
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint slide: Planar { parent: ground.rotated([2.0, -1.0, 2.0], 1.1), child: plate.rotated(Z, 0.3), axis: Z }
        part struts: [strut; 3] = |i| strut {
            base: ground.rotated([2.0, -1.0, 2.0], 1.1).at(FEET[i]),
            tip: plate.rotated(Z, 0.3).at(ends[i]),
        };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: struts.stroke, find: slide };
    }
    /// The same upside down: two struts from one point of the ground.
    pub mod planar_foot {
        param FEET: [Vec3; 2] = [[0.0, 0.05, 0.0], [1.3, 0.1, 0.0]];
        param PINS: [Vec3; 3] = [[-0.2, -0.1, 0.0], [0.25, -0.07, 0.0], [0.05, 0.23, 0.0]];
        let from = [FEET[0], FEET[1], FEET[0]];
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint slide: Planar { parent: ground.rotated([2.0, -1.0, 2.0], 1.1), child: plate, axis: Z }
        part struts: [strut; 3] = |i| strut {
            base: ground.rotated([2.0, -1.0, 2.0], 1.1).at(from[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit assembly_modes { given: struts.stroke, find: slide };
    }
    mod strut {
        port base: Frame;
        port tip: Frame;
        body cylinder { mass: 0.1, com: 0.3 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body piston { mass: 0.1, com: -0.3 * X, inertia: diag(0.0001, 0.003, 0.003) }
        joint swing: Revolute { parent: base, child: cylinder, axis: Z }
        joint stroke: Prismatic { parent: cylinder.at(0.5 * X), child: piston, axis: X }
        #[cut]
        joint pin: Revolute { parent: piston, child: tip, axis: Z }
    }
}
