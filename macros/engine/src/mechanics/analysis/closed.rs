//! Stage `mechanics`: the closed configurations that the analysis hands on.
//!
//! In: the groups of equations with the points that were found closed, and the roles. Out: [`Closed`] configurations of the
//! whole tree. The first stands as near to the start (coordinates at zero, orientations that turn nothing, drives at time
//! zero) as was found: with all of the state there if the loops close so, and else with what the least steps from there
//! reach. One that is regular is preferred, so that Newton's method starts well from it. The others are spread at random.

use crate::mechanics::loops::structure::Closed;

use super::configurations::{Configuration, Search};
use super::problem::{Point, Problem, Random};
use super::tape::Values;
use super::{CoupledRows, Role, Structure};

/// How far starts are from where coordinates stand by default.
const AMPLITUDES: [f64; 9] = [0.0, 0.05, 0.15, 0.3, 0.3, 0.6, 0.6, 1.0, 1.0];

/// A group of equations with what was found about it.
pub(super) struct Sampled {
    pub group: CoupledRows,
    pub configurations: Vec<Configuration>,
    /// Of the equations, where they are regular.
    pub rank: usize,
}

/// Configurations of the whole tree; none if some group was not closed at all.
pub(super) fn closed(problem: &Problem, samples: &[Sampled], structure: &Structure) -> Vec<Closed> {
    let mut values = Values::default();
    let mut list = Vec::new();
    let mut first = problem.origin();
    for sampled in samples {
        let Some(point) = near(problem, sampled, structure, &mut values) else { return list };
        problem.take(&mut first, &point, &sampled.group.columns);
    }
    list.push(closed_at(problem, &first, samples, &mut values));
    let points = |sampled: &Sampled| sampled.configurations.iter().filter(|c| c.closed).count();
    let (least, most) = (samples.iter().map(points).min().unwrap_or(0), samples.iter().map(points).max().unwrap_or(0));
    let mut random = Random(0xC105ED);
    for k in 0..if least == 0 { 0 } else { most } {
        let mut point = problem.start(&mut random, 1.0);
        problem.put_time(&mut point, 0.0);
        let mut reached = true;
        for sampled in samples {
            let mut own = sampled.configurations.iter().filter(|c| c.closed);
            if let Some(found) = own.nth(k % points(sampled)) {
                problem.take(&mut point, &found.point, &sampled.group.columns);
            }
            reached &= at_start(problem, sampled, &mut point, &mut values);
        }
        if reached {
            list.push(closed_at(problem, &point, samples, &mut values));
        }
    }
    list
}

/// The closed point of a group that is nearest to the start.
fn near(problem: &Problem, sampled: &Sampled, structure: &Structure, values: &mut Values) -> Option<Point> {
    let role = |column: usize| structure.role(problem.columns[column].coordinate);
    let dependent = |column: usize| matches!(role(column), Role::Dependent(_));
    let driven = |column: usize| matches!(role(column), Role::Driven(_));
    let columns = 0..problem.columns.len();
    let mut ways: Vec<Vec<bool>> = vec![columns.clone().map(driven).collect()];
    if sampled.group.columns.iter().any(|&column| dependent(column)) {
        ways.insert(0, columns.clone().map(|column| !dependent(column)).collect());
    }
    let CoupledRows { equations, columns } = &sampled.group;
    for held in ways {
        let search = Search::new(problem, equations, columns).holding(&held);
        let mut singular = None;
        let mut random = Random(0xBE61);
        for amplitude in AMPLITUDES {
            let mut point = problem.shaken(&problem.origin(), &mut random, amplitude, &held);
            if !search.close(&mut point, values) {
                continue;
            }
            if search.rank_at(&point, values) == Some(sampled.rank) {
                return Some(point);
            }
            singular.get_or_insert(point);
        }
        if singular.is_some() {
            return singular;
        }
    }
    sampled.configurations.iter().filter(|configuration| configuration.closed).find_map(|found| {
        let mut point = found.point.clone();
        problem.put_time(&mut point, 0.0);
        at_start(problem, sampled, &mut point, values).then_some(point)
    })
}

/// Whether a point that was found closed at a time of its own can be moved to where it is at time zero.
fn at_start(problem: &Problem, sampled: &Sampled, point: &mut Point, values: &mut Values) -> bool {
    let CoupledRows { equations, columns } = &sampled.group;
    let timed = equations.iter().any(|&k| problem.equations[k].timed);
    !timed || Search::new(problem, equations, columns).close(point, values)
}

fn closed_at(problem: &Problem, point: &Point, samples: &[Sampled], values: &mut Values) -> Closed {
    let mut residual = 0.0_f64;
    for sampled in samples {
        let residuals = problem.residuals(point, &sampled.group.equations, values);
        residual = residuals.iter().fold(residual, |greatest, x| greatest.max(x.abs()));
    }
    Closed { positions: problem.positions(point), residual }
}
