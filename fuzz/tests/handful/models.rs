//! Written by `are_as_the_generator_says`.

/// Of seed 101.
pub mod seed101 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 1.46;
        const K2 = 2.26;
        input u3;
        world { gravity: -9.81 * Z }
        body b4 { mass: 1.13, com: [K2, 0, 0.411], inertia: cylinder(1.13, 0.5 * 2 + 0.25, 1.5, -Z) }
        joint j5: Ball { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at(Y), child: b4.at(cross(Z, Z)).oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), coordinates: RollPitchYaw }
        drive j5.roll = -((K1 + t));
        state s6: rate = dot(b4.velocity, Z) * (u3 - s6), start: deg(45);
        let l7 = hypot(min(s6, j5.pitch), j5.yaw.rate);
        let l8 = b4.at(0.2 * Y);
        force f9: Effort { joint: j5.roll, value: hypot(s6, t) * j5.yaw }
        output o10 = pose(X, rotation(X + 2 * Y, (u3 + l8.position.z)));
        output o11 = -((j5.pitch.effort * Z).x);
        /// [steps/s^2]
        output o12 = j5.reaction.express(b4);
        emit mass_matrix;
        }
    }
}

/// Of seed 102.
pub mod seed102 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        /// [items m]
        param p1 = 0.7;
        input u2: Vec3;
        world { gravity: -9.81 * Z }
        body b3 { mass: 0.5 * p1 + 0.25, com: cross(Y, (Y - [1.2, 0, 1e-3])), inertia: diag(0.1, 0.2, 0.25) }
        joint j4: Revolute { parent: ground, child: b3, axis: X + 2 * Y }
        /// A body with words.
        body b5 { mass: 0.5 * p1 + 0.25, com: cross(X, [p1, 0, deg(90)]), inertia: cylinder(0.5 * p1 + 0.25, 0.91, 0.7, X + 2 * Y) }
        joint j6: Prismatic { parent: b3.at(p1 * Y), child: b5, axis: [1, 2, 3] }
        constraint gear = j4.angle - 0.7 * j6.travel - 0.2;
        formulation { constraints: Reduced }
        let l7 = atan(atan2(p1, 2.0));
        let l8 = atan2(dot(b3.at([0.1, -0.2, 0.3]).position, b3.at([0.1, -0.2, 0.3]).position), 2.0);
        force f9: Effort { joint: j6.travel, value: norm([p1, 0, 4] + 3.0 * X) }
        output o10 = j4.reaction;
        /// [pieces] of something
        output q11 = b3.rotated([1, 1, 0], deg(40)).at(0.5 * Z).jacobian;
        output o12 = cross(X, X);
        emit forward_dynamics;
        }
    }
}

/// Of seed 104.
pub mod seed104 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1 = 0.60;
        input u2: Vec3;
        input u3: Vec3;
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        body b4 { mass: 2.74, inertia: cuboid(2.74, [2.07, 0.4, K1]) }
        joint j5: Planar { parent: ground.oriented([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).at((X - K1 * X)), child: b4, axis: Y }
        force f6: Damper { joint: j5.y, damping: 0.52 }
        force f7: Damper { joint: j5.y, damping: 0.5 * 2 + 0.25 }
        }
    }
}

/// Of seed 105.
pub mod seed105 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        /// [steps/s^2]
        param p1: [Vec3; 2] = [[1, 0, 0], [0, 0.1, 0.2]];
        input u2;
        world { gravity: -9.81 * Z }
        body b3 { mass: 2.43, inertia: diag(0.7, 0.7, 0.7) }
        joint j4: Free { parent: ground, child: b3, coordinates: RollPitchYaw }
        body b5 { mass: 1.5, inertia: diag(1.5, 1.5, 1.5) }
        joint j6: Ball { parent: b3, child: b5 }
        body b7 { mass: 0.5 * 2 + 0.25, inertia: sphere(0.5 * 2 + 0.25, 0.7) }
        joint j8: Planar { parent: ground.at(2.5e2 * p1[1]), child: b7, axes: [X, [0, 3, -4]] }
        drive j4.roll = dot(1.3 * Z, -(Z) / 2.0);
        let l9 = b5.at([0.1, -0.2, 0.3]).at(0.2 * Y);
        let l10 = ((4 + j4.roll.rate) + powi(b5.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.x, -1));
        force f11: Spring { between: [l9, ground.at([3, 2, 1])], stiffness: l10, length: 0.5 }
        emit mass_matrix, energy, derivatives;
        }
    }
}

/// Of seed 106.
pub mod seed106 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: [Scalar; 2] = [2.5e2, 2];
        const K2: [Scalar; 2] = [3.0, 2];
        param input_3 = K1[1];
        input u4: [Scalar; 2];
        world { gravity: [0, -9.8, 1] }
        body b5 { mass: K2[1], com: (X - [1.0, 0, PI / 6]), inertia: sphere(K2[1], 0.84) }
        joint j6: Revolute { parent: ground.at(X), child: b5.at(2.5e2 * Y).rotated(X, -(1e-3)), axis: [1, 2, 3] }
        body v7 { mass: K2[1], com: -(X) / 2.0, inertia: diag(input_3, input_3, input_3) }
        joint j8: Ball { parent: b5, child: v7 }
        state s9: rate = dot(X, t * b5.position), start: 2.6;
        let l10 = (Y).z / (1.5 + powi(powf(1.1 + powi(1.379, 2), 0.5), 2));
        force f11: Damper { joint: j6.angle, damping: input_3 }
        /// [pieces] of something
        output r#match = norm([j6.angle.rate, 0, 1.073] + 3.0 * X) / (1.5 + powi(l10, 2));
        /// [items m]
        output o13 = v7.jacobian.express(v7);
        output o14 = v7.jacobian;
        emit forward_dynamics, inverse_dynamics, bias, residual;
        }
    }
}

/// Of seed 107.
pub mod seed107 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: [Scalar; 2] = [PI / 6, 2];
        input u2;
        body b3 { mass: 1.5, com: cross(X, 0.666 * X), inertia: cylinder(1.5, 1.5, 1.5, Y) }
        joint j4: Screw { parent: ground, child: b3, axis: X + 2 * Y, pitch: 0.1 }
        state s5: rate = ((b3.at([0.1, -0.2, 0.3]).twist.linear - X)).x, start: 2.8;
        let l6 = powi(t, 1) / (1.5 + powi(K1[1], 2));
        force f7: Effort { joint: j4.angle, value: t }
        force f8: Force { at: b3, value: cross(b3.position, Z), axes: ground }
        output o9 = b3.rotated([1, 1, 0], deg(40)).at(0.5 * Z).position.z;
        output o10 = b3.jacobian;
        output o11 = b3.twist;
        emit inverse_dynamics, mass_matrix, derivatives, residual;
        }
    }
}

/// Of seed 109.
pub mod seed109 {
    multibody::multibody! {
        /// A model.
        pub mod m {
        const K1: [Scalar; 2] = [1.819, 2];
        param params2 = 2.93;
        input u3;
        world { gravity: -9.81 * [1, 2, 2] / 3 }
        /// A body with words.
        body b4 { mass: params2, com: K1[1] * Y, inertia: diag(0.5 * params2 + 0.25, 0.5 * params2 + 0.25, 0.5 * params2 + 0.25) }
        joint j5: Revolute { parent: ground.rotated(Z, -(K1[1])).at(-(Z) / 2.0), child: b4, axis: Z }
        body b6 { mass: K1[1], com: -(Y) / 2.0, inertia: inertia(0.2, 0.23, 0.21, 0.02, -0.01, 0.03) }
        joint j7: Revolute { parent: b4.at(cross(Z, (Z - Z))), child: b6, axis: X + 2 * Y }
        constraint gear = j5.angle - K1[1] * j7.angle;
        state s8: rate = atan2(atan2(u3, 2.0), 2.0), start: 2;
        force f9: Effort { joint: j7.angle, value: dot([u3, 0, 1], b4.at([0.1, -0.2, 0.3]).angular_velocity) }
        force f10: Spring { between: [b6, ground.at([3, 2, 1])], stiffness: powi(j5.angle.rate, 1), length: 0.5 }
        output o11 = [params2, ln(1 + powi(j5.angle.accel, 2))];
        output o12 = b4.rotated([1, 1, 0], deg(40)).at(0.5 * Z).pose;
        output o13 = j7.reaction.express(b4);
        assume b4.position.z > -100;
        emit forward_dynamics;
        }
    }
}
