//! Square matrices of a size that only their type knows: [`Square`].

use super::{ComplexFactors, Factors, Solve, solve};
use crate::tangent::pack;
use crate::{Real, Tangent};

/// A square matrix with rows of fixed length, so that code can be generic over its size: `[[T; N]; N]`, by rows.
///
/// ```
/// use multibody::linear::Square;
///
/// fn twice<M: Square<f64>>(m: &M) -> M { M::from_fn(|i, j| 2.0 * m.get(i, j)) }
/// assert_eq!(twice(&[[1.0, 2.0], [3.0, 4.0]]), [[2.0, 4.0], [6.0, 8.0]]);
/// let x = [[2.0, 0.0], [0.0, 4.0]].solution(&[1.0, 1.0]).0;
/// assert_eq!(x, [0.5, 0.25]);
/// ```
pub trait Square<T: Real>: Copy {
    /// Rows and columns.
    const SIZE: usize;
    /// `[T; SIZE]`.
    type Vector: Copy + AsRef<[T]> + AsMut<[T]>;
    /// `[E; SIZE]`, one entry for each row.
    type Array<E: Copy>: Copy + AsRef<[E]> + AsMut<[E]>;
    /// The matrix, factored once for several right sides.
    type Factors: Copy + Solve<Self::Vector>;
    /// A complex matrix of this size, factored.
    type ComplexFactors: Copy + Solve<(Self::Vector, Self::Vector)>;

    /// The matrix with the entry `entry(row, column)` everywhere. Entries are asked for once each, row by row and from the
    /// first column to the last.
    fn from_fn(entry: impl FnMut(usize, usize) -> T) -> Self;

    /// The vector with the component `entry(row)` everywhere.
    fn vector(entry: impl FnMut(usize) -> T) -> Self::Vector;

    /// The vector with the components of another one in their order, and zeros where that has fewer.
    #[inline]
    fn packed(vector: &impl Tangent<T>) -> Self::Vector {
        let mut list = Self::vector(|_| T::lit(0.0));
        pack(vector, list.as_mut());
        list
    }

    /// The array with the entry `entry(row)` everywhere.
    fn array<E: Copy>(entry: impl FnMut(usize) -> E) -> Self::Array<E>;

    /// An entry; zero outside of the matrix.
    fn get(&self, row: usize, column: usize) -> T;

    /// Solves `self * x = b` by [`solve`], with the rank.
    fn solution(&self, b: &Self::Vector) -> (Self::Vector, T);

    /// `self * x`.
    fn times(&self, x: &Self::Vector) -> Self::Vector;

    /// Factors the matrix.
    fn factors(&self) -> Self::Factors;

    /// Factors the complex matrix `self + i imaginary`.
    fn complex_factors(&self, imaginary: &Self) -> Self::ComplexFactors;
}

impl<T: Real, const N: usize> Square<T> for [[T; N]; N] {
    const SIZE: usize = N;
    type Vector = [T; N];
    type Array<E: Copy> = [E; N];
    type Factors = Factors<T, N>;
    type ComplexFactors = ComplexFactors<T, N>;

    #[inline]
    fn from_fn(mut entry: impl FnMut(usize, usize) -> T) -> Self {
        core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
    }
    #[inline]
    fn vector(entry: impl FnMut(usize) -> T) -> [T; N] {
        core::array::from_fn(entry)
    }
    #[inline]
    fn array<E: Copy>(entry: impl FnMut(usize) -> E) -> [E; N] {
        core::array::from_fn(entry)
    }
    #[inline]
    fn get(&self, row: usize, column: usize) -> T {
        self.as_slice().get(row).and_then(|r| r.as_slice().get(column)).copied().unwrap_or_else(|| T::lit(0.0))
    }
    #[inline]
    fn solution(&self, b: &[T; N]) -> ([T; N], T) {
        solve(*self, *b)
    }
    #[inline]
    fn times(&self, x: &[T; N]) -> [T; N] {
        core::array::from_fn(|i| {
            let row = self.as_slice().get(i).into_iter().flatten();
            row.zip(x).fold(T::lit(0.0), |sum, (&a, &x)| sum + a * x)
        })
    }
    #[inline]
    fn factors(&self) -> Factors<T, N> {
        Factors::new(self)
    }
    #[inline]
    fn complex_factors(&self, imaginary: &Self) -> ComplexFactors<T, N> {
        ComplexFactors::new(self, imaginary)
    }
}
