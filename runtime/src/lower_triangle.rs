//! [`LowerTriangle`]: what `emit mass_matrix_lower` gives.

use crate::Real;
use nalgebra::{SMatrix, SVector};

/// A symmetric `N` x `N` matrix by its `P = N (N + 1) / 2` entries on and below the diagonal.
///
/// Of a mass matrix rows and columns are in the order of the velocity coordinates, and an entry has the unit of an effort
/// by an acceleration: kg m^2 for two angles, kg m for an angle and a travel, kg for two travels.
///
/// ```
/// use multibody::LowerTriangle;
/// use multibody::nalgebra::{SMatrix, SVector};
///
/// let mass = LowerTriangle::<f64, 2, 3>::from_packed([4.0, 1.0, 3.0]);
/// assert_eq!(mass.full(), SMatrix::from([[4.0, 1.0], [1.0, 3.0]]));
/// assert_eq!(mass.get(0, 1), Some(1.0));
/// assert_eq!(mass.times(&SVector::from([1.0, 2.0])), SVector::from([6.0, 7.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowerTriangle<T, const N: usize, const P: usize> {
    packed: [T; P],
}

impl<T: Real, const N: usize, const P: usize> LowerTriangle<T, N, P> {
    /// From entries row by row: (0, 0), (1, 0), (1, 1), (2, 0), ... Another `P` than `N (N + 1) / 2` does not compile.
    #[inline]
    #[must_use]
    pub fn from_packed(packed: [T; P]) -> Self {
        const { assert!(P == N * (N + 1) / 2, "a triangle of N rows has N (N + 1) / 2 entries") };
        LowerTriangle { packed }
    }

    /// The entries, row by row, each up to the diagonal.
    #[inline]
    #[must_use]
    pub fn packed(&self) -> &[T; P] {
        &self.packed
    }

    /// The entry of the symmetric matrix, on either side of the diagonal; nothing beyond `N` rows or columns.
    #[inline]
    #[must_use]
    pub fn get(&self, row: usize, column: usize) -> Option<T> {
        let (below, left) = if row < column { (column, row) } else { (row, column) };
        // Within N rows no number exceeds the length of the array twice.
        if below < N { self.packed.get(below * (below + 1) / 2 + left).copied() } else { None }
    }

    /// All of the symmetric matrix.
    #[inline]
    #[must_use]
    pub fn full(&self) -> SMatrix<T, N, N> {
        SMatrix::from_fn(|row, column| self.entry(row, column))
    }

    /// The matrix times a vector: efforts `M * accel`, momenta `M * v`. Each component is summed in the order of columns.
    #[inline]
    #[must_use]
    pub fn times(&self, vector: &SVector<T, N>) -> SVector<T, N> {
        SVector::from_fn(|row, _| {
            vector.iter().enumerate().fold(T::lit(0.0), |sum, (column, &x)| sum + self.entry(row, column) * x)
        })
    }

    fn entry(&self, row: usize, column: usize) -> T {
        self.get(row, column).unwrap_or(T::lit(0.0))
    }
}
