//! Coefficients of Radau IIA of order 5 (Hairer and Wanner, Solving Ordinary Differential Equations II, table IV.5.6),
//! and the transformation of its stages into eigenvectors of the inverse of its matrix (section IV.8), to 20 digits from
//! the definition.

use crate::{Real, Tangent};

/// Nodes: `(4 - sqrt 6) / 10`, `(4 + sqrt 6) / 10`, one.
pub(super) const C: [f64; 3] = [0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];

/// The real eigenvalue of `A^-1`..
pub(super) const GAMMA: f64 = 3.637_834_252_744_496;
/// ..and real and imaginary part of the complex pair.
pub(super) const ALPHA: f64 = 2.681_082_873_627_752_3;
pub(super) const BETA: f64 = 3.050_430_199_247_410_5;

/// `A^-1 T = T diag(gamma, [alpha, -beta; beta, alpha])`.
const T: [[f64; 3]; 3] = [
    [0.091_232_394_870_892_94, -0.141_255_295_020_954_2, -0.030_029_194_105_147_424],
    [0.241_717_932_707_107, 0.204_129_352_293_799_94, 0.382_942_112_757_261_9],
    [0.966_048_182_615_093, 1.0, 0.0],
];
const T_INVERSE: [[f64; 3]; 3] = [
    [4.325_579_890_063_155, 0.339_199_251_815_809_84, 0.541_770_539_935_874_9],
    [-4.178_718_591_551_905, -0.327_682_820_761_062_4, 0.476_623_554_500_550_4],
    [-0.502_872_634_945_786_9, 2.571_926_949_855_605, -0.596_039_204_828_224_9],
];

/// Weights of the stages in the estimate of the error, times three: `-13 - 7 sqrt 6`, `-13 + 7 sqrt 6`, `-1`. With
/// `gamma^-1` as weight of the slope at the start they make a formula of third order.
pub(super) const E: [f64; 3] = [-30.146_428_199_482_244, 4.146_428_199_482_247, -1.0];

/// Stages in terms of eigenvectors.
#[inline]
pub(super) fn to_stages<R: Real, V: Tangent<R>>(w: &[V; 3]) -> [V; 3] {
    product(&T, w)
}

/// Eigenvectors in terms of stages.
#[inline]
pub(super) fn from_stages<R: Real, V: Tangent<R>>(z: &[V; 3]) -> [V; 3] {
    product(&T_INVERSE, z)
}

#[inline]
fn product<R: Real, V: Tangent<R>>(matrix: &[[f64; 3]; 3], v: &[V; 3]) -> [V; 3] {
    let [a, b, c] = matrix;
    [combination(a, v), combination(b, v), combination(c, v)]
}

/// `weights[0] * v[0] + ..`
#[inline]
pub(super) fn combination<R: Real, V: Tangent<R>>(weights: &[f64; 3], v: &[V; 3]) -> V {
    weights.iter().zip(v).fold(V::zero(), |sum, (&weight, v)| sum.add_scaled(R::lit(weight), v))
}
