//! The angle of a point, and the inverse functions that follow from it, for `f32` and `f64`, each in its own arithmetic alone.
//!
//! By symmetry the angle is `k pi/4 +- atan(n/d)`: with `a` the lesser and `b` the greater of `|x|` and `|y|` the quotient is
//! `a/b` up to a half and `(a - b)/(a + b)` beyond (Muller, Elementary Functions, 3rd edition, section 11.5.2), so it
//! lies in [-1/3, 1/2]. There `a - b` is exact (Sterbenz 1974) and what the sum `a + b` rounds off is kept (Dekker
//! 1971). One reciprocal gives the quotient `t`; the remainder `n - t d`, from halves whose products are exact, gives
//! what `t` misses. `k pi/4` has two parts, the first with two bits left over, so `3 pi/4` is exact too.
//!
//! On `t` stands a minimax polynomial in the relative error (Remez; `runtime/tools/trigonometry.py`). Small terms are added
//! before the great ones, in a stated order and never fused, so the result is the same on every machine. Both numbers
//! are first scaled by a power of two that lets nothing overflow or lose bits. Zeros, infinities and NaN are not
//! branches: bits of positive numbers compare as integers do, and masks choose.

macro_rules! arctangent {
    ($float:ident, $bits:ty, $mantissa:expr, $quarter:expr, $arctangent:expr) => {
        pub(crate) mod $float {
            use super::super::polynomial::$float as polynomial;

            const BITS: u32 = <$bits>::BITS;
            /// Bits of a number behind the point.
            const MANTISSA: u32 = $mantissa;
            const BIAS: $bits = (1 << (BITS - 2 - MANTISSA)) - 1;
            const SIGN: $bits = 1 << (BITS - 1);
            const INFINITY: $bits = $float::INFINITY.to_bits();
            /// pi/4 in parts; the last two bits of the first are zero.
            const QUARTER: [$float; 2] = $quarter;
            /// (atan(t) / t - 1) / t^2 by powers of t^2.
            const ARCTANGENT: &[$float] = &$arctangent;

            /// Ones where the first of two numbers below [`SIGN`] is less.
            #[inline(always)]
            fn less(a: $bits, b: $bits) -> $bits {
                (a.wrapping_sub(b) >> (BITS - 1)).wrapping_neg()
            }

            /// The number, or zero where the mask is.
            #[inline(always)]
            fn masked(x: $float, mask: $bits) -> $float {
                $float::from_bits(x.to_bits() & mask)
            }

            /// The angle of the point `(x, y)` from the axis x on, between -pi and pi. [rad]
            #[inline]
            pub(crate) fn atan2(y: $float, x: $float) -> $float {
                let (y, x) = (y.to_bits(), x.to_bits());
                let (height, width) = (y & !SIGN, x & !SIGN);
                let steep = less(width, height);
                let swap = (height ^ width) & steep;
                let (a, b) = (height ^ swap, width ^ swap);

                // Infinite: one to one of two that are, else zero. Both zero: zero to one. NaN is the greater and stays.
                let (endless, both) = (less(b ^ INFINITY, 1), less(a ^ INFINITY, 1));
                let exponent = 1 << MANTISSA;
                let a = (a & (!endless | both)).wrapping_sub(both & endless & exponent);
                let b = b.wrapping_sub(endless & exponent).wrapping_sub(less(b, 1));

                // The greater becomes 2^(half of the greatest exponent), or the most that a number below that can.
                const MOST: $bits = 2 * BIAS;
                let wanted = MOST + BIAS.div_ceil(2) - (b >> MANTISSA);
                let scale = wanted ^ ((wanted ^ MOST) & less(MOST, wanted));
                let scale = $float::from_bits(scale << MANTISSA);
                let (a, b) = ($float::from_bits(a) * scale, $float::from_bits(b) * scale);

                let diagonal = less(b.to_bits(), (a + a).to_bits());
                let n = a - masked(b, diagonal);
                let addend = masked(a, diagonal);
                let d = b + addend;
                let missing = addend - (d - b);

                let inverse = 1.0 / d;
                let t = n * inverse;
                const UPPER: $bits = <$bits>::MAX << MANTISSA.div_ceil(2);
                let (upper, divisor) = (masked(t, UPPER), masked(d, UPPER));
                let rest = ((n - upper * divisor) - (t - upper) * divisor) - t * ((d - divisor) + missing);
                let rest = rest * inverse;

                // Turned about pi/4 k times, and mirrored where one of two mirrors is.
                let left = (x >> (BITS - 1)).wrapping_neg();
                let mirror = (steep ^ left) & SIGN;
                let k = diagonal & 1;
                let k = (k ^ steep).wrapping_add(steep & 3);
                let k = (k ^ left).wrapping_add(left & 5) as u32 as $float;
                let (t, rest) = ($float::from_bits(t.to_bits() ^ mirror), $float::from_bits(rest.to_bits() ^ mirror));

                let z = t * t;
                let bend = t * (z * polynomial(ARCTANGENT, z));
                let turned = k * QUARTER[0];
                let angle = turned + t;
                let lost = t - (angle - turned);
                let angle = angle + (lost + (k * QUARTER[1] + ((rest - rest * z) + bend)));
                $float::from_bits(angle.to_bits() ^ (y & SIGN))
            }
        }
    };
}

arctangent!(
    f32,
    u32,
    23,
    [f32::from_bits(0x3f49_0fd8), 1.569_582_4e-7],
    [-0.333_332_33, 0.199_941_68, -0.141_742_13, 0.101_558_35, -0.051_251_62]
);
arctangent!(
    f64,
    u64,
    52,
    [core::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17],
    [
        -0.333_333_333_333_333_15,
        0.199_999_999_999_937_64,
        -0.142_857_142_849_980_33,
        0.111_111_110_700_345_88,
        -0.090_909_077_051_855_54,
        0.076_922_776_368_134_7,
        -0.066_662_249_408_518_67,
        0.058_778_151_092_467_94,
        -0.052_300_428_051_736_26,
        0.045_895_199_930_738_054,
        -0.037_119_730_891_449_196,
        0.023_655_601_380_941_66,
        -0.008_365_643_674_687_27
    ]
);
