//! Random mechanisms as macro calls, written by `scripts/random_models.py`.

use multibody::multibody;

multibody! {
    /// Random mechanism number 0.
    pub mod tree0 {
        world { gravity: [-8.017, 0.0, 0.694] }
        body b0 { mass: 2.178, com: [0.0, -0.297, -0.272], inertia: diag(0.222, 0.297, 0.129) }
        joint j0: Screw { parent: ground.at([0.043, 0.325, 0.0]), child: b0.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), axis: Z, pitch: 0.126 }
        body b1 { mass: 1.285, com: [0.0, -0.209, 0.048], inertia: inertia(0.138957, 0.13941, 0.133633, 0.006578, -0.00775, -0.005717) }
        joint j1: Ball { parent: b0.rotated(Y, -0.115).at([0.0, 0.255, 0.0]).at([-0.156, 0.0, 0.159]), child: b1.rotated(Z, -0.086).at([-0.121, 0.0, 0.0]) }
        body b2 { mass: 2.503, com: [0.0, 0.206, 0.0], inertia: inertia(0.187495, 0.216385, 0.22012, -0.010475, -0.009872, -0.005195) }
        joint j2: Planar { parent: b1.at([0.0, 0.0, 0.0]), child: b2, axis: X }
        body b3 { mass: 1.352, com: [0.132, 0.0, 0.424], inertia: inertia(0.162682, 0.23187, 0.173448, 0.011832, 0.006873, 0.002018) }
        joint j3: Ball { parent: b2.at([0.341, -0.112, -0.596]).at([-0.05, -0.525, -0.134]).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), child: b3.at([0.439, -0.343, -0.194]), coordinates: RollPitchYaw }
        body b4 { mass: 2.464, com: [-0.462, -0.027, 0.149], inertia: diag(0.235, 0.135, 0.194) }
        joint j4: Fixed { parent: ground.rotated(Y, -0.391), child: b4.rotated(X, -1.275).rotated([-1.501, 0.0, 0.0], 0.506) }
        body b5 { mass: 2.565, com: [0.0, 0.0, 0.305], inertia: diag(0.202, 0.22, 0.33) }
        joint j5: Cylindrical { parent: b4.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: b5.rotated(Y, 1.865).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]).rotated([-1.144, 0.0, 0.664], -0.358), axis: Z }
        /// [m]
        output place = b5.position;
        /// [m/s]
        output velocity = b5.velocity;
        /// [rad/s]
        output omega = b5.angular_velocity;
        /// [m/s^2]
        output acceleration = b5.acceleration;
        /// at the child's frame of `j5`, in world axes
        output reaction = j5.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 1.
    pub mod tree1 {
        world { gravity: [0.0, 7.254, 0.0] }
        body b0 { mass: 2.305, com: [0.274, -0.301, -0.469], inertia: inertia(0.338462, 0.269987, 0.299552, -0.021864, -0.003832, -0.003758) }
        joint j0: Planar { parent: ground, child: b0, axis: X }
        body b1 { mass: 0.749, com: [-0.065, 0.043, -0.411], inertia: diag(0.139, 0.13, 0.175) }
        joint j1: Ball { parent: b0.at([0.396, 0.0, 0.33]), child: b1.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]) }
        body b2 { mass: 0.956, com: [-0.385, 0.0, -0.459], inertia: diag(0.198, 0.121, 0.149) }
        joint j2: Planar { parent: b1.at([-0.423, 0.481, -0.29]).at([-0.564, -0.018, 0.024]).rotated(Z, -0.687), child: b2.rotated(Y, -0.992).rotated(Y, 0.01), axis: Z }
        body b3 { mass: 2.772, com: [0.0, 0.0, 0.284], inertia: diag(0.355, 0.242, 0.245) }
        joint j3: Revolute { parent: b2, child: b3.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), axis: X }
        body b4 { mass: 2.687, com: [-0.29, 0.0, -0.465], inertia: diag(0.133, 0.278, 0.209) }
        joint j4: Fixed { parent: b3.at([0.0, 0.0, 0.0]).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]), child: b4 }
        body b5 { mass: 0.574, com: [0.0, -0.027, 0.0], inertia: inertia(0.36712, 0.371935, 0.370944, 0.006647, 0.006612, -0.007526) }
        joint j5: Ball { parent: b3.rotated(X, -1.226).at([0.0, -0.132, -0.597]).at([0.215, 0.505, 0.0]), child: b5 }
        /// [m]
        output place = b5.position;
        /// [m/s]
        output velocity = b5.velocity;
        /// [rad/s]
        output omega = b5.angular_velocity;
        /// [m/s^2]
        output acceleration = b5.acceleration;
        /// at the child's frame of `j4`, in world axes
        output reaction = j4.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 2.
    pub mod tree2 {
        world { gravity: [-5.581, 0.0, 2.522] }
        body b0 { mass: 1.775, com: [0.0, -0.46, 0.0], inertia: diag(0.168, 0.245, 0.163) }
        joint j0: Free { parent: ground.at([0.419, 0.094, -0.072]).rotated([0.0, -1.643, 0.0], -0.747), child: b0.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]) }
        body b1 { mass: 0.948, com: [0.0, 0.0, -0.434], inertia: diag(0.093, 0.054, 0.097) }
        joint j1: Ball { parent: b0, child: b1, coordinates: RollPitchYaw }
        body b2 { mass: 0.526, com: [-0.269, 0.134, -0.343], inertia: diag(0.281, 0.37, 0.271) }
        joint j2: Screw { parent: ground.rotated(Y, -0.667).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: b2.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).rotated(Z, -1.598), axis: X, pitch: -0.248 }
        body b3 { mass: 0.734, com: [0.0, 0.0, -0.211], inertia: inertia(0.202619, 0.268445, 0.220935, -0.005578, 0.00326, -0.024006) }
        joint j3: Cylindrical { parent: b2.at([0.563, 0.377, 0.0]).oriented([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]), child: b3, axis: Z }
        body b4 { mass: 0.695, com: [0.331, 0.0, 0.0], inertia: diag(0.144, 0.258, 0.218) }
        joint j4: Ball { parent: b3.at([0.322, 0.202, 0.0]), child: b4.at([-0.479, -0.314, -0.125]) }
        body b5 { mass: 1.939, com: [0.242, 0.0, -0.253], inertia: inertia(0.221605, 0.289357, 0.193038, 0.008278, 0.040719, 0.044592) }
        joint j5: Screw { parent: b4, child: b5.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]), axis: Y, pitch: 0.151, armature: 0.097 }
        body b6 { mass: 1.627, com: [0.0, 0.0, 0.0], inertia: inertia(0.198599, 0.161476, 0.219925, -0.017176, -0.03296, -0.053573) }
        joint j6: Fixed { parent: b5.rotated(X, -0.899).rotated(Y, 1.815).at([0.517, 0.0, 0.561]), child: b6.oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]) }
        /// [m]
        output place = b6.position;
        /// [m/s]
        output velocity = b6.velocity;
        /// [rad/s]
        output omega = b6.angular_velocity;
        /// [m/s^2]
        output acceleration = b6.acceleration;
        /// at the child's frame of `j3`, in world axes
        output reaction = j3.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 3.
    pub mod tree3 {
        world { gravity: [0.0, -1.066, -9.481] }
        body b0 { mass: 1.755, com: [0.397, 0.081, 0.17], inertia: inertia(0.280381, 0.285923, 0.281696, 0.001204, 0.000426, -0.00351) }
        joint j0: Free { parent: ground.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]), child: b0.rotated([-0.981, -1.211, -0.183], 1.081).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]) }
        body b1 { mass: 2.645, com: [0.0, 0.0, -0.351], inertia: diag(0.136, 0.15, 0.21) }
        joint j1: Revolute { parent: b0.at([-0.09, 0.577, 0.468]), child: b1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), axis: Z }
        body b2 { mass: 1.354, com: [-0.343, 0.0, 0.208], inertia: diag(0.184, 0.173, 0.243) }
        joint j2: Revolute { parent: b1.at([0.0, 0.0, -0.472]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: b2.oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]).rotated(X, 0.718), axis: [-0.257, -1.252, 0.0] }
        body b3 { mass: 1.328, com: [-0.289, 0.0, 0.0], inertia: diag(0.296, 0.301, 0.385) }
        joint j3: Fixed { parent: b2.rotated(X, 1.551).at([0.0, -0.193, 0.455]), child: b3.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) }
        body b4 { mass: 1.096, com: [0.0, -0.023, 0.0], inertia: diag(0.129, 0.121, 0.058) }
        joint j4: Screw { parent: b3.rotated(Z, -0.709).at([0.414, -0.382, 0.0]), child: b4.oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]).rotated([0.0, 1.401, 0.0], 1.985), axis: Y, pitch: -0.199 }
        /// [m]
        output place = b4.position;
        /// [m/s]
        output velocity = b4.velocity;
        /// [rad/s]
        output omega = b4.angular_velocity;
        /// [m/s^2]
        output acceleration = b4.acceleration;
        /// at the child's frame of `j1`, in world axes
        output reaction = j1.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 4.
    pub mod tree4 {
        world { gravity: [2.266, 0.177, 0.0] }
        body b0 { mass: 2.251, com: [0.309, -0.13, 0.221], inertia: inertia(0.085104, 0.074335, 0.078561, -0.005249, -0.008999, 0.004934) }
        joint j0: Revolute { parent: ground.at([0.237, 0.0, 0.259]), child: b0.oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), axis: Y }
        body b1 { mass: 1.088, com: [0.0, 0.236, 0.0], inertia: inertia(0.242212, 0.250493, 0.205296, -0.034001, -8.7e-05, -0.05438) }
        joint j1: Prismatic { parent: b0.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]).rotated([-1.604, -0.356, 0.0], 0.907).at([0.0, 0.0, -0.535]), child: b1.rotated(X, 0.804), axis: Z }
        body b2 { mass: 0.818, com: [0.399, 0.0, 0.0], inertia: inertia(0.201979, 0.198987, 0.111034, -0.002338, 0.042501, -0.039437) }
        joint j2: Ball { parent: b1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), child: b2 }
        body b3 { mass: 2.531, com: [-0.393, 0.452, 0.361], inertia: diag(0.244, 0.217, 0.153) }
        joint j3: Prismatic { parent: ground.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: b3.at([0.0, -0.507, 0.0]).at([-0.58, -0.059, -0.476]), axis: X }
        /// [m]
        output place = b3.position;
        /// [m/s]
        output velocity = b3.velocity;
        /// [rad/s]
        output omega = b3.angular_velocity;
        /// [m/s^2]
        output acceleration = b3.acceleration;
        /// at the child's frame of `j1`, in world axes
        output reaction = j1.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 5.
    pub mod tree5 {
        world { gravity: [0.749, 1.463, -2.851] }
        body b0 { mass: 0.806, com: [-0.132, 0.0, 0.0], inertia: diag(0.236, 0.214, 0.304) }
        joint j0: Ball { parent: ground.at([0.0, 0.0, 0.455]).at([0.113, 0.0, 0.0]).oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), child: b0.oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]).rotated(Y, -0.172) }
        body b1 { mass: 2.987, com: [-0.482, -0.212, 0.317], inertia: inertia(0.302199, 0.172768, 0.241033, -0.014796, 0.003152, 0.002284) }
        joint j1: Revolute { parent: b0.rotated(X, -0.826), child: b1.oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).rotated([-0.306, -1.71, -0.679], 1.786).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]), axis: X, armature: 0.098 }
        body b2 { mass: 2.148, com: [0.081, -0.246, -0.184], inertia: inertia(0.179983, 0.312493, 0.211523, -0.018171, 0.004597, -0.001898) }
        joint j2: Ball { parent: b1.rotated(Z, 1.481), child: b2.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).oriented([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]) }
        body b3 { mass: 2.415, com: [0.316, -0.313, 0.0], inertia: inertia(0.210527, 0.246608, 0.110866, 0.016521, -0.027018, 0.033883) }
        joint j3: Revolute { parent: b2.rotated(Y, -1.73).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]).oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]), child: b3, axis: Y }
        body b4 { mass: 2.524, com: [-0.143, 0.162, 0.0], inertia: diag(0.21, 0.185, 0.247) }
        joint j4: Revolute { parent: b3.rotated(Y, 0.023), child: b4.rotated(Y, -0.142), axis: [0.0, -1.723, 1.687] }
        body b5 { mass: 1.549, com: [-0.103, 0.0, -0.362], inertia: inertia(0.147258, 0.18609, 0.230653, 0.068712, -0.024745, 0.002446) }
        joint j5: Revolute { parent: b4.rotated([0.0, 1.951, 0.0], -0.275).at([-0.518, 0.0, -0.311]).at([0.0, -0.257, -0.306]), child: b5.rotated([0.546, -1.753, -1.332], -0.049).oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), axis: [0.0, 0.0, 0.334] }
        body b6 { mass: 1.861, com: [-0.24, -0.066, 0.232], inertia: diag(0.237, 0.228, 0.217) }
        joint j6: Ball { parent: b0.at([0.0, 0.0, 0.0]).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), child: b6.oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]).at([0.0, -0.519, -0.219]), coordinates: RollPitchYaw }
        body b7 { mass: 2.06, com: [0.0, 0.142, 0.0], inertia: inertia(0.298422, 0.276554, 0.259024, -0.006213, -0.015171, 0.012434) }
        joint j7: Fixed { parent: b6.at([-0.095, -0.099, -0.372]), child: b7.at([0.513, -0.493, 0.0]).at([0.0, 0.412, 0.384]) }
        /// [m]
        output place = b7.position;
        /// [m/s]
        output velocity = b7.velocity;
        /// [rad/s]
        output omega = b7.angular_velocity;
        /// [m/s^2]
        output acceleration = b7.acceleration;
        /// at the child's frame of `j1`, in world axes
        output reaction = j1.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 6.
    pub mod tree6 {
        world { gravity: [0.0, 0.0, -3.55] }
        body b0 { mass: 2.735, com: [0.135, -0.094, 0.0], inertia: inertia(0.096348, 0.072245, 0.077407, 0.013246, -0.011807, 0.019002) }
        joint j0: Free { parent: ground, child: b0 }
        body b1 { mass: 1.723, com: [0.0, 0.0, 0.382], inertia: inertia(0.243384, 0.197518, 0.199098, -0.012948, -0.03288, 0.019122) }
        joint j1: Planar { parent: b0.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: b1.at([0.0, 0.0, 0.0]).at([0.0, 0.0, 0.303]).oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]), axis: X }
        body b2 { mass: 0.612, com: [-0.056, 0.0, 0.0], inertia: diag(0.17, 0.158, 0.142) }
        joint j2: Revolute { parent: b1, child: b2.at([-0.169, 0.0, 0.0]).oriented([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).rotated(Y, -1.342), axis: Z, armature: 0.117 }
        /// [m]
        output place = b2.position;
        /// [m/s]
        output velocity = b2.velocity;
        /// [rad/s]
        output omega = b2.angular_velocity;
        /// [m/s^2]
        output acceleration = b2.acceleration;
        /// at the child's frame of `j2`, in world axes
        output reaction = j2.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 7.
    pub mod tree7 {
        body b0 { mass: 2.354, com: [-0.275, 0.134, -0.054], inertia: diag(0.208, 0.097, 0.253) }
        joint j0: Cylindrical { parent: ground, child: b0, axis: Z }
        body b1 { mass: 1.236, com: [0.0, 0.0, -0.409], inertia: diag(0.196, 0.362, 0.224) }
        joint j1: Ball { parent: b0.rotated([1.524, 0.0, 0.0], 0.066).rotated(X, 1.136).rotated(X, -1.719), child: b1.rotated(Z, -1.423).rotated([1.86, 0.248, 1.265], 1.196) }
        body b2 { mass: 2.023, com: [0.0, 0.0, 0.0], inertia: diag(0.195, 0.134, 0.145) }
        joint j2: Universal { parent: b1.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).at([-0.008, 0.43, 0.299]), child: b2.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]).rotated(Z, 1.827).rotated(Z, 1.599), axes: [X, Z] }
        body b3 { mass: 1.481, com: [0.232, 0.0, -0.371], inertia: inertia(0.169069, 0.199069, 0.279863, -0.035166, -0.027615, 0.006777) }
        joint j3: Planar { parent: b2.rotated(Y, -1.5).at([-0.535, 0.0, 0.0]).at([0.295, -0.2, 0.0]), child: b3.at([0.0, 0.251, 0.135]).rotated(Y, 1.326).oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]), axis: X }
        body b4 { mass: 2.453, com: [0.0, 0.0, 0.0], inertia: diag(0.195, 0.218, 0.351) }
        joint j4: Prismatic { parent: b3.at([0.386, 0.181, -0.364]), child: b4, axis: X }
        body b5 { mass: 2.027, com: [0.0, 0.0, -0.108], inertia: inertia(0.232132, 0.30934, 0.264528, -0.003829, 0.020755, -0.006769) }
        joint j5: Revolute { parent: b2.at([-0.261, 0.188, -0.248]), child: b5.rotated([1.542, 0.634, -0.919], 0.855).at([0.0, -0.551, -0.201]).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), axis: [0.0, 0.0, 1.36] }
        body b6 { mass: 0.717, com: [0.0, 0.0, 0.0], inertia: diag(0.171, 0.093, 0.186) }
        joint j6: Revolute { parent: b5, child: b6.rotated(Y, -0.434), axis: [1.956, -1.339, 0.0] }
        /// [m]
        output place = b6.position;
        /// [m/s]
        output velocity = b6.velocity;
        /// [rad/s]
        output omega = b6.angular_velocity;
        /// [m/s^2]
        output acceleration = b6.acceleration;
        /// at the child's frame of `j5`, in world axes
        output reaction = j5.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 8.
    pub mod tree8 {
        world { gravity: [-3.194, 8.504, 0.0] }
        body b0 { mass: 2.965, com: [0.169, 0.368, 0.0], inertia: inertia(0.186515, 0.195091, 0.184393, -0.0192, -0.009834, 0.021538) }
        joint j0: Fixed { parent: ground.at([0.515, 0.0, -0.24]).at([-0.051, 0.207, 0.492]), child: b0.rotated([0.0, 0.0, 0.683], -0.038).at([0.49, 0.275, 0.0]) }
        body b1 { mass: 0.861, com: [-0.005, -0.153, 0.303], inertia: inertia(0.104993, 0.101349, 0.113658, -0.014943, -0.005304, 0.002431) }
        joint j1: Revolute { parent: b0.oriented([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]).at([0.583, 0.0, -0.31]), child: b1.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), axis: [1.463, 0.0, -1.436] }
        body b2 { mass: 1.616, com: [0.012, 0.0, 0.0], inertia: diag(0.243, 0.326, 0.215) }
        joint j2: Ball { parent: b1.at([0.229, 0.55, 0.0]).at([0.406, 0.0, 0.0]), child: b2.oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).rotated([0.0, 0.0, -1.276], -0.902).rotated([-0.215, 0.0, -1.818], -0.361), coordinates: RollPitchYaw }
        body b3 { mass: 2.593, com: [0.0, 0.0, 0.295], inertia: diag(0.116, 0.14, 0.2) }
        joint j3: Planar { parent: b0.oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), child: b3.rotated(X, -1.449).at([0.512, -0.522, 0.0]), axis: Z }
        body b4 { mass: 1.803, com: [-0.25, -0.482, 0.0], inertia: diag(0.168, 0.16, 0.144) }
        joint j4: Ball { parent: b3.rotated(X, 0.338), child: b4, coordinates: RollPitchYaw }
        body b5 { mass: 1.348, com: [0.0, -0.441, 0.0], inertia: inertia(0.32086, 0.23968, 0.231459, 0.043034, 0.001986, 0.01518) }
        joint j5: Fixed { parent: b4.at([0.062, 0.0, 0.462]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]).rotated([0.113, -1.696, -1.53], 1.588), child: b5 }
        body b6 { mass: 2.734, com: [-0.452, 0.0, 0.0], inertia: inertia(0.205696, 0.11925, 0.205055, -0.022309, 0.001367, -0.013753) }
        joint j6: Prismatic { parent: b5.rotated(X, -1.257).oriented([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]), child: b6.at([-0.378, 0.0, -0.363]).rotated(Y, 1.603), axis: Z }
        body b7 { mass: 2.26, com: [0.0, 0.228, -0.267], inertia: inertia(0.228762, 0.304084, 0.297154, 0.011112, 0.006463, -0.034058) }
        joint j7: Cylindrical { parent: b6.rotated([1.541, -0.337, -1.178], 0.75), child: b7.rotated(Z, -0.304).at([0.464, 0.324, 0.54]), axis: Y }
        /// [m]
        output place = b7.position;
        /// [m/s]
        output velocity = b7.velocity;
        /// [rad/s]
        output omega = b7.angular_velocity;
        /// [m/s^2]
        output acceleration = b7.acceleration;
        /// at the child's frame of `j2`, in world axes
        output reaction = j2.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 9.
    pub mod tree9 {
        world { gravity: [-8.448, 8.393, 0.059] }
        body b0 { mass: 0.72, com: [0.0, 0.174, 0.0], inertia: inertia(0.274716, 0.228973, 0.256311, -0.005463, -0.004612, 0.008915) }
        joint j0: Cylindrical { parent: ground.at([-0.056, 0.0, 0.0]).rotated(Y, -0.644).rotated(Y, -1.235), child: b0.at([-0.19, 0.388, 0.549]), axis: X }
        body b1 { mass: 2.741, com: [-0.203, 0.0, 0.352], inertia: diag(0.2, 0.124, 0.152) }
        joint j1: Free { parent: ground, child: b1.rotated([1.038, -1.44, -0.387], -0.701).oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]).at([-0.282, -0.275, 0.0]), coordinates: RollPitchYaw }
        body b2 { mass: 1.697, com: [0.044, 0.0, 0.327], inertia: inertia(0.339368, 0.313562, 0.30707, -0.005168, -0.007432, -0.022565) }
        joint j2: Revolute { parent: b1, child: b2.rotated([0.0, -1.478, 1.719], 1.622).at([0.412, 0.42, -0.088]), axis: Y, armature: 0.132 }
        body b3 { mass: 1.993, com: [0.0, 0.058, 0.0], inertia: inertia(0.216059, 0.175331, 0.20461, 0.007993, -0.001966, 0.018638) }
        joint j3: Revolute { parent: ground.at([0.0, -0.236, 0.0]).oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: b3.at([0.04, 0.0, 0.0]).oriented([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]).rotated(X, 0.025), axis: X, armature: 0.186 }
        /// [m]
        output place = b3.position;
        /// [m/s]
        output velocity = b3.velocity;
        /// [rad/s]
        output omega = b3.angular_velocity;
        /// [m/s^2]
        output acceleration = b3.acceleration;
        /// at the child's frame of `j2`, in world axes
        output reaction = j2.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 10.
    pub mod tree10 {
        world { gravity: [-5.06, 0.0, -6.713] }
        body b0 { mass: 0.767, com: [0.144, 0.0, 0.0], inertia: inertia(0.252462, 0.239919, 0.235619, -0.025922, 2.4e-05, 0.003712) }
        joint j0: Screw { parent: ground, child: b0, axis: [0.0, -1.308, 1.338], pitch: 0.234, armature: 0.197 }
        body b1 { mass: 0.628, com: [0.082, 0.0, 0.0], inertia: diag(0.133, 0.251, 0.24) }
        joint j1: Ball { parent: b0.rotated(Z, -1.644), child: b1.rotated([0.0, 0.0, 0.921], 1.402).rotated(X, -0.465).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]), coordinates: RollPitchYaw }
        body b2 { mass: 0.75, com: [0.366, -0.148, 0.0], inertia: inertia(0.271812, 0.25357, 0.198618, -0.028579, -0.00618, 0.055747) }
        joint j2: Revolute { parent: b1.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).rotated(X, -1.943), child: b2.at([0.155, -0.396, 0.0]).rotated(X, 1.315).at([0.0, -0.333, -0.317]), axis: [-1.052, 0.0, -0.974] }
        body b3 { mass: 1.302, com: [-0.195, -0.057, 0.045], inertia: diag(0.256, 0.197, 0.243) }
        joint j3: Planar { parent: b2.oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]).at([0.425, 0.0, 0.0]).rotated([0.0, 0.0, -0.372], -1.603), child: b3.rotated(Y, -0.175).rotated(Z, 0.956), axis: Z }
        body b4 { mass: 1.067, com: [0.0, -0.407, 0.084], inertia: inertia(0.210741, 0.241886, 0.245373, -0.001322, -0.013648, 0.005543) }
        joint j4: Universal { parent: b3.rotated(Z, 1.105).oriented([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]), child: b4.rotated(Y, -1.466).at([-0.352, 0.02, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), axes: [X, Y] }
        body b5 { mass: 2.313, com: [0.0, 0.027, 0.102], inertia: diag(0.235, 0.257, 0.26) }
        joint j5: Ball { parent: b4.oriented([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), child: b5.at([0.0, 0.0, 0.0]), coordinates: RollPitchYaw }
        /// [m]
        output place = b5.position;
        /// [m/s]
        output velocity = b5.velocity;
        /// [rad/s]
        output omega = b5.angular_velocity;
        /// [m/s^2]
        output acceleration = b5.acceleration;
        /// at the child's frame of `j5`, in world axes
        output reaction = j5.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Random mechanism number 11.
    pub mod tree11 {
        world { gravity: [0.0, 0.0, 5.677] }
        body b0 { mass: 0.946, com: [-0.203, -0.12, -0.387], inertia: diag(0.219, 0.18, 0.155) }
        joint j0: Cylindrical { parent: ground, child: b0.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), axis: X }
        body b1 { mass: 2.669, com: [-0.369, -0.409, -0.246], inertia: diag(0.286, 0.228, 0.166) }
        joint j1: Cylindrical { parent: b0.at([0.0, 0.0, 0.0]).rotated(Y, 0.263), child: b1.oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]).rotated([0.0, -1.317, 0.0], 1.621), axis: X }
        body b2 { mass: 1.339, com: [0.265, 0.0, 0.272], inertia: diag(0.082, 0.181, 0.167) }
        joint j2: Prismatic { parent: b1.rotated(X, -1.075).rotated([0.597, 0.081, 0.0], -0.166).at([0.0, 0.445, 0.0]), child: b2.at([0.0, 0.563, 0.0]).at([-0.127, -0.217, 0.0]).at([-0.245, -0.574, 0.02]), axis: Z }
        body b3 { mass: 0.957, com: [0.0, -0.128, -0.179], inertia: inertia(0.16093, 0.230556, 0.156514, -0.00557, 0.050289, 0.004162) }
        joint j3: Fixed { parent: b0.rotated(Z, 0.794).rotated(Z, -0.886).rotated([-0.601, 1.454, 0.0], 0.024), child: b3 }
        body b4 { mass: 1.423, com: [0.0, 0.0, -0.01], inertia: inertia(0.304283, 0.287119, 0.310598, -0.03408, 0.046993, -0.038011) }
        joint j4: Free { parent: ground.rotated([-0.181, 0.0, -0.28], 1.599).oriented([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]), child: b4.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).at([-0.49, 0.336, -0.422]), coordinates: RollPitchYaw }
        body b5 { mass: 0.8, com: [0.0, 0.48, 0.0], inertia: diag(0.074, 0.112, 0.08) }
        joint j5: Fixed { parent: b4, child: b5.rotated([-1.149, -1.214, 0.0], 0.823).oriented([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]) }
        /// [m]
        output place = b5.position;
        /// [m/s]
        output velocity = b5.velocity;
        /// [rad/s]
        output omega = b5.angular_velocity;
        /// [m/s^2]
        output acceleration = b5.acceleration;
        /// at the child's frame of `j3`, in world axes
        output reaction = j3.reaction;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}
