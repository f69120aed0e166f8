//! Impulses and momenta without forward dynamics, with and without each other, in a crate that denies warnings.
#![forbid(unsafe_code)]
#![deny(warnings, missing_docs)]

use multibody::multibody;
use multibody::nalgebra::SVector;

multibody! {
    /// Both, and nothing else.
    pub mod both {
        body bob { mass: 1.0, com: -Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit impulse, momentum;
    }
    /// Momenta alone.
    pub mod momenta {
        body block { mass: 2.0 }
        joint rail: Prismatic { parent: ground, child: block, axis: X }
        emit forward_dynamics, momentum;
    }
    /// A bead on a ring, with a multiplier.
    pub mod bead {
        body rider { mass: 0.5 }
        body bead { mass: 1.0 }
        joint x: Prismatic { parent: ground, child: rider, axis: X }
        joint y: Prismatic { parent: rider, child: bead, axis: Y }
        constraint ring = x.travel * x.travel + y.travel * y.travel - 1.0;
        emit impulse;
    }
}

fn main() {
    let push = both::Velocity { hinge: 3.0 };
    let model = both::Model::<f64>::default();
    assert_eq!(model.impulse(&both::Position::default(), &push).hinge, 3.0);
    assert_eq!(model.velocity(&both::Position::default(), &push).hinge, 3.0);
    let state = momenta::State { v: momenta::Velocity { rail: 1.5 }, ..Default::default() };
    assert_eq!(momenta::Model::<f64>::default().momentum(&state).rail, 3.0);
    let q = bead::Position { x: 0.6, y: 0.8 };
    let bead::Jump { v, rank, .. } =
        bead::Model::<f64>::default().impulse(&q, &bead::Velocity { x: 1.0, y: 0.0 }, &SVector::from([0.1]));
    assert!((2.0 * (q.x * v.x + q.y * v.y) - 0.1).abs() < 1e-15 && rank == 1.0);
}
