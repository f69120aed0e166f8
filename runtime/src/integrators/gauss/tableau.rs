//! Coefficients of Gauss methods, relative to the middle of the step, and of the extrapolation that starts their
//! iteration.

use crate::Real;
use crate::integrators::slope::literals;

/// A Gauss method with `STAGES` stages that starts from the stages of `HISTORY` steps before.
pub(super) struct Tableau<T, const STAGES: usize, const HISTORY: usize> {
    /// Nodes, from zero to one.
    pub(super) nodes: [T; STAGES],
    /// Weights.
    pub(super) weights: [T; STAGES],
    /// `a_ij - b_j / 2`: stages as seen from the middle of start and end. The method is symplectic where `b_i` times
    /// this is skew, and so its diagonal is zero (Hairer, Lubich and Wanner, theorem VI.4.3).
    pub(super) middle: [[T; STAGES]; STAGES],
    /// Values of the polynomial through earlier stages at the nodes of this step, by stage, step (the last one first) and
    /// stage of that.
    pub(super) extrapolation: [[[T; STAGES]; HISTORY]; STAGES],
}

impl<const STAGES: usize, const HISTORY: usize> Tableau<f64, STAGES, HISTORY> {
    const fn new(nodes: [f64; STAGES], weights: [f64; STAGES], middle: [[f64; STAGES]; STAGES]) -> Self {
        let mut extrapolation = [[[1.0; STAGES]; HISTORY]; STAGES];
        let mut i = 0;
        while i < STAGES {
            let mut k = 0;
            while k < STAGES * HISTORY {
                let mut other = 0;
                while other < STAGES * HISTORY {
                    if other != k {
                        let (x, y) = (past(&nodes, k), past(&nodes, other));
                        extrapolation[i][k / STAGES][k % STAGES] *= (nodes[i] - y) / (x - y);
                    }
                    other += 1;
                }
                k += 1;
            }
            i += 1;
        }
        Self { nodes, weights, middle, extrapolation }
    }

    pub(super) const fn stages(&self) -> usize {
        STAGES
    }

    pub(super) const fn history(&self) -> usize {
        HISTORY
    }

    /// The same in another scalar, by loops that end as constants.
    #[inline(always)]
    pub(super) fn lit<T: Real>(&self) -> Tableau<T, STAGES, HISTORY> {
        let mut middle = [[T::lit(0.0); STAGES]; STAGES];
        let mut extrapolation = [[[T::lit(0.0); STAGES]; HISTORY]; STAGES];
        for (row, source) in middle.iter_mut().zip(&self.middle) {
            *row = literals(source);
        }
        for (steps, source) in extrapolation.iter_mut().zip(&self.extrapolation) {
            for (row, source) in steps.iter_mut().zip(source) {
                *row = literals(source);
            }
        }
        Tableau { nodes: literals(&self.nodes), weights: literals(&self.weights), middle, extrapolation }
    }
}

/// The node of the `k`th of all earlier stages.
const fn past<const STAGES: usize>(nodes: &[f64; STAGES], k: usize) -> f64 {
    let mut steps = 0.0;
    let mut step = 0;
    while step <= k / STAGES {
        steps += 1.0;
        step += 1;
    }
    nodes[k % STAGES] - steps
}

/// sqrt(3)
const ROOT3: f64 = 1.732_050_807_568_877_3;
/// sqrt(15)
const ROOT15: f64 = 3.872_983_346_207_417;

pub(super) const ONE: Tableau<f64, 1, 4> = Tableau::new([0.5], [1.0], [[0.0]]);

pub(super) const TWO: Tableau<f64, 2, 2> = {
    let a = ROOT3 / 6.0;
    Tableau::new([0.5 - a, 0.5 + a], [0.5, 0.5], [[0.0, -a], [a, 0.0]])
};

pub(super) const THREE: Tableau<f64, 3, 2> = {
    let (a, b) = (ROOT15 / 15.0, ROOT15 / 24.0);
    let nodes = [0.5 - ROOT15 / 10.0, 0.5, 0.5 + ROOT15 / 10.0];
    let middle = [[0.0, -a, -0.5 * a], [b, 0.0, -b], [0.5 * a, a, 0.0]];
    Tableau::new(nodes, [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0], middle)
};
