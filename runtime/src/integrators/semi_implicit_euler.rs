//! The semi-implicit (symplectic) Euler method (Hairer, Lubich and Wanner, section I.1.2).

use super::method::{Method, inherent};
use super::slope::{displaced, slope};
use crate::{System, Tangent};

/// The semi-implicit Euler method: first order, one evaluation. New velocities move the position, so that the energy
/// of a conservative system stays bounded; the method of games and of hard real time.
#[derive(Clone, Copy, Debug, Default)]
pub struct SemiImplicitEuler;

impl Method for SemiImplicitEuler {
    const ORDER: u32 = 1;
    const STAGES: u32 = 1;

    #[inline]
    fn step<S: System>(system: &S, t: S::Scalar, state: &S::State, input: &S::Input, dt: S::Scalar) -> S::State {
        let mut slope = slope(system, t, state, input);
        slope.q = slope.q.add_scaled(dt, &slope.v);
        system.accepted(t + dt, &displaced(state, &slope.scale(dt)), input)
    }
}

inherent!(SemiImplicitEuler);
