//! Random expressions that take others apart, and questions to other models.

use super::expressions::{Level, literal, scalar, vector};
use super::names::{Aid, Names, Shape};
use crate::random::Random;

/// By what values are differentiated, and in whose place others are put.
pub fn variable(random: &mut Random, names: &Names) -> Option<String> {
    let mut choices: Vec<String> = Vec::new();
    for _ in 0..2 {
        choices.extend(names.variable(random));
        choices.extend(names.variable(random).map(|c| format!("{c}.rate")));
    }
    for shape in [Shape::Param, Shape::State, Shape::Input] {
        choices.extend(names.scalar(random, shape));
    }
    if choices.is_empty() { None } else { Some(random.pick(&choices).clone()) }
}

/// The same, or time, by which only outputs are differentiated.
fn along(random: &mut Random, names: &Names, level: Level) -> Option<String> {
    if level >= Level::Output && random.chance(25) { Some("t".into()) } else { variable(random, names) }
}

/// Inside of what is taken apart nothing may follow from the forces.
fn inside(level: Level) -> Level {
    level.min(Level::Force)
}

/// A scalar of finished equations; nothing where there is nothing to take apart.
pub fn finished(random: &mut Random, names: &Names, level: Level, depth: usize) -> Option<String> {
    let entry = |random: &mut Random| names.variable(random);
    match random.below(10) {
        0..=2 => {
            let of = scalar(random, names, inside(level), depth);
            Some(format!("diff({of}, {})", along(random, names, level)?))
        }
        3 => {
            let energy = random.pick(&["kinetic()", "potential()", "kinetic() + potential()"]);
            Some(format!("diff({energy}, {})", along(random, names, level)?))
        }
        4 | 5 => {
            let of = scalar(random, names, inside(level), depth);
            Some(format!("substitute({of}, {})", pairs(random, names, level)?))
        }
        6 => Some(format!("mass_matrix[{}, {}]", entry(random)?, entry(random)?)),
        7 if level >= Level::Output => Some(format!("bias[{}]", entry(random)?)),
        7 => Some(format!("diff(diff(kinetic(), {}.rate), {}.rate)", entry(random)?, entry(random)?)),
        8 => {
            let row = names.row(random)?;
            Some(if random.chance(50) {
                format!("constraint[{row}]")
            } else {
                format!("jacobian[{row}, {}]", entry(random)?)
            })
        }
        _ => Some(format!("closed({})", names.closed(random)?)),
    }
}

/// A vector of the same kind.
pub fn finished_vector(random: &mut Random, names: &Names, level: Level, depth: usize) -> Option<String> {
    let of = vector(random, names, inside(level), depth);
    Some(if random.chance(60) {
        format!("diff({of}, {})", along(random, names, level)?)
    } else {
        format!("substitute({of}, {})", pairs(random, names, level)?)
    })
}

fn pairs(random: &mut Random, names: &Names, level: Level) -> Option<String> {
    let first = variable(random, names)?;
    let mut text = format!("{first} = {}", scalar(random, names, inside(level), 1));
    if let Some(second) = variable(random, names).filter(|second| *second != first && random.chance(40)) {
        text += &format!(", {second} = {}", scalar(random, names, inside(level), 1));
    }
    Some(text)
}

/// A scalar of another model.
pub fn asked(random: &mut Random, names: &Names, aid: &Aid, level: Level) -> String {
    let of = match random.below(12) {
        0 => "[0.5, 1.5][1]".to_owned(),
        1 | 2 => names_of(random, aid, "rate").unwrap_or_else(|| literal(random)),
        _ => scalar(random, &aid.names, Level::Force, 2),
    };
    format!("{}({of}{})", aid.name, given(random, names, aid, level))
}

/// A vector of another model.
pub fn asked_vector(random: &mut Random, names: &Names, aid: &Aid, level: Level) -> String {
    let of = vector(random, &aid.names, Level::Force, 1);
    format!("{}({of}{})", aid.name, given(random, names, aid, level))
}

fn names_of(random: &mut Random, aid: &Aid, member: &str) -> Option<String> {
    let name = aid.names.coordinate(random)?;
    Some(format!("{name}.{member}"))
}

/// Values for all that must be given, and for a parameter.
fn given(random: &mut Random, names: &Names, aid: &Aid, level: Level) -> String {
    let mut text = String::new();
    for name in &aid.given {
        let depth = usize::from(random.chance(40));
        text += &format!(", {name} = {}", scalar(random, names, level, depth));
    }
    if let Some(param) = aid.names.scalar(random, Shape::Param).filter(|_| random.chance(40)) {
        text += &format!(", {param} = {}", scalar(random, names, level, 0));
    }
    text
}
