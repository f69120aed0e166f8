use multibody::multibody;

// The mechanisms of `examples/tradeoff/models.rs`, those with loops as they are where these are solved.

multibody! {
    /// A point mass on a rod.
    pub(crate) mod pendulum {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.0, com: -Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics, derivatives, energy, momentum;
    }
}

multibody! {
    /// Two point masses on rods of one metre.
    pub(crate) mod double_pendulum {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.0, com: -Y }
        body lower { mass: 1.0, com: -Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        emit forward_dynamics, derivatives, energy, momentum;
    }
}

multibody! {
    /// A rigid body that nothing acts on.
    pub(crate) mod free_body {
        body nut { mass: 1.0, inertia: diag(1.0, 2.0, 3.0) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics, derivatives, energy;
    }
}

multibody! {
    /// Franka Emika's arm with its hand and viscous friction, its motors off.
    pub(crate) mod panda {
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
        body link7 {
            mass: 1.495522,
            com: [0.0017208742976286575, 0.0013603544171612296, 0.10048528114865578],
            inertia: inertia(
                0.016529853712634629, 0.014107248642161839, 0.0066769555566409556,
                0.00039489229711917772, -0.00070669571061450173, -0.001051105327046708,
            ),
        }
        joint q1: Revolute { parent: ground.at(0.333 * Z), child: link1, axis: Z }
        joint q2: Revolute { parent: link1.rotated(X, deg(-90.0)), child: link2, axis: Z }
        joint q3: Revolute { parent: link2.at(-0.316 * Y).rotated(X, deg(90.0)), child: link3, axis: Z }
        joint q4: Revolute { parent: link3.at(0.0825 * X).rotated(X, deg(90.0)), child: link4, axis: Z }
        joint q5: Revolute { parent: link4.at([-0.0825, 0.384, 0.0]).rotated(X, deg(-90.0)), child: link5, axis: Z }
        joint q6: Revolute { parent: link5.rotated(X, deg(90.0)), child: link6, axis: Z }
        joint q7: Revolute { parent: link6.at(0.088 * X).rotated(X, deg(90.0)), child: link7, axis: Z }
        force friction1: Damper { joint: q1, damping: 2.0 }
        force friction2: Damper { joint: q2, damping: 2.0 }
        force friction3: Damper { joint: q3, damping: 1.0 }
        force friction4: Damper { joint: q4, damping: 1.0 }
        force friction5: Damper { joint: q5, damping: 0.4 }
        force friction6: Damper { joint: q6, damping: 0.4 }
        force friction7: Damper { joint: q7, damping: 0.2 }
        emit forward_dynamics, derivatives, energy;
    }
}

multibody! {
    /// A governor: balls on two arms that a driven spindle carries along, and a sleeve that hangs on stiff, damped links.
    pub(crate) mod governor {
        const K = 1e7;
        const C = 5e4;
        world { gravity: -9.81 * Z }
        body spindle { mass: 1.0, inertia: diag(0.05, 0.05, 0.05) }
        body right { mass: 0.5, com: -0.3 * Z }
        body left { mass: 0.5, com: -0.3 * Z }
        body sleeve { mass: 1.0 }
        joint shaft: Revolute { parent: ground, child: spindle, axis: Z }
        joint right_arm: Revolute { parent: spindle.at(0.05 * X), child: right, axis: -Y }
        joint left_arm: Revolute { parent: spindle.at(-0.05 * X), child: left, axis: Y }
        joint slide: Prismatic { parent: spindle, child: sleeve, axis: Z }
        force drive: Effort { joint: shaft, value: 0.5 * (9.0 - shaft.rate) }
        force right_link: SpringDamper {
            between: [right.at(-0.2 * Z), sleeve.at(0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        force left_link: SpringDamper {
            between: [left.at(-0.2 * Z), sleeve.at(-0.05 * X)], stiffness: K, damping: C, length: 0.2,
        }
        emit forward_dynamics, derivatives, energy;
    }
}

multibody! {
    /// Its loop solved in closed form.
    pub(crate) mod four_bar {
        world { gravity: -9.81 * Y }
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(4.0 * X), child: rocker, axis: Z }
        #[cut]
        joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
        formulation { constraints: Reduced }
        solve (knee, pivot) from pin { sin(pivot - shaft - knee) > 0.0 }
        output angles = [shaft.angle, shaft.angle + knee.angle, pivot.angle];
        output rates = [shaft.rate, shaft.rate + knee.rate, pivot.rate];
        emit forward_dynamics, derivatives, energy;
    }
}

multibody! {
    /// Its three loops solved in closed form.
    pub(crate) mod andrews {
        const A = [-0.06934, -0.00227, 0.0];
        const B = [-0.03635, 0.03273, 0.0];
        const C = [0.014, 0.072, 0.0];
        body k1 { mass: 0.04325, com: 92e-5 * X, inertia: diag(0.0, 2.194e-6, 2.194e-6) }
        body k2 { mass: 0.00365, com: -115e-4 * X, inertia: diag(0.0, 4.410e-7, 4.410e-7) }
        body k3 { mass: 0.02373, com: [0.01043, -0.01874, 0.0], inertia: diag(0.0, 5.255e-6, 5.255e-6) }
        body k4 { mass: 0.00706, com: -0.00579 * Y, inertia: diag(5.667e-7, 0.0, 5.667e-7) }
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
        #[cut]
        joint p3: Revolute { parent: k2.at(-0.028 * X), child: k3.at(-0.035 * Y), axis: Z }
        #[cut]
        joint p4: Revolute { parent: k2.at(-0.028 * X), child: k4.at(-0.02 * Y), axis: Z }
        #[cut]
        joint p6: Revolute { parent: k2.at(-0.028 * X), child: k6.at(0.02 * X), axis: Z }
        force motor: Effort { joint: beta, value: 0.033 }
        force spring: Spring {
            between: [k3.at([0.02, -0.018, 0.0]), ground.at(C)], stiffness: 4530.0, length: 0.07785,
        }
        formulation { constraints: Reduced }
        solve (theta, gamma) from p3 { cos(beta.angle + theta.angle - gamma.angle) > 0.0 }
        solve (phi, delta) from p4 { cos(phi.angle) > 0.0 }
        solve (omega, epsilon) from p6 { cos(omega.angle) > 0.0 }
        output angles = [[theta.angle, gamma.angle, phi.angle], [delta.angle, omega.angle, epsilon.angle]];
        output rates = [[theta.rate, gamma.rate, phi.rate], [delta.rate, omega.rate, epsilon.rate]];
        emit forward_dynamics, derivatives, energy;
    }
}

multibody! {
    /// One leg; its length is one metre plus the stroke.
    mod leg {
        port base: Frame;
        port tip: Frame;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force thrust: Effort { joint: stroke, value: 7.2 }
        force spring: SpringDamper { joint: stroke, stiffness: 200.0, damping: 5.0, rest: 0.262 }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// Its six loops solved in closed form.
    pub(crate) mod stewart {
        const FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0],
            [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0],
        ];
        const PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4],
            [0.17, -0.595, -0.4], [0.43, -0.445, -0.4], [0.43, 0.445, -0.4],
        ];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        world { gravity: -9.80665 * Z }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg {
            base: ground.at(FEET[i]).rotated(Z, HEADING[i]),
            tip: platform.at(PINS[i]),
        };
        formulation { constraints: Reduced }
        emit forward_dynamics, derivatives, energy, kinematics { given: platform.pose, find: [legs.gimbal, legs.stroke] };
    }
}
