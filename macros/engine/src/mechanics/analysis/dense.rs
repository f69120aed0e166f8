//! Stage `mechanics`: small dense systems of numbers, whatever their rank.
//!
//! In: rows, a right side. Out: the least solution, or one that is zero where nothing says what it is.

use super::singular::{add, dot};

/// A pivot that is this much of the greatest entry before elimination is none.
const NO_PIVOT: f64 = 1e-11;
/// Of a row with entries about one; less is rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// Rows of unit length, or of zeros where they are nothing beside others.
pub(super) fn unit(rows: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = rows.collect();
    let lengths: Vec<f64> = rows.iter().map(|row| dot(row, row).sqrt()).collect();
    let longest = lengths.iter().fold(0.0_f64, |most, &x| most.max(x));
    for (row, &length) in rows.iter_mut().zip(&lengths) {
        let factor = if length > ROUNDING * longest { 1.0 / length } else { 0.0 };
        row.iter_mut().for_each(|x| *x *= factor);
    }
    rows
}

/// The least x that takes rows to a right side, as far as they agree.
pub(super) fn least(rows: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; rows.first().map_or(0, Vec::len)];
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for (row, &right) in rows.iter().zip(right) {
        let mut rest = row.clone();
        for unit in basis.iter().chain(&basis) {
            let along = dot(unit, &rest);
            add(&mut rest, -along, unit);
        }
        let square = dot(&rest, &rest);
        if square <= ROUNDING * ROUNDING * dot(row, row) || square == 0.0 {
            continue;
        }
        let missing = right - dot(row, &x);
        add(&mut x, missing / square, &rest);
        let length = square.sqrt();
        rest.iter_mut().for_each(|x| *x /= length);
        basis.push(rest);
    }
    x
}

/// A solution by complete pivoting, zero in what is left open.
pub(super) fn pivoted(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let (count, width) = (a.len(), a.first().map_or(0, Vec::len));
    for (row, right) in a.iter_mut().zip(&mut b) {
        let most = row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let factor = if most > 0.0 { 1.0 / most } else { 0.0 };
        row.iter_mut().for_each(|x| *x *= factor);
        *right *= factor;
    }
    let mut columns: Vec<usize> = (0..width).collect();
    let mut rank = 0;
    while rank < count.min(width) {
        // Plain loops: iterators cost several times as much in an unoptimised build.
        let (mut most, mut at, mut i) = (0.0_f64, (rank, rank), rank);
        while i < count {
            let (row, mut j) = (&a[i], rank);
            while j < width {
                let size = row[j].abs();
                if size > most {
                    (most, at) = (size, (i, j));
                }
                j += 1;
            }
            i += 1;
        }
        if most <= NO_PIVOT {
            break;
        }
        let (i, j) = at;
        a.swap(rank, i);
        b.swap(rank, i);
        a.iter_mut().for_each(|row| row.swap(rank, j));
        columns.swap(rank, j);
        let (pivot, right) = (a[rank].clone(), b[rank]);
        for below in rank + 1..count {
            let factor = a[below][rank] / pivot[rank];
            if factor != 0.0 {
                add(&mut a[below], -factor, &pivot);
                b[below] -= factor * right;
            }
        }
        rank += 1;
    }
    let mut x = vec![0.0; width];
    for i in (0..rank).rev() {
        let known: f64 = (i + 1..rank).map(|j| a[i][j] * x[columns[j]]).sum();
        x[columns[i]] = (b[i] - known) / a[i][i];
    }
    x
}
