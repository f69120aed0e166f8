//! Stage `model`: what is held at zero, and what follows a prescribed course.
//!
//! In: `constraint`, `drive`, `assume`. Out: scalars of positions and time, or of velocities too, rods, coordinates with their
//! expressions.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, ExprField, Member};

use crate::model::checker::{Checker, Context, Meaning, Slot};
use crate::model::checks::evaluate::Value;
use crate::model::docs;
use crate::model::expand::root;
use crate::model::expressions::source_text;
use crate::model::joint_kinds::JointKind;
use crate::model::topology::Topology;
use crate::model::typed::{Allowed, Class, FrameValue, Typed, new_expr};
use crate::model::types::Expr as Checked;
use crate::model::types::{
    BodyRef, Comparison, Constraint, ConstraintKind, Coordinate, Drive, DriveTarget, ExprNode, Joint, JointId, Joints,
    Order, Type,
};
use crate::syntax::tree::{self, ItemKind};

use super::fields::{Known, field};

const ROD: Known<'static> = Known { required: &["between", "length"], optional: &[] };

/// What a `drive` gives.
pub(in crate::model) enum Driven {
    /// Coordinates of the tree, which leave the state.
    Follows(Drive),
    /// A measured coordinate, held to its course by a multiplier.
    Held(Constraint),
}

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn finish_constraint(&mut self, slot: &Slot<'a>) -> Option<Constraint> {
        let context = root(slot.scope);
        let (name, kind) = match &slot.item.kind {
            ItemKind::ConstraintValue { name, value } => {
                let value = self.scalar(value, context, Allowed::Constraint);
                // The rate of a state may jump, and velocities with it where an equation of positions reads the state.
                let value = value.filter(|value| {
                    let is_of_velocities = value.uses.culprit(Class::State).is_some();
                    let refused = if is_of_velocities { None } else { value.uses.refusal(Allowed::Positions) };
                    let is_right = refused.is_none();
                    refused.into_iter().for_each(|(span, message)| self.report.error(span, message));
                    is_right
                });
                let kind = |value: Typed| match value.uses.culprit(Class::State) {
                    Some(_) => ConstraintKind::Rate(value.expr),
                    None => ConstraintKind::Value(value.expr),
                };
                (name, value.map(kind))
            }
            ItemKind::ConstraintKind { name, kind, fields } if kind == "Rod" => {
                self.check_fields(&format!("the rod `{name}`"), name, fields, &ROD);
                let between = field(fields, "between").and_then(|expr| self.between(expr, context));
                let length = field(fields, "length").and_then(|expr| {
                    let length = self.scalar(expr, context, Allowed::Parameters)?;
                    self.positive(&length, "the length of a rod")?;
                    Some(length.expr)
                });
                let rod = between.zip(length);
                let rod = rod.and_then(|(frames, length)| self.rod(frames, length, fields));
                (name, rod)
            }
            ItemKind::ConstraintKind { name, kind, .. } => {
                let text = kind.to_string();
                if text == tree::UNREADABLE {
                    self.report.silent();
                } else {
                    self.report.unknown(
                        kind.span(),
                        format!("unknown kind of constraint `{text}`"),
                        &text,
                        ["Rod", "Rolling", "Skate"],
                        Some("there are `Rod`, `Rolling`, `Skate`, and `constraint name = value;`".into()),
                    );
                }
                (name, None)
            }
            _ => return None,
        };
        Some(Constraint {
            place: slot.place.clone(),
            kind: kind?,
            drive: None,
            docs: docs::docs(&slot.item.attrs),
            span: name.span(),
        })
    }

    fn rod(
        &mut self,
        between: [crate::model::types::Frame; 2],
        length: Checked,
        fields: &tree::Fields,
    ) -> Option<ConstraintKind> {
        let [a, b] = &between;
        if a.body == b.body {
            let at = field(fields, "between").map_or(fields.span, Spanned::span);
            self.report.error(at, "both ends of this rod are on one body");
            return None;
        }
        Some(ConstraintKind::Rod { between: Box::new(between), length })
    }

    /// A finite value at the declared defaults that is above zero.
    fn positive(&mut self, value: &crate::model::typed::Typed, what: &str) -> Option<()> {
        self.finite(value)?;
        let number = self.evaluator.scalar(&value.expr)?;
        if number > 0.0 {
            return Some(());
        }
        let message = format!("{what} must be positive, but is {number} at the declared defaults");
        self.report.error(value.expr.span, message);
        None
    }

    /// `assume condition;`
    pub(in crate::model) fn assumption(&mut self, condition: &Expr, context: Context<'a>) -> Option<Checked> {
        let checked = self.typed(condition, context, &Type::Bool, Allowed::Positions)?.expr;
        self.check_assumed(condition, &checked);
        Some(checked)
    }

    /// What is assumed of parameters alone holds at the declared defaults, and is tested by `Params::check`.
    fn check_assumed(&mut self, written: &Expr, condition: &Checked) {
        let written = match written {
            Expr::Paren(inner) => &*inner.expr,
            other => other,
        };
        let sides = match written {
            Expr::Binary(both) => Some([&*both.left, &*both.right]),
            _ => None,
        };
        if let (ExprNode::And(a, b), Some([left, right])) = (&*condition.node, sides) {
            self.check_assumed(left, a);
            self.check_assumed(right, b);
            return;
        }
        if !matches!(self.evaluator.value(condition), Some(Value::Bool(false))) {
            return;
        }
        if let (ExprNode::Compare(comparison, a, b), Some([left, _])) = (&*condition.node, sides)
            && let (Some(is), Some(bound)) = (self.evaluator.scalar(a), self.evaluator.scalar(b))
        {
            // Numbers are rounded.
            if *comparison == Comparison::Equal && (is - bound).abs() <= 1e-9 * (is.abs() + bound.abs()) {
                return;
            }
            let what = crate::syntax::text(quote::ToTokens::to_token_stream(left)).replace(' ', "");
            let words = comparison.words();
            let message = format!("`{what}` must be {words} {bound}, but is {is} at the declared defaults");
            return self.report.error(a.span, message);
        }
        self.report.error(condition.span, "this is assumed, but doesn't hold at the declared defaults");
    }

    /// `drive target = value;`
    pub(in crate::model) fn drive(
        &mut self,
        target: &Expr,
        value: &Expr,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<Driven> {
        let found = self.drive_target(target, context, joints);
        let ty = match found {
            Some(DriveTarget::Coordinate(_)) => Type::Scalar,
            Some(DriveTarget::Position(_)) => Type::Vec3,
            Some(DriveTarget::Orientation(_)) => Type::Rotation,
            Some(DriveTarget::Pose(_)) => Type::Pose,
            None => {
                // Mistakes in the value are reported all the same.
                self.value(value, context);
                return None;
            }
        };
        let value = self.typed(value, context, &ty, Allowed::Time)?;
        let span = target.span();
        Some(match found? {
            DriveTarget::Coordinate(coordinate) if joints.is_some_and(|(tree, _)| tree.is_cut(coordinate.joint)) => {
                let Coordinate { joint, index } = coordinate;
                let place = self.joints[joint].place.clone();
                let order = Order::Position;
                let measured = new_expr(ExprNode::Coordinate { joint, index, order }, Type::Scalar, span);
                let gap = new_expr(ExprNode::Sub(measured, value.expr), Type::Scalar, span);
                let kind = ConstraintKind::Value(gap);
                Driven::Held(Constraint { place, kind, drive: Some(coordinate), docs: docs::docs(&[]), span })
            }
            target => Driven::Follows(Drive { target, value: value.expr, span }),
        })
    }

    pub(in crate::model) fn drive_target(
        &mut self,
        expr: &Expr,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<DriveTarget> {
        if let Expr::Field(field) = expr
            && let Member::Named(member) = &field.member
            && ["position", "orientation", "rotation", "pose"].iter().any(|known| member == known)
        {
            return self.whole_target(field, &member.to_string(), context, joints);
        }
        let (joint, index) = match self.meaning(expr, context)? {
            Meaning::Coordinate(joint, index) => (joint, index),
            Meaning::Joint(joint) => {
                let kind = self.joint_kind(joint)?;
                if kind.freedoms() != 1 {
                    let text = source_text(expr);
                    let names = drivable(kind, &text);
                    let message = format!("a drive needs one coordinate: `{text}` is a joint of kind {}", kind.name);
                    self.report.help(expr.span(), message, names);
                    return None;
                }
                (joint, 0)
            }
            Meaning::Frame(_) => {
                let text = source_text(expr);
                let help = format!("write `{text}.pose`, `{text}.position` or `{text}.orientation`");
                self.report.help(expr.span(), "a frame can't be driven as such", help);
                return None;
            }
            _ => {
                self.report.help(
                    expr.span(),
                    "this can't be driven",
                    "drives are on coordinates, such as `crank.angle`, and on poses of bodies that move freely",
                );
                return None;
            }
        };
        if let Some((topology, list)) = joints
            && topology.is_cut(joint)
            && !self.is_measured(&list[joint])
        {
            self.refuse_cut_coordinate(joint, expr.span(), list);
            return None;
        }
        Some(DriveTarget::Coordinate(Coordinate { joint, index }))
    }

    /// `platform.pose`, of a body on a Free joint or of that joint; `ball.orientation`.
    fn whole_target(
        &mut self,
        field: &ExprField,
        member: &str,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<DriveTarget> {
        let joint = match self.meaning(&field.base, context)? {
            Meaning::Joint(joint) => joint,
            Meaning::Frame(frame) => self.free_carrier(&frame, &field.base, joints)?,
            _ => {
                let text = source_text(&field.base);
                self.report.error(field.base.span(), format!("`{text}` has no `{member}` that can be driven"));
                return None;
            }
        };
        let joint = self.itself(joint, joints);
        let kind = self.joint_kind(joint)?;
        let target = match member {
            "position" if kind.is_free() => DriveTarget::Position(joint),
            "pose" if kind.is_free() => DriveTarget::Pose(joint),
            "orientation" | "rotation" if kind.turns_freely() => DriveTarget::Orientation(joint),
            _ => {
                let text = source_text(&field.base);
                let message = format!("a joint of kind {} has no `{member}` that can be driven", kind.name);
                self.report.help(field.span(), message, drivable(kind, &text));
                return None;
            }
        };
        self.in_the_tree(joint, field.span(), joints)?;
        Some(target)
    }

    /// A Free joint on the ground whose body has absolute coordinates is that body's own.
    fn itself(&self, joint: JointId, joints: Option<(&Topology, &Joints)>) -> JointId {
        let Some((topology, list)) = joints else { return joint };
        let written = &list[joint];
        if !(topology.is_cut(joint) && plain(written) && written.kind.is_free()) {
            return joint;
        }
        self.own_joint(written.child.body).unwrap_or(joint)
    }

    /// The Free joint on the ground whose coordinates are the pose of a body.
    pub(super) fn free_carrier(
        &mut self,
        frame: &FrameValue,
        base: &Expr,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<JointId> {
        if let Some(joint) = self.absolute(frame) {
            return Some(joint);
        }
        // Without a tree nothing more is known, and that has been told.
        let (topology, list) = joints?;
        let text = source_text(base);
        let carrier = topology.carrier(frame.frame.body, list).filter(|_| frame.frame.steps.is_empty());
        let free = carrier.filter(|id| self.joint_kind(*id).is_some_and(JointKind::is_free) && plain(&list[*id]));
        if free.is_none() {
            self.report.help(
                base.span(),
                format!("the pose of `{text}` is no coordinate"),
                "the body needs `coordinates: Absolute(..)`, or a Free joint whose frames are the ground's and its own",
            );
        }
        free
    }

    /// Refuses joints without coordinates.
    fn in_the_tree(&mut self, joint: JointId, at: Span, joints: Option<(&Topology, &Joints)>) -> Option<()> {
        match joints {
            Some((topology, list)) if topology.is_cut(joint) => {
                self.refuse_cut_coordinate(joint, at, list);
                None
            }
            _ => Some(()),
        }
    }

    /// The coordinates that a drive takes.
    pub(in crate::model) fn driven(&self, target: DriveTarget) -> Vec<Coordinate> {
        let freedoms = |joint: JointId| {
            let kind = self.joints[joint].kind;
            kind.map_or(0, JointKind::freedoms)
        };
        let (joint, range) = match target {
            DriveTarget::Coordinate(coordinate) => return vec![coordinate],
            DriveTarget::Position(joint) => (joint, 0..3),
            DriveTarget::Orientation(joint) => (joint, freedoms(joint).saturating_sub(3)..freedoms(joint)),
            DriveTarget::Pose(joint) => (joint, 0..6),
        };
        range.map(|index| Coordinate { joint, index }).collect()
    }

    /// How messages name a coordinate.
    pub(in crate::model) fn coordinate_name(&self, coordinate: Coordinate) -> String {
        let slot = &self.joints[coordinate.joint];
        let name = self.path_text(&slot.place);
        slot.kind.map_or_else(|| format!("`{name}`"), |kind| kind.coordinate_text(&name, coordinate.index))
    }
}

/// Whether a joint leads from the ground's frame to a body's own.
fn plain(joint: &Joint) -> bool {
    joint.parent.body == BodyRef::Ground && joint.parent.steps.is_empty() && joint.child.steps.is_empty()
}

/// What a joint has that can be driven.
fn drivable(kind: &JointKind, text: &str) -> String {
    let mut names: Vec<String> = kind.coordinates().iter().map(|name| format!("`{text}.{name}`")).collect();
    let whole: &[&str] = match (kind.turns_freely(), kind.is_free()) {
        (true, true) => &["position", "orientation", "pose"],
        (true, false) => &["orientation"],
        (false, _) => &[],
    };
    names.extend(whole.iter().map(|name| format!("`{text}.{name}`")));
    match names.as_slice() {
        [] => "take another joint".into(),
        names => format!("take {}", names.join(", ")),
    }
}
