//! The mechanisms of a first lecture.

use multibody::multibody;

multibody! {
    /// A rod on a hinge.
    pub mod pendulum {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass
        param m = 2.0;
        /// [m] length
        param l = 1.5;
        world { gravity: -g * Y }
        body bob { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A mass on a vertical rail, with a spring.
    pub mod oscillator {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass
        param m = 2.0;
        /// [N/m] spring
        param k = 50.0;
        world { gravity: -g * Z }
        body mass { mass: m }
        joint rail: Prismatic { parent: ground, child: mass, axis: Z }
        force spring: Spring { joint: rail, stiffness: k }
        emit forward_dynamics, inverse_dynamics, energy;
    }
}

multibody! {
    /// A rod hinged to a cart that a force pushes.
    pub mod cart_pole {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] cart
        param mc = 1.0;
        /// [kg] pole
        param mp = 0.2;
        /// [m] pole
        param l = 0.8;
        /// [N] along +x
        input push;
        world { gravity: -g * Y }
        body cart { mass: mc }
        body pole { mass: mp, com: 0.5 * l * Y, inertia: rod(mp, l, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }
        /// [m] tip of the pole
        output tip = pole.at(l * Y).position;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Two uniform rods, as in a textbook.
    pub mod two_rods {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] upper rod
        param m1 = 1.0;
        /// [kg] lower rod
        param m2 = 1.0;
        /// [m] upper rod
        param l1 = 1.0;
        /// [m] lower rod
        param l2 = 1.0;
        world { gravity: -g * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
}
