//! A thin disc that rolls.

use multibody::multibody;

multibody! {
    /// A thin disc on a plane.
    pub mod disc {
        /// [m]
        param radius = 0.25;
        /// [kg]
        param mass = 0.7;
        world { gravity: -9.81 * Z }
        body disc { mass: mass, inertia: cylinder(mass, radius, 0.0, Y) }
        joint float: Free { parent: ground, child: disc }
        constraint wheel: Rolling { wheel: disc, axis: Y, radius: radius }
        output axle = disc.rotation * Y;
        output contact = wheel.contact;
        output force = wheel.force;
        output energy = kinetic() + potential();
        emit forward_dynamics;
    }
}
