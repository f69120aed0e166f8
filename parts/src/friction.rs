//! Friction.

multibody::multibody! {
    /// Friction in a joint, after Stribeck: from breakaway at rest down to Coulomb's, then viscous.
    ///
    /// `-(c + (s - c) exp(-(w / ws)^2)) tanh(w / w0) - b w`: smooth, so a joint under a load creeps by about `w0 load / s` in place of
    /// sticking. B. Armstrong-Helouvry, P. Dupont and C. Canudas de Wit, Automatica 30, 1994, pages 1083 to 1138.
    pub mod stribeck_friction {
        port joint: Joint;
        /// N m, or N
        param coulomb = 1.0;
        /// N m, or N: at rest
        param breakaway = 1.5;
        /// N m s/rad, or N s/m
        param viscous = 0.0;
        /// rad/s, or m/s: where friction has fallen from breakaway to about a third of the way above Coulomb's
        param stribeck = 0.1;
        /// rad/s, or m/s: where friction has grown to three quarters
        param passage = 0.001;
        let relative = joint.rate / stribeck;
        let dry = coulomb + (breakaway - coulomb) * exp(-relative * relative);
        let resistance = dry * tanh(joint.rate / passage) + viscous * joint.rate;
        /// W
        let loss = resistance * joint.rate;
        force friction: Effort { joint: joint, value: -resistance }
    }
}
