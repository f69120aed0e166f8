//! Horner's scheme, never fused. The number of coefficients is known where it is called, so nothing of the loop is left.

macro_rules! polynomial {
    ($float:ident) => {
        #[inline(always)]
        pub(super) fn $float(coefficients: &[$float], z: $float) -> $float {
            let mut sum = 0.0;
            for (k, c) in coefficients.iter().rev().enumerate() {
                sum = if k == 0 { *c } else { sum * z + *c };
            }
            sum
        }
    };
}

polynomial!(f32);
polynomial!(f64);
