//! Written by `are_as_the_generator_says`.

/// Of seed 101.
pub mod seed101 {
    multibody::multibody! {
        /// A model that others ask.
        pub mod aid1 {
        const K2 = 2.32;
        const K3 = 1.36;
        /// [steps/s^2]
        param p4 = K3;
        input u5;
        body b6 { mass: p4, com: Y, inertia: diag(0.1, 0.2, 0.25) }
        joint j7: Cylindrical { parent: ground.at(cross(Z, [K3, 0, 1e-3])), child: b6, axis: [1, 2, 3] }
        }
        /// A model.
        pub mod m {
        const K8: Vec3 = [2.9, 0.5, 1];
        const K9 = 0.91;
        input u10: Vec3;
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        body b11 { mass: 0.74, inertia: sphere(0.74, 1.5) }
        joint j12: Cylindrical { parent: ground.rotated(X + 2 * Y, cos(K9)), child: b11, axis: Z }
        state s13: rate = t, start: PI / 6;
        let l14 = exp(j12.angle);
        output o15 = [dot(b11.express(b11.position), aid1(diff(b6.at([0.1, -0.2, 0.3]).angular_velocity, j7.angle), j7.travel = s13, j7.angle = atan2(j12.travel.effort, 2.0), j7.travel.rate = powf(1.1 + powi(s13, 2), 0.5), j7.angle.rate = hypot(potential(), j12.travel.accel), u5 = PI / 6 * potential(), t = K9)), potential()];
        /// words
        output o16 = pose(K8, rotation(X, t));
        /// words
        output o17 = Y;
        emit inverse_dynamics, energy, report, equations;
        extern e18(x, y) = crate::Curve;
        force f19: Effort { joint: j12.angle, value: e18(b11.position.x, s13 / (1.5 + powi(j12.travel, 2))) }
        output o20 = e18(sqrt(1 + powi(K9, 2)), s13);
        }
    }
}

/// Of seed 106.
pub mod seed106 {
    multibody::multibody! {
        /// A model that others ask.
        pub mod aid1 {
        /// [items m]
        param p2 = 1.5;
        input u3: [Scalar; 2];
        body b4 { mass: 0.7, com: [PI / 6, 0, 0.887], inertia: diag(0.1, 0.2, 0.25) }
        joint j5: Revolute { parent: ground, child: b4, axis: Z }
        let l6 = dot(Y, (b4.position - Z));
        }
        /// A model.
        pub mod m {
        const K7: [Scalar; 2] = [1.055, 2];
        input u8;
        world { gravity: [0, -9.8, 1] }
        body b9 { mass: K7[1], com: K7[1] * Y, inertia: diag(0.1, 0.2, 0.25) }
        joint j10: Free { parent: ground.at(cross(Z, [K7[1], 0, 0.0])), child: b9.at(-(Z) / 2.0), coordinates: RollPitchYaw }
        constraint gear = j10.x - 1.5 * j10.yaw;
        formulation { constraints: Multipliers }
        state s11: rate = select(select(1.8 <= j10.x , 1.8, j10.x) >= t || !(t > 1), select(1.8 <= j10.x , 1.8, j10.x), dot(b9.angular_velocity, b9.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position)), start: 2.0;
        /// words
        output o12 = b9.jacobian;
        emit mass_matrix, impulse, equations;
        }
    }
}

/// Of seed 113.
pub mod seed113 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        /// [steps/s^2]
        param p1 = 1.5;
        param p2 = 0.7;
        body b3 { mass: p1, inertia: diag(0.5 * p1 + 0.25, 0.5 * p1 + 0.25, 0.5 * p1 + 0.25) }
        joint j4: Revolute { parent: ground.at((X - p2 * X)), child: b3.rotated(Z, p1 * p2), axis: X, armature: 0.05 }
        body b5 { mass: p2, inertia: diag(p1, p1, p1) }
        joint j6: Revolute { parent: b3.at([p2, 0, 2.5]).at((X - 2.0 * X)), child: b5, axis: X + 2 * Y, armature: 0.05 }
        state s7: rate = sinh(dot(X, Z)), start: 1.515;
        let l8 = norm(diff(X, j4.angle.rate) + 3.0 * X);
        let l9 = ([p2, 0, 2]).z;
        simplify small(j4.angle);
        force f10: SpringDamper { joint: j4.angle, stiffness: p1, damping: 0.2, rest: 0.1 }
        output o11 = j6.reaction.express(b5.rotated([1, 1, 0], deg(40)).at(0.5 * Z));
        output o12 = X;
        output o13 = pose((b3.rotated([1, 1, 0], deg(40)).at(0.5 * Z).velocity - [j4.angle.accel, 0, 1.7]), roll_pitch_yaw(bias[j4.angle], 0.2, 1e-3));
        emit mass_matrix, derivatives, impulse, equations;
        extern e14(x, y, z) = crate::Curve;
        force f15: Effort { joint: j6.angle, value: e14(hypot(j6.angle.rate, t), p1, p1) }
        output o16 = e14(j6.angle / (1.5 + powi(t, 2)), powf(1.1 + powi(l8, 2), 0.5), b3.position.x);
        force f17: Effort { joint: j6.angle, value: e14(select(j6.angle.rate < t , j6.angle.rate, j6.angle.rate), select(PI / 6 <= j4.angle.rate , PI / 6, j6.angle), j6.angle.rate) }
        force k18: Contact { at: b3.at([0.1, -0.2, 0.3]), on: b3, stiffness: 1e3, damping: 0.3, friction: 0.4 }
        output o19 = k18.force;
        }
    }
}

/// Of seed 115.
pub mod seed115 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: [Scalar; 2] = [4, 2];
        /// [steps/s^2]
        param p2 = 0.30;
        param p3 = 0.5 * p2 + 0.25;
        /// [items m]
        param p4: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        world { gravity: [0, -9.8, 1] }
        body b5 { mass: 2.83, inertia: diag(0.1, 0.2, 0.25) }
        joint j6: Planar { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).rotated(Z, norm(X + 3.0 * X)), child: b5, axis: Y }
        state s9: rate = powf(1.1 + powi(p3, 2), 0.5), start: 2.07;
        /// A body with words.
        body b7 { mass: (0.86 + s9), com: (Y - p4[1]), inertia: diag(K1[1], K1[1], K1[1]) }
        joint self_8: Screw { parent: b5.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at(X), child: b7, axis: X + 2 * Y, pitch: 0.1, armature: 0.05 }
        solve (x10) from 0.95 * x10 + (b5.position.x - (t + 0.0)) == min(t, p3);
        let l12 = norm(p3 * p4[1] + 3.0 * X);
        force f13: Effort { joint: self_8.angle, value: powi(K1[1], 3) }
        force f14: Force { at: b5, value: p4[1], axes: ground }
        extern e15(x, y) = crate::Curve;
        output o16 = diff(e15(ln(1 + powi(t, 2)), x10), p2);
        force f17: Effort { joint: self_8.angle, value: e15(b7.position.z, t * b7.position.z) }
        output o18 = e15(l12, dot(b7.angular_velocity, b7.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position));
        }
    }
}

/// Of seed 124.
pub mod seed124 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 2.46;
        const K2 = K1;
        /// [items m]
        param p3 = 2.44;
        input u4: [Scalar; 2];
        world { gravity: [0, -9.8, 1] }
        body b5 { mass: 1.36, com: p3 * Z, inertia: diag(0.1, 0.2, 0.25) }
        joint j6: Fixed { parent: ground, child: b5 }
        body b7 { mass: K2, com: [p3, 0, 0.169], inertia: sphere(K2, K2) }
        joint j8: Revolute { parent: ground.rotated(Y, 2.6).at(cross(Y, K2 * Y)), child: b7, axis: Y, armature: 0.05 }
        body b9 { mass: 0.98, inertia: diag(0.1, 0.2, 0.25) }
        joint j10: Ball { parent: b5.rotated(Z, p3 / (1.5 + powi(p3, 2))).rotated([1, 0, 1], dot(X, X)), child: b9, coordinates: RollPitchYaw }
        constraint link: Rod { between: [ground.at([0.5, 0.4, 0.3]), b9.at(0.3 * X)], length: 1.2 }
        assume b9.position.z > -100;
        emit forward_dynamics, inverse_dynamics, equations;
        extern e11(x, y, z) = crate::Curve;
        output o12 = e11(sqrt(1 + powi(p3, 2)), dot(Y, X), dot(b7.velocity, b5.at([0.1, -0.2, 0.3]).angular_velocity)) + e11((t - b7.at([0.1, -0.2, 0.3]).position.z), diff(b7.position.y, j10.roll.rate), dot(b5.angular_velocity, b7.angular_velocity));
        output o13 = e11(u4[0], 3, (j10.pitch - j10.roll));
        force r#arm: Contact { at: b9, radius: 0.2, ball: b9.at([0.1, -0.2, 0.3]), ball_radius: 2.00, stiffness: 1e3, damping: 0.3, friction: 0.4 }
        output o15 = r#arm.stored;
        }
    }
}

/// Of seed 133.
pub mod seed133 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 0.7;
        param p2 = K1;
        param p3: Vec3 = [0.3, 0.0, 1];
        param p4: [Scalar; 3] = [1, 0.4, K1];
        world { gravity: -9.81 * Z }
        /// A body with words.
        body b5 { mass: p2, com: (p3 - 1 * p3), inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j6: Revolute { parent: ground.rotated(Y, dot(p3, p3)).at(-(p3) / 2.0), child: b5, axis: X }
        solve (x7) from p4[2] * x7 + norm(b5.at([0.1, -0.2, 0.3]).angular_velocity + 3.0 * X) == (0.112 + b5.at([0.1, -0.2, 0.3]).position.y);
        /// [items m]
        output o9 = b5.at([0.1, -0.2, 0.3]).pose;
        output o10 = b5.jacobian.express(b5);
        output o11 = p3;
        emit energy, derivatives, report;
        extern r#arm(x) = crate::Curve;
        force f13: Effort { joint: j6.angle, value: r#arm(p4[0]) }
        }
    }
}

/// Of seed 142.
pub mod seed142 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        world { gravity: -9.81 * Z }
        body b1 { mass: 0.87, inertia: cylinder(0.87, 0.5 * 2 + 0.25, 0.5 * 2 + 0.25, Z) }
        joint j2: Revolute { parent: ground.at(X).at(cross(X, X)), child: b1, axis: Z }
        let l3 = sin(b1.position.x * 2.5e2);
        force f4: Torque { at: b1.rotated([1, 1, 0], deg(40)).at(0.5 * Z), value: b1.at([0.1, -0.2, 0.3]).velocity, axes: b1.rotated([1, 1, 0], deg(40)).at(0.5 * Z) }
        emit inverse_dynamics, derivatives, residual, impulse, linearize, report;
        }
    }
}

/// Of seed 145.
pub mod seed145 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: Vec3 = [deg(45), 0.5, 1];
        const K2: [Scalar; 2] = [3.0, 2];
        input u3: [Scalar; 2];
        input u4;
        world { gravity: -9.81 * Z }
        state s7: rate = powf(1.1 + powi(t, 2), 0.5), start: K2[1];
        /// A body with words.
        body b5 { mass: (1.74 + s7), inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint model6: Fixed { parent: ground, child: b5 }
        /// A body with words.
        body b8 { mass: 1.5, com: [K2[1], 0, 1e-3], inertia: cylinder(1.5, 0.60, 0.59, X + 2 * Y) }
        joint j9: Cylindrical { parent: b5.rotated(X, K2[1] * K2[1]), child: b8, axis: [1, 2, 3] }
        body b10 { mass: 1.5, inertia: diag(0.1, 0.2, 0.25) }
        joint j11: Revolute { parent: ground.at(K1), child: b10, axis: Z }
        constraint gear = j9.travel - 0.5 * 2 + 0.25 * j11.angle;
        formulation { constraints: Reduced }
        let l12 = b10.at(0.2 * Y);
        emit equations;
        }
    }
}

/// Of seed 155.
pub mod seed155 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 1.78;
        param p2: Vec3 = [0.3, 3.0, 1];
        /// [items m]
        param p3 = 2.14;
        param p4: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        body params5 { mass: p3, com: p3 * Z, inertia: diag(0.1, 0.2, 0.25) }
        joint j6: Revolute { parent: ground, child: params5, axis: X }
        body b7 { mass: 0.5 * p3 + 0.25, inertia: diag(0.1, 0.2, 0.25) }
        joint j8: Ball { parent: params5.at(p2).rotated(Z, (p3 - p3)), child: b7, coordinates: RollPitchYaw }
        formulation { constraints: Reduced }
        state s9: rate = K1, start: PI / 6;
        force f10: SpringDamper { joint: j8.pitch, stiffness: sqrt(1 + powi(params5.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.y, 2)), damping: 0.2, rest: 0.1 }
        /// [steps/s^2]
        output o11 = j8.reaction.express(params5);
        assume params5.position.z > -100;
        extern e12(x, y) = crate::Curve;
        force f13: Effort { joint: j8.roll, value: e12(p3, PI / 6 * s9) }
        }
    }
}
