//! Sine and cosine of one `f32` angle in `f32` arithmetic alone.
//!
//! The `sinf` and `cosf` of libm compute in `f64`; on a processor without double precision they take nearly all the
//! time of a model. Here pi/2 is subtracted in three parts of few bits, so that their products with a multiple of up
//! to 2^12 are exact (Cody and Waite 1980), and polynomials with the coefficients of Cephes (Moshier, `sinf.c`) do the
//! rest. The error is at most 0.9e-7, three quarters of the rounding unit of one, against half a unit of a correctly
//! rounded function. The result is the same on every machine.

use super::float::single;

/// [rad] largest angle that is reduced here.
const LIMIT: f32 = 4096.0;
/// pi/2 in parts of 8, 11 and 24 bits.
const HALF_PI: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// Sine and cosine of `x` radians.
#[inline]
pub(super) fn sin_cos(x: f32) -> (f32, f32) {
    let positive = x.abs();
    if positive > LIMIT {
        return single::sin_cos(x);
    }
    let quadrant = (positive * core::f32::consts::FRAC_2_PI + 0.5) as i32; // NaN gives zero here, and NaN below
    let multiple = quadrant as f32;
    let r = ((positive - multiple * HALF_PI[0]) - multiple * HALF_PI[1]) - multiple * HALF_PI[2];

    let z = r * r;
    let sin = ((-1.951_529_6e-4 * z + 8.332_161e-3) * z - 1.666_665_5e-1) * z * r + r;
    let cos = ((2.443_315_7e-5 * z - 1.388_731_6e-3) * z + 4.166_664_6e-2) * (z * z) - 0.5 * z + 1.0;

    let (sin, cos) = if quadrant & 1 == 0 { (sin, cos) } else { (cos, sin) };
    // Second bits say where a function is negative: sine in the quadrants two and three, cosine in one and two.
    let sign = |quadrant: i32| (quadrant as u32 & 2) << 30;
    let odd = x.to_bits() & (1 << 31);
    (f32::from_bits(sin.to_bits() ^ sign(quadrant) ^ odd), f32::from_bits(cos.to_bits() ^ sign(quadrant + 1)))
}
