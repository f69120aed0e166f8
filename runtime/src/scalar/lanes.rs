//! Sine and cosine of several angles at once, in vectors of the crate `wide`.
//!
//! Angles are reduced as in `software/sine.rs`: up to a limit, 12,800 rad in `f32` and a million in `f64`, by four parts of pi/2,
//! which leaves the remainder `r - over` to more than twice the precision; whoever calls asks `is_far` first.
//! The polynomials are the same, but added up in pairs, since an evaluation waits for its sines; and of
//! `1 - z / 2` in the cosine what the subtraction rounds off is kept (Dekker 1971), which takes two operations more and leaves
//! less than one unit in the last place: 0.98 in `f32`, where all were tried, 0.84 in `f64` among 200,000. There is no choice between
//! values and no fused product, so all ordinary angles take the same instructions, NaN too; it comes out as NaN, and -0 as -0.
//!
//! The loops that a compiler makes of arrays are erratic, so vectors are written out.

macro_rules! three {
    ($all:ident, $c:ident, $z:ident) => {
        $all($c[0]) + $z * ($all($c[1]) + $z * $all($c[2]))
    };
}

/// Neighbours are added up first, then neighbours of these (Estrin).
macro_rules! six {
    ($all:ident, $c:ident, $z:ident) => {{
        let squared = $z * $z;
        let [low, middle, high] =
            [$all($c[0]) + $z * $all($c[1]), $all($c[2]) + $z * $all($c[3]), $all($c[4]) + $z * $all($c[5])];
        low + squared * (middle + squared * high)
    }};
}

macro_rules! lanes {
    ($name:ident: $lanes:ident of $float:ident, $bits:ident of $word:ident, $polynomial:ident) => {
        pub(super) mod $name {
            use crate::scalar::circle::$float::{COSINE, HALF_PI, LIMIT, SHIFTER, SINE};
            use wide::bytemuck::cast;
            use wide::{$bits, $lanes};

            /// Whether a lane is beyond what [`sin_cos`] reduces.
            #[inline(always)]
            pub(in crate::scalar) fn is_far(angles: $lanes) -> bool {
                angles.abs().simd_gt($lanes::splat(LIMIT)).to_bitmask() != 0
            }

            /// Sines and cosines of ordinary angles [rad].
            #[inline(always)]
            pub(in crate::scalar) fn sin_cos(x: $lanes) -> ($lanes, $lanes) {
                let all = $lanes::splat;
                let shifted = x * all(core::$float::consts::FRAC_2_PI) + all(SHIFTER);
                let n = shifted - all(SHIFTER);
                let exact = (x - n * all(HALF_PI[0])) - n * all(HALF_PI[1]);
                let third = n * all(HALF_PI[2]);
                let r = exact - third;
                let over = n * all(HALF_PI[3]) - ((exact - r) - third);

                let z = r * r;
                let sin = r - (over - r * (z * $polynomial!(all, SINE, z)));
                let half = all(0.5) * z;
                let most = all(1.0) - half;
                let cos = most + (((all(1.0) - most) - half) + (z * (z * $polynomial!(all, COSINE, z)) + over * r));

                // Sine and cosine change places in odd quadrants; second bits say where a function is negative: sine in the
                // quadrants two and three, cosine in one and two.
                let quadrant: $bits = cast(shifted);
                let odd: $lanes = cast($bits::splat(0) - (quadrant & $bits::splat(1)));
                let swap = (sin ^ cos) & odd;
                let sign = |quadrant: $bits| -> $lanes { cast((quadrant & $bits::splat(2)) << ($word::BITS - 2)) };
                (sin ^ swap ^ sign(quadrant), cos ^ swap ^ sign(quadrant + $bits::splat(1)))
            }
        }
    };
}

// Lanes of this size no scalar has: they are for a few angles of `f64`.
#[cfg(all(feature = "std", not(feature = "std-sines")))]
lanes!(pair: f64x2 of f64, u64x2 of u64, six);
lanes!(quad: f64x4 of f64, u64x4 of u64, six);
lanes!(single_quad: f32x4 of f32, u32x4 of u32, three);
lanes!(single_octet: f32x8 of f32, u32x8 of u32, three);
