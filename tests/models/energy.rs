//! Mechanisms whose energy is watched for a long time.

use multibody::multibody;

multibody! {
    /// A point mass of one kilogram on a massless rod. The hinge turns about +z, gravity pulls along -y.
    pub mod swing {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [m] length of the rod
        param l = 1.0;
        world { gravity: -g * Y }
        body bob { mass: 1.0, com: -l * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics, energy;
    }
}

multibody! {
    /// Two point masses of one kilogram on massless rods of one metre, hinges about +z, gravity along -y.
    pub mod double_swing {
        /// [m/s^2] gravity
        param g = 9.81;
        world { gravity: -g * Y }
        body upper { mass: 1.0, com: -Y }
        body lower { mass: 1.0, com: -Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        emit forward_dynamics, energy, momentum;
    }
}
