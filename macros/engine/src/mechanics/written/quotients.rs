//! Room `written`: systems of rates, for people to read.
//!
//! In: a square system. Out: its unknowns, by quotients of determinants in each of the smallest systems that can be solved one after the
//! other, if these are small; else what elimination with pivots gives, which has no formula.

use crate::mechanics::equations::Equations;
use crate::mechanics::translate::manipulations::MOST_WRITTEN;
use crate::symbolic::graph::Scalar;
use crate::symbolic::triangular_form::{components, matching};

impl Equations<'_> {
    pub(in crate::mechanics) fn solve_for_readers(
        &mut self,
        size: usize,
        matrix: &[Scalar],
        side: &[Scalar],
    ) -> Vec<Scalar> {
        match small_systems(size, matrix) {
            Some(systems) => self.solve_in_turn(&systems, matrix, side),
            None => self.eliminate_strictly(size, matrix, side),
        }
    }

    fn solve_in_turn(&mut self, systems: &[Vec<[usize; 2]>], matrix: &[Scalar], side: &[Scalar]) -> Vec<Scalar> {
        let size = side.len();
        let mut unknowns: Vec<Option<Scalar>> = vec![None; size];
        for system in systems {
            let sides: Vec<Scalar> = system
                .iter()
                .map(|&[row, _]| {
                    let known = (0..size).filter_map(|column| Some((matrix[row * size + column], -unknowns[column]?)));
                    let mut terms: Vec<Scalar> = known.map(|(entry, x)| self.g.mul(entry, x)).collect();
                    terms.push(side[row]);
                    self.g.sum(&terms)
                })
                .collect();
            let entries =
                system.iter().flat_map(|&[row, _]| system.iter().map(move |&[_, column]| row * size + column));
            let block: Vec<Scalar> = entries.map(|at| matrix[at]).collect();
            for (k, &[_, column]) in system.iter().enumerate() {
                unknowns[column] = Some(self.quotient(system.len(), &block, &sides, k));
            }
        }
        unknowns.into_iter().map(|x| x.unwrap_or(Scalar::ZERO)).collect()
    }
}

/// Rows with the columns that they are solved for, in systems that need earlier ones only; nothing where one is large, or where some
/// row has no column.
fn small_systems(size: usize, matrix: &[Scalar]) -> Option<Vec<Vec<[usize; 2]>>> {
    let reads = |row: usize| (0..size).filter(move |column| matrix[row * size + column] != Scalar::ZERO);
    let pattern: Vec<Vec<(usize, f64)>> =
        (0..size).map(|row| reads(row).map(|column| (column, 1.0)).collect()).collect();
    let pivots: Vec<usize> = matching(&pattern, size).into_iter().collect::<Option<_>>()?;
    let needs: Vec<Vec<usize>> = (0..size)
        .map(|row| (0..size).filter(|&other| reads(row).any(|column| column == pivots[other])).collect())
        .collect();
    let systems = components(&needs);
    if systems.iter().any(|system| system.len() > MOST_WRITTEN) {
        return None;
    }
    Some(systems.into_iter().map(|rows| rows.into_iter().map(|row| [row, pivots[row]]).collect()).collect())
}
