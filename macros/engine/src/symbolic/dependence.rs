//! Stage `symbolic`: which symbols an expression depends on.
//!
//! In: scalars or vectors, symbols. Out: yes or no. A value in which a symbol cancels was found out when its node was made, so what is
//! reachable is what matters.

use crate::contracts::call::{Call, ExternalId};

use super::graph::{AnyNode, Graph, Scalar, ScalarNode, Vector};

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

    /// A function of the user's own Rust of which one of these scalars needs slopes of slopes.
    pub fn curvature(&self, roots: &[Scalar]) -> Option<ExternalId> {
        self.first_call(roots, |call| match call {
            Call::ExternalCurvature(function) => Some(function),
            _ => None,
        })
    }

    /// A function of the user's own Rust that one of these scalars calls, or takes a slope of.
    pub fn external(&self, roots: &[Scalar]) -> Option<ExternalId> {
        self.first_call(roots, Call::external)
    }

    fn first_call(&self, roots: &[Scalar], find: impl Fn(Call) -> Option<ExternalId>) -> Option<ExternalId> {
        self.reachable(roots).into_iter().find_map(|node| match node {
            AnyNode::Scalar(index) => match self.node(self.scalar_at(index)) {
                ScalarNode::Call(call, _) => find(*call),
                _ => None,
            },
            _ => None,
        })
    }
}
