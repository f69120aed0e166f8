//! Bodies on limbs, with multipliers: equations that limbs absorb, wait, or lose at a pose.

use multibody::multibody;

multibody! {
    /// A strut on a universal joint. Its length is that of the rod plus the stroke, and may be zero.
    mod strut {
        port base: Frame;
        port tip: Frame;
        /// [kg]
        param heavy = 0.37;
        /// [kg]
        param light = 0.37;
        /// [N]
        input thrust;
        body cylinder {
            mass: heavy, com: [0.013, -0.021, 0.47],
            inertia: inertia(
                0.017 * heavy, 0.019 * heavy, 0.006 * heavy, 0.001 * heavy, -0.0005 * heavy, 0.001 * heavy,
            ),
        }
        body piston {
            mass: light, com: [0.003, 0.008, -0.52], inertia: diag(0.016 * light, 0.015 * light, 0.0024 * light),
        }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [[1.0, 2.0, 2.0], [2.0, 1.0, -2.0]] }
        joint stroke: Prismatic { parent: cylinder.at([0.0, 0.0, 0.9]), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
    }

    /// The same, which is known to stay long.
    mod long_strut {
        port base: Frame;
        port tip: Frame;
        /// [kg]
        param heavy = 0.37;
        /// [kg]
        param light = 0.37;
        /// [N]
        input thrust;
        body cylinder {
            mass: heavy, com: [0.013, -0.021, 0.47],
            inertia: inertia(
                0.017 * heavy, 0.019 * heavy, 0.006 * heavy, 0.001 * heavy, -0.0005 * heavy, 0.001 * heavy,
            ),
        }
        body piston {
            mass: light, com: [0.003, 0.008, -0.52], inertia: diag(0.016 * light, 0.015 * light, 0.0024 * light),
        }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at([0.0, 0.0, 0.9]), child: piston, axis: Z }
        assume stroke > -0.6;
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
    }

    /// Struts that stay long, on gimbals whose axes stay apart.
    mod upright_strut {
        port base: Frame;
        port tip: Frame;
        /// [m]
        param length = 0.9;
        /// [m]
        param least = 0.3;
        param apart = 0.25;
        body cylinder {
            mass: 0.37, com: [0.013, -0.021, 0.47],
            inertia: inertia(0.00629, 0.00703, 0.00222, 0.00037, -0.000185, 0.00037),
        }
        body piston { mass: 0.31, com: [0.003, 0.008, -0.52], inertia: diag(0.00592, 0.00555, 0.000888) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(length * Z), child: piston, axis: Z }
        assume stroke > least - length;
        assume cos(gimbal.second) > apart;
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
    }

    /// A barrel that turns, tilts about an axis across, typed to sixteen digits, and is drawn out.
    mod turret {
        port base: Frame;
        port tip: Frame;
        body ring {
            mass: 0.3, com: [0.013, -0.021, 0.047], inertia: inertia(0.017, 0.019, 0.006, 0.001, -0.0005, 0.001),
        }
        body barrel {
            mass: 0.3, com: [0.213, -0.021, 0.047], inertia: inertia(0.006, 0.019, 0.017, 0.001, -0.0005, 0.001),
        }
        body tube { mass: 0.2, com: [0.213, 0.011, 0.027], inertia: inertia(0.003, 0.012, 0.011, 0.0, 0.0004, 0.001) }
        joint turn: Revolute { parent: base, child: ring, axis: Z }
        joint tilt: Revolute {
            parent: ring.rotated(X, 0.3), child: barrel, axis: [0.0, 0.9553364891256061, -0.2955202066613395],
        }
        joint draw: Prismatic { parent: barrel.at(0.7 * X), child: tube, axis: X }
        assume draw > -0.4;
        assume tilt > -1.2 && tilt < 1.3;
        #[cut]
        joint ball: Ball { parent: tube, child: tip }
    }

    pub mod struts {
        const FEET: [Vec3; 4] = [
            [-0.8137, 0.2154, 0.1], [0.7411, 0.4023, -0.0712], [0.0612, -0.9027, 0.0331], [0.61, 0.42, -0.8],
        ];
        const PINS: [Vec3; 4] = [
            [-0.2113, 0.1404, -0.031], [0.2207, 0.1733, 0.0102], [0.0311, -0.2602, -0.0417], [0.05, 0.11, 0.07],
        ];
        const AXES: [Vec3; 4] = [[1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0]];
        const TURNS: [Scalar; 4] = [0.31, -0.52, 0.23, 2.9];
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw),
        }
        part legs: [strut; 4] = |i| strut {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    pub mod long_struts {
        const FEET: [Vec3; 4] =
            [[-0.8137, 0.2154, -0.7], [0.7411, 0.4023, -0.8712], [0.0612, -0.9027, -0.7669], [0.61, 0.42, -0.8]];
        const PINS: [Vec3; 4] = [
            [-0.2113, 0.1404, -0.031], [0.2207, 0.1733, 0.0102], [0.0311, -0.2602, -0.0417], [0.05, 0.11, 0.07],
        ];
        const AXES: [Vec3; 4] = [[1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0]];
        const TURNS: [Scalar; 4] = [0.31, -0.52, 0.23, 0.4];
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw),
        }
        part legs: [long_strut; 4] = |i| long_strut {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// The volume of a leg is that of two functions: the square of its length, and the cosine of the second angle.
    pub mod upright_struts {
        const FEET: [Vec3; 3] = [[-0.8137, 0.2154, -0.7], [0.7411, 0.4023, -0.8712], [0.0612, -0.9027, -0.7669]];
        const PINS: [Vec3; 3] = [[-0.2113, 0.1404, -0.031], [0.2207, 0.1733, 0.0102], [0.0311, -0.2602, -0.0417]];
        const AXES: [Vec3; 3] = [[1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0]];
        const TURNS: [Scalar; 3] = [0.31, -0.52, 0.23];
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(Quaternion),
        }
        part legs: [upright_strut; 3] = |i| upright_strut {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// The same of barrels, whose rows lie across the axes of all joints.
    pub mod turrets {
        const FEET: [Vec3; 3] = [[-0.8137, 0.2154, -0.7], [0.7411, 0.4023, -0.8712], [0.0612, -0.9027, -0.7669]];
        const PINS: [Vec3; 3] = [[-0.2113, 0.1404, -0.031], [0.2207, 0.1733, 0.0102], [0.0311, -0.2602, -0.0417]];
        const AXES: [Vec3; 3] = [[0.1, -1.0, 0.05], [-0.2, -1.0, 0.1], [0.1, -1.0, -0.3]];
        const TURNS: [Scalar; 3] = [1.1, 1.3, 0.9];
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw),
        }
        part legs: [turret; 3] = |i| turret {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// Every body by itself, with quaternions.
    pub mod free_struts {
        const FEET: [Vec3; 2] = [[-0.8137, 0.2154, 0.1], [0.7411, 0.4023, -0.0712]];
        const PINS: [Vec3; 2] = [[-0.2113, 0.1404, -0.031], [0.2207, 0.1733, 0.0102]];
        const AXES: [Vec3; 2] = [[1.0, 2.0, 0.3], [-0.4, 1.0, 0.2]];
        const TURNS: [Scalar; 2] = [0.31, -0.52];
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(Quaternion)
        }
        part legs: [strut; 2] = |i| strut {
            base: ground.at(FEET[i]).rotated(AXES[i], TURNS[i]),
            tip: plate.at(PINS[i]),
        };
        formulation { coordinates: Absolute(Quaternion) }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// Limbs of other kinds on one body: three hinges, a screw and a ball, a cylinder and a universal joint, a rod.
    pub mod limbs {
        /// [kg]
        param m = 0.4;
        world { gravity: [0.21, -0.34, -9.7] }
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw),
        }
        body thigh { mass: m, com: [0.21, 0.01, 0.02], inertia: diag(0.002 * m, 0.011 * m, 0.012 * m) }
        body shin { mass: m, com: [0.17, -0.02, 0.01], inertia: diag(0.001 * m, 0.008 * m, 0.009 * m) }
        body foot { mass: 0.2 * m, com: [0.01, 0.02, 0.03], inertia: diag(0.0004 * m, 0.0003 * m, 0.0005 * m) }
        body nut { mass: m, com: [0.01, 0.0, 0.2], inertia: diag(0.011 * m, 0.012 * m, 0.004 * m) }
        body boom { mass: m, com: [0.31, 0.02, 0.01], inertia: diag(0.004 * m, 0.021 * m, 0.022 * m) }
        body sleeve { mass: m, com: [0.02, 0.03, 0.11], inertia: diag(0.006 * m, 0.007 * m, 0.003 * m) }
        body collar { mass: m, com: [0.01, -0.02, 0.05], inertia: diag(0.003 * m, 0.003 * m, 0.002 * m) }
        joint hip: Revolute {
            parent: ground.at([0.9, 0.1, -0.2]).rotated([1.0, 0.4, 0.2], 0.7), child: thigh, axis: [0.1, 0.2, 1.0],
        }
        joint knee: Revolute { parent: thigh.at([0.5, 0.03, 0.02]), child: shin, axis: [0.2, 1.0, -0.1] }
        joint ankle: Revolute {
            parent: shin.at([0.45, -0.04, 0.0]).rotated(X, 0.4), child: foot, axis: [1.0, -0.2, 0.3],
        }
        #[cut] joint sole: Ball { parent: foot.at([0.1, 0.0, 0.05]), child: plate.at([0.3, 0.02, -0.1]) }
        joint thread: Screw {
            parent: ground.at([-0.7, 0.5, -0.3]).rotated([0.3, 1.0, 0.1], -0.4), child: nut, axis: Z, pitch: 0.07,
        }
        joint swing: Universal {
            parent: nut.at([0.1, 0.0, 0.2]), child: boom, axes: [[2.0, 1.0, 2.0], [1.0, 2.0, -2.0]],
        }
        #[cut] joint lug: Ball { parent: boom.at([0.6, 0.05, 0.0]), child: plate.at([-0.25, 0.12, 0.03]) }
        joint post: Cylindrical {
            parent: ground.at([0.1, -0.8, -0.6]).rotated([1.0, 0.1, -0.2], 0.2), child: sleeve, axis: Z,
        }
        joint yoke: Revolute { parent: sleeve.at([0.0, 0.02, 0.3]), child: collar, axis: [1.0, 0.3, 0.1] }
        constraint link: Rod { between: [collar.at([0.02, 0.05, 0.35]), plate.at([0.03, -0.2, 0.08])], length: 0.45 }
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// Two links of one length and a ball at their end: folded, the end stands on the first hinge.
    pub mod folded {
        param m = 0.6;
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw),
        }
        body upper { mass: m, com: [0.25, 0.01, 0.02], inertia: diag(0.002, 0.013, 0.014) }
        body lower { mass: m, com: [0.25, 0.02, -0.01], inertia: diag(0.002, 0.013, 0.014) }
        joint turn: Universal { parent: ground.rotated([1.0, 2.0, 2.0], 0.5), child: upper, axes: [Z, Y] }
        joint fold: Revolute { parent: upper.at(0.5 * X), child: lower, axis: Y }
        #[cut] joint end: Ball { parent: lower.at(0.5 * X), child: plate.at([0.1, 0.2, -0.1]) }
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// A strut whose length is a parameter: what is assumed of its stroke says little.
    pub mod lengthened {
        /// [m]
        param length = 0.9;
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw)
        }
        body cylinder { mass: 0.4, com: [0.013, -0.021, 0.47], inertia: diag(0.0063, 0.0071, 0.0022) }
        body piston { mass: 0.3, com: [0.003, 0.008, -0.52], inertia: diag(0.006, 0.0055, 0.0009) }
        joint gimbal: Universal { parent: ground.rotated([1.0, 2.0, 2.0], 0.5), child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(length * Z), child: piston, axis: Z }
        assume stroke > -0.6;
        #[cut] joint ball: Ball { parent: piston, child: plate.at([0.05, 0.11, 0.07]) }
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// Two slides, the second turned by a parameter that is zero by default, on a body that floats.
    pub mod turned {
        /// [rad]
        param tilt = 0.0;
        body plate {
            mass: 1.7, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw)
        }
        body base {
            mass: 3.1, com: [0.01, 0.02, -0.03], inertia: inertia(0.1, 0.12, 0.15, 0.01, -0.02, 0.03),
            coordinates: Absolute(RollPitchYaw)
        }
        body first { mass: 0.4, com: [0.1, 0.0, 0.0], inertia: diag(0.002, 0.003, 0.004) }
        body second { mass: 0.3, com: [0.0, 0.1, 0.0], inertia: diag(0.002, 0.003, 0.004) }
        joint along: Prismatic { parent: base.at([0.1, 0.2, 0.3]).rotated(X, 0.4), child: first, axis: X }
        joint across: Prismatic { parent: first.rotated(Z, tilt), child: second, axis: Y }
        #[cut] joint ball: Ball { parent: second.at([0.0, 0.2, 0.1]), child: plate.at([0.1, -0.2, 0.05]) }
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// Two points of a rod on slides that cross at a distance. As long as the rod they hold it in one place.
    pub mod trammel {
        /// [kg]
        param m = 0.3;
        /// [m]
        param distance = 0.6;
        body rod {
            mass: 1.7, com: [0.02, -0.01, 0.53], inertia: inertia(0.31, 0.33, 0.059, 0.002, -0.003, 0.004),
            coordinates: Absolute(RollPitchYaw)
        }
        body low { mass: m, com: [0.01, 0.0, 0.02], inertia: diag(0.01 * m, 0.02 * m, 0.02 * m) }
        body high { mass: m, com: [0.0, 0.01, 0.02], inertia: diag(0.01 * m, 0.02 * m, 0.02 * m) }
        joint floor: Prismatic { parent: ground.rotated([1.0, 2.0, 2.0], 0.5), child: low, axis: X }
        joint beam: Prismatic {
            parent: ground.rotated([1.0, 2.0, 2.0], 0.5).at(distance * Z).rotated(Z, 1.1), child: high, axis: X,
        }
        #[cut] joint heel: Ball { parent: low, child: rod }
        #[cut] joint head: Ball { parent: high, child: rod.at(Z) }
        formulation { constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias, impulse;
    }

    /// A slider-crank of rods that have no inertia about their lines, and of a point: which equations hold them there changes
    /// while it turns.
    pub mod thin {
        param mass = 1.0;
        param radius = 0.2;
        param length = 1.0;
        world { gravity: -9.81 * Y }
        body crank { mass: mass, com: 0.5 * radius * X, inertia: rod(mass, radius, X) }
        body rod { mass: mass, com: 0.5 * length * X, inertia: rod(mass, length, X) }
        body piston { mass: mass }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint pin: Revolute { parent: crank.at(radius * X), child: rod, axis: Z }
        joint guide: Prismatic { parent: ground, child: piston, axis: X }
        joint wrist: Revolute { parent: rod.at(length * X), child: piston, axis: Z }
        formulation { coordinates: Absolute(RollPitchYaw), constraints: Multipliers }
        emit forward_dynamics, mass_matrix, bias;
    }
}
