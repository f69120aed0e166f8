//! Impulses and impacts, rest and trim, projection, assembly and stabilisation, at any state with any settings.

use super::bounded::Bounded;
use super::drawn::{Drawn, Numbers, finite};
use super::steps::method;
use multibody::impact::{ImpactError, along, impact, impact_at_rate, impacts, impulse, impulse_at};
use multibody::nalgebra::{SMatrix, SVector};
use multibody::projection::{ByMass, Plain, Weighting, Weights, rank};
use multibody::*;
use std::hint::black_box;

pub(super) fn struck<S: Impulsive<Scalar: Drawn>>(system: &Bounded<S>, state: &S::State, n: &Numbers) {
    let (t, direction) = (n.scalar(), n.vector());
    system.reset();
    let kept = |outcome: Result<S::State, ImpactError>| {
        assert!(outcome.is_err() || outcome.is_ok_and(|state| finite(&state)));
    };
    kept(impulse(system, t, state, &direction).map(|done| done.state));
    kept(impact(system, t, state, &direction, n.scalar()).map(|done| done.state));
    kept(impact_at_rate(system, t, state, &direction, n.scalar(), n.scalar()).map(|done| done.state));
    let directions = [n.vector(), n.vector(), direction];
    kept(impacts(system, t, state, &directions, n.scalar()).map(|done| done.state));
    let jacobian = SMatrix::<S::Scalar, 6, 9>::from_fn(|_, _| n.scalar());
    let (force, wrench) = (SVector::<S::Scalar, 3>::from_fn(|_, _| n.scalar()), SVector::from_fn(|_, _| n.scalar()));
    black_box(along::<_, VelocityOf<S>, 3, 6, 9>(&jacobian, &force).len());
    kept(impulse_at(system, t, state, &jacobian, &force).map(|done| done.state));
    kept(impulse_at::<_, 6, 6, 9>(system, t, state, &jacobian, &wrench).map(|done| done.state));
}

pub(super) fn at_rest<S: Differentiable<Scalar: Drawn, Input: Tangent<S::Scalar>>>(
    system: &Bounded<S>,
    (state, input): (&S::State, &S::Input),
    n: &Numbers,
) {
    let some: DisplacementOf<S> = n.vector();
    for free in [some, some.map(&mut |_| S::Scalar::lit(1.0))] {
        system.reset();
        let found = equilibrium(system, n.scalar(), state, input, &free);
        assert!(found.is_err() || found.is_ok_and(|found| finite(&found.state)));
    }
    system.reset();
    let found = trim(system, n.scalar(), state, input, &n.vector());
    assert!(found.is_err() || found.is_ok_and(|found| finite(&found.state)));
    let (t, change) = (n.scalar(), n.vector());
    black_box(system.jacobian(t, state, input));
    black_box(system.input_derivative(t, state, input, &change).0.len());
}

pub(super) fn at_rest_with_loops<S: Differentiable<Scalar: Drawn> + Constrained>(
    system: &Bounded<S>,
    (state, input): (&S::State, &S::Input),
    n: &Numbers,
) {
    let some: DisplacementOf<S> = n.vector();
    for free in [some, some.map(&mut |_| S::Scalar::lit(1.0))] {
        system.reset();
        let found = constrained_equilibrium(system, n.scalar(), state, input, &free);
        assert!(found.is_err() || found.is_ok_and(|found| finite(&found.state)));
    }
}

/// Projection, assembly and their wrappers.
pub(super) fn closed<S: Constrained<Scalar: Drawn> + SecondOrder>(
    system: &Bounded<S>,
    start: (&S::State, &S::Input),
    n: &Numbers,
) {
    let (state, _) = start;
    let (q, _, _) = state.split();
    system.reset();
    black_box(system.constraints(n.scalar(), &q).len());
    black_box(system.constraint_rate(n.scalar(), state).len());
    black_box(system.correction(n.scalar(), state, &n.vector(), &n.vector()).1);
    black_box(system.least_correction(n.scalar(), state, &n.vector()).is_some());
    black_box(Plain.fixed_correction(system, n.scalar(), state, &n.vector()).1);
    black_box(rank(system, n.scalar(), state));
    let halves = [(true, false), (false, true), (true, true)];
    let (position, velocity) = halves[(n.setting().abs() % 3.0) as usize];
    let wild = Projection { tolerance: n.setting(), iterations: 30, position, velocity };
    for projection in [wild, Projection::default()] {
        let (t, weights) = (n.scalar(), n.vector());
        let kept = |outcome: Result<Projected<S::State, S::Scalar>, ProjectionError>| {
            system.reset();
            assert!(outcome.is_err() || outcome.is_ok_and(|projected| finite(&projected.state)));
        };
        kept(projection.project(system, t, state));
        kept(projection.project_weighted(system, t, state, &weights));
        kept(projection.project_by(&Plain, system, t, state));
        black_box(projection.project_fixed(system, t, state).residual);
        black_box(projection.project_fixed_by(&Weights(weights), system, t, state).residual);
        system.reset();
        method(Rk4, (&WithProjection::new(system, projection), system), start, n);
        method(Dop853, (&WithProjection::fixed(system, projection), system), start, n);
        method(Rk4, (&WithProjection::weighted(system, projection, Weights(weights)), system), start, n);
        let watched = WithRank::new(WithProjection::fixed_weighted(system, projection, Weights(weights)));
        method(Rk4, (&watched, system), start, n);
        let _ = black_box(watched.least().is_some());
    }
    for plain in [WithBaumgarte::plain(system, n.setting()), WithBaumgarte::plain_for_step(system, n.setting())] {
        method(Rk4, (&plain, system), start, n);
    }
    method(DormandPrince, (&WithBaumgarte::weighted(system, n.setting(), Plain), system), start, n);
    for free in [n.vector(), VelocityOf::<S>::zero().map(&mut |_| S::Scalar::lit(1.0))] {
        system.reset();
        let outcome = assemble(system, n.scalar(), state, &free);
        assert!(outcome.is_err() || outcome.is_ok_and(|assembled| finite(&assembled.state)));
    }
}

/// The same by mass.
pub(super) fn closed_by_mass<S>(system: &Bounded<S>, start: (&S::State, &S::Input), n: &Numbers)
where
    S: Constrained<Scalar: Drawn> + SecondOrder + Impulsive<Rates = <S as Constrained>::Residual>,
{
    let (state, _) = start;
    for projection in [Projection { tolerance: n.setting(), ..Projection::default() }, Projection::default()] {
        system.reset();
        let outcome = projection.project_by_mass(system, n.scalar(), state);
        assert!(outcome.is_err() || outcome.is_ok_and(|projected| finite(&projected.state)));
        method(Rk4, (&WithProjection::by_mass(system, projection), system), start, n);
        method(Rk4, (&WithProjection::fixed_weighted(system, projection, ByMass), system), start, n);
    }
    for held in [WithBaumgarte::new(system, n.setting()), WithBaumgarte::for_step(system, n.setting())] {
        method(Rk4, (&held, system), start, n);
    }
    method(GeneralisedAlpha::new(n.setting()).constrained().functional(), (system, system), start, n);
}

pub(super) fn closed_implicitly<S>(system: &Bounded<S>, start: (&S::State, &S::Input), n: &Numbers)
where
    S: Constrained<Scalar: Drawn> + SecondOrder + Differentiable + Impulsive<Rates = <S as Constrained>::Residual>,
{
    method(GeneralisedAlpha::new(n.setting()).constrained(), (system, system), start, n);
    method(Radau, (&WithProjection::new(system, Projection::default()), system), start, n);
    at_rest_with_loops(system, start, n);
}
