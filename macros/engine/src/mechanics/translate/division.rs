//! Stage `mechanics`: quotients by nothing.
//!
//! In: expressions of the user, or of what is written in the language, such as a wheel. Out: complaints about quotients whose divisor is zero
//! wherever the mechanism stands, such as the length of the way that a disc which always lies flat has ahead: they have no value, and
//! a product of them with zero would be zero on the graph. What stands in a branch of `select` may never be taken. Divisors that are zero
//! where loops are closed alone are looked for among numbers (`analysis/divisors`).

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::model::site::Sited;
use crate::model::types::{ConstraintKind, Expr, ExprNode, FrameQuantity, Model, Order};
use crate::symbolic::graph::Scalar;

use super::manipulations::roots;

/// Quotients by zero.
pub(in crate::mechanics) fn complaints(model: &Model) -> Vec<Complaint> {
    let mut e = None;
    let divides_by_zero = |(_, divisor): &(&Expr, &Expr)| {
        e.get_or_insert_with(|| Equations::plain(model)).scalar(divisor) == Scalar::ZERO
    };
    let found = quotients(model).into_iter().filter(divides_by_zero);
    told(found.map(|(quotient, _)| complaint(quotient, "wherever the mechanism stands")))
}

/// Quotients outside of branches of `select`, with their divisors, where these are known from positions of the tree alone.
pub(in crate::mechanics) fn quotients(model: &Model) -> Vec<(&Expr, &Expr)> {
    let equations = model.constraints.iter().filter_map(|constraint| match &constraint.kind {
        ConstraintKind::Value(value) | ConstraintKind::Rate(value) => Some(value),
        ConstraintKind::Rod { .. } => None,
    });
    let speeds = model.speeds.iter().map(|speed| &speed.value);
    let drives = model.drives.iter().map(|drive| &drive.value);
    let mut stack: Vec<&Expr> = roots(model).into_iter().chain(equations).chain(speeds).chain(drives).collect();
    let (mut found, mut seen) = (Vec::new(), HashSet::new());
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        match &*expr.node {
            ExprNode::Select(condition, ..) => {
                stack.push(condition);
                continue;
            }
            ExprNode::Div(_, divisor) if is_of_the_tree(divisor) => found.push((expr, divisor)),
            _ => {}
        }
        stack.extend(expr.node.operands());
    }
    found
}

pub(in crate::mechanics) fn complaint(quotient: &Expr, place: &str) -> Complaint {
    Complaint {
        at: quotient.site(),
        message: format!("this divides by what is zero {place}"),
        help: Some("what lies flat, stands on end or has no length has no direction there".to_owned()),
    }
}

/// Several quotients of one item, such as those of a wheel, stand at one token.
pub(in crate::mechanics) fn told(complaints: impl Iterator<Item = Complaint>) -> Vec<Complaint> {
    let mut told = HashSet::new();
    complaints.filter(|complaint| told.insert(format!("{:?}", complaint.at))).collect()
}

/// Whether an expression is known before anything is split or solved: from numbers and positions of the tree.
fn is_of_the_tree(expr: &Expr) -> bool {
    let mut stack = vec![expr];
    while let Some(expr) = stack.pop() {
        match &*expr.node {
            ExprNode::Coordinate { order: Order::Position, .. }
            | ExprNode::OfFrame(_, FrameQuantity::Position | FrameQuantity::Rotation) => {}
            ExprNode::Number(_)
            | ExprNode::Pi
            | ExprNode::Param(_)
            | ExprNode::Express { .. }
            | ExprNode::Vec3(_)
            | ExprNode::Array(_)
            | ExprNode::Index(..)
            | ExprNode::Component(..)
            | ExprNode::Neg(_)
            | ExprNode::Add(..)
            | ExprNode::Sub(..)
            | ExprNode::Mul(..)
            | ExprNode::Div(..)
            | ExprNode::Rotated(..)
            | ExprNode::Call(..) => stack.extend(expr.node.operands()),
            _ => return false,
        }
    }
    true
}
