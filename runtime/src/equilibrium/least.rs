//! Solutions of least norm where rows are vectors of any type: [`least`].

use crate::{Real, Tangent};

/// One equation: the derivatives by all that may change, the right side, and the square of its length at the beginning.
#[derive(Clone, Copy)]
pub(super) struct Row<T, R> {
    pub(super) entries: R,
    pub(super) right: T,
    pub(super) square: T,
}

/// The `d` with `entries . d = right` in all rows for which the sum of `d^2 / weights` is least, and the rank: the algorithm
/// of [`linear::least_norm`](crate::linear::least_norm). A row counts as dependent where less than `threshold` of its
/// length is left.
pub(super) fn least<T: Real, R: Tangent<T>>(rows: &mut [Row<T, R>], weights: &R, threshold: T) -> (R, T) {
    let (zero, one) = (T::lit(0.0), T::lit(1.0));
    let threshold = threshold * threshold;
    let dot =
        |a: &R, b: &R| a.zip(b, &mut |a, b| a * b).zip(weights, &mut |ab, w| ab * w).fold(zero, &mut |s, x| s + x);
    let mut rank = zero;
    let mut rest = &mut *rows;
    while let Some((pivot, others)) = rest.split_first_mut() {
        let share = |row: &Row<T, R>| dot(&row.entries, &row.entries) / row.square;
        let mut size = share(pivot);
        for row in others.iter_mut() {
            let other = share(row);
            let larger = Real::lt(size, other);
            let first = *pivot;
            *pivot = row.taken(larger, &first);
            *row = first.taken(larger, row);
            size = Real::select(larger, other, size);
        }
        let dropped = Real::le(size, threshold); // false for NaN
        rank += Real::select(dropped, zero, one);
        let square = dot(&pivot.entries, &pivot.entries);
        let inverse = Real::select(dropped, zero, one / Real::select(dropped, one, square));
        pivot.square = inverse; // from here on
        for row in others.iter_mut() {
            let factor = dot(&row.entries, &pivot.entries) * inverse;
            row.entries = row.entries.add_scaled(-factor, &pivot.entries);
            row.right -= factor * pivot.right;
        }
        rest = others;
    }
    let mut d = R::zero();
    for row in rows.iter().rev() {
        let done = row.entries.zip(&d, &mut |a, d| a * d).fold(zero, &mut |s, x| s + x);
        let factor = (row.right - done) * row.square;
        d = d.add(&row.entries.zip(weights, &mut |a, w| factor * a * w));
    }
    (d, rank)
}

impl<T: Real, R: Tangent<T>> Row<T, R> {
    /// This row where `mask` is true, the other elsewhere.
    fn taken(&self, mask: T::Mask, other: &Self) -> Self {
        Self {
            entries: self.entries.zip(&other.entries, &mut |a, b| Real::select(mask, a, b)),
            right: Real::select(mask, self.right, other.right),
            square: Real::select(mask, self.square, other.square),
        }
    }
}
