//! Stage `mechanics`: kinematics that no closed form gives.
//!
//! In: a model with its structure, and coordinates of which others are to be found. Out: the structure in which the given
//! coordinates are independent and all others of their loops follow by Newton's method: the pose of a platform from the lengths of
//! its legs. Such an iteration has no guess of its own. It begins where the coordinates stand that it finds, so these have to be in
//! the state, as what is given has to be.

use std::rc::Rc;

use crate::mechanics::loops::constraints::coordinate_name;
use crate::mechanics::loops::structure::{Means, Role, Structure};
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::site::Sited;
use crate::model::types::{Coordinate, Handling, Kinematics, LoopClosure, Model};

use super::problem::{Problem, Source};
use super::{Complaint, analyse};

/// One for each `kinematics`; nothing where coordinates that follow anyway are asked for.
pub(super) fn closures(model: &Model, structure: &Structure) -> Result<Vec<Option<Rc<Structure>>>, Vec<Complaint>> {
    if model.kinematics.is_empty() {
        return Ok(Vec::new());
    }
    let solved = structure.solved(model);
    let follows = |coordinate: &Coordinate| solved.role(*coordinate) != Role::State;
    let one = |wanted: &Kinematics| match wanted.find.iter().all(follows) {
        true if leads(model, &solved, wanted) => Ok(None),
        // Whoever is refused here is told of the formulas that there are.
        true => Ok(closure(model, structure, wanted).ok().map(Rc::new)),
        false => closure(model, structure, wanted).map(|found| Some(Rc::new(found))),
    };
    model.kinematics.iter().map(one).collect()
}

/// For `assembly_modes`.
pub(super) fn assembly(model: &Model, structure: &Structure) -> Result<Option<Rc<Structure>>, Vec<Complaint>> {
    let Some(wanted) = &model.assembly else { return Ok(None) };
    if wanted.find.iter().any(|coordinate| has_quaternion(&model.joints[coordinate.joint])) {
        let message = "orientations of assembly modes are angles".to_owned();
        let help = "write `RollPitchYaw`, as in `coordinates: Absolute(RollPitchYaw)`".to_owned();
        return Err(vec![Complaint { at: wanted.site(), message, help: Some(help) }]);
    }
    closure(model, structure, wanted).map(|closure| Some(Rc::new(closure)))
}

/// Whether formulas lead from what is given to what is to be found, as far as equations read coordinates.
fn leads(model: &Model, solved: &Structure, wanted: &Kinematics) -> bool {
    let problem = Problem::written(model, solved.writing);
    let (mut open, mut seen) = (wanted.find.clone(), Vec::new());
    while let Some(coordinate) = open.pop() {
        if seen.contains(&coordinate) || wanted.given.contains(&coordinate.joint) {
            continue;
        }
        seen.push(coordinate);
        let step = match solved.role(coordinate) {
            Role::State => return false,
            Role::Driven(_) => continue,
            Role::Dependent(step) => &solved.steps[step],
        };
        let reads = |source: Source| match (&step.means, source) {
            (Means::Solve(item), Source::Formula(of, _)) => *item == of,
            (Means::Solve(item), Source::Row(row)) => {
                model.solves[*item].closings().any(|closing| row.closing == closing)
            }
            (Means::Linear(id) | Means::Explicit(id), Source::Row(row)) => row.closing == LoopClosure::Constraint(*id),
            (Means::Newton { rows, .. }, Source::Row(row)) => rows.contains(&row),
            (Means::Linear(_) | Means::Explicit(_) | Means::Newton { .. }, Source::Formula(..)) => false,
        };
        let equations = problem.equations.iter().filter(|equation| reads(equation.source));
        let columns = equations.flat_map(|equation| &equation.columns);
        let others = columns.map(|&column| problem.columns[column].coordinate);
        open.extend(others.filter(|other| !step.unknowns.contains(other)));
    }
    true
}

fn closure(model: &Model, structure: &Structure, wanted: &Kinematics) -> Result<Structure, Vec<Complaint>> {
    let complain =
        |message: String, help: &str| vec![Complaint { at: wanted.site(), message, help: Some(help.to_owned()) }];
    let given = wanted.given.iter().flat_map(|&joint| {
        let freedoms = model.joints[joint].kind.freedoms();
        (0..freedoms).map(move |index| Coordinate { joint, index })
    });
    let given: Vec<Coordinate> = given.collect();
    let outside = |list: &[Coordinate]| list.iter().copied().find(|&c| matches!(structure.role(c), Role::Dependent(_)));
    if let Some(coordinate) = outside(&given) {
        let name = coordinate_name(model, coordinate);
        let help = match structure.rows.is_empty() {
            true => {
                "write `constraints: Multipliers`: what is given is read from the state, and what is to be found begins there"
            }
            false => "give the coordinates that it follows from",
        };
        return Err(complain(format!("`{name}` is given, and follows from other coordinates of the state"), help));
    }
    let independent: Vec<Coordinate> = given.iter().copied().filter(|&c| structure.role(c) == Role::State).collect();
    let held = structure.independent.iter().filter(|row| structure.rows.contains(row)).count();
    let freedoms = structure.freedoms().saturating_sub(held);
    if independent.len() > freedoms {
        let are = if freedoms == 1 { "is" } else { "are" };
        let message = format!("{} coordinates are given, but {freedoms} {are} independent", independent.len());
        return Err(complain(message, "give fewer: the others follow from them"));
    }
    let other = Model {
        handling: Handling::Reduced,
        independent,
        solves: Vec::new(),
        kinematics: Vec::new(),
        assembly: None,
        ..model.clone()
    };
    let found = analyse(&other).map_err(|complaints| {
        let (why, help) = complaints.into_iter().next().map(|one| (one.message, one.help)).unwrap_or_default();
        // What is said of `independent` is meant of what is given, and multipliers find no positions.
        let is_meant = |help: &String| !help.contains("`independent`") && !help.contains("`constraints: Multipliers`");
        let help = help.filter(is_meant);
        let help = help.as_deref().unwrap_or("give other coordinates");
        complain(format!("what is given does not lead to what is to be found: {why}"), help)
    })?;
    if let Some(coordinate) = outside(&found.guessed()) {
        let name = coordinate_name(model, coordinate);
        let help = "an iteration begins where coordinates of the state stand: write `constraints: Multipliers`";
        return Err(complain(format!("`{name}` has to be found, and is not in the state"), help));
    }
    Ok(found)
}
