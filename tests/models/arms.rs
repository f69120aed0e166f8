//! Serial arms as macro calls, written by `scripts/arms.py` from `data/robots`.

use multibody::multibody;

multibody! {
    /// The arm `double_pendulum`, every number a literal.
    pub mod double_pendulum {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 0.26703, com: [0.008610699999999995, 2.1726999999999987e-06, 0.03601199999999998], inertia: inertia(0.0004082700000000001, 0.00038791, 3.6421e-05, 1.2675e-09, 1.8738e-05, 3.5443e-08) }
        joint joint1: Revolute { parent: ground.at([0.0060872, 0.0, 0.035]), child: link1, axis: X }
        body link2 { mass: 0.33238, com: [-0.0050107, 1.9371e-10, 0.10088], inertia: inertia(0.0011753, 0.0011666, 1.4553e-05, 0.0, -2.9304e-08, 0.0) }
        joint joint2: Revolute { parent: link1.at([0.023, 0.0, 0.1]), child: link2, axis: X }
        /// tool frame
        output pose = link2.pose;
        /// columns are the tool's axes
        output rotation = link2.rotation;
        /// of the tool
        output jacobian = link2.jacobian;
        /// of the tool
        output twist = link2.twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `double_pendulum`, every number a literal.
    pub mod double_pendulum_driven {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 0.26703, com: [0.008610699999999995, 2.1726999999999987e-06, 0.03601199999999998], inertia: inertia(0.0004082700000000001, 0.00038791, 3.6421e-05, 1.2675e-09, 1.8738e-05, 3.5443e-08) }
        joint joint1: Revolute { parent: ground.at([0.0060872, 0.0, 0.035]), child: link1, axis: X }
        body link2 { mass: 0.33238, com: [-0.0050107, 1.9371e-10, 0.10088], inertia: inertia(0.0011753, 0.0011666, 1.4553e-05, 0.0, -2.9304e-08, 0.0) }
        joint joint2: Revolute { parent: link1.at([0.023, 0.0, 0.1]), child: link2, axis: X }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `double_pendulum`, every number a param.
    pub mod double_pendulum_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 0.26703;
        /// [m] centre of mass
        param c1 = [0.008610699999999995, 2.1726999999999987e-06, 0.03601199999999998];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.0004082700000000001, 0.00038791, 3.6421e-05, 1.2675e-09, 1.8738e-05, 3.5443e-08];
        /// [m] origin of `joint1`'s frame
        param joint1_at = [0.0060872, 0.0, 0.035];
        /// [kg] mass
        param m2 = 0.33238;
        /// [m] centre of mass
        param c2 = [-0.0050107, 1.9371e-10, 0.10088];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.0011753, 0.0011666, 1.4553e-05, 0.0, -2.9304e-08, 0.0];
        /// [m] origin of `joint2`'s frame
        param joint2_at = [0.023, 0.0, 0.1];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground.at(joint1_at), child: link1, axis: X }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.at(joint2_at), child: link2, axis: X }
        /// tool frame
        output pose = link2.pose;
        /// columns are the tool's axes
        output rotation = link2.rotation;
        /// of the tool
        output jacobian = link2.jacobian;
        /// of the tool
        output twist = link2.twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `double_pendulum`, every number a param.
    pub mod double_pendulum_driven_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 0.26703;
        /// [m] centre of mass
        param c1 = [0.008610699999999995, 2.1726999999999987e-06, 0.03601199999999998];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.0004082700000000001, 0.00038791, 3.6421e-05, 1.2675e-09, 1.8738e-05, 3.5443e-08];
        /// [m] origin of `joint1`'s frame
        param joint1_at = [0.0060872, 0.0, 0.035];
        /// [kg] mass
        param m2 = 0.33238;
        /// [m] centre of mass
        param c2 = [-0.0050107, 1.9371e-10, 0.10088];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.0011753, 0.0011666, 1.4553e-05, 0.0, -2.9304e-08, 0.0];
        /// [m] origin of `joint2`'s frame
        param joint2_at = [0.023, 0.0, 0.1];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground.at(joint1_at), child: link1, axis: X }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.at(joint2_at), child: link2, axis: X }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `cart5`, every number a literal.
    pub mod cart5 {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 5.0, com: [0.0, 0.0, 0.0], inertia: inertia(0.1, 0.1, 0.1, 0.0, 0.0, 0.0) }
        joint joint1: Prismatic { parent: ground, child: link1, axis: X }
        body link2 { mass: 1.0, com: [0.0, 0.0, -0.25], inertia: inertia(0.020833333333333332, 0.020833333333333332, 0.001, 0.0, 0.0, 0.0) }
        joint joint2: Revolute { parent: link1, child: link2, axis: Y }
        body link3 { mass: 1.2, com: [0.0, 0.0, -0.3], inertia: inertia(0.036, 0.036, 0.001, 0.0, 0.0, 0.0) }
        joint joint3: Revolute { parent: link2.at([0.0, 0.0, -0.5]), child: link3, axis: Y }
        body link4 { mass: 1.4, com: [0.0, 0.0, -0.35], inertia: inertia(0.05716666666666665, 0.05716666666666665, 0.001, 0.0, 0.0, 0.0) }
        joint joint4: Revolute { parent: link3.at([0.0, 0.0, -0.6]), child: link4, axis: Y }
        body link5 { mass: 1.6, com: [0.0, 0.0, -0.4], inertia: inertia(0.08533333333333336, 0.08533333333333336, 0.001, 0.0, 0.0, 0.0) }
        joint joint5: Revolute { parent: link4.at([0.0, 0.0, -0.7]), child: link5, axis: Y }
        body link6 { mass: 1.8, com: [0.0, 0.0, -0.45], inertia: inertia(0.12150000000000001, 0.12150000000000001, 0.001, 0.0, 0.0, 0.0) }
        joint joint6: Revolute { parent: link5.at([0.0, 0.0, -0.8]), child: link6, axis: Y }
        /// tool frame
        output pose = link6.at([0.0, 0.0, -0.9]).pose;
        /// columns are the tool's axes
        output rotation = link6.at([0.0, 0.0, -0.9]).rotation;
        /// of the tool
        output jacobian = link6.at([0.0, 0.0, -0.9]).jacobian;
        /// of the tool
        output twist = link6.at([0.0, 0.0, -0.9]).twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `cart5`, every number a literal.
    pub mod cart5_driven {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 5.0, com: [0.0, 0.0, 0.0], inertia: inertia(0.1, 0.1, 0.1, 0.0, 0.0, 0.0) }
        joint joint1: Prismatic { parent: ground, child: link1, axis: X }
        body link2 { mass: 1.0, com: [0.0, 0.0, -0.25], inertia: inertia(0.020833333333333332, 0.020833333333333332, 0.001, 0.0, 0.0, 0.0) }
        joint joint2: Revolute { parent: link1, child: link2, axis: Y }
        body link3 { mass: 1.2, com: [0.0, 0.0, -0.3], inertia: inertia(0.036, 0.036, 0.001, 0.0, 0.0, 0.0) }
        joint joint3: Revolute { parent: link2.at([0.0, 0.0, -0.5]), child: link3, axis: Y }
        body link4 { mass: 1.4, com: [0.0, 0.0, -0.35], inertia: inertia(0.05716666666666665, 0.05716666666666665, 0.001, 0.0, 0.0, 0.0) }
        joint joint4: Revolute { parent: link3.at([0.0, 0.0, -0.6]), child: link4, axis: Y }
        body link5 { mass: 1.6, com: [0.0, 0.0, -0.4], inertia: inertia(0.08533333333333336, 0.08533333333333336, 0.001, 0.0, 0.0, 0.0) }
        joint joint5: Revolute { parent: link4.at([0.0, 0.0, -0.7]), child: link5, axis: Y }
        body link6 { mass: 1.8, com: [0.0, 0.0, -0.45], inertia: inertia(0.12150000000000001, 0.12150000000000001, 0.001, 0.0, 0.0, 0.0) }
        joint joint6: Revolute { parent: link5.at([0.0, 0.0, -0.8]), child: link6, axis: Y }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `cart5`, every number a param.
    pub mod cart5_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 5.0;
        /// [m] centre of mass
        param c1 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m2 = 1.0;
        /// [m] centre of mass
        param c2 = [0.0, 0.0, -0.25];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.020833333333333332, 0.020833333333333332, 0.001, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m3 = 1.2;
        /// [m] centre of mass
        param c3 = [0.0, 0.0, -0.3];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.036, 0.036, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.0, 0.0, -0.5];
        /// [kg] mass
        param m4 = 1.4;
        /// [m] centre of mass
        param c4 = [0.0, 0.0, -0.35];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.05716666666666665, 0.05716666666666665, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0, 0.0, -0.6];
        /// [kg] mass
        param m5 = 1.6;
        /// [m] centre of mass
        param c5 = [0.0, 0.0, -0.4];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.08533333333333336, 0.08533333333333336, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [0.0, 0.0, -0.7];
        /// [kg] mass
        param m6 = 1.8;
        /// [m] centre of mass
        param c6 = [0.0, 0.0, -0.45];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.12150000000000001, 0.12150000000000001, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint6`'s frame
        param joint6_at = [0.0, 0.0, -0.8];
        /// [m] origin of `tool`'s frame
        param tool_at = [0.0, 0.0, -0.9];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Prismatic { parent: ground, child: link1, axis: X }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1, child: link2, axis: Y }
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at), child: link3, axis: Y }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at), child: link4, axis: Y }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at), child: link5, axis: Y }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.at(joint6_at), child: link6, axis: Y }
        /// tool frame
        output pose = link6.at(tool_at).pose;
        /// columns are the tool's axes
        output rotation = link6.at(tool_at).rotation;
        /// of the tool
        output jacobian = link6.at(tool_at).jacobian;
        /// of the tool
        output twist = link6.at(tool_at).twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `cart5`, every number a param.
    pub mod cart5_driven_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 5.0;
        /// [m] centre of mass
        param c1 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m2 = 1.0;
        /// [m] centre of mass
        param c2 = [0.0, 0.0, -0.25];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.020833333333333332, 0.020833333333333332, 0.001, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m3 = 1.2;
        /// [m] centre of mass
        param c3 = [0.0, 0.0, -0.3];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.036, 0.036, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.0, 0.0, -0.5];
        /// [kg] mass
        param m4 = 1.4;
        /// [m] centre of mass
        param c4 = [0.0, 0.0, -0.35];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.05716666666666665, 0.05716666666666665, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0, 0.0, -0.6];
        /// [kg] mass
        param m5 = 1.6;
        /// [m] centre of mass
        param c5 = [0.0, 0.0, -0.4];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.08533333333333336, 0.08533333333333336, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [0.0, 0.0, -0.7];
        /// [kg] mass
        param m6 = 1.8;
        /// [m] centre of mass
        param c6 = [0.0, 0.0, -0.45];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.12150000000000001, 0.12150000000000001, 0.001, 0.0, 0.0, 0.0];
        /// [m] origin of `joint6`'s frame
        param joint6_at = [0.0, 0.0, -0.8];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Prismatic { parent: ground, child: link1, axis: X }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1, child: link2, axis: Y }
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at), child: link3, axis: Y }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at), child: link4, axis: Y }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at), child: link5, axis: Y }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.at(joint6_at), child: link6, axis: Y }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `puma560`, every number a literal.
    pub mod puma560 {
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
        /// tool frame
        output pose = link6.pose;
        /// columns are the tool's axes
        output rotation = link6.rotation;
        /// of the tool
        output jacobian = link6.jacobian;
        /// of the tool
        output twist = link6.twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `puma560`, every number a literal.
    pub mod puma560_driven {
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
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `puma560`, every number a param.
    pub mod puma560_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 0.0;
        /// [m] centre of mass
        param c1 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.0, 0.0, 0.35, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m2 = 17.4;
        /// [m] centre of mass
        param c2 = [0.068, 0.006, 0.2275];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.13, 0.524, 0.539, 0.0, 0.0, 0.0];
        /// [m] origin of `joint2`'s frame
        param joint2_at = [0.0, 0.0, 0.6718299999999999];
        /// [kg] mass
        param m3 = 4.8;
        /// [m] centre of mass
        param c3 = [0.0, 0.07, 0.16415];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.066, 0.012499999999999997, 0.086, 0.0, 0.0, 0.0];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.4318, 0.0, 0.0];
        /// [kg] mass
        param m4 = 0.82;
        /// [m] centre of mass
        param c4 = [0.0, 0.0, 0.4507999999999999];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.0018, 0.0018, 0.0013, 0.0, 0.0, 0.0];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0203, 0.0, 0.15005];
        /// [kg] mass
        param m5 = 0.34;
        /// [m] centre of mass
        param c5 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.0003, 0.0003, 0.0004, 0.0, 0.0, 0.0];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [0.0, 0.0, 0.4318];
        /// [kg] mass
        param m6 = 0.09;
        /// [m] centre of mass
        param c6 = [0.0, 0.0, 0.03199999999999997];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.00015, 0.00015, 4e-05, 0.0, 0.0, 0.0];
        world { gravity: gravity }
        #[allow(unphysical_inertia)]
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground, child: link1, axis: Z }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.at(joint2_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link2, axis: Z }
        #[allow(unphysical_inertia)]
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at), child: link3, axis: Z }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link6, axis: Z }
        /// tool frame
        output pose = link6.pose;
        /// columns are the tool's axes
        output rotation = link6.rotation;
        /// of the tool
        output jacobian = link6.jacobian;
        /// of the tool
        output twist = link6.twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `puma560`, every number a param.
    pub mod puma560_driven_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 0.0;
        /// [m] centre of mass
        param c1 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.0, 0.0, 0.35, 0.0, 0.0, 0.0];
        /// [kg] mass
        param m2 = 17.4;
        /// [m] centre of mass
        param c2 = [0.068, 0.006, 0.2275];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.13, 0.524, 0.539, 0.0, 0.0, 0.0];
        /// [m] origin of `joint2`'s frame
        param joint2_at = [0.0, 0.0, 0.6718299999999999];
        /// [kg] mass
        param m3 = 4.8;
        /// [m] centre of mass
        param c3 = [0.0, 0.07, 0.16415];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.066, 0.012499999999999997, 0.086, 0.0, 0.0, 0.0];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.4318, 0.0, 0.0];
        /// [kg] mass
        param m4 = 0.82;
        /// [m] centre of mass
        param c4 = [0.0, 0.0, 0.4507999999999999];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.0018, 0.0018, 0.0013, 0.0, 0.0, 0.0];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0203, 0.0, 0.15005];
        /// [kg] mass
        param m5 = 0.34;
        /// [m] centre of mass
        param c5 = [0.0, 0.0, 0.0];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.0003, 0.0003, 0.0004, 0.0, 0.0, 0.0];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [0.0, 0.0, 0.4318];
        /// [kg] mass
        param m6 = 0.09;
        /// [m] centre of mass
        param c6 = [0.0, 0.0, 0.03199999999999997];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.00015, 0.00015, 4e-05, 0.0, 0.0, 0.0];
        world { gravity: gravity }
        #[allow(unphysical_inertia)]
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground, child: link1, axis: Z }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.at(joint2_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link2, axis: Z }
        #[allow(unphysical_inertia)]
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at), child: link3, axis: Z }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link6, axis: Z }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `panda`, every number a literal.
    pub mod panda {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 4.970684, com: [0.003875, 0.002081, -0.04762], inertia: inertia(0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169) }
        joint joint1: Revolute { parent: ground.at([0.0, 0.0, 0.333]), child: link1, axis: Z }
        body link2 { mass: 0.646926, com: [-0.003141, -0.02872, 0.003495], inertia: inertia(0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704) }
        joint joint2: Revolute { parent: link1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link2, axis: Z }
        body link3 { mass: 3.228604, com: [0.027518, 0.039252, -0.066502], inertia: inertia(0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805) }
        joint joint3: Revolute { parent: link2.at([0.0, -0.316, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link3, axis: Z }
        body link4 { mass: 3.587895, com: [-0.053169999999999974, 0.10441899999999994, 0.027453999999999985], inertia: inertia(0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641) }
        joint joint4: Revolute { parent: link3.at([0.0825, 0.0, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: 1.225946, com: [-0.011953, 0.041065, -0.038437], inertia: inertia(0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229) }
        joint joint5: Revolute { parent: link4.at([-0.0825, 0.384, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: 1.666555, com: [0.060149, -0.014117, -0.010517], inertia: inertia(0.0019640000000000005, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link6, axis: Z }
        body link7 { mass: 1.4955219999999998, com: [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578], inertia: inertia(0.01652985371263463, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.0007066957106145017, -0.001051105327046708) }
        joint joint7: Revolute { parent: link6.at([0.088, 0.0, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link7, axis: Z }
        /// tool frame
        output pose = link7.at([0.0, 0.0, 0.2104]).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).pose;
        /// columns are the tool's axes
        output rotation = link7.at([0.0, 0.0, 0.2104]).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).rotation;
        /// of the tool
        output jacobian = link7.at([0.0, 0.0, 0.2104]).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).jacobian;
        /// of the tool
        output twist = link7.at([0.0, 0.0, 0.2104]).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `panda`, every number a literal.
    pub mod panda_driven {
        world { gravity: [0.0, 0.0, -9.81] }
        body link1 { mass: 4.970684, com: [0.003875, 0.002081, -0.04762], inertia: inertia(0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169) }
        joint joint1: Revolute { parent: ground.at([0.0, 0.0, 0.333]), child: link1, axis: Z }
        body link2 { mass: 0.646926, com: [-0.003141, -0.02872, 0.003495], inertia: inertia(0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704) }
        joint joint2: Revolute { parent: link1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link2, axis: Z }
        body link3 { mass: 3.228604, com: [0.027518, 0.039252, -0.066502], inertia: inertia(0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805) }
        joint joint3: Revolute { parent: link2.at([0.0, -0.316, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link3, axis: Z }
        body link4 { mass: 3.587895, com: [-0.053169999999999974, 0.10441899999999994, 0.027453999999999985], inertia: inertia(0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641) }
        joint joint4: Revolute { parent: link3.at([0.0825, 0.0, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: 1.225946, com: [-0.011953, 0.041065, -0.038437], inertia: inertia(0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229) }
        joint joint5: Revolute { parent: link4.at([-0.0825, 0.384, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: 1.666555, com: [0.060149, -0.014117, -0.010517], inertia: inertia(0.0019640000000000005, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link6, axis: Z }
        body link7 { mass: 1.4955219999999998, com: [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578], inertia: inertia(0.01652985371263463, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.0007066957106145017, -0.001051105327046708) }
        joint joint7: Revolute { parent: link6.at([0.088, 0.0, 0.0]).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link7, axis: Z }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        /// effort of `joint7`
        input tau7;
        force drive7: Effort { joint: joint7, value: tau7 }
        emit forward_dynamics, derivatives;
    }
}

multibody! {
    /// The arm `panda`, every number a param.
    pub mod panda_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 4.970684;
        /// [m] centre of mass
        param c1 = [0.003875, 0.002081, -0.04762];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169];
        /// [m] origin of `joint1`'s frame
        param joint1_at = [0.0, 0.0, 0.333];
        /// [kg] mass
        param m2 = 0.646926;
        /// [m] centre of mass
        param c2 = [-0.003141, -0.02872, 0.003495];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704];
        /// [kg] mass
        param m3 = 3.228604;
        /// [m] centre of mass
        param c3 = [0.027518, 0.039252, -0.066502];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.0, -0.316, 0.0];
        /// [kg] mass
        param m4 = 3.587895;
        /// [m] centre of mass
        param c4 = [-0.053169999999999974, 0.10441899999999994, 0.027453999999999985];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0825, 0.0, 0.0];
        /// [kg] mass
        param m5 = 1.225946;
        /// [m] centre of mass
        param c5 = [-0.011953, 0.041065, -0.038437];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [-0.0825, 0.384, 0.0];
        /// [kg] mass
        param m6 = 1.666555;
        /// [m] centre of mass
        param c6 = [0.060149, -0.014117, -0.010517];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.0019640000000000005, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341];
        /// [kg] mass
        param m7 = 1.4955219999999998;
        /// [m] centre of mass
        param c7 = [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i7 = [0.01652985371263463, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.0007066957106145017, -0.001051105327046708];
        /// [m] origin of `joint7`'s frame
        param joint7_at = [0.088, 0.0, 0.0];
        /// [m] origin of `tool`'s frame
        param tool_at = [0.0, 0.0, 0.2104];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground.at(joint1_at), child: link1, axis: Z }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link2, axis: Z }
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link3, axis: Z }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link6, axis: Z }
        body link7 { mass: m7, com: c7, inertia: inertia(i7[0], i7[1], i7[2], i7[3], i7[4], i7[5]) }
        joint joint7: Revolute { parent: link6.at(joint7_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link7, axis: Z }
        /// tool frame
        output pose = link7.at(tool_at).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).pose;
        /// columns are the tool's axes
        output rotation = link7.at(tool_at).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).rotation;
        /// of the tool
        output jacobian = link7.at(tool_at).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).jacobian;
        /// of the tool
        output twist = link7.at(tool_at).oriented([[0.7071067811865475, 0.7071067811865476, 0.0], [-0.7071067811865476, 0.7071067811865475, 0.0], [0.0, 0.0, 1.0]]).twist;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The arm `panda`, every number a param.
    pub mod panda_driven_params {
        /// [m/s^2] gravity
        param gravity = [0.0, 0.0, -9.81];
        /// [kg] mass
        param m1 = 4.970684;
        /// [m] centre of mass
        param c1 = [0.003875, 0.002081, -0.04762];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i1 = [0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169];
        /// [m] origin of `joint1`'s frame
        param joint1_at = [0.0, 0.0, 0.333];
        /// [kg] mass
        param m2 = 0.646926;
        /// [m] centre of mass
        param c2 = [-0.003141, -0.02872, 0.003495];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i2 = [0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704];
        /// [kg] mass
        param m3 = 3.228604;
        /// [m] centre of mass
        param c3 = [0.027518, 0.039252, -0.066502];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i3 = [0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805];
        /// [m] origin of `joint3`'s frame
        param joint3_at = [0.0, -0.316, 0.0];
        /// [kg] mass
        param m4 = 3.587895;
        /// [m] centre of mass
        param c4 = [-0.053169999999999974, 0.10441899999999994, 0.027453999999999985];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i4 = [0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641];
        /// [m] origin of `joint4`'s frame
        param joint4_at = [0.0825, 0.0, 0.0];
        /// [kg] mass
        param m5 = 1.225946;
        /// [m] centre of mass
        param c5 = [-0.011953, 0.041065, -0.038437];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i5 = [0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229];
        /// [m] origin of `joint5`'s frame
        param joint5_at = [-0.0825, 0.384, 0.0];
        /// [kg] mass
        param m6 = 1.666555;
        /// [m] centre of mass
        param c6 = [0.060149, -0.014117, -0.010517];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i6 = [0.0019640000000000005, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341];
        /// [kg] mass
        param m7 = 1.4955219999999998;
        /// [m] centre of mass
        param c7 = [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578];
        /// [kg m^2] xx, yy, zz, xy, xz, yz
        param i7 = [0.01652985371263463, 0.014107248642161839, 0.006676955556640956, 0.0003948922971191777, -0.0007066957106145017, -0.001051105327046708];
        /// [m] origin of `joint7`'s frame
        param joint7_at = [0.088, 0.0, 0.0];
        world { gravity: gravity }
        body link1 { mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }
        joint joint1: Revolute { parent: ground.at(joint1_at), child: link1, axis: Z }
        body link2 { mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }
        joint joint2: Revolute { parent: link1.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link2, axis: Z }
        body link3 { mass: m3, com: c3, inertia: inertia(i3[0], i3[1], i3[2], i3[3], i3[4], i3[5]) }
        joint joint3: Revolute { parent: link2.at(joint3_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link3, axis: Z }
        body link4 { mass: m4, com: c4, inertia: inertia(i4[0], i4[1], i4[2], i4[3], i4[4], i4[5]) }
        joint joint4: Revolute { parent: link3.at(joint4_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link4, axis: Z }
        body link5 { mass: m5, com: c5, inertia: inertia(i5[0], i5[1], i5[2], i5[3], i5[4], i5[5]) }
        joint joint5: Revolute { parent: link4.at(joint5_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]), child: link5, axis: Z }
        body link6 { mass: m6, com: c6, inertia: inertia(i6[0], i6[1], i6[2], i6[3], i6[4], i6[5]) }
        joint joint6: Revolute { parent: link5.oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link6, axis: Z }
        body link7 { mass: m7, com: c7, inertia: inertia(i7[0], i7[1], i7[2], i7[3], i7[4], i7[5]) }
        joint joint7: Revolute { parent: link6.at(joint7_at).oriented([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]), child: link7, axis: Z }
        /// effort of `joint1`
        input tau1;
        force drive1: Effort { joint: joint1, value: tau1 }
        /// effort of `joint2`
        input tau2;
        force drive2: Effort { joint: joint2, value: tau2 }
        /// effort of `joint3`
        input tau3;
        force drive3: Effort { joint: joint3, value: tau3 }
        /// effort of `joint4`
        input tau4;
        force drive4: Effort { joint: joint4, value: tau4 }
        /// effort of `joint5`
        input tau5;
        force drive5: Effort { joint: joint5, value: tau5 }
        /// effort of `joint6`
        input tau6;
        force drive6: Effort { joint: joint6, value: tau6 }
        /// effort of `joint7`
        input tau7;
        force drive7: Effort { joint: joint7, value: tau7 }
        emit forward_dynamics, derivatives;
    }
}
