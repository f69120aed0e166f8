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
    /// A governor: a spindle with two arms that carry balls, and a sleeve that stiff, damped springs hang on the arms.
    pub mod governor {
        const K = 8e5;
        const C = 4e4;
        world { gravity: -9.81 * Z }
        body spindle { mass: 1.0, inertia: diag(0.25, 0.25, 0.5) }
        body rod1 { mass: 0.3, com: -0.5 * Z, inertia: rod(0.3, 1.0, Z) }
        body rod2 { mass: 0.3, com: -0.5 * Z, inertia: rod(0.3, 1.0, Z) }
        body ball1 { mass: 5.0 }
        body ball2 { mass: 5.0 }
        body sleeve { mass: 10.0 }
        joint shaft: Revolute { parent: ground, child: spindle, axis: Z }
        joint arm1: Revolute { parent: spindle, child: rod1, axis: -Y }
        joint arm2: Revolute { parent: spindle, child: rod2, axis: Y }
        joint weld1: Fixed { parent: rod1.at(-Z), child: ball1 }
        joint weld2: Fixed { parent: rod2.at(-Z), child: ball2 }
        joint slide: Prismatic { parent: spindle, child: sleeve, axis: Z }
        force link1: SpringDamper { between: [rod1.at(-0.5 * Z), sleeve], stiffness: K, damping: C, length: 0.5 }
        force link2: SpringDamper { between: [rod2.at(-0.5 * Z), sleeve], stiffness: K, damping: C, length: 0.5 }
        emit forward_dynamics, derivatives;
    }
}
