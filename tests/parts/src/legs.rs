//! A leg, with parts that only it knows by name, and one that every model may use.

use multibody::multibody;

multibody! {
    /// A leg of two links that hang obliquely, with a foot.
    pub mod leg {
        /// Where the hip is mounted.
        port hip: Frame;
        /// [m] of the shank
        param length = 0.4;
        /// [N m]
        input torque;

        let lower = shank.at(-length * Z).rotated([1.0, 2.0, 2.0] / 3.0, 0.4);

        body shank { mass: 1.5, com: -0.5 * length * Z + 0.02 * Y, inertia: rod(1.5, length, Z) }
        joint knee: Revolute { parent: hip.rotated(X, 0.3), child: shank, axis: [2.0, 3.0, 6.0] / 7.0 }
        force motor: Effort { joint: knee, value: torque }
        part end: foot { ankle: lower };
        part wheel: flywheel { axle: shank.at(0.1 * X) };

        /// [m] above the ground
        output height = end.pad.at(-0.05 * Z).position.z;
    }

    /// A foot on a spring.
    pub mod foot {
        /// The shank's lower end.
        port ankle: Frame;
        const STIFFNESS = 40.0;

        body pad { mass: 0.25, com: 0.03 * X, inertia: sphere(0.25, 0.05) }
        joint hinge: Revolute { parent: ankle, child: pad, axis: X }
        force spring: Spring { joint: hinge, stiffness: STIFFNESS }
    }

    mod flywheel {
        port axle: Frame;

        body disc { mass: 0.2, inertia: cylinder(0.2, 0.06, 0.01, Y) }
        joint spin: Revolute { parent: axle, child: disc, axis: Y }
    }

    mod reference {
        param mass = 2.0;
        body b { mass: mass }
        joint j: Prismatic { parent: ground, child: b, axis: X }
        output total = 2.0 * mass;
    }

    /// A part that no other call can use: it asks a model of this one.
    pub mod copied {
        /// Where it stands.
        port base: Frame;

        body block { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint turn: Revolute { parent: base, child: block, axis: Z }
        output total = reference(total);
    }
}
