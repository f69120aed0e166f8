//! What stands between a vehicle and its wheels, and between these and the road.

multibody::multibody! {
    /// A spring and a damper of a strut: `push = -k (q - rest) - d q'`.
    pub mod suspension {
        port strut: Joint;
        /// N/m, or N m/rad
        param stiffness = 2.5e4;
        /// N s/m, or N m s/rad
        param damping = 1.5e3;
        /// where the spring is slack
        param rest = 0.0;
        let push = -stiffness * (strut - rest) - damping * strut.rate;
        /// J
        let energy = 0.5 * stiffness * (strut - rest) * (strut - rest);
        /// W
        let loss = damping * strut.rate * strut.rate;
        force effort: Effort { joint: strut, value: push }
    }

    /// The carcass of a tyre on a road: `load = k s + d s'` while it is pressed, `s = road - z` of the contact, never below zero.
    ///
    /// A spring with a damper, upwards alone. H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd edition, 2006, section 9.
    pub mod carcass {
        /// at the lowest point of the tyre without load
        port contact: Frame;
        /// [m] height of the road there
        port road: Scalar;
        /// [m/s] its rate
        port road_rate: Scalar;
        /// [N/m]
        param stiffness = 2e5;
        /// [N s/m]
        param damping = 50.0;
        let squeeze = road - contact.position.z;
        let rate = road_rate - contact.velocity.z;
        let pressed = max(squeeze, 0.0);
        /// [N] on the wheel
        let load = select(squeeze > 0.0, max(stiffness * squeeze + damping * rate, 0.0), 0.0);
        /// J
        let energy = 0.5 * stiffness * pressed * pressed;
        /// [W] by the road
        let power = load * road_rate;
        /// W
        let loss = (load - stiffness * pressed) * rate;
        force push: Force { at: contact, value: load * Z, axes: ground }
    }
}
