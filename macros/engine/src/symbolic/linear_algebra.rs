//! Stage `symbolic`: sparse factorisation and solution of symmetric positive definite systems.
//!
//! In: a symmetric matrix of scalars and an order of elimination. Out: the solution of A x = b by L^T D L, eliminating
//! from the last row in the given order. With rows ordered from the leaves of a kinematic tree to its root there is no
//! fill-in (Featherstone 2005): zeros between branches stay zeros. Pivots are those of a positive definite matrix and
//! so are never zero; each costs one reciprocal.

use super::graph::{Graph, Scalar};

/// Solves A x = b, eliminating row `order[0]` first. `matrix` is symmetric.
pub fn solve_symmetric(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize], rhs: &[Scalar]) -> Vec<Scalar> {
    let n = rhs.len();
    let mut a = matrix.to_vec();
    let mut b = rhs.to_vec();
    let mut reciprocal = vec![Scalar::ZERO; n];
    let mut factors = vec![vec![Scalar::ZERO; n]; n];
    for (step, &k) in order.iter().enumerate() {
        let pivot = a[k][k];
        reciprocal[k] = g.reciprocal(pivot);
        let name = format!("{}", k + 1);
        g.name(pivot, || format!("pivot_{name}"));
        g.name(reciprocal[k], || format!("inverse_{name}"));
        let rest: Vec<usize> = order[step + 1..].iter().copied().filter(|&i| a[k][i] != Scalar::ZERO).collect();
        for &i in &rest {
            factors[k][i] = g.mul(a[k][i], reciprocal[k]);
            let l = factors[k][i];
            g.name(l, || format!("l_{}_{}", k + 1, i + 1));
        }
        for (at, &i) in rest.iter().enumerate() {
            for &j in &rest[at..] {
                let update = g.mul(factors[k][i], a[k][j]);
                a[i][j] = g.sub(a[i][j], update);
                a[j][i] = a[i][j];
            }
            let update = g.mul(factors[k][i], b[k]);
            b[i] = g.sub(b[i], update);
        }
    }
    let mut x = vec![Scalar::ZERO; n];
    for (step, &k) in order.iter().enumerate().rev() {
        let mut terms = vec![g.mul(b[k], reciprocal[k])];
        for &i in &order[step + 1..] {
            terms.push(-g.mul(factors[k][i], x[i]));
        }
        x[k] = g.sum(&terms);
    }
    x
}
