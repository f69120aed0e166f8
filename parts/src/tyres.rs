//! Tyres. A wheel's carrier is a frame at the centre of the contact, x ahead, y to the left, z up.

multibody::multibody! {
    /// A tyre whose side force is a stiffness times the slip angle: `-k atan(vy / |vx|)`.
    ///
    /// `|vx|` is `sqrt(vx^2 + v0^2)`, so that the force at rest is damping. H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd edition,
    /// 2006, section 1.
    pub mod linear_tyre {
        port carrier: Frame;
        /// [N/rad]
        param stiffness = 6e4;
        /// [m/s]
        param passage = 0.1;
        let velocity = carrier.express(carrier.velocity);
        let ahead = sqrt(velocity.x * velocity.x + passage * passage);
        /// [rad]
        let slip = atan(velocity.y / ahead);
        /// [N] to the left
        let side = -stiffness * slip;
        force grip: Force { at: carrier, value: [0.0, side, 0.0], axes: carrier }
    }

    /// A tyre after the magic formula: `-D sin(C atan(B s - E (B s - atan(B s))))`, `D = friction * load`, `s` the slip angle.
    ///
    /// Pure side slip. H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd edition, 2006, section 4.3.
    pub mod magic_tyre {
        port carrier: Frame;
        /// [N] on the wheel
        port load: Scalar;
        param friction = 1.0;
        /// `B`, 1/rad
        param stiffness = 10.0;
        /// `C`
        param shape = 1.3;
        /// `E`
        param curvature = -1.0;
        /// [m/s]
        param passage = 0.1;
        let velocity = carrier.express(carrier.velocity);
        let ahead = sqrt(velocity.x * velocity.x + passage * passage);
        /// [rad]
        let slip = atan(velocity.y / ahead);
        let steep = stiffness * slip;
        /// [N] to the left
        let side = -friction * load * sin(shape * atan(steep - curvature * (steep - atan(steep))));
        force grip: Force { at: carrier, value: [0.0, side, 0.0], axes: carrier }
    }
}
