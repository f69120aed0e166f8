//! Stage `symbolic`: sparse factorisation and solution of symmetric positive definite systems.
//!
//! In: a symmetric matrix of scalars and an order of elimination. Out: its factors L^T D L, and solutions of A x = b,
//! eliminating from the last row in the given order. With rows ordered from the leaves of a kinematic tree to its root
//! there is no fill-in (Featherstone 2005): zeros between branches stay zeros. Pivots are those of a positive definite
//! matrix and so are never zero; each costs one reciprocal.

use crate::invariant::injection::{Break, broken};

use super::graph::{Graph, Scalar};

/// Solves A x = b, eliminating row `order[0]` first. `matrix` is symmetric.
pub fn solve_symmetric(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize], rhs: &[Scalar]) -> Vec<Scalar> {
    let mut forward = rhs.to_vec();
    let factors = g.under("Factorisation L^T D L.", |g| Factors::eliminate(g, matrix, order, &mut forward));
    factors.backward(g, &forward)
}

/// A factorised matrix.
pub struct Factors {
    order: Vec<usize>,
    /// Of the pivots.
    reciprocal: Vec<Scalar>,
    /// `factors[k][i]`: how much of row k is taken from row i, which is eliminated later.
    factors: Vec<Vec<Scalar>>,
    singular: Option<usize>,
}

impl Factors {
    pub fn new(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize]) -> Factors {
        g.under("Factorisation L^T D L.", |g| Factors::eliminate(g, matrix, order, &mut []))
    }

    /// Factorises, and eliminates in a right-hand side row by row on the way, so that both share what they can.
    fn eliminate(g: &mut Graph, matrix: &[Vec<Scalar>], order: &[usize], rhs: &mut [Scalar]) -> Factors {
        let n = matrix.len();
        let mut a = matrix.to_vec();
        let mut reciprocal = vec![Scalar::ZERO; n];
        let mut factors = vec![vec![Scalar::ZERO; n]; n];
        for (step, &k) in order.iter().enumerate() {
            let pivot = a[k][k];
            if pivot == Scalar::ZERO {
                return Factors { order: order.to_vec(), reciprocal, factors, singular: Some(k) };
            }
            reciprocal[k] = g.reciprocal(pivot);
            let name = format!("{}", k + 1);
            g.name(pivot, || format!("pivot_{name}"));
            g.name(reciprocal[k], || format!("inverse_{name}"));
            if let Some(&b) = rhs.get(k) {
                g.label(b, || format!("side_{name}"));
            }
            let rest: Vec<usize> = order[step + 1..].iter().copied().filter(|&i| a[k][i] != Scalar::ZERO).collect();
            for &i in &rest {
                g.label(a[k][i], || format!("entry_{}_{}", k + 1, i + 1));
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
                // Without a right-hand side the matrix alone is factorised.
                if !rhs.is_empty() {
                    let update = g.mul(factors[k][i], rhs[k]);
                    rhs[i] = g.sub(rhs[i], update);
                }
            }
        }
        Factors { order: order.to_vec(), reciprocal, factors, singular: None }
    }

    /// What is left of a diagonal entry once the rows before it are eliminated.
    pub fn pivot(&self, g: &mut Graph, row: usize) -> Option<Scalar> {
        let inverse = self.reciprocal[row];
        (inverse != Scalar::ZERO).then(|| g.reciprocal(inverse))
    }

    /// A row whose pivot is zero by structure: the matrix is singular.
    pub fn singular(&self) -> Option<usize> {
        self.singular
    }

    /// The right-hand side with the rows eliminated.
    pub fn forward(&self, g: &mut Graph, rhs: &[Scalar]) -> Vec<Scalar> {
        let mut b = rhs.to_vec();
        for (step, &k) in self.order.iter().enumerate() {
            g.label(b[k], || format!("side_{}", k + 1));
            for &i in &self.order[step + 1..] {
                let update = g.mul(self.factors[k][i], b[k]);
                b[i] = g.sub(b[i], update);
            }
        }
        b
    }

    /// Divided by the pivots.
    pub fn scale(&self, g: &mut Graph, forward: &[Scalar]) -> Vec<Scalar> {
        forward.iter().zip(&self.reciprocal).map(|(&b, &inverse)| g.mul(b, inverse)).collect()
    }

    /// The solution from an eliminated right-hand side.
    pub fn backward(&self, g: &mut Graph, forward: &[Scalar]) -> Vec<Scalar> {
        let mut x = vec![Scalar::ZERO; forward.len()];
        for (step, &k) in self.order.iter().enumerate().rev() {
            let mut terms = vec![g.mul(forward[k], self.reciprocal[k])];
            for &i in &self.order[step + 1..] {
                let taken = g.mul(self.factors[k][i], x[i]);
                terms.push(if broken(Break::BackwardSign) { taken } else { -taken });
            }
            x[k] = g.sum(&terms);
        }
        x
    }

    pub fn solve(&self, g: &mut Graph, rhs: &[Scalar]) -> Vec<Scalar> {
        let forward = self.forward(g, rhs);
        self.backward(g, &forward)
    }
}
