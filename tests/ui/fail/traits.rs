//! Methods that need more than the model was asked for: each error names the word that `emit` lacks.
use multibody::{Rk4, multibody, simulate_stiff};

multibody! {
    pub mod forward {
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
    }
    pub mod inverse {
        body a { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        emit inverse_dynamics;
    }
}

fn main() {
    let state = inverse::State::<f64>::default();
    let _ = Rk4::step(&inverse::Model::default(), 0.0, &state, &(), 0.1);
    let state = forward::State::<f64>::default();
    let _ = simulate_stiff(&forward::Model::default(), 0.0, 1.0, &state, &(), 1e-6, |_, _| ());
}
