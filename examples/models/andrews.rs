//! Andrews' squeezing mechanism, as `andrews.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    pub(crate) mod andrews {
        /// [m] the motor's pin is the origin
        const A = [-0.06934, -0.00227, 0.0];
        const B = [-0.03635, 0.03273, 0.0];
        const C = [0.014, 0.072, 0.0];

        body k1 { mass: 0.04325, com: 92e-5 * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
        body k2 { mass: 0.00365, com: -115e-4 * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
        body k3 { mass: 0.02373, com: [0.01043, -0.01874, 0.0], inertia: diag(0.0, 5.255e-6, 5.255e-6) }
        body k4 { mass: 0.00706, com: -0.00579 * Y, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body k5 { mass: 0.07050, com: [0.02308, 0.00916, 0.0], inertia: diag(0.0, 1.169e-5, 1.169e-5) }
        body k6 { mass: 0.00706, com: 0.00579 * X, inertia: diag(0.0, 5.667e-7, 5.667e-7) }
        body k7 { mass: 0.05498, com: [-0.00449, -0.01228, 0.0], inertia: diag(0.0, 1.912e-5, 1.912e-5) }

        joint beta: Revolute { parent: ground, child: k1, axis: Z }
        joint theta: Revolute { parent: k1.at(0.007 * X), child: k2, axis: Z }
        joint gamma: Revolute { parent: ground.at(B), child: k3, axis: Z }
        joint delta: Revolute { parent: ground.at(A), child: k5, axis: Z }
        joint phi: Revolute { parent: k5.at(0.04 * X), child: k4, axis: Z }
        joint epsilon: Revolute { parent: ground.at(A), child: k7, axis: Z }
        joint omega: Revolute { parent: k7.at(-0.04 * Y), child: k6, axis: Z }

        // One point carries four bodies.
        #[cut]
        joint p3: Revolute { parent: k2.at(-0.028 * X), child: k3.at(-0.035 * Y), axis: Z }
        #[cut]
        joint p4: Revolute { parent: k2.at(-0.028 * X), child: k4.at(-0.02 * Y), axis: Z }
        #[cut]
        joint p6: Revolute { parent: k2.at(-0.028 * X), child: k6.at(0.02 * X), axis: Z }

        force motor: Effort { joint: beta, value: 0.033 }
        force spring: Spring { between: [k3.at([0.02, -0.018, 0.0]), ground.at(C)], stiffness: 4530.0, length: 0.07785 }

        formulation { constraints: Multipliers }
        /// [J] without the motor's work
        output energy = kinetic() + potential() - 0.033 * beta.angle;
        emit forward_dynamics, energy;
    }
}
