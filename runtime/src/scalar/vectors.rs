//! Sines and cosines of several `f64` or `f32`, in vectors of [`super::lanes`].
//!
//! This is where std's functions would be called otherwise: with std and `wide`, unless `std-sines` asks for std's, or
//! `reproducible` for those that are the same everywhere. From two angles on it is faster in both scalars, with any
//! instructions of x86-64 (`cargo bench --bench angles`). An odd angle at the end rides in a vector of its own, which takes
//! no longer than std; one angle alone is std's. Where an angle is beyond the limit of the vectors, std takes those of its vector.
//!
//! Vectors are written out for as many angles as generated code asks for at a time. Arrays and slices that a loop or a function
//! that is not inlined reads would be stored as scalars and loaded as vectors, which stalls for longer than the sines take.

/// `$small` angles or `$large` at a time; the last vector is filled up with the last angle.
macro_rules! in_vectors {
    ($float:ident, $scalar:ident: $small:ident $few:ident [$($i:literal)+], $large:ident $many:ident [$($k:literal)+]) => {
        pub(super) mod $float {
            use crate::scalar::float::$scalar;
            use crate::scalar::{lanes, together};

            const FEW: usize = [$($i),+].len();
            const MANY: usize = [$($k),+].len();

            /// Beyond the limit of the vectors.
            #[cold]
            #[inline(never)]
            fn far(angle: $float) -> ($float, $float) {
                $scalar::sin_cos(angle)
            }

            #[inline(always)]
            pub(in crate::scalar) fn sin_cos<const N: usize>(angles: [$float; N]) -> [($float, $float); N] {
                if N < 2 {
                    return together::one_by_one(angles);
                }
                let mut pairs = [(0.0, 0.0); N];
                vector(&angles, &mut pairs, 0);
                if N > MANY {
                    vector(&angles, &mut pairs, MANY);
                }
                for first in (2 * MANY..N).step_by(MANY) {
                    vector(&angles, &mut pairs, first);
                }
                pairs
            }

            /// From the angle of number `first` on.
            #[inline(always)]
            fn vector<const N: usize>(angles: &[$float; N], pairs: &mut [($float, $float); N], first: usize) {
                let at = |k: usize| angles[(first + k).min(N - 1)];
                if N - first > FEW {
                    let x = wide::$many::new([$(at($k)),+]);
                    let found = if lanes::$large::is_far(x) {
                        [$(far(at($k))),+]
                    } else {
                        let (sin, cos) = lanes::$large::sin_cos(x);
                        let (sin, cos) = (sin.to_array(), cos.to_array());
                        [$((sin[$k], cos[$k])),+]
                    };
                    $(if first + $k < N { pairs[first + $k] = found[$k]; })+
                } else {
                    let x = wide::$few::new([$(at($i)),+]);
                    let found = if lanes::$small::is_far(x) {
                        [$(far(at($i))),+]
                    } else {
                        let (sin, cos) = lanes::$small::sin_cos(x);
                        let (sin, cos) = (sin.to_array(), cos.to_array());
                        [$((sin[$i], cos[$i])),+]
                    };
                    $(if first + $i < N { pairs[first + $i] = found[$i]; })+
                }
            }
        }
    };
}

in_vectors!(f64, double: pair f64x2 [0 1], quad f64x4 [0 1 2 3]);
in_vectors!(f32, single: single_quad f32x4 [0 1 2 3], single_octet f32x8 [0 1 2 3 4 5 6 7]);
