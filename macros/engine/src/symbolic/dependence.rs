//! Stage `symbolic`: which symbols an expression depends on.
//!
//! In: scalars, symbols. Out: yes or no. A value in which a symbol cancels was found out when its node was made, so what is
//! reachable is what matters.

use super::graph::{AnyNode, Graph, Scalar};

impl Graph {
    /// Whether a scalar depends on any of these symbols.
    pub fn depends_on(&self, s: Scalar, symbols: &[Scalar]) -> bool {
        let reachable = self.reachable(&[s]);
        let is_one = |index: usize| symbols.iter().any(|symbol| symbol.index() == index && *symbol != Scalar::ZERO);
        reachable.iter().any(|node| matches!(node, AnyNode::Scalar(index) if is_one(*index)))
    }
}
