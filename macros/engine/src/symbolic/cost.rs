//! Stage `symbolic`: what a block costs.
//!
//! In: a block. Out: its operations.
//!
//! A linear solve is counted as the runtime does it, for every input alike: scaling, the search of a pivot (a comparison
//! and two or three selections per candidate, 1 add each), exchanges by selections (two per pair), elimination (the
//! n^3 / 3 of the textbook) and substitution. An iteration is counted with the operations of its body, once, whatever the
//! number of rounds: what is compared is the work of one round.

use crate::contracts::cost::Cost;

use super::graph::BlockKind;

impl Cost {
    /// Of a block without what its operands cost.
    pub fn of_block(kind: &BlockKind) -> Cost {
        match kind {
            // Written out, it is counted operation by operation.
            BlockKind::Iterate { .. } | BlockKind::Eliminate { .. } => Cost::default(),
            &BlockKind::Solve { size, symmetric, .. } => {
                let n = size as u32;
                let steps = (0..n).map(|k| if symmetric { symmetric_step(n, n - 1 - k) } else { step(n, n - 1 - k) });
                steps.fold(scaling(n, symmetric), Cost::plus)
            }
        }
    }
}

/// Rows and columns to one scale and the unknowns back; of a symmetric matrix only pivots are scaled.
fn scaling(n: u32, symmetric: bool) -> Cost {
    if symmetric {
        return Cost { div: n, ..Cost::default() };
    }
    Cost { add: 2 * n * n, mul: 2 * n * n + 2 * n, div: 2 * n, ..Cost::default() }
}

/// One step of elimination with complete pivoting, with its share of the substitution; `m` rows are left behind it.
fn step(n: u32, m: u32) -> Cost {
    let search = 4 * (m + 1) * (m + 1);
    let exchange = m * (2 * (m + 2) + 1) + m * (2 * n + 1);
    // Rank, and the order of unknowns put back.
    let choice = 5 + 3 * m;
    let work = m * (m + 2);
    Cost { add: search + exchange + choice + work, mul: work + m + 1, div: 1, ..Cost::default() }
}

/// One step of L D L^T with diagonal pivoting.
fn symmetric_step(n: u32, m: u32) -> Cost {
    let search = 3 * m;
    let exchange = m * (2 * (n + 1) + 1);
    let choice = 5 + 3 * m;
    let work = m * (m + 1) / 2 + 2 * m;
    Cost { add: search + exchange + choice + work, mul: work + 2 * m + 2, div: 1, ..Cost::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Elimination and substitution as textbooks count them: what is left when selections and scaling are taken away.
    #[test]
    fn products_are_those_of_elimination() {
        for size in 1..20_usize {
            let n = size as u32;
            let cost = Cost::of_block(&BlockKind::Solve { size, symmetric: false, groups: [].into() });
            assert_eq!(cost.mul - 2 * n * n - 2 * n, (n * n * n - n) / 3 + n * n);
            assert_eq!(cost.div, 3 * n);
            assert!(
                Cost::of_block(&BlockKind::Solve { size, symmetric: true, groups: [].into() }).weight() < cost.weight()
            );
        }
    }
}
