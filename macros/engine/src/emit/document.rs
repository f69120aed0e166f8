//! Stage `emit`: documentation of single items.
//!
//! In: the user's `///` text and units, operation counts. Out: lines of Markdown, which become `#[doc]` attributes. Every
//! public item has some: a crate that denies `missing_docs` accepts it.

mod advice;
pub(super) mod alike;
mod equations;
pub(super) mod facts;
pub(super) mod fields;
pub(super) mod formula;
pub(super) mod loops;
pub(super) mod report;
pub(super) mod shown;
mod unchecked;
pub(super) mod unused;

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::mechanics::loops::structure::Modes;
use crate::model::joint_kinds::JointKind;
use crate::model::types::{Docs, Joint, Param, PartTypeId, Speed, State};
use crate::optimize::packs;
use crate::optimize::program::{At, Compiled, Function};

use super::layout::{Layout, StructKind};
use super::print::literals;
use super::{Context, names};

/// Expands to one `#[doc = ".."]` per line.
pub(super) fn attributes(lines: &[String]) -> TokenStream {
    let lines = lines.iter().map(|line| match line.as_str() {
        "" => String::new(),
        line => format!(" {line}"),
    });
    quote!(#(#[doc = #lines])*)
}

/// The user's text with its unit in front as code; `otherwise` where there is none.
pub(super) fn item(docs: &Docs, otherwise: &str) -> Vec<String> {
    with_unit(docs, docs.unit.as_deref(), otherwise)
}

fn with_unit(docs: &Docs, unit: Option<&str>, otherwise: &str) -> Vec<String> {
    let mut lines = text(docs);
    if lines.iter().all(String::is_empty) {
        lines = vec![otherwise.to_string()];
    }
    if let (Some(unit), Some(first)) = (unit, lines.first_mut()) {
        *first = format!("`[{}]` {first}", code(unit));
    }
    lines
}

/// The lines of `///` text, without the space after the slashes.
pub(super) fn text(docs: &Docs) -> Vec<String> {
    let lines = docs.text.iter();
    lines.map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end().to_string()).collect()
}

/// Text that can stand between backticks.
pub(super) fn code(text: &str) -> String {
    text.replace('`', "'")
}

pub(super) fn param(param: &Param) -> Vec<String> {
    let mut lines = item(&param.docs, "parameter");
    lines.extend([String::new(), format!("Default: `{}`", values(&param.default))]);
    lines
}

pub(super) fn state(state: &State) -> Vec<String> {
    let mut lines = item(&state.docs, "state");
    lines.extend([String::new(), format!("Starts at `{}`", values(&[state.start]))]);
    lines
}

/// Of a speed of the user's choice in `Velocity`.
pub(super) fn speed(speed: &Speed) -> Vec<String> {
    item(&speed.docs, "speed")
}

/// `1.0`, or `[1.0, 2.0]`; long lists are cut.
pub(super) fn values(values: &[f64]) -> String {
    const MOST: usize = 12;
    let mut list: Vec<String> = values.iter().take(MOST).map(|v| literals::text(*v)).collect();
    if values.len() > MOST {
        list.push(format!(".. ({} numbers)", values.len()));
    }
    match &list[..] {
        [single] => single.clone(),
        _ => format!("[{}]", list.join(", ")),
    }
}

pub(super) fn position(joint: &Joint) -> Vec<String> {
    let unit = joint.docs.unit.as_deref().or(unit(joint.kind));
    let otherwise = format!("position of the {} joint", joint.kind.word);
    with_unit(&joint.docs, unit, &otherwise)
}

pub(super) fn velocity(joint: &Joint) -> Vec<String> {
    let unit = joint.docs.unit.as_deref().or(unit(joint.kind));
    let unit = unit.map(|unit| format!("{unit}/s"));
    let otherwise = format!("velocity of the {} joint", joint.kind.word);
    with_unit(&Docs::default(), unit.as_deref(), &otherwise)
}

/// Of a part of a joint, in `Position` and in `Velocity`.
pub(super) fn piece(joint: &Joint, what: &str, unit: &str) -> [Vec<String>; 2] {
    let kind = joint.kind.word;
    let (position, velocity) =
        (format!("{what} of the {kind} joint"), format!("rate of the {what} of the {kind} joint"));
    let rate = format!("{unit}/s");
    [with_unit(&joint.docs, Some(unit), &position), with_unit(&Docs::default(), Some(&rate), &velocity)]
}

/// Of a joint's one coordinate.
fn unit(kind: &JointKind) -> Option<&'static str> {
    let one = kind.freedoms() == 1;
    one.then(|| if kind.is_slide(0) { "m" } else { "rad" })
}

/// Of the structs `Params`, `Position`, ..
pub(super) fn group(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> Vec<String> {
    let part = owner.and_then(|part| layout.model.part_types.get(part.0));
    let of = part.map_or_else(
        || format!("`{}`", names::plain(&layout.model.name)),
        |part| format!("one part `{}`", names::plain(&part.name)),
    );
    let line = match group {
        StructKind::Params => format!("Parameters of {of}. The default is what the model declares."),
        StructKind::Position => {
            format!("Positions of the joints of {of}. The default is zero, or the identity.")
        }
        StructKind::Velocity => {
            format!("Velocities of {of}; accelerations and efforts have the same components.")
        }
        StructKind::Rates => format!("Rates of the positions of {of}, and their displacements."),
        StructKind::States => format!("States of {of} beside its coordinates, or their rates."),
        StructKind::Input => format!("Inputs of {of}, held over a step. The default is zero."),
        StructKind::Guess => {
            format!("Where Newton's method starts to close the loops of {of}: coordinates that follow from the others.")
        }
        StructKind::Output => format!("Outputs of {of}."),
        StructKind::Poses => format!("Where the bodies of {of} are in the world."),
    };
    let mut lines = vec![line];
    let size = layout.table(group).size;
    if owner.is_none() && matches!(group, StructKind::Position | StructKind::Velocity | StructKind::Rates) {
        lines.extend([String::new(), format!("Components in order of declaration: {size}.")]);
    }
    lines
}

/// Of `Model`.
pub(super) fn model(context: &Context<'_>) -> Vec<String> {
    let name = names::plain(&context.layout.model.name);
    let fields = match context.fields.len() {
        0 => "It takes no space: nothing depends on parameters.".to_string(),
        1 => "It holds the one value that depends on parameters alone.".to_string(),
        count => format!("It holds the {count} values that depend on parameters alone."),
    };
    vec![format!("The equations of motion of `{name}`. {fields}")]
}

/// Of `Model::new`.
pub(super) fn new(compiled: &Compiled) -> Vec<String> {
    vec![
        "Does the work that depends on parameters alone.".to_string(),
        String::new(),
        format!("Operations: {}.", compiled.prelude_cost.words()),
    ]
}

/// Of `Model::assembly_modes`.
pub(super) fn assembly_modes(found: &[String], modes: Option<Modes>) -> Vec<String> {
    let text = format!("All positions that what is given leaves, in this order: {}.", found.join(", "));
    let Some(Modes { sides, roots, .. }) = modes else { return vec![text] };
    let count = match (sides, roots) {
        (0, roots) => format!("{roots} at most, real ones first, the others NaN."),
        (sides, 0) => format!("{} at most; those that are not real are NaN.", 1 << sides),
        (sides, roots) => format!(
            "{} at most: {roots} for each of {} choices of sides, real ones first in each row, the others NaN.",
            roots << sides,
            1 << sides
        ),
    };
    vec![text, String::new(), count]
}

/// What a function gives.
fn meaning(layout: &Layout<'_>, function: &Function) -> String {
    let text = (function.kind.row().documentation)(&layout.sizes(function.kind));
    match function.kind {
        FunctionKind::Kinematics(number) => {
            let found = &layout.model.kinematics[number].find;
            let found: Vec<String> = found.iter().map(|c| format!("`{}`", code(&layout.coordinate(*c)))).collect();
            text.replace("{}", &found.join(", "))
        }
        FunctionKind::Assembly => {
            let found = layout.model.assembly.iter().flat_map(|wanted| &wanted.find);
            let found: Vec<String> = found.map(|c| format!("`{}`", code(&layout.coordinate(*c)))).collect();
            text.replace("{}", &found.join(", "))
        }
        FunctionKind::OutputGroup(number) => {
            let outputs = layout.model.output_groups[number].outputs();
            let named = outputs.map(|place| format!("`{}`", layout.name(&layout.model.outputs[place].place)));
            text.replace("{}", &named.collect::<Vec<_>>().join(", "))
        }
        _ => text.to_string(),
    }
}

/// Of a derived function.
pub(super) fn function(layout: &Layout<'_>, function: &Function) -> Vec<String> {
    let mut lines = work(layout, function);
    lines.extend(equations::of_function(layout, function.kind));
    lines
}

/// What a function gives, by which method, and what that costs.
fn work(layout: &Layout<'_>, function: &Function) -> Vec<String> {
    let mut lines = vec![meaning(layout, function), String::new()];
    if !function.method.is_empty() {
        lines.extend([format!("Method: {}.", function.method), String::new()]);
    }
    let (before, after) = (function.before.words(), function.after.words());
    lines.push(format!("Operations: {after}; as derived, before optimisation: {before}."));
    if let Some([packed, scalar]) = packs::operations(&function.program) {
        lines.push(format!("Limbs go in packs: {packed} operations on packs, {scalar} on scalars."));
    }
    lines
}

/// Of the struct that `Model::at` gives.
pub(super) fn at(layout: &Layout<'_>, at: &At) -> Vec<String> {
    let name = names::plain(&layout.model.name);
    let fields = match at.fields.len() {
        0 => "It holds no value: nothing depends on these alone.".to_string(),
        1 => "It holds the one value that depends on these alone, and is read by its functions.".to_string(),
        count => format!("It holds the {count} values that depend on these alone, and are read by its functions."),
    };
    vec![format!("`{name}` at a position, with what else [`Model::at`] takes. {fields}")]
}

/// Of `Model::at`.
pub(super) fn new_at(layout: &Layout<'_>, at: &At) -> Vec<String> {
    let functions = at.functions.iter().map(|f| format!("[`{0}`](At::{0})", f.kind.method(layout.model)));
    vec![
        "Does the work that depends on parameters and what is given here alone, once for several functions."
            .to_string(),
        String::new(),
        format!("Functions that go on from there: {}.", functions.collect::<Vec<_>>().join(", ")),
        String::new(),
        format!("Operations: {}.", at.cost.words()),
    ]
}

/// Of a function of what that gives.
pub(super) fn of_at(layout: &Layout<'_>, function: &Function) -> Vec<String> {
    let mut lines = work(layout, function);
    lines.extend([String::new(), format!("The same as [`Model::{}`].", function.kind.method(layout.model))]);
    lines
}
