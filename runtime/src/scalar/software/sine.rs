//! Sine and cosine of one angle, for `f32` and `f64`, each in its own arithmetic alone.
//!
//! The angle is `n pi/2 + r` with `|r|` hardly above pi/4. Up to [`f32`: 12,800, `f64`: 1e6] radians `n` comes from the
//! rounding of a sum with 1.5 * 2^(p-1), and pi/2 is subtracted in four parts (Cody and Waite 1980): the first two fit
//! below one, so `x - n p1 - n p2` is exact; `n p3` is exact, and what its subtraction rounds off is kept
//! (Dekker 1971); `n p4` joins it. So the remainder `r - over` is known to more than twice the precision, and the closest approach of
//! a number to a multiple of pi/2 (2^-27.8 here for f32) is no special case. Larger angles go to [`super::reduction`].
//!
//! On the remainder stand minimax polynomials in the relative error (Remez; `runtime/tools/trigonometry.py` makes all
//! numbers here). The result is made of sums and products in a stated order, never fused, so it is the same on every
//! machine; up to the limit the instructions are the same for every angle, NaN too.

macro_rules! sine {
    ($float:ident, $bits:ty, $shifter:expr, $limit:expr, $parts:expr, $sine:expr, $cosine:expr) => {
        pub(crate) mod $float {
            use super::super::polynomial::$float as polynomial;

            /// [rad] largest angle that is reduced by subtraction.
            const LIMIT: $float = $limit;
            /// Added and subtracted, it rounds to the nearest whole number; the lowest bits of the sum are that number's.
            const SHIFTER: $float = $shifter;
            /// pi/2 in parts.
            const HALF_PI: [$float; 4] = $parts;
            /// (sin(r) / r - 1) / r^2 by powers of r^2.
            const SINE: &[$float] = &$sine;
            /// (cos(r) - 1 + r^2 / 2) / r^4 by powers of r^2.
            const COSINE: &[$float] = &$cosine;

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
                let sin = r - (over - r * (z * polynomial(SINE, z)));
                let cos = 1.0 + (z * (z * polynomial(COSINE, z) - 0.5) + over * r);

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

sine!(
    f32,
    u32,
    12_582_912.0,
    12_800.0,
    [1.570_312_5, 4.837_513e-4, 7.549_533_6e-8, 2.563_344_2e-12],
    [-0.166_666_55, 0.008_332_189, -0.000_195_182_85],
    [0.041_666_646, -0.001_388_731, 2.443_232_7e-5]
);
sine!(
    f64,
    u64,
    6_755_399_441_055_744.0,
    1.0e6,
    [1.570_796_326_734_125_6, 6.077_094_383_272_197e-11, 6.123_233_994_092_14e-17, 1.644_625_693_632_425_8e-26],
    [
        -0.166_666_666_666_666_3,
        0.008_333_333_333_321_84,
        -0.000_198_412_698_293_585_28,
        2.755_731_353_851_453e-6,
        -2.505_073_438_940_085_4e-8,
        1.589_543_330_610_078e-10
    ],
    [
        0.041_666_666_666_666_595,
        -0.001_388_888_888_887_333_8,
        2.480_158_728_899_748e-5,
        -2.755_731_421_529_909e-7,
        2.087_570_511_498_386e-9,
        -1.135_873_277_503_408_8e-11
    ]
);
