//! Stage `symbolic`: ways through the graph.
//!
//! In: a graph and some of its nodes. Out: what they read, in an order in which operands stand before users, and which
//! of it depends on given symbols. Nodes are made in such an order, so nothing here recurses.

use super::graph::{AnyNode, Graph, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// Of so many nodes less than one is found: then sorting takes less time than looking at all.
const SCATTERED: usize = 16;

/// One truth per node.
pub(crate) struct Marks {
    scalars: Vec<bool>,
    vectors: Vec<bool>,
    rotations: Vec<bool>,
}

impl Marks {
    fn new(g: &Graph) -> Marks {
        Marks {
            scalars: vec![false; g.scalars.len()],
            vectors: vec![false; g.vectors.len()],
            rotations: vec![false; g.rotations.len()],
        }
    }

    fn list(&self, node: AnyNode) -> (&[bool], usize) {
        match node {
            AnyNode::Scalar(i) => (&self.scalars, i),
            AnyNode::Vector(i) => (&self.vectors, i),
            AnyNode::Rotation(i) => (&self.rotations, i),
        }
    }

    /// Nodes that were made later have no mark.
    pub(crate) fn has(&self, node: AnyNode) -> bool {
        let (list, i) = self.list(node);
        list.get(i).copied().unwrap_or(false)
    }

    fn set(&mut self, node: AnyNode) {
        let (list, i) = match node {
            AnyNode::Scalar(i) => (&mut self.scalars, i),
            AnyNode::Vector(i) => (&mut self.vectors, i),
            AnyNode::Rotation(i) => (&mut self.rotations, i),
        };
        list[i] = true;
    }
}

impl Graph {
    /// What a node reads, block by block where it is the output of one.
    pub(in crate::symbolic) fn each_operand(&self, node: AnyNode, visit: &mut dyn FnMut(AnyNode)) {
        let scalar = |s: &Scalar| AnyNode::Scalar(s.index());
        let vector = |v: &Vector| AnyNode::Vector(v.index());
        let rotation = |r: &Rotation| AnyNode::Rotation(r.index());
        match node {
            AnyNode::Scalar(i) => match &self.scalars[i] {
                ScalarNode::Literal(_) | ScalarNode::Symbol(_) => {}
                ScalarNode::Sum(list) | ScalarNode::Product(list) | ScalarNode::Call(_, list) => {
                    list.iter().map(scalar).for_each(visit);
                }
                ScalarNode::Reciprocal(x) | ScalarNode::Sqrt(x) | ScalarNode::Sin(x) | ScalarNode::Cos(x) => {
                    visit(scalar(x));
                }
                ScalarNode::Angle(c, s) => [c, s].map(scalar).into_iter().for_each(visit),
                ScalarNode::Output(id, _) => self.blocks[id.0].operands.iter().map(scalar).for_each(visit),
                ScalarNode::Component(v, _) => visit(vector(v)),
                ScalarNode::Dot(a, b) => [a, b].map(vector).into_iter().for_each(visit),
            },
            AnyNode::Vector(i) => match &self.vectors[i] {
                VectorNode::Triple(list) => list.iter().map(scalar).for_each(visit),
                VectorNode::Sum(list) => list.iter().map(vector).for_each(visit),
                VectorNode::Scale(s, v) => [scalar(s), vector(v)].into_iter().for_each(visit),
                VectorNode::Cross(a, b) => [a, b].map(vector).into_iter().for_each(visit),
                VectorNode::Rotate(r, v) => [rotation(r), vector(v)].into_iter().for_each(visit),
            },
            AnyNode::Rotation(i) => match &self.rotations[i] {
                RotationNode::Identity => {}
                RotationNode::Axis(_, angle) => visit(scalar(angle)),
                RotationNode::Matrix(rows) => rows.iter().flatten().map(scalar).for_each(visit),
                RotationNode::Quaternion(q) => q.iter().map(scalar).for_each(visit),
                RotationNode::Product(a, b) => [a, b].map(rotation).into_iter().for_each(visit),
            },
        }
    }

    /// These nodes and all that they need, operands before users.
    pub(super) fn reachable_from(&self, roots: impl IntoIterator<Item = AnyNode>) -> Vec<AnyNode> {
        let mut needed = Marks::new(self);
        let mut above_blocks = vec![false; self.blocks.len()];
        let mut found: Vec<AnyNode> = Vec::new();
        let mut stack: Vec<AnyNode> = roots.into_iter().collect();
        while let Some(node) = stack.pop() {
            if needed.has(node) {
                continue;
            }
            needed.set(node);
            found.push(node);
            // The operands of a block are many: once is enough.
            if let AnyNode::Scalar(i) = node
                && let ScalarNode::Output(id, _) = self.scalars[i]
                && std::mem::replace(&mut above_blocks[id.0], true)
            {
                continue;
            }
            self.each_operand(node, &mut |operand| stack.push(operand));
        }
        // Nodes are numbered as they are made, operands before users. Those of one function stand together, as a rule.
        let positions = || found.iter().map(|&node| self.position(node) as usize);
        let (Some(least), Some(most)) = (positions().min(), positions().max()) else { return found };
        if found.len() * SCATTERED < most - least {
            found.sort_unstable_by_key(|&node| self.position(node));
            return found;
        }
        self.order[least..=most].iter().copied().filter(|&node| needed.has(node)).collect()
    }

    /// All nodes that these scalars need, operands before users.
    pub(crate) fn reachable(&self, roots: &[Scalar]) -> Vec<AnyNode> {
        self.reachable_from(roots.iter().map(|root| AnyNode::Scalar(root.index())))
    }

    /// Whether the scalar at this place is one result of a block.
    pub(crate) fn is_output(&self, index: usize) -> bool {
        matches!(self.scalars[index], ScalarNode::Output(..))
    }

    /// Positions of all scalars that these need, operands before users.
    pub fn reachable_scalars(&self, roots: &[Scalar]) -> Vec<usize> {
        let scalar = |node| match node {
            AnyNode::Scalar(index) => Some(index),
            _ => None,
        };
        self.reachable(roots).into_iter().filter_map(scalar).collect()
    }

    /// Which of these nodes, given operands before users, read one of the symbols, themselves included.
    pub(crate) fn depending(&self, nodes: &[AnyNode], symbols: impl IntoIterator<Item = Scalar>) -> Marks {
        let mut marks = Marks::new(self);
        symbols.into_iter().for_each(|s| marks.set(AnyNode::Scalar(s.index())));
        for &node in nodes {
            let mut depends = false;
            self.each_operand(node, &mut |operand| depends |= marks.has(operand));
            if depends {
                marks.set(node);
            }
        }
        marks
    }

    /// Which of these scalars are used more than once.
    pub fn shared(&self, reachable: &[usize], roots: &[Scalar]) -> Vec<bool> {
        let mut uses = vec![0_u8; self.scalars.len()];
        let mut seen = vec![false; self.blocks.len()];
        let mut count = |i: usize| uses[i] = uses[i].saturating_add(1);
        for &index in reachable {
            if let ScalarNode::Output(id, _) = self.scalars[index]
                && std::mem::replace(&mut seen[id.0], true)
            {
                continue;
            }
            self.each_operand(AnyNode::Scalar(index), &mut |operand| {
                if let AnyNode::Scalar(i) = operand {
                    count(i);
                }
            });
        }
        roots.iter().for_each(|root| count(root.index()));
        uses.iter().map(|&n| n > 1).collect()
    }

    /// The handle of the scalar at a position.
    pub fn scalar_at(&self, index: usize) -> Scalar {
        Scalar::new(index, false)
    }
}
