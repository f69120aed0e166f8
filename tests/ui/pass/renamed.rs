//! The runtime under another name.
extern crate multibody as mb;

mb::multibody! {
    #![krate(::mb)]
    pub mod pendulum {
        param l = 1.0;
        world { gravity: -9.81 * Y }
        body bob { mass: 1.0, com: -l * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        output tip = bob.at(-l * Y).pose;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

mb::multibody! {
    pub mod found_by_itself {
        body block { mass: 2.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
    }
}

mod multibody {
    //! A module that has the name by chance.
}

fn main() {
    let model = pendulum::Model::<f64>::new(&pendulum::Params::default());
    let mut x = pendulum::State::default();
    x.q.hinge = 0.5;
    assert_eq!(found_by_itself::DOF, 1);
    assert!(mb::Rk4::step(&model, 0.0, &x, &(), 1e-3).v.hinge < 0.0);
}
