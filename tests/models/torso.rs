//! A floating trunk with a spine of three hinges and two arms, for the ledger alone: what a pair of arms does in packs.

use multibody::multibody;

multibody! {
    mod arm {
        port shoulder: Frame;
        param side = 1.0;
        /// [N m]
        input torque: [Scalar; 4];
        body clavicle { mass: 1.4, com: [-0.01, 0.09 * side, 0.02], inertia: inertia(0.012, 0.005, 0.01, 0.0008 * side, 0.0006, 0.0002 * side) }
        body humerus { mass: 1.7, com: [0.02, 0.01 * side, -0.11], inertia: diag(0.023, 0.022, 0.003) }
        body ulna { mass: 1.1, com: [0.01, -0.01 * side, -0.09], inertia: inertia(0.008, 0.009, 0.002, 0.0001 * side, 0.001, -0.0003 * side) }
        body hand { mass: 0.6, com: [0.01, 0.0, -0.06], inertia: diag(0.002, 0.0021, 0.0008) }
        joint pitch: Revolute { parent: shoulder, child: clavicle, axis: Y }
        joint roll: Revolute { parent: clavicle.at([0.0, 0.16 * side, 0.0]), child: humerus, axis: X }
        joint elbow: Revolute { parent: humerus.at([0.02, 0.0, -0.27]), child: ulna, axis: Y }
        joint wrist: Revolute { parent: ulna.at([-0.02, 0.0, -0.26]), child: hand, axis: Z }
        force pitch_motor: Effort { joint: pitch, value: torque[0] }
        force roll_motor: Effort { joint: roll, value: torque[1] }
        force elbow_motor: Effort { joint: elbow, value: torque[2] }
        force wrist_motor: Effort { joint: wrist, value: torque[3] }
    }
    pub mod torso {
        const SIDES: [Scalar; 2] = [1.0, -1.0];
        world { gravity: -9.81 * Z }
        /// [N m]
        input waist: [Scalar; 3];
        body pelvis { mass: 14.2, com: [-0.05, 0.0, 0.02], inertia: diag(0.05, 0.07, 0.06) }
        body lumbar { mass: 2.1, com: [0.01, 0.0, 0.03], inertia: diag(0.006, 0.005, 0.004) }
        body thorax { mass: 2.3, com: [-0.01, 0.0, 0.05], inertia: diag(0.007, 0.006, 0.005) }
        body chest { mass: 16.1, com: [-0.04, 0.0, 0.17], inertia: inertia(0.3, 0.24, 0.18, 0.0, 0.02, 0.0) }
        joint float: Free { parent: ground, child: pelvis }
        joint yaw: Revolute { parent: pelvis.at([-0.03, 0.0, 0.1]), child: lumbar, axis: Z }
        joint roll: Revolute { parent: lumbar.at(0.08 * Z), child: thorax, axis: X }
        joint pitch: Revolute { parent: thorax.at(0.07 * Z), child: chest, axis: Y }
        force yaw_motor: Effort { joint: yaw, value: waist[0] }
        force roll_motor: Effort { joint: roll, value: waist[1] }
        force pitch_motor: Effort { joint: pitch, value: waist[2] }
        part arms: [arm; 2] = |i| arm { shoulder: chest.at([0.0, 0.16 * SIDES[i], 0.24]), side: SIDES[i] };
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
}
