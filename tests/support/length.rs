//! The length of a quaternion, to more digits than it has.

use multibody::nalgebra::UnitQuaternion;

/// By how much the length differs from one: squares are summed with their roundings.
pub fn length_gap(q: &UnitQuaternion<f64>) -> f64 {
    let (mut sum, mut rest) = (-1.0, 0.0);
    for x in q.as_ref().coords.iter() {
        let square = x * x;
        let next: f64 = sum + square;
        let part = next - sum;
        rest += x.mul_add(*x, -square) + (sum - (next - part)) + (square - part);
        sum = next;
    }
    0.5 * (sum + rest).abs()
}
