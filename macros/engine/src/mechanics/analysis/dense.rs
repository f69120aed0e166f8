//! Stage `mechanics`: rows of numbers, whatever their rank.
//!
//! In: rows, a right side. Out: the rows at one length, the least solution.

use super::rank::Basis;
use super::singular::{add, dot};

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
    let mut basis = Basis::default();
    for (row, &right) in rows.iter().zip(right) {
        let rest = basis.rest(row);
        let square = dot(&rest, &rest);
        if square <= ROUNDING * ROUNDING * dot(row, row) || square == 0.0 {
            continue;
        }
        let missing = right - dot(row, &x);
        add(&mut x, missing / square, &rest);
        basis.grow(&rest, 0.0);
    }
    x
}
