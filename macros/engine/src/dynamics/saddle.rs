//! Stage `dynamics`: linear systems of the equations of motion.
//!
//! In: the mass matrix M, the Jacobian G of the equations that keep multipliers. Out: solutions of M x + G^T l = f,
//! G x = c, by the Schur complement G M^-1 G^T on the sparse factors of M. The complement is solved with pivots; its rank
//! comes with the result.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{BlockKind, Graph, Scalar};
use crate::symbolic::linear_algebra::Factors;

/// A system that is factorised once for several right-hand sides.
pub(crate) struct Saddle {
    jacobian: Vec<Vec<Scalar>>,
    /// Rows of one unit, see [`BlockKind::Solve`].
    groups: Box<[usize]>,
    /// Of M, with the equations of `added` in it.
    factors: Factors,
    added: Vec<usize>,
    /// Rows of G, eliminated in, and the same divided by the pivots.
    pushed: Vec<Vec<Scalar>>,
    scaled: Vec<Vec<Scalar>>,
    /// G M^-1 G^T, row by row.
    complement: Vec<Scalar>,
    /// Columns of its inverse.
    inverse: Option<Vec<Vec<Scalar>>>,
}

/// What solves one system.
pub(crate) struct Solution {
    pub unknowns: Vec<Scalar>,
    pub multipliers: Vec<Scalar>,
    pub rank: Option<Scalar>,
}

impl Saddle {
    /// Eliminates rows of M in this order. Rows of G with equal numbers in `groups` have one unit.
    pub(crate) fn new(
        g: &mut Graph,
        matrix: Vec<Vec<Scalar>>,
        (jacobian, groups): (Vec<Vec<Scalar>>, Box<[usize]>),
        order: &[usize],
    ) -> Saddle {
        let (factors, added) = augmented(g, matrix, &jacobian, order);
        let pushed: Vec<Vec<Scalar>> = jacobian.iter().map(|row| factors.forward(g, row)).collect();
        let scaled: Vec<Vec<Scalar>> = pushed.iter().map(|row| factors.scale(g, row)).collect();
        let size = jacobian.len();
        let mut complement = vec![Scalar::ZERO; size * size];
        for i in 0..size {
            for j in i..size {
                let entry = dot(g, &pushed[i], &scaled[j]);
                complement[i * size + j] = entry;
                complement[j * size + i] = entry;
            }
        }
        Saddle { jacobian, groups, factors, added, pushed, scaled, complement, inverse: None }
    }

    /// Inverts the complement: for more right-hand sides than it has rows.
    pub(crate) fn invert(&mut self, g: &mut Graph) {
        let size = self.jacobian.len();
        if size == 0 {
            return;
        }
        let unit = |at: usize| (0..size).map(move |k| if k == at { Scalar::ONE } else { Scalar::ZERO });
        let columns = (0..size).map(|at| {
            let operands: Vec<Scalar> = self.complement.iter().copied().chain(unit(at)).collect();
            let kind = BlockKind::Solve { size, symmetric: true, groups: self.groups.clone() };
            let mut column = g.block_outputs(kind, &operands);
            column.truncate(size);
            column
        });
        self.inverse = Some(columns.collect());
    }

    /// For f and c.
    pub(crate) fn solve(&self, g: &mut Graph, rhs: &[Scalar], held: &[Scalar]) -> Solution {
        if self.jacobian.is_empty() {
            return Solution { unknowns: self.factors.solve(g, rhs), multipliers: Vec::new(), rank: None };
        }
        let mut rhs = rhs.to_vec();
        for &row in &self.added {
            for (entry, &slope) in rhs.iter_mut().zip(&self.jacobian[row]) {
                let moved = g.mul(slope, held[row]);
                *entry = g.add(*entry, moved);
            }
        }
        let forward = self.factors.forward(g, &rhs);
        let mut driven = Vec::with_capacity(held.len());
        for (row, &held) in self.scaled.iter().zip(held) {
            let free = dot(g, row, &forward);
            let held = if broken(Break::HeldSign) { -held } else { held };
            driven.push(g.sub(free, held));
        }
        let (multipliers, rank) = self.multipliers(g, driven);
        let rest: Vec<Scalar> = (0..rhs.len())
            .map(|k| {
                let mut terms = vec![forward[k]];
                terms.extend(self.pushed.iter().zip(&multipliers).map(|(row, &l)| -g.mul(row[k], l)));
                g.sum(&terms)
            })
            .collect();
        Solution { unknowns: self.factors.backward(g, &rest), multipliers, rank }
    }

    fn multipliers(&self, g: &mut Graph, driven: Vec<Scalar>) -> (Vec<Scalar>, Option<Scalar>) {
        let size = self.jacobian.len();
        if let Some(inverse) = &self.inverse {
            let row = |k: usize| inverse.iter().map(|column| column[k]).collect::<Vec<_>>();
            return ((0..size).map(|k| dot(g, &row(k), &driven)).collect(), None);
        }
        let operands: Vec<Scalar> = self.complement.iter().copied().chain(driven).collect();
        let kind = BlockKind::Solve { size, symmetric: true, groups: self.groups.clone() };
        let mut multipliers = g.block_outputs(kind, &operands);
        let rank = multipliers.pop();
        (multipliers, rank)
    }
}

fn dot(g: &mut Graph, a: &[Scalar], b: &[Scalar]) -> Scalar {
    let terms: Vec<Scalar> = a.iter().zip(b).map(|(&x, &y)| g.mul(x, y)).collect();
    g.sum(&terms)
}

/// Factors of the mass matrix. Where it is singular by structure, as that of a free rod that has no inertia about its own
/// line, equations that hold the idle coordinate are added to it: with G x = c the systems M x + G^T l = f and
/// (M + g g^T) x + G^T l = f + g c have the same solution, multipliers included.
fn augmented(
    g: &mut Graph,
    mut matrix: Vec<Vec<Scalar>>,
    jacobian: &[Vec<Scalar>],
    order: &[usize],
) -> (Factors, Vec<usize>) {
    let mut added: Vec<usize> = Vec::new();
    loop {
        let factors = Factors::new(g, &matrix, order);
        let Some(idle) = factors.singular() else { return (factors, added) };
        // The shortest of the equations fills in least.
        let length = |row: usize| jacobian[row].iter().filter(|&&entry| entry != Scalar::ZERO).count();
        let holding = (0..jacobian.len()).filter(|row| !added.contains(row) && jacobian[*row][idle] != Scalar::ZERO);
        let Some(row) = holding.min_by_key(|&row| length(row)) else { return (factors, added) };
        added.push(row);
        let line = &jacobian[row];
        for i in 0..line.len() {
            for j in 0..line.len() {
                let both = g.mul(line[i], line[j]);
                matrix[i][j] = g.add(matrix[i][j], both);
            }
        }
    }
}
