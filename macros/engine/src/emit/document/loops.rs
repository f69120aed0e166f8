//! Stage `emit`: closed loops in words: names of coordinates and equations, the picture of the constraint Jacobian, and
//! what the report says of them.
//!
//! In: the layout with the model's structure, and the program of the Jacobian. Out: lines of text.

use crate::contracts::function::FunctionKind;
use crate::emit::layout::leaf::Leaf;
use crate::emit::layout::{Layout, StructKind};
use crate::emit::{Context, document};
use crate::mechanics::loops::constraints::row_name;
use crate::mechanics::loops::structure::{Means, Row, Step};
use crate::model::types::{
    ConstraintId, ConstraintKind, Coordinate, DriveTarget, JointId, LoopClosure, Place, SolveHow,
};
use crate::optimize::program::Expression;

use super::facts::{ClosingFact, Facts, carrier, text};
use super::report::{cell, frame, row, section};
use super::{advice, alike, formula};

impl Layout<'_> {
    /// Names of the components of a velocity, in order: `legs[0].gimbal.first`.
    pub(in crate::emit) fn coordinates(&self) -> Vec<String> {
        let entries = self.table(StructKind::Velocity).entries.iter();
        let names = entries.flat_map(|entry| {
            let place = Place { instance: entry.instance, field: entry.field.clone() };
            let name = self.name(&place);
            (0..entry.leaf.size()).map(move |component| format!("{name}{}", access(&entry.leaf, component)))
        });
        names.collect()
    }

    /// Name of any coordinate of a joint in the tree, or of a speed.
    pub(in crate::emit) fn coordinate(&self, coordinate: Coordinate) -> String {
        if let Some(speed) = self.model.speed(coordinate.joint) {
            return self.name(&speed.place);
        }
        let joint = &self.model.joints[coordinate.joint];
        let leaf = Leaf::velocity(joint.kind);
        let access = leaf.map_or_else(String::new, |leaf| access(&leaf, coordinate.index));
        format!("{}{access}", self.name(&joint.place))
    }

    /// Name of a constraint equation.
    pub(in crate::emit) fn row(&self, row: Row) -> String {
        row_name(self.model, row.closing, row.index)
    }
}

/// `.first`, `.position.x`
fn access(leaf: &Leaf, component: usize) -> String {
    leaf.access(component).to_string().split_whitespace().collect()
}

/// The Jacobian, row by row: `x` where an entry is not always zero, `.` where it is. Nothing where it was not derived.
pub(in crate::emit) fn picture(context: &Context<'_>) -> Option<Vec<String>> {
    let jacobian = context.function(FunctionKind::ConstraintJacobian)?;
    let dof = context.layout.dof().max(1);
    let rows = jacobian
        .program
        .results
        .chunks(dof)
        .map(|row| row.iter().map(|entry| if is_zero(entry) { '.' } else { 'x' }).collect());
    Some(rows.collect())
}

fn is_zero(entry: &Expression) -> bool {
    match entry {
        Expression::Literal(value) => *value == 0.0,
        Expression::Neg(inner) => is_zero(inner),
        _ => false,
    }
}

/// How loops are closed, what is driven, left out and assumed: sentences, each once for what is alike.
pub(super) fn items(context: &Context<'_>) -> Vec<String> {
    let layout = &context.layout;
    let (model, structure) = (layout.model, layout.structure);
    let mut items = Vec::new();
    items.extend(structure.steps.iter().map(|step| dependents(layout, step)));
    items.extend(model.drives.iter().map(|drive| {
        let target = match drive.target {
            DriveTarget::Coordinate(coordinate) => layout.coordinate(coordinate),
            DriveTarget::Position(joint) => format!("{}.position", joint_name(layout, joint)),
            DriveTarget::Orientation(joint) => format!("{}.orientation", joint_name(layout, joint)),
            DriveTarget::Pose(joint) => joint_name(layout, joint),
        };
        format!("{} is driven: {}", quoted(&target), quoted(&formula::text(layout, &drive.value)))
    }));
    items.extend(left_out(context));
    let assumed = model.assumptions.iter();
    items.extend(assumed.map(|condition| format!("assumed: {}", quoted(&formula::text(layout, condition)))));
    items.extend(structure.notes.iter().chain(&model.remarks).cloned());
    items.extend(advice::items(context));
    alike::once(items.iter().map(|item| item.replace('\n', " ")).collect())
}

/// Equations that say nothing beside the others.
pub(super) fn left_out(context: &Context<'_>) -> Option<String> {
    let dropped = context.layout.structure.dropped.iter().map(|row| quoted(&context.layout.row(*row)));
    listed(dropped).map(|names| format!("left out, since they follow from the other equations: {names}"))
}

/// The report's section; nothing for a model without loops and drives.
pub(super) fn section_lines(context: &Context<'_>, facts: &Facts) -> Vec<String> {
    let layout = &context.layout;
    let structure = layout.structure;
    let mut lines = Vec::new();
    if facts.closings.is_empty() && facts.loops.is_empty() {
        return lines;
    }
    section(&mut lines, "Loops", &["closed by", "kind", "between", "and", "equations", ""], {
        facts.closings.iter().map(|closing| {
            let [a, b] = closing.between.each_ref().map(|body| match body {
                Some(name) if name.is_empty() => String::new(),
                body => frame(body.as_ref()),
            });
            row(&closing.name, vec![closing.kind.to_string(), a, b, closing.equations.clone(), cell(&closing.text)])
        })
    });
    if lines.is_empty() {
        lines.extend(["", "## Loops"].map(String::from));
    }
    let (coordinates, rows) = (structure.freedoms(), layout.rows());
    lines.extend([
        String::new(),
        format!("{coordinates} velocity coordinates + {rows} constraint equations = {} equations.", coordinates + rows),
    ]);
    if !facts.loops.is_empty() {
        lines.push(String::new());
        lines.extend(facts.loops.iter().map(|item| format!("- {item}")));
    }
    if let Some(picture) = picture(context).filter(|_| rows > 0) {
        lines.extend(
            ["", "The Jacobian of the equations, `.` where an entry is always zero:", "", "```text"].map(String::from),
        );
        let named = facts.equations.iter().zip(picture);
        lines.extend(named.map(|(row, entries)| format!("{entries}  {row}")));
        lines.push("```".to_string());
    }
    lines
}

/// A fact for each closing joint and constraint.
pub(super) fn closings(layout: &Layout<'_>) -> Vec<ClosingFact> {
    let (model, structure) = (layout.model, layout.structure);
    let count = |closing: LoopClosure| {
        let kept = structure.rows.iter().filter(|row| row.closing == closing).count();
        let solved = structure.steps.iter().map(|step| match &step.means {
            Means::Newton { rows, .. } => rows.iter().filter(|row| row.closing == closing).count(),
            Means::Linear(constraint) | Means::Explicit(constraint) => {
                usize::from(closing == LoopClosure::Constraint(*constraint))
            }
            Means::Solve(_) => 0,
        });
        let solved: usize = solved.sum();
        match (kept, solved) {
            (0, 0) => "solved".to_string(),
            (0, solved) => format!("{solved}, solved"),
            (kept, 0) => kept.to_string(),
            (kept, solved) => format!("{kept}, and {solved} solved"),
        }
    };
    let cuts = model.cuts.iter().map(|id| {
        let joint = &model.joints[*id];
        ClosingFact {
            name: layout.name(&joint.place),
            kind: joint.kind.word,
            between: [carrier(layout, &joint.parent), carrier(layout, &joint.child)],
            equations: count(LoopClosure::Cut(*id)),
            text: text(&joint.docs),
        }
    });
    let constraints = model.constraints.iter().enumerate().map(|(number, constraint)| {
        let (kind, between) = match &constraint.kind {
            ConstraintKind::Value(_) if constraint.drive.is_some() => ("drive", [const { Some(String::new()) }; 2]),
            ConstraintKind::Rate(_) => ("velocities", [const { Some(String::new()) }; 2]),
            ConstraintKind::Value(_) => ("expression", [const { Some(String::new()) }; 2]),
            ConstraintKind::Rod { between, .. } => ("rod", between.each_ref().map(|frame| carrier(layout, frame))),
        };
        ClosingFact {
            name: layout.name(&constraint.place),
            kind,
            between,
            equations: count(LoopClosure::Constraint(ConstraintId(number))),
            text: text(&constraint.docs),
        }
    });
    cuts.chain(constraints).collect()
}

/// What a step finds, and how.
fn dependents(layout: &Layout<'_>, step: &Step) -> String {
    let model = layout.model;
    let unknowns = step.unknowns.iter().map(|unknown| quoted(&layout.coordinate(*unknown)));
    let unknowns = listed(unknowns).unwrap_or_default();
    let closing = |closing: LoopClosure| {
        let place = match closing {
            LoopClosure::Cut(joint) => &model.joints[joint].place,
            LoopClosure::Constraint(id) => &model.constraints[id].place,
        };
        quoted(&layout.name(place))
    };
    match &step.means {
        Means::Linear(constraint) => {
            format!("{unknowns}: linear in the others, by {}", closing(LoopClosure::Constraint(*constraint)))
        }
        Means::Explicit(constraint) => {
            format!("{unknowns}: explicitly, by {}", closing(LoopClosure::Constraint(*constraint)))
        }
        Means::Solve(number) => match &model.solves[*number].how {
            SolveHow::From { closings, branches } => {
                let branches = branches.iter().map(|branch| quoted(&formula::text(layout, branch)));
                let branches = listed(branches).map_or_else(String::new, |branches| format!(", where {branches}"));
                let closings = listed(closings.iter().map(|one| closing(one.what))).unwrap_or_default();
                format!("{unknowns}: in closed form from {closings}{branches}")
            }
            SolveHow::Formulas(_) => format!("{unknowns}: by the declared formulas"),
        },
        Means::Newton { rows, .. } => {
            let rows = rows.iter().map(|row| quoted(&layout.row(*row)));
            format!("{unknowns}: by Newton's method on {}", listed(rows).unwrap_or_default())
        }
    }
}

fn joint_name(layout: &Layout<'_>, joint: JointId) -> String {
    layout.name(&layout.model.joints[joint].place)
}

pub(super) fn quoted(text: &str) -> String {
    format!("`{}`", document::code(text))
}

/// Each once, with commas between; nothing for none.
fn listed(items: impl Iterator<Item = String>) -> Option<String> {
    let unique = alike::once(items.collect());
    (!unique.is_empty()).then(|| unique.join(", "))
}
