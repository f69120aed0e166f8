//! A model of the same crate with parts of another file, and a part with parts of another call.

use multibody::multibody;

multibody! {
    use crate::legs::{leg, foot as hoof};

    /// A weight on a rail with a leg and a foot of its own.
    pub mod hopper {
        world { gravity: -9.81 * Z }
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint rail: Prismatic { parent: ground, child: hull, axis: Z }
        part left: leg { hip: hull.at(0.1 * Y), length: 0.3 };
        part tail: hoof { ankle: hull.at(0.2 * X) };
    }

    /// Two legs on one axle.
    pub mod pair {
        /// The axle's frame.
        port axle: Frame;

        part legs: [leg; 2] = |i| leg { hip: axle.at((i - 0.5) * Y) };
        part tail: hoof { ankle: axle.at(-0.3 * X) };
    }
}
