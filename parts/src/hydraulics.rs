//! Hydraulics.

multibody::multibody! {
    /// A cylinder with a rod on one side, and the valve that feeds it, with compressible oil.
    ///
    /// `(Va / B) pa' = qa - A v - l`, `(Vb / B) pb' = qb + a v + l`, `Va = V0 + A x`, `Vb = V0 + a (stroke - x)`, leakage `l = g (pa - pb)`.
    /// An opening of the spool above zero feeds the side of the piston and drains that of the rod. An orifice lets `c u f(dp)` pass, `f` the
    /// root of the pressure over it with its sign, smooth below `passage`: `dp / (dp^2 + p0^2)^(1/4)`. The joint is the travel `x` of the rod,
    /// zero where it is in. H. E. Merritt, Hydraulic Control Systems, 1967, sections 3, 5 and 6.
    pub mod hydraulic_cylinder {
        /// [m] from 0 to `stroke`
        port rod: Joint;
        /// from -1 to 1
        port spool: Scalar;
        /// [m]
        param stroke = 0.5;
        /// [m^2] of the piston
        param piston = 2e-3;
        /// [m^2] of the ring beside the rod
        param ring = 1.2e-3;
        /// [m^3] of oil behind each side where it is shortest
        param dead = 1e-4;
        /// [Pa]
        param bulk = 1.2e9;
        /// [Pa]
        param supply = 2e7;
        /// [Pa]
        param tank = 0.0;
        /// m^3/(s Pa^0.5): of the whole opening
        param valve = 2e-7;
        /// [m^3/(s Pa)] past the piston
        param leak = 0.0;
        /// [Pa]
        param passage = 1e4;
        let f(dp) = dp / sqrt(sqrt(dp * dp + passage * passage));
        let out = max(spool, 0.0);
        let in_again = max(-spool, 0.0);
        /// [m^3/s] to the side of the piston
        let flow_a = valve * (out * f(supply - pressure_a) - in_again * f(pressure_a - tank));
        /// [m^3/s] to the side of the rod
        let flow_b = valve * (in_again * f(supply - pressure_b) - out * f(pressure_b - tank));
        /// [m^3/s]
        let leakage = leak * (pressure_a - pressure_b);
        /// [Pa]
        state pressure_a: rate = bulk * (flow_a - piston * rod.rate - leakage) / (dead + piston * rod), start: 0.0;
        /// [Pa]
        state pressure_b: rate = bulk * (flow_b + ring * rod.rate + leakage) / (dead + ring * (stroke - rod)), start: 0.0;
        /// [N]
        let push = piston * pressure_a - ring * pressure_b;
        force thrust: Effort { joint: rod, value: push }
    }
}
