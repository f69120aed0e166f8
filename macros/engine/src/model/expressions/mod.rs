//! Stage `model`: expressions of the user, from syntax to types.
//!
//! In: `syn` expressions and the scope they stand in. Out: typed expressions with what they depend on; `None` where an
//! error has been reported, so that one mistake is reported once.

mod arrays;
pub(super) mod bodies;
mod broadcast;
mod calls;
mod coerce;
mod externals;
pub(super) mod formulas;
mod functions;
mod joints;
mod manipulate;
mod members;
mod methods;
mod operators;
mod paths;
mod tables;
mod text;
mod unknowns;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, Lit};

use super::checker::{Checker, Context, Meaning};
use super::typed::{Allowed, FrameValue, Typed, new_expr, type_text};
use super::types::{ExprNode, Type};

pub(super) use coerce::{component_of, element_of};
pub(super) use text::source_text;

/// Bound on the nesting of one expression with the `let`s that it needs first.
const MAX_NESTING: usize = 80;

/// Bound on the height of a typed expression, `let`s included.
const MAX_HEIGHT: u16 = 400;

/// The tokens of an expression.
pub(super) fn span(expr: &Expr) -> Span {
    expr.span()
}

impl<'a> Checker<'a, '_> {
    /// What `expr` means, before it is asked for a value.
    pub(super) fn meaning(&mut self, expr: &Expr, context: Context<'a>) -> Option<Meaning> {
        if self.depth >= MAX_NESTING {
            self.report.help(
                span(expr),
                "this expression is nested too deeply",
                "name a part of it with `let`, above its use",
            );
            return None;
        }
        let Some(fuel) = self.fuel.checked_sub(1) else {
            // Said once, with the last drop.
            self.report.silent();
            return None;
        };
        self.fuel = fuel;
        if fuel == 0 {
            self.report.help(
                span(expr),
                "this model is too large once all parts are expanded",
                "write fewer or smaller parts, and name what they share with `let`",
            );
            return None;
        }
        self.depth += 1;
        let meaning = self.meaning_of(expr, context);
        self.depth -= 1;
        meaning
    }

    fn meaning_of(&mut self, expr: &Expr, context: Context<'a>) -> Option<Meaning> {
        match expr {
            Expr::Lit(literal) => self.literal(literal).map(Meaning::Value),
            Expr::Path(path) => self.path(path, context),
            Expr::Paren(inner) => self.meaning(&inner.expr, context),
            Expr::Group(inner) => self.meaning(&inner.expr, context),
            Expr::Unary(unary) => self.unary(unary, context).map(Meaning::Value),
            Expr::Binary(binary) => self.binary(binary, context).map(Meaning::Value),
            Expr::Array(array) => self.array(array, context).map(Meaning::Value),
            Expr::Call(call) => self.call(call, context),
            Expr::MethodCall(call) => self.method(call, context),
            Expr::Field(field) => self.member(field, context),
            Expr::Index(index) => self.index(index, context),
            Expr::Assign(named) => {
                self.report.help(
                    span(&named.left),
                    "a value with a name means nothing here",
                    "to compare, write `==`; names of values stand in `substitute(expression, name = value)`, and where another model \
                     is asked",
                );
                None
            }
            // The parser has reported what stands here.
            Expr::Verbatim(_) => {
                self.report.silent();
                None
            }
            // The parser lets no other through.
            other => {
                self.report.error(span(other), "this expression has no meaning here");
                None
            }
        }
    }

    /// The value of `expr`, of any type.
    pub(super) fn value(&mut self, expr: &Expr, context: Context<'a>) -> Option<Typed> {
        let meaning = self.meaning(expr, context)?;
        self.as_value(meaning, expr)
    }

    /// Makes a value of what has one: a joint of one coordinate stands for that coordinate.
    pub(super) fn as_value(&mut self, meaning: Meaning, expr: &Expr) -> Option<Typed> {
        let at = span(expr);
        let (what, help) = match meaning {
            Meaning::Value(typed) => return Some(typed.at(at)),
            Meaning::Coordinate(joint, index) => return self.coordinate(joint, index, expr),
            Meaning::Joint(joint) => return self.joint_value(joint, expr),
            Meaning::Frame(_) => ("a frame", "take `.position`, `.velocity`, `.pose`, .. of it".to_string()),
            Meaning::Force(_) => ("a force", "take `.power` of it".to_string()),
            Meaning::Constraint(_) => ("a constraint", "name it in `solve (..) from ..`".to_string()),
            Meaning::Part(_) => ("a part", "take something inside it".to_string()),
            Meaning::Parts(_) => ("an array of parts", format!("write `{}[0]. ..`", source_text(expr))),
        };
        self.report.help(at, format!("expected a value, found {what}"), help);
        None
    }

    /// A scalar that depends on nothing but what is allowed.
    pub(super) fn scalar(&mut self, expr: &Expr, context: Context<'a>, allowed: Allowed) -> Option<Typed> {
        self.typed(expr, context, &Type::Scalar, allowed)
    }

    /// A `Vec3` that depends on nothing but what is allowed.
    pub(super) fn vector(&mut self, expr: &Expr, context: Context<'a>, allowed: Allowed) -> Option<Typed> {
        self.typed(expr, context, &Type::Vec3, allowed)
    }

    /// A value of type `ty` that depends on nothing but what is allowed.
    pub(super) fn typed(&mut self, expr: &Expr, context: Context<'a>, ty: &Type, allowed: Allowed) -> Option<Typed> {
        let value = self.expect(expr, context, ty)?;
        self.allow(value, allowed)
    }

    /// Refuses a value that depends on more than is allowed.
    pub(super) fn allow(&mut self, value: Typed, allowed: Allowed) -> Option<Typed> {
        match value.uses.refusal(allowed) {
            None => Some(value),
            Some((span, message)) => {
                self.report.error(span, message);
                None
            }
        }
    }

    /// A frame: the ground, a body, a port, and what `.at`, `.rotated`, `.oriented` make of them.
    pub(super) fn frame(&mut self, expr: &Expr, context: Context<'a>) -> Option<FrameValue> {
        let found = match self.meaning(expr, context)? {
            Meaning::Frame(mut frame) => {
                frame.frame.span = span(expr);
                return Some(frame);
            }
            Meaning::Value(value) => type_text(&value.expr.ty),
            Meaning::Joint(_) => "a joint".into(),
            Meaning::Coordinate(..) => "a coordinate".into(),
            Meaning::Force(_) => "a force".into(),
            Meaning::Constraint(_) => "a constraint".into(),
            Meaning::Part(_) | Meaning::Parts(_) => "a part".into(),
        };
        self.report.help(
            span(expr),
            format!("expected a frame, found {found}"),
            "frames are `ground`, bodies, ports, and those with `.at(..)`, `.rotated(..)`",
        );
        None
    }

    /// A node over `parts`: collects what they depend on, and bounds the height.
    pub(super) fn build(&mut self, node: ExprNode, ty: Type, span: Span, parts: &[&Typed]) -> Option<Typed> {
        let mut value = Typed { expr: new_expr(node, ty, span), uses: super::typed::Uses::default(), depth: 1 };
        for part in parts {
            value.uses.merge(&part.uses);
            value.depth = value.depth.max(part.depth + 1);
        }
        if value.depth > MAX_HEIGHT {
            self.report.error(span, format!("this expression, with its `let`s, is nested more than {MAX_HEIGHT} deep"));
            return None;
        }
        Some(value)
    }

    fn literal(&mut self, literal: &ExprLit) -> Option<Typed> {
        let span = literal.lit.span();
        let digits = match &literal.lit {
            Lit::Int(int) => int.base10_digits(),
            Lit::Float(float) => float.base10_digits(),
            _ => {
                self.report.error(span, "expected a number");
                return None;
            }
        };
        match digits.parse::<f64>() {
            Ok(value) if value.is_finite() => Some(Typed::number(value, span)),
            _ => {
                self.report.error(span, "this number is out of range");
                None
            }
        }
    }
}
