//! Random displacements with which searches leave places where they make no way.

use crate::scalar::Real;
use crate::tangent::Tangent;

/// Numbers between plus and minus `size` for all components whose weight in `free` is positive, zero for the others.
///
/// In the scalar's own arithmetic: a microcontroller with single precision has no other.
pub(crate) fn shaking<T: Real, V: Tangent<T>>(free: &V, random: &mut u32, size: T) -> V {
    free.map(&mut |weight| {
        // Knuth's linear congruence; its upper bits are good enough for a direction.
        *random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Real::select(Real::gt(weight, T::lit(0.0)), size * fraction(*random), T::lit(0.0))
    })
}

/// A number between -1 and 1, with one of the upper bits of `random` for each of its digits.
fn fraction<T: Real>(random: u32) -> T {
    let (one, half) = (T::lit(1.0), T::lit(0.5));
    (8..32).fold(T::lit(0.0), |sum, bit| half * (sum + if random >> bit & 1 == 0 { -one } else { one }))
}
