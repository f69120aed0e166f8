//! Stage `model`: `base.member`.
//!
//! In: field accesses. Out: quantities of frames, joints, forces and values; things inside parts.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprField, Member};

use crate::model::checker::{Checker, Context, Meaning, ScopeId};
use crate::model::joint_kinds::JointKind;
use crate::model::typed::{Class, FrameValue, Typed, Uses, type_text};
use crate::model::types::{BodyRef, ConstraintId, ExprNode, ForceId, FrameQuantity, JointId, Type};

use super::bodies::is_centre_of_mass;
use super::coerce::{component_of, convert};
use super::paths::plain_frame;
use super::source_text;

/// Quantities of a frame by name.
const QUANTITIES: [(&str, FrameQuantity, Type, Class); 8] = [
    ("position", FrameQuantity::Position, Type::Vec3, Class::Position),
    ("rotation", FrameQuantity::Rotation, Type::Rotation, Class::Position),
    ("pose", FrameQuantity::Pose, Type::Pose, Class::Position),
    ("velocity", FrameQuantity::Velocity, Type::Vec3, Class::State),
    ("angular_velocity", FrameQuantity::AngularVelocity, Type::Vec3, Class::State),
    ("twist", FrameQuantity::Twist, Type::Twist, Class::State),
    ("acceleration", FrameQuantity::Acceleration, Type::Vec3, Class::Acceleration),
    ("angular_acceleration", FrameQuantity::AngularAcceleration, Type::Vec3, Class::Acceleration),
];

impl<'a> Checker<'a, '_> {
    pub(super) fn member(&mut self, field: &ExprField, context: Context<'a>) -> Option<Meaning> {
        let base = self.meaning(&field.base, context)?;
        self.member_of(base, field)
    }

    /// A member of what its base means.
    pub(super) fn member_of(&mut self, base: Meaning, field: &ExprField) -> Option<Meaning> {
        let Member::Named(member) = &field.member else {
            self.report.help(field.member.span(), "there are no tuples here", "elements of arrays are `a[0]`");
            return None;
        };
        match base {
            Meaning::Part(scope) => self.part_member(scope, &field.base, member),
            Meaning::Parts(_) => {
                let text = source_text(&field.base);
                self.report.help(
                    field.base.span(),
                    format!("`{text}` is an array of parts"),
                    format!("write `{text}[0].{member}`"),
                );
                None
            }
            Meaning::Joint(joint) => self.joint_member(joint, &field.base, member),
            Meaning::Coordinate(joint, index) => self.coordinate_member(joint, index, &field.base, member),
            Meaning::Frame(frame) => self.frame_member(frame, &field.base, member),
            Meaning::Force(force) => self.force_member(force, &field.base, member),
            Meaning::Constraint(constraint) => self.constraint_member(constraint, &field.base, member),
            Meaning::Value(value) => self.value_member(value, member),
        }
    }

    fn part_member(&mut self, scope: ScopeId, base: &Expr, member: &Ident) -> Option<Meaning> {
        let name = member.to_string();
        if let Some(symbol) = self.scopes[scope].symbol(&name) {
            return self.symbol(&symbol, member);
        }
        let known = self.names_of(scope);
        if self.is_broken(scope) && crate::diagnostics::nearest(&name, known.iter().map(String::as_str)).is_none() {
            self.report.silent();
            return None;
        }
        self.report.unknown(
            member.span(),
            format!("the part `{}` has no `{name}`", source_text(base)),
            &name,
            known.iter().map(String::as_str),
            None,
        );
        None
    }

    fn frame_member(&mut self, frame: FrameValue, base: &Expr, member: &Ident) -> Option<Meaning> {
        let name = member.to_string();
        let at = member.span();
        let text = format!("{}.{name}", source_text(base));
        if name == "jacobian" {
            let axes = plain_frame(BodyRef::Ground, at);
            let node = ExprNode::Jacobian { frame: frame.frame, axes };
            let uses = Uses::of(Class::Position, text, at);
            let value = Typed::leaf(node, Type::Jacobian, at).with(uses);
            return Some(Meaning::Value(value));
        }
        let Some((_, quantity, ty, class)) = QUANTITIES.iter().find(|(known, ..)| *known == name) else {
            if let Some(joint) = self.absolute(&frame) {
                let kind = self.joints[joint].kind;
                let coordinates = kind.map_or_else(Vec::new, JointKind::coordinates);
                if coordinates.contains(&name.as_str()) || matches!(name.as_str(), "rates" | "effort") {
                    return self.joint_member(joint, base, member);
                }
            }
            self.unknown_quantity(&name, base, at);
            return None;
        };
        let mut uses = frame.uses;
        let still = matches!(quantity, FrameQuantity::Position | FrameQuantity::Rotation | FrameQuantity::Pose);
        if !(still && frame.frame.body == BodyRef::Ground) {
            uses.add(*class, text, at);
        }
        let node = ExprNode::OfFrame(frame.frame, *quantity);
        Some(Meaning::Value(Typed::leaf(node, ty.clone(), at).with(uses)))
    }

    /// The implicit joint of a body with absolute coordinates, if `frame` is that body's own.
    pub(in crate::model) fn absolute(&self, frame: &FrameValue) -> Option<JointId> {
        self.own_joint(frame.frame.body).filter(|_| frame.frame.steps.is_empty())
    }

    fn unknown_quantity(&mut self, name: &str, base: &Expr, at: Span) {
        let message = format!("a frame has no `{name}`");
        let instead = match name {
            "x" | "y" | "z" => format!("position.{name}"),
            "linear_velocity" => "velocity".into(),
            "linear_acceleration" => "acceleration".into(),
            "omega" | "angular" => "angular_velocity".into(),
            "orientation" | "quaternion" | "attitude" => "rotation".into(),
            _ => {
                let names = || QUANTITIES.iter().map(|q| q.0).chain(["jacobian"]);
                let list: Vec<&str> = names().collect();
                let help = format!("it has `{}`", list.join("`, `"));
                return self.report.unknown(at, message, name, names(), Some(help));
            }
        };
        self.report.help(at, message, format!("write `{}.{instead}`", source_text(base)));
    }

    fn force_member(&mut self, force: ForceId, base: &Expr, member: &Ident) -> Option<Meaning> {
        if member != "power" {
            self.report.unknown(
                member.span(),
                format!("a force has no `{member}`"),
                &member.to_string(),
                ["power"],
                Some("it has `power`".into()),
            );
            return None;
        }
        let uses = Uses::of(Class::Load, format!("{}.power", source_text(base)), member.span());
        let value = Typed::leaf(ExprNode::Power(force), Type::Scalar, member.span());
        Some(Meaning::Value(value.with(uses)))
    }

    fn constraint_member(&mut self, constraint: ConstraintId, base: &Expr, member: &Ident) -> Option<Meaning> {
        let at = member.span();
        if member != "multiplier" {
            let (message, has) = (format!("a constraint has no `{member}`"), "it has `multiplier`");
            self.report.unknown(at, message, &member.to_string(), ["multiplier"], Some(has.into()));
            return None;
        }
        let uses = Uses::of(Class::Load, format!("{}.multiplier", source_text(base)), at);
        let value = Typed::leaf(ExprNode::Multiplier(constraint), Type::Scalar, at);
        Some(Meaning::Value(value.with(uses)))
    }

    fn value_member(&mut self, value: Typed, member: &Ident) -> Option<Meaning> {
        let name = member.to_string();
        if let Some(moving) = self.centre_member(&value, member) {
            return Some(Meaning::Value(moving));
        }
        if let (Some(index), Some(vector)) =
            (["x", "y", "z"].iter().position(|known| *known == name), convert(&value, &Type::Vec3))
        {
            return Some(Meaning::Value(Typed {
                expr: component_of(&vector.expr, index)?,
                uses: value.uses,
                depth: vector.depth.saturating_add(1),
            }));
        }
        let offered: &[&str] = match &value.expr.ty {
            Type::Vec3 if is_centre_of_mass(&value) => &["x", "y", "z", "position", "velocity", "acceleration"],
            Type::Vec3 => &["x", "y", "z"],
            Type::Pose => &["position", "rotation"],
            Type::Twist => &["linear", "angular"],
            Type::Wrench => &["force", "moment"],
            _ => &[],
        };
        let at = member.span();
        let node = match (&*value.expr.node, name.as_str()) {
            (ExprNode::OfFrame(frame, FrameQuantity::Pose), "position") => {
                ExprNode::OfFrame(frame.clone(), FrameQuantity::Position)
            }
            (ExprNode::OfFrame(frame, FrameQuantity::Pose), "rotation") => {
                let node = ExprNode::OfFrame(frame.clone(), FrameQuantity::Rotation);
                let ty = Type::Rotation;
                return Some(Meaning::Value(Typed::leaf(node, ty, at).with(value.uses)));
            }
            (ExprNode::Pose(position, _), "position") => {
                return Some(Meaning::Value(Typed { expr: position.clone(), ..value }));
            }
            (ExprNode::Pose(_, orientation), "rotation") => {
                return Some(Meaning::Value(Typed { expr: orientation.clone(), ..value }));
            }
            (_, "linear" | "force") if offered.contains(&name.as_str()) => ExprNode::Linear(value.expr.clone()),
            (_, "angular" | "moment") if offered.contains(&name.as_str()) => ExprNode::Angular(value.expr.clone()),
            _ => {
                let help = match offered {
                    [] => None,
                    some => Some(format!("it has `{}`", some.join("`, `"))),
                };
                self.report.unknown(
                    at,
                    format!("{} has no `{name}`", type_text(&value.expr.ty)),
                    &name,
                    offered.iter().copied(),
                    help,
                );
                return None;
            }
        };
        self.build(node, Type::Vec3, at, &[&value]).map(Meaning::Value)
    }
}
