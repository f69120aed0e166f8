//! Stage `symbolic`: expressions from one graph to another.
//!
//! In: nodes of a graph, and for each symbol that they read an expression of another graph. Out: the same expressions there.
//! Literals, vectors, rotations and names go along; blocks are made anew, but for iterations, whose unknowns are symbols of their
//! own graph.

use std::collections::HashMap;

use super::graph::{AnyNode, BlockKind, Graph, Scalar, ScalarNode, SymbolId};
use super::substitute::Images;

impl Graph {
    /// Expressions of another graph. A word is put behind the names of what comes out as another value, if there is one.
    pub fn transplant(
        &mut self,
        from: &Graph,
        roots: &[Scalar],
        put: &HashMap<SymbolId, Scalar>,
        word: Option<&'static str>,
    ) -> Vec<Scalar> {
        let mut images = Images::with_word(word);
        for (&id, &value) in put {
            images.scalars.extend(from.symbol_handle(id).map(|symbol| (symbol.index(), value)));
        }
        for node in from.reachable(roots) {
            if !images.has(node) {
                images.make(self, node, Some(from));
            }
        }
        roots.iter().map(|&root| images.of(root)).collect()
    }

    /// The symbols that expressions read; nothing where an iteration finds one of them.
    pub fn formula_symbols(&self, roots: &[Scalar]) -> Option<Vec<SymbolId>> {
        let mut symbols = Vec::new();
        for node in self.reachable(roots) {
            let AnyNode::Scalar(index) = node else { continue };
            match self.node(self.scalar_at(index)) {
                ScalarNode::Symbol(id) => symbols.push(*id),
                ScalarNode::Output(id, _) if matches!(self.block(*id).kind, BlockKind::Iterate { .. }) => return None,
                _ => {}
            }
        }
        Some(symbols)
    }
}
