//! Dense output of sixth order for methods whose stages give none: a quintic, bootstrapped.

use super::dense::Dense;
use super::problem::{Problem, Step};
use super::slope::SlopeOf;
use crate::{Real, System, Tangent};

impl<S: System> Dense<S> {
    /// The quintic through the displacement, the rates at both ends, and the rates at one and three quarters.
    ///
    /// The latter are evaluated on the cubic, and once more on the quintic that this gives: each pass gains an order
    /// (Enright, Jackson, Norsett and Thomsen 1986; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations
    /// I, section II.6). Six evaluations, made where states within a step are asked for.
    pub(super) fn quintic(problem: &Problem<'_, S>, step: &Step<'_, S>, displacement: &SlopeOf<S>) -> Self {
        let lit = S::Scalar::lit;
        let first = problem.slope(step.t, step.state);
        let last = problem.stage(step.end, step.state, displacement);
        let d = displacement;
        let rise = first.scale(step.dt).add_scaled(lit(-1.0), d);
        let fall = d.add_scaled(-step.dt, &last).add_scaled(lit(-1.0), &rise);
        let mut dense = Self::cubic(step, d, &first, &last);
        for _ in 0..2 {
            // What the rates are beside those of the cubic d c + rise c (1 - c) + fall c^2 (1 - c).
            let excess = |c: f64, cubic: [f64; 2]| {
                let rate = problem.stage(step.time(c), step.state, &dense.displacement(lit(c)));
                let cubic = d.add_scaled(lit(cubic[0]), &rise).add_scaled(lit(cubic[1]), &fall);
                rate.scale(step.dt).add_scaled(lit(-1.0), &cubic)
            };
            let early = excess(0.25, [0.5, 5.0 / 16.0]);
            let late = excess(0.75, [-0.5, -3.0 / 16.0]);
            let fifth = early.add(&late).scale(lit(-128.0 / 3.0));
            let fourth = early.scale(lit(16.0 / 3.0)).add_scaled(lit(-7.0 / 16.0), &fifth);
            dense = Self::new(step.state, [*d, rise, fall, fourth, fifth]);
        }
        dense
    }
}
