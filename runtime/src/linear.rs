//! Small dense linear systems: [`solve`], [`solve_symmetric`], [`least_norm`], for any scalar and free of branches that
//! depend on numbers.
//!
//! In: a matrix and a right side of fixed size. Out: a solution and the numerical rank, in each lane its own. Every
//! input costs the same: loops are counted, pivots are found by comparisons and brought into place by selects.
//! Generated code calls these functions where no closed form is left, and counts them.
//!
//! All three pivot completely and judge a pivot after the rows and columns have been brought to one scale, so that the
//! rank doesn't depend on units. A pivot counts if it exceeds `16 N` roundings of the scalar, where the greatest
//! possible is one: 2e-14 for a 6x6 system in `f64`, 1e-5 in `f32`. What stands behind the rank is left out: such
//! unknowns are zero, such equations are not met. Complete pivoting leaves the error of a solution at a few roundings
//! of the system (Higham 2002, Accuracy and Stability of Numerical Algorithms, chapters 9 and 10), where refinement
//! in the same precision gains nothing; there is none.
//!
//! NaN and infinity never vanish behind the rank: where the matrix has one, the rank and every component are NaN;
//! where the right side has one, a component is not finite.

// A pivot's neighbours are found by index in rows and in columns.
#![allow(clippy::needless_range_loop)]

mod factors;
mod square;

pub use factors::{ComplexFactors, Factors, Solve};
pub use square::Square;

use crate::Real;
use nalgebra::{SMatrix, SVector};

/// Solves `a x = b` with a square matrix, given by rows, by Gaussian elimination with complete pivoting. Gives `x` and
/// the rank of `a`.
///
/// Rows and columns are scaled by their greatest entries first. Beyond the rank a solution is one of many if `b` lies in
/// the range of `a`, and otherwise no solution; compare the rank with `N`.
///
/// ```
/// use multibody::linear::solve;
///
/// let (x, rank) = solve([[0.0, 2.0], [1.0, 1.0]], [4.0_f64, 3.0]);
/// assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
/// assert_eq!(rank, 2.0);
///
/// let (x, rank) = solve([[1.0, 1.0], [1.0, 1.0]], [2.0_f32, 2.0]);
/// assert_eq!(x[0] + x[1], 2.0);
/// assert_eq!(rank, 1.0);
/// ```
#[inline]
pub fn solve<T: Real, const N: usize>(mut a: [[T; N]; N], mut b: [T; N]) -> ([T; N], T) {
    let (zero, one) = (T::lit(0.0), T::lit(1.0));
    let scale = equilibrate(&mut a, &mut b);
    let threshold = threshold::<T>(N);
    let mut origin = [zero; N];
    let mut inverse = [zero; N];
    let mut rank = zero;

    for k in 0..N {
        let (mut size, mut row, mut column) = (Real::abs(a[k][k]), index::<T>(k), index::<T>(k));
        for i in k..N {
            for j in k..N {
                let candidate = Real::abs(a[i][j]);
                let larger = Real::lt(size, candidate);
                size = Real::select(larger, candidate, size);
                row = Real::select(larger, index(i), row);
                column = Real::select(larger, index(j), column);
            }
        }
        for i in k + 1..N {
            let here = Real::eq(row, index(i));
            for j in k..N {
                (a[k][j], a[i][j]) = swapped(here, a[k][j], a[i][j]);
            }
            (b[k], b[i]) = swapped(here, b[k], b[i]);
        }
        for j in k + 1..N {
            let here = Real::eq(column, index(j));
            for i in 0..N {
                (a[i][k], a[i][j]) = swapped(here, a[i][k], a[i][j]);
            }
        }
        origin[k] = column;

        let dropped = Real::le(size, threshold); // false for NaN
        rank += Real::select(dropped, zero, one) + residue(size);
        inverse[k] = Real::select(dropped, zero, one / Real::select(dropped, one, a[k][k]));
        for i in k + 1..N {
            let factor = a[i][k] * inverse[k];
            for j in k + 1..N {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }

    // An inverse of zero makes an unknown beyond the rank zero, and NaN where its equation has come to be NaN.
    let mut x = [zero; N];
    for k in (0..N).rev() {
        if k >= N {
            continue; // never; indices then need no check at any level of optimisation
        }
        let mut sum = b[k];
        for j in k + 1..N {
            sum -= a[k][j] * x[j];
        }
        x[k] = sum * inverse[k];
    }
    unpermute(&mut x, &origin);
    for (x, scale) in x.iter_mut().zip(scale) {
        *x = *x * scale + residue(rank);
    }
    (x, rank)
}

/// Solves `a x = b` with a symmetric matrix that has no negative eigenvalue, by `L D L^T` with diagonal pivoting. Gives
/// `x` and the rank of `a`.
///
/// Only the diagonal and what is left of it are read. A pivot is measured by the diagonal entry that it came from, which
/// is the same as bringing the diagonal to ones first: a Schur complement `G M^-1 G^T` with masses or units far apart
/// loses no digit to that. A matrix of this kind holds squares, so equations that differ by less than the root of the
/// threshold (3e-7 in `f64`) count as one.
///
/// ```
/// use multibody::linear::solve_symmetric;
///
/// // Two equations of very different scale, and a third that repeats the first.
/// let a = [[2e12, 1.0, 2e12], [1.0, 1e-9, 1.0], [2e12, 1.0, 2e12]];
/// let (x, rank) = solve_symmetric(a, [2e12_f64, 1.0, 2e12]);
/// assert_eq!(rank, 2.0);
/// assert!((x[0] + x[2] - 1.0).abs() < 1e-14 && x[1].abs() < 1e-14);
/// ```
#[inline]
pub fn solve_symmetric<T: Real, const N: usize>(a: [[T; N]; N], b: [T; N]) -> ([T; N], T) {
    solve_symmetric_in_groups(a, b, &each::<N>())
}

/// The same where equations belong together, and are compared: `groups` says which, by equal numbers.
///
/// Equations of one group have one unit, such as the three that hold two points together. One that is smaller than the
/// greatest of its group by the threshold is what rounding has left of an equation that vanishes, and counts as none.
///
/// ```
/// use multibody::linear::solve_symmetric_in_groups;
///
/// let a = [[1.0, 1e-17, 0.0], [1e-17, 1e-33, 0.0], [0.0, 0.0, 1e-33]];
/// let (x, rank) = solve_symmetric_in_groups(a, [1.0_f64, 1e-17, 1e-33], &[0, 0, 1]);
/// assert_eq!((x, rank), ([1.0, 0.0, 1.0], 2.0));
/// ```
#[inline]
pub fn solve_symmetric_in_groups<T: Real, const N: usize>(
    a: [[T; N]; N],
    b: [T; N],
    groups: &[usize; N],
) -> ([T; N], T) {
    let mut diagonal = [T::lit(0.0); N];
    for k in 0..N {
        diagonal[k] = a[k][k];
    }
    solve_symmetric_measured(a, b, diagonal, groups)
}

/// The same where a pivot is not measured by the diagonal entry that it came from, but by `measures`, each in the unit of its
/// entry: what the entry was made of, where `a` is what an elimination has left. What has cancelled there is rounding, and a
/// pivot below the threshold of it counts as none.
///
/// ```
/// use multibody::linear::solve_symmetric_measured;
///
/// // The second entry is what is left of 1e9.
/// let a = [[1.0, 0.0], [0.0, 1e-7]];
/// let (x, rank) = solve_symmetric_measured(a, [1.0_f64, 1.0], [1.0, 1e9], &[0, 1]);
/// assert_eq!((x, rank), ([1.0, 0.0], 1.0));
/// ```
#[inline]
pub fn solve_symmetric_measured<T: Real, const N: usize>(
    mut a: [[T; N]; N],
    mut b: [T; N],
    measures: [T; N],
    groups: &[usize; N],
) -> ([T; N], T) {
    let (zero, one) = (T::lit(0.0), T::lit(1.0));
    let threshold = threshold::<T>(N);
    let mut scale = inverses_in_groups(&measures, groups, threshold * threshold);
    let mut origin = [zero; N];
    let mut rank = zero;

    for k in 0..N {
        let (mut size, mut pivot) = (a[k][k] * scale[k], index::<T>(k));
        for i in k + 1..N {
            let candidate = a[i][i] * scale[i];
            let larger = Real::lt(size, candidate);
            size = Real::select(larger, candidate, size);
            pivot = Real::select(larger, index(i), pivot);
        }
        // Left of the pivot and below it; the rows below only hold what is left of their diagonal.
        let (mut left, mut below) = (a[k], [zero; N]);
        for i in k..N {
            below[i] = a[i][k];
        }
        for i in k + 1..N {
            let here = Real::eq(pivot, index(i));
            for (x, y) in left.iter_mut().zip(&mut a[i]).take(k) {
                (*x, *y) = swapped(here, *x, *y);
            }
            for (x, y) in below.iter_mut().zip(&mut a[i]).take(i).skip(k + 1) {
                (*x, *y) = swapped(here, *x, *y);
            }
            for j in i + 1..N {
                (below[j], a[j][i]) = swapped(here, below[j], a[j][i]);
            }
            (below[k], a[i][i]) = swapped(here, below[k], a[i][i]);
            (b[k], b[i]) = swapped(here, b[k], b[i]);
            (scale[k], scale[i]) = swapped(here, scale[k], scale[i]);
        }
        a[k] = left;
        origin[k] = pivot;

        let dropped = Real::le(size, threshold); // false for NaN
        rank += Real::select(dropped, zero, one) + residue(size);
        let inverse = Real::select(dropped, zero, one / Real::select(dropped, one, below[k]));
        for i in k + 1..N {
            let factor = below[i] * inverse;
            for (x, &y) in a[i].iter_mut().zip(&below).take(i + 1).skip(k + 1) {
                *x -= factor * y;
            }
            a[i][k] = factor;
            b[i] -= factor * b[k];
        }
        b[k] *= inverse; // zero beyond the rank, and NaN where the right side is
    }

    for k in (0..N).rev() {
        if k >= N {
            continue; // never; indices then need no check at any level of optimisation
        }
        for i in k + 1..N {
            b[k] -= a[i][k] * b[i];
        }
    }
    unpermute(&mut b, &origin);
    (b.map(|x| x + residue(rank)), rank)
}

/// The displacement `d = W G^T (G W G^T)^+ r`: of all that satisfy `G d = r` the one for which the sum of
/// `d_j^2 / weights_j` is least. Gives `d` and the rank of `G W`.
///
/// A coordinate of weight zero stays where it is; weights are never negative. Rows count as independent whatever their
/// units, down to zero itself: where a row may vanish up to rounding, see [`least_norm_in_groups`]. Beyond the rank,
/// equations that repeat others are met with them, and equations that contradict others are not met.
///
/// The rows of `G` are made orthogonal one after the other, the one that is least dependent on the ones before first
/// (modified Gram-Schmidt with pivots, in the form of Björck 1994 for solutions of least norm), so that no square of `G`
/// is formed and rows count as independent down to the threshold itself.
///
/// ```
/// use multibody::{linear::least_norm, nalgebra::{Matrix1x3, Vector1, Vector3}};
///
/// let (g, r) = (Matrix1x3::new(1.0, 1.0, 0.0), Vector1::new(2.0_f64));
/// let (d, rank) = least_norm(&g, &r, &Vector3::new(1.0, 1.0, 1.0));
/// assert_eq!((d, rank), (Vector3::new(1.0, 1.0, 0.0), 1.0));
/// let (d, _) = least_norm(&g, &r, &Vector3::new(0.0, 1.0, 1.0)); // the first one is held
/// assert_eq!(d, Vector3::new(0.0, 2.0, 0.0));
/// ```
#[inline]
pub fn least_norm<T: Real, const M: usize, const N: usize>(
    g: &SMatrix<T, M, N>,
    r: &SVector<T, M>,
    weights: &SVector<T, N>,
) -> (SVector<T, N>, T) {
    least_norm_in_groups(g, r, weights, &each::<M>())
}

/// The same where rows belong together, and are compared: `groups` says which, by equal numbers.
///
/// Rows of one group have one unit, such as the three that hold two points together: in a flat pose one of these may
/// vanish as a whole. One that is smaller than the greatest of its group by the threshold is what rounding has left of
/// it, and counts as zero; rows of other groups don't matter for that, so neither do units.
///
/// ```
/// use multibody::{linear::least_norm_in_groups, nalgebra::{Matrix3, Vector3}};
///
/// let g = Matrix3::new(2.0, 0.0, 0.0, 0.0, 1e-17, 0.0, 0.0, 0.0, 1e-17_f64);
/// let (d, rank) = least_norm_in_groups(&g, &Vector3::new(2.0, 1.0, 1e-17), &Vector3::repeat(1.0), &[0, 0, 1]);
/// assert!(rank == 2.0 && (d - Vector3::new(1.0, 0.0, 1.0)).norm() < 1e-15);
/// ```
#[inline]
pub fn least_norm_in_groups<T: Real, const M: usize, const N: usize>(
    g: &SMatrix<T, M, N>,
    r: &SVector<T, M>,
    weights: &SVector<T, N>,
    groups: &[usize; M],
) -> (SVector<T, N>, T) {
    let (zero, one) = (T::lit(0.0), T::lit(1.0));
    let columns = &g.data.0;
    let [weights] = &weights.data.0;
    let [mut r] = r.data.0;
    let dot = |a: &[T; N], b: &[T; N]| {
        let products = weights.iter().zip(a.iter().zip(b));
        products.fold(zero, |sum, (&weight, (&a, &b))| sum + weight * a * b)
    };

    let mut rows = [[zero; N]; M];
    let mut scale = [one; M];
    let mut poison = zero; // or NaN, if any entry is not finite
    for i in 0..M {
        for j in 0..N {
            rows[i][j] = columns[j][i];
        }
        let square = dot(&rows[i], &rows[i]);
        scale[i] = square;
        poison += residue(square);
    }
    let threshold = threshold::<T>(if M < N { N } else { M });
    let threshold = threshold * threshold;
    let mut scale = inverses_in_groups(&scale, groups, threshold);
    let mut rank = poison;
    for i in 0..M {
        poison += residue(r[i]);
    }

    let most = if M < N { M } else { N };
    let mut inverse = [zero; M];
    for k in 0..M {
        if k >= most {
            break;
        }
        let mut square = dot(&rows[k], &rows[k]);
        let (mut size, mut pivot) = (square * scale[k], index::<T>(k));
        for i in k + 1..M {
            let other = dot(&rows[i], &rows[i]);
            let candidate = other * scale[i];
            let larger = Real::lt(size, candidate);
            size = Real::select(larger, candidate, size);
            square = Real::select(larger, other, square);
            pivot = Real::select(larger, index(i), pivot);
        }
        for i in k + 1..M {
            let here = Real::eq(pivot, index(i));
            for j in 0..N {
                (rows[k][j], rows[i][j]) = swapped(here, rows[k][j], rows[i][j]);
            }
            (r[k], r[i]) = swapped(here, r[k], r[i]);
            (scale[k], scale[i]) = swapped(here, scale[k], scale[i]);
        }

        let dropped = Real::le(size, threshold); // false for NaN
        rank += Real::select(dropped, zero, one);
        inverse[k] = Real::select(dropped, zero, one / Real::select(dropped, one, square));
        let pivot_row = rows[k];
        for i in k + 1..M {
            let factor = dot(&rows[i], &pivot_row) * inverse[k];
            for j in 0..N {
                rows[i][j] -= factor * pivot_row[j];
            }
            r[i] -= factor * r[k];
        }
    }

    // Row by row backwards, with what the displacement already does to a row taken off: this is what keeps the error
    // small where rounding has left the rows not quite orthogonal.
    let mut d = [poison; N];
    for k in (0..most).rev() {
        if k >= M {
            continue; // never
        }
        let products = rows[k].iter().zip(&d);
        let done = products.fold(zero, |sum, (&g, &d)| sum + g * d);
        let factor = (r[k] - done) * inverse[k];
        for j in 0..N {
            d[j] += factor * weights[j] * rows[k][j];
        }
    }
    (SVector::from(d), rank)
}

/// Pivots up to this size count as zero, in a system of size `n` scaled to one.
#[inline]
fn threshold<T: Real>(n: usize) -> T {
    T::lit(16.0 * n as f64) * T::epsilon()
}

/// Every equation a group of its own.
#[inline]
const fn each<const N: usize>() -> [usize; N] {
    let mut groups = [0; N];
    let mut k = 0;
    while k < N {
        groups[k] = k;
        k += 1;
    }
    groups
}

/// Inverses of squares; zero where a square is no more than the share `least` of the greatest in its group, and so
/// rounding.
#[inline]
fn inverses_in_groups<T: Real, const N: usize>(squares: &[T; N], groups: &[usize; N], least: T) -> [T; N] {
    let zero = T::lit(0.0);
    let mut inverses = [zero; N];
    for (inverse, (&square, group)) in inverses.iter_mut().zip(squares.iter().zip(groups)) {
        let members = squares.iter().zip(groups).filter(|(_, other)| *other == group);
        let greatest = members.fold(zero, |greatest, (&square, _)| Real::max(greatest, square));
        *inverse = Real::select(Real::le(square, least * greatest), zero, reciprocal(square));
    }
    inverses
}

/// A position in a list as a scalar, to be compared in every lane.
#[inline]
fn index<T: Real>(i: usize) -> T {
    T::lit(i as f64)
}

/// `1 / x`, or one where `x` is too small for that in single precision (and then counts as zero).
#[inline]
fn reciprocal<T: Real>(x: T) -> T {
    let one = T::lit(1.0);
    one / Real::select(Real::lt(x, T::lit(f64::from(f32::MIN_POSITIVE))), one, x)
}

/// Zero, or NaN where `x` is not finite.
#[inline]
#[allow(clippy::eq_op)]
pub(crate) fn residue<T: Real>(x: T) -> T {
    x - x
}

/// `(b, a)` where `mask` is true, `(a, b)` elsewhere.
#[inline]
fn swapped<T: Real>(mask: T::Mask, a: T, b: T) -> (T, T) {
    (Real::select(mask, b, a), Real::select(mask, a, b))
}

/// Scales rows and then columns to a greatest entry of one; gives the factors of the columns.
#[inline]
fn equilibrate<T: Real, const N: usize>(a: &mut [[T; N]; N], b: &mut [T; N]) -> [T; N] {
    let zero = T::lit(0.0);
    let mut scale = [zero; N];
    for (row, b) in a.iter_mut().zip(b) {
        let factor = reciprocal(row.iter().fold(zero, |greatest, &x| Real::max(greatest, Real::abs(x))));
        *b *= factor;
        for (x, greatest) in row.iter_mut().zip(&mut scale) {
            *x *= factor;
            *greatest = Real::max(*greatest, Real::abs(*x));
        }
    }
    scale = scale.map(reciprocal);
    for row in a {
        for (x, &scale) in row.iter_mut().zip(&scale) {
            *x *= scale;
        }
    }
    scale
}

/// Undoes the exchanges of `k` with `origin[k]`, the last one first.
#[inline]
fn unpermute<T: Real, const N: usize>(x: &mut [T; N], origin: &[T; N]) {
    for k in (0..N).rev() {
        if k >= N {
            continue; // never; indices then need no check at any level of optimisation
        }
        for j in k + 1..N {
            let here = Real::eq(origin[k], index(j));
            (x[k], x[j]) = swapped(here, x[k], x[j]);
        }
    }
}
