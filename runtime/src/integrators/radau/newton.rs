//! The simplified Newton iteration for the stages, and when it has converged (Hairer and Wanner, Solving Ordinary
//! Differential Equations II, section IV.8).

use super::super::control::Tolerance;
use super::super::problem::{Problem, Step};
use super::super::slope::{SlopeOf, magnitude};
use super::linear::{Matrices, MatricesOf};
use super::tableau::{ALPHA, BETA, C, GAMMA, from_stages, to_stages};
use crate::tangent::unit;
use crate::{Differentiable, Real, Tangent};

/// How exactly the stages are solved for.
pub(super) struct Aim {
    /// The tolerance that errors are measured by.
    pub(super) tolerance: Tolerance,
    /// What an error in terms of it is in terms of the tolerance that was asked for.
    pub(super) share: f64,
    /// The error of the stages may be this great, in terms of the tolerance.
    kappa: f64,
    /// A change that is no longer reduced may be rounding up to this size.
    rounding: f64,
    /// Greatest number of iterations.
    limit: u32,
    /// Whether an iteration that can't converge within the limit is given up at once.
    hasty: bool,
}

impl Aim {
    /// Steps chosen by error. The estimate is of third order and the method of fifth, so the tolerance for the estimate
    /// is `0.1 rel^(2/3)`, as in the program `radau5`: then errors are about what was asked for.
    fn within<T: Real>(asked: Tolerance) -> Self {
        let level = if asked.relative > 0.0 { asked.relative } else { asked.absolute };
        let share = Real::min(1.0, 10.0 * Real::powf(level, 1.0 / 3.0));
        let tolerance = Tolerance { relative: asked.relative / share, absolute: asked.absolute / share, ..asked };
        let level = level / share;
        let kappa = Real::max(10.0 * T::epsilon().greatest() / level, Real::min(0.03, Real::sqrt(level)));
        Self { tolerance, share, kappa, rounding: Real::max(kappa, 0.1), limit: 8, hasty: true }
    }

    /// Steps of one length: the stages are solved for to rounding.
    fn rounding<T: Real>() -> Self {
        let level = 16.0 * T::epsilon().greatest();
        let tolerance = Tolerance::new(level, level);
        Self { tolerance, share: 1.0, kappa: 1.0, rounding: f64::INFINITY, limit: 20, hasty: false }
    }

    pub(super) fn of<T: Real>(tolerance: Option<Tolerance>) -> Self {
        tolerance.map_or_else(Self::rounding::<T>, Self::within::<T>)
    }
}

/// A change that is no longer reduced is rounding if it is no more than this many times what roundings of the state alone
/// would make of it.
const ROUNDINGS: f64 = 16.0;

/// What the iteration makes of a rounding in each coordinate of a state, in the mean square.
///
/// A rounding `d` of the state changes slopes by `J d`, and an iteration answers by `h (gamma - h J)^-1 J d`, which is
/// `gamma (gamma - h J)^-1 d` beside `d` itself. For a stiff spring that is a velocity of `d / h`, far more than a
/// rounding of the velocity is; lengths round as those of one metre where coordinates are shorter.
fn rounding<S: Differentiable>(matrices: &MatricesOf<S>, size: &SlopeOf<S>, norm: impl Fn(&SlopeOf<S>) -> f64) -> f64 {
    let one = S::Scalar::lit(1.0);
    let epsilon = S::Scalar::epsilon();
    let mut sum = 0.0;
    for k in 0..size.len() {
        let d = unit::<S::Scalar, SlopeOf<S>>(k).zip(size, &mut |unit, size| unit * epsilon * (one + Real::abs(size)));
        let answer = norm(&matrices.solve_real(&d.scale(S::Scalar::lit(GAMMA))));
        sum += answer * answer;
    }
    Real::sqrt(sum)
}

/// The stages of a step as displacements from its start, if they were found.
pub(super) struct Solution<S: Differentiable> {
    pub(super) stages: [SlopeOf<S>; 3],
    pub(super) converged: bool,
    /// The rate of convergence: each change was about this share of the one before.
    pub(super) theta: f64,
    /// `theta / (1 - theta)`: what is still to come, in terms of the last change.
    pub(super) eta: f64,
    /// Share of the step to try next, if there was no convergence.
    pub(super) shrink: f64,
}

/// Solves for the stages, starting from `guess`; `eta` is what the step before ended with.
pub(super) fn solve<S: Differentiable>(
    problem: &Problem<'_, S>,
    step: &Step<'_, S>,
    matrices: &MatricesOf<S>,
    aim: &Aim,
    guess: &[SlopeOf<S>; 3],
    eta: f64,
) -> Solution<S> {
    let lit = S::Scalar::lit;
    let size = magnitude(step.state);
    let mut stages = *guess;
    let mut w = from_stages(guess);
    let mut eta = Real::powf(Real::max(eta, f64::EPSILON), 0.8);
    let (mut theta, mut ratio_before, mut change_before) = (0.0, 0.0, 0.0);
    for k in 0..aim.limit {
        let [z1, z2, z3] = &stages;
        let at = |c: f64, z: &SlopeOf<S>| problem.stage(step.time(c), step.state, z).scale(step.dt);
        let f = from_stages(&[at(C[0], z1), at(C[1], z2), at(C[2], z3)]);
        let [f1, f2, f3] = &f;
        let [w1, w2, w3] = &w;
        let r1 = f1.add_scaled(lit(-GAMMA), w1);
        let r2 = f2.add_scaled(lit(-ALPHA), w2).add_scaled(lit(BETA), w3);
        let r3 = f3.add_scaled(lit(-ALPHA), w3).add_scaled(lit(-BETA), w2);
        let d1 = matrices.solve_real(&r1);
        let (d2, d3) = matrices.solve_complex(&r2, &r3);

        let norm = |d: &SlopeOf<S>| aim.tolerance.norm(d, &size, &size).greatest();
        let (n1, n2, n3) = (norm(&d1), norm(&d2), norm(&d3));
        let change = Real::sqrt((n1 * n1 + n2 * n2 + n3 * n3) / 3.0);
        if !change.is_finite() {
            if k == 0 {
                stages = stages.map(|z| z.scale(lit(f64::NAN))); // the system itself is not finite here
            }
            return Solution { stages, converged: false, theta: f64::INFINITY, eta, shrink: 0.1 };
        }
        if k > 0 {
            let ratio = if change_before > 0.0 { change / change_before } else { 0.0 };
            theta = if k == 1 { ratio } else { Real::sqrt(ratio * ratio_before) };
            ratio_before = ratio;
            let stalled = ratio >= 0.99 && change <= aim.rounding;
            if stalled && change <= ROUNDINGS * rounding::<S>(matrices, &size, norm) {
                return Solution { stages, converged: true, theta: 0.99, eta, shrink: 1.0 };
            }
            let diverges = if aim.hasty { theta >= 0.99 } else { ratio >= 2.0 };
            if diverges {
                return Solution { stages, converged: false, theta, eta, shrink: 0.5 };
            }
            if theta < 0.99 {
                eta = theta / (1.0 - theta);
                // What the last iteration allowed would leave.
                let left = eta * change * Real::powi(theta, (aim.limit - 1 - k).cast_signed()) / aim.kappa;
                if aim.hasty && left >= 1.0 {
                    let excess = Real::max(1e-4, Real::min(20.0, left));
                    let shrink = 0.8 * Real::powf(excess, -1.0 / f64::from(4 + aim.limit - 1 - k));
                    return Solution { stages, converged: false, theta, eta, shrink };
                }
            } else {
                eta = 100.0;
            }
        }
        change_before = change;
        w = [w1.add(&d1), w2.add(&d2), w3.add(&d3)];
        stages = to_stages(&w);
        if eta * change <= aim.kappa {
            return Solution { stages, converged: true, theta, eta, shrink: 1.0 };
        }
    }
    Solution { stages, converged: false, theta, eta, shrink: 0.5 }
}
