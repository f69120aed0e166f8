//! Generated code finds every name without a prelude, and passes what users deny.
#![no_implicit_prelude]
#![deny(warnings, missing_docs, unused)]

::multibody::multibody! {
    /// A part.
    pub mod leg {
        /// Base.
        port base: Frame;
        /// [kg]
        param m = 1.0;
        body link { mass: m, com: X, inertia: diag(1.0, 1.0, 1.0) }
        joint knee: Revolute { parent: base, child: link, axis: Z }
    }
    /// A model.
    pub mod model {
        part legs: [leg; 2] = |i| leg { base: ground.at(i * X) };
        /// Input.
        input u;
        body b { mass: 1.0, com: X, inertia: diag(1.0, 1.0, 1.0) }
        joint j: Ball { parent: ground, child: b }
        /// State.
        state s: rate = u - s, start: 0.0;
        output b = b.position;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, impulse;
    }
}

fn main() {}
