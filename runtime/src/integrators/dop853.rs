//! The method 8(5,3) of Dormand and Prince with the error estimate and the dense output of Hairer, Norsett and Wanner,
//! Solving Ordinary Differential Equations I, section II.10; on manifolds after Munthe-Kaas (1998).

#[cfg(test)]
mod conditions;
mod tableau;

use super::dense::Dense;
use super::method::{Accepted, Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advance_by, combination, displaced, literals, rate_of_displacement, slope_at_end};
use crate::{Real, System, Tangent};
use core::cell::OnceCell;
use tableau as tab;

/// The eighth-order method of Dormand and Prince: twelve evaluations, eleven where the step is rejected. The first choice
/// for smooth motions from errors of 1e-3 downwards.
///
/// Its estimate of the error combines one of fifth and one of third order; dense output is of seventh order and takes
/// three further evaluations for each step that is asked for it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dop853;

/// The stages 1 and 6 to 12 of a step, and the slope at its end where that was asked for: neither the step nor its
/// estimate has a use for it, so steps that are rejected do without.
#[derive(Clone, Debug)]
pub struct EighthOrderStages<D> {
    /// As rates of the displacement.
    rates: [D; 8],
    last: OnceCell<D>,
}

/// The slope at the end of a step, evaluated once.
fn last<S: System>(
    problem: &Problem<'_, S>,
    step: &Step<'_, S>,
    attempt: &Attempt<S, EighthOrderStages<SlopeOf<S>>>,
) -> SlopeOf<S> {
    let evaluated = || problem.slope(step.end, &displaced(step.state, &attempt.displacement));
    *attempt.details.last.get_or_init(evaluated)
}

impl<S: System> Method<S> for Dop853 {
    const ORDER: u32 = 8;
    const ESTIMATE: u32 = 8;
    type Memory = SlopeOf<S>;
    type Details = EighthOrderStages<SlopeOf<S>>;

    #[inline]
    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> SlopeOf<S> {
        problem.slope(t, state)
    }

    #[inline]
    fn first_slope(
        &self,
        _problem: &Problem<'_, S>,
        _t: S::Scalar,
        _state: &S::State,
        memory: &mut SlopeOf<S>,
    ) -> SlopeOf<S> {
        *memory
    }

    #[inline]
    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, k1: &SlopeOf<S>) -> Attempt<S, Self::Details> {
        let dt = step.dt;
        let [c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12] = tab::C;
        let at = |c: f64, d: &SlopeOf<S>| problem.stage(step.time(c), step.state, d);
        let k2 = at(c2, &combination(dt, tab::A2, [k1]));
        let k3 = at(c3, &combination(dt, tab::A3, [k1, &k2]));
        let k4 = at(c4, &combination(dt, tab::A4, [k1, &k3]));
        let k5 = at(c5, &combination(dt, tab::A5, [k1, &k3, &k4]));
        let k6 = at(c6, &combination(dt, tab::A6, [k1, &k4, &k5]));
        let k7 = at(c7, &combination(dt, tab::A7, [k1, &k4, &k5, &k6]));
        let k8 = at(c8, &combination(dt, tab::A8, [k1, &k4, &k5, &k6, &k7]));
        let k9 = at(c9, &combination(dt, tab::A9, [k1, &k4, &k5, &k6, &k7, &k8]));
        let k10 = at(c10, &combination(dt, tab::A10, [k1, &k4, &k5, &k6, &k7, &k8, &k9]));
        let k11 = at(c11, &combination(dt, tab::A11, [k1, &k4, &k5, &k6, &k7, &k8, &k9, &k10]));
        let k12 = at(c12, &combination(dt, tab::A12, [k1, &k4, &k5, &k6, &k7, &k8, &k9, &k10, &k11]));
        let stages = [k1, &k6, &k7, &k8, &k9, &k10, &k11, &k12];
        let [_, ref rest @ ..] = tab::B;
        let displacement = advance_by(dt, k1, literals(rest), [&k6, &k7, &k8, &k9, &k10, &k11, &k12]);
        if !step.full {
            let rates = [SlopeOf::<S>::zero(); 8];
            return Attempt::new(displacement, EighthOrderStages { rates, last: OnceCell::new() });
        }
        Attempt {
            displacement,
            error: combination(dt, tab::E5, stages),
            converged: true,
            details: EighthOrderStages { rates: [*k1, k6, k7, k8, k9, k10, k11, k12], last: OnceCell::new() },
        }
    }

    /// `e5^2 / sqrt(e5^2 + 0.01 e3^2)` of the estimates of fifth and third order: it shrinks as the eighth power of the
    /// step.
    #[inline]
    fn error(
        &self,
        step: &Step<'_, S>,
        attempt: &Attempt<S, Self::Details>,
        norm: impl Fn(&SlopeOf<S>) -> S::Scalar,
    ) -> S::Scalar {
        let [k1, _, _, _, k9, _, _, k12] = &attempt.details.rates;
        let third = combination(step.dt, tab::E3, [k1, k9, k12]);
        let e5 = norm(&attempt.error);
        let e3 = norm(&attempt.displacement.add_scaled(S::Scalar::lit(-1.0), &third));
        // Not by squares, which vanish or overflow long before the estimates do.
        let tenth = S::Scalar::lit(0.1) * e3;
        let size = Real::hypot(e5, tenth);
        Real::select(Real::eq(size, S::Scalar::lit(0.0)), size, e5 * (e5 / size))
    }

    /// The slope at the end is there already if dense output asked for it and [`System::accepted`] has not changed the state.
    #[inline]
    fn proceed(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &SlopeOf<S>,
        attempt: &Attempt<S, Self::Details>,
        next: &Accepted<S>,
    ) -> SlopeOf<S> {
        slope_at_end(problem, step, next, || last(problem, step, attempt))
    }

    /// Of seventh order, by three further evaluations.
    fn dense(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &SlopeOf<S>,
        attempt: &Attempt<S, Self::Details>,
    ) -> Dense<S> {
        let dt = step.dt;
        let [c14, c15, c16] = tab::C_DENSE;
        let at = |c: f64, d: &SlopeOf<S>| problem.stage(step.time(c), step.state, d);
        let [k1, k6, k7, k8, k9, k10, k11, k12] = &attempt.details.rates;
        let k13 = &rate_of_displacement::<S>(&attempt.displacement, &last(problem, step, attempt));
        let k14 = &at(c14, &combination(dt, tab::A14, [k1, k7, k8, k9, k10, k11, k12, k13]));
        let k15 = &at(c15, &combination(dt, tab::A15, [k1, k6, k7, k8, k11, k12, k13, k14]));
        let k16 = &at(c16, &combination(dt, tab::A16, [k1, k6, k7, k8, k9, k13, k14, k15]));
        let stages = [k1, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16];
        let [displacement, rise, fall, ..] = Dense::cubic(step, &attempt.displacement, k1, k13).into_terms();
        let [d4, d5, d6, d7] = [tab::D4, tab::D5, tab::D6, tab::D7].map(|weights| combination(dt, weights, stages));
        Dense::new(step.state, [displacement, rise, fall, d4, d5, d6, d7])
    }
}

inherent!(Dop853);
