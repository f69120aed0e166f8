//! Stage `model`: `base.method(arguments)`.
//!
//! In: `.at(v)`, `.rotated(axis, angle)`, `.oriented(matrix)`, `.express(..)`. Out: frames whose steps are checked at the
//! declared defaults; vectors, Jacobians and reactions in other axes.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprMethodCall};

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::checks::evaluate::{cross, dot};
use crate::model::typed::{Allowed, Class, FrameValue, Typed, type_text};
use crate::model::types::{BodyRef, Expr as Checked, ExprNode, FrameStep, Type};

use super::coerce::{component_of, element_of};
use super::source_text;

const OF_FRAME: [&str; 4] = ["at", "rotated", "oriented", "express"];

/// rad; beyond it more than six digits of an angle are lost.
const MAX_ANGLE: f64 = 1e6;

/// How far a matrix of the user may be from orthonormal.
const ORTHONORMAL: f64 = 1e-6;

/// Chained steps of one frame.
const MAX_STEPS: usize = 64;

impl<'a> Checker<'a, '_> {
    pub(super) fn method(&mut self, call: &ExprMethodCall, context: Context<'a>) -> Option<Meaning> {
        let base = self.meaning(&call.receiver, context)?;
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match base {
            Meaning::Part(part) if self.external_of(part, &call.method).is_some() => {
                let function = self.external_of(part, &call.method)?;
                self.external_call(function, &call.method, &arguments, call.span(), context).map(Meaning::Value)
            }
            Meaning::Part(part) if self.function_of(part, &call.method).is_some() => {
                let function = self.function_of(part, &call.method)?;
                self.expanded_call(function, &call.method, &arguments, call.span(), context)
            }
            Meaning::Frame(frame) => self.frame_method(frame, call, &arguments, context),
            Meaning::Value(value) if call.method == "express" => {
                let [argument] = arguments.as_slice() else {
                    return self.arguments(&call.method, 1, arguments.len(), call.span());
                };
                self.express_value(value, argument, call, context)
            }
            other => {
                if !self.function_as_method(&call.receiver, &call.method, &arguments) {
                    let what = match &other {
                        Meaning::Value(value) => type_text(&value.expr.ty),
                        Meaning::Joint(_) => "a joint".into(),
                        Meaning::Coordinate(..) => "a coordinate".into(),
                        Meaning::Force(_) => "a force".into(),
                        Meaning::Constraint(_) => "a constraint".into(),
                        _ => "a part".into(),
                    };
                    let name = call.method.to_string();
                    let message = format!("{what} has no method `{name}`");
                    let help = match name.as_str() {
                        "to_radians" | "to_degrees" => "angles are in radians; `deg(30.0)` is thirty degrees",
                        "inverse" | "transpose" => "`frame.express(v)` is a vector in the axes of a frame",
                        _ if OF_FRAME.contains(&name.as_str()) => "frames have it: `ground`, bodies, ports",
                        _ => {
                            self.report.error(call.method.span(), message);
                            return None;
                        }
                    };
                    self.report.help(call.method.span(), message, help);
                }
                None
            }
        }
    }

    fn arguments<T>(&mut self, name: &Ident, count: usize, found: usize, at: Span) -> Option<T> {
        let plural = if count == 1 { "" } else { "s" };
        let message = format!("`{name}` takes {count} argument{plural}, found {found}");
        self.report.error(at, message);
        None
    }

    fn frame_method(
        &mut self,
        mut frame: FrameValue,
        call: &ExprMethodCall,
        arguments: &[&Expr],
        context: Context<'a>,
    ) -> Option<Meaning> {
        let name = call.method.to_string();
        let parameters = Allowed::Parameters;
        let found = arguments.len();
        let step = match (name.as_str(), arguments) {
            ("at", [offset]) => {
                let offset = self.vector(offset, context, parameters)?;
                frame.uses.merge(&offset.uses);
                self.finite(&offset)?;
                FrameStep::At(offset.expr)
            }
            ("rotated", [axis, angle]) => {
                let axis = self.axis(axis, context);
                let angle = self.scalar(angle, context, parameters);
                let (axis, angle) = (axis?, angle?);
                frame.uses.merge(&axis.uses);
                frame.uses.merge(&angle.uses);
                self.finite(&angle)?;
                self.within_turns(&angle)?;
                FrameStep::Rotated(axis.expr, angle.expr)
            }
            ("oriented", [matrix]) => {
                let matrix = self.matrix(matrix, context)?;
                frame.uses.merge(&matrix.uses);
                FrameStep::Oriented(Box::new(rows(&matrix.expr)?))
            }
            ("express", [vector]) => {
                let vector = self.expect(vector, context, &Type::Vec3)?;
                let text = format!("{}.express", source_text(&call.receiver));
                let value = self.express(frame, vector, text, call.span())?;
                return Some(Meaning::Value(value));
            }
            ("at" | "oriented" | "express", _) => {
                return self.arguments(&call.method, 1, found, call.span());
            }
            ("rotated", _) => return self.arguments(&call.method, 2, found, call.span()),
            _ => {
                self.report.unknown(
                    call.method.span(),
                    format!("a frame has no method `{name}`"),
                    &name,
                    OF_FRAME,
                    Some("it has `at`, `rotated`, `oriented`, `express`".into()),
                );
                return None;
            }
        };
        frame.frame.span = call.span();
        frame.frame.steps.push(step);
        if frame.frame.steps.len() > MAX_STEPS {
            let message = format!("a frame has at most {MAX_STEPS} steps");
            self.report.error(call.method.span(), message);
            return None;
        }
        Some(Meaning::Frame(frame))
    }

    /// Components of a world vector in the axes of a frame.
    fn express(&mut self, frame: FrameValue, vector: Typed, text: String, at: Span) -> Option<Typed> {
        let mut uses = frame.uses;
        if frame.frame.body != BodyRef::Ground {
            uses.add(Class::Position, text, at);
        } else if frame.frame.steps.is_empty() {
            return Some(vector);
        }
        let node = ExprNode::Express { frame: frame.frame, vector: vector.expr.clone() };
        let mut value = self.build(node, Type::Vec3, at, &[&vector])?;
        value.uses.merge(&uses);
        Some(value)
    }

    /// `tool.jacobian.express(tool)`, `wrist.reaction.express(hand)`.
    fn express_value(
        &mut self,
        value: Typed,
        argument: &Expr,
        call: &ExprMethodCall,
        context: Context<'a>,
    ) -> Option<Meaning> {
        let at = call.span();
        let node = match &*value.expr.node {
            ExprNode::Jacobian { frame, .. } => {
                let axes = self.frame(argument, context)?;
                ExprNode::Jacobian { frame: frame.clone(), axes: axes.frame }
            }
            ExprNode::Reaction { joint, .. } => {
                let axes = self.frame(argument, context)?;
                ExprNode::Reaction { joint: *joint, axes: axes.frame }
            }
            _ => {
                let message = format!("{} has no method `express`", type_text(&value.expr.ty));
                let help = format!("write `{}.express({})`", source_text(argument), source_text(&call.receiver));
                self.report.help(call.method.span(), message, help);
                return None;
            }
        };
        let ty = value.expr.ty.clone();
        self.build(node, ty, at, &[&value]).map(Meaning::Value)
    }

    /// A direction: a `Vec3` of parameters at most, of any length but zero.
    pub(in crate::model) fn axis(&mut self, expr: &Expr, context: Context<'a>) -> Option<Typed> {
        let axis = self.vector(expr, context, Allowed::Parameters)?;
        self.finite(&axis)?;
        let value = self.evaluator.vector(&axis.expr)?;
        if dot(value, value) == 0.0 {
            self.report.error(expr.span(), "an axis must not be zero");
            return None;
        }
        Some(axis)
    }

    /// Refuses values that are not finite at the declared defaults.
    pub(in crate::model) fn finite(&mut self, value: &Typed) -> Option<()> {
        let known = self.evaluator.value(&value.expr)?;
        if known.is_finite() {
            return Some(());
        }
        self.report.error(value.expr.span, "this value is not finite at the declared defaults");
        None
    }

    /// Refuses angles whose last digits are no small part of a turn.
    fn within_turns(&mut self, angle: &Typed) -> Option<()> {
        if self.evaluator.scalar(&angle.expr)?.abs() <= MAX_ANGLE {
            return Some(());
        }
        let message = "this angle has so many turns that what is left of the last one is lost in rounding";
        self.report.help(
            angle.expr.span,
            message,
            "leave whole turns out: angles are in radians, and `2.0 * PI` is one turn",
        );
        None
    }

    /// A rotation matrix, row by row.
    fn matrix(&mut self, expr: &Expr, context: Context<'a>) -> Option<Typed> {
        let ty = Type::Array(Box::new(Type::Vec3), 3);
        let matrix = self.typed(expr, context, &ty, Allowed::Parameters)?;
        self.finite(&matrix)?;
        let mut flat = Vec::new();
        self.evaluator.value(&matrix.expr)?.flatten(&mut flat);
        let [a, b, c, d, e, f, g, h, i] = *flat.as_slice() else {
            return None;
        };
        let (x, y, z) = ([a, b, c], [d, e, f], [g, h, i]);
        let off = |value: f64, wanted: f64| (value - wanted).abs() > ORTHONORMAL;
        let skewed = off(dot(x, x), 1.0)
            || off(dot(y, y), 1.0)
            || off(dot(z, z), 1.0)
            || off(dot(x, y), 0.0)
            || off(dot(y, z), 0.0)
            || off(dot(z, x), 0.0);
        if skewed {
            self.report.help(
                expr.span(),
                "this matrix is no rotation: its rows are not orthonormal",
                "write it row by row; its columns are the new axes",
            );
            return None;
        }
        if dot(cross(x, y), z) < 0.0 {
            let message = "this matrix is a reflection: its determinant is -1";
            self.report.error(expr.span(), message);
            return None;
        }
        Some(matrix)
    }
}

/// Elements of a checked 3x3 array.
fn rows(matrix: &Checked) -> Option<[[Checked; 3]; 3]> {
    let row = |k| {
        let row = element_of(matrix, k)?;
        Some([component_of(&row, 0)?, component_of(&row, 1)?, component_of(&row, 2)?])
    };
    Some([row(0)?, row(1)?, row(2)?])
}
