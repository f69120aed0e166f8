multibody::multibody! {
    /// Four bars whose loop Newton's method closes.
    pub mod four_bar {
        body crank { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.2, X) }
        body coupler { mass: 1.0, com: 0.3 * X, inertia: rod(1.0, 0.6, X) }
        body rocker { mass: 1.0, com: 0.2 * X, inertia: rod(1.0, 0.4, X) }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint pin: Revolute { parent: crank.at(0.2 * X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(0.5 * X), child: rocker, axis: Z }
        #[cut]
        joint wrist: Revolute { parent: coupler.at(0.6 * X), child: rocker.at(0.4 * X), axis: Z }
        formulation { constraints: Reduced, independent: [shaft] }
        emit forward_dynamics;
    }
}
