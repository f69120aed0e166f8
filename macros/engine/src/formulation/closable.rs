//! Stage `formulation`: which loops the user could have closed by closed forms, where Newton's method closes them.
//!
//! In: a model whose loops go by Newton's method, with its structure. Out: `solve .. from .. { .. }` items, on the branch of the default
//! pose. A closed form stays on its branch where Newton's method follows its guess to another one, so these are proposals: the text is
//! the user's to paste. Identical parts get one line.

use std::collections::BTreeMap;

use crate::mechanics::analysis::{Closable, Pose, closable};
use crate::mechanics::loops::advice::Solvable;
use crate::mechanics::loops::constraints::{closing_name, coordinate_name, local_name, parameter_name, place_of};
use crate::mechanics::loops::solutions::Solutions;
use crate::mechanics::loops::structure::Structure;
use crate::mechanics::{self};
use crate::model::formulated::{ClosedForm, Origin};
use crate::model::types::{Coordinate, InstanceId, Model, ParamId, PartTypeId};

use super::sides::sides;

/// As many closed forms are looked for, since each takes a search.
const MOST_TRIED: usize = 40;

/// `solve` items with what is told of them.
pub(super) struct Line {
    pub forms: Vec<ClosedForm>,
    pub told: Solvable,
}

pub(super) fn lines(model: &Model, structure: &Structure) -> Vec<Line> {
    let Some((loops, poses)) = closable(model, structure) else { return Vec::new() };
    let forms = forms(model, structure, &loops, &poses);
    let mut of_parts: BTreeMap<(PartTypeId, String), Vec<(InstanceId, ClosedForm)>> = BTreeMap::new();
    let mut lines: Vec<Line> = Vec::new();
    for form in forms {
        match local(model, &form) {
            Some((part, instance, text)) => of_parts.entry((part, text)).or_default().push((instance, form)),
            None => lines.push(alone(model, form)),
        }
    }
    for ((part, text), list) in of_parts {
        // What stands in a part holds for all of them.
        let all = (0..model.instances.len()).map(InstanceId).filter(|&id| model.instances[id].part_type == Some(part));
        if all.into_iter().all(|id| list.iter().any(|one| one.0 == id)) {
            let part = Some(model.part_types[part].name.to_string());
            lines.push(Line { forms: list.into_iter().map(|one| one.1).collect(), told: Solvable { part, text } });
        } else {
            lines.extend(list.into_iter().map(|(_, form)| alone(model, form)));
        }
    }
    lines
}

/// One for each loop that has one.
fn forms(model: &Model, structure: &Structure, loops: &[Closable], poses: &[Pose]) -> Vec<ClosedForm> {
    let bare = |one: &Closable, unknowns: &[Coordinate]| ClosedForm {
        unknowns: unknowns.to_vec(),
        closing: one.closing,
        sides: Vec::new(),
    };
    let tried = loops.iter().flat_map(|one| one.unknowns.iter().map(move |unknowns| (one, unknowns)));
    let tried: Vec<(&Closable, &Vec<Coordinate>)> = tried.take(MOST_TRIED).collect();
    let all: Vec<ClosedForm> = tried.iter().map(|(one, unknowns)| bare(one, unknowns)).collect();
    let with = model.closing(&all);
    let Ok(found) = mechanics::solutions(&with, structure, model.solves.len(), poses) else { return Vec::new() };
    let mut forms: Vec<ClosedForm> = Vec::new();
    for (((one, unknowns), form), solutions) in tried.into_iter().zip(all).zip(found) {
        let is_taken = forms.iter().any(|known| {
            known.closing == form.closing || known.unknowns.iter().any(|unknown| unknowns.contains(unknown))
        });
        let Some(solutions) = solutions.filter(|_: &Solutions| !is_taken) else { continue };
        if let Some(sides) = sides(model, one, unknowns, poses, &solutions) {
            forms.push(ClosedForm { sides, ..form });
        }
    }
    forms
}

fn alone(model: &Model, form: ClosedForm) -> Line {
    let name = |coordinate: Coordinate| coordinate_name(model, coordinate);
    let parameter = |of: ParamId| parameter_name(model, of);
    let text = text(model, &form, &closing_name(model, form.closing), name, parameter);
    Line { forms: vec![form], told: Solvable { part: None, text } }
}

/// As it stands in the part that all names are of.
fn local(model: &Model, form: &ClosedForm) -> Option<(PartTypeId, InstanceId, String)> {
    let place = place_of(model, form.closing);
    let part = model.instances[place.instance].part_type?;
    let sides = form.sides.iter();
    let coordinates = sides.clone().flat_map(|side| side.terms.iter().map(|term| term.0)).chain(form.unknowns.clone());
    let joints = coordinates.map(|coordinate| model.joints[coordinate.joint].place.instance);
    let parameters = sides.filter_map(|side| match side.from {
        Origin::Parameter { of, .. } => Some(model.params[of].place.instance),
        Origin::Number(_) => None,
    });
    if joints.chain(parameters).any(|instance| instance != place.instance) {
        return None;
    }
    let name = |coordinate: Coordinate| local_name(model, coordinate);
    let parameter = |of: ParamId| model.params[of].place.field.to_string();
    Some((part, place.instance, text(model, form, &place.field.to_string(), name, parameter)))
}

/// `solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }`
fn text(
    model: &Model,
    form: &ClosedForm,
    closing: &str,
    name: impl Fn(Coordinate) -> String,
    parameter: impl Fn(ParamId) -> String,
) -> String {
    let mut unknowns: Vec<String> = Vec::new();
    for &unknown in &form.unknowns {
        let freedoms = model.joints[unknown.joint].kind.freedoms();
        let is_own = |other: &&Coordinate| other.joint == unknown.joint;
        let own: Vec<&Coordinate> = form.unknowns.iter().filter(is_own).collect();
        // A joint stands for all that it has.
        if own.len() < freedoms {
            unknowns.push(name(unknown));
        } else if *own[0] == unknown {
            let whole = name(unknown);
            let joint = if freedoms > 1 { whole.rsplit_once('.').map_or(&*whole, |parts| parts.0) } else { &*whole };
            unknowns.push(joint.to_owned());
        }
    }
    let sides: Vec<String> = form.sides.iter().map(|side| side.text(&name, &parameter)).collect();
    let conditions = if sides.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", sides.join(", ")) };
    format!("solve ({}) from {closing} {conditions}", unknowns.join(", "))
}
