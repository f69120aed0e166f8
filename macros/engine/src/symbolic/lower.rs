//! Stage `symbolic`: vectors and rotations become scalars.
//!
//! In: a graph and the scalars that are wanted of it. Out: a new graph of scalars alone, in which only what these need
//! has been made. A rotation about a coordinate axis turns two components (4 products, 2 sums); a product of rotations
//! is applied factor by factor, which costs less than its matrix unless many vectors pass through it; zeros vanish on
//! the way since the constructors see them.

use std::collections::HashMap;

use crate::invariant::fault::OrFault;
use crate::invariant::injection::{Break, broken};

use super::graph::{
    AnyNode, BlockId, BlockKind, Graph, Name, PlaceMap, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector,
    VectorNode,
};
use super::sparse_factors::{Purpose, SparseFactors, expressions};
use crate::contracts::call::Call;

/// A system that would make a function larger than so many expressions is not written out, but solved by the runtime: one of
/// about twenty unknowns in which each equation reads all.
const MOST_WRITTEN: usize = 45_000;

/// Copies expressions of one graph into another, as scalars.
pub struct Lowering<'g> {
    from: &'g Graph,
    pub to: Graph,
    scalars: PlaceMap<Scalar>,
    vectors: PlaceMap<[Scalar; 3]>,
    matrices: PlaceMap<[[Scalar; 3]; 3]>,
    blocks: HashMap<BlockId, Vec<Scalar>>,
    /// By matrix, and whether its solutions have to be no numbers where it is singular.
    factors: HashMap<(bool, Box<[Scalar]>), SparseFactors>,
}

impl<'g> Lowering<'g> {
    /// `to` must have the symbols of `from`, made in the same order.
    pub fn new(from: &'g Graph) -> Self {
        Lowering::onto(from, from.empty_copy())
    }

    /// Into a graph that has some expressions already: what has their values is found.
    pub fn onto(from: &'g Graph, to: Graph) -> Self {
        Lowering {
            from,
            to,
            scalars: PlaceMap::default(),
            vectors: PlaceMap::default(),
            matrices: PlaceMap::default(),
            blocks: HashMap::new(),
            factors: HashMap::new(),
        }
    }

    /// Lowers these scalars, operands before users, so that no recursion is deep.
    pub fn run(&mut self, roots: &[Scalar]) -> Vec<Scalar> {
        for node in self.from.reachable(roots) {
            match node {
                AnyNode::Scalar(index) => drop(self.scalar(Scalar::new(index, false))),
                AnyNode::Vector(index) => drop(self.vector(Vector::new(index, false))),
                AnyNode::Rotation(_) => {}
            }
        }
        roots.iter().map(|&root| self.scalar(root)).collect()
    }

    fn scalar(&mut self, s: Scalar) -> Scalar {
        let value = match self.scalars.get(&s.index()) {
            Some(&value) => value,
            None => {
                let value = self.node(s.positive());
                if let Some(name) = self.from.name_of(s) {
                    self.to.name_like(value, name);
                }
                self.scalars.insert(s.index(), value);
                value
            }
        };
        value.flip_if(s.is_negative())
    }

    fn node(&mut self, s: Scalar) -> Scalar {
        let from = self.from;
        match from.node(s) {
            ScalarNode::Literal(n) => self.to.number(*n),
            ScalarNode::Symbol(id) => {
                let handle = self.to.symbol_handle(*id).filter(|_| !broken(Break::LoweredSymbol));
                handle.or_fault("the lowered graph has the symbols of the graph that is lowered")
            }
            ScalarNode::Sum(terms) => {
                let terms: Vec<Scalar> = terms.iter().map(|&t| self.scalar(t)).collect();
                self.to.sum(&terms)
            }
            ScalarNode::Product(factors) => {
                let factors: Vec<Scalar> = factors.iter().map(|&f| self.scalar(f)).collect();
                self.to.product(&factors)
            }
            ScalarNode::Reciprocal(x) => {
                let x = self.scalar(*x);
                self.to.reciprocal(x)
            }
            ScalarNode::Sqrt(x) => {
                let x = self.scalar(*x);
                self.to.sqrt(x)
            }
            ScalarNode::Sin(angle) => {
                let angle = self.scalar(*angle);
                self.to.sin(angle)
            }
            ScalarNode::Cos(angle) => {
                let angle = self.scalar(*angle);
                self.to.cos(angle)
            }
            ScalarNode::Call(call, arguments) => {
                let arguments: Vec<Scalar> = arguments.iter().map(|&a| self.scalar(a)).collect();
                self.to.call(*call, &arguments)
            }
            ScalarNode::Angle(c, s) => {
                let (c, s) = (self.scalar(*c), self.scalar(*s));
                self.to.angle(c, s)
            }
            ScalarNode::Output(id, k) => {
                let block = from.block(*id);
                if let Some(outputs) = self.blocks.get(id) {
                    return outputs[*k];
                }
                let operands: Vec<Scalar> = block.operands.iter().map(|&s| self.scalar(s)).collect();
                let outputs = match block.kind {
                    BlockKind::Eliminate { size, strict } => self.eliminate(size, strict, &operands),
                    _ => self.to.block_outputs(block.kind.clone(), &operands),
                };
                let output = outputs[*k];
                self.blocks.insert(*id, outputs);
                output
            }
            ScalarNode::Component(v, axis) => self.vector(*v)[*axis],
            ScalarNode::Dot(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                self.dot(&a, &b)
            }
        }
    }

    fn eliminate(&mut self, size: usize, strict: bool, operands: &[Scalar]) -> Vec<Scalar> {
        let (matrix, side) = operands.split_at(size * size);
        let to = &mut self.to;
        let key = (strict, matrix.into());
        if !self.factors.contains_key(&key) {
            if to.len() + expressions(size, matrix) > MOST_WRITTEN {
                let kind = BlockKind::Solve { size, symmetric: false, groups: Box::default() };
                let mut unknowns = to.block_outputs(kind, operands);
                let rank = unknowns.split_off(size);
                return if strict { known(to, size, &rank, unknowns) } else { unknowns };
            }
            let purpose = if strict { Purpose::Regular } else { Purpose::Solutions };
            let factors = SparseFactors::of(to, size, matrix, purpose);
            self.factors.insert(key.clone(), factors);
        }
        self.factors[&key].solve(to, side)
    }

    fn dot(&mut self, a: &[Scalar; 3], b: &[Scalar; 3]) -> Scalar {
        let products = [0, 1, 2].map(|k| self.to.mul(a[k], b[k]));
        self.to.sum(&products)
    }

    fn vector(&mut self, v: Vector) -> [Scalar; 3] {
        let value = match self.vectors.get(&v.index()) {
            Some(&value) => value,
            None => {
                let value = self.vector_node(v);
                if let Some(name) = self.from.vector_name_of(v) {
                    for (axis, c) in ["x", "y", "z"].iter().zip(value) {
                        self.to.name_like(c, &Name { text: format!("{}_{axis}", name.text), ..name.clone() });
                    }
                }
                self.vectors.insert(v.index(), value);
                value
            }
        };
        value.map(|c| c.flip_if(v.is_negative()))
    }

    fn vector_node(&mut self, v: Vector) -> [Scalar; 3] {
        let from = self.from;
        match from.vector_node(v) {
            VectorNode::Triple(components) => components.map(|c| self.scalar(c)),
            VectorNode::Sum(terms) => {
                let terms: Vec<[Scalar; 3]> = terms.iter().map(|&t| self.vector(t)).collect();
                [0, 1, 2].map(|k| {
                    let column: Vec<Scalar> = terms.iter().map(|t| t[k]).collect();
                    self.to.sum(&column)
                })
            }
            VectorNode::Scale(s, v) => {
                let (s, v) = (self.scalar(*s), self.vector(*v));
                v.map(|c| self.to.mul(s, c))
            }
            VectorNode::Cross(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                [0, 1, 2].map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let plus = self.to.mul(a[j], b[k]);
                    let minus = self.to.mul(a[k], b[j]);
                    self.to.sub(plus, minus)
                })
            }
            VectorNode::Rotate(r, v) => {
                let v = self.vector(*v);
                self.rotate(*r, v)
            }
        }
    }

    fn rotate(&mut self, r: Rotation, v: [Scalar; 3]) -> [Scalar; 3] {
        match *self.from.rotation_node(r) {
            RotationNode::Identity => v,
            RotationNode::Axis(axis, angle) => {
                let angle = self.scalar(angle);
                let (c, s) = (self.to.cos(angle), self.to.sin(angle));
                let s = s.flip_if(r.is_transposed() && s != Scalar::ZERO);
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut turned = v;
                let (a, b) = (self.to.mul(c, v[j]), self.to.mul(s, v[k]));
                turned[j] = self.to.sub(a, b);
                let (a, b) = (self.to.mul(s, v[j]), self.to.mul(c, v[k]));
                turned[k] = self.to.add(a, b);
                turned
            }
            RotationNode::Product(a, b) => {
                let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
                let inner = self.rotate(first, v);
                self.rotate(second, inner)
            }
            RotationNode::Matrix(_) | RotationNode::Quaternion(_) => {
                let m = self.matrix(r);
                [0, 1, 2].map(|i| {
                    let row = if r.is_transposed() { [m[0][i], m[1][i], m[2][i]] } else { m[i] };
                    self.dot(&row, &v)
                })
            }
        }
    }

    /// Entries of a matrix or quaternion, not transposed.
    fn matrix(&mut self, r: Rotation) -> [[Scalar; 3]; 3] {
        if let Some(&rows) = self.matrices.get(&r.index()) {
            return rows;
        }
        let rows = match self.from.rotation_node(r) {
            RotationNode::Quaternion(q) => {
                let q = q.map(|c| self.scalar(c));
                self.to.quaternion_rows(q)
            }
            RotationNode::Matrix(rows) => rows.clone().map(|row| row.map(|c| self.scalar(c))),
            _ => [[Scalar::ZERO; 3]; 3],
        };
        self.matrices.insert(r.index(), rows);
        rows
    }
}

impl Graph {
    /// A graph with the same symbols and nothing else.
    pub fn empty_copy(&self) -> Graph {
        let mut copy = Graph::new();
        copy.quaternions.clone_from(&self.quaternions);
        copy.circles.clone_from(&self.circles);
        copy.radicands.clone_from(&self.radicands);
        for &s in &self.symbols {
            let id = SymbolId(copy.symbols.len());
            let handle = copy.insert_scalar(ScalarNode::Symbol(id), self.prints[s.index()]);
            copy.symbols.push(handle);
        }
        copy
    }
}

/// Unknowns where the rank is full, else no numbers.
fn known(g: &mut Graph, size: usize, rank: &[Scalar], unknowns: Vec<Scalar>) -> Vec<Scalar> {
    let (full, none) = (g.integer(size as i64), g.call(Call::Nan, &[]));
    let short = rank.first().map(|&rank| g.call(Call::Less, &[rank, full]));
    let unknown = |x: Scalar| short.map_or(x, |short| g.call(Call::Select, &[short, none, x]));
    unknowns.into_iter().map(unknown).collect()
}
