//! Stage `mechanics`: constraints whose forces rigid bodies don't tell.
//!
//! In: all equations as numbers, closed configurations; for models that read a multiplier. Out: constraints whose row depends on the
//! others, those included that were left out, at every pose that was looked at: the load is shared among these in any way, and a
//! multiplier would be no more than what the order of equations makes of it. With multipliers for one axle's two wheels, say, neither
//! is known, though one row alone is kept.

use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::mechanics::translate::dependencies::Dependencies;
use crate::mechanics::translate::manipulations;
use crate::model::types::Model;

use super::problem::{Point, Problem, Source};
use super::tape::Values;
use super::{rank, rates};

pub(super) fn shared(model: &Model, problem: &Problem, structure: &Structure) -> Vec<Row> {
    // Nobody else asks.
    if !Dependencies::of(manipulations::roots(model).into_iter()).multipliers {
        return Vec::new();
    }
    let mut at_all: Option<Vec<(Row, bool)>> = None;
    for point in &rates::points(problem, structure) {
        let (names, rows) = all(problem, structure, point);
        let depends = dependent(&rows);
        match &mut at_all {
            None => at_all = Some(names.into_iter().zip(depends).collect()),
            Some(found) => found.iter_mut().zip(depends).for_each(|(one, depends)| one.1 &= depends),
        }
    }
    at_all.into_iter().flatten().filter(|one| one.1).map(|one| one.0).collect()
}

/// Whether each row takes part in a combination of rows that vanishes.
fn dependent(rows: &[Vec<f64>]) -> Vec<bool> {
    let mut depends = vec![false; rows.len()];
    for combination in rank::combinations(rows) {
        depends.iter_mut().zip(&combination).for_each(|(depends, share)| *depends |= share.abs() > rank::DEPENDENT);
    }
    depends
}

/// Unit rows, or zero, of all equations of positions and velocities.
pub(super) fn all(problem: &Problem, structure: &Structure, point: &Point) -> (Vec<Row>, Vec<Vec<f64>>) {
    let of_positions: Vec<(usize, Row)> = (0..problem.equations.len())
        .filter_map(|k| match problem.equations[k].source {
            Source::Row(row) => Some((k, row)),
            _ => None,
        })
        .collect();
    let numbers: Vec<usize> = of_positions.iter().map(|one| one.0).collect();
    let mut values = Values::default();
    let positions = problem.linearise(point, &numbers, &mut values).rows;
    let rates = problem.rates_at(point, &mut values).rows;
    let names = of_positions.iter().map(|one| one.1).chain(problem.rates.iter().map(|rate| rate.row));
    let unit = |row: &Vec<(usize, f64)>| {
        let mut dense = vec![0.0; problem.columns.len()];
        for &(column, entry) in row {
            let is_driven = matches!(structure.role(problem.columns[column].coordinate), Role::Driven(_));
            dense[column] += if is_driven { 0.0 } else { entry };
        }
        let length = dense.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            dense.iter_mut().for_each(|x| *x /= length);
        }
        dense
    };
    (names.collect(), positions.iter().chain(&rates).map(unit).collect())
}
