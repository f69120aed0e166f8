//! Stage `model`: units of items.
//!
//! In: the checker's names and what its items have given. Out: errors where an expression's unit is not that of the
//! place in which it stands.

use std::rc::Rc;

use crate::model::assemble::{Collected, Loops};
use crate::model::checker::{Checker, Meaning, Subject};
use crate::model::docs;
use crate::model::joint_kinds::JointKind;
use crate::model::report::Report;
use crate::model::types::{
    Body, Constraint, ConstraintKind, Coordinate, Docs, Drive, DriveTarget, Expr, Force, ForceKind, Handling, Joint,
    JointId, ParamId, Solve, SolveHow, State,
};

use super::declared::{Declared, declared};
use super::dimension::Unit;
use super::expressions::{Expressions, Held, conversion};
use super::quantities::{self as quantity, OfCoordinate, Quantity, SLIDES};
use super::value::{Known, Text};

/// The units of one model.
pub(in crate::model) struct Units {
    pub(super) expressions: Expressions,
    /// Without a declared unit there is nothing to compare.
    idle: bool,
}

impl Units {
    /// Reads what is declared.
    pub(in crate::model) fn new(checker: &Checker<'_, '_>) -> Units {
        let name = |item: &proc_macro2::Ident| item.to_string();
        let params = checker.params.iter().map(|slot| declared(&name(&slot.place.field), &slot.docs));
        let inputs = checker.inputs.iter().map(|slot| declared(&name(&slot.place.field), &slot.docs));
        let states = checker.states.iter();
        let states = states.map(|slot| declared(&name(&slot.place.field), &docs::docs(&slot.item.attrs)));
        let expressions = Expressions {
            params: params.collect(),
            inputs: inputs.collect(),
            states: states.collect(),
            joints: checker.joints.iter().map(|slot| slot.kind).collect(),
            ..Expressions::default()
        };
        let items = [&expressions.params, &expressions.inputs, &expressions.states];
        let declares = items.into_iter().flatten().any(Option::is_some)
            || checker.named.iter().any(|named| named.unit.is_some())
            || checker.functions.iter().any(|function| function.unit.is_some())
            // Others may declare what this model gives them.
            || !checker.asked_elsewhere.is_empty()
            || checker.joints.iter().any(|slot| docs::docs(&slot.item.attrs).unit.is_some())
            || checker
                .forces
                .iter()
                .chain(&checker.constraints)
                .any(|slot| docs::docs(&slot.item.attrs).unit.is_some());
        Units { expressions, idle: !declares }
    }

    /// All items but those that speak of the tree.
    pub(in crate::model) fn items(&mut self, checker: &Checker<'_, '_>, collected: &Collected<'_>) {
        if self.idle {
            return;
        }
        self.hold(collected.constraints.iter().map(Option::as_ref));
        self.names(checker);
        for value in &checker.returned {
            self.named(value);
        }
        for (expr, wanted) in &checker.quantities {
            self.expressions.expect(expr, *wanted);
        }
        if let Some(gravity) = &collected.gravity {
            self.expressions.expect(gravity, quantity::ACCELERATION);
        }
        if let Some(Handling::Stabilised { rate, position }) = &collected.handling {
            self.expressions.expect(rate, quantity::STABILISING_RATE);
            self.expressions.expect(position, quantity::STABILISING_POSITION);
        }
        for body in collected.bodies.iter().flatten() {
            self.body(body);
        }
        for joint in collected.joints.iter().flatten() {
            self.joint(joint);
        }
        for force in collected.forces.iter().flatten() {
            self.force(force);
        }
        for constraint in collected.constraints.iter().flatten() {
            self.constraint(constraint);
        }
        for state in collected.states.iter().flatten() {
            self.state(state);
        }
        for condition in collected.assumptions.iter().flatten() {
            self.expressions.of(condition);
        }
    }

    /// What constraints hold, for what names their equations; nothing of those with mistakes.
    pub(super) fn hold<'c>(&mut self, constraints: impl Iterator<Item = Option<&'c Constraint>>) {
        let held = |constraint: &Constraint| match &constraint.kind {
            ConstraintKind::Rod { .. } => Held::Rod,
            ConstraintKind::Value(value) | ConstraintKind::Rate(value) => {
                Held::Value(value.clone(), declared(&constraint.place.field.to_string(), &constraint.docs))
            }
        };
        self.expressions.held = constraints.map(|constraint| constraint.map(held)).collect();
    }

    /// What speaks of the tree.
    pub(in crate::model) fn loops(&mut self, loops: &Loops) {
        if self.idle {
            return;
        }
        for drive in &loops.drives {
            self.drive(drive);
        }
        for constraint in &loops.held {
            self.constraint(constraint);
        }
        for solve in &loops.solves {
            self.solve(solve);
        }
    }

    /// Says what is wrong.
    pub(in crate::model) fn tell(self, report: &mut Report<'_>) {
        for mistake in self.expressions.mistakes {
            match mistake.help {
                Some(help) => report.help(mistake.span, mistake.message, help),
                None => report.error(mistake.span, mistake.message),
            }
        }
    }

    /// Values with names, and defaults, in source order.
    fn names(&mut self, checker: &Checker<'_, '_>) {
        for task in &checker.tasks {
            match task.subject {
                Subject::Named(id) => match checker.named[id].known() {
                    Some(Meaning::Value(value)) => self.named(&value.expr),
                    Some(Meaning::Frame(frame)) => self.expressions.frame(&frame.frame),
                    _ => {}
                },
                Subject::Param(id) => {
                    let default = checker.params[id].default.as_ref();
                    default.into_iter().for_each(|default| self.default(id, default));
                }
                _ => {}
            }
        }
    }

    /// The unit of a name against that of its value.
    fn named(&mut self, expr: &Expr) {
        let Some(declared) = &expr.unit else {
            self.expressions.of(expr);
            return;
        };
        let wanted = Known::from(&**declared);
        if let Some((span, _, found)) = self.expressions.misfit_beneath(expr, &wanted) {
            self.differs(span, &declared.name, &wanted, &found);
            self.expressions.refused.insert(Rc::as_ptr(declared));
        }
    }

    /// The unit of a param against that of its default.
    fn default(&mut self, id: ParamId, default: &Expr) {
        let Some(slot) = self.expressions.params.get_mut(id.0) else { return };
        let Some(declared) = slot.take() else {
            self.expressions.of(default);
            return;
        };
        // A default does not speak of its param.
        if self.declares(default, &declared.name, &Known::from(&declared))
            && let Some(slot) = self.expressions.params.get_mut(id.0)
        {
            *slot = Some(declared);
        }
    }

    /// Whether it may.
    fn declares(&mut self, expr: &Expr, name: &str, wanted: &Known) -> bool {
        let found = self.expressions.misfit(expr, wanted);
        if let Some((span, _, found)) = &found {
            self.differs(*span, name, wanted, found);
        }
        found.is_none()
    }

    fn differs(&mut self, span: proc_macro2::Span, name: &str, wanted: &Known, found: &Known) {
        let message = format!("`{name}` is declared in {}, its value is in {}", wanted.text(), found.text());
        self.expressions.mistake(span, message, conversion(found, wanted, ""));
    }

    fn body(&mut self, body: &Body) {
        self.expressions.expect(&body.mass, quantity::MASS);
        self.expressions.expect(&body.com, quantity::LENGTH);
    }

    fn joint(&mut self, joint: &Joint) {
        self.expressions.frame(&joint.parent);
        self.expressions.frame(&joint.child);
        for direction in joint.directions.written() {
            self.expressions.of(direction);
        }
        if let Some(pitch) = &joint.pitch {
            self.expressions.expect(pitch, quantity::PITCH);
        }
        let of = OfCoordinate::of(joint.kind, 0);
        if let Some(armature) = &joint.armature {
            self.expressions.expect(armature, of.armature);
        }
        if joint.kind.freedoms() == 1 {
            let (name, position) = (joint.place.field.to_string(), of.position);
            self.documented(&name, &joint.docs, joint.span, position, "the coordinate of");
        }
    }

    /// A unit that stands at an item whose unit the language gives.
    fn documented(&mut self, name: &str, docs: &Docs, span: proc_macro2::Span, own: Quantity, what: &str) {
        let Some(declared) = declared(name, docs).filter(|declared| !declared.unit.is(own.unit)) else {
            return;
        };
        let message = format!("{what} `{name}` is in {}, not in {}", own.text, declared.text);
        self.expressions.mistake(span, message, None);
    }

    fn kind(&self, joint: JointId) -> Option<&'static JointKind> {
        self.expressions.joints.get(joint.0).copied().flatten()
    }

    fn force(&mut self, force: &Force) {
        let name = force.place.field.to_string();
        match &force.kind {
            ForceKind::Effort { joint, values } => {
                let Some(kind) = self.kind(*joint) else { return };
                for (index, value) in values.iter().enumerate() {
                    self.expressions.expect(value, OfCoordinate::of(kind, index).effort);
                }
                if kind.freedoms() == 1 {
                    self.documented(&name, &force.docs, force.span, OfCoordinate::of(kind, 0).effort, "the effort");
                }
            }
            ForceKind::JointSpring { joint, coordinate, stiffness, damping, rest } => {
                let Some(kind) = self.kind(*joint) else { return };
                let of = OfCoordinate::of(kind, *coordinate);
                self.spring([(stiffness, of.stiffness), (damping, of.damping), (rest, of.position)]);
            }
            ForceKind::LineSpring { between, stiffness, damping, length } => {
                between.iter().for_each(|frame| self.expressions.frame(frame));
                self.spring([(stiffness, SLIDES.stiffness), (damping, SLIDES.damping), (length, quantity::LENGTH)]);
            }
            ForceKind::Force { at, value, axes } => {
                self.at_frame([at, axes], value, quantity::FORCE);
                self.documented(&name, &force.docs, force.span, quantity::FORCE, "the force");
            }
            ForceKind::Torque { at, value, axes } => {
                self.at_frame([at, axes], value, quantity::TORQUE);
                self.documented(&name, &force.docs, force.span, quantity::TORQUE, "the torque");
            }
        }
    }

    fn spring(&mut self, fields: [(&Option<Expr>, Quantity); 3]) {
        for (expr, wanted) in fields {
            if let Some(expr) = expr {
                self.expressions.expect(expr, wanted);
            }
        }
    }

    fn at_frame(&mut self, frames: [&crate::model::types::Frame; 2], value: &Expr, wanted: Quantity) {
        frames.into_iter().for_each(|frame| self.expressions.frame(frame));
        self.expressions.expect(value, wanted);
    }

    fn constraint(&mut self, constraint: &Constraint) {
        match &constraint.kind {
            ConstraintKind::Value(value) | ConstraintKind::Rate(value) => {
                let name = constraint.place.field.to_string();
                match declared(&name, &constraint.docs) {
                    Some(declared) => {
                        self.declares(value, &name, &Known::from(&declared));
                    }
                    None => {
                        self.expressions.of(value);
                    }
                }
            }
            ConstraintKind::Rod { between, length } => {
                between.iter().for_each(|frame| self.expressions.frame(frame));
                self.expressions.expect(length, quantity::LENGTH);
            }
        }
    }

    fn state(&mut self, state: &State) {
        let name = state.place.field.to_string();
        let of = declared(&name, &state.docs);
        let per_second = of.and_then(|of| Some((of.unit.over(quantity::TIME.unit)?, of)));
        let Some((unit, of)) = per_second else {
            self.expressions.of(&state.rate);
            return;
        };
        let wanted = Known { unit, declared: true, text: Text::Written(rate_text(&of)) };
        if let Some((span, _, found)) = self.expressions.misfit(&state.rate, &wanted) {
            let message = format!("the rate of `{name}` is in {}, this is in {}", wanted.text(), found.text());
            self.expressions.mistake(span, message, conversion(&found, &wanted, ""));
        }
    }

    fn drive(&mut self, drive: &Drive) {
        match drive.target {
            DriveTarget::Coordinate(coordinate) => self.coordinate(coordinate, &drive.value),
            DriveTarget::Position(_) => self.expressions.expect(&drive.value, quantity::LENGTH),
            DriveTarget::Orientation(_) | DriveTarget::Pose(_) => {
                self.expressions.of(&drive.value);
            }
        }
    }

    /// What a coordinate is set to.
    fn coordinate(&mut self, coordinate: Coordinate, value: &Expr) {
        if let Some(kind) = self.kind(coordinate.joint) {
            self.expressions.expect(value, OfCoordinate::of(kind, coordinate.index).position);
        }
    }

    fn solve(&mut self, solve: &Solve) {
        match &solve.how {
            SolveHow::Formulas(formulas) => {
                for (coordinate, formula) in solve.unknowns.iter().zip(formulas) {
                    self.coordinate(*coordinate, formula);
                }
            }
            SolveHow::From { branches, .. } => {
                for condition in branches {
                    self.expressions.of(condition);
                }
            }
        }
    }
}

/// `A/s`
fn rate_text(of: &Declared) -> Rc<str> {
    let text = &*of.text;
    Rc::from(match of.unit.is(Unit::ONE) && matches!(text, "1" | "-") {
        true => "1/s".to_string(),
        false if text.contains([' ', '/', '*', '·']) => format!("({text})/s"),
        false => format!("{text}/s"),
    })
}
