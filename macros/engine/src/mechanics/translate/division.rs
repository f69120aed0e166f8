//! Stage `mechanics`: values that are infinite wherever the mechanism stands.
//!
//! In: expressions of the user, or of what is written in the language, such as a wheel. Out: complaints about quotients whose divisor is
//! zero on the tree, negative powers of zero and its logarithm: such as one by the length of the way that a disc which always lies flat
//! has ahead. They have no value, and on the graph, where prints are finite, a product of them with zero would be zero: an equation
//! would be lost without a word. A divisor is looked at as it is, and with drives in the places of the coordinates that follow them.
//! What stands in a branch of `select` may never be taken. Divisors that are zero where loops are closed alone are looked for among
//! numbers (`analysis/divisors`).

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::model::site::Sited;
use crate::model::types::{ConstraintKind, Expr, ExprNode, FrameQuantity, Function, Model, Order};
use crate::symbolic::graph::Scalar;

use super::manipulations::roots;

/// What is infinite where one of its operands vanishes.
pub(in crate::mechanics) struct Pole<'m> {
    pub whole: &'m Expr,
    /// The operand.
    pub divisor: &'m Expr,
}

/// Poles at which the mechanism always stands.
pub(in crate::mechanics) fn complaints(model: &Model) -> Vec<Complaint> {
    let poles = poles(model, is_of_the_tree);
    if poles.is_empty() {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let anywhere: Vec<Scalar> = poles.iter().map(|pole| e.scalar(pole.divisor)).collect();
    let mut driven = Reduction::default();
    e.drive(&mut driven);
    let where_driven = e.g.substitute(&anywhere, &driven.map);
    told(poles.iter().zip(anywhere.into_iter().zip(where_driven)).filter_map(|(pole, divisors)| match divisors {
        (Scalar::ZERO, _) => Some(pole.complaint("wherever the mechanism stands")),
        (_, Scalar::ZERO) => Some(pole.complaint("wherever drives keep the mechanism")),
        _ => None,
    }))
}

/// Poles outside of branches of `select` whose divisors are known from what `is_known` admits.
pub(in crate::mechanics) fn poles(model: &Model, is_known: fn(&ExprNode) -> bool) -> Vec<Pole<'_>> {
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
        if let ExprNode::Select(condition, ..) = &*expr.node {
            stack.push(condition);
            continue;
        }
        let divisor = divisor(&expr.node).filter(|divisor| all_of(divisor, is_known));
        found.extend(divisor.map(|divisor| Pole { whole: expr, divisor }));
        stack.extend(expr.node.operands());
    }
    found
}

/// What must not vanish.
fn divisor(node: &ExprNode) -> Option<&Expr> {
    let is_negative = |power: &Expr| match &*power.node {
        ExprNode::Number(x) => *x < 0.0,
        ExprNode::Neg(x) => matches!(*x.node, ExprNode::Number(x) if x > 0.0),
        _ => false,
    };
    match node {
        ExprNode::Div(_, divisor) => Some(divisor),
        ExprNode::Call(Function::Powi | Function::Powf, arguments) => match &arguments[..] {
            [base, power] if is_negative(power) => Some(base),
            _ => None,
        },
        ExprNode::Call(Function::Ln, arguments) => arguments.first(),
        _ => None,
    }
}

impl Pole<'_> {
    /// It vanishes at this place.
    pub(in crate::mechanics) fn complaint(&self, place: &str) -> Complaint {
        let what = match &*self.whole.node {
            ExprNode::Div(..) => "this divides by what is zero",
            ExprNode::Call(Function::Ln, _) => "this is the logarithm of what is zero",
            _ => "this is a negative power of what is zero",
        };
        let is_length =
            matches!(*self.divisor.node, ExprNode::Call(Function::Norm | Function::Sqrt | Function::Hypot, _));
        Complaint {
            at: self.whole.site(),
            message: format!("{what} {place}"),
            help: is_length.then(|| "what lies flat, stands on end or has no length has no direction there".to_owned()),
        }
    }
}

/// What is infinite once couplings, drives and what follows stand in the places of coordinates: nothing with it in it has a value, and a
/// product with zero, or a slope, would be zero on the graph.
pub(in crate::mechanics) fn at_a_pole(model: &Model) -> Complaint {
    Complaint {
        at: model.site(),
        message:
            "its equations divide by what is zero wherever the mechanism stands, or take the tangent of a right angle"
                .to_owned(),
        help: Some(
            "look for a quotient, a power, a logarithm or a tangent of what couplings, drives or loops keep as it is"
                .to_owned(),
        ),
    }
}

/// Several quotients of one item, such as those of a wheel, stand at one token.
pub(in crate::mechanics) fn told(complaints: impl Iterator<Item = Complaint>) -> Vec<Complaint> {
    let mut told = HashSet::new();
    complaints.filter(|complaint| told.insert(format!("{:?}", complaint.at))).collect()
}

fn all_of(expr: &Expr, is_known: fn(&ExprNode) -> bool) -> bool {
    let (mut stack, mut seen) = (vec![expr], HashSet::new());
    while let Some(expr) = stack.pop() {
        if seen.insert(Rc::as_ptr(&expr.node)) {
            if !is_known(&expr.node) {
                return false;
            }
            stack.extend(expr.node.operands());
        }
    }
    true
}

/// Whether a node is known, where its operands are, before anything is split or solved.
fn is_of_the_tree(node: &ExprNode) -> bool {
    match node {
        ExprNode::Time
        | ExprNode::Input(_)
        | ExprNode::State(_)
        | ExprNode::RelativeAngularVelocity(_)
        | ExprNode::Coordinate { order: Order::Rate, .. }
        | ExprNode::OfFrame(_, FrameQuantity::Velocity | FrameQuantity::AngularVelocity | FrameQuantity::Twist)
        | ExprNode::Linear(_)
        | ExprNode::Angular(_)
        | ExprNode::Select(..) => true,
        _ => is_of_positions(node),
    }
}

/// The same from numbers and positions alone.
pub(in crate::mechanics) fn is_of_positions(node: &ExprNode) -> bool {
    matches!(
        node,
        ExprNode::Coordinate { order: Order::Position, .. }
            | ExprNode::OfFrame(_, FrameQuantity::Position | FrameQuantity::Rotation)
            | ExprNode::Number(_)
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
            | ExprNode::Identity
            | ExprNode::RotationAbout { .. }
            | ExprNode::RollPitchYaw(_)
            | ExprNode::Compose(..)
            | ExprNode::Compare(..)
            | ExprNode::And(..)
            | ExprNode::Or(..)
            | ExprNode::Not(_)
            | ExprNode::Call(..)
    )
}
