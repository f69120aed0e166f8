//! Stage `symbolic`: solution of linear systems whose pivots may vanish, written out as expressions.
//!
//! In: a square matrix and right sides. Out: the solution and the number of pivots that don't vanish, which is the rank where
//! it is full and at most the rank below (rows alone are exchanged). Rows are exchanged by selects, so the
//! cost is the same for every input and nothing branches; it is all counted where it stands. Of the remaining rows the
//! one with the largest entry gives the pivot. Pivots below the threshold count as zero: their unknowns are zero.

use crate::contracts::call::Call;

use super::graph::{Graph, Scalar};

/// A pivot of this many rounding units of the first one is none: 1e-13 in double precision.
const UNITS: i64 = 450;

/// Solves A x = b for several right sides b by elimination with exchange of rows.
pub fn solve_pivoted(g: &mut Graph, matrix: &[Vec<Scalar>], sides: &[Vec<Scalar>]) -> (Vec<Vec<Scalar>>, Scalar) {
    let n = matrix.len();
    let width = n + sides.len();
    let mut rows: Vec<Vec<Scalar>> =
        (0..n).map(|i| matrix[i].iter().copied().chain(sides.iter().map(|side| side[i])).collect()).collect();
    let mut inverse = vec![Scalar::ZERO; n];
    let mut ranks = Vec::with_capacity(n);
    let mut scale = Scalar::ONE;
    for k in 0..n {
        exchange(g, &mut rows, k);
        let pivot = rows[k][k];
        let (inv, full) = guarded(g, pivot, scale);
        if k == 0 {
            scale = g.call(Call::Abs, &[pivot]);
        }
        inverse[k] = inv;
        ranks.push(full);
        for i in k + 1..n {
            let factor = g.mul(rows[i][k], inv);
            let top = rows[k].clone();
            for (entry, &above) in rows[i].iter_mut().zip(&top).skip(k + 1) {
                let update = g.mul(factor, above);
                *entry = g.sub(*entry, update);
            }
        }
    }
    let solutions = (n..width).map(|side| {
        let mut x = vec![Scalar::ZERO; n];
        for k in (0..n).rev() {
            let mut terms = vec![rows[k][side]];
            for j in k + 1..n {
                terms.push(-g.mul(rows[k][j], x[j]));
            }
            let sum = g.sum(&terms);
            x[k] = g.mul(sum, inverse[k]);
        }
        x
    });
    let solutions = solutions.collect();
    let rank = g.sum(&ranks);
    (solutions, rank)
}

/// Brings the row with the largest entry in column k to place k: of pairs the larger one comes first, then of pairs of these. That takes
/// as many comparisons as one row against all others, and few of them wait for each other.
fn exchange(g: &mut Graph, rows: &mut [Vec<Scalar>], k: usize) {
    let mut left: Vec<usize> = (k..rows.len()).filter(|&i| i == k || rows[i][k] != Scalar::ZERO).collect();
    while left.len() > 1 {
        for pair in left.chunks_exact(2) {
            let [a, b] = [pair[0], pair[1]].map(|i| g.call(Call::Abs, &[rows[i][k]]));
            let larger = g.call(Call::Less, &[a, b]);
            for column in k..rows[k].len() {
                let [above, below] = [pair[0], pair[1]].map(|i| rows[i][column]);
                rows[pair[0]][column] = g.call(Call::Select, &[larger, below, above]);
                rows[pair[1]][column] = g.call(Call::Select, &[larger, above, below]);
            }
        }
        left = left.into_iter().step_by(2).collect();
    }
}

/// 1 / x and one, or zero and zero where x vanishes beside a positive scale.
pub fn guarded(g: &mut Graph, x: Scalar, scale: Scalar) -> (Scalar, Scalar) {
    if g.literal(x).is_some_and(|n| !n.is_zero()) {
        return (g.reciprocal(x), Scalar::ONE);
    }
    let size = g.call(Call::Abs, &[x]);
    let (count, unit) = (g.integer(UNITS), g.call(Call::Epsilon, &[]));
    let tiny = g.mul(count, unit);
    let tiny = g.mul(tiny, scale);
    // What is no number is neither: it shows in the solution, and the rank is not full.
    let lost = g.call(Call::LessEqual, &[size, tiny]);
    let full = g.call(Call::Less, &[tiny, size]);
    let inverse = g.reciprocal(x);
    (g.call(Call::Select, &[lost, Scalar::ZERO, inverse]), g.call(Call::Select, &[full, Scalar::ONE, Scalar::ZERO]))
}
