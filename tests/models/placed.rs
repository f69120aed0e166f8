//! Bodies that are found from what holds them: forward kinematics of parallel robots, by Newton's method.

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
    /// A platform on six legs whose feet and pins are nowhere in line, with all coordinates in the state.
    pub mod platform {
        param FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.07], [-2.38, 1.024, -0.13], [-2.18, -1.224, 0.21], [-2.02, -1.474, -0.05],
            [0.13, -0.25, 0.11], [0.09, 0.45, -0.17],
        ];
        param PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.43], [-0.6, 0.25, -0.36], [-0.57, -0.15, -0.41], [0.27, -0.595, -0.38],
            [0.43, -0.345, -0.47], [0.53, 0.445, -0.32],
        ];
        const AXES: [Vec3; 6] = [
            [1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9],
        ];
        const TURNS: [Scalar; 6] = [0.31, -0.52, 0.23, 0.4, -2.85, 2.85];
        body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit kinematics { given: legs.stroke, find: plate.pose };
        emit kinematics { given: plate.pose, find: [legs.gimbal, legs.stroke] };
        emit kinematics { given: [legs.stroke], find: [plate.pose, legs.gimbal] };
    }
}

multibody! {
    mod limb {
        port hip: Frame; port left: Frame; port right: Frame;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut] joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut] joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right }
    }
    /// Delta robot whose rods are bodies.
    pub mod delta {
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics, kinematics { given: limbs.shoulder, find: [plate.pose, limbs.elbow_a, limbs.elbow_b] };
    }
}

multibody! {
    /// A parallelogram by its user's formulas. Its mass matrix is a number that is written with the angle.
    pub mod parallelogram {
        param l = 1.0;
        world { gravity: -9.8 * Y }
        body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
        body b { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        body c { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        joint p: Revolute { parent: ground, child: a, axis: Z }
        joint q: Revolute { parent: a.at(l * X), child: b, axis: Z }
        joint r: Revolute { parent: ground.at(0.7 * X + 0.1 * Y), child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(0.7 * X + 0.1 * Y), child: c.at(l * X), axis: Z }
        solve (q) = (-p.angle);
        solve (r) = (p.angle);
        formulation { constraints: Reduced, independent: [p] }
        emit forward_dynamics;
    }
}

multibody! {
    /// A slider-crank whose crank follows from the slider, by the formula that the other way round needs none of.
    pub mod press {
        param r = 0.31;
        param l = 0.83;
        body crank { mass: 1.0, com: 0.5 * r * X, inertia: rod(1.0, r, X) }
        body rod { mass: 1.0, com: 0.5 * l * X, inertia: rod(1.0, l, X) }
        body slider { mass: 1.0 }
        joint turn: Revolute { parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(r * X), child: rod, axis: Z }
        joint rail: Prismatic { parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: slider, axis: X }
        #[cut] joint pin: Revolute { parent: rod.at(l * X), child: slider, axis: Z }
        formulation { constraints: Multipliers }
        emit kinematics { given: rail, find: [turn, knee] };
    }
}

multibody! {
    /// A four-bar with a wheel geared to two of its hinges, closed by Newton's method for all that is asked.
    pub mod geared_bar {
        world { gravity: -9.81 * Y }
        input torque;
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        body wheel { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint turn: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint swing: Revolute { parent: ground.at(4.0 * X), child: rocker, axis: Z }
        joint spin: Revolute { parent: ground, child: wheel, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
        constraint gear = spin - 0.5 * knee - turn;
        force motor: Effort { joint: turn, value: torque }
        force spring: Effort { joint: knee, value: -7.0 * knee }
        formulation { constraints: Reduced, independent: [turn] }
        emit kinematics { given: turn, find: [knee] };
    }
}
