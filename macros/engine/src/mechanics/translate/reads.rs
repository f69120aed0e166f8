//! Stage `mechanics`: what of a mechanism an expression reads, for pictures of it.
//!
//! In: an expression. Out: the joints whose coordinates, and the frames whose motion, stand in it, each once.

use std::collections::HashSet;
use std::rc::Rc;

use crate::model::types::{BodyRef, Expr, ExprNode, Frame, JointId};

/// What an expression reads.
#[derive(Clone, Default)]
pub struct Reads {
    pub joints: Vec<JointId>,
    pub frames: Vec<Frame>,
}

impl Reads {
    pub fn of<'m>(roots: impl IntoIterator<Item = &'m Expr>) -> Reads {
        let mut reads = Reads::default();
        let mut seen = HashSet::new();
        let mut stack: Vec<&Expr> = roots.into_iter().collect();
        while let Some(expr) = stack.pop() {
            if !seen.insert(Rc::as_ptr(&expr.node)) {
                continue;
            }
            match &*expr.node {
                ExprNode::Coordinate { joint, .. } if !reads.joints.contains(joint) => reads.joints.push(*joint),
                ExprNode::OfFrame(frame, _) => reads.frames.push(frame.clone()),
                _ => {}
            }
            stack.extend(expr.node.operands());
        }
        reads.joints.sort_unstable();
        reads
    }

    /// The bodies of the frames, the ground among them, each once.
    pub fn bodies(&self) -> Vec<BodyRef> {
        let mut bodies = Vec::new();
        for frame in &self.frames {
            if !bodies.contains(&frame.body) {
                bodies.push(frame.body);
            }
        }
        bodies
    }
}
