//! Franka Emika's arm, as `panda.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    /// Franka Emika's arm with its hand. Joint axes are the bodies' z axes; `payload` hangs at the tool centre point.
    pub(crate) mod panda {
        /// [kg] what the hand holds
        param payload = 0.0;
        /// [N m] of the seven motors
        input torque: [Scalar; 7];

        world { gravity: -9.81 * Z }

        body link1 {
            mass: 4.970684,
            com: [0.003875, 0.002081, -0.04762],
            inertia: inertia(0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169),
        }
        body link2 {
            mass: 0.646926,
            com: [-0.003141, -0.02872, 0.003495],
            inertia: inertia(0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704),
        }
        body link3 {
            mass: 3.228604,
            com: [0.027518, 0.039252, -0.066502],
            inertia: inertia(0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805),
        }
        body link4 {
            mass: 3.587895,
            com: [-0.05317, 0.104419, 0.027454],
            inertia: inertia(0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641),
        }
        body link5 {
            mass: 1.225946,
            com: [-0.011953, 0.041065, -0.038437],
            inertia: inertia(0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229),
        }
        body link6 {
            mass: 1.666555,
            com: [0.060149, -0.014117, -0.010517],
            inertia: inertia(0.001964, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341),
        }
        /// The last link and the hand.
        body link7 {
            mass: 1.495522,
            com: [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578],
            inertia: inertia(
                0.016529853712634629, 0.014107248642161839, 0.0066769555566409556,
                0.00039489229711917772, -0.00070669571061450173, -0.001051105327046708,
            ),
        }
        body load { mass: payload }

        joint q1: Revolute { parent: ground.at(0.333 * Z), child: link1, axis: Z }
        joint q2: Revolute { parent: link1.rotated(X, deg(-90.0)), child: link2, axis: Z }
        joint q3: Revolute { parent: link2.at(-0.316 * Y).rotated(X, deg(90.0)), child: link3, axis: Z }
        joint q4: Revolute { parent: link3.at(0.0825 * X).rotated(X, deg(90.0)), child: link4, axis: Z }
        joint q5: Revolute { parent: link4.at([-0.0825, 0.384, 0.0]).rotated(X, deg(-90.0)), child: link5, axis: Z }
        joint q6: Revolute { parent: link5.rotated(X, deg(90.0)), child: link6, axis: Z }
        joint q7: Revolute { parent: link6.at(0.088 * X).rotated(X, deg(90.0)), child: link7, axis: Z }
        joint grip: Fixed { parent: link7.at(0.2104 * Z), child: load }

        force motor1: Effort { joint: q1, value: torque[0] }
        force motor2: Effort { joint: q2, value: torque[1] }
        force motor3: Effort { joint: q3, value: torque[2] }
        force motor4: Effort { joint: q4, value: torque[3] }
        force motor5: Effort { joint: q5, value: torque[4] }
        force motor6: Effort { joint: q6, value: torque[5] }
        force motor7: Effort { joint: q7, value: torque[6] }

        /// [m] tool centre point
        output tip: Vec3 = link7.at(0.2104 * Z).position;
        /// [J]
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
}
