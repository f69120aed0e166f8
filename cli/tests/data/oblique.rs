use multibody::multibody;

multibody! {
    /// Frames that stand across all coordinate axes: `x < y & "z"` is no tag.
    pub mod oblique {
        /// [m] of the rope; <b>not bold</b>
        param rope_length = 2.0;
        body anchor { mass: 2.0, inertia: diag(0.1, 0.2, 0.3) }
        body hull { mass: 1.0, com: 0.1 * Z, inertia: diag(0.1, 0.1, 0.1) }
        body strap { mass: 0.5, inertia: diag(0.01, 0.01, 0.02) }
        joint first: Cylindrical { parent: ground.at(X).rotated(Z, atan2(3.0, 4.0)), child: anchor, axis: Z }
        joint second: Revolute { parent: anchor.at([0.5, 0.0, 0.25]), child: hull, axis: [1.0, 1.0, 0.0] }
        joint mooring: Ball { parent: hull.at(Y), child: strap }
        constraint rope: Rod { between: [ground.at([0.8, 1.1, 2.25]), hull.at(Y)], length: rope_length }
        emit forward_dynamics;
    }
}
