//! Stage `model`: squares in products.
//!
//! In: a product. Out: what stands in it beside a square, as `k` in `0.5 * k * x * x`; of such a product the half is a plain
//! number, see the rule in the documentation of the room.

use std::rc::Rc;

use crate::model::types::{Expr, ExprNode, Function};

/// How far a product is looked through for its factors.
const MOST_FACTORS: usize = 16;

/// How far two factors are compared.
const MOST_MEMBERS: usize = 4;

/// Sums of squares, such as `vx * vx + vy * vy + vz * vz`.
const MOST_SQUARES: usize = 2;

/// The factors beside a square; none where there is no square.
pub(super) fn beside(product: &Expr) -> Vec<&Expr> {
    let mut factors = factors(product);
    if let Some(square) = factors.iter().position(|factor| is_square(factor, MOST_SQUARES)) {
        factors.remove(square);
        return factors;
    }
    for first in 0..factors.len() {
        let (before, after) = factors.split_at(first + 1);
        let same = |other: &&Expr| before.last().is_some_and(|factor| is_same(factor, other, MOST_MEMBERS));
        if let Some(distance) = after.iter().position(same) {
            factors.remove(first + 1 + distance);
            factors.remove(first);
            return factors;
        }
    }
    Vec::new()
}

/// Those above the line; none of a product that is very long.
fn factors(product: &Expr) -> Vec<&Expr> {
    let mut factors: Vec<&Expr> = Vec::new();
    let mut waiting = vec![product];
    while let Some(next) = waiting.pop() {
        // What the product itself declares is not what it is made of.
        let whole = next.unit.is_none() || std::ptr::eq(next, product);
        match &*next.node {
            ExprNode::Mul(a, b) if whole => waiting.extend([a, b]),
            ExprNode::Div(a, _) | ExprNode::Neg(a) if whole => waiting.push(a),
            _ => factors.push(next),
        }
        if factors.len() + waiting.len() > MOST_FACTORS {
            return Vec::new();
        }
    }
    factors
}

/// Whether it is a square, or a sum of squares.
fn is_square(expr: &Expr, depth: usize) -> bool {
    if expr.unit.is_some() {
        return false;
    }
    match &*expr.node {
        ExprNode::Call(Function::Powi, arguments) => {
            matches!(arguments.as_slice(), [_, exponent] if matches!(&*exponent.node, ExprNode::Number(x) if *x == 2.0))
        }
        ExprNode::Call(Function::Dot, arguments) => {
            matches!(arguments.as_slice(), [a, b] if is_same(a, b, MOST_MEMBERS))
        }
        ExprNode::Mul(a, b) => is_same(a, b, MOST_MEMBERS),
        ExprNode::Add(a, b) => depth > 0 && is_square(a, depth - 1) && is_square(b, depth - 1),
        _ => false,
    }
}

/// Whether two names, or members of them, are the same; `abs` changes no unit.
fn is_same(a: &Expr, b: &Expr, depth: usize) -> bool {
    if Rc::ptr_eq(&a.node, &b.node) {
        return true;
    }
    if depth == 0 {
        return false;
    }
    match (&*a.node, &*b.node) {
        (ExprNode::Call(Function::Abs, inner), _) => inner.first().is_some_and(|inner| is_same(inner, b, depth - 1)),
        (_, ExprNode::Call(Function::Abs, inner)) => inner.first().is_some_and(|inner| is_same(a, inner, depth - 1)),
        (ExprNode::Time, ExprNode::Time) => true,
        (ExprNode::Param(a), ExprNode::Param(b)) => a == b,
        (ExprNode::Input(a), ExprNode::Input(b)) => a == b,
        (ExprNode::State(a), ExprNode::State(b)) => a == b,
        (ExprNode::RelativeAngularVelocity(a), ExprNode::RelativeAngularVelocity(b)) => a == b,
        (
            ExprNode::Coordinate { joint, index, order },
            ExprNode::Coordinate { joint: joint2, index: index2, order: order2 },
        ) => (joint, index, order) == (joint2, index2, order2),
        (ExprNode::OfFrame(a, of), ExprNode::OfFrame(b, of2)) => {
            of == of2 && a.body == b.body && a.steps.is_empty() && b.steps.is_empty()
        }
        (ExprNode::Index(a, k), ExprNode::Index(b, l)) | (ExprNode::Component(a, k), ExprNode::Component(b, l)) => {
            k == l && is_same(a, b, depth - 1)
        }
        _ => false,
    }
}
