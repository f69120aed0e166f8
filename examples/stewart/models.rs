//! The manipulator's models, all from one declaration: what a call adds is its formulation, what it drives, and what it emits.

use multibody::multibody;

/// [m] of the universal joints, in the world. The models below have the same numbers.
pub(crate) const FEET: [[f64; 3]; 6] = [
    [-2.12, 1.374, 0.0],
    [-2.38, 1.224, 0.0],
    [-2.38, -1.224, 0.0],
    [-2.12, -1.374, 0.0],
    [0.0, -0.15, 0.0],
    [0.0, 0.15, 0.0],
];
/// [m] of the ball joints, in the plate's axes
pub(crate) const PINS: [[f64; 3]; 6] = [
    [0.17, 0.595, -0.4],
    [-0.6, 0.15, -0.4],
    [-0.6, -0.15, -0.4],
    [0.17, -0.595, -0.4],
    [0.43, -0.445, -0.4],
    [0.43, 0.445, -0.4],
];
/// [rad] of each leg's first axis
pub(crate) const HEADING: [f64; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];

/// A Stewart-Gough platform with the dimensions of Tsai's book: six legs under one rigid plate. Each leg is a universal
/// joint on the ground, a driven stroke and a ball joint under the plate. `leg` takes what a leg has beside that,
/// `platform` what the manipulator has.
macro_rules! manipulator {
    ($(#[$docs:meta])* $name:ident { leg: { $($leg:tt)* } platform: { $($platform:tt)* } }) => {
        multibody! {
            /// One leg. Its length is one metre plus the stroke.
            mod leg {
                port base: Frame;
                port tip: Frame;
                /// [N] pushes the tip away from the base
                input thrust;
                body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
                body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
                joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
                joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z }
                #[cut]
                joint ball: Ball { parent: piston, child: tip }
                force actuator: Effort { joint: stroke, value: thrust }
                $($leg)*
            }
            $(#[$docs])*
            pub(crate) mod $name {
                /// [m] of the universal joints, in the world
                const FEET: [Vec3; 6] = [
                    [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0],
                    [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0],
                ];
                /// [m] of the ball joints, in the plate's axes
                const PINS: [Vec3; 6] = [
                    [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4],
                    [0.17, -0.595, -0.4], [0.43, -0.445, -0.4], [0.43, 0.445, -0.4],
                ];
                /// [rad] of each leg's first axis
                const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
                world { gravity: -9.80665 * Z }
                body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
                part legs: [leg; 6] = |i| leg {
                    base: ground.at(FEET[i]).rotated(Z, HEADING[i]),
                    tip: platform.at(PINS[i]),
                };
                $($platform)*
            }
        }
    };
}

manipulator! {
    /// All bodies absolute: six coordinates each, and all joints are equations.
    absolute {
        leg: {}
        platform: {
            formulation { coordinates: Absolute(RollPitchYaw), constraints: Multipliers }
            emit constraints;
        }
    }
}

manipulator! {
    /// The plate absolute, the legs relative to the ground.
    hybrid {
        leg: {}
        platform: {
            formulation { constraints: Multipliers }
            output energy = kinetic() + potential();
            emit forward_dynamics, constraints, residual;
        }
    }
}

manipulator! {
    /// Joint coordinates alone: the plate hangs on one of the legs.
    joints {
        leg: {}
        platform: {
            formulation { coordinates: Joint, constraints: Multipliers }
            emit constraints;
        }
    }
}

manipulator! {
    /// Solved in closed form: the pose of the plate is all the state there is.
    reduced {
        leg: {
            solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
        }
        platform: {
            formulation { constraints: Reduced }
            output energy = kinetic() + potential();
            emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust },
                kinematics { given: platform.pose, find: legs.stroke },
                kinematics { given: platform.pose, find: [legs.gimbal, legs.stroke] },
                equations;
        }
    }
}

manipulator! {
    /// The same, its plate kept level.
    level {
        leg: {
            solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
        }
        platform: {
            formulation { constraints: Reduced }
            drive platform.orientation = identity();
            emit inverse_dynamics { solve_for: legs.thrust };
        }
    }
}

manipulator! {
    /// The same without a formula: Newton's method on each leg's three equations.
    iterated {
        leg: {}
        platform: {
            formulation { constraints: Reduced }
        }
    }
}

multibody! {
    /// The three equations of one leg, everything about it adjustable, its pin anywhere.
    pub(crate) mod one_leg {
        /// [m]
        param foot: Vec3 = [-2.12, 1.374, 0.0];
        /// [rad]
        param heading = -0.75;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        joint gimbal: Universal { parent: ground.at(foot).rotated(Z, heading), child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: plate }
        formulation { constraints: Multipliers }
        emit constraints, equations;
    }
}
