//! Sines and cosines of several angles, one after the other.

use super::Real;

/// Written out for as many angles as generated code asks for at a time: a loop over arrays stays one in code that is optimised for
/// size, and stores what it could keep in registers.
#[inline(always)]
pub(super) fn one_by_one<T: Real, const N: usize>(angles: [T; N]) -> [(T, T); N] {
    let zero = T::lit(0.0);
    let mut pairs = [(zero, zero); N];
    macro_rules! each {
        ($($k:literal)+) => { $(
            if N > $k {
                pairs[$k] = Real::sin_cos(angles[$k]);
            }
        )+ };
    }
    each!(0 1 2 3 4 5 6 7);
    for k in 8..N {
        pairs[k] = Real::sin_cos(angles[k]);
    }
    pairs
}
