//! The mechanisms.

use multibody::multibody;

multibody! {
    /// Two point masses on rods of one metre.
    pub mod double_pendulum {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.0, com: -Y }
        body lower { mass: 1.0, com: -Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// A governor: balls on two arms that a driven spindle carries along, and a sleeve that hangs on stiff, damped links.
    pub mod governor {
        const K = 1e7;
        const C = 5e4;
        world { gravity: -9.81 * Z }
        body spindle { mass: 1.0, inertia: diag(0.05, 0.05, 0.05) }
        body right { mass: 0.5, com: -0.3 * Z }
        body left { mass: 0.5, com: -0.3 * Z }
        body sleeve { mass: 1.0 }
        joint shaft: Revolute { parent: ground, child: spindle, axis: Z }
        joint right_arm: Revolute { parent: spindle.at(0.05 * X), child: right, axis: -Y }
        joint left_arm: Revolute { parent: spindle.at(-0.05 * X), child: left, axis: Y }
        joint slide: Prismatic { parent: spindle, child: sleeve, axis: Z }
        force drive: Effort { joint: shaft, value: 0.5 * (9.0 - shaft.rate) }
        force right_link: SpringDamper {
            between: [right.at(-0.2 * Z), sleeve.at(0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        force left_link: SpringDamper {
            between: [left.at(-0.2 * Z), sleeve.at(-0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        emit forward_dynamics, derivatives;
    }
}
