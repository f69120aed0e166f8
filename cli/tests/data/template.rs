macro_rules! pendulum {
    ($name:ident) => {
        multibody! {
            pub mod $name {
                body rod { mass: 2.0, com: -0.5 * Y, inertia: rod(2.0, 1.0, Y) }
                joint hinge: Revolute { parent: ground, child: rod, axis: Z }
                emit forward_dynamics;
            }
        }
    };
}
