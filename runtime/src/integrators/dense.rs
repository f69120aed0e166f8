//! States within a step: [`Dense`].

use super::problem::Step;
use super::slope::{SlopeOf, displaced};
use crate::{Real, System, Tangent};

/// Greatest number of coefficients.
pub(super) const TERMS: usize = 8;

/// The states within one step, as a polynomial of the displacement from its start:
/// `d(c) = c (k1 + (1 - c) (k2 + c (k3 + (1 - c) (k4 + ..))))` with `c` from zero to one (Hairer, Norsett and Wanner,
/// Solving Ordinary Differential Equations I, section II.6, in the form of their programs).
pub struct Dense<S: System> {
    start: S::State,
    terms: [SlopeOf<S>; TERMS],
}

impl<S: System> Dense<S> {
    /// From the state at the start and the coefficients; those that are left out are zero.
    #[inline]
    pub fn new<const N: usize>(start: &S::State, coefficients: [SlopeOf<S>; N]) -> Self {
        let mut terms = [SlopeOf::<S>::zero(); TERMS];
        for (term, coefficient) in terms.iter_mut().zip(coefficients) {
            *term = coefficient;
        }
        Self { start: *start, terms }
    }

    /// The cubic through the displacement and the rates at both ends.
    #[inline]
    pub fn cubic(step: &Step<'_, S>, displacement: &SlopeOf<S>, first: &SlopeOf<S>, last: &SlopeOf<S>) -> Self {
        let minus = S::Scalar::lit(-1.0);
        let rise = first.scale(step.dt).add_scaled(minus, displacement);
        let fall = displacement.add_scaled(-step.dt, last).add_scaled(minus, &rise);
        Self::new(step.state, [*displacement, rise, fall])
    }

    /// The coefficients.
    #[inline]
    pub(super) const fn into_terms(self) -> [SlopeOf<S>; TERMS] {
        self.terms
    }

    /// The displacement from the start to the share `c` of the step.
    #[inline]
    pub fn displacement(&self, c: S::Scalar) -> SlopeOf<S> {
        let rest = S::Scalar::lit(1.0) - c;
        let mut sum = SlopeOf::<S>::zero();
        for (k, term) in self.terms.iter().enumerate().rev() {
            sum = sum.add(term).scale(if k % 2 == 0 { c } else { rest });
        }
        sum
    }

    /// The state at the share `c` of the step, from zero to one.
    #[inline]
    pub fn state(&self, c: S::Scalar) -> S::State {
        displaced(&self.start, &self.displacement(c))
    }
}
