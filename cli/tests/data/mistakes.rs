//! Two mistakes of the model, one of its mechanics.
use multibody::multibody;

multibody! {
    pub mod pendulum {
        param length = 1.0;
        body rod { mass: 2.0, com: -0.5 * lenght * Y, inertia: rod(2.0, length, Y) }
        joint hinge: Revolut { parent: ground, child: rod, axis: Z }
        emit forward_dynamics;
    }
}

multibody! {
    pub mod point {
        body bead { mass: 1.0 }
        joint hinge: Revolute { parent: ground, child: bead, axis: Z }
        emit forward_dynamics;
    }
}
