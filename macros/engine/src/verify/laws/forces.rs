//! Stage `verify`: what is known of declared forces.
//!
//! In: a model. Out: whether springs have an energy, and all else vanishes at rest without inputs and is linear in
//! velocities.

use std::collections::HashMap;
use std::rc::Rc;

use crate::model::types::{Expr, ExprNode, ForceKind, FrameQuantity, Function, Model, Order, SystemQuantity};

/// How an expression depends on velocities and inputs.
#[derive(Clone, Copy)]
struct Shape {
    /// Reads parameters alone.
    constant: bool,
    /// In velocities; two stands for anything else.
    degree: u8,
    /// Where velocities and inputs are zero.
    vanishes: bool,
}

const OTHER: Shape = Shape { constant: false, degree: 2, vanishes: false };

/// See [`super::At`]'s equations of Lagrange.
pub(super) fn are_balanced(model: &Model) -> bool {
    let mut known = HashMap::new();
    model.forces.iter().all(|force| match &force.kind {
        ForceKind::Effort { values, .. } => values.iter().all(|value| is_balanced(value, &mut known)),
        ForceKind::Force { value, .. } | ForceKind::Torque { value, .. } => is_balanced(value, &mut known),
        ForceKind::JointSpring { stiffness, damping, rest, .. } => {
            [stiffness, damping, rest].into_iter().flatten().all(|part| shape(part, &mut known).constant)
        }
        ForceKind::LineSpring { stiffness, damping, length, .. } => {
            [stiffness, damping, length].into_iter().flatten().all(|part| shape(part, &mut known).constant)
        }
    })
}

/// Whether springs act on joints that close loops.
pub(super) fn on_closed_joints(model: &Model) -> bool {
    model.forces.iter().any(|force| match &force.kind {
        ForceKind::JointSpring { joint, .. } => model.cuts.contains(joint),
        ForceKind::Effort { .. }
        | ForceKind::LineSpring { .. }
        | ForceKind::Force { .. }
        | ForceKind::Torque { .. } => false,
    })
}

type Known = HashMap<*const ExprNode, Shape>;

fn is_balanced(expr: &Expr, known: &mut Known) -> bool {
    let Shape { degree, vanishes, .. } = shape(expr, known);
    vanishes && degree < 2
}

fn shape(expr: &Expr, known: &mut Known) -> Shape {
    let key = Rc::as_ptr(&expr.node);
    if let Some(&shape) = known.get(&key) {
        return shape;
    }
    let shape = shape_of(&expr.node, known);
    known.insert(key, shape);
    shape
}

fn shape_of(node: &ExprNode, known: &mut Known) -> Shape {
    let of = |degree: u8, vanishes: bool| Shape { constant: false, degree, vanishes };
    match node {
        ExprNode::Number(x) => Shape { constant: true, degree: 0, vanishes: *x == 0.0 },
        ExprNode::Pi | ExprNode::Param(_) => Shape { constant: true, degree: 0, vanishes: false },
        ExprNode::Time | ExprNode::State(_) | ExprNode::Coordinate { order: Order::Position, .. } => of(0, false),
        ExprNode::Input(_) => of(0, true),
        ExprNode::Coordinate { order: Order::Rate, .. } | ExprNode::RelativeAngularVelocity(_) => of(1, true),
        ExprNode::OfFrame(_, quantity) => match quantity {
            FrameQuantity::Position | FrameQuantity::Rotation | FrameQuantity::Pose => of(0, false),
            FrameQuantity::Velocity | FrameQuantity::AngularVelocity | FrameQuantity::Twist => of(1, true),
            FrameQuantity::Acceleration | FrameQuantity::AngularAcceleration => OTHER,
        },
        ExprNode::OfBodies(_, quantity) => match quantity {
            SystemQuantity::TotalMass => Shape { constant: true, degree: 0, vanishes: false },
            SystemQuantity::CentreOfMass => of(0, false),
            SystemQuantity::CentreOfMassVelocity | SystemQuantity::LinearMomentum | SystemQuantity::AngularMomentum => {
                of(1, true)
            }
            SystemQuantity::CentreOfMassAcceleration => OTHER,
        },
        ExprNode::Express { vector, .. } => Shape { constant: false, ..shape(vector, known) },
        ExprNode::Vec3(parts) => sum(parts, known),
        ExprNode::Array(parts) => sum(parts, known),
        ExprNode::Add(a, b) | ExprNode::Sub(a, b) => sum([a, b], known),
        ExprNode::Index(x, _)
        | ExprNode::Component(x, _)
        | ExprNode::Linear(x)
        | ExprNode::Angular(x)
        | ExprNode::Neg(x) => shape(x, known),
        ExprNode::Mul(a, b) => product(a, b, known),
        ExprNode::Div(a, b) => {
            let (a, b) = (shape(a, known), shape(b, known));
            let degree = if b.degree == 0 { a.degree } else { 2 };
            Shape { constant: a.constant && b.constant, degree, vanishes: a.vanishes }
        }
        ExprNode::Call(Function::Dot | Function::Cross, parts) => match &parts[..] {
            [a, b] => product(a, b, known),
            _ => OTHER,
        },
        ExprNode::Call(_, parts) => {
            let Shape { constant, degree, .. } = sum(parts, known);
            Shape { constant, degree: if degree == 0 { 0 } else { 2 }, vanishes: false }
        }
        ExprNode::Select(mask, a, b) => {
            let Shape { degree, vanishes, .. } = sum([a, b], known);
            if shape(mask, known).degree == 0 { of(degree, vanishes) } else { OTHER }
        }
        ExprNode::Compare(_, a, b) | ExprNode::And(a, b) | ExprNode::Or(a, b) => {
            let Shape { constant, degree, .. } = sum([a, b], known);
            Shape { constant, degree: if degree == 0 { 0 } else { 2 }, vanishes: false }
        }
        _ => OTHER,
    }
}

fn sum<'e>(parts: impl IntoIterator<Item = &'e Expr>, known: &mut Known) -> Shape {
    let mut all = Shape { constant: true, degree: 0, vanishes: true };
    for part in parts {
        let part = shape(part, known);
        all.constant &= part.constant;
        all.degree = all.degree.max(part.degree);
        all.vanishes &= part.vanishes;
    }
    all
}

fn product(a: &Expr, b: &Expr, known: &mut Known) -> Shape {
    let (a, b) = (shape(a, known), shape(b, known));
    let degree = (a.degree + b.degree).min(2);
    Shape { constant: a.constant && b.constant, degree, vanishes: a.vanishes || b.vanishes }
}
