use multibody::multibody;

multibody! {
    /// A planar four-bar linkage that a motor turns, with a damper on its coupler.
    ///
    /// Lengths are those of a crank-rocker: the crank turns without end, the rocker swings.
    pub mod four_bar {
        /// [m] of the crank
        param crank_length = 1.0;
        /// [N m s/rad] of the bearing between crank and coupler
        param friction = 0.1;
        /// [kg] that nothing carries
        param ballast = 2.0;
        const COUPLER = 3.5;
        const ROCKER = 3.0;
        const BASE = 4.0;
        /// [N m] of the motor on the crank
        input torque;

        world { gravity: -9.81 * Y }
        body crank { mass: 1.0, com: 0.5 * crank_length * X, inertia: rod(1.0, crank_length, X) }
        body coupler { mass: 3.5, com: 0.5 * COUPLER * X, inertia: rod(3.5, COUPLER, X) }
        body rocker { mass: 3.0, com: 0.5 * ROCKER * X, inertia: rod(3.0, ROCKER, X) }
        joint drive_shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(crank_length * X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(BASE * X), child: rocker, axis: Z }
        #[cut]
        joint pin: Revolute { parent: coupler.at(COUPLER * X), child: rocker.at(ROCKER * X), axis: Z }
        formulation { constraints: Reduced }
        solve (knee, pivot) from pin { sin(pivot - drive_shaft - knee) > 0.0 }
        force motor: Effort { joint: drive_shaft, value: torque }
        force bearing: Damper { joint: knee, damping: friction }

        /// [rad]
        output rocker_angle = pivot.angle;
        /// [J]
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics { solve_for: torque };
    }
}
