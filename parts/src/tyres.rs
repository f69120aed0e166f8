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
    /// A tyre that is driven and slides aside at once: the magic formula of the theoretical slip, against the direction of sliding.
    ///
    /// `F = -D sin(C atan(B s - E (B s - atan(B s)))) w / s`, `D = friction * load`, `w = (vx - r n, vy) / |r n|`, `s = |w|`, `n` the
    /// wheel's speed. Alike in all directions. Theoretical slip: H. B. Pacejka, Tyre and Vehicle Dynamics, 2nd edition, 2006, section 3.2;
    /// with the formula: E. Bakker, L. Nyborg and H. B. Pacejka, SAE paper 870421, 1987.
    pub mod combined_tyre {
        port carrier: Frame;
        /// of the wheel, about y of the carrier
        port spin: Joint;
        /// [N] on the wheel
        port load: Scalar;
        /// [m]
        param radius = 0.3;
        param friction = 1.0;
        /// `B`
        param stiffness = 10.0;
        /// `C`
        param shape = 1.3;
        /// `E`
        param curvature = -1.0;
        /// [m/s]
        param passage = 0.1;
        let velocity = carrier.express(carrier.velocity);
        let rolling = radius * spin.rate;
        let sliding = [velocity.x - rolling, velocity.y, 0.0];
        let speed = sqrt(rolling * rolling + passage * passage);
        // Never zero, so that the direction of no slip is none.
        let slip = sqrt(dot(sliding, sliding) / (speed * speed) + 1e-16);
        let steep = stiffness * slip;
        let grip = friction * load * sin(shape * atan(steep - curvature * (steep - atan(steep))));
        /// [N] ahead, to the left
        let push = -grip / (slip * speed) * sliding;
        /// W
        let loss = -dot(push, sliding);
        force contact: Force { at: carrier, value: push, axes: carrier }
        force drag: Effort { joint: spin, value: -radius * push.x }
    }
}
