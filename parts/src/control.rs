//! Signals: controllers and filters.

multibody::multibody! {
    /// A controller with proportional, integral and filtered derivative action: `command = p e + i I + d (e - f) / T`, `I' = e`,
    /// `T f' = e - f`, `e = wanted - measured`.
    ///
    /// K. J. Astrom and T. Hagglund, Advanced PID Control, 2006, section 3.
    pub mod pid {
        port wanted: Scalar;
        port measured: Scalar;
        param proportional = 1.0;
        /// 1/s
        param integral = 0.0;
        /// s
        param derivative = 0.0;
        /// [s] of the filter
        param filter = 0.01;
        let error = wanted - measured;
        state sum: rate = error, start: 0.0;
        state filtered: rate = (error - filtered) / filter, start: 0.0;
        let command = proportional * error + integral * sum + derivative * (error - filtered) / filter;
    }

    /// Feedback of a joint's position and velocity: `command = k (wanted - q) + d (wanted' - q')`.
    pub mod servo {
        port joint: Joint;
        port wanted: Scalar;
        /// its rate
        port wanted_rate: Scalar;
        /// N m/rad, or N/m
        param stiffness = 100.0;
        /// N m s/rad, or N s/m
        param damping = 10.0;
        let command = stiffness * (wanted - joint) + damping * (wanted_rate - joint.rate);
    }

    /// A filter of first order: `T y' = u - y`.
    pub mod low_pass {
        port signal: Scalar;
        /// [s]
        param time = 0.1;
        state value: rate = (signal - value) / time, start: 0.0;
    }

    /// A filter of second order: `y'' + 2 z w y' + w^2 y = w^2 u`.
    pub mod second_order {
        port signal: Scalar;
        /// [rad/s]
        param frequency = 10.0;
        /// a share of the critical one
        param damping = 0.7;
        state value: rate = slope, start: 0.0;
        state slope: rate = frequency * frequency * (signal - value) - 2.0 * damping * frequency * slope, start: 0.0;
    }
    /// Feedback of the state of two joints: `command = feed - k1 (q1 - w1) - k2 (q2 - w2) - d1 q1' - d2 q2'`, a row of `u = -K x`.
    ///
    /// The gains come from poles or from weights, by `linearize` at the point of rest. B. D. O. Anderson and J. B. Moore, Optimal
    /// Control: Linear Quadratic Methods, 1990, section 2.
    pub mod state_feedback {
        port first: Joint;
        port second: Joint;
        /// where the joints are to rest
        port wanted_first: Scalar;
        port wanted_second: Scalar;
        /// what holds them there
        param feed = 0.0;
        /// of the positions, in the order of the joints
        param gains: [Scalar; 2] = [0.0, 0.0];
        /// of the rates
        param rate_gains: [Scalar; 2] = [0.0, 0.0];
        let of_positions = gains[0] * (first - wanted_first) + gains[1] * (second - wanted_second);
        let of_rates = rate_gains[0] * first.rate + rate_gains[1] * second.rate;
        let command = feed - of_positions - of_rates;
    }
}
