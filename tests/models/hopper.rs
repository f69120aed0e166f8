//! A floating trunk on one leg, whose knee and ankle are turned by cranks through rods, in planes that are askew to all axes: loops one
//! behind the other, far from the ground. With coordinates that follow, and with multipliers.

use multibody::multibody;

multibody! {
    mod leg {
        port hip: Frame;
        /// [N m] at the hip's two hinges, the knee's crank and the ankle's
        input torque: [Scalar; 4];
        const TILT: Vec3 = [0.3, 0.2, 1.0];
        body yoke { mass: 0.8, com: [0.01, 0.02, -0.02], inertia: inertia(0.002, 0.0021, 0.0015, 0.0001, 0.0, -0.0002) }
        body thigh { mass: 4.0, com: [0.005, 0.01, -0.17], inertia: inertia(0.06, 0.062, 0.009, 0.0003, 0.0011, -0.0006) }
        body knee_crank { mass: 0.15, com: [-0.02, 0.003, 0.0], inertia: diag(0.00002, 0.0001, 0.0001) }
        body knee_rod { mass: 0.2, com: [0.001, 0.0, -0.175], inertia: diag(0.002, 0.002, 0.00001) }
        body shank { mass: 2.5, com: [0.004, -0.002, -0.16], inertia: inertia(0.035, 0.0355, 0.003, 0.0001, 0.0007, 0.0002) }
        body ankle_crank { mass: 0.12, com: -0.02 * X, inertia: diag(0.00002, 0.0001, 0.0001) }
        body ankle_rod { mass: 0.17, com: -0.175 * Z, inertia: diag(0.002, 0.002, 0.00001) }
        body foot { mass: 0.9, com: [0.04, 0.0, -0.04], inertia: inertia(0.0012, 0.004, 0.0042, 0.0, 0.0005, 0.0) }
        body toe { mass: 0.2, com: 0.03 * X, inertia: diag(0.0001, 0.0002, 0.0002) }
        joint roll: Revolute { parent: hip.rotated(Y, 0.3), child: yoke, axis: X }
        joint pitch: Revolute { parent: yoke, child: thigh, axis: [0.1, 1.0, 0.2] }
        joint knee_motor: Revolute { parent: thigh.at([-0.01, 0.03, -0.05]).rotated(TILT, 0.4), child: knee_crank, axis: Y, armature: 0.011 }
        joint knee_hinge: Revolute { parent: knee_crank.at(-0.05 * X), child: knee_rod, axis: Y }
        joint knee: Revolute { parent: thigh.at([-0.01, 0.03, -0.05]).rotated(TILT, 0.4).at([0.01, -0.03, -0.35]), child: shank, axis: Y }
        #[cut]
        joint knee_coupling: Revolute { parent: knee_rod.at(-0.35 * Z), child: shank.at([-0.06, 0.03, 0.0]), axis: Y }
        joint ankle_motor: Revolute { parent: shank.at([-0.01, 0.03, -0.05]).rotated(X, -0.2), child: ankle_crank, axis: Y, armature: 0.007 }
        joint ankle_hinge: Revolute { parent: ankle_crank.at(-0.05 * X), child: ankle_rod, axis: Y }
        joint ankle: Revolute { parent: shank.at([-0.01, 0.03, -0.05]).rotated(X, -0.2).at([0.01, -0.03, -0.35]), child: foot, axis: Y }
        #[cut]
        joint ankle_coupling: Revolute { parent: ankle_rod.at(-0.35 * Z), child: foot.at([-0.06, 0.03, 0.0]), axis: Y }
        joint bend: Revolute { parent: foot.at([0.1, 0.0, -0.05]), child: toe, axis: [0.0, 1.0, 0.1], armature: 0.0005 }
        constraint tendon = bend.angle + 0.3 * ankle.angle;
        force at_roll: Effort { joint: roll, value: torque[0] }
        force at_pitch: Effort { joint: pitch, value: torque[1] }
        force at_knee: Effort { joint: knee_motor, value: torque[2] }
        force at_ankle: Effort { joint: ankle_motor, value: torque[3] }
        force friction: Effort { joint: knee, value: -0.2 * knee.rate }
        force drag: Force { at: foot.at(0.05 * X), value: -1.5 * foot.velocity, axes: ground }
        solve (knee_hinge, knee) from knee_coupling { cos(knee_motor.angle + knee_hinge.angle - knee.angle) > 0.0 }
        solve (ankle_hinge, ankle) from ankle_coupling { cos(ankle_motor.angle + ankle_hinge.angle - ankle.angle) > 0.0 }
    }
    pub mod hopper {
        world { gravity: -9.81 * Z }
        formulation { constraints: Reduced }
        body pelvis { mass: 12.0, com: [0.01, 0.0, 0.12], inertia: inertia(0.21, 0.17, 0.13, 0.002, -0.006, 0.001) }
        joint float: Free { parent: ground, child: pelvis }
        part leg: leg { hip: pelvis.at([0.02, -0.1, -0.05]) };
        /// [m/s^2] of a sensor that sits askew on the trunk
        output felt = pelvis.at([0.1, 0.05, 0.2]).acceleration;
        emit forward_dynamics, inverse_dynamics, impulse;
    }
    /// The same with all coordinates in the state.
    pub mod hopper_held {
        world { gravity: -9.81 * Z }
        formulation { constraints: Multipliers }
        body pelvis { mass: 12.0, com: [0.01, 0.0, 0.12], inertia: inertia(0.21, 0.17, 0.13, 0.002, -0.006, 0.001) }
        joint float: Free { parent: ground, child: pelvis }
        part leg: leg { hip: pelvis.at([0.02, -0.1, -0.05]) };
        output felt = pelvis.at([0.1, 0.05, 0.2]).acceleration;
        emit forward_dynamics, impulse;
    }
}
