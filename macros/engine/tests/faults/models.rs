//! Models that use every stage that is broken, with all that they may emit, and with forward dynamics alone.

/// Name and text.
pub(crate) const MODELS: [(&str, &str); 15] = [
    (
        "double_pendulum",
        "mod double_pendulum {
            param l1 = 0.7;
            param l2 = 0.4;
            param m2 = 1.3;
            world { gravity: -9.81 * Y }
            body upper { mass: 2.0, com: -0.4 * l1 * Y, inertia: diag(0.1, 0.05, 0.12) }
            body lower { mass: m2, com: -0.5 * l2 * Y + 0.1 * X, inertia: diag(0.1, 0.03, 0.11) }
            joint shoulder: Universal { parent: ground, child: upper, axes: [Z, X] }
            joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
            emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, momentum;
        }",
    ),
    (
        "four_bar",
        "mod four_bar {
            param a = 0.1;
            param b = 0.31;
            param c = 0.25;
            param d = 0.29;
            world { gravity: -9.81 * Y }
            body crank { mass: 0.6, com: 0.5 * a * X, inertia: diag(0.0, 0.001, 0.001) }
            body coupler { mass: 1.1, com: 0.5 * b * X, inertia: diag(0.0, 0.01, 0.01) }
            body rocker { mass: 0.8, com: 0.5 * c * X, inertia: diag(0.0, 0.004, 0.004) }
            joint drive: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(a * X), child: coupler, axis: Z }
            joint pivot: Revolute { parent: ground.at(d * X), child: rocker, axis: Z }
            #[cut]
            joint close: Revolute { parent: coupler.at(b * X), child: rocker.at(c * X), axis: Z }
            solve (knee, pivot) from close { sin(pivot - knee - drive) > 0.0 }
            formulation { constraints: Reduced }
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
        }",
    ),
    (
        "held",
        "mod held {
            param d = 0.29;
            world { gravity: -9.81 * Y }
            body crank { mass: 0.6, com: 0.05 * X, inertia: diag(0.0, 0.001, 0.001) }
            body coupler { mass: 1.1, com: 0.155 * X, inertia: diag(0.0, 0.01, 0.01) }
            body rocker { mass: 0.8, com: 0.125 * X, inertia: diag(0.0, 0.004, 0.004) }
            joint drive: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(0.1 * X), child: coupler, axis: Z }
            joint pivot: Revolute { parent: ground.at(d * X), child: rocker, axis: Z }
            #[cut]
            joint close: Revolute { parent: coupler.at(0.31 * X), child: rocker.at(0.25 * X), axis: Z }
            formulation { constraints: Multipliers }
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy, derivatives;
        }",
    ),
    (
        "pointer",
        "mod pointer {
            world { gravity: -9.81 * Y }
            body rod { mass: 2.0, com: -0.5 * Y, inertia: diag(0.1, 0.05, 0.12) }
            joint hinge: Revolute { parent: ground, child: rod, axis: Z }
            output bearing = atan2(2.0 * hinge + 1.0, cos(hinge) + 2.0);
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
        }",
    ),
    (
        "double_pendulum_alone",
        "mod double_pendulum_alone {
            param l1 = 0.7;
            param l2 = 0.4;
            param m2 = 1.3;
            world { gravity: -9.81 * Y }
            body upper { mass: 2.0, com: -0.4 * l1 * Y, inertia: diag(0.1, 0.05, 0.12) }
            body lower { mass: m2, com: -0.5 * l2 * Y + 0.1 * X, inertia: diag(0.1, 0.03, 0.11) }
            joint shoulder: Universal { parent: ground, child: upper, axes: [Z, X] }
            joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
            emit forward_dynamics;
        }",
    ),
    (
        "four_bar_alone",
        "mod four_bar_alone {
            param a = 0.1;
            param b = 0.31;
            param c = 0.25;
            param d = 0.29;
            world { gravity: -9.81 * Y }
            body crank { mass: 0.6, com: 0.5 * a * X, inertia: diag(0.0, 0.001, 0.001) }
            body coupler { mass: 1.1, com: 0.5 * b * X, inertia: diag(0.0, 0.01, 0.01) }
            body rocker { mass: 0.8, com: 0.5 * c * X, inertia: diag(0.0, 0.004, 0.004) }
            joint drive: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(a * X), child: coupler, axis: Z }
            joint pivot: Revolute { parent: ground.at(d * X), child: rocker, axis: Z }
            #[cut]
            joint close: Revolute { parent: coupler.at(b * X), child: rocker.at(c * X), axis: Z }
            solve (knee, pivot) from close { sin(pivot - knee - drive) > 0.0 }
            formulation { constraints: Reduced }
            emit forward_dynamics;
        }",
    ),
    (
        "held_alone",
        "mod held_alone {
            param d = 0.29;
            world { gravity: -9.81 * Y }
            body crank { mass: 0.6, com: 0.05 * X, inertia: diag(0.0, 0.001, 0.001) }
            body coupler { mass: 1.1, com: 0.155 * X, inertia: diag(0.0, 0.01, 0.01) }
            body rocker { mass: 0.8, com: 0.125 * X, inertia: diag(0.0, 0.004, 0.004) }
            joint drive: Revolute { parent: ground, child: crank, axis: Z }
            joint knee: Revolute { parent: crank.at(0.1 * X), child: coupler, axis: Z }
            joint pivot: Revolute { parent: ground.at(d * X), child: rocker, axis: Z }
            #[cut]
            joint close: Revolute { parent: coupler.at(0.31 * X), child: rocker.at(0.25 * X), axis: Z }
            formulation { constraints: Multipliers }
            emit forward_dynamics;
        }",
    ),
    (
        "floating_alone",
        "mod floating_alone {
            input torque;
            world { gravity: -9.81 * Y }
            body hull { mass: 3.0, com: 0.1 * X + 0.05 * Z, inertia: inertia(0.3, 0.4, 0.5, 0.01, -0.02, 0.03) }
            body fin { mass: 0.4, com: 0.2 * X - 0.1 * Y, inertia: inertia(0.02, 0.03, 0.04, 0.001, 0.002, 0.003) }
            joint base: Free { parent: ground, child: hull }
            joint hinge: Revolute { parent: hull.at(0.4 * X), child: fin, axis: Z }
            force motor: Effort { joint: hinge, value: torque - 0.1 * hinge.rate }
            emit forward_dynamics;
        }",
    ),
    (
        "chain_alone",
        "mod chain_alone {
            world { gravity: -9.81 * Y }
            body a { mass: 0.9, com: 0.1 * X, inertia: inertia(0.03, 0.04, 0.05, 0.001, -0.002, 0.003) }
            body b { mass: 0.8, com: 0.2 * Y, inertia: inertia(0.03, 0.04, 0.05, 0.002, -0.001, 0.004) }
            body c { mass: 0.7, com: 0.1 * Z, inertia: inertia(0.02, 0.03, 0.04, 0.001, 0.002, -0.003) }
            body d { mass: 0.6, com: 0.3 * X, inertia: inertia(0.02, 0.03, 0.04, 0.003, 0.001, 0.002) }
            body e { mass: 0.5, com: 0.1 * Y, inertia: inertia(0.02, 0.02, 0.03, 0.001, 0.002, 0.001) }
            joint ja: Revolute { parent: ground, child: a, axis: Z }
            joint jb: Revolute { parent: a.at(0.3 * X + 0.1 * Y), child: b, axis: X }
            joint jc: Revolute { parent: b.at(0.2 * Z + 0.1 * Y), child: c, axis: Y }
            joint jd: Revolute { parent: c.at(0.2 * X + 0.3 * Y), child: d, axis: Z }
            joint je: Revolute { parent: d.at(0.1 * X + 0.2 * Z), child: e, axis: X }
            emit forward_dynamics;
        }",
    ),
    (
        "oblique",
        "mod oblique {
            param k = 30.0;
            world { gravity: -9.81 * Y }
            body nut { mass: 0.9, com: 0.1 * X, inertia: inertia(0.03, 0.04, 0.05, 0.001, -0.002, 0.003) }
            body arm { mass: 0.8, com: 0.2 * Y, inertia: inertia(0.03, 0.04, 0.05, 0.002, -0.001, 0.004) }
            joint thread: Screw { parent: ground.rotated(X, 0.3), child: nut, axis: [1.0, 2.0, 2.0], pitch: 0.02 }
            joint hinge: Revolute { parent: nut.at(0.1 * X), child: arm, axis: [0.6, 0.0, 0.8] }
            force spring: SpringDamper { joint: hinge, stiffness: k, damping: 0.4 }
            emit inverse_dynamics;
        }",
    ),
    (
        "wishbone",
        "mod wishbone {
            world { gravity: -9.81 * Z }
            body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
            body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
            body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
            joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
            joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
            joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
            #[cut]
            joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
            constraint tie: Rod {
                between: [ground.at([0.05, -0.12, 0.08]), upright.at([0.0, -0.13, 0.08])], length: 0.37 }
            assume (cos(low) > 0.9);
            solve (up, pivot) from (head, tie) { up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw) > 0.0 }
            formulation { constraints: Reduced }
            emit forward_dynamics;
        }",
    ),
    (
        "delta",
        "mod delta {
            world { gravity: -9.81 * Z }
            body one { mass: 1.1, com: [0.14, 0.01, -0.02], inertia: diag(0.002, 0.03, 0.031) }
            body two { mass: 1.2, com: [0.15, -0.01, 0.02], inertia: diag(0.003, 0.032, 0.033) }
            body three { mass: 1.3, com: [0.13, 0.02, 0.01], inertia: diag(0.004, 0.034, 0.036) }
            body along { mass: 0.2 }
            body across { mass: 0.3 }
            body plate { mass: 2.5 }
            joint a: Revolute { parent: ground.at(0.2 * X), child: one, axis: [0.03, 1.0, -0.05] }
            joint b: Revolute { parent: ground.rotated(Z, 2.1).at(0.21 * X), child: two, axis: Y }
            joint c: Revolute { parent: ground.rotated(Z, -2.1).at(0.19 * X), child: three, axis: Y }
            joint x: Prismatic { parent: ground, child: along, axis: [1.0, 0.1, 0.0] }
            joint y: Prismatic { parent: along, child: across, axis: Y }
            joint z: Prismatic { parent: across, child: plate, axis: Z }
            constraint first: Rod { between: [one.at(0.31 * X), plate.at(0.06 * X)], length: 0.81 }
            constraint second: Rod { between: [two.at(0.29 * X), plate.at([-0.03, 0.05, 0.01])], length: 0.79 }
            constraint third: Rod { between: [three.at(0.3 * X), plate.at([-0.02, -0.06, 0.0])], length: 0.82 }
            assume (cos(a) > 0.6 && cos(b) > 0.6 && cos(c) > 0.6);
            solve (x, y, z) from (first, second, third) { z < 0.0 }
            formulation { constraints: Reduced }
            emit forward_dynamics;
        }",
    ),
    (
        "spider",
        "mod leg {
            port hip: Frame;
            param side = 1.0;
            body thigh { mass: 0.4, com: [0.12, 0.03 * side, -0.02], inertia: diag(0.002, 0.004, 0.005) }
            body shin { mass: 0.3, com: [0.17, -0.02 * side, 0.01], inertia: diag(0.001, 0.003, 0.003) }
            joint lift: Revolute { parent: hip, child: thigh, axis: [0.1 * side, 1.0, 0.2 * side] }
            joint knee: Revolute { parent: thigh.at([0.3, 0.02 * side, -0.01]), child: shin, axis: Y }
        }
        mod spider {
            formulation { packs: Four }
            const HIPS: [Vec3; 4] = [[0.31, 0.22, 0.03], [0.31, -0.22, 0.03], [-0.28, 0.19, 0.05], [-0.28, -0.19, 0.05]];
            const SIDES: [Scalar; 4] = [1.0, -1.0, 1.0, -1.0];
            world { gravity: [0.3, -0.2, -9.7] }
            body trunk { mass: 2.1, com: [0.02, -0.01, 0.03], inertia: diag(0.031, 0.043, 0.059) }
            joint float: Free { parent: ground, child: trunk }
            part legs: [leg; 4] = |i| leg { hip: trunk.at(HIPS[i]).rotated(X, 0.1 * SIDES[i]), side: SIDES[i] };
            emit forward_dynamics, inverse_dynamics;
            emit at { functions: [forward_dynamics, inverse_dynamics] };
        }",
    ),
    (
        "pair_at",
        "mod pair_at {
            param l = 0.7;
            world { gravity: -9.81 * Y }
            body upper { mass: 2.0, com: -0.4 * l * Y + 0.1 * Z, inertia: inertia(0.1, 0.05, 0.12, 0.01, 0.02, -0.01) }
            body lower { mass: 1.3, com: 0.1 * X - 0.2 * Y, inertia: diag(0.1, 0.03, 0.11) }
            joint shoulder: Universal { parent: ground, child: upper, axes: [[1.0, 2.0, 2.0], [2.0, 1.0, -2.0]] }
            joint elbow: Revolute { parent: upper.at(-l * Y), child: lower, axis: [0.6, 0.0, 0.8] }
            emit forward_dynamics, inverse_dynamics, mass_matrix;
            emit at { functions: [forward_dynamics, inverse_dynamics, mass_matrix] };
        }",
    ),
    (
        "three_two_one",
        "mod leg {
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
        mod three_two_one {
            param FEET: [Vec3; 6] = [
                [-2.12, 1.374, 0.07], [-2.38, 1.024, -0.13], [-2.18, -1.224, 0.21], [-2.02, -1.474, -0.05],
                [0.13, -0.25, 0.11], [0.09, 0.45, -0.17],
            ];
            param PINS: [Vec3; 3] = [[0.17, 0.595, -0.43], [-0.57, -0.15, -0.41], [0.53, -0.345, -0.32]];
            let ends = [PINS[0], PINS[1], PINS[0], PINS[2], PINS[0], PINS[1]];
            body plate { mass: 1.5, inertia: diag(0.08, 0.07, 0.09), coordinates: Absolute(RollPitchYaw) }
            part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated([1.0, 2.0, 0.3], 0.3), tip: plate.at(ends[i]) };
            formulation { constraints: Multipliers }
            emit assembly_modes { given: legs.stroke, find: plate.pose };
        }",
    ),
];
