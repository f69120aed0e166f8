//! The pair 5(4) of Dormand and Prince (1980), with the coefficients as in Hairer, Norsett and Wanner, Solving
//! Ordinary Differential Equations I, table II.5.2; on manifolds after Munthe-Kaas (1998).

use super::dense::Dense;
use super::method::{Accepted, Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, advance_by, combination, displaced, literals, rate_of_displacement, slope_at_end};
use crate::{Real, System, Tangent};

/// The fifth-order method of Dormand and Prince: six evaluations. The first choice for steps chosen by error where errors
/// above 1e-3 will do, and below where states within steps are asked for; its estimate is the difference to an embedded
/// method of fourth order.
#[derive(Clone, Copy, Debug, Default)]
pub struct DormandPrince;

/// Nodes of the stages two to six.
const C: [f64; 5] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0];
const A2: [f64; 1] = [1.0 / 5.0];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19_372.0 / 6_561.0, -25_360.0 / 2_187.0, 64_448.0 / 6_561.0, -212.0 / 729.0];
const A6: [f64; 5] = [9_017.0 / 3_168.0, -355.0 / 33.0, 46_732.0 / 5_247.0, 49.0 / 176.0, -5_103.0 / 18_656.0];
/// Weights of the stages three to six; that of the first, 35/384, is what they leave to one. With it they are the seventh
/// row of the tableau too.
const B: [f64; 4] = [500.0 / 1_113.0, 125.0 / 192.0, -2_187.0 / 6_784.0, 11.0 / 84.0];
/// Fifth-order weights minus fourth-order ones, of the stages one and three to seven.
const E: [f64; 6] =
    [71.0 / 57_600.0, -71.0 / 16_695.0, 71.0 / 1_920.0, -17_253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Weights of the stages one and three to seven in the last term of dense output.
const D: [f64; 6] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// The stages one and three to seven of a step.
#[derive(Clone, Copy, Debug)]
pub struct Stages<D> {
    /// As rates of the displacement.
    rates: [D; 6],
    /// The last one as a slope.
    last: D,
}

impl<S: System> Method<S> for DormandPrince {
    const ORDER: u32 = 5;
    const ESTIMATE: u32 = 5;
    type Memory = SlopeOf<S>;
    type Details = Stages<SlopeOf<S>>;

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
    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, k1: &SlopeOf<S>) -> Attempt<S, Stages<SlopeOf<S>>> {
        let dt = step.dt;
        let at = |c: f64, d: &SlopeOf<S>| problem.stage(step.time(c), step.state, d);
        let k2 = at(C[0], &combination(dt, A2, [k1]));
        let k3 = at(C[1], &combination(dt, A3, [k1, &k2]));
        let k4 = at(C[2], &combination(dt, A4, [k1, &k2, &k3]));
        let k5 = at(C[3], &combination(dt, A5, [k1, &k2, &k3, &k4]));
        let k6 = at(C[4], &combination(dt, A6, [k1, &k2, &k3, &k4, &k5]));
        let displacement = advance_by(dt, k1, literals(&B), [&k3, &k4, &k5, &k6]);
        if !step.full {
            let none = SlopeOf::<S>::zero();
            return Attempt::new(displacement, Stages { rates: [none; 6], last: none });
        }
        let next = problem.slope(step.end, &displaced(step.state, &displacement));
        let k7 = rate_of_displacement::<S>(&displacement, &next);
        let error = combination(dt, E, [k1, &k3, &k4, &k5, &k6, &k7]);
        Attempt {
            displacement,
            error,
            converged: true,
            details: Stages { rates: [*k1, k3, k4, k5, k6, k7], last: next },
        }
    }

    /// The slope at the end is there already, unless [`System::accepted`] has changed the state.
    #[inline]
    fn proceed(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &SlopeOf<S>,
        attempt: &Attempt<S, Stages<SlopeOf<S>>>,
        next: &Accepted<S>,
    ) -> SlopeOf<S> {
        if !step.full {
            return problem.slope(step.end, &next.state);
        }
        slope_at_end(problem, step, next, || attempt.details.last)
    }

    /// Of fourth order, without further evaluations.
    fn dense(
        &self,
        _problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &SlopeOf<S>,
        attempt: &Attempt<S, Stages<SlopeOf<S>>>,
    ) -> Dense<S> {
        let minus = S::Scalar::lit(-1.0);
        let [k1, k3, k4, k5, k6, k7] = &attempt.details.rates;
        let d = &attempt.displacement;
        let rise = k1.scale(step.dt).add_scaled(minus, d);
        let fall = d.add_scaled(-step.dt, k7).add_scaled(minus, &rise);
        Dense::new(step.state, [*d, rise, fall, combination(step.dt, D, [k1, k3, k4, k5, k6, k7])])
    }
}

inherent!(DormandPrince);
