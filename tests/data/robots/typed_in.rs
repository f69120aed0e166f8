// Robots typed in, written by `scripts/robots.py`; `{functions}` stands for what a test asks for.

multibody! {
    pub mod quadruped {
        world { gravity: -9.81 * Z }
        body trunk { mass: 6.921, com: [-0.037, -0.0556, -0.0146], inertia: inertia(0.0900378, 0.087038, 0.0984014, 0.007087, 0.0050946, 0.0044962) }
        joint floating: Free { parent: ground, child: trunk }
        body fl_hip { mass: 0.678, com: [-0.0089, 0.0012, -0.0071], inertia: inertia(0.0004639, 0.0004524, 0.0004711, 3.71e-05, 2.85e-05, 2.66e-05) }
        body fl_thigh { mass: 1.152, com: [0.024, -0.0245, -0.0152], inertia: inertia(0.0057636, 0.005957, 0.0061833, 0.0003503, -0.0003809, 9.76e-05) }
        body fl_shank { mass: 0.154, com: [0.0137, 0.0005, -0.0258], inertia: inertia(0.0007327, 0.000638, 0.0008463, 4.5e-05, 5.9e-06, -2.46e-05) }
        joint fl_abduction: Revolute { parent: trunk.at([0.1934, 0.0465, 0.0]), child: fl_hip, axis: X }
        force fl_abduction_damper: Damper { joint: fl_abduction, damping: 0.459 }
        joint fl_flexion: Revolute { parent: fl_hip.at([0.0, 0.0955, 0.0]), child: fl_thigh, axis: Y }
        force fl_flexion_damper: Damper { joint: fl_flexion, damping: 0.308 }
        joint fl_knee: Revolute { parent: fl_thigh.at([0.0, 0.0, -0.213]), child: fl_shank, axis: Y }
        let fl_foot = fl_shank.at([0.0, 0.0, -0.211]);
        body fr_hip { mass: 0.678, com: [0.0122, 0.0111, 0.0003], inertia: inertia(0.0005058, 0.0005379, 0.0005087, -2.94e-05, -1.69e-05, 2.71e-05) }
        body fr_thigh { mass: 1.152, com: [-0.0365, -0.0363, 0.0101], inertia: inertia(0.0051249, 0.0055934, 0.0054766, -0.0001448, 0.0004583, -0.0002806) }
        body fr_shank { mass: 0.154, com: [-0.007, -0.0238, 0.0106], inertia: inertia(0.0006841, 0.0007037, 0.0008, -2.21e-05, 7.2e-06, 4.98e-05) }
        joint fr_abduction: Revolute { parent: trunk.at([0.1934, -0.0465, 0.0]), child: fr_hip, axis: X }
        force fr_abduction_damper: Damper { joint: fr_abduction, damping: 0.095 }
        joint fr_flexion: Revolute { parent: fr_hip.at([0.0, -0.0955, 0.0]), child: fr_thigh, axis: Y }
        force fr_flexion_damper: Damper { joint: fr_flexion, damping: 0.078 }
        joint fr_knee: Revolute { parent: fr_thigh.at([0.0, 0.0, -0.213]), child: fr_shank, axis: Y }
        let fr_foot = fr_shank.at([0.0, 0.0, -0.211]);
        body rl_hip { mass: 0.678, com: [-0.0087, 0.0085, 0.0037], inertia: inertia(0.0004751, 0.0004914, 0.0004647, -3.6e-06, -3.97e-05, 1.71e-05) }
        body rl_thigh { mass: 1.152, com: [0.0317, 0.0364, 0.0188], inertia: inertia(0.0063772, 0.0046415, 0.0051407, 0.0004295, 0.0002537, -8.25e-05) }
        body rl_shank { mass: 0.154, com: [0.0355, 0.0096, 0.0254], inertia: inertia(0.0006883, 0.0006632, 0.0007254, -4.48e-05, -1.46e-05, 5.69e-05) }
        joint rl_abduction: Revolute { parent: trunk.at([-0.1934, 0.0465, 0.0]), child: rl_hip, axis: X }
        force rl_abduction_damper: Damper { joint: rl_abduction, damping: 0.199 }
        joint rl_flexion: Revolute { parent: rl_hip.at([0.0, 0.0955, 0.0]), child: rl_thigh, axis: Y }
        force rl_flexion_damper: Damper { joint: rl_flexion, damping: 0.054 }
        joint rl_knee: Revolute { parent: rl_thigh.at([0.0, 0.0, -0.213]), child: rl_shank, axis: Y }
        let rl_foot = rl_shank.at([0.0, 0.0, -0.211]);
        body rr_hip { mass: 0.678, com: [-0.0146, -0.0106, 0.0091], inertia: inertia(0.0004969, 0.0004843, 0.0004508, 4.18e-05, -6.6e-06, -2.53e-05) }
        body rr_thigh { mass: 1.152, com: [-0.0353, -0.0356, -0.0265], inertia: inertia(0.0058555, 0.0048838, 0.0046834, -8.6e-06, -0.0002313, 0.0004586) }
        body rr_shank { mass: 0.154, com: [-0.0302, 0.0023, 0.0219], inertia: inertia(0.0007169, 0.0008594, 0.0007337, -3.18e-05, -1.1e-05, -5.71e-05) }
        joint rr_abduction: Revolute { parent: trunk.at([-0.1934, -0.0465, 0.0]), child: rr_hip, axis: X }
        force rr_abduction_damper: Damper { joint: rr_abduction, damping: 0.24 }
        joint rr_flexion: Revolute { parent: rr_hip.at([0.0, -0.0955, 0.0]), child: rr_thigh, axis: Y }
        force rr_flexion_damper: Damper { joint: rr_flexion, damping: 0.162 }
        joint rr_knee: Revolute { parent: rr_thigh.at([0.0, 0.0, -0.213]), child: rr_shank, axis: Y }
        let rr_foot = rr_shank.at([0.0, 0.0, -0.211]);
        {functions}
    }
}

multibody! {
    pub mod humanoid {
        world { gravity: -9.81 * Z }
        body pelvis { mass: 8.337, com: [0.0047, -0.0253, -0.0564], inertia: inertia(0.0946507, 0.081336, 0.0827547, -0.0015427, 0.0021246, 0.0073354) }
        joint floating: Free { parent: ground, child: pelvis }
        body waist_yaw_link { mass: 4.005, com: [0.0395, 0.0394, -0.0206], inertia: inertia(0.0164855, 0.0170446, 0.0214149, 0.000319, 0.0013376, 0.0015128) }
        joint waist_yaw: Revolute { parent: pelvis.at([0.0618, 0.0141, -0.1729]).rotated(Z, 0.2064).rotated(Y, 0.3664).rotated(X, -0.5718), child: waist_yaw_link, axis: [0.526, 0.1313, 0.3478] }
        force waist_yaw_damper: Damper { joint: waist_yaw, damping: 0.337 }
        body waist_roll_link { mass: 5.072, com: [-0.0311, -0.0004, -0.0153], inertia: inertia(0.0270183, 0.0274057, 0.0223333, -0.0017028, -0.0010419, -0.0007522) }
        joint waist_roll: Revolute { parent: waist_yaw_link.at([0.1079, -0.0361, 0.1]).rotated(Z, -0.3764).rotated(Y, 0.0285).rotated(X, -0.2389), child: waist_roll_link, axis: [0.2908, 0.0262, 0.7253] }
        force waist_roll_damper: Damper { joint: waist_roll, damping: 0.477 }
        body waist_pitch_link { mass: 4.149, com: [-0.0345, 0.035, 0.0356], inertia: inertia(0.0197443, 0.0198199, 0.0227865, -0.0008176, -0.0008112, 0.000648) }
        joint waist_pitch: Revolute { parent: waist_roll_link.at([0.07, 0.0744, 0.1312]).rotated(Z, -0.3294).rotated(Y, -0.0958).rotated(X, 0.0149), child: waist_pitch_link, axis: [-0.5733, -0.2603, -0.1365] }
        force waist_pitch_damper: Damper { joint: waist_pitch, damping: 0.383 }
        body neck_link { mass: 2.466, com: [0.0006, -0.0072, 0.0075], inertia: inertia(0.0063969, 0.007318, 0.0069774, 0.0002161, -0.0001407, 1.99e-05) }
        joint neck: Revolute { parent: waist_pitch_link.at([0.0664, 0.137, 0.0086]).rotated(Z, -0.4566).rotated(Y, 0.2271).rotated(X, -0.2151), child: neck_link, axis: [-0.3308, -0.9346, 0.1056] }
        force neck_damper: Damper { joint: neck, damping: 0.164 }
        body left_hip_yaw_link { mass: 2.525, com: [0.0288, 0.0135, -0.0463], inertia: inertia(0.0185761, 0.0158236, 0.0209777, -1.11e-05, 0.001106, -0.0007428) }
        joint left_hip_yaw: Revolute { parent: pelvis.at([0.1615, -0.1807, 0.1837]).rotated(Z, 0.4982).rotated(Y, -0.5121).rotated(X, -0.1324), child: left_hip_yaw_link, axis: [0.6735, -0.6128, 0.1549] }
        force left_hip_yaw_damper: Damper { joint: left_hip_yaw, damping: 0.264 }
        body left_hip_roll_link { mass: 2.121, com: [-0.0075, 0.0473, -0.0119], inertia: inertia(0.0172801, 0.0172876, 0.0173354, 0.0002976, 0.0010666, -0.0004184) }
        joint left_hip_roll: Revolute { parent: left_hip_yaw_link.at([-0.0107, -0.0262, -0.1995]).rotated(Z, 0.089).rotated(Y, 0.3148).rotated(X, -0.0131), child: left_hip_roll_link, axis: [-0.6452, -0.5146, -0.0319] }
        force left_hip_roll_damper: Damper { joint: left_hip_roll, damping: 0.098 }
        body left_hip_pitch_link { mass: 2.215, com: [0.0239, -0.0393, -0.0386], inertia: inertia(0.0147226, 0.0167106, 0.0139618, 0.0005166, 0.0001837, 0.0007179) }
        joint left_hip_pitch: Revolute { parent: left_hip_roll_link.at([0.1376, 0.1118, 0.0087]).rotated(Z, -0.4204).rotated(Y, 0.1173).rotated(X, -0.2351), child: left_hip_pitch_link, axis: [-0.5431, 0.3999, 0.1953] }
        force left_hip_pitch_damper: Damper { joint: left_hip_pitch, damping: 0.112 }
        body left_knee_link { mass: 2.608, com: [0.0099, -0.0277, 0.0149], inertia: inertia(0.0172345, 0.0173734, 0.0190059, -0.0006916, 0.0007147, -0.0002789) }
        joint left_knee: Revolute { parent: left_hip_pitch_link.at([-0.1052, 0.1593, 0.1672]).rotated(Z, -0.2736).rotated(Y, -0.4557).rotated(X, 0.3271), child: left_knee_link, axis: [-0.8038, 0.4889, -0.0724] }
        force left_knee_damper: Damper { joint: left_knee, damping: 0.092 }
        body left_ankle_pitch_link { mass: 3.406, com: [-0.0424, -0.0455, 0.04], inertia: inertia(0.0251434, 0.0285686, 0.0262979, -0.0015475, -8.06e-05, 0.0011129) }
        joint left_ankle_pitch: Revolute { parent: left_knee_link.at([-0.2412, 0.1386, -0.0747]).rotated(Z, 0.3462).rotated(Y, -0.2146).rotated(X, 0.0163), child: left_ankle_pitch_link, axis: [-0.0327, -0.0966, -0.8742] }
        force left_ankle_pitch_damper: Damper { joint: left_ankle_pitch, damping: 0.378 }
        body left_ankle_roll_link { mass: 2.171, com: [0.0104, -0.0495, -0.0392], inertia: inertia(0.0169737, 0.0151067, 0.0168039, 0.0005199, -0.0003956, 9.11e-05) }
        joint left_ankle_roll: Revolute { parent: left_ankle_pitch_link.at([-0.0552, -0.2282, 0.1724]).rotated(Z, 0.1675).rotated(Y, 0.4415).rotated(X, 0.0368), child: left_ankle_roll_link, axis: [0.2608, -0.7776, 0.2418] }
        force left_ankle_roll_damper: Damper { joint: left_ankle_roll, damping: 0.244 }
        let left_sole = left_ankle_roll_link.at([0.03, -0.01, -0.05]);
        body left_shoulder_pitch_link { mass: 1.039, com: [-0.0279, -0.0231, -0.031], inertia: inertia(0.0042557, 0.0039384, 0.0035384, 4.48e-05, 0.0002535, 0.0002877) }
        joint left_shoulder_pitch: Revolute { parent: waist_pitch_link.at([-0.152, 0.0435, 0.0412]).rotated(Z, -0.0394).rotated(Y, -0.1526).rotated(X, -0.0247), child: left_shoulder_pitch_link, axis: [-0.3144, -0.2154, -0.6382] }
        force left_shoulder_pitch_damper: Damper { joint: left_shoulder_pitch, damping: 0.362 }
        body left_shoulder_roll_link { mass: 1.455, com: [0.0338, -0.0091, -0.0192], inertia: inertia(0.0051923, 0.0047535, 0.0059754, -0.0003354, 1e-06, 0.0003436) }
        joint left_shoulder_roll: Revolute { parent: left_shoulder_pitch_link.at([0.0728, 0.0467, 0.0961]).rotated(Z, 0.133).rotated(Y, 0.3894).rotated(X, 0.1318), child: left_shoulder_roll_link, axis: [-0.548, -0.8594, 0.8754] }
        force left_shoulder_roll_damper: Damper { joint: left_shoulder_roll, damping: 0.101 }
        body left_shoulder_yaw_link { mass: 1.223, com: [0.0271, 0.0244, 0.0184], inertia: inertia(0.0040373, 0.0040127, 0.0047891, -0.0003177, -0.0002197, -0.000194) }
        joint left_shoulder_yaw: Revolute { parent: left_shoulder_roll_link.at([0.1075, 0.1129, 0.1073]).rotated(Z, -0.3814).rotated(Y, 0.4505).rotated(X, 0.4564), child: left_shoulder_yaw_link, axis: [0.9963, -0.3065, 0.4137] }
        force left_shoulder_yaw_damper: Damper { joint: left_shoulder_yaw, damping: 0.405 }
        body left_elbow_link { mass: 1.004, com: [0.0301, 0.0086, 0.0139], inertia: inertia(0.0037339, 0.004206, 0.0035108, -0.0001086, 0.0001347, 0.0002397) }
        joint left_elbow: Revolute { parent: left_shoulder_yaw_link.at([0.0245, 0.0256, -0.1545]).rotated(Z, -0.2465).rotated(Y, -0.3534).rotated(X, -0.0268), child: left_elbow_link, axis: [-0.2029, -0.0032, -0.3536] }
        force left_elbow_damper: Damper { joint: left_elbow, damping: 0.371 }
        body left_forearm_link { mass: 0.925, com: [-0.0332, 0.0151, -0.0018], inertia: inertia(0.0041735, 0.003731, 0.0036854, 4.41e-05, -0.0002392, 8e-05) }
        joint left_forearm: Revolute { parent: left_elbow_link.at([-0.0291, -0.1303, -0.1177]).rotated(Z, -0.1308).rotated(Y, -0.2447).rotated(X, -0.5954), child: left_forearm_link, axis: [0.0661, 0.7123, -0.8755] }
        force left_forearm_damper: Damper { joint: left_forearm, damping: 0.113 }
        body left_wrist_pitch_link { mass: 0.866, com: [-0.0017, -0.0034, -0.0347], inertia: inertia(0.0031632, 0.0030922, 0.0029929, -4.28e-05, -0.0002353, -0.0001908) }
        joint left_wrist_pitch: Revolute { parent: left_forearm_link.at([-0.0845, -0.0718, -0.0183]).rotated(Z, -0.2346).rotated(Y, 0.1993).rotated(X, -0.1654), child: left_wrist_pitch_link, axis: [-0.1712, -0.7473, 0.9268] }
        force left_wrist_pitch_damper: Damper { joint: left_wrist_pitch, damping: 0.429 }
        body left_wrist_roll_link { mass: 0.922, com: [0.0208, 0.0103, 0.026], inertia: inertia(0.0040816, 0.0039431, 0.0039227, -2.81e-05, -5.96e-05, 3.71e-05) }
        joint left_wrist_roll: Revolute { parent: left_wrist_pitch_link.at([0.0524, -0.0334, 0.1697]).rotated(Z, 0.3275).rotated(Y, -0.125).rotated(X, -0.0155), child: left_wrist_roll_link, axis: [-0.002, -0.1706, -0.2918] }
        force left_wrist_roll_damper: Damper { joint: left_wrist_roll, damping: 0.381 }
        let left_palm = left_wrist_roll_link.at([0.01, 0.02, 0.09]).rotated(Z, -0.2).rotated(X, 0.3);
        body right_hip_yaw_link { mass: 2.256, com: [0.0262, -0.0185, -0.038], inertia: inertia(0.0147022, 0.016296, 0.0179116, 0.0009739, -0.0013673, 0.0011388) }
        joint right_hip_yaw: Revolute { parent: pelvis.at([0.0257, -0.2135, -0.0328]).rotated(Z, -0.1163).rotated(Y, 0.5325).rotated(X, -0.3803), child: right_hip_yaw_link, axis: [-0.7546, -0.888, -0.2975] }
        force right_hip_yaw_damper: Damper { joint: right_hip_yaw, damping: 0.126 }
        body right_hip_roll_link { mass: 2.692, com: [0.0029, 0.0163, -0.0068], inertia: inertia(0.0194292, 0.019997, 0.0200202, -0.0013944, -0.0012039, -0.0013952) }
        joint right_hip_roll: Revolute { parent: right_hip_yaw_link.at([0.118, 0.1147, -0.2117]).rotated(Z, 0.2781).rotated(Y, 0.5277).rotated(X, -0.341), child: right_hip_roll_link, axis: [-0.9803, -0.1254, 0.8326] }
        force right_hip_roll_damper: Damper { joint: right_hip_roll, damping: 0.374 }
        body right_hip_pitch_link { mass: 2.422, com: [0.0329, 0.0159, 0.0458], inertia: inertia(0.0201074, 0.0156411, 0.0181946, 0.0007112, 0.0010408, 0.0008504) }
        joint right_hip_pitch: Revolute { parent: right_hip_roll_link.at([0.1437, -0.1376, -0.0281]).rotated(Z, 0.5867).rotated(Y, 0.5168).rotated(X, -0.3288), child: right_hip_pitch_link, axis: [-0.2381, -0.2898, -0.4713] }
        force right_hip_pitch_damper: Damper { joint: right_hip_pitch, damping: 0.102 }
        body right_knee_link { mass: 1.983, com: [-0.0405, 0.045, 0.0202], inertia: inertia(0.0137598, 0.0171796, 0.0126889, 0.0010062, -0.0010836, -0.0004738) }
        joint right_knee: Revolute { parent: right_hip_pitch_link.at([-0.2374, -0.0296, 0.0853]).rotated(Z, -0.5638).rotated(Y, 0.1378).rotated(X, 0.4285), child: right_knee_link, axis: [-0.0442, 0.8636, 0.3036] }
        force right_knee_damper: Damper { joint: right_knee, damping: 0.107 }
        body right_ankle_pitch_link { mass: 3.474, com: [-0.0495, 0.0457, 0.0153], inertia: inertia(0.0242077, 0.0277122, 0.0281592, 0.0014284, 0.0019323, 0.0006407) }
        joint right_ankle_pitch: Revolute { parent: right_knee_link.at([0.1994, -0.1481, -0.1763]).rotated(Z, 0.3576).rotated(Y, 0.3444).rotated(X, 0.1369), child: right_ankle_pitch_link, axis: [-0.2681, 0.8625, 0.2467] }
        force right_ankle_pitch_damper: Damper { joint: right_ankle_pitch, damping: 0.102 }
        body right_ankle_roll_link { mass: 3.31, com: [0.0076, -0.0047, 0.0252], inertia: inertia(0.0218419, 0.02402, 0.0232701, 0.0018215, 0.0019256, -3.37e-05) }
        joint right_ankle_roll: Revolute { parent: right_ankle_pitch_link.at([0.1035, -0.0604, -0.1022]).rotated(Z, 0.5063).rotated(Y, -0.2016).rotated(X, 0.1242), child: right_ankle_roll_link, axis: [0.4314, 0.6648, 0.6758] }
        force right_ankle_roll_damper: Damper { joint: right_ankle_roll, damping: 0.438 }
        let right_sole = right_ankle_roll_link.at([0.03, -0.01, -0.05]);
        body right_shoulder_pitch_link { mass: 0.844, com: [-0.0094, -0.013, -0.0288], inertia: inertia(0.003453, 0.0034227, 0.0036511, -0.0001243, 0.0002084, 6.7e-06) }
        joint right_shoulder_pitch: Revolute { parent: waist_pitch_link.at([0.1302, 0.1707, 0.1087]).rotated(Z, 0.1573).rotated(Y, -0.3769).rotated(X, 0.359), child: right_shoulder_pitch_link, axis: [0.3333, 0.9803, 0.3513] }
        force right_shoulder_pitch_damper: Damper { joint: right_shoulder_pitch, damping: 0.331 }
        body right_shoulder_roll_link { mass: 1.424, com: [-0.0109, 0.0333, -0.0299], inertia: inertia(0.0046169, 0.0054486, 0.0058841, -0.0002523, 0.0004086, -0.0004426) }
        joint right_shoulder_roll: Revolute { parent: right_shoulder_pitch_link.at([0.1644, 0.0453, -0.0103]).rotated(Z, -0.5732).rotated(Y, 0.159).rotated(X, 0.1297), child: right_shoulder_roll_link, axis: [-0.0078, 0.7172, 0.0984] }
        force right_shoulder_roll_damper: Damper { joint: right_shoulder_roll, damping: 0.117 }
        body right_shoulder_yaw_link { mass: 0.954, com: [0.0022, 0.0028, -0.0165], inertia: inertia(0.004019, 0.00361, 0.003129, -8.72e-05, -3.07e-05, -0.0001353) }
        joint right_shoulder_yaw: Revolute { parent: right_shoulder_roll_link.at([-0.1098, -0.0833, -0.1381]).rotated(Z, 0.4354).rotated(Y, 0.3011).rotated(X, 0.5039), child: right_shoulder_yaw_link, axis: [-0.1182, 0.6185, 0.8078] }
        force right_shoulder_yaw_damper: Damper { joint: right_shoulder_yaw, damping: 0.334 }
        body right_elbow_link { mass: 0.901, com: [0.0049, -0.0269, -0.0232], inertia: inertia(0.0030267, 0.003153, 0.0039273, -0.0001767, 0.000263, -0.0002754) }
        joint right_elbow: Revolute { parent: right_shoulder_yaw_link.at([0.0352, -0.1009, 0.1781]).rotated(Z, -0.2383).rotated(Y, 0.1704).rotated(X, -0.4885), child: right_elbow_link, axis: [-0.2237, 0.6319, 0.2564] }
        force right_elbow_damper: Damper { joint: right_elbow, damping: 0.397 }
        body right_forearm_link { mass: 1.196, com: [-0.0034, 0.0191, 0.0208], inertia: inertia(0.0039314, 0.0040901, 0.0044056, -0.0001863, -0.0003135, -0.0002368) }
        joint right_forearm: Revolute { parent: right_elbow_link.at([-0.1123, -0.1459, 0.0945]).rotated(Z, 0.382).rotated(Y, -0.3654).rotated(X, 0.5299), child: right_forearm_link, axis: [0.7688, 0.3816, -0.7234] }
        force right_forearm_damper: Damper { joint: right_forearm, damping: 0.442 }
        body right_wrist_pitch_link { mass: 1.398, com: [-0.0073, -0.0346, 0.0016], inertia: inertia(0.0057645, 0.0052839, 0.0059364, 0.0001828, -0.0003682, 0.0001562) }
        joint right_wrist_pitch: Revolute { parent: right_forearm_link.at([0.1523, -0.0697, 0.095]).rotated(Z, 0.4937).rotated(Y, 0.257).rotated(X, -0.0394), child: right_wrist_pitch_link, axis: [-0.7795, 0.9597, 0.3792] }
        force right_wrist_pitch_damper: Damper { joint: right_wrist_pitch, damping: 0.069 }
        body right_wrist_roll_link { mass: 1.211, com: [0.025, 0.0057, 0.0207], inertia: inertia(0.0048999, 0.0041866, 0.0052885, 0.0001792, 0.0002004, -0.0002737) }
        joint right_wrist_roll: Revolute { parent: right_wrist_pitch_link.at([-0.0569, 0.0527, 0.0743]).rotated(Z, -0.5204).rotated(Y, -0.1928).rotated(X, 0.5161), child: right_wrist_roll_link, axis: [-0.2503, -0.5434, 0.6654] }
        force right_wrist_roll_damper: Damper { joint: right_wrist_roll, damping: 0.347 }
        let right_palm = right_wrist_roll_link.at([0.01, 0.02, 0.09]).rotated(Z, -0.2).rotated(X, 0.3);
        {functions}
    }
}

multibody! {
    pub mod biped {
        world { gravity: -9.81 * Z }
        body pelvis { mass: 5.713, com: [-0.0176, -0.0349, 0.0151], inertia: inertia(0.0367408, 0.04336, 0.0409292, -0.0031564, 5.31e-05, -0.0033029) }
        joint floating: Free { parent: ground, child: pelvis }
        body left_yaw { mass: 0.913, com: [-0.0053, -0.0344, -0.0327], inertia: inertia(0.0042721, 0.0048599, 0.0038328, -0.0002021, 9.31e-05, 0.000327) }
        joint left_hip_yaw: Revolute { parent: pelvis.at([0.0131, 0.0952, -0.0512]).rotated(Z, 0.381).rotated(Y, -0.0827).rotated(X, 0.0617), child: left_yaw, axis: [-0.9068, 0.7169, -0.4208] }
        force left_hip_yaw_damper: Damper { joint: left_hip_yaw, damping: 0.115 }
        body left_roll { mass: 1.127, com: [-0.0255, 0.0065, 0.0111], inertia: inertia(0.0051795, 0.0054957, 0.0046212, -0.0003971, -0.0002651, 0.0001626) }
        joint left_hip_roll: Revolute { parent: left_yaw.at([-0.0764, -0.0383, 0.0632]).rotated(Z, 0.0684).rotated(Y, -0.1487).rotated(X, -0.0579), child: left_roll, axis: [-0.0936, -0.4005, 0.5888] }
        force left_hip_roll_damper: Damper { joint: left_hip_roll, damping: 0.365 }
        body left_thigh { mass: 2.461, com: [0.03, 0.0184, -0.017], inertia: inertia(0.0137035, 0.0103089, 0.0114904, 0.0005063, -0.0006852, -2.17e-05) }
        joint left_hip_thigh: Revolute { parent: left_roll.at([-0.0512, 0.0149, 0.005]).rotated(Z, 0.2117).rotated(Y, 0.1346).rotated(X, -0.3686), child: left_thigh, axis: [0.1461, 0.751, -0.3725] }
        force left_hip_thigh_damper: Damper { joint: left_hip_thigh, damping: 0.363 }
        body left_shank { mass: 1.318, com: [0.034, 0.0445, -0.0026], inertia: inertia(0.0104259, 0.0084374, 0.0105489, 0.0002424, 0.0008124, 0.0005304) }
        body left_rotor { mass: 0.214, com: [-0.0043, -0.0023, 0.0034], inertia: inertia(5.4e-05, 6.34e-05, 5.71e-05, -4.1e-06, -4.7e-06, 2.9e-06) }
        joint left_knee: Revolute { parent: left_thigh.at([0.0123, 0.0071, -0.231]).rotated(Z, -0.052).rotated(Y, 0.117).rotated(X, 0.031), child: left_shank, axis: [1, 8, -2] }
        force left_knee_damper: Damper { joint: left_knee, damping: 0.108 }
        joint left_knee_rotor: Revolute { parent: left_thigh.at([0.013, -0.0497, -0.0178]).rotated(Z, -0.052).rotated(Y, 0.117).rotated(X, 0.031), child: left_rotor, axis: [1, 8, -2] }
        body left_crank { mass: 0.107, com: [-0.0061, -0.0026, 0.0089], inertia: inertia(3.98e-05, 4.54e-05, 4.7e-05, 3e-06, 2.5e-06, 2.8e-06) }
        body left_rod { mass: 0.093, com: [-0.0213, -0.0081, -0.0136], inertia: inertia(0.0007251, 0.0007409, 0.000568, -3.47e-05, -2.87e-05, -2.86e-05) }
        body left_foot { mass: 0.571, com: [-0.0007, 0.0043, -0.0114], inertia: inertia(0.0008236, 0.00096, 0.0009437, 1.09e-05, 7.45e-05, 3.13e-05) }
        joint left_crank_drive: Revolute { parent: left_shank.at([0.0212, 0.03125, -0.0613]), child: left_crank, axis: Y }
        force left_crank_drive_damper: Damper { joint: left_crank_drive, damping: 0.282 }
        joint left_rod_pivot: Revolute { parent: left_crank.at([-0.0549, 0.015625, 0.0107]), child: left_rod, axis: Y }
        joint left_ankle: Revolute { parent: left_shank.at([0.0, 0.0, -0.2891]), child: left_foot, axis: Y }
        force left_ankle_damper: Damper { joint: left_ankle, damping: 0.328 }
        let left_sole = left_foot.at([0.0271, 0.0, -0.0413]);
        body right_yaw { mass: 0.913, com: [0.0141, -0.0357, 0.032], inertia: inertia(0.0047914, 0.0049295, 0.0048175, -7.86e-05, -7.38e-05, -0.0002896) }
        joint right_hip_yaw: Revolute { parent: pelvis.at([0.0131, -0.0952, -0.0512]).rotated(Z, -0.3461).rotated(Y, -0.3502).rotated(X, 0.1074), child: right_yaw, axis: [-0.5825, -0.6754, -0.3199] }
        force right_hip_yaw_damper: Damper { joint: right_hip_yaw, damping: 0.074 }
        body right_roll { mass: 1.127, com: [-0.0109, -0.038, 0.0299], inertia: inertia(0.0056153, 0.0047759, 0.0049629, -0.0001376, -0.0001225, -0.00034) }
        joint right_hip_roll: Revolute { parent: right_yaw.at([-0.1, -0.0697, -0.0797]).rotated(Z, -0.0272).rotated(Y, 0.3945).rotated(X, 0.2791), child: right_roll, axis: [-0.0323, -0.8282, -0.7956] }
        force right_hip_roll_damper: Damper { joint: right_hip_roll, damping: 0.204 }
        body right_thigh { mass: 2.461, com: [-0.0382, 0.0361, 0.0023], inertia: inertia(0.0104213, 0.0119828, 0.0099505, 5.53e-05, 0.0009421, 0.0007153) }
        joint right_hip_thigh: Revolute { parent: right_roll.at([-0.047, 0.0658, -0.0677]).rotated(Z, -0.1066).rotated(Y, -0.1911).rotated(X, 0.157), child: right_thigh, axis: [-0.6659, 0.5439, 0.0652] }
        force right_hip_thigh_damper: Damper { joint: right_hip_thigh, damping: 0.401 }
        body right_shank { mass: 1.318, com: [0.0485, 0.0353, 0.0306], inertia: inertia(0.0109339, 0.0106754, 0.0089846, 2.91e-05, -0.000238, -0.000776) }
        body right_rotor { mass: 0.214, com: [-0.0094, -0.0044, -0.0048], inertia: inertia(6.83e-05, 7.4e-05, 6.31e-05, 4.7e-06, 5.2e-06, 4.9e-06) }
        joint right_knee: Revolute { parent: right_thigh.at([0.0123, -0.0071, -0.231]).rotated(Z, 0.052).rotated(Y, 0.117).rotated(X, -0.031), child: right_shank, axis: [1, 8, -2] }
        force right_knee_damper: Damper { joint: right_knee, damping: 0.214 }
        joint right_knee_rotor: Revolute { parent: right_thigh.at([0.013, -0.0497, -0.0178]).rotated(Z, 0.052).rotated(Y, 0.117).rotated(X, -0.031), child: right_rotor, axis: [1, 8, -2] }
        body right_crank { mass: 0.107, com: [-0.0067, -0.0066, -0.0073], inertia: inertia(4.17e-05, 4.81e-05, 5.24e-05, 2.6e-06, -2e-07, 1.2e-06) }
        body right_rod { mass: 0.093, com: [0.0288, -0.0399, 0.0154], inertia: inertia(0.0007306, 0.0007033, 0.0006964, -2.4e-06, -3.44e-05, 3.1e-05) }
        body right_foot { mass: 0.571, com: [-0.008, 0.0144, 0.0226], inertia: inertia(0.0009524, 0.0009543, 0.0011336, 3.7e-05, -5.43e-05, -6.13e-05) }
        joint right_crank_drive: Revolute { parent: right_shank.at([0.0212, 0.03125, -0.0613]), child: right_crank, axis: Y }
        force right_crank_drive_damper: Damper { joint: right_crank_drive, damping: 0.118 }
        joint right_rod_pivot: Revolute { parent: right_crank.at([-0.0549, 0.015625, 0.0107]), child: right_rod, axis: Y }
        joint right_ankle: Revolute { parent: right_shank.at([0.0, 0.0, -0.2891]), child: right_foot, axis: Y }
        force right_ankle_damper: Damper { joint: right_ankle, damping: 0.457 }
        let right_sole = right_foot.at([0.0271, 0.0, -0.0413]);
        constraint left_gear = (-6.25) * left_knee.angle - left_knee_rotor.angle;
        #[cut] joint left_pin: Revolute { parent: left_rod.at([0.0, 0.0, -0.2357]), child: left_foot.at([-0.0317, 0.046875, 0.0]), axis: Y }
        constraint right_gear = (-6.25) * right_knee.angle - right_knee_rotor.angle;
        #[cut] joint right_pin: Revolute { parent: right_rod.at([0.0, 0.0, -0.2357]), child: right_foot.at([-0.0317, 0.046875, 0.0]), axis: Y }
        {functions}
    }
}

multibody! {
    pub mod rail_arm {
        world { gravity: -9.81 * Z }
        body carriage { mass: 12.41, com: [-0.0328, 0.0555, -0.0448], inertia: inertia(0.1431784, 0.1154957, 0.1227447, 0.0111495, -0.0064915, 0.0031691) }
        joint rail: Prismatic { parent: ground.at([0.1, -0.2, 0.35]).rotated(Z, 0.4).rotated(Y, -0.03).rotated(X, 0.02), child: carriage, axis: [1, 0.1, 0] }
        force rail_damper: Damper { joint: rail, damping: 0.257 }
        body link1 { mass: 3.5, com: [-0.0047, -0.0005, -0.0308], inertia: inertia(0.0291421, 0.0226587, 0.0239241, -0.0021, -0.0010204, -0.000404) }
        joint joint1: Revolute { parent: carriage.at([0.1608, -0.0484, -0.1545]).rotated(Z, -0.6991).rotated(Y, 0.7866).rotated(X, -0.3866), child: link1, axis: [0.2403, -0.2456, 0.3217] }
        force joint1_damper: Damper { joint: joint1, damping: 0.202 }
        body link2 { mass: 3.1, com: [0.0191, -0.0002, 0.015], inertia: inertia(0.0263607, 0.0238819, 0.0204766, -0.0016881, 0.0017284, -4.39e-05) }
        joint joint2: Revolute { parent: link1.at([-0.1225, 0.1784, 0.0316]).rotated(Z, -0.343).rotated(Y, 0.6095).rotated(X, 0.3663), child: link2, axis: [-0.2866, 0.7562, -0.73] }
        force joint2_damper: Damper { joint: joint2, damping: 0.394 }
        body link3 { mass: 2.7, com: [-0.0402, 0.019, 0.0202], inertia: inertia(0.0232875, 0.0225686, 0.0202744, -0.0010204, -0.0011807, 9.69e-05) }
        joint joint3: Revolute { parent: link2.at([0.0039, -0.1714, 0.1613]).rotated(Z, -0.4481).rotated(Y, 0.3221).rotated(X, 0.0119), child: link3, axis: [-0.5122, -0.9762, -0.3135] }
        force joint3_damper: Damper { joint: joint3, damping: 0.17 }
        body link4 { mass: 2.3, com: [-0.0077, -0.0123, 0.0334], inertia: inertia(0.0195009, 0.0153827, 0.0166535, -0.0009597, 0.0004691, 0.0013652) }
        joint joint4: Revolute { parent: link3.at([-0.1193, 0.1066, -0.08]).rotated(Z, -0.2531).rotated(Y, 0.4229).rotated(X, -0.7789), child: link4, axis: [-0.6597, -0.1288, -0.5366] }
        force joint4_damper: Damper { joint: joint4, damping: 0.235 }
        body link5 { mass: 1.9, com: [-0.0054, -0.0082, 0.0089], inertia: inertia(0.0132465, 0.0123268, 0.01228, -0.0009345, 4.97e-05, -0.0003321) }
        joint joint5: Revolute { parent: link4.at([0.1231, 0.002, 0.0833]).rotated(Z, -0.7729).rotated(Y, -0.6992).rotated(X, 0.7681), child: link5, axis: [-0.7192, -0.2273, 0.1473] }
        force joint5_damper: Damper { joint: joint5, damping: 0.385 }
        body link6 { mass: 1.5, com: [-0.0149, 0.0465, -0.0497], inertia: inertia(0.0125088, 0.0101628, 0.0126569, -0.0008754, 0.0008722, 0.0004863) }
        joint joint6: Revolute { parent: link5.at([0.1962, 0.032, -0.1289]).rotated(Z, -0.6666).rotated(Y, -0.0936).rotated(X, 0.7518), child: link6, axis: [0.2108, -0.0056, -0.0536] }
        force joint6_damper: Damper { joint: joint6, damping: 0.12 }
        body link7 { mass: 1.1, com: [-0.0378, 0.0081, -0.0047], inertia: inertia(0.0072227, 0.0080836, 0.0088702, 0.0002963, -3.95e-05, -0.0001461) }
        joint joint7: Revolute { parent: link6.at([-0.0557, -0.1098, -0.121]).rotated(Z, 0.3602).rotated(Y, -0.6269).rotated(X, -0.086), child: link7, axis: [0.4166, 0.223, -0.9548] }
        force joint7_damper: Damper { joint: joint7, damping: 0.214 }
        body thumb { mass: 0.083, com: [-0.0014, -0.0081, 0.0094], inertia: inertia(2.7e-05, 2.49e-05, 2.66e-05, -1.2e-06, -1.1e-06, 1e-07) }
        joint thumb_slide: Prismatic { parent: link7.at([0.01, 0.02, 0.11]).rotated(Z, 0.3).rotated(Y, -0.2).rotated(X, 0.1), child: thumb, axis: [0, 1, 0.05] }
        body finger { mass: 0.083, com: [0.0049, 0.0029, -0.0099], inertia: inertia(2.58e-05, 2.83e-05, 2.69e-05, 1.8e-06, 2e-06, -1.1e-06) }
        joint finger_slide: Prismatic { parent: link7.at([0.01, -0.02, 0.11]).rotated(Z, 0.3).rotated(Y, -0.2).rotated(X, 0.1), child: finger, axis: [0, 1, 0.05] }
        constraint finger_slide_mimic = finger_slide.travel - (-0.8) * thumb_slide.travel - (0.0125);
        {functions}
    }
}
