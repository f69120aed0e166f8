//! A wheel with the brake of another file.

multibody::multibody! {
    use crate::brakes::brake;
    pub mod wheel {
        body disc { mass: 1.0, inertia: diag(1.0, 1.0, 2.0) }
        joint turn: Revolute { parent: ground, child: disc, axis: Z }
        part stop: brake { hinge: turn };
    }
}
