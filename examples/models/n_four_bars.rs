//! Two four-bars in a row, as `n_four_bars.rs` and the check of the firmware for panics use them.

use multibody::multibody;

/// Declares the linkage; what a call adds is its formulation.
macro_rules! linkage {
    ($(#[$docs:meta])* $name:ident { $($items:tt)* }) => {
        multibody! {
            $(#[$docs])*
            pub(crate) mod $name {
                world { gravity: -9.81 * Y }
                body b0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body b1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body b2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body top1 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body top2 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                joint crank: Revolute { parent: ground, child: b0, axis: Z }
                joint middle: Revolute { parent: ground.at(X), child: b1, axis: Z }
                joint last: Revolute { parent: ground.at(2.0 * X), child: b2, axis: Z }
                joint coupler1: Revolute { parent: b0.at(X), child: top1, axis: Z }
                joint coupler2: Revolute { parent: b1.at(X), child: top2, axis: Z }
                #[cut]
                joint pin1: Revolute { parent: top1.at(X), child: b1.at(X), axis: Z }
                #[cut]
                joint pin2: Revolute { parent: top2.at(X), child: b2.at(X), axis: Z }
                /// [m]
                output tip = b0.at(X).position;
                /// [J]
                output energy = kinetic() + potential();
                $($items)*
            }
        }
    };
}

linkage! {
    /// Parallelograms, by the user's word.
    parallel {
        formulation { constraints: Reduced }
        solve (coupler1, middle) = (-crank, crank);
        solve (coupler2, last) = (-crank, crank);
    }
}

linkage! {
    /// Five coordinates, four equations.
    redundant {
        formulation { constraints: Multipliers }
    }
}
