use multibody::multibody;

multibody! {
    /// A rod that hangs from a hinge.
    pub mod pendulum {
        /// [m]
        param length = 1.0;
        world { gravity: -9.81 * Y }
        body rod { mass: 2.0, com: -0.5 * length * Y, inertia: rod(2.0, length, Y) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        emit forward_dynamics, mass_matrix;
    }
}

mod inner {
    multibody::multibody! {
        /// A crank, a rod and a slider.
        pub mod slider {
            param length = 1.0;
            body crank { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.2, X) }
            body rod { mass: 1.0, com: 0.5 * length * X, inertia: rod(1.0, length, X) }
            body piston { mass: 1.0 }
            joint shaft: Revolute { parent: ground, child: crank, axis: Z }
            joint pin: Revolute { parent: crank.at(0.2 * X), child: rod, axis: Z }
            joint guide: Prismatic { parent: ground, child: piston, axis: X }
            #[cut]
            joint wrist: Revolute { parent: rod.at(length * X), child: piston, axis: Z }
            formulation { constraints: Reduced }
            solve (pin, guide) from wrist { guide > 0.0 }
            emit forward_dynamics;
        }
    }
}
