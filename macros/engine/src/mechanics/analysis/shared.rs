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
use super::rates;
use super::singular::{add, dot};
use super::tape::Values;

/// What is left of a unit row that depends on others.
const DEPENDENT: f64 = 1e-7;

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

/// Whether each row takes part in a combination of rows that vanishes: what is left of a row beside those before it is a combination of
/// rows, which is kept along (Gram and Schmidt, twice).
fn dependent(rows: &[Vec<f64>]) -> Vec<bool> {
    let mut depends = vec![false; rows.len()];
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
        } else if dot(row, row) > 0.0 {
            depends.iter_mut().zip(&of_rows).for_each(|(depends, share)| *depends |= share.abs() > DEPENDENT);
        }
    }
    depends
}

/// Unit rows, or zero.
fn all(problem: &Problem, structure: &Structure, point: &Point) -> (Vec<Row>, Vec<Vec<f64>>) {
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
