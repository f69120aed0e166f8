//! Stage `mechanics`: which equations of velocities keep multipliers.
//!
//! In: the equations as numbers, closed configurations. Out: all of them behind those of positions, but for what depends on
//! equations before it, of positions or of velocities, in all these configurations, whatever the parameters: rows of analytic
//! functions that depend on each other at random poses do so everywhere. What they ask of motions that are forced from
//! outside (a plane that turns, a course in time) must then agree too; where that can't be looked at in numbers they stay, and the
//! pivoted solve finds the rank.

use crate::mechanics::loops::constraints::row_name;
use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::model::site::Sited;
use crate::model::types::{LoopClosure, Model};

use super::Complaint;
use super::problem::{Point, Problem, Random, Source};
use super::tape::Values;

/// Poses that are looked at where no loop says which there are.
const POSES: usize = 9;
/// What is left of a row that depends on others, as a share of it.
const DEPENDENT: f64 = 1e-9;
/// Parameters are off their defaults by about this much.
const OFF: f64 = 0.1;

/// A row of the whole mechanism: slopes, and what is left at rest.
type Gradient = (Vec<f64>, f64);

/// What a row is beside those before it, at one pose.
#[derive(Clone, Copy, PartialEq)]
enum Beside {
    Independent,
    Follows,
    Contradicts,
    /// It depends on others, and what these ask for is not known in numbers.
    Unknown,
}

pub(super) fn keep(model: &Model, problem: &Problem, structure: &mut Structure) -> Vec<Complaint> {
    let (mut kept, mut complaints) = (Vec::new(), Vec::new());
    let mut names = Vec::new();
    let points = points(problem, structure);
    let moved = Problem::with(model, OFF);
    let before = structure.clone();
    let judge = Judge { problem, structure: &before, points: &points };
    for (number, rate) in problem.rates.iter().enumerate() {
        let name = || row_name(model, rate.row.closing, rate.row.index);
        let declared = judge.at_all(problem, number, &kept);
        let all = |list: &[Beside]| !list.is_empty() && list.iter().all(|&one| one == Beside::Follows);
        if all(&declared) && all(&judge.at_all(&moved, number, &kept)) {
            names.push(format!("`{}`", name()));
            structure.dropped.push(rate.row);
            continue;
        }
        let stuck = |&one: &Beside| matches!(one, Beside::Follows | Beside::Contradicts);
        if declared.contains(&Beside::Contradicts) && declared.iter().all(stuck) {
            let LoopClosure::Constraint(id) = rate.row.closing else { continue };
            let message = format!("the constraint `{}` contradicts others: their velocities leave none for it", name());
            complaints.push(Complaint { at: model.constraints[id].site(), message, help: None });
            continue;
        }
        structure.redundant |= declared.iter().any(|&one| one != Beside::Independent);
        structure.scales.insert(rate.row, judge.scale(number));
        kept.push(number);
    }
    if !names.is_empty() {
        let names = names.join(", ");
        structure.notes.push(format!(
            "redundant equations of velocities, left out: {names}; they follow from others at {} poses",
            points.len()
        ));
    }
    structure.rows.extend(kept.into_iter().map(|number| problem.rates[number].row));
    complaints
}

fn points(problem: &Problem, structure: &Structure) -> Vec<Point> {
    if !problem.equations.is_empty() {
        return structure.closed.iter().map(|closed| problem.at(&closed.positions)).collect();
    }
    let mut random = Random(0x8011E5);
    (0..POSES).map(|_| problem.start(&mut random, 1.0)).collect()
}

struct Judge<'a> {
    problem: &'a Problem,
    structure: &'a Structure,
    points: &'a [Point],
}

impl Judge<'_> {
    /// What an equation is beside those of positions and those that are kept, pose by pose.
    fn at_all(&self, problem: &Problem, number: usize, kept: &[usize]) -> Vec<Beside> {
        self.points.iter().map(|point| self.beside(problem, point, number, kept)).collect()
    }

    /// The greatest length of its row.
    fn scale(&self, number: usize) -> f64 {
        let mut values = Values::default();
        let length = |point: &Point| {
            self.problem.rates_at(point, &mut values).rows[number].iter().map(|x| x.1 * x.1).sum::<f64>().sqrt()
        };
        self.points.iter().map(length).fold(0.0, f64::max)
    }

    fn beside(&self, problem: &Problem, point: &Point, number: usize, kept: &[usize]) -> Beside {
        // Parameters are part of a point: those of the other set are put in.
        let point = problem.at(&problem.positions(point));
        let mut values = Values::default();
        let dense = |row: &[(usize, f64)]| {
            let mut dense = vec![0.0; problem.columns.len()];
            for &(column, entry) in row {
                let driven = matches!(self.structure.role(problem.columns[column].coordinate), Role::Driven(_));
                dense[column] += if driven { 0.0 } else { entry };
            }
            dense
        };
        let own = |row: Row| self.structure.independent.contains(&row);
        let of_positions: Vec<usize> = (0..problem.equations.len())
            .filter(|&k| matches!(problem.equations[k].source, Source::Row(row) if own(row)))
            .collect();
        let positions = problem.linearise(&point, &of_positions, &mut values);
        let rates = problem.rates_at(&point, &mut values);
        let mut basis: Vec<Gradient> = Vec::new();
        let before = positions.rows.iter().map(|row| (dense(row), 0.0));
        let before = before.chain(kept.iter().map(|&k| (dense(&rates.rows[k]), rates.residuals[k])));
        for gradient in before {
            let size = length(&gradient.0);
            let mut left = without(gradient, &basis);
            let rest = length(&left.0);
            if rest > DEPENDENT * size {
                left.0.iter_mut().for_each(|x| *x /= rest);
                left.1 /= rest;
                basis.push(left);
            }
        }
        let gradient = (dense(&rates.rows[number]), rates.residuals[number]);
        let size = length(&gradient.0);
        let left = without(gradient, &basis);
        if length(&left.0) > DEPENDENT * size {
            return Beside::Independent;
        }
        // Drives, and loops that follow time, move on their own: what they ask for is not looked at here.
        let unknown = problem.is_timed()
            || problem.columns.iter().any(|column| matches!(self.structure.role(column.coordinate), Role::Driven(_)));
        match left.1.abs() <= DEPENDENT * (size + rates.residuals[number].abs()) {
            _ if unknown => Beside::Unknown,
            true => Beside::Follows,
            false => Beside::Contradicts,
        }
    }
}

fn length(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Less what lies along unit rows; twice, for the digits that the first time has lost.
fn without(gradient: Gradient, basis: &[Gradient]) -> Gradient {
    let (mut row, mut rest) = gradient;
    for (unit, of_unit) in basis.iter().chain(basis) {
        let along: f64 = row.iter().zip(unit).map(|(a, b)| a * b).sum();
        row.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
        rest -= along * of_unit;
    }
    (row, rest)
}
