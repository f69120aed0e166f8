//! Bodies whose mass follows states, and the same with parameters in their place.

use multibody::multibody;

/// A tank on an oblique arm: what its masses follow, and what else it declares.
macro_rules! arm {
    ($(#[$doc:meta])* $name:ident, { $($declared:tt)* }, $content:ident) => {
        multibody! {
            $(#[$doc])*
            pub mod $name {
                $($declared)*
                param dry = 0.4;
                input push;
                input burn;
                world { gravity: [1.0, -9.0, 2.0] }
                body boom { mass: 1.0, com: [0.3, 0.1, -0.2], inertia: inertia(0.06, 0.05, 0.04, 0.01, 0.02, -0.01) }
                body tank {
                    mass: dry + $content,
                    com: [0.1, 0.05 * $content, -0.1],
                    inertia: cylinder(dry + $content, 0.2 + 0.1 * $content, 0.7, [1.0, 2.0, 0.5])
                }
                joint shoulder: Screw { parent: ground, child: boom, axis: [1.0, 2.0, 0.5], pitch: 0.05, armature: 0.07 }
                joint elbow: Universal {
                    parent: boom.at([0.3, 0.1, 0.2]).rotated([1, 1, 0], 0.4), child: tank.at([0.1, 0, 0.2]), axes: [X, [0, 1, 1]]
                }
                force drag: Force { at: tank.at(X), value: (push - 0.3) * tank.velocity, axes: tank }
                output power = drag.power;
                output stored = kinetic() + potential();
                output centre = centre_of_mass();
                output momentum = linear_momentum();
                emit forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias, energy, derivatives, linearize,
                    impulse, centroidal_momentum_matrix;
                emit at { functions: [forward_dynamics, inverse_dynamics, mass_matrix, bias, kinetic_energy] };
            }
        }
    };
}

arm!(
    /// It empties.
    tank, { state fuel: rate = -burn * (1.0 + 0.1 * fuel), start: 0.8; }, fuel
);
arm!(
    /// It stays as it is.
    frozen, { param content = 0.8; }, content
);

multibody! {
    /// A robot on four legs, whose shins fill up, in packs.
    mod leg {
        port hip: Frame;
        param filling = 0.3;
        state water: rate = filling, start: 0.2;
        body thigh { mass: 0.8, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.15, 0.12, 0.01, -0.02, 0.015) }
        body shin { mass: 0.2 + water, com: [0.02, -0.01, -0.2], inertia: cuboid(0.2 + water, [0.1, 0.1, 0.4]) }
        joint swing: Universal { parent: hip, child: thigh, axes: [X, [0, 1, 1]] }
        joint knee: Revolute { parent: thigh.at(-0.5 * Z), child: shin, axis: [0, 1, 0.2] }
    }
    pub mod walker {
        world { gravity: -9.81 * Z }
        formulation { packs: Four }
        body trunk { mass: 5.0, inertia: diag(0.5, 0.6, 0.7) }
        joint float: Free { parent: ground, child: trunk }
        part legs: [leg; 4] = |i| leg { hip: trunk.at([0.3 * (1 - 2 * (i - 1) * (i - 2) / 2), 0.2 * i, 0.0]).rotated(Z, 0.4 * i) };
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    mod stiff_leg {
        port hip: Frame;
        param water = 0.2;
        body thigh { mass: 0.8, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.15, 0.12, 0.01, -0.02, 0.015) }
        body shin { mass: 0.2 + water, com: [0.02, -0.01, -0.2], inertia: cuboid(0.2 + water, [0.1, 0.1, 0.4]) }
        joint swing: Universal { parent: hip, child: thigh, axes: [X, [0, 1, 1]] }
        joint knee: Revolute { parent: thigh.at(-0.5 * Z), child: shin, axis: [0, 1, 0.2] }
    }
    /// With parameters, and without packs.
    pub mod stiff_walker {
        world { gravity: -9.81 * Z }
        body trunk { mass: 5.0, inertia: diag(0.5, 0.6, 0.7) }
        joint float: Free { parent: ground, child: trunk }
        part legs: [stiff_leg; 4] = |i| stiff_leg {
            hip: trunk.at([0.3 * (1 - 2 * (i - 1) * (i - 2) / 2), 0.2 * i, 0.0]).rotated(Z, 0.4 * i)
        };
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
}

multibody! {
    /// Straight up in a vacuum, with the fuel that was burnt as a state.
    pub mod rocket {
        param exhaust = 2500.0;
        input flow;
        state burnt: rate = flow, start: 0.0;
        body hull { mass: 1000.0 - burnt, com: (0.5 - 0.001 * burnt) * Z, inertia: cylinder(1000.0 - burnt, 0.5, 4.0, Z) }
        joint rail: Prismatic { parent: ground, child: hull, axis: Z }
        force thrust: Force { at: hull, value: exhaust * flow * Z, axes: hull }
        emit forward_dynamics, derivatives;
    }
    /// A tumbling body that loses mass evenly, and one that loses none: nothing of their motion differs.
    pub mod tumbling {
        state share: rate = -0.4 * share, start: 1.0;
        body leaking {
            mass: 2.0 * share, com: [0.1, 0.2, -0.3],
            inertia: inertia(0.5 * share, 0.6 * share, 0.8 * share, 0.02 * share, -0.03 * share, 0.01 * share)
        }
        body tight { mass: 2.0, com: [0.1, 0.2, -0.3], inertia: inertia(0.5, 0.6, 0.8, 0.02, -0.03, 0.01) }
        joint first: Free { parent: ground, child: leaking }
        joint second: Free { parent: ground, child: tight }
        output spins = [angular_momentum([leaking]), angular_momentum([tight])];
        emit forward_dynamics;
    }
    /// What the energy changes by: the power of the force, and what the mass that leaves takes with it.
    pub mod balanced {
        state fuel: rate = -0.2 * fuel, start: 0.8;
        world { gravity: [1.0, -9.0, 2.0] }
        body boom { mass: 1.0, com: [0.3, 0.1, -0.2], inertia: inertia(0.06, 0.05, 0.04, 0.01, 0.02, -0.01) }
        body tank { mass: 0.4 + fuel, com: [0.1, 0.05 * fuel, -0.1], inertia: sphere(0.4 + fuel, 0.2 + 0.1 * fuel) }
        joint shoulder: Revolute { parent: ground, child: boom, axis: [1.0, 2.0, 0.5] }
        joint elbow: Universal { parent: boom.at([0.3, 0.1, 0.2]), child: tank, axes: [X, [0, 1, 1]] }
        let drag = -0.3 * tank.velocity;
        force brake: Force { at: tank, value: drag, axes: ground }
        state fed: rate = dot(drag, tank.velocity) - 0.2 * fuel * diff(kinetic() + potential(), fuel), start: 0.0;
        output stored = kinetic() + potential();
        output pull = tank.at([0.1, 0.04, -0.1]).velocity;
        emit forward_dynamics;
    }
}
