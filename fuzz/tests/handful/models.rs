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
        /// A body with words.
        body b6 { mass: p4, inertia: sphere(p4, 2.23) }
        joint j7: Cylindrical { parent: ground.rotated([1, 2, 3], sqrt(1 + powi(K3, 2))).at(cross(Z, [K3, 0, 1e-3])), child: b6, axis: [1, 2, 3] }
        }
        /// A model.
        pub mod m {
        const K8: Vec3 = [2.9, 0.5, 1];
        const K9 = 0.91;
        input u10: Vec3;
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        body b11 { mass: 0.74, com: K8, inertia: sphere(0.74, 0.5 * 2 + 0.25) }
        joint j12: Cylindrical { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b11, axis: -Z }
        force f13: Effort { joint: j12.angle, value: exp(norm(Y + 3.0 * X)) }
        output o14 = j12.reaction.express(b11);
        output o15 = dot(aid1(diff(b6.at([0.1, -0.2, 0.3]).angular_velocity, j7.angle), j7.travel = j12.reaction.force.z, j7.angle = j12.reaction.force.z, j7.travel.rate = j12.angle, j7.angle.rate = aid1(max(j7.angle.rate, u5) / (1.5 + powi(select(j7.travel.rate >= deg(30) , j7.travel.rate, j7.travel.rate), 2)), j7.travel = select(t > j12.travel , t, t), j7.angle = K9, j7.travel.rate = b11.position.y, j7.angle.rate = aid1(p4, j7.travel = (f13.power - j12.travel.rate), j7.angle = j12.travel.effort, j7.travel.rate = deg(45), j7.angle.rate = f13.power, u5 = (j12.travel.effort + t), t = t), u5 = j12.angle, t = diff(potential(), j12.angle), p4 = j12.travel), u5 = mass_matrix[j12.travel, j12.travel], t = j12.travel.accel, p4 = t), b11.express(X));
        output o16 = pose(aid1(b6.velocity, j7.travel = potential(), j7.angle = j12.reaction.force.z, j7.travel.rate = j12.travel, j7.angle.rate = diff(j12.angle.rate, j12.angle), u5 = PI / 6 / (1.5 + powi(potential(), 2)), t = t), roll_pitch_yaw(K9, 0.2, PI / 6));
        emit derivatives, residual, linearize, equations;
        extern e17(x, y, z) = crate::Curve;
        output o18 = e17(sqrt(1 + powi(b11.position.y, 2)), j12.travel.rate, (b11.angular_velocity).z) + e17(ln(1 + powi(j12.angle.rate, 2)), (j12.angle.rate - b11.position.z), diff(1e-3, j12.travel.rate));
        output o19 = e17(abs(PI / 6), min(2.5e2, j12.travel), -(K9));
        }
    }
}

/// Of seed 104.
pub mod seed104 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 0.36;
        const K2: Vec3 = [2.3, 0.5, 1];
        param p3 = 2.00;
        /// [items m]
        param p4: Vec3 = [0.3, 1.355, 1];
        world { gravity: [0, -9.8, 1] }
        /// A body with words.
        body b5 { mass: 0.5 * p3 + 0.25, com: p3 * K2, inertia: diag(p3, p3, p3) }
        joint j6: Ball { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at(cross(p4, [K1, 0, 1.5])), child: b5, coordinates: RollPitchYaw }
        body b7 { mass: 0.5 * p3 + 0.25, com: -(Z) / 2.0, inertia: diag(0.1, 0.2, 0.25) }
        joint j8: Prismatic { parent: b5, child: b7, axis: Y }
        body b9 { mass: p3, com: (X - K2), inertia: cuboid(p3, [K1, 0.4, K1]) }
        joint j10: Free { parent: b5.at(K2), child: b9 }
        formulation { coordinates: Absolute(Quaternion) }
        solve (x11, y12) from [0.5 * p3 + 0.25 * x11 - (powi(j6.roll.rate, 2)) * y12 == diff(p3, p3), x11 + 2 * y12 == norm(X + 3.0 * X)];
        let l13 = norm(b7.at([0.1, -0.2, 0.3]).position + 3.0 * X);
        force f14: SpringDamper { joint: j6.yaw, stiffness: dot(b5.at([0.1, -0.2, 0.3]).express(X), substitute(p4, p3 = j6.pitch)), damping: 0.2, rest: 0.1 }
        force f15: Force { at: b9, value: (p4 - p3 * p4), axes: ground }
        output o16 = sqrt(1 + powi((b7.position).y, 2));
        output o17 = b5.rotated([1, 1, 0], deg(40)).at(0.5 * Z).rotation;
        output o18 = atan2((cross(K2, b7.position)).z, 2.0);
        assume b7.position.z > -100;
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
        body b4 { mass: 0.7, com: [1.1, 0, PI / 6], inertia: cuboid(0.7, [p2, 0.4, 2.14]) }
        joint j5: Fixed { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b4 }
        body b6 { mass: 0.7, com: (Y - p2 * Y), inertia: diag(1.05, 1.05, 1.05) }
        joint j7: Prismatic { parent: b4.rotated(Y, ln(1 + powi(p2, 2))).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b6.at(-(Z) / 2.0).at(X), axis: [1, 2, 3] }
        let l8 = b4.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.z;
        let l9 = b6.at([0.1, -0.2, 0.3]).at(0.2 * Y);
        }
        /// A model.
        pub mod m {
        param p10: [Scalar; 3] = [1, 0.4, 2.69];
        input u11: [Scalar; 2];
        world { gravity: -9.81 * Z }
        body b12 { mass: p10[0], inertia: cylinder(p10[0], 0.7, 0.5 * p10[0] + 0.25, [1, 0, 1]) }
        joint j13: Revolute { parent: ground.at(Y).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b12, axis: X }
        body b14 { mass: p10[0], com: cross(Z, [p10[2], 0, 2.5e2]), inertia: diag(p10[0], p10[0], p10[0]) }
        joint j15: Revolute { parent: b12.at(cross(X, X)), child: b14, axis: Z }
        body b16 { mass: 1.83, com: (X - X), inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j17: Revolute { parent: b12.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).rotated([1, 2, 3], 1e-3 / (1.5 + powi(p10[0], 2))), child: b16.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), axis: -Z }
        constraint link: Rod { between: [ground.at([0.5, 0.4, 0.3]), b16.at(0.3 * X)], length: 1.2 }
        output reach = norm(b12.position);
        state s18: rate = p10[2] - (0.7) * s18, start: 1.243;
        force f19: Force { at: b16.rotated([1, 1, 0], deg(40)).at(0.5 * Z), value: -(b16.twist.linear) / 2.0, axes: ground }
        force f20: Force { at: b16, value: (b16.velocity - dot(Z, b16.position) * b16.velocity), axes: ground }
        output o21 = 0.0;
        assume b16.at([0.1, -0.2, 0.3]).position.z > -100;
        emit mass_matrix, constraints, residual, linearize;
        }
    }
}

/// Of seed 110.
pub mod seed110 {
    multibody::multibody! {
        /// A part.
        mod leg {
        port base: Frame;
        const K1: Vec3 = [1e-3, 0.5, 1];
        param p2 = 2.59;
        param p3: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        param p4: Vec3 = [0.3, PI / 6, 1];
        input u5;
        body b6 { mass: 0.20, inertia: diag(0.1, 0.2, 0.25) }
        joint j7: Screw { parent: base.rotated(Z, dot(K1, Y)).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b6.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at(K1), axis: Y, pitch: 0.1, armature: 0.05 }
        /// A body with words.
        body b8 { mass: 0.7, inertia: cuboid(0.7, [2.41, 0.4, 0.5 * p2 + 0.25]) }
        joint j9: Revolute { parent: b6.at(-(K1) / 2.0), child: b8, axis: Z }
        state s10: rate = 1.563 - (0.5 * p2 + 0.25) * s10, start: 2.5e2;
        force input_11: Damper { joint: j9.angle, damping: 0.38 }
        }
        /// A model.
        pub mod m {
        const K12: [Scalar; 2] = [PI / 6, 2];
        const K13: Vec3 = [1e-3, 0.5, 1];
        /// [pieces] of something
        param p14: Vec3 = [0.3, deg(45), 1];
        param values15: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        /// A body with words.
        body b16 { mass: 1.5, inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j17: Fixed { parent: ground, child: b16 }
        part leg_18: [leg; 1] = |i| leg { base: b16.rotated(Z, deg(7) * i) };
        assume leg_18[0].b6.at([0.1, -0.2, 0.3]).position.z > -100;
        emit forward_dynamics, equations;
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
        body b3 { mass: p1, com: [2.3, 0, 2.8], inertia: diag(0.1, 0.2, 0.25) }
        joint j4: Screw { parent: ground.at(Z), child: b3, axis: Y, pitch: 0.1 }
        body b5 { mass: 0.5 * p1 + 0.25, inertia: sphere(0.5 * p1 + 0.25, 0.7) }
        joint j6: Fixed { parent: ground.rotated(Y, 2.5e2), child: b5.at(0.816 * Z).at(p1 * Z) }
        body b7 { mass: 0.2, inertia: diag(1e-3, 1e-3, 1e-3) }
        body b8 { mass: 0.1, com: 0.15 * X, inertia: rod(0.1, 0.59, X) }
        body b9 { mass: 0.7 }
        joint j10: Revolute { parent: b3, child: b7, axis: Z }
        joint j11: Revolute { parent: b7.at(0.1 * X), child: b8, axis: Z }
        joint j12: Prismatic { parent: b3, child: b9, axis: X }
        #[cut]
        joint j13: Revolute { parent: b8.at(0.59 * X), child: b9, axis: Z }
        state s14: rate = b5.position.x - (0.7) * s14, start: 4;
        simplify s14.rate == 0;
        /// [steps/s^2]
        output o15 = [powi(select(j12.travel.accel >= b5.position.x && b5.position.x < 3.0, j12.travel.accel, j10.angle.effort), 0), -(j11.angle.rate)];
        output o16 = sqrt(1 + powi((powf(1.1 + powi(j10.angle.rate, 2), 0.5) - sinh(p2)), 2));
        output o17 = b5.rotated([1, 1, 0], deg(40)).at(0.5 * Z).pose;
        emit inverse_dynamics, bias, residual, linearize, equations;
        }
    }
}

/// Of seed 116.
pub mod seed116 {
    multibody::multibody! {
        /// A part.
        mod leg {
        port base: Frame;
        const K1 = 1.01;
        param p2: [Scalar; 3] = [1, 0.4, 1.74];
        param r#match: Vec3 = [0.3, 1e-3, 1];
        body b4 { mass: 2.85, com: cross(X, [p2[2], 0, 2]), inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j5: Revolute { parent: base.rotated(Z, 2.5e2).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b4, axis: [1, 0, 1], armature: 0.05 }
        }
        /// A model.
        pub mod m {
        const K6: Vec3 = [1.539, 0.5, 1];
        param p7 = 0.7;
        param p8 = 0.5 * p7 + 0.25;
        input u9: Vec3;
        input u10: Vec3;
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        /// A body with words.
        body b11 { mass: 0.5 * p8 + 0.25, com: cross(Z, p7 * Z), inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j12: Planar { parent: ground.at(Z), child: b11, axes: [X, [0, 3, -4]] }
        /// A body with words.
        body b13 { mass: 0.7, inertia: sphere(0.7, 0.5 * p8 + 0.25) }
        joint j14: Revolute { parent: b11.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b13.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), axis: X + 2 * Y }
        part leg_15: [leg; 3] = |i| leg { base: b11.rotated(Z, 2.5e2 * i) };
        drive j12.x = p7;
        let l16 = leg_15[2].b4.at(0.2 * Y);
        force f17: SpringDamper { joint: j12.x, stiffness: t * 2.0 * 1e-3 * p7, damping: 0.2, rest: 0.1 }
        output o18 = b13.jacobian;
        emit inverse_dynamics, residual;
        }
    }
}

/// Of seed 122.
pub mod seed122 {
    multibody::multibody! {
        /// A model that others ask.
        pub mod aid1 {
        const K2 = 2.62;
        param p3 = 1.5;
        input u4;
        input u5;
        body b6 { mass: 1.44, com: [K2, 0, 2.5e2], inertia: sphere(1.44, p3) }
        joint j7: Prismatic { parent: ground, child: b6, axis: Z }
        let l8 = b6.at(0.2 * Y);
        let l9 = dot([t, 0, 2.5e2], b6.twist.linear);
        }
        /// A model.
        pub mod m {
        /// [pieces] of something
        param p10 = 0.5 * 2 + 0.25;
        /// [steps/s^2]
        param p11 = 0.5 * p10 + 0.25;
        world { gravity: -9.81 * Z }
        body b12 { mass: 2.76, inertia: diag(0.1, 0.2, 0.25) }
        joint r#match: Fixed { parent: ground, child: b12 }
        solve (x14) from powi(x14, 2) == 1 + powi(norm(b12.position + 3.0 * X), 2) { x14 > 0.0 }
        let l16 = (-(p11) + -(p10));
        output o17 = [hypot(select(r#match.reaction.force.z <= p10 , r#match.reaction.force.z, 2.5e2), kinetic()), potential()];
        output o18 = [r#match.reaction.moment, b12.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.y * X];
        assume b12.position.z > -100;
        emit derivatives, linearize;
        extern e19(x) = crate::Curve;
        output o20 = diff(e19(norm(b12.twist.linear + 3.0 * X)), p10);
        output o21 = e19(b12.position.x * t);
        }
    }
}

/// Of seed 123.
pub mod seed123 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 0.7;
        /// words
        param p2 = K1;
        param p3: Vec3 = [0.3, 0.432, 1];
        /// [items m]
        param p4 = 0.46;
        input u5;
        input u6: Vec3;
        world { gravity: [0, -9.8, 1] }
        /// A body with words.
        body b7 { mass: p4, inertia: diag(0.1, 0.2, 0.25) }
        joint j8: Prismatic { parent: ground.at(cross(p3, (p3 - [K1, 0, PI / 6]))), child: b7, axis: [1, 0, 1], armature: 0.05 }
        body b9 { mass: 0.5 * p2 + 0.25, inertia: sphere(0.5 * p2 + 0.25, 0.5 * p4 + 0.25) }
        joint j10: Revolute { parent: b7.at(-(Z) / 2.0), child: b9, axis: -Z }
        /// A body with words.
        body b11 { mass: 2.13, inertia: diag(0.1, 0.2, 0.25) }
        joint j12: Ball { parent: b9.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at(X), child: b11 }
        formulation { constraints: Reduced }
        state s13: rate = u5, start: 0.238;
        solve (x14) from powi(x14, 2) == 1 + powi(-(t), 2) { x14 > 0.0 }
        force f16: SpringDamper { joint: j10.angle, stiffness: t, damping: 0.2, rest: 0.1 }
        force f17: Force { at: b11, value: cross(b11.position, b11.rotated([1, 1, 0], deg(40)).at(0.5 * Z).velocity), axes: ground }
        /// [pieces] of something
        output o18 = p2;
        output o19 = cross(u6, b7.at([0.1, -0.2, 0.3]).angular_velocity);
        emit report, equations;
        extern e20(x, y) = crate::Curve;
        output o21 = diff(e20(atan2(K1, 2.0), (j10.angle.rate - 1e-3)), j10.angle.rate);
        output o22 = diff(e20(min(t, j10.angle), sqrt(1 + powi(s13, 2))), u5);
        }
    }
}

/// Of seed 125.
pub mod seed125 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: [Scalar; 2] = [2, 2];
        const K2: Vec3 = [3.0, 0.5, 1];
        /// [pieces] of something
        param p3: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        param p4 = 0.79;
        input u5: Vec3;
        body b6 { mass: K1[1], com: cross(Y, [p4, 0, 0.977]), inertia: cuboid(K1[1], [p4, 0.4, 0.5 * p4 + 0.25]) }
        joint j7: Screw { parent: ground, child: b6, axis: [p4, 1, 0.5], pitch: 0.1 }
        body b8 { mass: K1[1], com: p3[1], inertia: diag(0.93, 0.93, 0.93) }
        joint j9: Fixed { parent: b6.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).rotated(Y, (K2).y), child: b8 }
        body b10 { mass: K1[1], inertia: cylinder(K1[1], K1[1], K1[1], [1, 2, 3]) }
        joint j11: Free { parent: b6.at(cross(K2, K2)).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), child: b10.rotated(Y, max(2.5e2, p4)).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]) }
        let l12 = p4 * K1[1];
        let l13 = p4 / (1.5 + powi((K2).x, 2));
        output o14 = b8.acceleration;
        /// [pieces] of something
        output o15 = [norm(b8.rotated([1, 1, 0], deg(40)).at(0.5 * Z).twist.linear + 3.0 * X), powf(1.1 + powi(b6.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.x, 2), 0.5)];
        emit forward_dynamics, impulse;
        }
    }
}
