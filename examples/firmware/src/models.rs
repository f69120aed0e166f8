//! The models of the examples, and two that emit only what the scenes call: leaner than the examples of their names (the
//! pendulum here does not integrate the heat of its friction), so that what is counted is the mechanics.

use multibody::multibody;

#[path = "../../models/panda.rs"]
pub(crate) mod arm;
#[path = "../../models/cart_pole.rs"]
pub(crate) mod cart;
#[path = "../../models/slider_crank.rs"]
pub(crate) mod crank;
#[path = "../../models/four_bar.rs"]
pub(crate) mod four_bar;
#[path = "../../models/impacts.rs"]
pub(crate) mod impacts;
#[path = "../../models/n_four_bars.rs"]
pub(crate) mod linkages;
#[path = "../../models/double_pendulum.rs"]
pub(crate) mod pendulum;
#[allow(dead_code)] // several formulations of one platform
#[path = "../../stewart/models.rs"]
mod platform;
#[path = "../../models/andrews.rs"]
pub(crate) mod squeezer;

pub(crate) use arm::panda;
pub(crate) use platform::{hybrid, iterated, level, reduced};

multibody! {
    /// Planar double pendulum.
    pub(crate) mod double_pendulum {
        /// [kg]
        param m1 = 1.0;
        param m2 = 1.0;
        /// [m] rod lengths
        param l1 = 1.0;
        param l2 = 1.0;
        world { gravity: -9.81 * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        force friction: Effort { joint: elbow, value: -0.01 * elbow.rate }
        emit forward_dynamics;
    }

    /// A pole hinged to a cart; upright at zero.
    pub(crate) mod cart_pole {
        /// [kg]
        param cart_mass = 1.0;
        param pole_mass = 0.2;
        /// [m]
        param length = 0.8;
        /// [N] pushes the cart along +x
        input push;
        world { gravity: -9.81 * Y }
        body cart { mass: cart_mass }
        body pole { mass: pole_mass, com: 0.5 * length * Y, inertia: rod(pole_mass, length, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }
        emit forward_dynamics;
    }
}
