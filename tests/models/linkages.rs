//! Andrews' squeezer, seven bodies in three loops (Hairer and Wanner, volume II, section VII.7); reference data in
//! `data/motion/andrews.json`.

use multibody::multibody;

/// Declares the squeezer; what a call adds is its formulation.
macro_rules! squeezer {
    ($(#[$docs:meta])* $name:ident { $($items:tt)* }) => {
        multibody! {
            $(#[$docs])*
            pub mod $name {
                const A = [-0.06934, -0.00227, 0.0];
                const B = [-0.03635, 0.03273, 0.0];
                const C = [0.014, 0.072, 0.0];
                body one { mass: 0.04325, com: 92e-5 * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
                body two { mass: 0.00365, com: -0.0115 * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
                body three { mass: 0.02373, com: [0.01043, -0.01874, 0.0], inertia: diag(0.0, 5.255e-6, 5.255e-6) }
                body four { mass: 0.00706, com: -0.00579 * Y, inertia: diag(5.667e-7, 0.0, 5.667e-7) }
                body five { mass: 0.07050, com: [0.02308, 0.00916, 0.0], inertia: diag(0.0, 1.169e-5, 1.169e-5) }
                body six { mass: 0.00706, com: 0.00579 * X, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
                body seven { mass: 0.05498, com: [-0.00449, -0.01228, 0.0], inertia: diag(0.0, 1.912e-5, 1.912e-5) }
                joint beta: Revolute { parent: ground, child: one, axis: Z }
                joint theta: Revolute { parent: one.at(0.007 * X), child: two, axis: Z }
                joint gamma: Revolute { parent: ground.at(B), child: three, axis: Z }
                joint delta: Revolute { parent: ground.at(A), child: five, axis: Z }
                joint phi: Revolute { parent: five.at(0.04 * X), child: four, axis: Z }
                joint epsilon: Revolute { parent: ground.at(A), child: seven, axis: Z }
                joint omega: Revolute { parent: seven.at(-0.04 * Y), child: six, axis: Z }
                #[cut]
                joint first: Revolute { parent: two.at(-0.028 * X), child: three.at(-0.035 * Y), axis: Z }
                #[cut]
                joint second: Revolute { parent: two.at(-0.028 * X), child: four.at(-0.02 * Y), axis: Z }
                #[cut]
                joint third: Revolute { parent: two.at(-0.028 * X), child: six.at(0.02 * X), axis: Z }
                force motor: Effort { joint: beta, value: 0.033 }
                force spring: Spring {
                    between: [three.at([0.02, -0.018, 0.0]), ground.at(C)], stiffness: 4530.0, length: 0.07785,
                }
                /// [J] without the motor's work
                output energy = kinetic() + potential() - 0.033 * beta.angle;
                output angles = [beta.angle, theta.angle, gamma.angle, phi.angle, delta.angle, omega.angle, epsilon.angle];
                output rates = [beta.rate, theta.rate, gamma.rate, phi.rate, delta.rate, omega.rate, epsilon.rate];
                $($items)*
            }
        }
    };
}

squeezer! {
    /// With its equations.
    squeezer {
        formulation { constraints: Multipliers }
        emit forward_dynamics, impulse;
    }
}

squeezer! {
    /// Its loops solved.
    squeezer_reduced {
        formulation { constraints: Reduced }
        solve (theta, gamma) from first { cos(beta.angle + theta.angle - gamma.angle) > 0.0 }
        solve (phi, delta) from second { cos(phi.angle) > 0.0 }
        solve (omega, epsilon) from third { cos(omega.angle) > 0.0 }
        emit forward_dynamics, kinematics { given: beta, find: [theta, gamma, phi, delta, omega, epsilon] };
    }
}
