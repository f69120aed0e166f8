use multibody::multibody;

multibody! {
    /// A four-bar linkage whose equations are left to the compiler.
    pub mod automatic {
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(4.0 * X), child: rocker, axis: Z }
        #[cut]
        joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
        formulation { constraints: Auto }
    }
}
