//! Stage `verify`: pivoted linear systems, as the runtime solves them, in both kinds of numbers.
//!
//! In: a matrix by rows and a right side. Out: a [`LinearSolution`]. Pivots are chosen as in `multibody::linear`, and count as zero
//! by the roundings of double precision, whatever the numbers: the rank is that of the emitted code. The order of pivots
//! is part of the result, since what a system of lesser rank leaves open depends on it.

use super::arithmetic::Arithmetic;

/// A solution with what its sensitivity needs.
#[derive(Clone, Debug)]
pub(super) struct LinearSolution<T> {
    pub x: Vec<T>,
    /// Equations and unknowns in the order of their pivots; as many as the rank.
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    /// What rows and columns were multiplied by.
    pub row_scales: Vec<f64>,
    pub column_scales: Vec<f64>,
    /// Whether a pivot lies near the threshold.
    pub unclear: bool,
}

/// A pivot within this factor of the threshold, either way, may count or not.
const UNCLEAR: f64 = 1e3;

fn threshold(n: usize) -> f64 {
    16.0 * n as f64 * f64::EPSILON
}

fn inverse(greatest: f64) -> f64 {
    if greatest < f64::from(f32::MIN_POSITIVE) { 1.0 } else { 1.0 / greatest }
}

/// Complete pivoting after rows and columns have been brought to one scale. With `order`, pivots are those.
pub(super) fn solve<T: Arithmetic>(matrix: &[T], rhs: &[T], order: Option<(&[usize], &[usize])>) -> LinearSolution<T> {
    let n = rhs.len();
    let mut row_scales = Vec::with_capacity(n);
    let mut greatest = vec![0.0_f64; n];
    for row in matrix.chunks(n.max(1)) {
        let scale = inverse(row.iter().fold(0.0, |most: f64, x| most.max(x.high().abs())));
        for (most, x) in greatest.iter_mut().zip(row) {
            *most = most.max(x.high().abs() * scale);
        }
        row_scales.push(scale);
    }
    let column_scales: Vec<f64> = greatest.into_iter().map(inverse).collect();
    let mut a: Vec<Vec<T>> = Vec::with_capacity(n);
    for (row, &scale) in matrix.chunks(n.max(1)).zip(&row_scales) {
        a.push(row.iter().zip(&column_scales).map(|(x, c)| x.mul(T::of(scale)).mul(T::of(*c))).collect());
    }
    let mut b: Vec<T> = rhs.iter().zip(&row_scales).map(|(x, &scale)| x.mul(T::of(scale))).collect();
    let mut rows: Vec<usize> = (0..n).collect();
    let mut columns: Vec<usize> = (0..n).collect();
    let least = threshold(n);
    let (mut rank, mut unclear) = (0, false);
    while rank < n {
        let (mut size, mut at) = (-1.0, (rank, rank));
        match order {
            None => {
                for (i, row) in a.iter().enumerate().skip(rank) {
                    for (j, x) in row.iter().enumerate().skip(rank) {
                        let x = x.high().abs();
                        if x > size || x.is_nan() {
                            (size, at) = (x, (i, j));
                        }
                    }
                }
            }
            Some((wanted_rows, wanted_columns)) => {
                let place = |list: &[usize], wanted: &[usize]| {
                    wanted.get(rank).and_then(|&wanted| list.iter().position(|&x| x == wanted))
                };
                let Some(place) = place(&rows, wanted_rows).zip(place(&columns, wanted_columns)) else { break };
                (size, at) = (a[place.0][place.1].high().abs(), place);
            }
        }
        unclear |= size < least * UNCLEAR && size * UNCLEAR > least;
        if order.is_none() && size <= least {
            break;
        }
        a.swap(rank, at.0);
        b.swap(rank, at.0);
        rows.swap(rank, at.0);
        a.iter_mut().for_each(|row| row.swap(rank, at.1));
        columns.swap(rank, at.1);
        let pivot = a[rank][rank].reciprocal();
        let (above, below) = a.split_at_mut(rank + 1);
        let Some(pivot_row) = above.last() else { break };
        let right = b[rank];
        for (row, b) in below.iter_mut().zip(b.iter_mut().skip(rank + 1)) {
            if row[rank].high() == 0.0 {
                continue;
            }
            let factor = row[rank].mul(pivot);
            for (x, &y) in row.iter_mut().zip(pivot_row).skip(rank + 1) {
                *x = x.sub(factor.mul(y));
            }
            *b = b.sub(factor.mul(right));
        }
        rank += 1;
    }
    let mut x = vec![T::ZERO; n];
    for k in (0..rank).rev() {
        let mut rest = b[k];
        for j in k + 1..rank {
            rest = rest.sub(a[k][j].mul(x[columns[j]]));
        }
        x[columns[k]] = rest.mul(a[k][k].reciprocal());
    }
    for (x, &scale) in x.iter_mut().zip(&column_scales) {
        *x = x.mul(T::of(scale));
    }
    rows.truncate(rank);
    columns.truncate(rank);
    LinearSolution { x, rows, columns, row_scales, column_scales, unclear }
}

/// Its equation, the factors below it, its inverse.
type Pivot<T> = (usize, Vec<(usize, T)>, T);

/// Diagonal pivoting of a symmetric matrix without negative eigenvalues, pivots measured by what is given, or by the
/// diagonal entries that they came from.
pub(super) fn solve_symmetric<T: Arithmetic>(
    matrix: &[T],
    rhs: &[T],
    (measures, groups): (&[T], &[usize]),
    order: Option<&[usize]>,
) -> LinearSolution<T> {
    let n = rhs.len();
    let mut a: Vec<Vec<T>> =
        matrix.chunks(n.max(1)).enumerate().map(|(i, row)| row[..=i.min(n - 1)].to_vec()).collect();
    let mut b = rhs.to_vec();
    let least = threshold(n);
    let diagonal: Vec<f64> = match measures {
        [] => a.iter().enumerate().map(|(k, row)| row[k].high()).collect(),
        measures => measures.iter().map(|measure| measure.high()).collect(),
    };
    let group = |k: usize| groups.get(k).copied().unwrap_or(k);
    let scales: Vec<f64> = (0..n)
        .map(|k| {
            let members = (0..n).filter(|&j| j == k || (!groups.is_empty() && group(j) == group(k)));
            let most = members.fold(0.0_f64, |most, j| most.max(diagonal[j]));
            if diagonal[k] <= least * least * most { 0.0 } else { inverse(diagonal[k]) }
        })
        .collect();
    // Nothing is moved: what is left is a list of numbers.
    let mut left: Vec<usize> = (0..n).collect();
    let mut pivots: Vec<Pivot<T>> = Vec::new();
    let mut unclear = false;
    while !left.is_empty() {
        let mut best = 0;
        let mut size = -1.0;
        for (place, &k) in left.iter().enumerate() {
            let candidate = a[k][k].high() * scales[k];
            let chosen = match order {
                Some(order) => order.get(pivots.len()) == Some(&k),
                None => candidate > size || candidate.is_nan(),
            };
            if chosen {
                (best, size) = (place, candidate);
            }
        }
        unclear |= size < least * UNCLEAR && size * UNCLEAR > least;
        if size <= least {
            break;
        }
        let k = left.remove(best);
        let inverse = a[k][k].reciprocal();
        let below: Vec<(usize, T)> = left.iter().map(|&i| (i, if i > k { a[i][k] } else { a[k][i] })).collect();
        let below: Vec<(usize, T)> = below.into_iter().filter(|entry| entry.1.high() != 0.0).collect();
        let mut factors = Vec::with_capacity(below.len());
        for (place, &(i, entry)) in below.iter().enumerate() {
            let factor = entry.mul(inverse);
            for &(j, other) in &below[..=place] {
                let slot = &mut a[i.max(j)][i.min(j)];
                *slot = slot.sub(factor.mul(other));
            }
            b[i] = b[i].sub(factor.mul(b[k]));
            factors.push((i, factor));
        }
        pivots.push((k, factors, inverse));
    }
    let mut x = vec![T::ZERO; n];
    for (k, factors, inverse) in pivots.iter().rev() {
        let mut value = b[*k].mul(*inverse);
        for (i, factor) in factors {
            value = value.sub(factor.mul(x[*i]));
        }
        x[*k] = value;
    }
    let rows: Vec<usize> = pivots.iter().map(|pivot| pivot.0).collect();
    let scale = |&d: &f64| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 };
    let scales: Vec<f64> = diagonal.iter().map(scale).collect();
    LinearSolution { x, columns: rows.clone(), rows, row_scales: scales.clone(), column_scales: scales, unclear }
}

/// The adjoint of the right side: A^T y = x' on the rows and columns of the pivots.
pub(super) fn transposed<T: Arithmetic>(n: usize, matrix: &[T], rows: &[usize], columns: &[usize], x: &[T]) -> Vec<T> {
    let reduced: Vec<T> = columns.iter().flat_map(|&j| rows.iter().map(move |&i| matrix[i * n + j])).collect();
    let rhs: Vec<T> = columns.iter().map(|&j| x[j]).collect();
    let identity: Vec<usize> = (0..rows.len()).collect();
    // In the order of the pivots that have proven good.
    let solved = solve(&reduced, &rhs, Some((&identity, &identity)));
    let mut y = vec![T::ZERO; n];
    for (&i, value) in rows.iter().zip(solved.x) {
        y[i] = value;
    }
    y
}
