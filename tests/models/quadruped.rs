//! A robot on four legs, for the ledger alone: what is asked for at a position, and what its legs do in packs.

use multibody::multibody;

multibody! {
    mod leg {
        port hip: Frame;
        param side = 1.0;
        /// [N m]
        input torque: [Scalar; 3];
        body shoulder { mass: 0.54, com: [-0.0051, 0.0023 * side, 0.0001], inertia: diag(0.00038, 0.00056, 0.00044) }
        body thigh {
            mass: 0.634, com: [-0.0035, -0.019 * side, -0.0273],
            inertia: inertia(0.0044, 0.0047, 0.0008, 0.00001 * side, -0.0002, 0.00007 * side),
        }
        body shin { mass: 0.166, com: [0.0065, 0.0, -0.1074], inertia: diag(0.003, 0.003, 0.00004) }
        joint roll: Revolute { parent: hip, child: shoulder, axis: X }
        joint pitch: Revolute { parent: shoulder.at(0.08 * side * Y), child: thigh, axis: Y }
        joint knee: Revolute { parent: thigh.at(-0.2 * Z), child: shin, axis: Y }
        force roll_motor: Effort { joint: roll, value: torque[0] }
        force pitch_motor: Effort { joint: pitch, value: torque[1] }
        force knee_motor: Effort { joint: knee, value: torque[2] }
        output foot = shin.at(-0.2 * Z).position;
    }
    pub mod quadruped {
        const LENGTHWISE: [Scalar; 4] = [0.183, 0.183, -0.183, -0.183];
        const SIDES: [Scalar; 4] = [1.0, -1.0, 1.0, -1.0];
        world { gravity: -9.81 * Z }
        body trunk {
            mass: 4.713, com: [0.011, 0.002, 0.0005], inertia: inertia(0.0168, 0.063, 0.0717, 0.0001, 0.0002, 0.00003),
        }
        joint float: Free { parent: ground, child: trunk }
        part legs: [leg; 4] = |i| leg { hip: trunk.at([LENGTHWISE[i], 0.047 * SIDES[i], 0.0]), side: SIDES[i] };
        emit forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias;
        emit at { functions: [forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias, outputs] };
    }
}
