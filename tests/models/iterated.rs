//! Mechanisms whose loops Newton's method closes, beside the same with multipliers, and in closed form where there is one.

use multibody::multibody;

multibody! {
    mod limb {
        port hip: Frame; port left: Frame; port right: Frame;
        input torque;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut] joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut] joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right }
        force motor: Effort { joint: shoulder, value: torque }
    }
    /// Delta robot whose rods are bodies, by Newton's method.
    pub mod delta_newton {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }
    /// Delta robot whose rods are bodies, with multipliers.
    pub mod delta_multipliers {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
}

multibody! {
    mod limb {
        port hip: Frame; port left: Frame; port right: Frame;
        input torque;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        body rod_a { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        body rod_b { mass: 0.1, com: 0.4 * X, inertia: diag(0.00001, 0.006, 0.006) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        joint elbow_a: Universal { parent: arm.at(0.3 * X + 0.05 * Y), child: rod_a, axes: [Y, Z] }
        joint elbow_b: Universal { parent: arm.at(0.3 * X - 0.05 * Y), child: rod_b, axes: [Y, Z] }
        #[cut] joint wrist_a: Ball { parent: rod_a.at(0.8 * X), child: left }
        #[cut] joint wrist_b: Ball { parent: rod_b.at(0.8 * X), child: right }
        force motor: Effort { joint: shoulder, value: torque }
        solve (shoulder, elbow_a) from wrist_a { sin(elbow_a.first) > 0.0, cos(elbow_a.second) > 0.0 }
        solve (elbow_b) = (elbow_a.first, elbow_a.second);
    }
    /// Delta robot whose rods are bodies, in closed form: its plate stands on parallelograms.
    pub mod delta_closed {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };
        formulation { constraints: Reduced }
        solve (plate.roll, plate.pitch, plate.yaw) = (0.0, 0.0, 0.0);
        emit forward_dynamics, kinematics { given: plate, find: [limbs.shoulder, limbs.elbow_a] };
    }
}

multibody! {
    mod limb {
        port hip: Frame; port tip: Frame;
        input thrust;
        body cylinder { mass: 0.4, com: 0.3 * Z, inertia: diag(0.01, 0.01, 0.001) }
        body piston { mass: 0.3, com: -0.3 * Z, inertia: diag(0.01, 0.01, 0.001) }
        joint hinge: Revolute { parent: hip, child: cylinder, axis: Y }
        joint stroke: Prismatic { parent: cylinder.at(0.8 * Z), child: piston, axis: Z }
        #[cut] joint ball: Ball { parent: piston, child: tip }
        force motor: Effort { joint: stroke, value: thrust }
    }
    /// Platform on three limbs of hinge, slide and ball, by Newton's method.
    pub mod rps_newton {
        world { gravity: -9.80665 * Z }
        body plate { mass: 2.0, inertia: diag(0.05, 0.05, 0.1), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.5 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.3 * X),
        };
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }
    /// Platform on three limbs of hinge, slide and ball, by three rounds of Newton's method.
    pub mod rps_near {
        world { gravity: -9.80665 * Z }
        body plate { mass: 2.0, inertia: diag(0.05, 0.05, 0.1), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.5 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.3 * X),
        };
        formulation { constraints: Reduced, rounds: 3 }
        emit forward_dynamics;
    }
    /// Platform on three limbs of hinge, slide and ball, with multipliers.
    pub mod rps_multipliers {
        world { gravity: -9.80665 * Z }
        body plate { mass: 2.0, inertia: diag(0.05, 0.05, 0.1), coordinates: Absolute(RollPitchYaw) }
        part limbs: [limb; 3] = |i| limb {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.5 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.3 * X),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
}

multibody! {
    /// Double wishbone with a tie rod, axes in general position, by Newton's method.
    pub mod wishbone_newton {
        world { gravity: -9.80665 * Z }
        input load;
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        force spring: Effort { joint: low, value: load - 5.0 * low.rate }
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }
    /// Double wishbone with a tie rod, axes in general position, by three rounds of Newton's method.
    pub mod wishbone_near {
        world { gravity: -9.80665 * Z }
        input load;
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        force spring: Effort { joint: low, value: load - 5.0 * low.rate }
        formulation { constraints: Reduced, rounds: 3 }
        emit forward_dynamics;
    }
    /// Double wishbone with a tie rod, axes in general position, with multipliers.
    pub mod wishbone_multipliers {
        world { gravity: -9.80665 * Z }
        input load;
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        force spring: Effort { joint: low, value: load - 5.0 * low.rate }
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    /// Double wishbone with a tie rod, axes in general position, in closed form: both loops together.
    pub mod wishbone_closed {
        world { gravity: -9.80665 * Z }
        input load;
        body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
        body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
        body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
        body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
        joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
        joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }
        joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }
        #[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }
        joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }
        #[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }
        force spring: Effort { joint: low, value: load - 5.0 * low.rate }
        formulation { constraints: Reduced }
        assume (cos(low) > 0.9);
        solve (up, pivot, rack) from (head, steer) {
            up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw) > 0.0, cos(rack.second) > 0.0
        }
        emit forward_dynamics;
    }
}

multibody! {
    /// Sarrus linkage: a straight line from two planes of hinges, by Newton's method.
    pub mod sarrus_newton {
        world { gravity: -9.80665 * Z }
        input push;
        body a1 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body a2 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body b1 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body b2 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body plate { mass: 1.0, com: [0.1, 0.1, 0.0], inertia: diag(0.02, 0.02, 0.03) }
        joint a: Revolute { parent: ground, child: a1, axis: Y }
        joint ab: Revolute { parent: a1.at(0.4 * X), child: a2, axis: Y }
        joint ac: Revolute { parent: a2.at(0.4 * X), child: plate, axis: Y }
        joint b: Revolute { parent: ground.at([0.6, -0.5, 0.0]), child: b1, axis: X }
        joint bb: Revolute { parent: b1.at(0.4 * Y), child: b2, axis: X }
        #[cut] joint bc: Revolute { parent: b2.at(0.4 * Y), child: plate.at([0.1, -0.003, 0.0]), axis: X }
        force motor: Effort { joint: a, value: push }
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }
    /// Sarrus linkage: a straight line from two planes of hinges, by three rounds of Newton's method.
    pub mod sarrus_near {
        world { gravity: -9.80665 * Z }
        input push;
        body a1 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body a2 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body b1 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body b2 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body plate { mass: 1.0, com: [0.1, 0.1, 0.0], inertia: diag(0.02, 0.02, 0.03) }
        joint a: Revolute { parent: ground, child: a1, axis: Y }
        joint ab: Revolute { parent: a1.at(0.4 * X), child: a2, axis: Y }
        joint ac: Revolute { parent: a2.at(0.4 * X), child: plate, axis: Y }
        joint b: Revolute { parent: ground.at([0.6, -0.5, 0.0]), child: b1, axis: X }
        joint bb: Revolute { parent: b1.at(0.4 * Y), child: b2, axis: X }
        #[cut] joint bc: Revolute { parent: b2.at(0.4 * Y), child: plate.at([0.1, -0.003, 0.0]), axis: X }
        force motor: Effort { joint: a, value: push }
        formulation { constraints: Reduced, rounds: 3 }
        emit forward_dynamics;
    }
    /// Sarrus linkage: a straight line from two planes of hinges, with multipliers.
    pub mod sarrus_multipliers {
        world { gravity: -9.80665 * Z }
        input push;
        body a1 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body a2 { mass: 0.4, com: [0.2, 0.0, 0.0], inertia: diag(0.001, 0.01, 0.01) }
        body b1 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body b2 { mass: 0.4, com: [0.0, 0.2, 0.0], inertia: diag(0.01, 0.001, 0.01) }
        body plate { mass: 1.0, com: [0.1, 0.1, 0.0], inertia: diag(0.02, 0.02, 0.03) }
        joint a: Revolute { parent: ground, child: a1, axis: Y }
        joint ab: Revolute { parent: a1.at(0.4 * X), child: a2, axis: Y }
        joint ac: Revolute { parent: a2.at(0.4 * X), child: plate, axis: Y }
        joint b: Revolute { parent: ground.at([0.6, -0.5, 0.0]), child: b1, axis: X }
        joint bb: Revolute { parent: b1.at(0.4 * Y), child: b2, axis: X }
        #[cut] joint bc: Revolute { parent: b2.at(0.4 * Y), child: plate.at([0.1, -0.003, 0.0]), axis: X }
        force motor: Effort { joint: a, value: push }
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
}

multibody! {
    /// Stephenson's six-bar, by Newton's method.
    pub mod stephenson_newton {
        world { gravity: -9.80665 * Y }
        input torque;
        body crank { mass: 0.3, com: 0.1 * X, inertia: rod(0.3, 0.2, X) }
        body coupler { mass: 0.6, com: [0.3, 0.1, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        body rocker { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        body link { mass: 0.4, com: 0.2 * X, inertia: rod(0.4, 0.4, X) }
        body last { mass: 0.4, com: 0.3 * X, inertia: diag(0.01, 0.01, 0.02) }
        joint shaft: Revolute { parent: ground, child: link, axis: Z }
        joint floating: Revolute { parent: link.at(0.45 * X), child: coupler, axis: Z }
        joint pin: Revolute { parent: ground.at([0.8, 0.1, 0.0]), child: rocker, axis: Z }
        #[cut] joint one: Revolute { parent: coupler.at(0.7 * X), child: rocker.at(0.5 * X), axis: Z }
        joint turning: Revolute { parent: ground.at([0.3, -0.5, 0.0]), child: crank, axis: Z }
        joint lever: Revolute { parent: crank.at(0.2 * X), child: last, axis: Z }
        #[cut] joint two: Revolute { parent: coupler.at([0.35, 0.25, 0.0]), child: last.at(0.9 * X), axis: Z }
        force motor: Effort { joint: turning, value: torque }
        formulation { constraints: Reduced, independent: [turning] }
        emit forward_dynamics;
    }
    /// Stephenson's six-bar, by three rounds of Newton's method.
    pub mod stephenson_near {
        world { gravity: -9.80665 * Y }
        input torque;
        body crank { mass: 0.3, com: 0.1 * X, inertia: rod(0.3, 0.2, X) }
        body coupler { mass: 0.6, com: [0.3, 0.1, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        body rocker { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        body link { mass: 0.4, com: 0.2 * X, inertia: rod(0.4, 0.4, X) }
        body last { mass: 0.4, com: 0.3 * X, inertia: diag(0.01, 0.01, 0.02) }
        joint shaft: Revolute { parent: ground, child: link, axis: Z }
        joint floating: Revolute { parent: link.at(0.45 * X), child: coupler, axis: Z }
        joint pin: Revolute { parent: ground.at([0.8, 0.1, 0.0]), child: rocker, axis: Z }
        #[cut] joint one: Revolute { parent: coupler.at(0.7 * X), child: rocker.at(0.5 * X), axis: Z }
        joint turning: Revolute { parent: ground.at([0.3, -0.5, 0.0]), child: crank, axis: Z }
        joint lever: Revolute { parent: crank.at(0.2 * X), child: last, axis: Z }
        #[cut] joint two: Revolute { parent: coupler.at([0.35, 0.25, 0.0]), child: last.at(0.9 * X), axis: Z }
        force motor: Effort { joint: turning, value: torque }
        formulation { constraints: Reduced, rounds: 3, independent: [turning] }
        emit forward_dynamics;
    }
    /// Stephenson's six-bar, with multipliers.
    pub mod stephenson_multipliers {
        world { gravity: -9.80665 * Y }
        input torque;
        body crank { mass: 0.3, com: 0.1 * X, inertia: rod(0.3, 0.2, X) }
        body coupler { mass: 0.6, com: [0.3, 0.1, 0.0], inertia: diag(0.01, 0.01, 0.02) }
        body rocker { mass: 0.5, com: 0.25 * X, inertia: rod(0.5, 0.5, X) }
        body link { mass: 0.4, com: 0.2 * X, inertia: rod(0.4, 0.4, X) }
        body last { mass: 0.4, com: 0.3 * X, inertia: diag(0.01, 0.01, 0.02) }
        joint shaft: Revolute { parent: ground, child: link, axis: Z }
        joint floating: Revolute { parent: link.at(0.45 * X), child: coupler, axis: Z }
        joint pin: Revolute { parent: ground.at([0.8, 0.1, 0.0]), child: rocker, axis: Z }
        #[cut] joint one: Revolute { parent: coupler.at(0.7 * X), child: rocker.at(0.5 * X), axis: Z }
        joint turning: Revolute { parent: ground.at([0.3, -0.5, 0.0]), child: crank, axis: Z }
        joint lever: Revolute { parent: crank.at(0.2 * X), child: last, axis: Z }
        #[cut] joint two: Revolute { parent: coupler.at([0.35, 0.25, 0.0]), child: last.at(0.9 * X), axis: Z }
        force motor: Effort { joint: turning, value: torque }
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
}

multibody! {
    /// A four-bar with a wheel that turns as fast as crank and coupler together: one angle that follows in a sum with another. The wheel's
    /// axis lies along nothing.
    pub mod geared_knee {
        world { gravity: -9.81 * Y }
        input torque;
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        body wheel { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint turn: Revolute { parent: ground.rotated(X, 0.4).rotated(Y, 0.7), child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint swing: Revolute { parent: ground.rotated(X, 0.4).rotated(Y, 0.7).at(4.0 * X), child: rocker, axis: Z }
        joint spin: Revolute { parent: ground, child: wheel, axis: [0.36, -0.48, 0.8] }
        #[cut] joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
        constraint gear = spin - knee - turn;
        force motor: Effort { joint: turn, value: torque }
        force spring: Effort { joint: knee, value: -7.0 * knee }
        solve (knee, swing) from pin { sin(turn + knee - swing) < 0.0 }
        formulation { constraints: Reduced, independent: [turn] }
        emit forward_dynamics, inverse_dynamics, derivatives, linearize;
    }
}

multibody! {
    mod arm {
        port hip: Frame; port tip: Frame;
        input torque;
        body upper { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        joint shoulder: Revolute { parent: hip, child: upper, axis: Y }
        constraint rod: Rod { between: [upper.at(0.3 * X), tip], length: 0.8 }
        force motor: Effort { joint: shoulder, value: torque }
    }
    /// Delta robot on rods, its plate on slides, by Newton's method.
    pub mod delta_rods_newton {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002) }
        body along { mass: 0.0 }
        body across { mass: 0.0 }
        joint x: Prismatic { parent: ground, child: along, axis: X }
        joint y: Prismatic { parent: along, child: across, axis: Y }
        joint z: Prismatic { parent: across, child: plate, axis: Z }
        part arms: [arm; 3] = |i| arm {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X),
        };
        formulation { constraints: Reduced, independent: [arms.shoulder] }
        emit forward_dynamics;
    }
    /// Delta robot on rods, its plate on slides, with multipliers.
    pub mod delta_rods_multipliers {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002) }
        body along { mass: 0.0 }
        body across { mass: 0.0 }
        joint x: Prismatic { parent: ground, child: along, axis: X }
        joint y: Prismatic { parent: along, child: across, axis: Y }
        joint z: Prismatic { parent: across, child: plate, axis: Z }
        part arms: [arm; 3] = |i| arm {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    /// Delta robot on rods, its plate on slides, its forward kinematics in closed form: three spheres.
    pub mod delta_rods_closed {
        world { gravity: -9.80665 * Z }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002) }
        body along { mass: 0.0 }
        body across { mass: 0.0 }
        joint x: Prismatic { parent: ground, child: along, axis: X }
        joint y: Prismatic { parent: along, child: across, axis: Y }
        joint z: Prismatic { parent: across, child: plate, axis: Z }
        part arms: [arm; 3] = |i| arm {
            hip: ground.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            tip: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X),
        };
        formulation { constraints: Reduced }
        assume (cos(arms[0].shoulder) > 0.5 && cos(arms[1].shoulder) > 0.5 && cos(arms[2].shoulder) > 0.5);
        solve (x, y, z) from (arms[0].rod, arms[1].rod, arms[2].rod) { z < 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: arms.shoulder, find: [x, y, z] };
    }
}
