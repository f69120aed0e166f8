//! Sine and cosine of one angle, for `f32` and `f64`, each in its own arithmetic alone.
//!
//! The angle is `n pi/2 + r` with `|r|` hardly above pi/4. Up to [`f32`: 12,800, `f64`: 1e6] radians `n` comes from the
//! rounding of a sum with 1.5 * 2^(p-1), and pi/2 is subtracted in four parts (Cody and Waite 1980): the first two fit
//! below one, so `x - n p1 - n p2` is exact; `n p3` is exact, and what its subtraction rounds off is kept
//! (Dekker 1971); `n p4` joins it. So the remainder `r - over` is known to more than twice the precision, and the closest approach of
//! a number to a multiple of pi/2 (2^-27.8 here for f32) is no special case. Larger angles go to [`super::reduction`].
//!
//! On the remainder stand minimax polynomials in the relative error; all numbers are those of `scalar/circle.rs`. The result
//! is made of sums and products in a stated order, never fused, so it is the same on every machine; up to the limit the
//! instructions are the same for every angle, NaN too.

macro_rules! sine {
    ($float:ident, $bits:ty) => {
        pub(crate) mod $float {
            use super::super::super::circle::$float::{COSINE, HALF_PI, LIMIT, SHIFTER, SINE};
            use super::super::polynomial::$float as polynomial;

            /// Sine and cosine of `x` radians.
            #[inline]
            pub(crate) fn sin_cos(x: $float) -> ($float, $float) {
                let (quadrant, r, over) = if x.abs() > LIMIT {
                    super::super::reduction::$float(x)
                } else {
                    let shifted = x * core::$float::consts::FRAC_2_PI + SHIFTER;
                    let n = shifted - SHIFTER;
                    let exact = (x - n * HALF_PI[0]) - n * HALF_PI[1];
                    let third = n * HALF_PI[2];
                    let r = exact - third;
                    (shifted.to_bits(), r, n * HALF_PI[3] - ((exact - r) - third))
                };
                let z = r * r;
                let sin = r - (over - r * (z * polynomial(&SINE, z)));
                let cos = 1.0 + (z * (z * polynomial(&COSINE, z) - 0.5) + over * r);

                // Bits change places under a mask, where a choice might become a jump. Second bits of the quadrant say where
                // a function is negative: sine in the quadrants two and three, cosine in one and two.
                let (sin, cos) = (sin.to_bits(), cos.to_bits());
                let swap = (sin ^ cos) & (quadrant & 1).wrapping_neg();
                let sign = |quadrant: $bits| (quadrant & 2) << (<$bits>::BITS - 2);
                let (sin, cos) = (sin ^ swap ^ sign(quadrant), cos ^ swap ^ sign(quadrant.wrapping_add(1)));
                ($float::from_bits(sin), $float::from_bits(cos))
            }
        }
    };
}

sine!(f32, u32);
sine!(f64, u64);
