//! Stage `emit`: the structure of a model with mistakes, where it can't be analysed.
//!
//! In: the model as far as it is known. Out: a [`Structure`] with the coordinates of its tree in the state, but for those
//! that drives and `solve` items take, and with all equations of what closes its loops, so that methods and fields of
//! loops exist.

use std::collections::HashSet;

use crate::mechanics::analysis::driven_by;
use crate::mechanics::loops::constraints::{closings, rate_rows, row_count};
use crate::mechanics::loops::structure::{Means, Row, Step, Structure};
use crate::model::types::{Coordinate, Handling, Model};

/// As many equations are made up.
const MOST: usize = 512;

pub(in crate::emit) fn structure(model: &Model) -> Structure {
    let mut structure = Structure::open(model);
    let reduced = match model.handling {
        Handling::Reduced => true,
        // Where closed forms are written they are cheap as a rule.
        Handling::Auto => !model.solves.is_empty(),
        Handling::Multipliers | Handling::Stabilised { .. } => false,
    };
    let rows = closings(model)
        .into_iter()
        .flat_map(|closing| (0..row_count(model, closing)).map(move |index| Row { closing, index }));
    let rows: Vec<Row> = rows.take(MOST).collect();
    let rates = rate_rows(model).into_iter().take(MOST);
    let mut away: HashSet<Coordinate> = model.drives.iter().flat_map(|drive| driven_by(model, drive.target)).collect();
    let mut steps = Vec::new();
    if reduced {
        for (number, solve) in model.solves.iter().enumerate() {
            away.extend(&solve.unknowns);
            steps.push(Step { unknowns: solve.unknowns.clone(), means: Means::Solve(number) });
        }
        // Of a body whose orientation is a quaternion nothing follows.
        let may_follow = |coordinate: &Coordinate| {
            !away.contains(coordinate) && !model.joints[coordinate.joint].kind.has_quaternion()
        };
        let left: Vec<Coordinate> = structure.state.iter().copied().filter(may_follow).collect();
        if model.independent.is_empty() {
            // Which coordinates Newton's method finds is not known: any of them may be one.
            if model.solves.is_empty() && !rows.is_empty() {
                steps.push(newton(left));
            }
        } else {
            let dependent = left.into_iter().filter(|coordinate| !model.independent.contains(coordinate));
            let dependent: Vec<Coordinate> = dependent.collect();
            away.extend(&dependent);
            steps.extend((!dependent.is_empty()).then(|| newton(dependent)));
        }
    } else {
        structure.rows = rows;
    }
    structure.rows.extend(rates);
    structure.steps = steps;
    structure.state.retain(|coordinate| !away.contains(coordinate));
    structure
}

fn newton(unknowns: Vec<Coordinate>) -> Step {
    Step { unknowns, means: Means::Newton { rows: Vec::new(), guess: 0 } }
}
