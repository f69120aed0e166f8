//! Stage `model`: joints.
//!
//! In: `joint name: Kind { .. }`. Out: kind with its axes, frames on both sides, armature; checked at the declared
//! defaults.

use proc_macro2::{Ident, Span};
use syn::Expr;
use syn::spanned::Spanned;

use crate::diagnostics::nearest;
use crate::model::checker::{Checker, Context, Lazy};
use crate::model::checks::evaluate::dot;
use crate::model::docs;
use crate::model::expand::root;
use crate::model::names::{JOINT_KINDS, Shape};
use crate::model::typed::{Allowed, FrameValue, Typed};
use crate::model::types::{BodyRef, Joint, JointId, JointKind, Orientation, Type};
use crate::syntax::tree::{self, ItemKind};

use super::fields::{Known, field};

/// How far from perpendicular the axes of a universal joint may be: the sine of the angle that is missing.
const PERPENDICULAR: f64 = 1e-6;

/// Sequences of angles that other tools know.
const SEQUENCES: [&str; 2] = ["Quaternion", "RollPitchYaw"];

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn finish_joint(&mut self, id: JointId) -> Option<Joint> {
        let slot = self.joints.get(id.0)?;
        let (item, scope, place, shape) = (slot.item, slot.scope, slot.place.clone(), slot.shape);
        let ItemKind::Joint { name, kind, fields } = &item.kind else {
            return self.implicit(id);
        };
        let attributes = docs::attributes(&item.attrs, self.report);
        self.refuse_waiver(&attributes);
        let frames = self.joint_frames(id, name.span());
        let Some(shape) = shape else {
            self.unknown_kind(kind);
            return None;
        };
        let owner = format!("the {} joint `{name}`", shape.name());
        self.check_fields(&owner, name, fields, &known(shape));
        let context = root(scope);
        let joint_kind = self.joint_kind(shape, fields, context);
        let armature = match field(fields, "armature").filter(|_| shape.freedoms() == 1) {
            Some(expr) => self
                .scalar(expr, context, Allowed::Parameters)
                .and_then(|value| self.not_negative(&value, "an armature"))
                .map(|value| Some(value.expr)),
            None => Some(None),
        };
        let [parent, child] = frames?;
        // With a body as its parent it may close a loop.
        if child.frame.body == BodyRef::Ground && parent.frame.body == BodyRef::Ground {
            let message = format!("the child of the joint `{name}` is the ground, which cannot move");
            self.report.help(child.frame.span, message, "one side must be a body");
            return None;
        }
        if child.frame.body == parent.frame.body {
            let message = format!("the joint `{name}` joins a body to itself");
            self.report.error(child.frame.span, message);
            return None;
        }
        Some(Joint {
            place,
            kind: joint_kind?,
            parent: parent.frame,
            child: child.frame,
            armature: armature?,
            docs: attributes.docs,
            span: name.span(),
        })
    }

    /// The joint of a body with absolute coordinates.
    fn implicit(&mut self, id: JointId) -> Option<Joint> {
        let [parent, child] = self.joint_frames(id, Span::call_site())?;
        let slot = self.joints.get(id.0)?;
        let Some(Shape::Free(orientation)) = slot.shape else {
            return None;
        };
        Some(Joint {
            place: slot.place.clone(),
            kind: JointKind::Free(orientation),
            parent: parent.frame,
            child: child.frame,
            armature: None,
            docs: docs::docs(&slot.item.attrs),
            span: slot.place.field.span(),
        })
    }

    /// The frames of a joint, worked out when they are first asked for.
    pub(in crate::model) fn joint_frames(&mut self, id: JointId, site: Span) -> Option<[FrameValue; 2]> {
        let slot = self.joints.get_mut(id.0)?;
        match &slot.frames {
            Lazy::Done(frames) => return frames.clone(),
            Lazy::Working => {
                let message = format!("the frames of `{}` depend on themselves", slot.place.field);
                self.report.error(site, message);
                return None;
            }
            Lazy::Waiting => slot.frames = Lazy::Working,
        }
        let (item, context) = (slot.item, root(slot.scope));
        let frames = match &item.kind {
            ItemKind::Joint { fields, .. } => {
                let mut side = |name| {
                    let expr = field(fields, name)?;
                    self.frame(expr, context)
                };
                let (parent, child) = (side("parent"), side("child"));
                parent.zip(child).map(|(parent, child)| [parent, child])
            }
            _ => None,
        };
        if let Some(slot) = self.joints.get_mut(id.0) {
            slot.frames = Lazy::Done(frames.clone());
        }
        frames
    }

    fn unknown_kind(&mut self, kind: &Ident) {
        let name = kind.to_string();
        if name == tree::UNREADABLE {
            return self.report.silent();
        }
        let instead = elsewhere(&name);
        let message = format!("unknown kind of joint `{name}`");
        if let Some(instead) = instead {
            let help = format!("write `{instead}`");
            return self.report.help(kind.span(), message, help);
        }
        let kinds: Vec<&str> = JOINT_KINDS.iter().map(|(kind, _)| *kind).collect();
        let list = format!("kinds are `{}`", kinds.join("`, `"));
        self.report.unknown(kind.span(), message, &name, kinds, Some(list));
    }

    pub(in crate::model) fn joint_kind(
        &mut self,
        shape: Shape,
        fields: &tree::Fields,
        context: Context<'a>,
    ) -> Option<JointKind> {
        if let Some(expr) = field(fields, "coordinates") {
            self.orientation(shape, expr);
        }
        let axis = match (shape, field(fields, "axis")) {
            (Shape::Fixed | Shape::Universal | Shape::Ball(_) | Shape::Free(_), _) => None,
            (_, Some(expr)) => self.axis(expr, context).map(|axis| axis.expr),
            (_, None) => None,
        };
        Some(match shape {
            Shape::Fixed => JointKind::Fixed,
            Shape::Revolute => JointKind::Revolute { axis: axis? },
            Shape::Prismatic => JointKind::Prismatic { axis: axis? },
            Shape::Cylindrical => JointKind::Cylindrical { axis: axis? },
            Shape::Planar => JointKind::Planar { axis: axis? },
            Shape::Screw => {
                let pitch = field(fields, "pitch").and_then(|expr| {
                    let pitch = self.scalar(expr, context, Allowed::Parameters)?;
                    self.finite(&pitch)?;
                    Some(pitch.expr)
                });
                JointKind::Screw { axis: axis?, pitch: pitch? }
            }
            Shape::Universal => {
                let axes = field(fields, "axes")?;
                JointKind::Universal { axes: Box::new(self.universal_axes(axes, context)?) }
            }
            Shape::Ball(orientation) => JointKind::Ball(orientation),
            Shape::Free(orientation) => JointKind::Free(orientation),
        })
    }

    fn universal_axes(&mut self, expr: &Expr, context: Context<'a>) -> Option<[crate::model::types::Expr; 2]> {
        let axes = match expr {
            // Element by element, so that errors stand at one of them.
            Expr::Array(array) => {
                let list: Vec<Option<Typed>> = array.elems.iter().map(|e| self.axis(e, context)).collect();
                if list.len() != 2 {
                    let message = format!("a universal joint has 2 axes, found {}", list.len());
                    self.report.error(expr.span(), message);
                    return None;
                }
                let list: Vec<Typed> = list.into_iter().collect::<Option<_>>()?;
                list.into_iter().map(|axis| axis.expr).collect::<Vec<_>>()
            }
            _ => {
                let ty = Type::Array(Box::new(Type::Vec3), 2);
                let pair = self.typed(expr, context, &ty, Allowed::Parameters)?;
                self.finite(&pair)?;
                let element = |k| crate::model::expressions::element_of(&pair.expr, k);
                vec![element(0)?, element(1)?]
            }
        };
        let [first, second] = <[crate::model::types::Expr; 2]>::try_from(axes).ok()?;
        let (a, b) = (self.evaluator.vector(&first)?, self.evaluator.vector(&second)?);
        if dot(a, a) == 0.0 || dot(b, b) == 0.0 {
            self.report.error(expr.span(), "an axis must not be zero");
            return None;
        }
        if dot(a, b).abs() > PERPENDICULAR * (dot(a, a) * dot(b, b)).sqrt() {
            self.report.help(
                expr.span(),
                "the two axes of a universal joint must be perpendicular",
                "tilted axes are two revolute joints with a massless body between them",
            );
            return None;
        }
        Some([first, second])
    }

    /// `coordinates:` of Ball and Free; the shape has read what it needs.
    fn orientation(&mut self, shape: Shape, expr: &Expr) {
        if !matches!(shape, Shape::Ball(_) | Shape::Free(_)) {
            return;
        }
        let name = match expr {
            Expr::Verbatim(_) => return self.report.silent(),
            Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
            _ => None,
        };
        let name = name.unwrap_or_default();
        if Orientation::named(&name).is_some() {
            return;
        }
        self.report.unknown(
            expr.span(),
            "unknown kind of coordinates",
            &name,
            SEQUENCES,
            Some("there are `Quaternion` and `RollPitchYaw` so far".into()),
        );
    }
}

impl Orientation {
    pub(in crate::model) fn named(name: &str) -> Option<Orientation> {
        match name {
            "Quaternion" => Some(Orientation::Quaternion),
            "RollPitchYaw" => Some(Orientation::RollPitchYaw),
            _ => None,
        }
    }
}

/// What other tools call a kind of joint.
fn elsewhere(name: &str) -> Option<&'static str> {
    Some(match name {
        "Hinge" | "Pin" | "Rotary" | "Rotational" | "Continuous" => "Revolute",
        "Slider" | "Sliding" | "Linear" | "Translational" => "Prismatic",
        "Spherical" => "Ball",
        "Weld" | "Rigid" => "Fixed",
        "Floating" | "SixDof" | "FreeJoint" => "Free",
        "Cardan" | "Hooke" => "Universal",
        "Helical" => "Screw",
        _ => return None,
    })
}

/// The shape of a joint whose kind is none: of the one that was probably meant.
pub(in crate::model) fn meant(kind: &str, fields: &tree::Fields) -> Shape {
    let near = || nearest(kind, JOINT_KINDS.iter().map(|(kind, _)| *kind));
    let name = elsewhere(kind).or_else(near).unwrap_or("Revolute");
    Shape::read(name, fields).unwrap_or(Shape::Revolute)
}

/// The names of the fields that a joint has.
pub(in crate::model) fn fields_of(shape: Shape) -> Vec<&'static str> {
    let known = known(shape);
    known.required.iter().chain(known.optional).copied().collect()
}

fn known(shape: Shape) -> Known<'static> {
    let required: &[&str] = match shape {
        Shape::Fixed | Shape::Ball(_) | Shape::Free(_) => &["parent", "child"],
        Shape::Screw => &["parent", "child", "axis", "pitch"],
        Shape::Universal => &["parent", "child", "axes"],
        _ => &["parent", "child", "axis"],
    };
    let optional: &[&str] = match shape {
        Shape::Ball(_) | Shape::Free(_) => &["coordinates"],
        _ if shape.freedoms() == 1 => &["armature"],
        _ => &[],
    };
    Known { required, optional }
}
