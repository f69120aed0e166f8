//! A projection after each step of any integrator: [`WithProjection`].

use super::clarity::{TURNED, ambiguity};
use super::handed_on::{handed_on, watched};
use super::{ByMass, Mask, Plain, Projection, Weighting, finite};
use crate::integrators::SlopeOf;
use crate::tangent::greatest;
use crate::{
    Canonical, Constrained, Differentiable, DisplacementOf, ExtraOf, Impulsive, JacobianOf, PositionOf, Real,
    Separable, StateSpace, System, Tangent, VelocityOf, all, any,
};

/// A system whose states are projected at the end of every accepted step, whatever the integrator.
///
/// It is a [`System`] with the state and the input of the one it holds:
/// `Rk4::integrate(&WithProjection::new(&model, Projection::default()), ..)`. The start is not projected; see
/// [`assemble`](super::assemble). What else the system offers (its derivatives, its momenta, jumps of its velocities) is
/// handed on, so every method takes it.
///
/// A step has no place for an error, so where a projection fails, in one lane or in all, the velocities become NaN
/// there, and `integrate` ends in [`IntegrationError::NonFinite`](crate::IntegrationError). Loops over
/// [`Projection::project`] say why. Where it may have led to another motion, or rounding decides which one goes on, it is
/// [`IntegrationError::Ambiguous`](crate::IntegrationError). [`WithRank`](super::WithRank) around it tells of singular poses.
#[derive(Clone, Copy, Debug)]
pub struct WithProjection<S, W = Plain> {
    /// The system.
    pub system: S,
    projection: Projection,
    weighting: W,
    fixed: bool,
}

impl<S: Constrained> WithProjection<S> {
    /// Projects as [`Projection::project`] does, to a tolerance.
    pub const fn new(system: S, projection: Projection) -> Self {
        Self { system, projection, weighting: Plain, fixed: false }
    }

    /// Projects as [`Projection::project_fixed`] does, by a fixed number of corrections: every step costs the same.
    pub const fn fixed(system: S, projection: Projection) -> Self {
        Self { system, projection, weighting: Plain, fixed: true }
    }
}

impl<S: Constrained + Impulsive<Rates = <S as Constrained>::Residual>> WithProjection<S, ByMass> {
    /// Projects as [`Projection::project_by_mass`] does, to a tolerance.
    pub const fn by_mass(system: S, projection: Projection) -> Self {
        Self { system, projection, weighting: ByMass, fixed: false }
    }
}

impl<S: Constrained, W: Weighting<S>> WithProjection<S, W> {
    /// Projects as [`Projection::project_by`] does, to a tolerance.
    pub const fn weighted(system: S, projection: Projection, weighting: W) -> Self {
        Self { system, projection, weighting, fixed: false }
    }

    /// Projects as [`Projection::project_fixed_by`] does, by a fixed number of corrections.
    pub const fn fixed_weighted(system: S, projection: Projection, weighting: W) -> Self {
        Self { system, projection, weighting, fixed: true }
    }
}

impl<S: Constrained, W: Weighting<S>> System for WithProjection<S, W> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;

    #[inline]
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, state, input)
    }
    #[inline]
    fn slope(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> SlopeOf<S> {
        self.system.slope(t, state, input)
    }

    fn accepted(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> S::State {
        let Self { system, projection, weighting, fixed } = self;
        if *fixed {
            return system.accepted(t, &projection.project_fixed_by(weighting, system, t, state).state, input);
        }
        let run = projection.run(weighting, system, t, state);
        let good: Mask<S> = run.closed & run.motion.consistent & finite::<S>(&run.motion.state) & !run.unclear;
        let (q, v, x) = if any(run.unclear) {
            state.split() // so that `ambiguity` finds it again
        } else {
            run.motion.state.split()
        };
        let v = v.map(&mut |v| Real::select(good, v, S::Scalar::lit(f64::NAN)));
        let v = unturned(system, t, &state.join(q, v, x), &state.split().1);
        system.accepted(t, &state.join(q, v, x), input)
    }

    #[inline]
    fn reached(&self, t: S::Scalar, state: &S::State) {
        self.system.reached(t, state);
    }

    /// As [`ambiguity`] says, and infinite where the projection may have led to another motion.
    fn ambiguity(&self, t: S::Scalar, state: &S::State, _input: &S::Input) -> S::Scalar {
        let Self { system, projection, weighting, fixed } = self;
        let (q, v, x) = state.split();
        if *fixed || all(Real::is_finite(greatest(&v))) {
            return ambiguity(system, t, state);
        }
        let unclear = projection.run(weighting, system, t, &state.join(q, Tangent::zero(), x)).unclear;
        Real::select(unclear, S::Scalar::lit(f64::INFINITY), S::Scalar::lit(0.0))
    }

    watched!();
}

/// The projected velocities of `state`, or those of `before` where rounding decides in which direction a projection turns
/// them: a mechanism goes straight on through a pose in which motions cross.
fn unturned<S: Constrained>(system: &S, t: S::Scalar, state: &S::State, before: &VelocityOf<S>) -> VelocityOf<S> {
    let one = S::Scalar::lit(1.0);
    let (_, v, _) = state.split();
    let change = greatest(&v.add_scaled(-one, before));
    let turned = Real::gt(change, S::Scalar::lit(TURNED) * greatest(before));
    if !any(turned) {
        return v;
    }
    let turned = turned & Real::ge(ambiguity(system, t, state), one);
    v.zip(before, &mut |v, before| Real::select(turned, before, v))
}

handed_on!(WithProjection<S, W>, [W: Weighting<S>], Constrained, Impulsive, Differentiable, Canonical, Separable);
