//! A part with a part of its own, and a model with the same in one call.

multibody! {
    pub mod leg {
        port hip: Frame;
        body shank { mass: 1.5, com: -0.2 * Z + 0.02 * Y, inertia: rod(1.5, 0.4, Z) }
        joint knee: Revolute { parent: hip.rotated(X, 0.3), child: shank, axis: [2.0, 3.0, 6.0] / 7.0 }
        part end: foot { ankle: shank.at(-0.4 * Z) };
    }
    mod foot {
        port ankle: Frame;
        body pad { mass: 0.25, inertia: sphere(0.25, 0.05) }
        joint hinge: Revolute { parent: ankle, child: pad, axis: X }
    }
    pub mod walking {
        world { gravity: -9.81 * Z }
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint float: Free { parent: ground, child: hull }
        part legs: [leg; 2] = |i| leg { hip: hull.at((i - 0.5) * Y) };
    }
}
