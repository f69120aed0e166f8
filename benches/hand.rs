//! Baseline: forward dynamics of the double pendulum of `tests/data/robots`, written by hand.
//!
//! What a careful engineer gets: a recursion in body axes, pruned to the plane, the mass matrix by composite bodies, and
//! L^T D L. Both hinges turn about x, so that y and z are left. 19 add, 28 mul, 1 div, 2 sincos.

/// Constants of the two links: about the hinges, out of the data's numbers about the centres of mass.
mod links {
    /// [m] the second hinge in the first link, along z
    pub(super) const LENGTH: f64 = 0.1;
    const M1: f64 = 0.26703;
    pub(super) const M2: f64 = 0.33238;
    const C1: [f64; 2] = [2.1726999999999987e-06, 0.03601199999999998];
    const C2: [f64; 2] = [1.9371e-10, 0.10088];
    /// [kg m] first moments
    pub(super) const H1: [f64; 2] = [M1 * C1[0], M1 * C1[1]];
    pub(super) const H2: [f64; 2] = [M2 * C2[0], M2 * C2[1]];
    /// [kg m^2] second moments about the hinges
    const I1: f64 = 0.0004082700000000001 + M1 * (C1[0] * C1[0] + C1[1] * C1[1]);
    pub(super) const I2: f64 = 0.0011753 + M2 * (C2[0] * C2[0] + C2[1] * C2[1]);
    /// [kg m^2] of both about the first hinge, less what depends on the angle between them
    pub(super) const BOTH: f64 = I1 + I2 + M2 * LENGTH * LENGTH;
}

/// Accelerations for these angles, rates and efforts.
#[inline(never)]
pub fn forward_dynamics(q: &[f64; 2], v: &[f64; 2], effort: &[f64; 2]) -> [f64; 2] {
    use links::{BOTH, H1, H2, I2, LENGTH, M2};
    let (s1, c1) = q[0].sin_cos();
    let (s2, c2) = q[1].sin_cos();
    // Accelerations of the hinges in their links' axes, against gravity, for joints that do not accelerate.
    let (ay, az) = (9.81 * s1, 9.81 * c1);
    let pz = az - v[0] * v[0] * LENGTH;
    let by = c2 * ay + s2 * pz;
    let bz = c2 * pz - s2 * ay;
    // Force on the second link, moments about both hinges.
    let rate = v[0] + v[1];
    let square = rate * rate;
    let fy = M2 * by - square * H2[0];
    let fz = M2 * bz - square * H2[1];
    let bias2 = H2[0] * bz - H2[1] * by;
    let bias1 = (H1[0] * az - H1[1] * ay) + bias2 - LENGTH * (c2 * fy - s2 * fz);
    // The mass matrix, by composite bodies: [BOTH + 2 k, I2 + k; I2 + k, I2].
    let k = const { LENGTH * H2[0] } * s2 + const { LENGTH * H2[1] } * c2;
    let m11 = BOTH + 2.0 * k;
    let m12 = I2 + k;
    // L^T D L from the tip.
    let l = m12 * const { 1.0 / I2 };
    let r2 = effort[1] - bias2;
    let a1 = (effort[0] - bias1 - l * r2) / (m11 - l * m12);
    [a1, r2 * const { 1.0 / I2 } - l * a1]
}
