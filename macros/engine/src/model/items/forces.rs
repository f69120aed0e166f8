//! Stage `model`: forces.
//!
//! In: `force name: Kind { .. }`. Out: efforts on coordinates, springs and dampers on coordinates or along lines, forces
//! and torques at frames.

use proc_macro2::Ident;
use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, Context, Meaning, Slot};
use crate::model::docs;
use crate::model::expand::root;
use crate::model::expressions::{component_of, element_of, source_text};
use crate::model::joint_kinds::JointKind;
use crate::model::typed::{Allowed, Typed, number};
use crate::model::types::Expr as Checked;
use crate::model::types::{Force, ForceKind, Frame, JointId, Type};
use crate::syntax::tree::{self, ItemKind};

use super::fields::{Known, field};

const KINDS: [&str; 7] = ["Effort", "Spring", "Damper", "SpringDamper", "Force", "Torque", "Contact"];

const EFFORT: Known<'static> = Known { required: &["joint", "value"], optional: &[] };

const AT_FRAME: Known<'static> = Known { required: &["at", "value", "axes"], optional: &[] };

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn finish_force(&mut self, slot: &Slot<'a>) -> Option<Force> {
        let ItemKind::Force { name, kind, fields } = &slot.item.kind else {
            return None;
        };
        let attributes = docs::attributes(&slot.item.attrs, self.report);
        self.refuse_waiver(&attributes);
        self.refuse_cut(&attributes);
        let context = root(slot.scope);
        let text = kind.to_string();
        let owner = format!("the {text} `{name}`");
        let force = match text.as_str() {
            "Effort" => {
                self.check_fields(&owner, name, fields, &EFFORT);
                self.effort(fields, context)
            }
            "Force" | "Torque" => {
                self.check_fields(&owner, name, fields, &AT_FRAME);
                self.at_frame(&text, fields, context)
            }
            "Spring" | "Damper" | "SpringDamper" => self.spring(&text, &owner, name, fields, context),
            tree::UNREADABLE => {
                self.report.silent();
                None
            }
            "Motor" | "Actuator" | "Friction" => {
                let message = format!("unknown kind of force `{text}`");
                self.report.help(kind.span(), message, "write `Effort`");
                None
            }
            "Gravity" => {
                let message = "unknown kind of force `Gravity`";
                self.report.help(kind.span(), message, "gravity acts on all bodies: `world { gravity: -9.81 * Z }`");
                None
            }
            _ => {
                self.report.unknown(
                    kind.span(),
                    format!("unknown kind of force `{text}`"),
                    &text,
                    KINDS,
                    Some(format!("kinds are `{}`", KINDS.join("`, `"))),
                );
                None
            }
        };
        Some(Force { place: slot.place.clone(), kind: force?, docs: attributes.docs, span: name.span() })
    }

    fn effort(&mut self, fields: &tree::Fields, context: Context<'a>) -> Option<ForceKind> {
        let target = field(fields, "joint").and_then(|expr| self.target(expr, context));
        let value = field(fields, "value");
        let Some((joint, kind, index)) = target else {
            // Mistakes in the value are reported all the same.
            if let Some(expr) = value {
                self.value(expr, context);
            }
            return None;
        };
        let value = value?;
        let freedoms = kind.freedoms();
        // Along the axes of a joint an effort acts between the two bodies, be the joint a coordinate or not; efforts on
        // angles in sequence, and on what is free, have no such meaning.
        if kind.has_angles() || kind.is_free() {
            self.uses_coordinates(joint, field(fields, "joint").map_or(fields.span, Spanned::span));
        }
        if freedoms == 0 {
            let at = field(fields, "joint").map_or(fields.span, Spanned::span);
            self.report.error(at, "a fixed joint has no coordinate to act on");
            return None;
        }
        if let Some(index) = index {
            let value = self.scalar(value, context, Allowed::Forces)?;
            let zero = number(0.0, value.expr.span);
            let mut values = vec![zero; freedoms];
            values[index] = value.expr;
            return Some(ForceKind::Effort { joint, values });
        }
        let values = match freedoms {
            1 => vec![self.scalar(value, context, Allowed::Forces)?.expr],
            3 => {
                let value = self.vector(value, context, Allowed::Forces)?;
                elements(&value, 3)?
            }
            _ => {
                let ty = Type::Array(Box::new(Type::Scalar), freedoms);
                let value = self.typed(value, context, &ty, Allowed::Forces)?;
                elements(&value, freedoms)?
            }
        };
        Some(ForceKind::Effort { joint, values })
    }

    /// A joint, or one coordinate of it.
    fn target(&mut self, expr: &Expr, context: Context<'a>) -> Option<(JointId, &'static JointKind, Option<usize>)> {
        let (joint, index) = match self.meaning(expr, context)? {
            Meaning::Joint(joint) => (joint, None),
            Meaning::Coordinate(joint, index) => (joint, Some(index)),
            _ => {
                self.report.help(
                    expr.span(),
                    "expected a joint",
                    "write a joint's name, or one coordinate such as `gimbal.first`",
                );
                return None;
            }
        };
        let kind = self.joints[joint].kind;
        if kind.is_none() {
            self.report.silent();
        }
        Some((joint, kind?, index))
    }

    fn at_frame(&mut self, kind: &str, fields: &tree::Fields, context: Context<'a>) -> Option<ForceKind> {
        let at = field(fields, "at").and_then(|expr| self.frame(expr, context));
        let axes = field(fields, "axes").and_then(|expr| self.frame(expr, context));
        let value = field(fields, "value").and_then(|expr| self.vector(expr, context, Allowed::Forces));
        let (at, axes, value) = (at?.frame, axes?.frame, value?.expr);
        Some(match kind {
            "Force" => ForceKind::Force { at, value, axes },
            _ => ForceKind::Torque { at, value, axes },
        })
    }

    fn spring(
        &mut self,
        kind: &str,
        owner: &str,
        name: &Ident,
        fields: &tree::Fields,
        context: Context<'a>,
    ) -> Option<ForceKind> {
        let on_joint = field(fields, "joint");
        let between = field(fields, "between");
        let known = match (kind, on_joint.is_some()) {
            ("Spring", true) => (&["joint", "stiffness"][..], &["rest"][..]),
            ("Spring", false) => (&["between", "stiffness", "length"][..], &[][..]),
            ("Damper", true) => (&["joint", "damping"][..], &[][..]),
            ("Damper", false) => (&["between", "damping"][..], &[][..]),
            (_, true) => (&["joint", "stiffness", "damping"][..], &["rest"][..]),
            (_, false) => (&["between", "stiffness", "damping", "length"][..], &[][..]),
        };
        if let (Some(_), Some(second)) = (on_joint, between) {
            self.report.error(second.span(), "a spring or damper acts on a `joint` or `between` two frames, not both");
            return None;
        }
        if on_joint.is_none() && between.is_none() && !fields.broken {
            self.report.help(
                name.span(),
                format!("{owner} says neither `joint` nor `between`"),
                "write `joint: <joint>` or `between: [<frame>, <frame>]`",
            );
            return None;
        }
        let known = Known { required: known.0, optional: known.1 };
        self.check_fields(owner, name, fields, &known);
        let mut scalar = |name: &str, allowed| match field(fields, name) {
            Some(expr) => self.scalar(expr, context, allowed).map(|value| Some(value.expr)),
            None => Some(None),
        };
        let stiffness = scalar("stiffness", Allowed::Springs);
        let damping = scalar("damping", Allowed::Forces);
        let rest = scalar("rest", Allowed::Springs);
        let length = scalar("length", Allowed::Springs);
        if let Some(expr) = on_joint {
            let (joint, coordinate) = self.spring_target(expr, context)?;
            return Some(ForceKind::JointSpring {
                joint,
                coordinate,
                stiffness: stiffness?,
                damping: damping?,
                rest: rest?,
            });
        }
        let between = self.between(between?, context)?;
        Some(ForceKind::LineSpring {
            between: Box::new(between),
            stiffness: stiffness?,
            damping: damping?,
            length: length?,
        })
    }

    /// One scalar coordinate.
    fn spring_target(&mut self, expr: &Expr, context: Context<'a>) -> Option<(JointId, usize)> {
        let (joint, kind, index) = self.target(expr, context)?;
        // The place of what is free is a number in each direction, its orientation none.
        if kind.is_free() && kind.has_quaternion() && index.is_none() {
            self.report.help(
                expr.span(),
                "springs and dampers need coordinates that are numbers, and this joint has quaternions",
                "take one of its `x`, `y`, `z`, write `coordinates: RollPitchYaw` on the joint, or `between: [..]` here",
            );
            return None;
        }
        if let Some(index) = index {
            self.uses_coordinates(joint, expr.span());
            return Some((joint, index));
        }
        if kind.freedoms() == 1 {
            self.uses_coordinates(joint, expr.span());
            return Some((joint, 0));
        }
        let text = source_text(expr);
        let help = match kind.coordinates()[..] {
            [first, ..] => format!("write `joint: {text}.{first}`"),
            [] if kind.has_quaternion() => "an `Effort` with a Vec3 can act on it".to_string(),
            [] => "write another joint".to_string(),
        };
        self.report.help(
            expr.span(),
            format!("a spring or damper acts on one coordinate: `{text}` is a joint of kind {}", kind.name),
            help,
        );
        None
    }

    pub(in crate::model) fn between(&mut self, expr: &Expr, context: Context<'a>) -> Option<[Frame; 2]> {
        let frames: Vec<Option<Frame>> = match expr {
            Expr::Array(array) => {
                let frames = array.elems.iter();
                frames.map(|e| self.frame(e, context).map(|f| f.frame)).collect()
            }
            Expr::Verbatim(_) => {
                self.report.silent();
                return None;
            }
            _ => Vec::new(),
        };
        if frames.len() != 2 {
            self.report.help(expr.span(), "expected two frames", "write `between: [a.at(p), b]`");
            return None;
        }
        let frames: Vec<Frame> = frames.into_iter().collect::<Option<_>>()?;
        <[Frame; 2]>::try_from(frames).ok()
    }
}

fn elements(value: &Typed, count: usize) -> Option<Vec<Checked>> {
    (0..count)
        .map(|k| match value.expr.ty {
            Type::Vec3 => component_of(&value.expr, k),
            _ => element_of(&value.expr, k),
        })
        .collect()
}
