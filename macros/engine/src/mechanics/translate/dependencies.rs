//! Stage `mechanics`: what expressions ask for.
//!
//! In: typed expressions. Out: [`Dependencies`], which tell how much of the mechanics has to be derived for them.

use std::collections::HashSet;
use std::rc::Rc;

use crate::model::types::{Expr, ExprNode, JointId, Model, Order, SystemQuantity};

/// What expressions ask for.
#[derive(Default)]
pub(in crate::mechanics) struct Dependencies {
    pub frames: bool,
    pub accelerations: bool,
    pub multipliers: bool,
    reactions: Vec<JointId>,
    /// Equations or expressions are taken apart: by derivatives, substitutions, formulas of other models.
    pub manipulations: bool,
}

impl Dependencies {
    pub(in crate::mechanics) fn of<'m>(roots: impl Iterator<Item = &'m Expr>) -> Dependencies {
        let mut needs = Dependencies::default();
        let mut seen = HashSet::new();
        let mut stack: Vec<&Expr> = roots.collect();
        while let Some(expr) = stack.pop() {
            if !seen.insert(Rc::as_ptr(&expr.node)) {
                continue;
            }
            match &*expr.node {
                ExprNode::OfFrame(_, quantity) => {
                    use crate::model::types::FrameQuantity::{Acceleration, AngularAcceleration};
                    needs.frames = true;
                    needs.accelerations |= matches!(quantity, Acceleration | AngularAcceleration);
                }
                ExprNode::OfBodies(_, quantity) => {
                    needs.frames = true;
                    needs.accelerations |= *quantity == SystemQuantity::CentreOfMassAcceleration;
                }
                ExprNode::Power(_) | ExprNode::Express { .. } => needs.frames = true,
                ExprNode::Coordinate { order: Order::Acceleration, .. } => needs.accelerations = true,
                ExprNode::Derivative { accelerated, .. } => {
                    needs.accelerations |= *accelerated;
                    needs.manipulations = true;
                }
                ExprNode::Substituted { .. } | ExprNode::Formula { .. } => needs.manipulations = true,
                ExprNode::Multiplier(_) => (needs.accelerations, needs.multipliers) = (true, true),
                ExprNode::Reaction { joint, .. } => {
                    needs.accelerations = true;
                    needs.reactions.push(*joint);
                }
                _ => {}
            }
            stack.extend(expr.node.operands());
        }
        needs
    }

    /// Of what asks for frames' positions and rotations alone.
    pub(in crate::mechanics) fn on_frames() -> Dependencies {
        Dependencies { frames: true, ..Dependencies::default() }
    }

    /// Joints whose reactions are asked for.
    pub(in crate::mechanics) fn reactions(&self) -> &[JointId] {
        &self.reactions
    }

    /// `Fixed` joints whose reactions are asked for.
    pub(in crate::mechanics) fn kept(&self, model: &Model) -> Vec<JointId> {
        let fixed = |id: &JointId| model.joints.get(id.0).is_some_and(|joint| joint.kind.freedoms() == 0);
        self.reactions.iter().copied().filter(fixed).collect()
    }
}
