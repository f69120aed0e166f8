//! Stage `mechanics`: quotients by nothing.
//!
//! In: expressions of the user, or of what is written in the language, such as a wheel. Out: complaints about quotients whose divisor is zero
//! wherever the mechanism stands, such as the length of the way that a disc which always lies flat has ahead: nothing is what they are, and
//! a product of them with zero would be zero on the graph. What stands in a branch of `select` may never be taken; there
//! a quotient by zero is no number.

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
    let equations = model.constraints.iter().filter_map(|constraint| match &constraint.kind {
        ConstraintKind::Value(value) | ConstraintKind::Rate(value) => Some(value),
        ConstraintKind::Rod { .. } => None,
    });
    let speeds = model.speeds.iter().map(|speed| &speed.value);
    let drives = model.drives.iter().map(|drive| &drive.value);
    let mut stack: Vec<&Expr> = roots(model).into_iter().chain(equations).chain(speeds).chain(drives).collect();
    let (mut complaints, mut seen, mut e) = (Vec::new(), HashSet::new(), None);
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        match &*expr.node {
            ExprNode::Select(condition, ..) => {
                stack.push(condition);
                continue;
            }
            ExprNode::Div(_, divisor) if is_of_the_tree(divisor) => {
                let e = e.get_or_insert_with(|| Equations::plain(model));
                if e.scalar(divisor) == Scalar::ZERO {
                    complaints.push(Complaint {
                        at: expr.site(),
                        message: "this divides by what is zero wherever the mechanism stands".to_owned(),
                        help: Some("what lies flat, stands on end or has no length has no direction there".to_owned()),
                    });
                }
            }
            _ => {}
        }
        stack.extend(expr.node.operands());
    }
    // Several quotients of one item, such as those of a wheel, stand at one token.
    let mut told = HashSet::new();
    complaints.retain(|complaint: &Complaint| told.insert(format!("{:?}", complaint.at)));
    complaints
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
