//! A pole on a cart, as `cart_pole.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    /// A pole hinged to a cart. The cart slides along x, y points up, and the pole is upright at zero.
    pub(crate) mod cart_pole {
        /// [m/s^2]
        param g = 9.81;
        /// [kg]
        param cart_mass = 1.0;
        /// [kg]
        param pole_mass = 0.2;
        /// [m]
        param length = 0.8;
        /// [N] pushes the cart along +x
        input push;

        world { gravity: -g * Y }
        body cart { mass: cart_mass }
        body pole { mass: pole_mass, com: 0.5 * length * Y, inertia: rod(pole_mass, length, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }

        /// [J] zero when all is at rest with the pole upright
        output energy = kinetic() + potential() - 0.5 * length * pole_mass * g;
        emit forward_dynamics, mass_matrix, bias;
    }
}
