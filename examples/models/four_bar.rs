//! A planar four-bar linkage, free and driven, as `four_bar.rs` and the check of the firmware for panics use it.

use multibody::multibody;

/// Declares the linkage; what a call adds makes it free or driven.
macro_rules! linkage {
    ($(#[$docs:meta])* $name:ident { $($items:tt)* }) => {
        multibody! {
            $(#[$docs])*
            pub(crate) mod $name {
                /// [m]
                const CRANK = 1.0;
                const COUPLER = 3.5;
                const ROCKER = 3.0;
                const BASE = 4.0;
                /// [N m] of the motor on the crank
                input torque;

                world { gravity: -9.81 * Y }
                body crank { mass: 1.0, com: 0.5 * CRANK * X, inertia: rod(1.0, CRANK, X) }
                body coupler { mass: 3.5, com: 0.5 * COUPLER * X, inertia: rod(3.5, COUPLER, X) }
                body rocker { mass: 3.0, com: 0.5 * ROCKER * X, inertia: rod(3.0, ROCKER, X) }
                joint drive_shaft: Revolute { parent: ground, child: crank, axis: Z }
                joint knee: Revolute { parent: crank.at(CRANK * X), child: coupler, axis: Z }
                joint pivot: Revolute { parent: ground.at(BASE * X), child: rocker, axis: Z }
                #[cut]
                joint pin: Revolute { parent: coupler.at(COUPLER * X), child: rocker.at(ROCKER * X), axis: Z }
                formulation { constraints: Reduced }
                solve (knee, pivot) from pin { sin(pivot - drive_shaft - knee) > 0.0 }
                force motor: Effort { joint: drive_shaft, value: torque }
                $($items)*
            }
        }
    };
}

linkage! {
    /// The crank turns freely, under the motor's torque and gravity.
    free {
        /// [rad]
        output rocker_angle = pivot.angle;
        /// [J]
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics { solve_for: torque }, equations;
    }
}

linkage! {
    /// The crank follows its drive: a turn a second.
    driven {
        drive drive_shaft.angle = 2.0 * PI * t;
        emit inverse_dynamics { solve_for: torque };
    }
}
