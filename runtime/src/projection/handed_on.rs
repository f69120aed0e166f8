//! What a wrapper leaves as it is: traits handed on to the system that it holds.

/// Implements traits for a wrapper of a constrained system by those of its field `system`.
macro_rules! handed_on {
    ($type:ty, $parameters:tt, $($trait:ident),*) => {
        $(handed_on!(@$trait $type, $parameters);)*
    };
    (@Constrained $type:ty, [$($parameter:tt)*]) => {
        impl<S: Constrained, $($parameter)*> Constrained for $type {
            type Residual = S::Residual;

            #[inline]
            fn constraints(&self, t: S::Scalar, q: &PositionOf<S>) -> S::Residual {
                self.system.constraints(t, q)
            }
            #[inline]
            fn constraint_rate(&self, t: S::Scalar, state: &S::State) -> S::Residual {
                self.system.constraint_rate(t, state)
            }
            #[inline]
            fn tells_crossings(&self) -> bool {
                self.system.tells_crossings()
            }
            #[inline]
            fn correction(
                &self,
                t: S::Scalar,
                state: &S::State,
                residual: &S::Residual,
                weights: &DisplacementOf<S>,
            ) -> (DisplacementOf<S>, S::Scalar) {
                self.system.correction(t, state, residual, weights)
            }
            #[inline]
            fn velocity_correction(
                &self,
                t: S::Scalar,
                state: &S::State,
                residual: &S::Residual,
                weights: &VelocityOf<S>,
            ) -> (VelocityOf<S>, S::Scalar) {
                self.system.velocity_correction(t, state, residual, weights)
            }
            #[inline]
            fn constraints_along(&self, t: S::Scalar, state: &S::State, d: &DisplacementOf<S>) -> S::Residual {
                self.system.constraints_along(t, state, d)
            }
            #[inline]
            fn constraint_rate_along(&self, t: S::Scalar, state: &S::State, d: &VelocityOf<S>) -> S::Residual {
                self.system.constraint_rate_along(t, state, d)
            }
            #[inline]
            fn least_correction(
                &self,
                t: S::Scalar,
                state: &S::State,
                residual: &S::Residual,
            ) -> Option<(DisplacementOf<S>, S::Scalar)> {
                self.system.least_correction(t, state, residual)
            }
            #[inline]
            fn least_velocity_correction(
                &self,
                t: S::Scalar,
                state: &S::State,
                residual: &S::Residual,
            ) -> Option<(VelocityOf<S>, S::Scalar)> {
                self.system.least_velocity_correction(t, state, residual)
            }
        }
    };
    (@Impulsive $type:ty, [$($parameter:tt)*]) => {
        impl<S: Constrained + Impulsive, $($parameter)*> Impulsive for $type {
            type Rates = S::Rates;

            #[inline]
            fn jump(
                &self,
                t: S::Scalar,
                state: &S::State,
                impulse: &VelocityOf<S>,
                rates: &S::Rates,
            ) -> (VelocityOf<S>, S::Scalar) {
                self.system.jump(t, state, impulse, rates)
            }
        }
    };
    (@Differentiable $type:ty, [$($parameter:tt)*]) => {
        impl<S: Constrained + Differentiable, $($parameter)*> Differentiable for $type {
            type Matrix = S::Matrix;

            #[inline]
            fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> JacobianOf<S> {
                self.system.jacobian(t, state, input)
            }
            #[inline]
            fn input_derivative(
                &self,
                t: S::Scalar,
                state: &S::State,
                input: &S::Input,
                change: &S::Input,
            ) -> (VelocityOf<S>, ExtraOf<S>) {
                self.system.input_derivative(t, state, input, change)
            }
        }
    };
    (@Canonical $type:ty, [$($parameter:tt)*]) => {
        impl<S: Constrained + Canonical, $($parameter)*> Canonical for $type {
            #[inline]
            fn momentum(&self, state: &S::State) -> VelocityOf<S> {
                self.system.momentum(state)
            }
            #[inline]
            fn velocity(&self, q: &PositionOf<S>, momentum: &VelocityOf<S>) -> VelocityOf<S> {
                self.system.velocity(q, momentum)
            }
            #[inline]
            fn momentum_rate(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> VelocityOf<S> {
                self.system.momentum_rate(t, state, input)
            }
        }
    };
    (@Separable $type:ty, [$($parameter:tt)*]) => {
        impl<S: Constrained + Separable, $($parameter)*> Separable for $type {}
    };
}

/// What a wrapper's `System` says of how positions move and of loops: what the system says that it holds.
macro_rules! watched {
    () => {
        #[inline]
        fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
            self.system.position_rates(t, state)
        }
        #[inline]
        fn horizon(&self, t: S::Scalar, state: &S::State) -> S::Scalar {
            self.system.horizon(t, state)
        }
        #[inline]
        fn margins(
            &self,
            t: S::Scalar,
            state: &S::State,
            input: &S::Input,
            visit: &mut dyn FnMut(crate::Margin<S::Scalar>),
        ) -> S::Scalar {
            self.system.margins(t, state, input, visit)
        }
        #[inline]
        fn opening(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> crate::Opening<S::Scalar> {
            self.system.opening(t, state, input)
        }
        #[inline]
        fn without_inertia(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Option<&'static str> {
            self.system.without_inertia(t, state, input)
        }
    };
}

pub(super) use {handed_on, watched};
