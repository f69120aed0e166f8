//! The ends of a travel.

multibody::multibody! {
    /// Rubber at both ends of a joint's range: nothing inside, `-s d^2` at a depth `d` beyond, with damping `c d q'`.
    ///
    /// Force and damping start with slope zero, so integrators see no kink, and no force ever pulls while the joint leaves slower
    /// than `s d / c`. K. H. Hunt and F. R. E. Crossley, Journal of Applied Mechanics 42, 1975, pages 440 to 445, for the damping.
    pub mod bump_stops {
        port joint: Joint;
        /// rad, or m
        param lower = -1.0;
        /// rad, or m
        param upper = 1.0;
        /// N m/rad^2, or N/m^2
        param stiffness = 1e4;
        /// N m s/rad^2, or N s/m^2
        param damping = 0.0;
        let above = max(joint - upper, 0.0);
        let below = max(lower - joint, 0.0);
        let damped = damping * (above + below) * joint.rate;
        /// J
        let energy = stiffness * (above * above * above + below * below * below) / 3.0;
        /// W
        let loss = damped * joint.rate;
        force stops: Effort { joint: joint, value: stiffness * (below * below - above * above) - damped }
    }
}
