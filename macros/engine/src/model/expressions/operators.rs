//! Stage `model`: operators.
//!
//! In: unary and binary operations. Out: typed nodes; numbers, and `Vec3` where it has a meaning.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, ExprUnary, UnOp};

use crate::model::checker::{Checker, Context};
use crate::model::typed::{Typed, type_text};
use crate::model::types::{Comparison, ExprNode, Type};

use super::coerce::convert;

/// Sums longer than this are built as balanced trees: their height must not grow with their length.
const LONG_SUM: usize = 16;

impl<'a> Checker<'a, '_> {
    pub(super) fn unary(&mut self, unary: &ExprUnary, context: Context<'a>) -> Option<Typed> {
        let at = unary.span();
        match unary.op {
            UnOp::Neg(_) => {
                let value = self.value(&unary.expr, context)?;
                self.negate(&value, at)
            }
            UnOp::Not(_) => {
                let value = self.expect(&unary.expr, context, &Type::Bool)?;
                self.build(ExprNode::Not(value.expr.clone()), Type::Bool, at, &[&value])
            }
            _ => {
                self.report.error(unary.op.span(), "this operator has no meaning here");
                None
            }
        }
    }

    fn negate(&mut self, value: &Typed, at: Span) -> Option<Typed> {
        if let ExprNode::Number(x) = &*value.expr.node {
            let mut number = Typed::number(-x, at);
            number.expr.unit.clone_from(&value.expr.unit);
            return Some(number);
        }
        let Some(value) = arithmetic(value) else {
            let message = format!("{} has no negative", type_text(&value.expr.ty));
            self.report.error(at, message);
            return None;
        };
        let ty = value.expr.ty.clone();
        self.build(ExprNode::Neg(value.expr.clone()), ty, at, &[&value])
    }

    /// Chains such as `a + b - c` lean to the left and may be long: they are walked, not recursed into.
    pub(super) fn binary(&mut self, binary: &ExprBinary, context: Context<'a>) -> Option<Typed> {
        let mut chain: Vec<&ExprBinary> = vec![binary];
        let mut first: &Expr = &binary.left;
        while let Expr::Binary(inner) = first {
            chain.push(inner);
            first = &inner.left;
        }
        chain.reverse();
        let mut result = self.value(first, context);
        let mut rest = chain.as_slice();
        while let Some((link, after)) = rest.split_first() {
            let run = rest.iter().take_while(|link| is_sum(&link.op)).count();
            if run > LONG_SUM {
                let (sum, after) = rest.split_at(run);
                result = self.long_sum(result, sum, context);
                rest = after;
                continue;
            }
            rest = after;
            let right = self.value(&link.right, context);
            result = match (result, right) {
                (Some(left), Some(right)) => self.combine(link, left, right),
                _ => None,
            };
        }
        result
    }

    fn long_sum(&mut self, first: Option<Typed>, links: &[&ExprBinary], context: Context<'a>) -> Option<Typed> {
        let mut terms = vec![first.map(|value| (false, value))];
        for link in links {
            let value = self.value(&link.right, context);
            terms.push(value.map(|value| (matches!(link.op, BinOp::Sub(_)), value)));
        }
        let terms: Vec<(bool, Typed)> = terms.into_iter().collect::<Option<_>>()?;
        let (_, first) = terms.first()?;
        let Some(first) = arithmetic(first) else {
            let message = format!("cannot add {}", type_text(&first.expr.ty));
            self.report.error(first.expr.span, message);
            return None;
        };
        let ty = first.expr.ty.clone();
        // Only the first term of another type is reported.
        let terms: Vec<(bool, Typed)> =
            terms.into_iter().map(|(minus, term)| Some((minus, self.coerce(term, &ty)?))).collect::<Option<_>>()?;
        // The first term has no sign, and it decides.
        self.balanced(&terms).map(|(_, sum)| sum)
    }

    /// Sum of signed terms, and whether all of it is to be subtracted. The first term decides that, so a sum that
    /// begins without a sign has none.
    fn balanced(&mut self, terms: &[(bool, Typed)]) -> Option<(bool, Typed)> {
        if let [(minus, term)] = terms {
            return Some((*minus, term.clone()));
        }
        let (left, right) = terms.split_at(terms.len() / 2);
        let (left_minus, left) = self.balanced(left)?;
        let (right_minus, right) = self.balanced(right)?;
        let (ty, at) = (left.expr.ty.clone(), left.expr.span);
        let (a, b) = (left.expr.clone(), right.expr.clone());
        let node = if left_minus == right_minus { ExprNode::Add(a, b) } else { ExprNode::Sub(a, b) };
        let sum = self.build(node, ty, at, &[&left, &right])?;
        Some((left_minus, sum))
    }

    fn combine(&mut self, link: &ExprBinary, left: Typed, right: Typed) -> Option<Typed> {
        let at = link.op.span();
        match &link.op {
            BinOp::Add(_) => self.sum("add", ExprNode::Add, at, left, right),
            BinOp::Sub(_) => self.sum("subtract", ExprNode::Sub, at, left, right),
            BinOp::Mul(_) => self.product(at, left, right),
            BinOp::Div(_) => self.quotient(at, left, right),
            BinOp::Lt(_) => self.comparison(Comparison::Less, at, left, right),
            BinOp::Le(_) => self.comparison(Comparison::LessEqual, at, left, right),
            BinOp::Gt(_) => self.comparison(Comparison::Greater, at, left, right),
            BinOp::Ge(_) => self.comparison(Comparison::GreaterEqual, at, left, right),
            BinOp::Eq(_) => self.comparison(Comparison::Equal, at, left, right),
            BinOp::Ne(_) => self.comparison(Comparison::NotEqual, at, left, right),
            BinOp::And(_) => self.logic(ExprNode::And, at, left, right),
            BinOp::Or(_) => self.logic(ExprNode::Or, at, left, right),
            _ => {
                // The parser lets no other through.
                self.report.error(at, "this operator has no meaning here");
                None
            }
        }
    }

    fn sum(
        &mut self,
        verb: &str,
        node: fn(crate::model::types::Expr, crate::model::types::Expr) -> ExprNode,
        at: Span,
        left: Typed,
        right: Typed,
    ) -> Option<Typed> {
        match (arithmetic(&left), arithmetic(&right)) {
            (Some(a), Some(b)) if a.expr.ty == b.expr.ty => {
                let ty = a.expr.ty.clone();
                self.build(node(a.expr.clone(), b.expr.clone()), ty, at, &[&a, &b])
            }
            _ => self.mismatch(verb, at, &left, &right, None),
        }
    }

    fn product(&mut self, at: Span, left: Typed, right: Typed) -> Option<Typed> {
        let ty = |a: &Typed, b: &Typed| match (&a.expr.ty, &b.expr.ty) {
            (Type::Scalar, other) | (other, Type::Scalar) => Some(other.clone()),
            _ => None,
        };
        if let (Some(a), Some(b)) = (arithmetic(&left), arithmetic(&right)) {
            if let Some(ty) = ty(&a, &b) {
                let node = ExprNode::Mul(a.expr.clone(), b.expr.clone());
                return self.build(node, ty, at, &[&a, &b]);
            }
            let help = "write `dot(a, b)` or `cross(a, b)`";
            return self.mismatch("multiply", at, &left, &right, Some(help));
        }
        if (&left.expr.ty, &right.expr.ty) == (&Type::Rotation, &Type::Rotation) {
            let node = ExprNode::Compose(left.expr.clone(), right.expr.clone());
            return self.build(node, Type::Rotation, at, &[&left, &right]);
        }
        if left.expr.ty == Type::Rotation
            && let Some(vector) = convert(&right, &Type::Vec3)
        {
            let node = ExprNode::Rotated(left.expr.clone(), vector.expr.clone());
            return self.build(node, Type::Vec3, at, &[&left, &vector]);
        }
        self.mismatch("multiply", at, &left, &right, None)
    }

    fn quotient(&mut self, at: Span, left: Typed, right: Typed) -> Option<Typed> {
        match (arithmetic(&left), arithmetic(&right)) {
            (Some(a), Some(b)) if b.expr.ty == Type::Scalar => {
                if matches!(&*b.expr.node, ExprNode::Number(x) if *x == 0.0) {
                    self.report.error(b.expr.span, "division by zero");
                    return None;
                }
                let ty = a.expr.ty.clone();
                let node = ExprNode::Div(a.expr.clone(), b.expr.clone());
                self.build(node, ty, at, &[&a, &b])
            }
            _ => self.mismatch("divide", at, &left, &right, None),
        }
    }

    fn comparison(&mut self, comparison: Comparison, at: Span, left: Typed, right: Typed) -> Option<Typed> {
        let left = self.coerce(left, &Type::Scalar);
        let right = self.coerce(right, &Type::Scalar);
        let (a, b) = (left?, right?);
        let node = ExprNode::Compare(comparison, a.expr.clone(), b.expr.clone());
        self.build(node, Type::Bool, at, &[&a, &b])
    }

    fn logic(
        &mut self,
        node: fn(crate::model::types::Expr, crate::model::types::Expr) -> ExprNode,
        at: Span,
        left: Typed,
        right: Typed,
    ) -> Option<Typed> {
        let left = self.coerce(left, &Type::Bool);
        let right = self.coerce(right, &Type::Bool);
        let (a, b) = (left?, right?);
        let node = node(a.expr.clone(), b.expr.clone());
        self.build(node, Type::Bool, at, &[&a, &b])
    }

    fn mismatch(&mut self, verb: &str, at: Span, left: &Typed, right: &Typed, help: Option<&str>) -> Option<Typed> {
        let (left, right) = (type_text(&left.expr.ty), type_text(&right.expr.ty));
        let message = match verb {
            "divide" => format!("cannot divide {left} by {right}"),
            "subtract" => format!("cannot subtract {right} from {left}"),
            "multiply" => format!("cannot multiply {left} by {right}"),
            _ => format!("cannot {verb} {left} and {right}"),
        };
        match help {
            Some(help) => self.report.help(at, message, help),
            None => self.report.error(at, message),
        }
        None
    }
}

fn is_sum(op: &BinOp) -> bool {
    matches!(op, BinOp::Add(_) | BinOp::Sub(_))
}

/// A value to calculate with: a scalar, a `Vec3`, or three scalars as one.
fn arithmetic(value: &Typed) -> Option<Typed> {
    match value.expr.ty {
        Type::Scalar => Some(value.clone()),
        _ => convert(value, &Type::Vec3),
    }
}
