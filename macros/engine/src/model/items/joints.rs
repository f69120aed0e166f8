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
use crate::model::joint_kinds::{self, JointKind, Written};
use crate::model::typed::{Allowed, FrameValue, Typed};
use crate::model::types::{self, BodyRef, Directions, Joint, JointId, Orientation, Type};
use crate::syntax::tree::{self, ItemKind};

use super::fields::{Known, field};

/// How far from perpendicular two axes of a joint may be: the sine of the angle that is missing.
const PERPENDICULAR: f64 = 1e-6;

/// Sequences of angles that other tools know.
const SEQUENCES: [&str; 2] = ["Quaternion", "RollPitchYaw"];

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn finish_joint(&mut self, id: JointId) -> Option<Joint> {
        let slot = &self.joints[id];
        let (item, scope, place, known_kind) = (slot.item, slot.scope, slot.place.clone(), slot.kind);
        let ItemKind::Joint { name, kind: word, fields } = &item.kind else {
            return self.implicit(id);
        };
        let attributes = docs::attributes(&item.attrs, self.report);
        self.refuse_waiver(&attributes);
        let frames = self.joint_frames(id, name.span());
        let Some(kind) = known_kind else {
            self.unknown_kind(word);
            return None;
        };
        let owner = format!("the {} joint `{name}`", kind.name);
        let (required, optional) = (required(kind, fields), optional(kind, fields));
        self.check_fields(&owner, name, fields, &Known { required: &required, optional: &optional });
        let context = root(scope);
        let parts = self.joint_directions(kind, fields, context);
        let armature = match field(fields, "armature").filter(|_| kind.freedoms() == 1) {
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
        let (directions, pitch) = parts?;
        Some(Joint {
            place,
            kind,
            directions,
            pitch,
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
        let slot = &self.joints[id];
        let kind = slot.kind.filter(|kind| kind.is_free())?;
        Some(Joint {
            place: slot.place.clone(),
            kind,
            directions: Directions::Frame,
            pitch: None,
            parent: parent.frame,
            child: child.frame,
            armature: None,
            docs: docs::docs(&slot.item.attrs),
            span: slot.place.field.span(),
        })
    }

    /// The frames of a joint, worked out when they are first asked for.
    pub(in crate::model) fn joint_frames(&mut self, id: JointId, site: Span) -> Option<[FrameValue; 2]> {
        let slot = &mut self.joints[id];
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
        self.joints[id].frames = Lazy::Done(frames.clone());
        frames
    }

    fn unknown_kind(&mut self, kind: &Ident) {
        let name = kind.to_string();
        if name == tree::UNREADABLE {
            return self.report.silent();
        }
        let message = format!("unknown kind of joint `{name}`");
        if let Some(instead) = JointKind::elsewhere(&name) {
            let help = format!("write `{}`", instead.name);
            return self.report.help(kind.span(), message, help);
        }
        let kinds: Vec<&str> = JointKind::names().collect();
        let list = format!("kinds are `{}`", kinds.join("`, `"));
        self.report.unknown(kind.span(), message, &name, kinds, Some(list));
    }

    /// What gives a joint's directions, and its pitch.
    pub(in crate::model) fn joint_directions(
        &mut self,
        kind: &JointKind,
        fields: &tree::Fields,
        context: Context<'a>,
    ) -> Option<(Directions, Option<types::Expr>)> {
        if let Some(expr) = field(fields, "coordinates") {
            self.orientation(kind, expr);
        }
        let directions = match kind.written {
            Written::Frame => Some(Directions::Frame),
            Written::Axis => {
                let axis = field(fields, "axis").and_then(|expr| self.axis(expr, context));
                axis.map(|axis| Directions::Axis(axis.expr))
            }
            Written::Crossed => {
                let axes = field(fields, "axes").and_then(|expr| self.two_axes(kind, expr, context));
                axes.map(|axes| Directions::Crossed(Box::new(axes)))
            }
            Written::Slot => self.slot(kind, fields, context).map(|axes| Directions::Slot(Box::new(axes))),
            Written::Plane => match (field(fields, "axis"), field(fields, "axes")) {
                (Some(_), Some(axes)) => {
                    let message = format!("a {} joint has `axis` or `axes`, not both", kind.word);
                    self.report.help(axes.span(), message, "`axes` are in the plane, `axis` is across it");
                    None
                }
                (axis, None) => axis.and_then(|expr| self.axis(expr, context)).map(|axis| Directions::Axis(axis.expr)),
                (None, Some(expr)) => {
                    let axes = self.two_axes(kind, expr, context);
                    axes.map(|axes| Directions::Plane(Box::new(axes)))
                }
            },
        };
        let pitch = match field(fields, "pitch").filter(|_| kind.has_pitch) {
            Some(expr) => {
                let pitch = self.scalar(expr, context, Allowed::Parameters);
                pitch.filter(|pitch| self.finite(pitch).is_some()).map(|pitch| Some(pitch.expr))
            }
            None => (!kind.has_pitch).then_some(None),
        };
        Some((directions?, pitch?))
    }

    /// `axes: [a, b]`
    fn two_axes(&mut self, kind: &JointKind, expr: &Expr, context: Context<'a>) -> Option<[types::Expr; 2]> {
        let axes = match expr {
            // Element by element, so that errors stand at one of them.
            Expr::Array(array) => {
                let list: Vec<Option<Typed>> = array.elems.iter().map(|e| self.axis(e, context)).collect();
                if list.len() != 2 {
                    let message = format!("a {} joint has 2 axes, found {}", kind.word, list.len());
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
        let axes = <[types::Expr; 2]>::try_from(axes).ok()?;
        let help = match kind.written {
            Written::Plane => "take the second across the first: both lie in the plane in which the joint slides",
            Written::Crossed | Written::Slot | Written::Axis | Written::Frame => {
                "tilted axes are two revolute joints with a massless body between them"
            }
        };
        if self.cosine(&axes, expr)?.abs() > PERPENDICULAR {
            let message = format!("the two axes of a {} joint must be perpendicular", kind.word);
            self.report.help(expr.span(), message, help);
            return None;
        }
        Some(axes)
    }

    /// `axis: a, slide: b`
    fn slot(&mut self, kind: &JointKind, fields: &tree::Fields, context: Context<'a>) -> Option<[types::Expr; 2]> {
        let mut direction = |name| {
            let expr = field(fields, name)?;
            self.axis(expr, context).map(|axis| axis.expr)
        };
        let (axis, slide) = (direction("axis"), direction("slide"));
        let (axes, site) = ([axis?, slide?], field(fields, "slide")?);
        let cosine = self.cosine(&axes, site)?.abs();
        if cosine <= PERPENDICULAR {
            return Some(axes);
        }
        let (message, help) = if cosine >= 1.0 - PERPENDICULAR {
            ("slides along the axis that it turns about", "that is a `Cylindrical` joint: write it with `axis` alone")
        } else {
            (
                "must slide perpendicular to its axis",
                "a tilted axis is a prismatic and a revolute joint with a massless body between them",
            )
        };
        self.report.help(site.span(), format!("a {} joint {message}", kind.word), help);
        None
    }

    /// Of the angle between two axes, at the declared defaults.
    fn cosine(&mut self, [first, second]: &[types::Expr; 2], site: &Expr) -> Option<f64> {
        let (a, b) = (self.evaluator.vector(first)?, self.evaluator.vector(second)?);
        if dot(a, a) == 0.0 || dot(b, b) == 0.0 {
            self.report.error(site.span(), "an axis must not be zero");
            return None;
        }
        Some(dot(a, b) / (dot(a, a) * dot(b, b)).sqrt())
    }

    /// `coordinates:` of Ball and Free; the kind has read what it needs.
    fn orientation(&mut self, kind: &JointKind, expr: &Expr) {
        if !kind.turns_freely() {
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

/// The kind of a joint whose kind is none: the one that was probably meant.
pub(in crate::model) fn meant(word: &str, fields: &tree::Fields) -> &'static JointKind {
    let near = || nearest(word, JointKind::names());
    let name = JointKind::elsewhere(word).map(|kind| kind.name).or_else(near);
    name.and_then(|name| JointKind::read(name, fields)).unwrap_or(&joint_kinds::REVOLUTE)
}

/// The names of the fields that a joint has.
pub(in crate::model) fn fields_of(kind: &JointKind, given: &tree::Fields) -> Vec<&'static str> {
    [required(kind, given), optional(kind, given)].concat()
}

/// `axis`, unless what may stand in its place is given.
fn required(kind: &JointKind, given: &tree::Fields) -> Vec<&'static str> {
    let pitch: &[&str] = if kind.has_pitch { &["pitch"] } else { &[] };
    let instead = kind.written.instead();
    let axes = if instead.iter().any(|name| field(given, name).is_some()) { instead } else { kind.written.fields() };
    [&["parent", "child"], axes, pitch].concat()
}

fn optional(kind: &JointKind, given: &tree::Fields) -> Vec<&'static str> {
    let required = required(kind, given);
    let others = [kind.written.fields(), kind.written.instead()].concat();
    let mut optional: Vec<&str> = others.into_iter().filter(|name| !required.contains(name)).collect();
    if kind.turns_freely() {
        optional.push("coordinates");
    } else if kind.freedoms() == 1 {
        optional.push("armature");
    }
    optional
}
