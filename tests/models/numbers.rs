//! Mechanisms that have every function, for the edges of what numbers can do.

use multibody::multibody;

multibody! {
    /// A ball joint with an arm, a motor with a state, and a spring: everything of an open tree.
    pub mod tree {
        /// [kg]
        param m = 1.3;
        /// [N/m]
        param stiffness = 20.0;
        input torque;
        world { gravity: -9.81 * Z }
        body trunk { mass: m, com: -0.4 * Z, inertia: diag(0.1, 0.12, 0.05) }
        body arm { mass: 0.4, com: 0.3 * X, inertia: rod(0.4, 0.6, X) }
        joint base: Ball { parent: ground, child: trunk }
        joint elbow: Revolute { parent: trunk.at(-0.8 * Z), child: arm, axis: [0.0, 1.0, 1.0] }
        force motor: Effort { joint: elbow, value: lag }
        force band: Spring { between: [arm.at(0.6 * X), ground.at([1.0, 0.5, -0.5])], stiffness: stiffness, length: 0.2 }
        state lag: rate = torque - 2.0 * lag, start: 0.1;
        output tip = arm.at(0.6 * X).position;
        output power = band.power;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, impulse, derivatives, linearize;
    }
    /// A four-bar that keeps its equations.
    pub mod kept {
        formulation { constraints: Multipliers }
        world { gravity: -9.81 * Y }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque }
        output load = pin.reaction.force;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, constraints, residual, impulse, derivatives;
    }
}
