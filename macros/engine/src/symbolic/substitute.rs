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

use super::graph::{
    AnyNode, Graph, PlaceMap, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector, VectorNode,
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

/// One replacement of symbols, shared by all that is asked for.
pub struct Substitution {
    symbols: Vec<Scalar>,
    scalars: PlaceMap<Scalar>,
    vectors: PlaceMap<Vector>,
    rotations: PlaceMap<Rotation>,
}

impl Substitution {
    /// Symbols that the graph doesn't have are left out.
    pub fn new(g: &Graph, map: &HashMap<SymbolId, Scalar>) -> Substitution {
        let scalars: PlaceMap<Scalar> =
            map.iter().filter_map(|(&id, &by)| Some((g.symbol_handle(id)?.index(), by))).collect();
        let symbols = scalars.keys().map(|&index| Scalar::new(index, false)).collect();
        Substitution { symbols, scalars, vectors: PlaceMap::default(), rotations: PlaceMap::default() }
    }

    /// In place of any scalars, not of symbols alone.
    pub fn of_nodes(list: &[(Scalar, Scalar)]) -> Substitution {
        let entry = |&(node, by): &(Scalar, Scalar)| (node.index(), if node.is_negative() { -by } else { by });
        let symbols = list.iter().map(|(node, _)| node.positive()).collect();
        Substitution {
            symbols,
            scalars: list.iter().map(entry).collect(),
            vectors: PlaceMap::default(),
            rotations: PlaceMap::default(),
        }
    }

    pub fn scalars(&mut self, g: &mut Graph, roots: &[Scalar]) -> Vec<Scalar> {
        self.walk(g, roots.iter().map(|s| AnyNode::Scalar(s.index())));
        roots.iter().map(|&s| self.of(s)).collect()
    }

    pub fn vectors(&mut self, g: &mut Graph, roots: &[Vector]) -> Vec<Vector> {
        self.walk(g, roots.iter().map(|v| AnyNode::Vector(v.index())));
        roots.iter().map(|&v| self.of_vector(v)).collect()
    }

    pub fn rotations(&mut self, g: &mut Graph, roots: &[Rotation]) -> Vec<Rotation> {
        self.walk(g, roots.iter().map(|r| AnyNode::Rotation(r.index())));
        roots.iter().map(|&r| self.of_rotation(r)).collect()
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
            if !depends.has(node) {
                continue;
            }
            match node {
                AnyNode::Scalar(i) if !self.scalars.contains_key(&i) => {
                    let made = self.scalar(g, i);
                    if let Some(name) = g.name_of(Scalar::new(i, false)).cloned() {
                        g.name_like(made, &name);
                    }
                    self.scalars.insert(i, made);
                }
                AnyNode::Vector(i) if !self.vectors.contains_key(&i) => {
                    let made = self.vector(g, i);
                    if let Some(name) = g.vector_name_of(Vector::new(i, false)).cloned() {
                        g.name_vector_like(made, &name);
                    }
                    self.vectors.insert(i, made);
                }
                AnyNode::Rotation(i) if !self.rotations.contains_key(&i) => {
                    let made = self.rotation(g, i);
                    self.rotations.insert(i, made);
                }
                _ => {}
            }
        }
    }

    fn of(&self, s: Scalar) -> Scalar {
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

    fn scalar(&self, g: &mut Graph, index: usize) -> Scalar {
        let s = Scalar::new(index, false);
        match g.node(s).clone() {
            ScalarNode::Literal(_) | ScalarNode::Symbol(_) => s,
            ScalarNode::Sum(terms) => g.sum(&self.all(&terms)),
            ScalarNode::Product(factors) => g.product(&self.all(&factors)),
            ScalarNode::Reciprocal(x) => g.reciprocal(self.of(x)),
            ScalarNode::Sqrt(x) => g.sqrt(self.of(x)),
            ScalarNode::Sin(x) => g.sin(self.of(x)),
            ScalarNode::Cos(x) => g.cos(self.of(x)),
            ScalarNode::Call(call, list) => g.call(call, &self.all(&list)),
            ScalarNode::Angle(cos, sin) => g.angle(self.of(cos), self.of(sin)),
            ScalarNode::Output(id, k) => {
                let block = g.block(id).clone();
                let outputs = g.block_outputs(block.kind, &self.all(&block.operands));
                outputs[k]
            }
            ScalarNode::Component(v, axis) => g.component(self.of_vector(v), axis),
            ScalarNode::Dot(a, b) => g.dot(self.of_vector(a), self.of_vector(b)),
        }
    }

    fn vector(&self, g: &mut Graph, index: usize) -> Vector {
        match g.vector_node(Vector::new(index, false)).clone() {
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

    fn rotation(&self, g: &mut Graph, index: usize) -> Rotation {
        let r = Rotation::new(index, false);
        match g.rotation_node(r).clone() {
            RotationNode::Identity => r,
            RotationNode::Axis(axis, angle) => g.axis_rotation(axis, self.of(angle)),
            RotationNode::Matrix(rows) => g.matrix_rotation(rows.map(|row| row.map(|s| self.of(s)))),
            RotationNode::Quaternion(q) => g.quaternion_rotation(q.map(|s| self.of(s))),
            RotationNode::Product(a, b) => g.compose(self.of_rotation(a), self.of_rotation(b)),
        }
    }
}
