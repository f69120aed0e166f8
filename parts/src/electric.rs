//! Electric motors.

multibody::multibody! {
    /// A direct-current motor whose current follows its voltage at once: `i = (u - k w) / R`, torque `k i`.
    ///
    /// Right where the electric time constant `L / R` is short beside what the mechanism does; see `inductive_motor` for the other case.
    /// A. E. Fitzgerald, C. Kingsley and S. D. Umans, Electric Machinery, 6th edition, 2003, section 7.
    pub mod dc_motor {
        /// [rad] what it turns
        port shaft: Joint;
        /// [V]
        port supply: Scalar;
        /// [N m/A] the same number in V s/rad
        param constant = 0.05;
        /// [ohm]
        param resistance = 1.0;
        /// [A]
        let current = (supply - constant * shaft.rate) / resistance;
        /// [N m]
        let torque = constant * current;
        /// [W] what it draws
        let power = supply * current;
        /// [W] what heats the windings
        let loss = resistance * current * current;
        force drive: Effort { joint: shaft, value: torque }
    }

    /// A direct-current motor with inductance: `L i' = u - R i - k w`, torque `k i`.
    ///
    /// Fitzgerald, Kingsley and Umans, Electric Machinery, 6th edition, 2003, section 7.
    pub mod inductive_motor {
        /// [rad] what it turns
        port shaft: Joint;
        /// [V]
        port supply: Scalar;
        /// [N m/A] the same number in V s/rad
        param constant = 0.05;
        /// [ohm]
        param resistance = 1.0;
        /// [H]
        param inductance = 1e-3;
        /// [A]
        state current: rate = (supply - resistance * current - constant * shaft.rate) / inductance, start: 0.0;
        /// [N m]
        let torque = constant * current;
        /// [W] what it draws
        let power = supply * current;
        /// [W] what heats the windings
        let loss = resistance * current * current;
        /// [J] in the magnetic field
        let energy = 0.5 * inductance * current * current;
        force drive: Effort { joint: shaft, value: torque }
    }
}
