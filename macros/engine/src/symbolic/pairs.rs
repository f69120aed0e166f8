//! Stage `symbolic`: solution of positive definite systems, two unknowns at a time.
//!
//! In: a matrix and a right side. Out: the solution. Elimination one by one asks for one quotient after the other, each of which
//! waits for what the one before has left; of two unknowns together the block of two is inverted by its determinant, so half as
//! many quotients stand in a row, for a few products more. What is taken from later rows is the same in exact arithmetic, and the
//! determinant of a block is as well conditioned as its two pivots are: a c - b b loses what c - b b / a loses.

use super::graph::{Graph, Scalar};

/// Two rows that go together, the last one by itself where their number is odd.
enum Block {
    Pair { rows: [usize; 2], factors: Vec<(usize, [Scalar; 2])>, solved: [Scalar; 2] },
    Last { row: usize, solved: Scalar },
}

/// Solves A x = b, eliminating rows `order[0]` and `order[1]` first. `matrix` is symmetric and positive definite.
pub fn solve_in_pairs(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize], rhs: &[Scalar]) -> Vec<Scalar> {
    let blocks = g.under("Factorisation by blocks of two.", |g| eliminate(g, matrix, order, rhs));
    let mut x = vec![Scalar::ZERO; rhs.len()];
    for block in blocks.iter().rev() {
        match block {
            Block::Pair { rows, factors, solved } => {
                let found = [0, 1].map(|k| rest(g, solved[k], factors.iter().map(|(i, l)| (l[k], x[*i]))));
                rows.iter().zip(found).for_each(|(&row, value)| x[row] = value);
            }
            Block::Last { row, solved } => x[*row] = *solved,
        }
    }
    x
}

/// What is left of a value once products are taken off.
fn rest(g: &mut Graph, value: Scalar, products: impl Iterator<Item = (Scalar, Scalar)>) -> Scalar {
    let mut terms = vec![value];
    for (a, b) in products {
        terms.push(-g.mul(a, b));
    }
    g.sum(&terms)
}

fn eliminate(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize], rhs: &[Scalar]) -> Vec<Block> {
    let (mut a, mut side) = (matrix.to_vec(), rhs.to_vec());
    let mut blocks = Vec::new();
    for (step, rows) in order.chunks(2).enumerate() {
        let later = order.get(2 * step + 2..).unwrap_or_default();
        match *rows {
            [m, n] => {
                let (square, mixed) = (g.mul(a[m][m], a[n][n]), g.mul(a[m][n], a[m][n]));
                let determinant = g.sub(square, mixed);
                g.name(determinant, || format!("determinant_{}", step + 1));
                let inverse = g.reciprocal(determinant);
                // The inverse of the block.
                let [first, cross, last] = [a[n][n], -a[m][n], a[m][m]].map(|entry| g.mul(entry, inverse));
                let by_block = |g: &mut Graph, [x, y]: [Scalar; 2]| {
                    [[first, cross], [cross, last]].map(|[p, q]| {
                        let (one, other) = (g.mul(p, x), g.mul(q, y));
                        g.add(one, other)
                    })
                };
                let mut factors = Vec::with_capacity(later.len());
                for &i in later {
                    factors.push((i, by_block(g, [a[m][i], a[n][i]])));
                }
                let solved = by_block(g, [side[m], side[n]]);
                for (at, &(i, l)) in factors.iter().enumerate() {
                    for &(j, _) in &factors[at..] {
                        a[i][j] = rest(g, a[i][j], [(l[0], a[m][j]), (l[1], a[n][j])].into_iter());
                        a[j][i] = a[i][j];
                    }
                    side[i] = rest(g, side[i], [(l[0], side[m]), (l[1], side[n])].into_iter());
                }
                blocks.push(Block::Pair { rows: [m, n], factors, solved });
            }
            [row] => {
                let inverse = g.reciprocal(a[row][row]);
                blocks.push(Block::Last { row, solved: g.mul(side[row], inverse) });
            }
            _ => {}
        }
    }
    blocks
}
