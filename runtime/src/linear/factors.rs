//! Factorisations that are kept for several right sides: [`Factors`] and, of a complex matrix, [`ComplexFactors`].
//!
//! In: a square matrix by rows. Out: `P A = L U` by Gaussian elimination with row pivots, judged after each row has been
//! divided by its greatest entry (implicit scaling; Higham 2002, Accuracy and Stability of Numerical Algorithms,
//! section 9.3). As everywhere in [`linear`](super), pivots are found by comparisons and brought into place by selects,
//! in each lane its own. There is no rank: a singular matrix has solutions that are not finite, which is what an
//! iteration that keeps its factors wants to see.

// A pivot's neighbours are found by index in rows and in columns.
#![allow(clippy::needless_range_loop)]

use super::{index, reciprocal, swapped};
use crate::Real;
use core::ops::{Mul, SubAssign};

/// Something that solves a linear system for one right side after another.
pub trait Solve<B> {
    /// The solution for the right side `b`; not finite if the matrix is singular.
    fn solve(&self, b: &B) -> B;
}

/// A real matrix, factored.
///
/// ```
/// use multibody::linear::{Solve, Square};
///
/// let factors = [[0.0, 2.0], [4.0, 1.0]].factors();
/// assert_eq!(factors.solve(&[2.0, 5.0]), [1.0, 1.0]);
/// assert_eq!(factors.solve(&[4.0, 2.0]), [0.0, 2.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Factors<T, const N: usize> {
    rows: [[T; N]; N],
    origin: [T; N],
}

/// A complex matrix, factored. Right sides and solutions are pairs: real parts, imaginary parts.
///
/// ```
/// use multibody::linear::{ComplexFactors, Solve};
///
/// let factors = ComplexFactors::new(&[[0.0]], &[[2.0]]); // 2i
/// assert_eq!(factors.solve(&([2.0], [4.0])), ([2.0], [-1.0]));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ComplexFactors<T, const N: usize> {
    rows: [[Complex<T>; N]; N],
    origin: [T; N],
}

impl<T: Real, const N: usize> Factors<T, N> {
    /// Factors a matrix, given by rows.
    #[inline]
    pub fn new(matrix: &[[T; N]; N]) -> Self {
        let mut rows = *matrix;
        let origin = eliminate(&mut rows);
        Self { rows, origin }
    }
}

impl<T: Real, const N: usize> Solve<[T; N]> for Factors<T, N> {
    #[inline]
    fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = *b;
        substitute(&self.rows, &self.origin, &mut x);
        x
    }
}

impl<T: Real, const N: usize> ComplexFactors<T, N> {
    /// Factors a matrix, given by the rows of its real and of its imaginary part.
    #[inline]
    pub fn new(real: &[[T; N]; N], imaginary: &[[T; N]; N]) -> Self {
        let mut rows = [[Complex { re: T::lit(0.0), im: T::lit(0.0) }; N]; N];
        for i in 0..N {
            for j in 0..N {
                rows[i][j] = Complex { re: real[i][j], im: imaginary[i][j] };
            }
        }
        let origin = eliminate(&mut rows);
        Self { rows, origin }
    }
}

impl<T: Real, const N: usize> Solve<([T; N], [T; N])> for ComplexFactors<T, N> {
    #[inline]
    fn solve(&self, (re, im): &([T; N], [T; N])) -> ([T; N], [T; N]) {
        let mut x = [Complex { re: T::lit(0.0), im: T::lit(0.0) }; N];
        for i in 0..N {
            x[i] = Complex { re: re[i], im: im[i] };
        }
        substitute(&self.rows, &self.origin, &mut x);
        (x.map(|x| x.re), x.map(|x| x.im))
    }
}

/// Leaves `U` on and above the diagonal, with inverse pivots on it, and `L` without its ones below; gives the row that
/// each pivot came from.
#[inline]
fn eliminate<T: Real, F: Field<T>, const N: usize>(a: &mut [[F; N]; N]) -> [T; N] {
    let zero = T::lit(0.0);
    let mut scale = [zero; N];
    for (scale, row) in scale.iter_mut().zip(a.iter()) {
        *scale = reciprocal(row.iter().fold(zero, |greatest, x| Real::max(greatest, x.size())));
    }
    let mut origin = [zero; N];
    for k in 0..N {
        let (mut size, mut pivot) = (a[k][k].size() * scale[k], index::<T>(k));
        for i in k + 1..N {
            let candidate = a[i][k].size() * scale[i];
            let larger = Real::lt(size, candidate);
            size = Real::select(larger, candidate, size);
            pivot = Real::select(larger, index(i), pivot);
        }
        for i in k + 1..N {
            let here = Real::eq(pivot, index(i));
            for j in 0..N {
                (a[k][j], a[i][j]) = F::swapped(here, a[k][j], a[i][j]);
            }
            (scale[k], scale[i]) = swapped(here, scale[k], scale[i]);
        }
        origin[k] = pivot;
        let inverse = a[k][k].inverse();
        a[k][k] = inverse;
        for i in k + 1..N {
            let factor = a[i][k] * inverse;
            a[i][k] = factor;
            for j in k + 1..N {
                let product = factor * a[k][j];
                a[i][j] -= product;
            }
        }
    }
    origin
}

/// Solves with what [`eliminate`] left.
#[inline]
fn substitute<T: Real, F: Field<T>, const N: usize>(a: &[[F; N]; N], origin: &[T; N], x: &mut [F; N]) {
    for k in 0..N {
        for i in k + 1..N {
            let here = Real::eq(origin[k], index(i));
            (x[k], x[i]) = F::swapped(here, x[k], x[i]);
        }
    }
    for k in 0..N {
        for i in k + 1..N {
            let product = a[i][k] * x[k];
            x[i] -= product;
        }
    }
    for k in (0..N).rev() {
        if k >= N {
            continue; // never; indices then need no check at any level of optimisation
        }
        let mut sum = x[k];
        for j in k + 1..N {
            sum -= a[k][j] * x[j];
        }
        x[k] = sum * a[k][k];
    }
}

/// What elimination asks of an entry with real parts of type `T`.
trait Field<T: Real>: Copy + Mul<Output = Self> + SubAssign {
    /// A measure of its size.
    fn size(self) -> T;
    fn inverse(self) -> Self;
    fn swapped(mask: T::Mask, a: Self, b: Self) -> (Self, Self);
}

impl<T: Real> Field<T> for T {
    #[inline]
    fn size(self) -> T {
        Real::abs(self)
    }
    #[inline]
    fn inverse(self) -> T {
        T::lit(1.0) / self
    }
    #[inline]
    fn swapped(mask: T::Mask, a: T, b: T) -> (T, T) {
        swapped(mask, a, b)
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug)]
struct Complex<T> {
    re: T,
    im: T,
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl<T: Real> SubAssign for Complex<T> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        self.re -= other.re;
        self.im -= other.im;
    }
}

impl<T: Real> Field<T> for Complex<T> {
    #[inline]
    fn size(self) -> T {
        Real::abs(self.re) + Real::abs(self.im)
    }
    /// Divided by the size first, so that no square overflows.
    #[inline]
    fn inverse(self) -> Self {
        let scale = T::lit(1.0) / self.size();
        let (re, im) = (self.re * scale, self.im * scale);
        let factor = scale / (re * re + im * im);
        Self { re: re * factor, im: -im * factor }
    }
    #[inline]
    fn swapped(mask: T::Mask, a: Self, b: Self) -> (Self, Self) {
        let (are, bre) = swapped(mask, a.re, b.re);
        let (aim, bim) = swapped(mask, a.im, b.im);
        (Self { re: are, im: aim }, Self { re: bre, im: bim })
    }
}
