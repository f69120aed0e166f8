//! Several mistakes in one compile, each at its own token; what uses the model is not blamed.
use multibody::{Rk4, multibody};

multibody! {
    pub mod arm {
        param length = 1.0;
        world { gravity: -9.81 * Y }
        body upper { mass: 1.0, com: -0.5 * lenght * Y }
        body lower { mass: 1.0, com: -0.5 * Y, inertai: rod(1.0, 1.0, Y) }
        joint shoulder: Revolute { parent: ground, child: uper, axis: Z }
        joint elbow: Revolut { parent: upper.at(-Y), child: lower, axis: Z }
        output tip: Vec3 = lower.at(-Y).position;
        emit forward_dynamics, mass_matrx;
    }
}

fn main() {
    let model = arm::Model::<f64>::new(&arm::Params { length: 2.0 });
    let mut x = arm::State::default();
    x.q.shoulder = 0.1;
    let x = Rk4::step(&model, 0.0, &x, &(), 1e-3);
    println!("{}", model.outputs(0.0, &x, &()).tip.x);
}
