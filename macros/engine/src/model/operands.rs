//! Stage `model`: expressions inside expressions.
//!
//! In: a node. Out: its operands. Frames hold parameters alone, and are translated where they stand.

use super::types::{Expr, ExprNode};

impl ExprNode {
    /// What has to be known before this is.
    pub fn operands(&self) -> Vec<&Expr> {
        match self {
            ExprNode::Number(_)
            | ExprNode::Pi
            | ExprNode::Time
            | ExprNode::Param(_)
            | ExprNode::Input(_)
            | ExprNode::State(_)
            | ExprNode::Coordinate { .. }
            | ExprNode::RelativeAngularVelocity(_)
            | ExprNode::Effort { .. }
            | ExprNode::OfFrame(..)
            | ExprNode::Jacobian { .. }
            | ExprNode::Reaction { .. }
            | ExprNode::Multiplier(_)
            | ExprNode::Power(_)
            | ExprNode::Kinetic
            | ExprNode::Potential
            | ExprNode::OfBodies(..)
            | ExprNode::MassMatrix(_)
            | ExprNode::Bias(_)
            | ExprNode::Residual { .. }
            | ExprNode::Closed(_)
            | ExprNode::Unknown(_)
            | ExprNode::Undefined
            | ExprNode::Identity => Vec::new(),
            ExprNode::Solved { system, .. } => system.iter().collect(),
            ExprNode::OneOfTwo { coefficients, .. } => coefficients.iter().collect(),
            ExprNode::Substituted { of, pairs } => {
                std::iter::once(of).chain(pairs.iter().map(|pair| &pair.1)).collect()
            }
            ExprNode::Formula { given, .. } => given.iter().map(|given| &given.value).collect(),
            ExprNode::Express { vector: inner, .. }
            | ExprNode::Derivative { of: inner, .. }
            | ExprNode::Index(inner, _)
            | ExprNode::Component(inner, _)
            | ExprNode::Linear(inner)
            | ExprNode::Angular(inner)
            | ExprNode::Neg(inner)
            | ExprNode::Not(inner) => vec![inner],
            ExprNode::Vec3(elements) | ExprNode::RollPitchYaw(elements) => elements.iter().collect(),
            ExprNode::Array(elements) | ExprNode::Call(_, elements) | ExprNode::External(_, elements) => {
                elements.iter().collect()
            }
            ExprNode::RotationAbout { axis: a, angle: b }
            | ExprNode::Add(a, b)
            | ExprNode::Sub(a, b)
            | ExprNode::Compose(a, b)
            | ExprNode::Rotated(a, b)
            | ExprNode::Pose(a, b)
            | ExprNode::Mul(a, b)
            | ExprNode::Div(a, b)
            | ExprNode::Compare(_, a, b)
            | ExprNode::And(a, b)
            | ExprNode::Or(a, b) => vec![a, b],
            ExprNode::Select(condition, a, b) => vec![condition, a, b],
        }
    }
}
