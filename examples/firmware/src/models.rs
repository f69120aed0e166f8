//! The models of the examples, and some that emit only what the scenes call: leaner than the examples of their names (the
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

    /// Four rotors on a hull whose centre of mass is not where they meet.
    pub(crate) mod quadrotor {
        const ARM = 0.17;
        /// [m] drag moment of a rotor over its thrust
        const DRAG = 0.016;
        /// [kg]
        param mass = 1.0;
        /// [m]
        param com: Vec3 = [0.003, -0.002, 0.011];
        /// [N] of each rotor
        input thrust: [Scalar; 4];
        world { gravity: -9.81 * Z }
        body hull { mass: mass, com: com, inertia: inertia(0.0082, 0.0085, 0.0149, 1e-4, -5e-5, 8e-5) }
        joint float: Free { parent: ground, child: hull, coordinates: Quaternion }
        force lift: Force { at: hull, value: (thrust[0] + thrust[1] + thrust[2] + thrust[3]) * Z, axes: hull }
        force turn: Torque {
            at: hull,
            value: [
                ARM * (thrust[1] - thrust[3]),
                ARM * (thrust[2] - thrust[0]),
                DRAG * (thrust[0] - thrust[1] + thrust[2] - thrust[3]),
            ],
            axes: hull,
        }
        force air: Force { at: hull, value: -0.1 * hull.velocity, axes: ground }
        emit forward_dynamics;
    }

    /// A thin disc that rolls: five coordinates and three speeds, the components of its turn in axes that lean with it. The
    /// rates of the coordinates follow without pivots.
    pub(crate) mod rolling_disc {
        /// [m]
        const RADIUS = 0.25;
        /// [kg]
        param mass = 0.7;
        world { gravity: -9.81 * Z }
        body ahead { mass: 0 }
        body aside { mass: 0 }
        body above { mass: 0 }
        body headed { mass: 0 }
        body leaning { mass: 0 }
        body disc { mass: mass, inertia: cylinder(mass, RADIUS, 0.0, Y) }
        joint x: Prismatic { parent: ground, child: ahead, axis: X }
        joint y: Prismatic { parent: ahead, child: aside, axis: Y }
        joint z: Prismatic { parent: aside, child: above, axis: Z }
        joint yaw: Revolute { parent: above, child: headed, axis: Z }
        joint lean: Revolute { parent: headed, child: leaning, axis: X }
        joint spin: Revolute { parent: leaning, child: disc, axis: Y }
        constraint wheel: Rolling { wheel: disc, axis: Y, radius: RADIUS }
        let turn = leaning.express(disc.angular_velocity);
        /// [rad/s] over onto its side
        speed tip = turn.x;
        /// [rad/s] about its axle
        speed roll = turn.y;
        /// [rad/s] about the line to its contact
        speed swerve = turn.z;
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }

    /// A spatial four-bar without a formula: the coupler turns about its length as the ball at its end lets it.
    pub(crate) mod spatial_four_bar {
        world { gravity: -9.81 * Z }
        body crank { mass: 0.5, com: 0.1 * X, inertia: rod(0.5, 0.2, X) }
        body coupler { mass: 1.0, com: 0.4 * X, inertia: diag(0.001, 0.05, 0.05) }
        body rocker { mass: 0.8, com: 0.3 * X, inertia: rod(0.8, 0.6, X) }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint wrist: Universal { parent: crank.at(0.2 * X), child: coupler, axes: [Z, Y] }
        joint pivot: Revolute { parent: ground.at([0.7, 0.1, 0.0]).rotated(X, 0.5), child: rocker, axis: Z }
        #[cut]
        joint ball: Ball { parent: coupler.at(0.8 * X), child: rocker.at(0.6 * X) }
        formulation { constraints: Reduced }
        emit forward_dynamics;
    }
}
