//! Stage `symbolic`: operations that a set of expressions costs as it stands.
//!
//! In: a graph of scalars and its roots. Out: the [`Cost`] of evaluating every node once: an n-ary sum n - 1 additions,
//! an n-ary product n - 1 products, a reciprocal one quotient, sine and cosine of an angle one sincos, a
//! block what it does, and the body of an iteration once.

use crate::contracts::call::Call;
use crate::contracts::cost::Cost;

use super::graph::{AnyNode, Graph, Scalar, ScalarNode};

impl Graph {
    /// Cost of these scalars, shared work counted once. Vectors must have been lowered.
    pub fn cost(&self, roots: &[Scalar]) -> Cost {
        let mut cost = Cost::default();
        let mut angles = std::collections::HashSet::new();
        let mut blocks = std::collections::HashSet::new();
        for node in self.reachable(roots) {
            let AnyNode::Scalar(index) = node else { continue };
            match &self.scalars[index] {
                ScalarNode::Literal(_) | ScalarNode::Symbol(_) | ScalarNode::Component(..) | ScalarNode::Dot(..) => {}
                ScalarNode::Output(id, _) if blocks.insert(*id) => {
                    cost = cost.plus(Cost::of_block(&self.block(*id).kind))
                }
                ScalarNode::Output(..) => {}
                ScalarNode::Angle(..) => cost.other += 1,
                ScalarNode::Sum(terms) => cost.add += terms.len() as u32 - 1,
                ScalarNode::Product(factors) => cost.mul += factors.len() as u32 - 1,
                ScalarNode::Reciprocal(_) => cost.div += 1,
                ScalarNode::Sqrt(_) => cost.sqrt += 1,
                ScalarNode::Sin(angle) | ScalarNode::Cos(angle) => {
                    if angles.insert(*angle) {
                        cost.sincos += 1;
                    }
                }
                ScalarNode::Call(Call::Min | Call::Max | Call::Select, _) => cost.add += 1,
                ScalarNode::Call(Call::Epsilon | Call::Nan, _) => {}
                ScalarNode::Call(call, _) if call.is_comparison() => cost.compare += 1,
                ScalarNode::Call(..) => cost.other += 1,
            }
        }
        cost
    }
}
