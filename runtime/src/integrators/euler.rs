//! The explicit Euler method.

use super::method::{Method, inherent};
use super::slope::{displaced, slope};
use crate::{System, Tangent};

/// The explicit Euler method: first order, one evaluation. Energy grows; a reference, seldom a choice.
#[derive(Clone, Copy, Debug, Default)]
pub struct Euler;

impl Method for Euler {
    const ORDER: u32 = 1;
    const STAGES: u32 = 1;

    #[inline]
    fn step<S: System>(system: &S, t: S::Scalar, state: &S::State, input: &S::Input, dt: S::Scalar) -> S::State {
        let d = slope(system, t, state, input).scale(dt);
        system.accepted(t + dt, &displaced(state, &d), input)
    }
}

inherent!(Euler);
