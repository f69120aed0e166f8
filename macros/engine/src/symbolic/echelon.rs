//! Stage `symbolic`: reduced row echelon forms of literals.
//!
//! In: rows of literals. Out: the same rows reduced, exactly, by the choice of pivots that costs the fewest products.
//! The number of choices that are tried is bounded.

use super::fingerprint::Print;
use super::number::Number;

/// Rows in reduced form beside what right sides they take, and their pivots' columns.
pub(super) type Echelon = (Vec<Vec<Number>>, Vec<usize>);

/// Most choices of pivots that are tried.
const MOST_CHOICES: usize = 1_000;

/// The choice of pivots that leaves the fewest products, among those that are not much worse conditioned than the best.
pub(super) fn best_pivots(rows: &[Vec<Number>], n: usize) -> Option<Echelon> {
    let k = rows.len();
    let mut best: Option<((usize, usize), Echelon)> = None;
    let mut columns: Vec<usize> = (0..k).collect();
    for _ in 0..MOST_CHOICES {
        if let Some((size, echelon)) = echelon(rows, &columns) {
            // Entries beyond sixteen mean pivots too small.
            let score = (usize::from(size > 16.0), products(&echelon, n));
            if best.as_ref().is_none_or(|(least, _)| score < *least) {
                best = Some((score, echelon));
            }
        }
        if !advance(&mut columns, n) {
            break;
        }
    }
    best.map(|(_, echelon)| echelon)
}

/// The next choice of columns in lexicographic order.
fn advance(columns: &mut [usize], n: usize) -> bool {
    let k = columns.len();
    let Some(at) = (0..k).rev().find(|&at| columns[at] < n - k + at) else { return false };
    columns[at] += 1;
    for j in at + 1..k {
        columns[j] = columns[j - 1] + 1;
    }
    true
}

/// Gauss-Jordan elimination with these pivots' columns; the largest entry that comes out.
fn echelon(constant: &[Vec<Number>], columns: &[usize]) -> Option<(f64, Echelon)> {
    let k = constant.len();
    let mut rows: Vec<Vec<Number>> = Vec::new();
    for (at, row) in constant.iter().enumerate() {
        let own = (0..k).map(|j| if j == at { Number::ONE } else { Number::ZERO });
        rows.push(row.iter().copied().chain(own).collect());
    }
    for (at, &column) in columns.iter().enumerate() {
        let size = |i: &usize| rows[*i][column].abs().value();
        let largest = (at..k).max_by(|a, b| size(a).total_cmp(&size(b)).then(b.cmp(a)))?;
        if rows[largest][column].is_zero() || !rows[largest][column].is_sharp() {
            return None;
        }
        rows.swap(at, largest);
        let pivot = rows[at][column];
        rows[at].iter_mut().for_each(|c| *c = *c / pivot);
        for i in (0..k).filter(|&i| i != at) {
            let factor = rows[i][column];
            if !factor.is_zero() {
                let taken = rows[at].clone();
                rows[i].iter_mut().zip(taken).for_each(|(c, t)| *c = *c - factor * t);
            }
        }
    }
    let size = rows.iter().flatten().map(|c| c.abs().value()).fold(0.0, f64::max);
    Some((size, (rows, columns.to_vec())))
}

/// Products that a reduced form costs, roughly: entries that are neither zero nor one; what stands twice, once.
fn products((rows, pivots): &Echelon, n: usize) -> usize {
    let mut cost = 0;
    for j in (0..n).filter(|j| !pivots.contains(j)) {
        let mut seen: Vec<Print> = Vec::new();
        for row in rows {
            let c = row[j].abs();
            if !c.is_zero() {
                cost += 1;
                if !c.is_one() && !seen.contains(&c.residue) {
                    seen.push(c.residue);
                    cost += 1;
                }
            }
        }
    }
    cost
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever columns are the first that can be solved for.
    #[test]
    fn columns_that_are_regular() {
        let rows = |list: &[[i64; 4]]| -> Vec<Vec<Number>> {
            list.iter().map(|row| row.map(Number::integer).to_vec()).collect()
        };
        for (list, expected) in [
            ([[1, 1, 0, 0], [1, 1, 1, 0]], [0, 2]),
            ([[0, 0, 1, 0], [0, 0, 0, 1]], [2, 3]),
            ([[1, 2, 3, 0], [1, 2, 3, 1]], [0, 3]),
        ] {
            let (reduced, pivots) = best_pivots(&rows(&list), 4).expect("regular columns");
            assert!(pivots.contains(&expected[1]), "{pivots:?}");
            for (i, row) in reduced.iter().enumerate() {
                for (at, &column) in pivots.iter().enumerate() {
                    assert!(row[column] == if at == i { Number::ONE } else { Number::ZERO });
                }
            }
        }
        assert!(best_pivots(&rows(&[[1, 2, 3, 4], [2, 4, 6, 8]]), 4).is_none());
    }
}
