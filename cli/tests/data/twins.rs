multibody::multibody! {
    /// With joints.
    #[cfg(not(feature = "absolute"))]
    pub mod arm {
        body rod { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        formulation { coordinates: Joint }
    }
    /// With bodies, and one more.
    #[cfg(feature = "absolute")]
    pub mod arm {
        body rod { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
        body tip { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        joint wrist: Revolute { parent: rod, child: tip, axis: Y }
        formulation { coordinates: Absolute(Quaternion) }
    }
}
