//! A model with parts inside a function body, twice the same name.
use multibody::multibody;

fn first() -> f64 {
    multibody! {
        mod limb {
            port base: Frame;
            param m = 0.5;
            body rod { mass: m, com: -0.5 * Z, inertia: rod(m, 1.0, Z) }
            joint hinge: Revolute { parent: base, child: rod, axis: Y }
        }
        mod model {
            world { gravity: -9.81 * Z }
            part limbs: [limb; 2] = |i| limb { base: ground.at(i * X) };
            emit forward_dynamics, energy;
        }
    }
    let model = model::Model::<f64>::new(&model::Params::default());
    let mut x = model::State::default();
    x.q.limbs[1].hinge = 0.3;
    model.forward_dynamics(0.0, &x, &()).limbs[1].hinge
}

fn second() -> f64 {
    multibody! {
        mod model {
            body block { mass: 2.0 }
            joint rail: Prismatic { parent: ground, child: block, axis: X }
            force spring: Spring { joint: rail, stiffness: 8.0 }
        }
    }
    let model = model::Model::<f64>::new(&model::Params::default());
    let mut x = model::State::default();
    x.q.rail = 1.0;
    model.forward_dynamics(0.0, &x, &()).rail
}

fn main() {
    assert!((first() + 1.5 * 9.81 * 0.3_f64.sin()).abs() < 1e-12);
    assert_eq!(second(), -4.0);
}
