//! Reduction of large angles modulo pi/2 (Payne and Hanek 1983), in integers, with one fixed number of operations.
//!
//! With `x = m 2^e` the product of `m` and those bits of 2/pi that matter, three words from the one of weight 2^(1-e) on,
//! is `x 2/pi` modulo four: what stands before them adds multiples of four. Of a quarter turn, what follows is below
//! 2^(p+2-3w) for words of `w` bits and `p` bits of `m`, and the product's own 2w bits cut off less than 2^(2-2w). The fraction, normalised and multiplied by pi/2, is split in two floats.

macro_rules! reduction {
    ($float:ident, $word:ty, $double:ty, $signed:ty, $mantissa:expr, $half_pi:expr, $words:expr) => {
        /// The multiple of pi/2 next to a finite `x` beyond a thousand, and the remainder: a float, and what it is too great by.
        #[cold]
        #[inline(never)]
        pub(super) fn $float(x: $float) -> ($word, $float, $float) {
            const WORD: u32 = <$word>::BITS;
            const MANTISSA: u32 = $mantissa;
            const EXPONENTS: u32 = (1 << (WORD - 1 - MANTISSA)) - 1;
            const BIAS: u32 = EXPONENTS >> 1;
            /// A word of zeros, then 2/pi.
            const TWO_OVER_PI: &[$word] = &$words;
            /// pi/2 with one bit before the point.
            const HALF_PI: $double = $half_pi;

            let bits = x.to_bits();
            let exponent = (bits >> MANTISSA) as u32 & EXPONENTS;
            let mantissa = bits & ((1 << MANTISSA) - 1) | 1 << MANTISSA;

            // The first bit of weight 2^(1-e) stands at e - 2 behind the word of zeros, e = exponent - BIAS - MANTISSA.
            let first = (exponent + WORD).wrapping_sub(2 + BIAS + MANTISSA);
            let word = |k: u32| TWO_OVER_PI.get((first / WORD + k) as usize).copied().unwrap_or(0);
            let shift = first % WORD;
            let window = |k: u32| (word(k) << shift | word(k + 1) >> 1 >> (WORD - 1 - shift)) as $double;
            let m = mantissa as $double;
            let product = ((m * window(0)) << WORD).wrapping_add(m * window(1)).wrapping_add((m * window(2)) >> WORD);

            // Two bits of quadrant, then the fraction, which is rounded to the nearest quarter turn.
            let quadrant = (product >> (2 * WORD - 2)) as $word + ((product >> (2 * WORD - 3)) as $word & 1);
            let fraction = (product << 2) as $signed;
            let zeros = fraction.unsigned_abs().leading_zeros() % (2 * WORD);
            let upper = (fraction.unsigned_abs() << zeros) >> WORD;
            let r = ((upper * HALF_PI) >> WORD) as $word;
            // Both parts are exact: the lower takes the bits that a float cannot hold.
            let rest = r & ((1 << (WORD - 1 - MANTISSA)) - 1);
            let scale = $float::from_bits(((1 + BIAS - WORD).wrapping_sub(zeros) as $word) << MANTISSA);
            let invalid = x - x; // zero, but NaN for what is not finite
            let (upper, over) = ((r - rest) as $float * scale + invalid, -(rest as $float * scale));
            let (upper, over) = if fraction < 0 { (-upper, -over) } else { (upper, over) };
            if x < 0.0 { (quadrant.wrapping_neg(), -upper, -over) } else { (quadrant, upper, over) }
        }
    };
}

reduction!(
    f32,
    u32,
    u64,
    i64,
    23,
    0xc90f_daa2,
    [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab]
);
reduction!(
    f64,
    u64,
    u128,
    i128,
    52,
    0xc90f_daa2_2168_c235,
    [
        0,
        0xa2f9_836e_4e44_1529,
        0xfc27_57d1_f534_ddc0,
        0xdb62_9599_3c43_9041,
        0xfe51_63ab_debb_c561,
        0xb724_6e3a_424d_d2e0,
        0x0649_2eea_09d1_921c,
        0xfe1d_eb1c_b129_a73e,
        0xe882_35f5_2ebb_4484,
        0xe99c_7026_b45f_7e41,
        0x3991_d639_8353_39f4,
        0x9c84_5f8b_bdf9_283b,
        0x1ff8_97ff_de05_980f,
        0xef2f_118b_5a0a_6d1f,
        0x6d36_7ecf_27cb_09b7,
        0x4f46_3f66_9e5f_ea2d,
        0x7527_bac7_ebe5_f17b,
        0x3d07_39f7_8a52_92ea,
        0x6bfb_5fb1_1f8d_5d08,
        0x5603_3046_fc7b_6bab
    ]
);
