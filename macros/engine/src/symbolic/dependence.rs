//! Stage `symbolic`: which symbols an expression depends on.
//!
//! In: scalars or vectors, symbols. Out: yes or no. A value in which a symbol cancels was found out when its node was made, so what is
//! reachable is what matters.

use super::graph::{AnyNode, Graph, Scalar, Vector};

impl Graph {
    /// Whether a scalar depends on any of these symbols.
    pub fn depends_on(&self, s: Scalar, symbols: &[Scalar]) -> bool {
        self.read_by(&[s], symbols).contains(&true)
    }

    /// By symbol: whether any of these scalars depends on it.
    pub fn read_by(&self, roots: &[Scalar], symbols: &[Scalar]) -> Vec<bool> {
        self.read_by_nodes(roots.iter().map(|root| AnyNode::Scalar(root.index())), symbols)
    }

    /// By symbol: whether any of these vectors depends on it.
    pub fn read_by_vectors(&self, roots: &[Vector], symbols: &[Scalar]) -> Vec<bool> {
        self.read_by_nodes(roots.iter().map(|root| AnyNode::Vector(root.index())), symbols)
    }

    fn read_by_nodes(&self, roots: impl Iterator<Item = AnyNode>, symbols: &[Scalar]) -> Vec<bool> {
        let mut read = vec![false; symbols.len()];
        for node in self.reachable_from(roots) {
            let AnyNode::Scalar(index) = node else { continue };
            for (read, symbol) in read.iter_mut().zip(symbols) {
                *read |= symbol.index() == index && *symbol != Scalar::ZERO;
            }
        }
        read
    }
}
