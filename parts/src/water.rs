//! Bodies in water, whose surface is `z = 0` of the world.

multibody::multibody! {
    /// The weight of the water that a hull of a given height puts aside, at its centre: all of it below the surface, none above,
    /// and in between as much as the share of the height that is under water.
    pub mod buoyancy {
        /// at the centre of the hull
        port hull: Frame;
        /// [m^3]
        param volume = 1e-3;
        /// [m]
        param height = 0.1;
        /// [kg/m^3]
        param density = 1000.0;
        /// [m/s^2]
        param gravity = 9.81;
        let share = max(min(0.5 - hull.position.z / height, 1.0), 0.0);
        /// [N]
        let lift = density * gravity * volume * share;
        force up: Force { at: hull, value: [0.0, 0.0, lift], axes: ground }
    }

    /// Drag under water, against the velocity of a point: `0.5 r c A |v| v`, with the damping `0.5 r c A v0 v` where `v` is small.
    ///
    /// S. F. Hoerner, Fluid-Dynamic Drag, 1965, section 1, for coefficients.
    pub mod water_drag {
        port point: Frame;
        /// `c A` [m^2]
        param area = 0.01;
        /// [kg/m^3]
        param density = 1000.0;
        /// [m/s]
        param passage = 0.01;
        let velocity = point.velocity;
        let speed = sqrt(dot(velocity, velocity) + passage * passage);
        let resistance = 0.5 * density * area * speed;
        /// [W]
        let loss = resistance * dot(velocity, velocity);
        force drag: Force { at: point, value: -resistance * velocity, axes: ground }
    }
}
