//! Mechanisms for which the choice of velocities matters (Kane and Levinson 1985; Mitiguy and Kane 1996), for the ledger alone.

use multibody::multibody;

multibody! {
    /// A rigid body about its centre of mass, turned by yaw, pitch and roll.
    pub mod rigid_body {
        param inertia_x = 0.3;
        param inertia_y = 0.4;
        param inertia_z = 0.5;
        body spun { mass: 2.0, inertia: diag(inertia_x, inertia_y, inertia_z) }
        body yawed { mass: 0 }
        body pitched { mass: 0 }
        joint yaw: Revolute { parent: ground, child: yawed, axis: Z }
        joint pitch: Revolute { parent: yawed, child: pitched, axis: Y }
        joint roll: Revolute { parent: pitched, child: spun, axis: X }
        formulation { speeds: Auto }
    }
    /// The same in space, its centre of mass off its origin.
    pub mod floating_body {
        world { gravity: -9.81 * Z }
        body hull { mass: 5.0, com: [0.1, 0.05, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.03, -0.02, 0.01) }
        joint free: Free { parent: ground, child: hull, coordinates: RollPitchYaw }
        formulation { speeds: Auto }
    }
    /// A heavy top on its tip.
    pub mod top {
        param mass = 0.5;
        param height = 0.04;
        param across = 8e-4;
        param along = 4e-4;
        world { gravity: -9.81 * Z }
        body precessed { mass: 0 }
        body tilted { mass: 0 }
        body top { mass: mass, com: height * Z, inertia: diag(across, across, along) }
        joint precession: Revolute { parent: ground, child: precessed, axis: Z }
        joint nutation: Revolute { parent: precessed, child: tilted, axis: X }
        joint spin: Revolute { parent: tilted, child: top, axis: Z }
        formulation { speeds: Auto }
    }
    /// Two limbs on spherical joints.
    pub mod two_limbs {
        world { gravity: -9.81 * Z }
        body upper { mass: 2.0, com: [0.02, 0.01, 0.3], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, 0.03) }
        body fore { mass: 1.0, com: [0.02, 0.01, 0.2], inertia: inertia(0.2, 0.25, 0.3, 0.01, 0.02, 0.03) }
        joint shoulder: Ball { parent: ground, child: upper, coordinates: RollPitchYaw }
        joint elbow: Ball { parent: upper.at(0.6 * Z), child: fore, coordinates: RollPitchYaw }
        formulation { speeds: Auto }
    }
    /// Three of them.
    pub mod three_limbs {
        world { gravity: -9.81 * Z }
        body upper { mass: 2.0, com: [0.02, 0.01, 0.3], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, 0.03) }
        body fore { mass: 1.0, com: [0.02, 0.01, 0.2], inertia: inertia(0.2, 0.25, 0.3, 0.01, 0.02, 0.03) }
        body hand { mass: 0.5, com: [0.02, 0.01, 0.1], inertia: inertia(0.02, 0.025, 0.03, 0.001, 0.002, 0.003) }
        joint shoulder: Ball { parent: ground, child: upper, coordinates: RollPitchYaw }
        joint elbow: Ball { parent: upper.at(0.6 * Z), child: fore, coordinates: RollPitchYaw }
        joint wrist: Ball { parent: fore.at(0.5 * Z), child: hand, coordinates: RollPitchYaw }
        formulation { speeds: Auto }
    }
    /// A robot on two wheels that roll.
    pub mod two_wheels {
        const RADIUS = 0.05;
        const TRACK = 0.2;
        world { gravity: -9.81 * Z }
        body axle { mass: 0 }
        body body { mass: 1.2, com: 0.09 * Z, inertia: diag(0.006, 0.005, 0.003) }
        body left { mass: 0.06, inertia: diag(4e-5, 8e-5, 4e-5) }
        body right { mass: 0.06, inertia: diag(4e-5, 8e-5, 4e-5) }
        joint place: Planar { parent: ground.at(RADIUS * Z), child: axle, axis: Z }
        joint pitch: Revolute { parent: axle, child: body, axis: Y }
        joint left_motor: Revolute { parent: body.at(0.5 * TRACK * Y), child: left, axis: Y }
        joint right_motor: Revolute { parent: body.at(-0.5 * TRACK * Y), child: right, axis: Y }
        constraint left_wheel: Rolling { wheel: left, axis: Y, radius: RADIUS }
        constraint right_wheel: Rolling { wheel: right, axis: Y, radius: RADIUS }
        formulation { constraints: Reduced, speeds: Auto }
    }
    /// A sleigh on one blade (Chaplygin).
    pub mod sleigh {
        body sleigh { mass: 2.0, com: [0.3, 0.0, 0.0], inertia: diag(0.3, 0.3, 0.5) }
        joint place: Planar { parent: ground, child: sleigh, axis: Z }
        constraint blade: Skate { blade: sleigh, along: X }
        formulation { constraints: Reduced, speeds: Auto }
    }
    /// A disc that rolls.
    pub mod disc {
        const RADIUS = 0.25;
        world { gravity: -9.81 * Z }
        body ahead { mass: 0 }
        body aside { mass: 0 }
        body above { mass: 0 }
        body yawed { mass: 0 }
        body leaned { mass: 0 }
        body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
        joint x: Prismatic { parent: ground, child: ahead, axis: X }
        joint y: Prismatic { parent: ahead, child: aside, axis: Y }
        joint z: Prismatic { parent: aside, child: above, axis: Z }
        joint yaw: Revolute { parent: above, child: yawed, axis: Z }
        joint lean: Revolute { parent: yawed, child: leaned, axis: X }
        joint spin: Revolute { parent: leaned, child: disc, axis: Y }
        constraint roll: Rolling { wheel: disc, axis: Y, radius: RADIUS }
        formulation { constraints: Reduced, independent: [x, y, yaw, lean, spin], speeds: Auto }
    }
}
