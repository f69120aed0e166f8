//! Methods with steps of a given length: [`Method`], and the loop over such steps.

use super::error::IntegrationError;
use super::slope::{is_finite, magnitude};
use crate::{Real, System};

/// A one-step method with a given step.
///
/// `step` and `integrate` exist on every method itself, so that the trait is needed only to write code for any method.
pub trait Method {
    /// Order of convergence.
    const ORDER: u32;
    /// Evaluations of the system in each step.
    const STAGES: u32;

    /// The state after one step of `dt` `[s]` from the time `t` `[s]`, with the input held.
    fn step<S: System>(system: &S, t: S::Scalar, state: &S::State, input: &S::Input, dt: S::Scalar) -> S::State;

    /// The state after `steps` steps of `dt` `[s]`, with the input held throughout.
    ///
    /// `observe` is called after every step with the time and the state. Time is `t0 + k * dt` and does not drift.
    ///
    /// # Errors
    /// [`IntegrationError::NonFinite`] as soon as the state is infinite or NaN (in any lane).
    fn integrate<S: System>(
        system: &S,
        t0: S::Scalar,
        state: &S::State,
        input: &S::Input,
        dt: S::Scalar,
        steps: u32,
        mut observe: impl FnMut(S::Scalar, &S::State),
    ) -> Result<S::State, IntegrationError> {
        let mut state = *state;
        let mut t = t0;
        for k in 1..=steps {
            let next = Self::step(system, t, &state, input, dt);
            if !is_finite(&magnitude(&next)) {
                return Err(IntegrationError::NonFinite { time: t.greatest() });
            }
            state = next;
            t = t0 + S::Scalar::lit(f64::from(k)) * dt;
            observe(t, &state);
        }
        Ok(state)
    }
}

/// The functions of [`Method`] on the method itself, callable without importing the trait.
macro_rules! inherent {
    ($method:ident) => {
        impl $method {
            /// The state after one step of `dt` `[s]` from the time `t` `[s]`, with the input held.
            #[inline]
            pub fn step<S: $crate::System>(
                system: &S,
                t: S::Scalar,
                state: &S::State,
                input: &S::Input,
                dt: S::Scalar,
            ) -> S::State {
                <Self as $crate::integrators::Method>::step(system, t, state, input, dt)
            }

            /// The state after `steps` steps of `dt` `[s]`, with the input held throughout.
            ///
            /// `observe` is called after every step with the time and the state. Time is `t0 + k * dt` and does not
            /// drift.
            ///
            /// # Errors
            /// [`IntegrationError::NonFinite`](crate::IntegrationError) as soon as the state is infinite or NaN (in any
            /// lane).
            pub fn integrate<S: $crate::System>(
                system: &S,
                t0: S::Scalar,
                state: &S::State,
                input: &S::Input,
                dt: S::Scalar,
                steps: u32,
                observe: impl FnMut(S::Scalar, &S::State),
            ) -> Result<S::State, $crate::IntegrationError> {
                <Self as $crate::integrators::Method>::integrate(system, t0, state, input, dt, steps, observe)
            }
        }
    };
}

pub(super) use inherent;
