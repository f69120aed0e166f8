//! Room `written`: names of what is written apart.
//!
//! In: lines with definitions between them. Out: the same, where a definition that the lines of one element of an array alone read
//! bears the element's name, `legs[2].u`: so what is alike in all elements is written alike.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::mechanics::loops::constraints::path;
use crate::mechanics::loops::structure::Structure;
use crate::model::types::{LoopClosure, Model, Place};
use crate::symbolic::write::formula::{Formula, Identifier};
use crate::symbolic::write::vacant;

use super::{Line, Subject};

/// The part that a line is about, `legs[2]`; none where it is the model itself.
pub(super) fn part_of(model: &Model, structure: &Structure, subject: Subject) -> Option<String> {
    let place = match subject {
        Subject::Position(c)
        | Subject::Cosine(c)
        | Subject::Sine(c)
        | Subject::Rate(c)
        | Subject::Driven(c, _)
        | Subject::Follows(c, _)
        | Subject::Rest(c)
        | Subject::Acceleration(c) => &model.joints[c.joint].place,
        Subject::Speed(number) => &model.speeds[number].place,
        Subject::Constraint(row) | Subject::Closing(row) | Subject::Rolling(row) => of_closing(model, row.closing),
        Subject::Slope(k, _) => of_closing(model, structure.rows[k].closing),
        _ => return None,
    };
    path(model, place).rsplit_once('.').map(|(part, _)| part.to_owned())
}

fn of_closing(model: &Model, closing: LoopClosure) -> &Place {
    match closing {
        LoopClosure::Cut(id) => &model.joints[id].place,
        LoopClosure::Constraint(id) => &model.constraints[id].place,
    }
}

/// New names by the ones before.
pub(super) type Renamed = HashMap<Identifier, Identifier>;

/// Gives definitions the names of the elements that read them.
pub(super) fn by_element(
    lines: &mut [Line],
    part: &dyn Fn(Subject) -> Option<String>,
    taken: &mut HashSet<String>,
) -> Renamed {
    let mut readers: HashMap<Identifier, BTreeSet<Option<String>>> = HashMap::new();
    // Readers stand behind what they read.
    for line in lines.iter().rev() {
        let own = match (line.subject, &line.equation.left) {
            (Subject::Definition, Formula::Name(name)) => readers.get(name).cloned().unwrap_or_default(),
            _ => BTreeSet::from([part(line.subject)]),
        };
        each_name(&line.equation.right, &mut |name| readers.entry(name.clone()).or_default().extend(own.clone()));
    }
    let mut renamed = Renamed::new();
    for line in lines.iter().filter(|line| line.subject == Subject::Definition) {
        let Formula::Name(name) = &line.equation.left else { continue };
        let parts = readers.get(name).into_iter().flatten();
        let [Some(part)] = &parts.collect::<Vec<_>>()[..] else { continue };
        // What has an index has the coordinate there.
        if part.ends_with(']') && name.index.is_none() {
            let text = vacant(&format!("{part}.{}", stem(&name.text, part)), taken);
            renamed.insert(name.clone(), Identifier { text, ..name.clone() });
        }
    }
    for line in lines {
        rename(&mut line.equation.left, &renamed);
        rename(&mut line.equation.right, &renamed);
    }
    renamed
}

pub(super) fn rename(formula: &mut Formula, renamed: &Renamed) {
    formula.each_name_mut(&mut |name| {
        if let Some(new) = renamed.get(name) {
            *name = new.clone();
        }
    });
}

fn each_name(formula: &Formula, visit: &mut dyn FnMut(&Identifier)) {
    if let Formula::Name(name) = formula {
        visit(name);
    }
    formula.each_part(&mut |part| each_name(part, visit));
}

/// A name without the element's, and without the number that told it from those of other elements.
fn stem<'t>(text: &'t str, part: &str) -> &'t str {
    let element = part.replace(['[', '.'], "_").replace(']', "") + "_";
    let own = text.strip_prefix(element.as_str()).unwrap_or(text);
    let stem = own.trim_end_matches(|c: char| c.is_ascii_digit());
    stem.strip_suffix('_').filter(|stem| !stem.is_empty()).unwrap_or(own)
}
