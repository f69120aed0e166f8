//! Stage `symbolic`: expressions in place of symbols.
//!
//! In: nodes of a graph, and an expression on the same graph for each symbol that gives way. Out: the same nodes with
//! the expressions in the symbols' places, all at once: an expression may hold the symbol that it replaces. Every node is
//! made anew once, operands before users; what doesn't depend on the symbols stays the node it is. Vectors stay vectors
//! and rotations rotations: turning about an axis by a symbol becomes turning about it by the new angle. Names go along.
//!
//! The four symbols of a unit quaternion must give way together, to what is a unit quaternion again: nodes were merged by
//! its equation. The unknowns of an iteration are its own; they can't be replaced.

use std::collections::HashMap;

use crate::invariant::fault::{OrFault, raise};

use super::graph::{
    AnyNode, Block, BlockId, Graph, Name, PlaceMap, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector,
    VectorNode,
};

use super::walk::Marks;

impl Graph {
    /// Scalars with expressions in place of symbols.
    pub fn substitute(&mut self, roots: &[Scalar], map: &HashMap<SymbolId, Scalar>) -> Vec<Scalar> {
        Substitution::new(self, map).scalars(self, roots)
    }

    /// The symbol that a scalar is.
    pub fn symbol_id(&self, s: Scalar) -> Option<SymbolId> {
        match *self.node(s) {
            ScalarNode::Symbol(id) => Some(id),
            _ => None,
        }
    }
}

/// What stands for nodes in a graph: others of it, or those of another graph.
#[derive(Default)]
pub(super) struct Images {
    pub(super) scalars: PlaceMap<Scalar>,
    vectors: PlaceMap<Vector>,
    rotations: PlaceMap<Rotation>,
    blocks: HashMap<BlockId, Vec<Scalar>>,
    /// Behind the names of what has another value than what it is the image of.
    word: Option<&'static str>,
}

/// One replacement of symbols, shared by all that is asked for.
pub struct Substitution {
    symbols: Vec<Scalar>,
    images: Images,
}

impl Substitution {
    /// Symbols that the graph doesn't have are left out.
    pub fn new(g: &Graph, map: &HashMap<SymbolId, Scalar>) -> Substitution {
        let scalars: PlaceMap<Scalar> =
            map.iter().filter_map(|(&id, &by)| Some((g.symbol_handle(id)?.index(), by))).collect();
        let symbols = scalars.keys().map(|&index| Scalar::new(index, false)).collect();
        Substitution { symbols, images: Images { scalars, ..Images::default() } }
    }

    /// In place of any scalars, not of symbols alone.
    pub fn of_nodes(list: &[(Scalar, Scalar)]) -> Substitution {
        let entry = |&(node, by): &(Scalar, Scalar)| (node.index(), if node.is_negative() { -by } else { by });
        let symbols = list.iter().map(|(node, _)| node.positive()).collect();
        let scalars = list.iter().map(entry).collect();
        Substitution { symbols, images: Images { scalars, ..Images::default() } }
    }

    pub fn scalars(&mut self, g: &mut Graph, roots: &[Scalar]) -> Vec<Scalar> {
        self.walk(g, roots.iter().map(|s| AnyNode::Scalar(s.index())));
        roots.iter().map(|&s| self.images.of(s)).collect()
    }

    pub fn vectors(&mut self, g: &mut Graph, roots: &[Vector]) -> Vec<Vector> {
        self.walk(g, roots.iter().map(|v| AnyNode::Vector(v.index())));
        roots.iter().map(|&v| self.images.of_vector(v)).collect()
    }

    pub fn rotations(&mut self, g: &mut Graph, roots: &[Rotation]) -> Vec<Rotation> {
        self.walk(g, roots.iter().map(|r| AnyNode::Rotation(r.index())));
        roots.iter().map(|&r| self.images.of_rotation(r)).collect()
    }

    /// Makes anew what depends on the symbols and hasn't been made.
    fn walk(&mut self, g: &mut Graph, roots: impl Iterator<Item = AnyNode>) {
        let nodes = g.reachable_from(roots);
        let depends = g.depending(&nodes, self.symbols.iter().copied());
        let replaced = self.symbols.iter().fold(0, |marks, s| marks | g.reads(AnyNode::Scalar(s.index())));
        let before = std::mem::replace(&mut g.shunned, replaced);
        self.make(g, nodes, &depends);
        g.shunned = before;
    }

    fn make(&mut self, g: &mut Graph, nodes: Vec<AnyNode>, depends: &Marks) {
        for node in nodes {
            if depends.has(node) && !self.images.has(node) {
                self.images.make(g, node, None);
            }
        }
    }
}

impl Images {
    pub(super) fn with_word(word: Option<&'static str>) -> Images {
        Images { word, ..Images::default() }
    }

    pub(super) fn has(&self, node: AnyNode) -> bool {
        match node {
            AnyNode::Scalar(i) => self.scalars.contains_key(&i),
            AnyNode::Vector(i) => self.vectors.contains_key(&i),
            AnyNode::Rotation(i) => self.rotations.contains_key(&i),
        }
    }

    /// Makes the image of a node, of this graph or of another one, whose operands have theirs.
    pub(super) fn make(&mut self, g: &mut Graph, node: AnyNode, other: Option<&Graph>) {
        let from: &Graph = other.unwrap_or(g);
        match node {
            AnyNode::Scalar(i) => {
                let s = Scalar::new(i, false);
                let (node, name) = (from.node(s).clone(), from.name_of(s).cloned());
                if other.is_some() && matches!(node, ScalarNode::Symbol(_)) {
                    raise("symbols of another graph have their images");
                }
                // Its outputs are made in one go: a block of n unknowns reads n^2 scalars.
                let block = match node {
                    ScalarNode::Output(id, _) if !self.blocks.contains_key(&id) => Some(from.block(id).clone()),
                    _ => None,
                };
                let print = from.print(s);
                let made = self.scalar(g, s, node, block);
                if let Some(name) = name {
                    g.name_like(made, &self.named(name, g.print(made) == print));
                }
                self.scalars.insert(i, made);
            }
            AnyNode::Vector(i) => {
                let v = Vector::new(i, false);
                let (node, name) = (from.vector_node(v).clone(), from.vector_name_of(v).cloned());
                let print = from.vector_print(v);
                let made = self.vector(g, node);
                if let Some(name) = name {
                    g.name_vector_like(made, &self.named(name, g.vector_print(made) == print));
                }
                self.vectors.insert(i, made);
            }
            AnyNode::Rotation(i) => {
                let node = from.rotation_node(Rotation::new(i, false)).clone();
                let made = self.rotation(g, node);
                self.rotations.insert(i, made);
            }
        }
    }

    fn named(&self, name: Name, same: bool) -> Name {
        match self.word.filter(|_| !same) {
            Some(word) => Name { text: format!("{}_{word}", name.text), ..name },
            None => name,
        }
    }

    pub(super) fn of(&self, s: Scalar) -> Scalar {
        match self.scalars.get(&s.index()) {
            Some(&by) if s.is_negative() => -by,
            Some(&by) => by,
            None => s,
        }
    }

    fn of_vector(&self, v: Vector) -> Vector {
        match self.vectors.get(&v.index()) {
            Some(&by) if v.is_negative() => -by,
            Some(&by) => by,
            None => v,
        }
    }

    fn of_rotation(&self, r: Rotation) -> Rotation {
        match self.rotations.get(&r.index()) {
            Some(&by) if r.is_transposed() => by.transpose(),
            Some(&by) => by,
            None => r,
        }
    }

    fn all(&self, list: &[Scalar]) -> Vec<Scalar> {
        list.iter().map(|&s| self.of(s)).collect()
    }

    fn scalar(&mut self, g: &mut Graph, s: Scalar, node: ScalarNode, block: Option<Block>) -> Scalar {
        match node {
            ScalarNode::Literal(number) => g.number(number),
            ScalarNode::Symbol(_) => s,
            ScalarNode::Sum(terms) => g.sum(&self.all(&terms)),
            ScalarNode::Product(factors) => g.product(&self.all(&factors)),
            ScalarNode::Reciprocal(x) => g.reciprocal(self.of(x)),
            ScalarNode::Sqrt(x) => g.sqrt(self.of(x)),
            ScalarNode::Sin(x) => g.sin(self.of(x)),
            ScalarNode::Cos(x) => g.cos(self.of(x)),
            ScalarNode::Call(call, list) => g.call(call, &self.all(&list)),
            ScalarNode::Angle(cos, sin) => g.angle(self.of(cos), self.of(sin)),
            ScalarNode::Output(id, k) => {
                if let Some(block) = block {
                    let outputs = g.block_outputs(block.kind, &self.all(&block.operands));
                    self.blocks.insert(id, outputs);
                }
                self.blocks.get(&id).or_fault("an output is one of its block")[k]
            }
            ScalarNode::Component(v, axis) => g.component(self.of_vector(v), axis),
            ScalarNode::Dot(a, b) => g.dot(self.of_vector(a), self.of_vector(b)),
        }
    }

    fn vector(&self, g: &mut Graph, node: VectorNode) -> Vector {
        match node {
            VectorNode::Triple(components) => g.vector(components.map(|c| self.of(c))),
            VectorNode::Sum(terms) => {
                let terms: Vec<Vector> = terms.iter().map(|&t| self.of_vector(t)).collect();
                g.sum_vectors(&terms)
            }
            VectorNode::Scale(s, v) => g.scale(self.of(s), self.of_vector(v)),
            VectorNode::Cross(a, b) => g.cross(self.of_vector(a), self.of_vector(b)),
            VectorNode::Rotate(r, v) => g.rotate(self.of_rotation(r), self.of_vector(v)),
        }
    }

    fn rotation(&self, g: &mut Graph, node: RotationNode) -> Rotation {
        match node {
            RotationNode::Identity => Rotation::IDENTITY,
            RotationNode::Axis(axis, angle) => g.axis_rotation(axis, self.of(angle)),
            RotationNode::Matrix(rows) => g.matrix_rotation(rows.map(|row| row.map(|s| self.of(s)))),
            RotationNode::Quaternion(q) => g.quaternion_rotation(q.map(|s| self.of(s))),
            RotationNode::Product(a, b) => g.compose(self.of_rotation(a), self.of_rotation(b)),
        }
    }
}
