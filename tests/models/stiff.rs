//! A mechanism with time constants far apart: a centrifugal governor whose sleeve hangs on stiff links.

use multibody::multibody;

multibody! {
    /// Two balls on arms that a turning spindle carries along; links of stiff springs and dampers lift a sleeve as they
    /// fly out. Their fastest eigenvalues are about -1e5 per second, the governor swings with about 10.
    ///
    /// The spindle turns about +z, gravity pulls along -z; arms hang down at zero and lift outwards.
    pub mod governor {
        /// [m/s^2] gravity
        const G = 9.81;
        /// [m] hinges from the axis
        const OFFSET = 0.05;
        /// [m] arms
        const LENGTH = 0.3;
        /// [m] on an arm, from its hinge to the link
        const KNEE = 0.2;
        /// [kg] each ball
        const BALL = 0.5;
        /// [kg]
        const SLEEVE = 1.0;
        /// [m] natural length of a link
        const LINK = 0.2;
        /// [N/m]
        param stiffness = 1.0e7;
        /// [N s/m]
        param damping = 5.0e4;
        /// [N m s] gain of the drive
        param gain = 0.5;
        /// [rad/s] speed that the drive is set to
        input speed;

        world { gravity: -G * Z }
        body spindle { mass: 1.0, inertia: diag(0.05, 0.05, 0.05) }
        body right { mass: BALL, com: -LENGTH * Z }
        body left { mass: BALL, com: -LENGTH * Z }
        body sleeve { mass: SLEEVE }
        joint shaft: Revolute { parent: ground, child: spindle, axis: Z }
        joint right_arm: Revolute { parent: spindle.at(OFFSET * X), child: right, axis: -Y }
        joint left_arm: Revolute { parent: spindle.at(-OFFSET * X), child: left, axis: Y }
        joint slide: Prismatic { parent: spindle, child: sleeve, axis: Z }
        force drive: Effort { joint: shaft, value: gain * (speed - shaft.rate) }
        force right_link: SpringDamper {
            between: [right.at(-KNEE * Z), sleeve.at(OFFSET * X)], stiffness: stiffness, damping: damping, length: LINK
        }
        force left_link: SpringDamper {
            between: [left.at(-KNEE * Z), sleeve.at(-OFFSET * X)], stiffness: stiffness, damping: damping, length: LINK
        }
        emit forward_dynamics, derivatives, energy;
    }
}
