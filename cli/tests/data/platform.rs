multibody! {
    mod leg {
        port base: Frame;
        port tip: Frame;
        /// [N] pushes the tip away from the base
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }
    /// The Stewart-Gough manipulator with Tsai's data, whose legs are computed together.
    pub mod platform {
        const FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0], [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0],
            [0.0, 0.15, 0.0],
        ];
        const PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4], [0.17, -0.595, -0.4], [0.43, -0.445, -0.4],
            [0.43, 0.445, -0.4],
        ];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced, packs: Four }
        body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) };
        emit forward_dynamics;
    }
}
