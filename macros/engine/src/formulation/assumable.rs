//! Stage `formulation`: what the user could assume for equations to cost less.
//!
//! In: a model with multipliers, and what it takes. Out: `assume` items that let more equations be absorbed. Volumes of rows that
//! depend on one coordinate alone say how far that may go (`mechanics::hopes`). What is told has been tried: the model is derived
//! with it, and takes less.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::invariant::fault::guard;
use crate::mechanics;
use crate::mechanics::analysis::{Hope, analyse};
use crate::mechanics::loops::advice::{Assumable, Closing, Figures};
use crate::mechanics::loops::constraints::{coordinate_name, local_name};
use crate::model::assumed::{Assumed, tidied};
use crate::model::types::{Coordinate, JointId, Model, PartTypeId};

use super::{figures, judged};

/// How much of a volume has to be left; where less is not accepted, more.
const SHARES: [f64; 2] = [0.1, 0.3];

/// As many ways are tried, since each is derived.
const MOST_WAYS: usize = 2;

/// More lines than these nobody writes.
const MOST_LINES: usize = 6;

/// Of more lines none is left out to see whether it is needed.
const MOST_DOUBTED: usize = 3;

/// What saves less is not worth a line.
const WORTH: f64 = 0.95;

/// One line of the user's: a coordinate of the model, or of each part of a type.
type Key = (Option<PartTypeId>, String, usize);

struct Line {
    coordinates: Vec<Coordinate>,
    assumed: Assumed,
    told: Assumable,
}

pub(super) fn assumable(model: &Model, own: &Figures) -> Option<(Vec<Assumable>, Figures)> {
    if own.closing != Closing::Multipliers {
        return None;
    }
    let judged = judged(model, &model.handling);
    let structure = analyse(&judged).ok()?;
    let takes = |lines: &[Line]| -> Option<Figures> {
        let all = lines.iter().flat_map(|line| line.coordinates.iter().map(|&coordinate| (coordinate, line.assumed)));
        figures(&model.assuming(&all.collect::<Vec<_>>()), &model.handling).ok()
    };
    let is_worth = |found: &Figures, than: &Figures| f64::from(found.work) < WORTH * f64::from(than.work);
    let mut best: Option<(Vec<Line>, Figures)> = None;
    for share in SHARES {
        let hopes = guard("mechanics", || mechanics::hopes(&judged, &structure, share)).ok()?.ok()?;
        for hopes in hopes.into_iter().take(MOST_WAYS) {
            let lines = lines(model, &hopes);
            if lines.len() > MOST_LINES {
                continue;
            }
            let Some(found) = takes(&lines).filter(|found| is_worth(found, own)) else { continue };
            if best.as_ref().is_none_or(|(_, known)| is_worth(&found, known)) {
                best = Some((lines, found));
            }
        }
        if best.is_some() {
            break;
        }
    }
    let (mut lines, mut least) = best?;
    // What makes no difference is not asked for.
    let mut at = 0;
    let is_short = lines.len() <= MOST_DOUBTED;
    while is_short && lines.len() > 1 && at < lines.len() {
        let line = lines.remove(at);
        match takes(&lines).filter(|found| found.work <= least.work) {
            Some(found) => least = found,
            None => {
                lines.insert(at, line);
                at += 1;
            }
        }
    }
    Some((lines.into_iter().map(|line| line.told).collect(), least))
}

/// One for each coordinate, and one for the same coordinate of all parts of a type.
fn lines(model: &Model, hopes: &[(Coordinate, Hope)]) -> Vec<Line> {
    let mut groups: BTreeMap<Key, Vec<Hope>> = BTreeMap::new();
    for &(coordinate, hope) in hopes {
        groups.entry(key(model, coordinate)).or_default().push(hope);
    }
    let line = |(key, hopes): (Key, Vec<Hope>)| {
        let joints = (0..model.joints.len()).map(JointId).filter(|id| !model.cuts.contains(id));
        let all = joints.map(|joint| Coordinate { joint, index: key.2 });
        let coordinates: Vec<Coordinate> = all.filter(|&coordinate| self::key(model, coordinate) == key).collect();
        let &first = coordinates.first()?;
        let part = key.0.map(|part| model.part_types[part].name.to_string());
        let assumed = assumed(&hopes)?;
        let name = if part.is_some() { local_name(model, first) } else { coordinate_name(model, first) };
        let told = Assumable { part, condition: assumed.text(&name) };
        Some(Line { coordinates, assumed, told })
    };
    groups.into_iter().filter_map(line).collect()
}

/// Outside of parts a joint stands for itself.
fn key(model: &Model, coordinate: Coordinate) -> Key {
    let place = &model.joints[coordinate.joint].place;
    let part = model.instances[place.instance].part_type;
    (part, place.field.to_string(), coordinate.index)
}

/// What holds for all of them.
fn assumed(hopes: &[Hope]) -> Option<Assumed> {
    let bounds = |of: fn(&Hope) -> Option<f64>| hopes.iter().filter_map(of);
    let least = bounds(|hope| hope.least).reduce(f64::max);
    let most = bounds(|hope| hope.most).reduce(f64::min);
    let travels = hopes.first()?.travels;
    let nearest = hopes.iter().map(|hope| hope.at);
    let (low, high) = (nearest.clone().fold(f64::INFINITY, f64::min), nearest.fold(f64::NEG_INFINITY, f64::max));
    if least.is_some_and(|least| least >= low) || most.is_some_and(|most| most <= high) {
        return None;
    }
    if !travels && (least.is_some() || most.is_some()) {
        // Beyond half a turn it comes to the other bound from behind.
        return Some(Assumed::angle(least.unwrap_or(high - PI), most.unwrap_or(low + PI)));
    }
    match (least, most) {
        (Some(least), Some(most)) => Some(Assumed::Between(tidied(least, low), tidied(most, high))),
        (Some(least), None) => Some(Assumed::Above(tidied(least, low))),
        (None, Some(most)) => Some(Assumed::Below(tidied(most, high))),
        (None, None) => None,
    }
}
