//! An engine, as `slider_crank.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    /// The crank turns about z, the piston slides along x.
    pub(crate) mod engine {
        /// [m]
        const CRANK = 0.04;
        const ROD = 0.14;
        /// [N] on the piston, towards the crank
        input gas;
        /// [N m s/rad] of the dynamometer on the shaft
        param load = 0.05;

        body crank { mass: 2.0, inertia: diag(0.005, 0.005, 0.01) }
        body rod { mass: 0.3, com: 0.05 * X, inertia: rod(0.3, ROD, X) }
        body piston { mass: 0.4 }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint big_end: Revolute { parent: crank.at(CRANK * X), child: rod, axis: Z }
        joint cylinder: Prismatic { parent: ground, child: piston, axis: X }
        #[cut]
        joint small_end: Revolute { parent: rod.at(ROD * X), child: piston, axis: Z }
        formulation { constraints: Reduced }
        solve (big_end, cylinder) from small_end { cylinder > 0.0 }
        force pressure: Effort { joint: cylinder, value: -gas }
        force dynamometer: Damper { joint: shaft, damping: load }

        /// [N] on the crank
        output bearing: Vec3 = shaft.reaction.force;
        output energy = kinetic();
        emit forward_dynamics, inverse_dynamics, equations, kinematics { given: shaft, find: cylinder };
    }
}
