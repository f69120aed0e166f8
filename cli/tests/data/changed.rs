use multibody::multibody;

multibody! {
    /// A rod that hangs from a hinge.
    pub mod pendulum {
        /// [m]
        param length = 1.0;
        world { gravity: -9.81 * Y }
        body rod { mass: 2.0, com: -0.5 * length * Y, inertia: diag(0.1, 0.2, 0.3) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        emit forward_dynamics, energy;
    }
}

