//! The classical Runge-Kutta method (Kutta 1901), on manifolds after Munthe-Kaas (1998).

use super::method::{Method, inherent};
use super::slope::{displaced, slope, stage};
use crate::{Real, System, Tangent};

/// The classical Runge-Kutta method: fourth order, four evaluations. The first choice for a fixed step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rk4;

impl Method for Rk4 {
    const ORDER: u32 = 4;
    const STAGES: u32 = 4;

    #[inline]
    fn step<S: System>(system: &S, t: S::Scalar, state: &S::State, input: &S::Input, dt: S::Scalar) -> S::State {
        let half = S::Scalar::lit(0.5) * dt;
        let k1 = slope(system, t, state, input);
        let k2 = stage(system, t + half, state, input, &k1.scale(half));
        let k3 = stage(system, t + half, state, input, &k2.scale(half));
        let k4 = stage(system, t + dt, state, input, &k3.scale(dt));
        let d = k1.add(&k4).add_scaled(S::Scalar::lit(2.0), &k2.add(&k3)).scale(S::Scalar::lit(1.0 / 6.0) * dt);
        system.accepted(t + dt, &displaced(state, &d), input)
    }
}

inherent!(Rk4);
