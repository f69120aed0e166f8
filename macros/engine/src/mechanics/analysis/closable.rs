//! Stage `mechanics`: loops that Newton's method closes and that a closed form could close, one closing at a time, or all of a system.
//!
//! In: a model with its structure. Out: of each closing whose equations Newton's method solves, and of few that it solves together, the
//! coordinates that these may give alone, and poses near the default one, at which solutions are told apart. Whether there is a closed form is not known here.

use crate::mechanics::loops::structure::{Means, Role, Row, Structure};
use crate::model::types::{Coordinate, LoopClosure, Model};

use super::problem::{Point, Problem, Source};
use super::relations::poses;

/// A coordinate that is further from where it stands by default is elsewhere.
const STANDS: f64 = 1e-9;

/// Closings that are solved together in closed form, if there is one.
const MOST_TOGETHER: usize = 4;

/// Closings with what may follow from them.
#[derive(Clone, Debug)]
pub struct Closable {
    pub closings: Vec<LoopClosure>,
    /// Lists of as many as their equations, of those that Newton's method finds.
    pub unknowns: Vec<Vec<Coordinate>>,
    /// Coordinates of their loops, unknowns among them: angles that are the same after a turn, and what is not, travels and threads.
    pub angles: Vec<Coordinate>,
    pub lengths: Vec<Coordinate>,
    /// Whether parameters have a say in their equations.
    pub is_adjustable: bool,
}

/// A configuration with parameters.
#[derive(Clone, Debug)]
pub struct Pose {
    /// By joint the components of its position; nothing for joints that close loops.
    pub positions: Vec<Vec<f64>>,
    /// Parameters by number and element, where they are moved.
    pub parameters: Vec<((usize, usize), f64)>,
}

/// Closings, and closed poses at time zero of which the first is the default one; nothing where no pose has the state where it stands by default.
pub fn closable(model: &Model, structure: &Structure) -> Option<(Vec<Closable>, Vec<Pose>)> {
    let problem = Problem::written(model, structure.writing);
    let first = structure.closed.first().map(|closed| problem.at(&closed.positions))?;
    let origin = problem.origin();
    let stands = |column: usize| match (problem.value_of(&first, column), problem.value_of(&origin, column)) {
        (Some(at), Some(from)) => (at - from).abs() <= STANDS,
        _ => true,
    };
    let follows = |column: usize| matches!(structure.role(problem.columns[column].coordinate), Role::Dependent(_));
    if !(0..problem.columns.len()).all(|column| follows(column) || stands(column)) {
        return None;
    }
    let points = std::iter::once(first).chain(poses(&problem, structure));
    let poses: Vec<Pose> = points.map(|point| pose(&problem, &point)).collect();
    let mut closings: Vec<LoopClosure> = Vec::new();
    for row in newton(structure).flat_map(|(rows, _)| rows) {
        if !closings.contains(&row.closing) {
            closings.push(row.closing);
        }
    }
    let alone = closings.into_iter().map(|closing| vec![closing]);
    let sets = alone.chain(together(structure));
    let found = sets.filter_map(|closings| of_closings(model, structure, &problem, &closings));
    Some((found.collect(), poses))
}

/// Equations that Newton's method solves, with what it finds.
fn newton(structure: &Structure) -> impl Iterator<Item = (&[Row], &[Coordinate])> {
    structure.steps.iter().filter_map(|step| match &step.means {
        Means::Newton { rows, .. } => Some((rows.as_slice(), step.unknowns.as_slice())),
        Means::Linear(_) | Means::Explicit(_) | Means::Solve(_) => None,
    })
}

/// Closings of each system that Newton's method solves: each unknown of such a system stands in equations of others.
fn together(structure: &Structure) -> Vec<Vec<LoopClosure>> {
    let mut sets: Vec<Vec<LoopClosure>> = Vec::new();
    for (rows, _) in newton(structure) {
        let mut own: Vec<LoopClosure> = rows.iter().map(|row| row.closing).collect();
        own.sort_unstable();
        own.dedup();
        if (2..=MOST_TOGETHER).contains(&own.len()) && !sets.contains(&own) {
            sets.push(own);
        }
    }
    sets
}

fn of_closings(model: &Model, structure: &Structure, problem: &Problem, own: &[LoopClosure]) -> Option<Closable> {
    let of = |closing: LoopClosure| {
        let own = move |source: Source| matches!(source, Source::Row(row) if row.closing == closing);
        let equations = problem.equations.iter().filter(move |equation| own(equation.source));
        equations.flat_map(|equation| equation.columns.iter().copied())
    };
    let is_own = |row: &Row| own.contains(&row.closing);
    let mut columns: Vec<usize> = own.iter().copied().flat_map(of).collect();
    columns.sort_unstable();
    columns.dedup();
    let coordinate = |column: &usize| problem.columns[*column].coordinate;
    let steps: Vec<(&[Row], &[Coordinate])> = newton(structure).filter(|(rows, _)| rows.iter().any(is_own)).collect();
    let count = steps.iter().flat_map(|step| step.0).filter(|row| is_own(row)).count();
    let mut found: Vec<Coordinate> = steps.iter().flat_map(|step| step.1.iter().copied()).collect();
    found.sort_unstable_by_key(|c| (c.joint, c.index));
    let mut unknowns: Vec<Vec<Coordinate>> = Vec::new();
    let mut offer = |list: Vec<Coordinate>| {
        if list.len() == count && !unknowns.contains(&list) {
            unknowns.push(list);
        }
    };
    // All that is found with them belongs to them.
    offer(found.clone());
    // What no other loop has a part in: of several loops that are closed together each may give its own coordinates.
    let others = super::closings(model).into_iter().filter(|other| !own.contains(other));
    let shared: Vec<usize> = others.flat_map(of).collect();
    let alone: Vec<Coordinate> = columns.iter().filter(|column| !shared.contains(column)).map(coordinate).collect();
    offer(alone.into_iter().filter(|one| found.contains(one)).collect());
    // A quaternion has no formulas.
    let turns = |one: &Coordinate| problem.columns.iter().any(|column| column.turns && column.coordinate == *one);
    unknowns.retain(|list| !list.iter().any(turns));
    if unknowns.is_empty() {
        return None;
    }
    let (lengths, angles): (Vec<usize>, Vec<usize>) =
        columns.iter().copied().filter(|&column| !problem.columns[column].turns).partition(|&column| {
            let joint = problem.columns[column].coordinate.joint;
            problem.columns[column].travels || model.joints[joint].kind.has_pitch
        });
    let is_adjustable =
        problem.equations.iter().any(|one| one.adjustable && matches!(one.source, Source::Row(row) if is_own(&row)));
    let named = |list: Vec<usize>| list.iter().map(coordinate).collect();
    Some(Closable { closings: own.to_vec(), unknowns, angles: named(angles), lengths: named(lengths), is_adjustable })
}

fn pose(problem: &Problem, point: &Point) -> Pose {
    let equations: Vec<usize> = (0..problem.equations.len()).collect();
    let parameters = problem.parameters_of(&equations).into_iter();
    let moved = parameters.filter(|&(symbol, _)| point.0[symbol] != problem.defaults[symbol]);
    let parameters = moved.map(|(symbol, parameter)| (parameter, point.0[symbol])).collect();
    Pose { positions: problem.positions(point), parameters }
}
