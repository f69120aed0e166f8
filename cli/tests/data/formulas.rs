multibody::multibody! {
    /// How far a crank pushes a rod.
    mod linkage {
        formulation { constraints: Reduced }
        param arm = 0.1;
        body crank { mass: 0.2, inertia: diag(1e-3, 1e-3, 1e-3) }
        body link { mass: 0.1, com: 0.15 * X, inertia: rod(0.1, 0.3, X) }
        body rod { mass: 0.3 }
        joint turn: Revolute { parent: ground, child: crank, axis: Z }
        joint elbow: Revolute { parent: crank.at(arm * X), child: link, axis: Z }
        joint push: Prismatic { parent: ground, child: rod, axis: X }
        #[cut]
        joint pin: Revolute { parent: link.at(0.3 * X), child: rod, axis: Z }
        solve (elbow, push) from pin { push > 0.0 }
    }
    /// A load on springs, on a table that such a linkage moves.
    pub mod shaker {
        body table { mass: 5.0 }
        body load { mass: 1.0 }
        joint guide: Prismatic { parent: ground, child: table, axis: X }
        joint feet: Prismatic { parent: table, child: load, axis: X }
        force springs: SpringDamper { joint: feet, stiffness: 4e3, damping: 10.0 }
        drive guide = linkage(push, turn = 60.0 * t, arm = 0.02);
        emit forward_dynamics;
    }
}
