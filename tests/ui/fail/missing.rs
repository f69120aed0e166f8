//! Functions that were not asked for, and a model without mistakes beside one with: one error each.
use multibody::multibody;

multibody! {
    pub mod good {
        body a { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body b { mass: 1.0, com: X, inertia: rod(1.0, 3.0, X) }
        body c { mass: 1.0, inertia: rod(1.0, 2.0, X) }
        joint ja: Revolute { parent: ground, child: a, axis: Z }
        joint jb: Revolute { parent: a.at(X), child: b, axis: Z }
        joint jc: Revolute { parent: ground.at(3 * X), child: c, axis: Z }
        joint jd: Revolute { parent: b.at(3 * X), child: c.at(2 * X), axis: Z }
        output p = c.position;
    }
    pub mod bad {
        body a { mass: 1.0, cmo: X }
        joint x: Prismatic { parent: ground, child: a, axis: X }
        output v = 2.0 * a.velocity;
    }
}

fn main() {
    let q = good::Position { ja: 0.1, jb: 0.2, jc: 0.3 };
    let model = good::Model::<f64>::default();
    let s = good::State { q, ..Default::default() };
    println!("{:?}", model.outputs(0.0, &s, &()).p.iter().next());
    println!("{}", model.mass_matrix(&s.q)[(0, 0)] + model.kinetic_energy(&s));
    let state = bad::State::default();
    println!("{}", bad::Model::<f64>::default().outputs(0.0, &state, &()).v.norm() + state.q.x);
}
