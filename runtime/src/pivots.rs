//! Pivots of a mass matrix, for generated models: which coordinate has no inertia.

use nalgebra::SMatrix;

use crate::scalar::{Real, all};

/// The coordinate of the first pivot of a mass matrix, eliminated from the last to the first, that rounding leaves nothing
/// of; `None` for a regular matrix, and for one that is not finite, which says nothing.
#[must_use]
pub fn without_inertia<T: Real, const N: usize>(
    matrix: &SMatrix<T, N, N>,
    coordinates: &[&'static str; N],
) -> Option<&'static str> {
    let mut a = *matrix;
    for (k, coordinate) in coordinates.iter().enumerate().rev() {
        if !a.iter().all(|&entry| all(Real::is_finite(entry))) {
            return None;
        }
        let pivot = a[(k, k)];
        let rounding = T::lit(64.0) * T::epsilon() * Real::abs(matrix[(k, k)]);
        if !all(Real::gt(pivot, rounding)) {
            return Some(coordinate);
        }
        for i in 0..k {
            let factor = a[(i, k)] / pivot;
            for j in 0..=i {
                let rest = a[(i, j)] - factor * a[(k, j)];
                a[(i, j)] = rest;
                a[(j, i)] = rest;
            }
        }
    }
    None
}
