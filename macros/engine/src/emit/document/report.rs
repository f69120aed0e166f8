//! Stage `emit`: the model's report, which is the documentation of the generated module.
//!
//! In: the checked model and its programs. Out: Markdown: parameters, coordinates, inputs, outputs, bodies, the defaults
//! in force, the functions with their methods and operation counts. What is alike for an array of parts stands once
//! ([`alike`]).

use crate::contracts::function::FunctionKind;
use crate::emit::items::separable::is_separable;
use crate::emit::layout::{Layout, joints};
use crate::emit::methods::functions;
use crate::emit::print::{literals, range};
use crate::emit::{Context, context, document, names};
use crate::mechanics::loops::structure::Structure;
use crate::model::types::{Body, BodyRef, Docs, ExprNode, Frame, JointId, Model, Place, Type};
use crate::optimize::program::Compiled;

use super::{alike, code, cost, equations, loops, unchecked, values};

/// The report as a Markdown document.
pub fn report(model: &Model, structure: &Structure, compiled: &Compiled) -> String {
    let mut all = vec![format!("# `{}`", names::plain(&model.name)), String::new()];
    all.extend(model.attrs.iter().filter_map(doc_text).map(|text| {
        let text = text.strip_prefix(' ').unwrap_or(&text);
        text.to_string()
    }));
    all.extend(lines(&context(model, structure, compiled, false)));
    all.push(String::new());
    all.join("\n")
}

/// The text of a `#[doc = ".."]`.
fn doc_text(attr: &syn::Attribute) -> Option<String> {
    match &attr.meta {
        syn::Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

/// The report's lines, to follow the user's own text.
pub(in crate::emit) fn lines(context: &Context<'_>) -> Vec<String> {
    let layout = &context.layout;
    let model = layout.model;
    let mut lines = Vec::new();
    section(&mut lines, "Parameters", &["field", "unit", "default", ""], {
        let params = model.params.iter();
        params.map(|p| row(layout, &p.place, vec![unit(&p.docs), format!("`{}`", values(&p.default)), text(&p.docs)]))
    });
    section(&mut lines, "Coordinates", &["joint", "kind", "parent", "child", "freedoms", ""], {
        let joints = model.joints.iter().enumerate().map(|(number, j)| (JointId(number), j));
        joints.filter(|(id, _)| !model.cuts.contains(id)).map(|(id, j)| {
            let (parent, child) = (frame(layout, &j.parent), frame(layout, &j.child));
            let all = j.kind.freedoms();
            let held = joints::held(model, &layout.structure.state, id).iter().filter(|held| **held).count();
            let freedoms = if held == all { all.to_string() } else { format!("{held} of {all}") };
            let kind = j.kind.word.to_string();
            row(layout, &j.place, vec![kind, parent, child, freedoms, text(&j.docs)])
        })
    });
    section(&mut lines, "States", &["field", "unit", "start", ""], {
        let states = model.states.iter();
        states.map(|s| row(layout, &s.place, vec![unit(&s.docs), format!("`{}`", values(&[s.start])), text(&s.docs)]))
    });
    section(&mut lines, "Inputs", &["field", "unit", "type", ""], {
        let inputs = model.inputs.iter();
        inputs.map(|i| row(layout, &i.place, vec![unit(&i.docs), ty(&i.ty), text(&i.docs)]))
    });
    section(&mut lines, "Outputs", &["field", "unit", "type", ""], {
        let outputs = model.outputs.iter();
        outputs.map(|o| row(layout, &o.place, vec![unit(&o.docs), ty(&o.value.ty), text(&o.docs)]))
    });
    section(&mut lines, "Bodies", &["body", "inertia", ""], {
        let bodies = model.bodies.iter();
        bodies.map(|b| row(layout, &b.place, vec![inertia(b).to_string(), text(&b.docs)]))
    });
    lines.extend(loops::section_lines(context));
    let groups = &layout.structure.groups;
    if !groups.is_empty() {
        lines.extend(["", "## Repeated parts", ""].map(String::from));
        lines.extend(groups.iter().map(|group| format!("- {}", group.sentence())));
    }
    let beyond = range::beyond_single(context);
    if !beyond.is_empty() {
        const MOST: usize = 12;
        let numbers: Vec<String> = beyond.iter().take(MOST).map(|x| format!("`{}`", literals::text(*x))).collect();
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
        let new = vec![String::new(), cost(&compiled.prelude_cost), String::new()];
        let functions = compiled.functions.iter();
        let functions = functions.filter(|f| f.kind != FunctionKind::Outputs || !model.outputs.is_empty());
        let functions = functions.map(|f| {
            let rest = vec![cell(f.method), cost(&f.after), cost(&f.before)];
            plain_row(&functions::name(f.kind), rest)
        });
        std::iter::once(plain_row("new", new)).chain(functions)
    });
    lines.extend(unchecked::lines(context));
    if is_separable(context) {
        let separable = "Accelerations do not depend on velocities: the model is `Separable`.";
        lines.extend(["", separable].map(String::from));
    }
    let defaults = defaults(layout);
    if !defaults.is_empty() {
        lines.extend(["", "## Defaults in force", ""].map(String::from));
        lines.extend(defaults);
    }
    lines
}

/// A row of a table.
pub(in crate::emit) struct TableRow(String);

pub(in crate::emit) fn row(layout: &Layout<'_>, place: &Place, rest: Vec<String>) -> TableRow {
    plain_row(&layout.name(place), rest)
}

/// `legs[_].m` for `legs[2].m`
fn general(name: &str) -> String {
    let mut general = String::new();
    for (number, piece) in name.split('[').enumerate() {
        match piece.split_once(']') {
            Some((_, after)) if number > 0 => general = format!("{general}[_]{after}"),
            _ => general.push_str(piece),
        }
    }
    general
}

fn plain_row(name: &str, rest: Vec<String>) -> TableRow {
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
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

pub(in crate::emit) fn text(docs: &Docs) -> String {
    let lines = document::text(docs);
    let first: Vec<&str> = lines.iter().map(String::as_str).take_while(|line| !line.is_empty()).collect();
    cell(&first.join(" "))
}

fn unit(docs: &Docs) -> String {
    let unit = docs.unit.as_deref();
    unit.map_or_else(String::new, |unit| format!("`{}`", cell(&code(unit))))
}

fn ty(ty: &Type) -> String {
    match ty {
        Type::Scalar => "scalar".to_string(),
        Type::Bool => "condition".to_string(),
        Type::Vec3 => "vector".to_string(),
        Type::Rotation => "rotation".to_string(),
        Type::Pose => "pose".to_string(),
        Type::Twist => "twist".to_string(),
        Type::Wrench => "wrench".to_string(),
        Type::Jacobian => "Jacobian".to_string(),
        Type::Array(element, count) => format!("{count} of {}", self::ty(element)),
    }
}

pub(super) fn frame(layout: &Layout<'_>, frame: &Frame) -> String {
    match frame.body {
        BodyRef::Ground => "ground".to_string(),
        BodyRef::Body(body) => {
            let body = layout.model.bodies.get(body.0);
            body.map_or_else(String::new, |body| format!("`{}`", layout.name(&body.place)))
        }
    }
}

fn inertia(body: &Body) -> &'static str {
    match (&body.mass.node.as_ref(), &body.inertia) {
        (ExprNode::Number(mass), None) if *mass == 0.0 => "massless",
        (_, None) => "point mass",
        _ => "rigid body",
    }
}

/// The choices that the model leaves to the language.
fn defaults(layout: &Layout<'_>) -> Vec<String> {
    let model = layout.model;
    let mut lines = Vec::new();
    if model.gravity.is_none() {
        lines.push("- no gravity".to_string());
    }
    let mut list = |what: &str, places: Vec<&Place>| {
        let mut names: Vec<String> = Vec::new();
        for place in places {
            let name = format!("`{}`", general(&layout.name(place)));
            if !names.contains(&name) {
                names.push(name);
            }
        }
        if !names.is_empty() {
            lines.push(format!("- {what}: {}", names.join(", ")));
        }
    };
    let in_tree = model.joints.iter().enumerate().filter(|(number, _)| !model.cuts.contains(&JointId(*number)));
    let quaternions = in_tree.map(|(_, joint)| joint).filter(|joint| joint.kind.has_quaternion());
    list("orientation by quaternions", quaternions.map(|joint| &joint.place).collect());
    let at_origin = model.bodies.iter().filter(|body| is_zero(body));
    list("centre of mass at the body's origin", at_origin.map(|body| &body.place).collect());
    lines
}

fn is_zero(body: &Body) -> bool {
    let number = |node: &ExprNode| matches!(node, ExprNode::Number(value) if *value == 0.0);
    match body.com.node.as_ref() {
        ExprNode::Vec3(components) => components.iter().all(|c| number(&c.node)),
        _ => false,
    }
}
