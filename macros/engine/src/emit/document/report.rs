//! Stage `emit`: the model's report, which is the documentation of the generated module.
//!
//! In: the checked model and its programs. Out: Markdown: parameters, coordinates, inputs, outputs, bodies, the defaults
//! in force, the functions with their methods and operation counts. What is alike for an array of parts stands once
//! ([`alike`]).

use crate::emit::layout::Layout;
use crate::emit::methods::functions;
use crate::emit::{Context, context, names};
use crate::mechanics::loops::structure::Structure;
use crate::model::types::Model;
use crate::optimize::program::Compiled;

use super::facts::{Declared, Facts, doc_text};
use super::{alike, code, equations, loops, unchecked};

/// The report as a Markdown document.
pub fn report(model: &Model, structure: &Structure, compiled: &Compiled) -> String {
    let mut all = vec![format!("# `{}`", names::plain(&model.name)), String::new()];
    all.extend(model.attrs.iter().filter_map(doc_text));
    all.extend(lines(&context(model, structure, compiled, false)));
    all.push(String::new());
    all.join("\n")
}

/// The report's lines, to follow the user's own text.
pub(in crate::emit) fn lines(context: &Context<'_>) -> Vec<String> {
    let layout: &Layout<'_> = &context.layout;
    let facts = Facts::new(context);
    let mut lines = Vec::new();
    let values = |declared: &Declared| {
        row(&declared.name, vec![unit(declared), format!("`{}`", declared.value), cell(&declared.text)])
    };
    let types =
        |declared: &Declared| row(&declared.name, vec![unit(declared), declared.value.clone(), cell(&declared.text)]);
    section(&mut lines, "Parameters", &["field", "unit", "default", ""], facts.params.iter().map(values));
    section(&mut lines, "Coordinates", &["joint", "kind", "parent", "child", "freedoms", ""], {
        facts.joints.iter().filter(|joint| !joint.closes).map(|joint| {
            let (parent, child) = (frame(joint.parent.as_ref()), frame(joint.child.as_ref()));
            row(&joint.name, vec![joint.kind.to_string(), parent, child, joint.freedoms.clone(), cell(&joint.text)])
        })
    });
    section(&mut lines, "States", &["field", "unit", "start", ""], facts.states.iter().map(values));
    section(&mut lines, "Inputs", &["field", "unit", "type", ""], facts.inputs.iter().map(types));
    section(&mut lines, "Outputs", &["field", "unit", "type", ""], facts.outputs.iter().map(types));
    section(&mut lines, "Bodies", &["body", "inertia", ""], {
        facts.bodies.iter().map(|body| row(&body.name, vec![body.inertia.to_string(), cell(&body.text)]))
    });
    lines.extend(loops::section_lines(context, &facts));
    if !facts.repeated.is_empty() {
        lines.extend(["", "## Repeated parts", ""].map(String::from));
        lines.extend(facts.repeated.iter().map(|group| format!("- {group}")));
    }
    let beyond = &facts.beyond_single;
    if !beyond.is_empty() {
        const MOST: usize = 12;
        let numbers: Vec<String> = beyond.iter().take(MOST).map(|x| format!("`{x}`")).collect();
        let more = if beyond.len() > MOST { format!(" and {} more", beyond.len() - MOST) } else { String::new() };
        lines.extend(["", "## Beyond single precision", ""].map(String::from));
        lines.push(format!(
            "`f32` doesn't hold these numbers of the equations: {}{more}. With it `Params::check` is an error.",
            numbers.join(", ")
        ));
    }
    lines.extend(equations::lines(layout));
    section(&mut lines, "Functions", &["function", "method", "operations", "as derived"], {
        let compiled = context.compiled;
        let new = vec![String::new(), compiled.prelude_cost.words(), String::new()];
        let functions = facts.functions.iter().map(|&number| {
            let f = &compiled.functions[number];
            row(&functions::name(layout.model, f.kind), vec![cell(f.method), f.after.words(), f.before.words()])
        });
        let at = compiled.at.iter().flat_map(|at| {
            let own = row("at", vec![String::new(), at.cost.words(), String::new()]);
            let functions = at.functions.iter().map(|f| {
                let name = format!("at.{}", functions::name(layout.model, f.kind));
                row(&name, vec![cell(f.method), f.after.words(), f.before.words()])
            });
            std::iter::once(own).chain(functions)
        });
        std::iter::once(row("new", new)).chain(functions).chain(at)
    });
    lines.extend(unchecked::lines(&facts));
    if facts.is_separable {
        let separable = "Accelerations do not depend on velocities: the model is `Separable`.";
        lines.extend(["", separable].map(String::from));
    }
    if !facts.defaults.is_empty() {
        lines.extend(["", "## Defaults in force", ""].map(String::from));
        lines.extend(facts.defaults.iter().map(|choice| format!("- {choice}")));
    }
    lines
}

/// A row of a table.
pub(super) struct TableRow(String);

pub(super) fn row(name: &str, rest: Vec<String>) -> TableRow {
    TableRow(format!("| `{name}` | {} |", rest.join(" | ")))
}

/// A table under a heading; nothing where there are no rows.
pub(super) fn section(lines: &mut Vec<String>, heading: &str, columns: &[&str], rows: impl Iterator<Item = TableRow>) {
    let rows: Vec<String> = rows.map(|row| row.0).collect();
    if rows.is_empty() {
        return;
    }
    lines.extend([String::new(), format!("## {heading}"), String::new()]);
    lines.push(format!("| {} |", columns.join(" | ")));
    lines.push(format!("|{}", "---|".repeat(columns.len())));
    lines.extend(alike::once(rows));
}

/// Text for a cell of a table: one line, no bars.
pub(super) fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

fn unit(declared: &Declared) -> String {
    declared.unit.as_deref().map_or_else(String::new, |unit| format!("`{}`", cell(&code(unit))))
}

/// The body that a frame is fixed to, or the ground.
pub(super) fn frame(body: Option<&String>) -> String {
    body.map_or_else(|| "ground".to_string(), |name| format!("`{name}`"))
}
