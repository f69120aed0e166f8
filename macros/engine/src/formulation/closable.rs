//! Stage `formulation`: which loops the user could have closed by closed forms, where Newton's method closes them.
//!
//! In: a model whose loops go by Newton's method, with its structure. Out: `solve .. from .. { .. }` items, on the branch of the default
//! pose. A closed form stays on its branch where Newton's method follows its guess to another one, so these are proposals: the text is
//! the user's to paste. Identical parts get one line.

use std::collections::BTreeMap;

use crate::invariant::fault::guard;
use crate::mechanics;
use crate::mechanics::analysis::{Closable, Pose, analyse, closable};
use crate::mechanics::loops::advice::Solvable;
use crate::mechanics::loops::constraints::{closing_name, coordinate_name, local_name, place_of};
use crate::mechanics::loops::solutions::Solutions;
use crate::mechanics::loops::structure::Structure;
use crate::model::formulated::{Beside, Beyond, ClosedForm, Origin, Placed, Side};
use crate::model::types::{
    BodyRef, ConstraintKind, Coordinate, Directions, Frame, InstanceId, JointId, LoopClosure, Model, PartTypeId,
};

use super::sides::sides;
use super::wording::Wording;

/// As many closed forms are looked for, since each takes a search.
const MOST_TRIED: usize = 40;

/// `solve` items with what is told of them.
pub(super) struct Line {
    pub forms: Vec<ClosedForm>,
    pub told: Solvable,
}

/// With the poses at which they have to agree with Newton's method.
pub(super) fn lines(model: &Model, structure: &Structure) -> (Vec<Line>, Vec<Pose>) {
    let Some((loops, poses)) = closable(model, structure) else { return Default::default() };
    let forms = forms(model, structure, &loops, &poses);
    let mut of_parts: BTreeMap<(PartTypeId, String), Vec<(InstanceId, ClosedForm)>> = BTreeMap::new();
    let mut lines: Vec<Line> = Vec::new();
    for form in forms {
        match local(model, &form) {
            Some((part, instance, text)) => of_parts.entry((part, text)).or_default().push((instance, form)),
            None => lines.extend(alone(model, form)),
        }
    }
    for ((part, text), list) in of_parts {
        // What stands in a part holds for all of them.
        let all = (0..model.instances.len()).map(InstanceId).filter(|&id| model.instances[id].part_type == Some(part));
        if all.into_iter().all(|id| list.iter().any(|one| one.0 == id)) {
            let part = Some(model.part_types[part].name.to_string());
            lines.push(Line { forms: list.into_iter().map(|one| one.1).collect(), told: Solvable { part, text } });
        } else {
            lines.extend(list.into_iter().filter_map(|(_, form)| alone(model, form)));
        }
    }
    (lines, poses)
}

/// Whether loops that are closed so stand as Newton's method has them at some poses.
pub(super) fn agrees(model: &Model, poses: &[Pose]) -> bool {
    let agrees = |structure: &Structure| mechanics::agrees(model, structure, poses).ok();
    analyse(model).ok().and_then(|structure| agrees(&structure)).unwrap_or(false)
}

/// One for each loop that has one.
fn forms(model: &Model, structure: &Structure, loops: &[Closable], poses: &[Pose]) -> Vec<ClosedForm> {
    let bare = |one: &Closable, unknowns: &[Coordinate]| ClosedForm {
        unknowns: unknowns.to_vec(),
        closings: one.closings.clone(),
        sides: Vec::new(),
        place: placed(model, &one.closings, unknowns),
    };
    let tried = loops.iter().flat_map(|one| one.unknowns.iter().map(move |unknowns| (one, unknowns)));
    let tried: Vec<(&Closable, &Vec<Coordinate>)> = tried.take(MOST_TRIED).collect();
    let all: Vec<ClosedForm> = tried.iter().map(|(one, unknowns)| bare(one, unknowns)).collect();
    let with = model.closing(&all);
    // What nobody has written stands in nobody's way.
    let found = guard("mechanics", || mechanics::solutions(&with, structure, model.solves.len(), poses));
    let Ok(Ok(found)) = found else { return Vec::new() };
    let mut forms: Vec<ClosedForm> = Vec::new();
    for (((one, unknowns), form), solutions) in tried.into_iter().zip(all).zip(found) {
        let is_taken = forms.iter().any(|known| {
            known.closings.iter().any(|closing| form.closings.contains(closing))
                || known.unknowns.iter().any(|unknown| unknowns.contains(unknown))
        });
        let Some(solutions) = solutions.filter(|_: &Solutions| !is_taken) else { continue };
        if let Some(choice) = sides(model, one, unknowns, poses, &solutions) {
            let place = form.place.zip(choice.offered).map(|(place, is_above)| place.turned(is_above));
            forms.push(ClosedForm { sides: choice.sides, place, ..form });
        }
    }
    forms
}

/// What could choose between solutions where no coordinate does.
fn placed(model: &Model, closings: &[LoopClosure], unknowns: &[Coordinate]) -> Option<Placed> {
    match *closings {
        [closing] => beyond(model, closing, unknowns).map(Placed::Beyond),
        [a, b, c] => {
            let link = |closing: LoopClosure| link(model, closing, unknowns);
            Some(Placed::Beside(Beside { rods: [link(a)?, link(b)?, link(c)?], is_above: true }))
        }
        _ => None,
    }
}

/// The joint that carries a body, if its coordinates are found.
fn carrier(model: &Model, body: BodyRef, unknowns: &[Coordinate]) -> Option<JointId> {
    unknowns.iter().map(|unknown| unknown.joint).find(|&joint| model.joints[joint].child.body == body)
}

/// What a closing holds together.
fn ends(model: &Model, closing: LoopClosure) -> Option<[&Frame; 2]> {
    match closing {
        LoopClosure::Constraint(id) => match &model.constraints[id].kind {
            ConstraintKind::Rod { between, .. } => Some([&between[0], &between[1]]),
            ConstraintKind::Value(_) | ConstraintKind::Rate(_) => None,
        },
        LoopClosure::Cut(id) => Some([&model.joints[id].parent, &model.joints[id].child]),
    }
}

/// The ends of something of one length between two points: a rod, or a body that turns about either.
fn link(model: &Model, closing: LoopClosure, unknowns: &[Coordinate]) -> Option<[Frame; 2]> {
    let ends = ends(model, closing)?;
    if matches!(closing, LoopClosure::Constraint(_)) {
        // What is moved carries the last one.
        let is_moved = |frame: &Frame| {
            let mut at = frame.body;
            std::iter::from_fn(|| {
                let joint = model.tree.iter().copied().find(|&joint| model.joints[joint].child.body == at)?;
                at = model.joints[joint].parent.body;
                Some(joint)
            })
            .any(|joint| unknowns.iter().any(|unknown| unknown.joint == joint))
        };
        let [near, far] = if is_moved(ends[1]) { ends } else { [ends[1], ends[0]] };
        return Some([near.clone(), far.clone()]);
    }
    [[0, 1], [1, 0]].into_iter().find_map(|[near, far]| {
        let bearing = &model.joints[carrier(model, ends[near].body, unknowns)?];
        (bearing.kind.freedoms() == 2 && !bearing.kind.is_slide(0) && !bearing.kind.is_slide(1))
            .then(|| [bearing.parent.clone(), ends[far].clone()])
    })
}

/// What could choose between the solutions of a hinge from whose arm something of one length leads to a point.
fn beyond(model: &Model, closing: LoopClosure, unknowns: &[Coordinate]) -> Option<Beyond> {
    let carrier = |body: BodyRef| carrier(model, body, unknowns);
    let ends = ends(model, closing)?;
    [[0, 1], [1, 0]].into_iter().find_map(|[near, far]| {
        let hinge = &model.joints[carrier(ends[near].body)?];
        let Directions::Axis(axis) = &hinge.directions else { return None };
        if hinge.kind.freedoms() != 1 || hinge.kind.is_slide(0) || hinge.kind.has_pitch {
            return None;
        }
        let far = match closing {
            LoopClosure::Constraint(_) => ends[far],
            // A link between two points.
            LoopClosure::Cut(_) => {
                let end = &model.joints[carrier(ends[far].body)?];
                Some(&end.parent).filter(|_| end.kind.freedoms() > 1)?
            }
        };
        Some(Beyond {
            hinge: hinge.child.clone(),
            axis: axis.clone(),
            near: ends[near].clone(),
            far: far.clone(),
            is_above: true,
        })
    })
}

/// For the model itself, with all names in full. What has no text can't be told.
fn alone(model: &Model, form: ClosedForm) -> Option<Line> {
    let name = |coordinate: Coordinate| coordinate_name(model, coordinate);
    let closings: Vec<String> = form.closings.iter().map(|&closing| closing_name(model, closing)).collect();
    let text = text(Wording { model, part: None }, &form, &closings, name)?;
    Some(Line { forms: vec![form], told: Solvable { part: None, text } })
}

/// As it stands in the part that all names are of.
fn local(model: &Model, form: &ClosedForm) -> Option<(PartTypeId, InstanceId, String)> {
    let (&first, others) = form.closings.split_first()?;
    let place = place_of(model, first);
    if others.iter().any(|&other| place_of(model, other).instance != place.instance) {
        return None;
    }
    let part = model.instances[place.instance].part_type?;
    let sides = form.sides.iter().flat_map(|side| side.terms.iter().map(|term| term.0));
    let mut coordinates = sides.chain(form.unknowns.iter().copied());
    if coordinates.any(|coordinate| model.joints[coordinate.joint].place.instance != place.instance) {
        return None;
    }
    let name = |coordinate: Coordinate| local_name(model, coordinate);
    let wording = Wording { model, part: Some(place.instance) };
    let closings: Vec<String> = form.closings.iter().map(|&one| place_of(model, one).field.to_string()).collect();
    Some((part, place.instance, text(wording, form, &closings, name)?))
}

/// `solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }`
fn text(
    wording: Wording<'_>,
    form: &ClosedForm,
    closings: &[String],
    name: impl Fn(Coordinate) -> String,
) -> Option<String> {
    let mut unknowns: Vec<String> = Vec::new();
    for &unknown in &form.unknowns {
        let freedoms = wording.model.joints[unknown.joint].kind.freedoms();
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
    let parameters = |side: &Side| match side.from {
        Origin::Parameter { of, .. } => wording.parameter(of),
        Origin::Number(_) => Some(String::new()),
    };
    let side = |side: &Side| parameters(side).map(|parameter| side.text(&name, &parameter));
    let mut conditions: Vec<String> = form.sides.iter().map(side).collect::<Option<_>>()?;
    conditions.extend(match &form.place {
        Some(place) => Some(place_text(wording, place)?),
        None => None,
    });
    let conditions = if conditions.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", conditions.join(", ")) };
    let closing = match closings {
        [one] => one.clone(),
        several => format!("({})", several.join(", ")),
    };
    Some(format!("solve ({}) from {closing} {conditions}", unknowns.join(", ")))
}

fn place_text(wording: Wording<'_>, place: &Placed) -> Option<String> {
    match place {
        Placed::Beyond(beyond) => {
            let [hinge, near, far] = [&beyond.hinge, &beyond.near, &beyond.far].map(|frame| wording.frame(frame));
            Some(beyond.text(&[hinge?, wording.expression(&beyond.axis)?, near?, far?]))
        }
        Placed::Beside(beside) => {
            let [a, b, c] = beside.rods.each_ref().map(|[near, far]| Some([wording.frame(near)?, wording.frame(far)?]));
            Some(beside.text(&[a?, b?, c?]))
        }
    }
}
