//! Stage `mechanics`: coordinates that stand still while loops move, or go along with others.
//!
//! In: a model with its structure. Out: what dependent coordinates have in common at closed configurations near where the
//! mechanism stands by default: the orientation of a plate on parallelograms stays as it is, the two rods of one have the same
//! angles. That is seen in numbers at a few poses, and so only proposed: as a formula of the user's it is checked exactly, like any.

use crate::mechanics::loops::structure::{Role, Structure};
use crate::model::types::{Coordinate, Model};

use super::configurations::Search;
use super::problem::{Point, Problem, Random};
use super::tape::Values;

/// Poses, how far the state is moved for them, and how many have to close. In every other one parameters are moved too; where
/// loops don't close with others than those that are declared, that pose says nothing.
const POSES: usize = 24;
const PARAMETERS: f64 = 0.05;
const AMPLITUDES: [f64; 4] = [0.02, 0.05, 0.1, 0.2];
const LEAST_POSES: usize = 6;

/// What differs by less is the same, loops being closed to eleven digits.
const SAME: f64 = 1e-8;

/// What a dependent coordinate is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    Constant(f64),
    /// The same as another one, which needs no relation itself.
    Same(Coordinate),
    /// The same but for the sign.
    Opposite(Coordinate),
}

/// Of coordinates that Newton's method finds. Another one is looked for among those that `may` stand in its formula.
pub fn relations(
    model: &Model,
    structure: &Structure,
    may: impl Fn(Coordinate, Coordinate) -> bool,
) -> Vec<(Coordinate, Relation)> {
    let problem = Problem::written(model, structure.writing);
    let poses = poses(&problem, structure);
    if poses.len() < LEAST_POSES {
        return Vec::new();
    }
    let values = |coordinate: Coordinate| -> Option<Vec<f64>> {
        let column = problem.columns.iter().position(|column| column.coordinate == coordinate)?;
        poses.iter().map(|pose| problem.value_of(pose, column)).collect()
    };
    let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * (1.0 + a.abs());
    let mut found: Vec<(Coordinate, Relation)> = Vec::new();
    // What others can be the same as: the state, and what came before without a relation.
    let mut free: Vec<(Coordinate, Vec<f64>)> =
        structure.state.iter().filter_map(|&coordinate| Some((coordinate, values(coordinate)?))).collect();
    for unknown in structure.guessed() {
        let Some(own) = values(unknown) else { continue };
        let like = |sign: f64| {
            let same = |other: &&(Coordinate, Vec<f64>)| {
                may(unknown, other.0) && own.iter().zip(&other.1).all(|(&a, &b)| is_same(a, sign * b))
            };
            free.iter().find(same).map(|other| other.0)
        };
        let relation = match own.iter().all(|&value| is_same(value, own[0])) {
            true => Some(Relation::Constant(own[0])),
            false => like(1.0).map(Relation::Same).or_else(|| like(-1.0).map(Relation::Opposite)),
        };
        match relation {
            Some(relation) => found.push((unknown, relation)),
            None => free.push((unknown, own)),
        }
    }
    found
}

/// Closed configurations near the default one, with the state moved.
pub(super) fn poses(problem: &Problem, structure: &Structure) -> Vec<Point> {
    let Some(first) = structure.closed.first().map(|closed| problem.at(&closed.positions)) else { return Vec::new() };
    let role = |column: usize| structure.role(problem.columns[column].coordinate);
    let columns: Vec<usize> = (0..problem.columns.len()).collect();
    let (dependent, held): (Vec<bool>, Vec<bool>) =
        columns.iter().map(|&column| matches!(role(column), Role::Dependent(_))).map(|is| (is, !is)).unzip();
    // What is driven stands still too.
    let still: Vec<bool> = columns.iter().map(|&column| dependent[column] || role(column) != Role::State).collect();
    let equations: Vec<usize> = (0..problem.equations.len()).collect();
    let search = Search::new(problem, &equations, &columns).holding(&held);
    let parameters = problem.parameters_of(&equations);
    let (mut random, mut values) = (Random(0x0E1A), Values::default());
    let moved = (0..POSES).filter_map(|k| {
        let mut pose = problem.shaken(&first, &mut random, AMPLITUDES[k / 2 % AMPLITUDES.len()], &still);
        for &(symbol, _) in parameters.iter().filter(|_| k % 2 == 1) {
            let size = if pose.0[symbol] == 0.0 { 1.0 } else { pose.0[symbol] };
            pose.0[symbol] += PARAMETERS * size * random.next();
        }
        search.close(&mut pose, &mut values).then_some(pose)
    });
    moved.collect()
}
