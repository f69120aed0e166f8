//! Stage `model`: what expressions may ask of a joint.
//!
//! In: `elbow.rate`, `gimbal.first`, `ball.angular_velocity`. Out: coordinates, their rates, accelerations and efforts,
//! and reactions, as typed nodes.

use proc_macro2::{Ident, Span};
use syn::Expr;

use crate::model::checker::{Checker, Meaning};
use crate::model::joint_kinds::JointKind;
use crate::model::typed::{Class, Typed, Uses};
use crate::model::types::{BodyRef, ExprNode, JointId, Order, Type};

use super::paths::plain_frame;
use super::{source_text, span};

/// Members of joints and coordinates beside the coordinates' own names.
const OF_COORDINATE: [&str; 3] = ["rate", "accel", "effort"];

impl Checker<'_, '_> {
    /// Remembers where a coordinate is used: which joints have some is known when the tree is.
    pub(in crate::model) fn uses_coordinates(&mut self, joint: JointId, at: Span) {
        self.coordinate_uses.push((joint, at));
    }

    pub(in crate::model) fn joint_kind(&mut self, joint: JointId) -> Option<&'static JointKind> {
        let kind = self.joints[joint].kind;
        if kind.is_none() {
            // An unknown kind: reported with the joint itself.
            self.report.silent();
        }
        kind
    }

    /// A bare joint of one coordinate stands for that coordinate.
    pub(super) fn joint_value(&mut self, joint: JointId, expr: &Expr) -> Option<Typed> {
        let kind = self.joint_kind(joint)?;
        if kind.freedoms() == 1 {
            return self.coordinate(joint, 0, expr);
        }
        let text = source_text(expr);
        let names = offers(kind, &text);
        self.report.help(
            span(expr),
            format!("expected a value, found a joint of kind {}", kind.name),
            format!("take one of {names}"),
        );
        None
    }

    /// The value of a coordinate.
    pub(super) fn coordinate(&mut self, joint: JointId, index: usize, expr: &Expr) -> Option<Typed> {
        self.joint_kind(joint)?;
        let at = span(expr);
        let uses = Uses::of(Class::Position, source_text(expr), at);
        self.uses_coordinates(joint, at);
        let node = ExprNode::Coordinate { joint, index, order: Order::Position };
        Some(Typed::leaf(node, Type::Scalar, at).with(uses))
    }

    /// `.rate`, `.accel`, `.effort` of a coordinate.
    pub(super) fn coordinate_member(
        &mut self,
        joint: JointId,
        index: usize,
        base: &Expr,
        member: &Ident,
    ) -> Option<Meaning> {
        let name = member.to_string();
        let text = format!("{}.{name}", source_text(base));
        self.uses_coordinates(joint, member.span());
        let (node, class) = match name.as_str() {
            "rate" => (coordinate(joint, index, Order::Rate), Class::State),
            "accel" => (coordinate(joint, index, Order::Acceleration), Class::Acceleration),
            "effort" => (ExprNode::Effort { joint, index }, Class::Load),
            _ => {
                self.report.unknown(
                    member.span(),
                    format!("a coordinate has no `{name}`"),
                    &name,
                    OF_COORDINATE,
                    Some("it has `rate`, `accel`, `effort`".into()),
                );
                return None;
            }
        };
        let uses = Uses::of(class, text, member.span());
        Some(Meaning::Value(Typed::leaf(node, Type::Scalar, member.span()).with(uses)))
    }

    pub(super) fn joint_member(&mut self, joint: JointId, base: &Expr, member: &Ident) -> Option<Meaning> {
        let kind = self.joint_kind(joint)?;
        let name = member.to_string();
        let coordinates = kind.coordinates();
        if let Some(index) = coordinates.iter().position(|known| *known == name) {
            return Some(Meaning::Coordinate(joint, index));
        }
        if kind.freedoms() == 1 && OF_COORDINATE.contains(&name.as_str()) {
            return self.coordinate_member(joint, 0, base, member);
        }
        let text = format!("{}.{name}", source_text(base));
        let at = member.span();
        let rotates = kind.turns_freely();
        let angles = kind.has_angles();
        let (value, class) = match name.as_str() {
            "reaction" => {
                let axes = plain_frame(BodyRef::Ground, at);
                let node = ExprNode::Reaction { joint, axes };
                (Typed::leaf(node, Type::Wrench, at), Class::Load)
            }
            "angular_velocity" if rotates => {
                let node = ExprNode::RelativeAngularVelocity(joint);
                (Typed::leaf(node, Type::Vec3, at), Class::State)
            }
            "velocity" if kind.is_free() => {
                let node = |index| coordinate(joint, index, Order::Rate);
                (self.several(node, 0..3, at)?, Class::State)
            }
            "angular_acceleration" if rotates && !angles => {
                let node = |index| coordinate(joint, index, Order::Acceleration);
                let end = kind.freedoms();
                let value = self.several(node, end - 3..end, at)?;
                (value, Class::Acceleration)
            }
            "rates" if angles => {
                let node = |index| coordinate(joint, index, Order::Rate);
                (self.several(node, 0..kind.freedoms(), at)?, Class::State)
            }
            "effort" if kind.freedoms() > 1 => {
                let node = |index| ExprNode::Effort { joint, index };
                (self.several(node, 0..kind.freedoms(), at)?, Class::Load)
            }
            _ => {
                self.unknown_joint_member(kind, base, member);
                return None;
            }
        };
        if name != "reaction" {
            self.uses_coordinates(joint, at);
        }
        Some(Meaning::Value(value.with(Uses::of(class, text, at))))
    }

    /// Scalars of one joint together: three are a `Vec3`.
    fn several(&mut self, node: impl Fn(usize) -> ExprNode, range: std::ops::Range<usize>, at: Span) -> Option<Typed> {
        let count = range.len();
        let elements: Vec<Typed> = range.map(|index| Typed::leaf(node(index), Type::Scalar, at)).collect();
        let ty = if count == 3 { Type::Vec3 } else { Type::Array(Box::new(Type::Scalar), count) };
        self.collect(elements, ty, at)
    }

    fn unknown_joint_member(&mut self, kind: &JointKind, base: &Expr, member: &Ident) {
        let name = member.to_string();
        let text = source_text(base);
        let several = kind.freedoms() > 1 && OF_COORDINATE.contains(&name.as_str());
        let help = match kind.coordinates()[..] {
            [first, ..] if several => format!("write `{text}.{first}.{name}`"),
            [coordinate] => match name.as_str() {
                "q" | "position" | "displacement" => format!("write `{text}.{coordinate}`"),
                "v" | "velocity" | "speed" | "omega" | "angular_velocity" => format!("write `{text}.rate`"),
                "a" | "acceleration" => format!("write `{text}.accel`"),
                "torque" => format!("write `{text}.effort`"),
                _ => format!("it has {}", offers(kind, &text)),
            },
            _ if name == "rates" => format!("write `{text}.angular_velocity`"),
            _ => format!("it has {}", offers(kind, &text)),
        };
        let mut candidates: Vec<&str> = members(kind);
        if several {
            candidates.clear();
        }
        self.report.unknown(
            member.span(),
            format!("a joint of kind {} has no `{name}`", kind.name),
            &name,
            candidates,
            Some(help),
        );
    }
}

/// Names that a joint offers.
fn members(kind: &JointKind) -> Vec<&'static str> {
    let mut names = kind.coordinates();
    if kind.freedoms() == 1 {
        names.extend(OF_COORDINATE);
    }
    if kind.turns_freely() {
        names.push("angular_velocity");
    }
    names.push("reaction");
    names
}

pub(in crate::model) fn offers(kind: &JointKind, text: &str) -> String {
    let names: Vec<String> = members(kind).iter().map(|name| format!("`{text}.{name}`")).collect();
    names.join(", ")
}

fn coordinate(joint: JointId, index: usize, order: Order) -> ExprNode {
    ExprNode::Coordinate { joint, index, order }
}
