//! Constraints that pull themselves closed while a system moves: [`WithBaumgarte`].
//!
//! Baumgarte (1972), Stabilization of constraints and integrals of motion in dynamical systems. In place of
//! `Phi'' = 0` the accelerations keep `Phi'' + 2 a Phi' + a^2 Phi = 0`, critically damped, so what steps leave open
//! closes like `exp(-a t)`. The exact motion is not changed, since all that is added vanishes with `Phi` and `Phi'`.

use super::clarity::ambiguity;
use super::handed_on::{handed_on, watched};
use super::{ByMass, Plain, Weighting};
use crate::integrators::{Slope, SlopeOf};
use crate::linear::Square;
use crate::tangent::unit;
use crate::{
    Constrained, Differentiable, DisplacementOf, ExtraOf, Impulsive, JacobianMatrix, JacobianOf, PositionOf, Real,
    StateSpace, System, Tangent, VelocityOf,
};

/// `a dt` in [`WithBaumgarte::for_step`].
const SHARE: f64 = 0.1;

/// A system whose accelerations bring it back to its constraints: cheaper than a projection, and less exact.
///
/// To the accelerations the jump for `-2 a (G v + dPhi/dt) - a^2 Phi` is added, the one that is least by the mass matrix,
/// as forces of constraint would make it ([`Impulsive`], `emit impulse`), or the plain one. Equations that depend on
/// others are left out, as in projections.
///
/// # The rate
/// The equation of the drift has the double eigenvalue `-a`. An explicit method must keep `a dt` within its region of
/// stability: below 0.83 for the semi-implicit Euler method (`k^2 + 4 k < 4`), 2 for Euler's, 2.78 for [`Rk4`](crate::Rk4),
/// 3.3 for [`DormandPrince`](crate::DormandPrince). Stability is not all: stages of a step lie off the constraints by
/// the square of the step, and `a^2` times that disturbs them. [`WithBaumgarte::for_step`] takes `a = 0.1 / dt`, which is
/// stable with all of them, closes to a third in ten steps, and leaves the least drift with methods of order four and
/// five: a four-bar whose crank turns at 9 rad/s drifts by 1.5e-4 m in 4 s with steps of 4 ms of `Rk4`; 4e-6 remain at
/// `a dt = 0.01`, 2.5e-7 at 0.1, 4e-6 at 0.4 and 2e-5 at 0.8. Where steps are chosen by error, a rate far above the
/// motion's own frequencies makes them shorter.
///
/// At a rate of its own every method keeps its order. One that is tied to the step costs order as steps become shorter,
/// since what stages are off by is multiplied by a number that does not shrink: on a four-bar, halving such steps gained
/// 2^1.1 to 2^1.4 with [`Rk4`](crate::Rk4), 2^3.4 to 2^4.0 with [`DormandPrince`](crate::DormandPrince), 2^3.3 with
/// [`GaussLegendre4`](crate::GaussLegendre4) (`runtime/tests/loops/handlings.rs`). Where the order matters, give the rate
/// ([`WithBaumgarte::new`]), or project.
#[derive(Clone, Copy, Debug)]
pub struct WithBaumgarte<S, W = ByMass> {
    /// The system.
    pub system: S,
    rate: f64,
    weighting: W,
}

impl<S: Constrained + Impulsive<Rates = <S as Constrained>::Residual>> WithBaumgarte<S> {
    /// Closes at the rate `a` `[1/s]`.
    pub const fn new(system: S, rate: f64) -> Self {
        Self { system, rate, weighting: ByMass }
    }

    /// Closes at a rate that suits steps of `dt` `[s]`: see [there](Self#the-rate).
    pub const fn for_step(system: S, dt: f64) -> Self {
        Self::new(system, SHARE / dt)
    }
}

impl<S: Constrained> WithBaumgarte<S, Plain> {
    /// Closes at the rate `a` `[1/s]` by the least accelerations, of metres and radians alike.
    pub const fn plain(system: S, rate: f64) -> Self {
        Self { system, rate, weighting: Plain }
    }

    /// The same, at a rate that suits steps of `dt` `[s]`.
    pub const fn plain_for_step(system: S, dt: f64) -> Self {
        Self::plain(system, SHARE / dt)
    }
}

impl<S: Constrained, W: Weighting<S>> WithBaumgarte<S, W> {
    /// Closes at the rate `a` `[1/s]` by the accelerations that are least in any weighting.
    pub const fn weighted(system: S, rate: f64, weighting: W) -> Self {
        Self { system, rate, weighting }
    }
}

impl<S: Constrained, W: Weighting<S>> WithBaumgarte<S, W> {
    /// What is added to the accelerations.
    fn closing(&self, t: S::Scalar, state: &S::State) -> VelocityOf<S> {
        let (q, _, _) = state.split();
        let rate = S::Scalar::lit(self.rate);
        let (velocity, position) = (self.system.constraint_rate(t, state), self.system.constraints(t, &q));
        let wanted = velocity.scale(S::Scalar::lit(-2.0) * rate).add_scaled(-rate * rate, &position);
        self.weighting.velocity_correction(&self.system, t, state, &wanted).0
    }
}

impl<S: Constrained, W: Weighting<S>> System for WithBaumgarte<S, W> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;

    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        let (accel, rates) = self.system.derivative(t, state, input);
        (accel.add(&self.closing(t, state)), rates)
    }

    fn slope(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> SlopeOf<S> {
        let Slope { q, v, x } = self.system.slope(t, state, input);
        Slope { q, v: v.add(&self.closing(t, state)), x }
    }

    #[inline]
    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        self.system.accepted(t, state, input)
    }

    #[inline]
    fn reached(&self, t: S::Scalar, state: &S::State) {
        self.system.reached(t, state);
    }

    #[inline]
    fn ambiguity(&self, t: S::Scalar, state: &S::State, _input: &S::Input) -> S::Scalar {
        ambiguity(&self.system, t, state)
    }

    watched!();
}

/// Of what is added only `-2 a C G` and `-a^2 C G` are differentiated, where `C` is the jump: exact to first order in
/// `1/a` where the constraints hold. Implicit methods use derivatives only to find their way, and find the same solution.
impl<S: Constrained + Differentiable, W: Weighting<S>> Differentiable for WithBaumgarte<S, W> {
    type Matrix = S::Matrix;

    fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> JacobianOf<S> {
        let jacobian = self.system.jacobian(t, state, input);
        let (q, v, x) = state.split();
        let at = |v: VelocityOf<S>| self.system.constraint_rate(t, &state.join(q, v, x));
        let rest = at(Tangent::zero());
        let by_velocity = self.answers(t, state, |column| {
            (column < v.len()).then(|| at(unit(column)).add_scaled(S::Scalar::lit(-1.0), &rest))
        });
        // A displacement opens the loops as the velocity does that makes it.
        let by_position = if S::Matrix::FULL {
            self.answers(t, state, |column| {
                let inside = column < DisplacementOf::<S>::zero().len();
                inside.then(|| self.system.constraints_along(t, state, &unit(column)))
            })
        } else {
            by_velocity
        };
        let a = S::Scalar::lit(self.rate);
        S::Matrix::less(
            &jacobian,
            |i, j| a * a * by_position.get(j, i),
            |i, j| S::Scalar::lit(2.0) * a * by_velocity.get(j, i),
        )
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

impl<S: Constrained + Differentiable, W: Weighting<S>> WithBaumgarte<S, W> {
    /// The answers of velocities to what a change along each coordinate does to the constraints, one in each row; zero
    /// where there is no such coordinate.
    fn answers(&self, t: S::Scalar, state: &S::State, opened: impl Fn(usize) -> Option<S::Residual>) -> S::Matrix {
        let zero = S::Scalar::lit(0.0);
        let size = VelocityOf::<S>::zero().len();
        let mut known = None;
        S::Matrix::from_fn(|column, row| {
            if row >= size {
                return zero;
            }
            let answer = match known {
                Some((of, answer)) if of == column => answer,
                _ => {
                    let answer = opened(column).map_or_else(VelocityOf::<S>::zero, |opened| {
                        self.weighting.velocity_correction(&self.system, t, state, &opened).0
                    });
                    known = Some((column, answer));
                    answer
                }
            };
            pick(&answer, row)
        })
    }
}

/// One component of a vector.
fn pick<T: Real, V: Tangent<T>>(v: &V, at: usize) -> T {
    v.fold((0, T::lit(0.0)), &mut |(count, found), x| (count + 1, if count == at { x } else { found })).1
}

handed_on!(WithBaumgarte<S, W>, [W: Weighting<S>], Constrained, Impulsive);
