//! Arms whose motors are solved for: an input for each joint, gears, belts and differentials. The links are those of `puma560`.

use multibody::multibody;

multibody! {
    /// A motor on each joint.
    pub mod puma560_direct {
        world { gravity: [0.0, 0.0, -9.81] }
        #[allow(unphysical_inertia)]
        body link1 { mass: 0.0, com: [0.0, 0.0, 0.0], inertia: inertia(0.0, 0.0, 0.35, 0.0, 0.0, 0.0) }
        joint joint1: Revolute { parent: ground, child: link1, axis: Z }
        body link2 { mass: 17.4, com: [0.068, 0.006, 0.2275], inertia: inertia(0.13, 0.524, 0.539, 0.0, 0.0, 0.0) }
        joint joint2: Revolute { parent: link1.at([0.0, 0.0, 0.6718299999999999]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link2, axis: Z }
        #[allow(unphysical_inertia)]
        body link3 { mass: 4.8, com: [0.0, 0.07, 0.16415], inertia: inertia(0.066, 0.012499999999999997, 0.086, 0.0, 0.0, 0.0) }
        joint joint3: Revolute { parent: link2.at([0.4318, 0.0, 0.0]), child: link3, axis: Z }
        body link4 { mass: 0.82, com: [0.0, 0.0, 0.4507999999999999], inertia: inertia(0.0018, 0.0018, 0.0013, 0.0, 0.0, 0.0) }
        joint joint4: Revolute { parent: link3.at([0.0203, 0.0, 0.15005]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: 0.34, com: [0.0, 0.0, 0.0], inertia: inertia(0.0003, 0.0003, 0.0004, 0.0, 0.0, 0.0) }
        joint joint5: Revolute { parent: link4.at([0.0, 0.0, 0.4318]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: 0.09, com: [0.0, 0.0, 0.03199999999999997], inertia: inertia(0.00015, 0.00015, 4e-05, 0.0, 0.0, 0.0) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link6, axis: Z }
        input tau: [Scalar; 6];
        force motor1: Effort { joint: joint1, value: tau[0] }
        force motor2: Effort { joint: joint2, value: tau[1] }
        force motor3: Effort { joint: joint3, value: tau[2] }
        force motor4: Effort { joint: joint4, value: tau[3] }
        force motor5: Effort { joint: joint5, value: tau[4] }
        force motor6: Effort { joint: joint6, value: tau[5] }
        emit inverse_dynamics { solve_for: tau };
    }
    /// Gears on the first two joints, a belt from the second to the third, a direct drive, a differential in the wrist.
    pub mod puma560_geared {
        param gears = [62.5, 107.8];
        param belt = [53.7, -12.5];
        param wrist = [71.9, 76.7];
        world { gravity: [0.0, 0.0, -9.81] }
        #[allow(unphysical_inertia)]
        body link1 { mass: 0.0, com: [0.0, 0.0, 0.0], inertia: inertia(0.0, 0.0, 0.35, 0.0, 0.0, 0.0) }
        joint joint1: Revolute { parent: ground, child: link1, axis: Z }
        body link2 { mass: 17.4, com: [0.068, 0.006, 0.2275], inertia: inertia(0.13, 0.524, 0.539, 0.0, 0.0, 0.0) }
        joint joint2: Revolute { parent: link1.at([0.0, 0.0, 0.6718299999999999]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link2, axis: Z }
        #[allow(unphysical_inertia)]
        body link3 { mass: 4.8, com: [0.0, 0.07, 0.16415], inertia: inertia(0.066, 0.012499999999999997, 0.086, 0.0, 0.0, 0.0) }
        joint joint3: Revolute { parent: link2.at([0.4318, 0.0, 0.0]), child: link3, axis: Z }
        body link4 { mass: 0.82, com: [0.0, 0.0, 0.4507999999999999], inertia: inertia(0.0018, 0.0018, 0.0013, 0.0, 0.0, 0.0) }
        joint joint4: Revolute { parent: link3.at([0.0203, 0.0, 0.15005]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: 0.34, com: [0.0, 0.0, 0.0], inertia: inertia(0.0003, 0.0003, 0.0004, 0.0, 0.0, 0.0) }
        joint joint5: Revolute { parent: link4.at([0.0, 0.0, 0.4318]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: 0.09, com: [0.0, 0.0, 0.03199999999999997], inertia: inertia(0.00015, 0.00015, 4e-05, 0.0, 0.0, 0.0) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link6, axis: Z }
        input tau: [Scalar; 6];
        force motor1: Effort { joint: joint1, value: gears[0] * tau[0] }
        force motor2: Effort { joint: joint2, value: gears[1] * tau[1] + belt[1] * tau[2] }
        force motor3: Effort { joint: joint3, value: belt[0] * tau[2] }
        force motor4: Effort { joint: joint4, value: -tau[3] }
        force motor5: Effort { joint: joint5, value: wrist[0] * (tau[4] + tau[5]) }
        force motor6: Effort { joint: joint6, value: wrist[1] * (tau[4] - tau[5]) }
        emit forward_dynamics, inverse_dynamics { solve_for: tau };
    }
}
