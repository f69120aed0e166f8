//! The pair 5(4) of Dormand and Prince (1980), with the coefficients as in Hairer, Norsett and Wanner, Solving
//! Ordinary Differential Equations I, table II.5.2; on manifolds after Munthe-Kaas (1998).

use super::method::{Method, inherent};
use super::slope::{SlopeOf, displaced, slope, stage};
use crate::{Real, System, Tangent};

/// The fifth-order method of Dormand and Prince with a given step: six evaluations. [`Adaptive`](crate::Adaptive)
/// chooses its steps by the embedded fourth-order method.
#[derive(Clone, Copy, Debug, Default)]
pub struct DormandPrince;

/// Nodes of the stages two to six.
const C: [f64; 5] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0];
const A2: [f64; 1] = [1.0 / 5.0];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19_372.0 / 6_561.0, -25_360.0 / 2_187.0, 64_448.0 / 6_561.0, -212.0 / 729.0];
const A6: [f64; 5] = [9_017.0 / 3_168.0, -355.0 / 33.0, 46_732.0 / 5_247.0, 49.0 / 176.0, -5_103.0 / 18_656.0];
/// Weights of the stages one and three to six; they are the seventh row of the tableau too.
const B: [f64; 5] = [35.0 / 384.0, 500.0 / 1_113.0, 125.0 / 192.0, -2_187.0 / 6_784.0, 11.0 / 84.0];
/// Fifth-order weights minus fourth-order ones, of the stages one and three to seven.
const E: [f64; 6] =
    [71.0 / 57_600.0, -71.0 / 16_695.0, 71.0 / 1_920.0, -17_253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// One step: the displacement, and the stages that the error estimate needs.
pub(super) struct Stages<S: System> {
    /// Displacement over the step.
    pub(super) displacement: SlopeOf<S>,
    /// Stages one and three to six.
    slopes: [SlopeOf<S>; 5],
}

impl<S: System> Stages<S> {
    /// The stages of a step of `dt` from `state`, where the slope is `first`; `time(c)` is the time at the node `c`.
    #[inline]
    pub(super) fn new(
        system: &S,
        time: impl Fn(f64) -> S::Scalar,
        state: &S::State,
        input: &S::Input,
        dt: S::Scalar,
        first: &SlopeOf<S>,
    ) -> Self {
        let at = |c: f64, d: &SlopeOf<S>| stage(system, time(c), state, input, d);
        let k1 = *first;
        let k2 = at(C[0], &combination(dt, A2, [&k1]));
        let k3 = at(C[1], &combination(dt, A3, [&k1, &k2]));
        let k4 = at(C[2], &combination(dt, A4, [&k1, &k2, &k3]));
        let k5 = at(C[3], &combination(dt, A5, [&k1, &k2, &k3, &k4]));
        let k6 = at(C[4], &combination(dt, A6, [&k1, &k2, &k3, &k4, &k5]));
        Self { displacement: combination(dt, B, [&k1, &k3, &k4, &k5, &k6]), slopes: [k1, k3, k4, k5, k6] }
    }

    /// The difference of the fifth- and the fourth-order displacement; `last` is the rate of the displacement at the
    /// end of the step.
    #[inline]
    pub(super) fn error(&self, dt: S::Scalar, last: &SlopeOf<S>) -> SlopeOf<S> {
        let [k1, k3, k4, k5, k6] = &self.slopes;
        combination(dt, E, [k1, k3, k4, k5, k6, last])
    }
}

/// `dt * (weights[0] * slopes[0] + ..)`.
#[inline]
fn combination<T: Real, V: Tangent<T>, const N: usize>(dt: T, weights: [f64; N], slopes: [&V; N]) -> V {
    let terms = weights.into_iter().zip(slopes);
    terms.fold(V::zero(), |sum, (weight, slope)| sum.add_scaled(T::lit(weight), slope)).scale(dt)
}

impl Method for DormandPrince {
    const ORDER: u32 = 5;
    const STAGES: u32 = 6;

    #[inline]
    fn step<S: System>(system: &S, t: S::Scalar, state: &S::State, input: &S::Input, dt: S::Scalar) -> S::State {
        let first = slope(system, t, state, input);
        let stages = Stages::new(system, |c| t + S::Scalar::lit(c) * dt, state, input, dt, &first);
        system.accepted(t + dt, &displaced(state, &stages.displacement), input)
    }
}

inherent!(DormandPrince);
