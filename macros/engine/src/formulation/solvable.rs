//! Stage `formulation`: which `solve` items the user could write, where Newton's method closes loops.
//!
//! In: a model whose loops go by Newton's method, and what it takes. Out: formulas of coordinates that stand still while the
//! loops move, or go along with others (`mechanics::analysis::relations`): so are plates on parallelograms; then closed forms of what
//! is left ([`closable`]). What is told has been tried: such items are checked as any of the user's, with the declared parameters, the
//! model is derived with them, and takes less.

use std::collections::BTreeMap;

use crate::invariant::fault::guard;
use crate::mechanics::analysis::{Relation, analyse, relations};
use crate::mechanics::loops::advice::{Closing, Figures, Solvable};
use crate::mechanics::loops::constraints::{coordinate_name, local_name};
use crate::model::formulated::Formula;
use crate::model::types::{Coordinate, InstanceId, Model, PartTypeId};

use super::{closable, figures, judged};

/// What saves less is not worth a line.
const WORTH: f64 = 0.95;

/// Of more lines none is tried by itself, since each is derived.
const MOST_LINES: usize = 6;

/// A constant is one of these multiples of a half turn, or a decimal.
const PARTS_OF_HALF_TURN: i32 = 12;

/// Decimals, and how far from one a value may be that was found in numbers.
const DECIMALS: f64 = 1e6;
const NEAR: f64 = 1e-8;

/// One line for each joint of a part, or of the model itself.
type Key = (Option<PartTypeId>, String);

struct Line {
    items: Vec<Vec<(Coordinate, Formula)>>,
    told: Solvable,
}

pub(super) fn solvable(model: &Model, own: &Figures) -> Option<(Vec<Solvable>, Figures)> {
    if own.closing != Closing::Newton {
        return None;
    }
    let (mut told, with, mut least) = formulas(model, own)?;
    let forms = closed_forms(&with, &least);
    if let Some((lines, figures)) = forms {
        told.extend(lines);
        least = figures;
    }
    (!told.is_empty()).then_some((told, least))
}

/// Closed forms of loops that are left, with what the model takes then.
fn closed_forms(model: &Model, own: &Figures) -> Option<(Vec<Solvable>, Figures)> {
    let judged = judged(model, &model.handling);
    let structure = analyse(&judged).ok()?;
    let (lines, poses) = closable::lines(&judged, &structure);
    let takes = |lines: &[&closable::Line]| -> Option<Figures> {
        let forms: Vec<_> = lines.iter().flat_map(|line| line.forms.iter().cloned()).collect();
        // A closed form has to be that of the branch on which Newton's method starts, whatever its conditions have chosen.
        let is_so = guard("mechanics", || closable::agrees(&judged.closing(&forms), &poses)).unwrap_or(false);
        if is_so { figures(&model.closing(&forms), &model.handling).ok() } else { None }
    };
    let (kept, least) = kept(&lines, own, takes)?;
    Some((kept.into_iter().map(|line| line.told.clone()).collect(), least))
}

/// Formulas of coordinates with the model that has them, and what that takes; no formula where none is worth a line.
fn formulas(model: &Model, own: &Figures) -> Option<(Vec<Solvable>, Model, Figures)> {
    let judged = judged(model, &model.handling);
    let structure = analyse(&judged).ok()?;
    let instance = |coordinate: Coordinate| judged.joints[coordinate.joint].place.instance;
    // A formula of a part reads that part alone.
    let found = relations(&judged, &structure, |unknown, other| instance(unknown) == instance(other));
    let items = |lines: &[&Line]| -> Vec<_> { lines.iter().flat_map(|line| line.items.iter().cloned()).collect() };
    let takes = |lines: &[&Line]| figures(&model.solving(&items(lines)), &model.handling).ok();
    let lines = lines(&judged, &found);
    let Some((kept, least)) = kept(&lines, own, takes) else { return Some((Vec::new(), model.clone(), *own)) };
    let told = kept.iter().map(|line| line.told.clone()).collect();
    Some((told, model.solving(&items(&kept)), least))
}

/// The lines that are worth it: all at once, or one by one where some line is refused.
fn kept<'a, L>(
    lines: &'a [L],
    own: &Figures,
    takes: impl Fn(&[&L]) -> Option<Figures>,
) -> Option<(Vec<&'a L>, Figures)> {
    let (mut kept, mut least): (Vec<&L>, Figures) = (Vec::new(), *own);
    let all: Vec<&L> = lines.iter().collect();
    let single = all.iter().map(|&line| vec![line]).filter(|_| (2..=MOST_LINES).contains(&all.len()));
    let ways: Vec<Vec<&L>> = std::iter::once(all.clone()).filter(|all| !all.is_empty()).chain(single).collect();
    for more in ways {
        let tried = [kept.clone(), more].concat();
        if let Some(found) = takes(&tried).filter(|found| f64::from(found.work) < WORTH * f64::from(least.work)) {
            (kept, least) = (tried, found);
            if kept.len() == lines.len() {
                break;
            }
        }
    }
    (!kept.is_empty()).then_some((kept, least))
}

/// What holds in every part of a type, joint by joint.
fn lines(model: &Model, found: &[(Coordinate, Relation)]) -> Vec<Line> {
    let mut joints: BTreeMap<Key, BTreeMap<(InstanceId, usize), Relation>> = BTreeMap::new();
    for &(coordinate, relation) in found {
        let place = &model.joints[coordinate.joint].place;
        let part = model.instances[place.instance].part_type;
        let own = joints.entry((part, place.field.to_string())).or_default();
        own.insert((place.instance, coordinate.index), relation);
    }
    joints.into_iter().filter_map(|(key, relations)| line(model, found, &key, &relations)).collect()
}

fn line(
    model: &Model,
    found: &[(Coordinate, Relation)],
    (part, field): &Key,
    relations: &BTreeMap<(InstanceId, usize), Relation>,
) -> Option<Line> {
    let all = (0..model.instances.len()).map(InstanceId).filter(|&id| model.instances[id].part_type == *part);
    let has_one = |id: &InstanceId| part.is_some() || relations.keys().any(|key| key.0 == *id);
    let parts: Vec<InstanceId> = all.filter(has_one).collect();
    let &first = parts.first()?;
    let of_first =
        |index: usize| relations.get(&(first, index)).and_then(|&relation| worded(model, relation, part.is_some()));
    let indices: Vec<usize> = relations.keys().filter(|key| key.0 == first).map(|key| key.1).collect();
    // The same in every part.
    let everywhere = |&index: &usize| {
        let text = of_first(index);
        text.is_some()
            && parts.iter().all(|&id| {
                relations.get(&(id, index)).and_then(|&relation| worded(model, relation, part.is_some())) == text
            })
    };
    let indices: Vec<usize> = indices.into_iter().filter(everywhere).collect();
    if indices.is_empty() {
        return None;
    }
    let name = |coordinate: Coordinate| {
        if part.is_some() { local_name(model, coordinate) } else { coordinate_name(model, coordinate) }
    };
    let mut items = Vec::new();
    let mut told = None;
    for &id in &parts {
        let own: Vec<(Coordinate, Relation)> = found
            .iter()
            .copied()
            .filter(|(coordinate, _)| {
                let place = &model.joints[coordinate.joint].place;
                place.instance == id && place.field == field.as_str() && indices.contains(&coordinate.index)
            })
            .collect();
        let unknowns: Vec<Coordinate> = own.iter().map(|one| one.0).collect();
        let formulas = own.iter().map(|one| Some((one.0, formula(one.1)?))).collect::<Option<Vec<_>>>()?;
        if told.is_none() {
            let names: Vec<String> = unknowns.iter().map(|&unknown| name(unknown)).collect();
            let values = own.iter().map(|one| worded(model, one.1, part.is_some())).collect::<Option<Vec<String>>>()?;
            let part = part.map(|part| model.part_types[part].name.to_string());
            told = Some(Solvable { part, text: format!("solve ({}) = ({});", names.join(", "), values.join(", ")) });
        }
        items.push(formulas);
    }
    Some(Line { items, told: told? })
}

/// As it stands behind the equals sign.
fn worded(model: &Model, relation: Relation, is_in_part: bool) -> Option<String> {
    let name = |coordinate: Coordinate| {
        let joint = &model.joints[coordinate.joint];
        let bare = if is_in_part { local_name(model, coordinate) } else { coordinate_name(model, coordinate) };
        // In an expression the name of such a joint is the joint, and no number.
        match joint.kind.freedoms.get(coordinate.index) {
            Some(freedom) if joint.kind.freedoms() == 1 => format!("{bare}.{}", freedom.name),
            _ => bare,
        }
    };
    Some(match relation {
        Relation::Constant(value) => match constant(value)? {
            (value, None) => format!("{value:?}"),
            (_, Some(parts)) => format!("{parts}.0 * PI / {PARTS_OF_HALF_TURN}.0"),
        },
        Relation::Same(other) => name(other),
        Relation::Opposite(other) => format!("-{}", name(other)),
    })
}

fn formula(relation: Relation) -> Option<Formula> {
    Some(match relation {
        Relation::Constant(value) => Formula::Number(constant(value)?.0),
        Relation::Same(other) => Formula::Same(other),
        Relation::Opposite(other) => Formula::Opposite(other),
    })
}

/// The number that was meant, and how many twelfths of a half turn it is; nothing where it is none of these.
fn constant(value: f64) -> Option<(f64, Option<i32>)> {
    let decimal = (value * DECIMALS).round() / DECIMALS;
    if (decimal - value).abs() < NEAR {
        return Some((decimal + 0.0, None));
    }
    let part = std::f64::consts::PI / f64::from(PARTS_OF_HALF_TURN);
    let parts = (value / part).round();
    ((parts * part - value).abs() < NEAR).then_some((parts * part, Some(parts as i32)))
}
