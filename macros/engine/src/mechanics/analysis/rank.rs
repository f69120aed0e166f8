//! Stage `mechanics`: which equations follow from the others.
//!
//! In: Jacobians at several closed configurations. Out: the rows that carry the rank, the earlier ones first: a row is kept if
//! it raises the rank at some configuration, so one is dropped where it follows from those before it at all of them.

use super::singular::{add, dot};

/// A row is new if this much of it stands across all kept ones.
const NEW: f64 = 1e-6;

/// What is left of a unit row that depends on others.
pub(super) const DEPENDENT: f64 = 1e-7;

/// An orthonormal basis that grows.
#[derive(Clone, Default)]
pub(super) struct Basis {
    vectors: Vec<Vec<f64>>,
}

impl Basis {
    /// What stands across the basis, orthogonalised twice.
    pub(super) fn rest(&self, vector: &[f64]) -> Vec<f64> {
        let mut rest = vector.to_vec();
        for _ in 0..2 {
            for unit in &self.vectors {
                let along = dot(unit, &rest);
                add(&mut rest, -along, unit);
            }
        }
        rest
    }

    /// Adds a direction if more than `least` of it is new.
    pub(super) fn grow(&mut self, vector: &[f64], least: f64) -> bool {
        let mut rest = self.rest(vector);
        let norm = dot(&rest, &rest).sqrt();
        if norm.is_nan() || norm <= least {
            return false;
        }
        rest.iter_mut().for_each(|x| *x /= norm);
        self.vectors.push(rest);
        true
    }

    pub(super) fn len(&self) -> usize {
        self.vectors.len()
    }

    pub(super) fn vectors(&self) -> &[Vec<f64>] {
        &self.vectors
    }
}

/// Whether each row is kept, in the given order. Rows are unit or zero.
pub(super) fn kept(jacobians: &[&[Vec<f64>]], order: &[usize]) -> Vec<usize> {
    let mut bases = vec![Basis::default(); jacobians.len()];
    let mut kept = Vec::new();
    for &row in order {
        let mut new = false;
        for (basis, jacobian) in bases.iter_mut().zip(jacobians) {
            new |= jacobian.get(row).is_some_and(|row| basis.grow(row, NEW));
        }
        if new {
            kept.push(row);
        }
    }
    kept
}

/// Rank of some rows of one Jacobian.
pub(super) fn of(jacobian: &[Vec<f64>], rows: &[usize]) -> usize {
    let mut basis = Basis::default();
    for row in rows.iter().filter_map(|&row| jacobian.get(row)) {
        basis.grow(row, NEW);
    }
    basis.len()
}

/// Greatest rank of some columns at any configuration.
pub(super) fn rank(jacobians: &[&[Vec<f64>]], rows: &[usize], columns: &[bool]) -> usize {
    let rank_of = |jacobian: &&[Vec<f64>]| {
        let mut basis = Basis::default();
        for &row in rows {
            let Some(row) = jacobian.get(row) else { continue };
            let part: Vec<f64> = row.iter().zip(columns).map(|(&x, &on)| if on { x } else { 0.0 }).collect();
            basis.grow(&part, NEW);
        }
        basis.len()
    };
    jacobians.iter().map(rank_of).max().unwrap_or(0)
}

/// Combinations of rows that vanish, one for each row that follows from those before it: what is left of a row beside these is a combination of
/// rows, which is kept along (Gram and Schmidt, twice). Rows are unit or zero.
pub(super) fn combinations(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut found = Vec::new();
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let (mut rest, mut of_rows) = (row.clone(), vec![0.0; rows.len()]);
        of_rows[k] = 1.0;
        for (unit, combination) in basis.iter().chain(&basis) {
            let along = dot(unit, &rest);
            add(&mut rest, -along, unit);
            add(&mut of_rows, -along, combination);
        }
        let norm = dot(&rest, &rest).sqrt();
        if norm > DEPENDENT {
            rest.iter_mut().chain(&mut of_rows).for_each(|x| *x /= norm);
            basis.push((rest, of_rows));
        } else {
            found.push(of_rows);
        }
    }
    found
}
