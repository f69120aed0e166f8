//! Stage `verify`: derived equations as a list of elementary operations.
//!
//! In: a graph, vectors and all, and the roots of one function. Out: a [`Tape`]. It is made anew from the graph and asks no
//! print: what two stages have merged, factored or reordered since is compared with the operations that the derivation has
//! written down. Only what is multiplied by a literal zero is left out. The body of an iteration is a stretch of its own, with its
//! unknowns as places to be set.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{
    AnyNode, BlockId, BlockKind, Graph, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector, VectorNode,
};
use crate::symbolic::number::Number;

/// A node of the tape and a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge(u32);

impl Edge {
    const ZERO: Edge = Edge(0);
    const ONE: Edge = Edge(2);

    fn new(node: usize) -> Edge {
        Edge((node as u32) << 1)
    }

    pub(super) fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    pub(super) fn is_negative(self) -> bool {
        self.0 & 1 == 1
    }

    fn flip_if(self, flip: bool) -> Edge {
        if self.node() == 0 { self } else { Edge(self.0 ^ u32::from(flip)) }
    }

    fn positive(self) -> Edge {
        Edge(self.0 & !1)
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Op {
    Literal(Number),
    Symbol(SymbolId),
    /// Of an iteration; set from outside.
    Unknown,
    Sum,
    Product,
    Reciprocal,
    Sqrt,
    /// The sine of the same angle stands behind it.
    Cos,
    Sin,
    Call(Call),
    /// Solves the block with this number.
    Solve(usize),
    /// The block's body stands behind it.
    Enter(usize),
    /// Behind the body.
    Leave(usize),
    /// Of a block that stands before.
    Output(usize, usize),
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub op: Op,
    pub first: u32,
    pub last: u32,
}

/// Work with several results, see [`BlockKind`].
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub work: Work,
    pub operands: Vec<Edge>,
}

#[derive(Clone, Debug)]
pub(super) enum Work {
    Solve {
        size: usize,
        symmetric: bool,
        groups: Box<[usize]>,
    },
    /// Nodes of the unknowns and of the body.
    Iterate {
        unknowns: Vec<usize>,
        count: usize,
        body: (usize, usize),
    },
}

/// One function, operation by operation.
#[derive(Clone, Debug, Default)]
pub(super) struct Tape {
    pub nodes: Vec<Node>,
    pub operands: Vec<Edge>,
    pub blocks: Vec<Block>,
    pub roots: Vec<Edge>,
}

impl Tape {
    pub(super) fn new(graph: &Graph, roots: &[Scalar]) -> Tape {
        let mut writer = Writer { graph, tape: Tape::default(), known: Known::default() };
        writer.push(Op::Literal(Number::ZERO), &[]);
        writer.push(Op::Literal(Number::ONE), &[]);
        let nodes = graph.reachable(roots);
        writer.write(&nodes);
        let roots: Vec<Edge> = roots.iter().map(|&root| writer.scalar(root)).collect();
        let mut tape = writer.tape;
        tape.roots = roots;
        tape.prune();
        tape
    }

    pub(super) fn operands(&self, node: &Node) -> &[Edge] {
        &self.operands[node.first as usize..node.last as usize]
    }

    /// Leaves out what no root needs: bodies of iterations outside of these.
    fn prune(&mut self) {
        let mut alive = vec![false; self.nodes.len()];
        let mut blocks = vec![false; self.blocks.len()];
        alive[..2].fill(true);
        self.roots.iter().for_each(|root| alive[root.node()] = true);
        for at in (0..self.nodes.len()).rev() {
            let node = self.nodes[at];
            match node.op {
                Op::Solve(block) | Op::Leave(block) | Op::Enter(block) if blocks[block] => {
                    alive[at] = true;
                    if !matches!(node.op, Op::Enter(_)) {
                        self.blocks[block].operands.iter().for_each(|edge| alive[edge.node()] = true);
                    }
                    if let Work::Iterate { unknowns, .. } = &self.blocks[block].work {
                        unknowns.iter().for_each(|&node| alive[node] = true);
                    }
                }
                _ if !alive[at] => {}
                Op::Output(block, _) => blocks[block] = true,
                Op::Sin => alive[at - 1] = true,
                _ => {}
            }
            if alive[at] {
                self.operands(&node).to_vec().iter().for_each(|edge| alive[edge.node()] = true);
                // A sine stands behind its cosine.
                if matches!(node.op, Op::Cos) {
                    alive[at + 1] = true;
                }
            }
        }
        let mut place = vec![0_usize; self.nodes.len() + 1];
        let mut nodes = Vec::with_capacity(self.nodes.len());
        for (at, node) in self.nodes.iter().enumerate() {
            place[at] = nodes.len();
            if alive[at] {
                nodes.push(*node);
            }
        }
        if let Some(last) = place.last_mut() {
            *last = nodes.len();
        }
        let moved = |edge: &mut Edge| *edge = Edge::new(place[edge.node()]).flip_if(edge.is_negative());
        self.nodes = nodes;
        self.operands.iter_mut().for_each(moved);
        self.roots.iter_mut().for_each(moved);
        for block in &mut self.blocks {
            block.operands.iter_mut().for_each(moved);
            if let Work::Iterate { unknowns, body, .. } = &mut block.work {
                unknowns.iter_mut().for_each(|node| *node = place[*node]);
                *body = (place[body.0], place[body.1]);
            }
        }
    }
}

/// What has been written, by position in the graph.
#[derive(Default)]
struct Known {
    scalars: HashMap<usize, Edge>,
    vectors: HashMap<usize, [Edge; 3]>,
    matrices: HashMap<usize, [[Edge; 3]; 3]>,
    /// Cosine and sine of an angle.
    points: HashMap<usize, (Edge, Edge)>,
    blocks: HashMap<usize, usize>,
}

struct Writer<'g> {
    graph: &'g Graph,
    tape: Tape,
    known: Known,
}

impl Writer<'_> {
    fn push(&mut self, op: Op, operands: &[Edge]) -> Edge {
        let first = self.tape.operands.len() as u32;
        self.tape.operands.extend_from_slice(operands);
        self.tape.nodes.push(Node { op, first, last: self.tape.operands.len() as u32 });
        Edge::new(self.tape.nodes.len() - 1)
    }

    fn write(&mut self, nodes: &[AnyNode]) {
        for &node in nodes {
            match node {
                AnyNode::Scalar(index) => {
                    let edge = self.scalar_node(index);
                    self.known.scalars.insert(index, edge);
                }
                AnyNode::Vector(index) => {
                    let edges = self.vector_node(index);
                    self.known.vectors.insert(index, edges);
                }
                AnyNode::Rotation(_) => {}
            }
        }
    }

    fn scalar(&self, s: Scalar) -> Edge {
        let edge = self.known.scalars.get(&s.index()).or_fault("operands stand on the tape before their users");
        edge.flip_if(s.is_negative())
    }

    fn vector(&self, v: Vector) -> [Edge; 3] {
        let edges = self.known.vectors.get(&v.index()).or_fault("operands stand on the tape before their users");
        edges.map(|edge| edge.flip_if(v.is_negative()))
    }

    fn sum(&mut self, terms: &[Edge]) -> Edge {
        let terms: Vec<Edge> = terms.iter().copied().filter(|term| term.node() != 0).collect();
        match terms[..] {
            [] => Edge::ZERO,
            [single] => single,
            _ => self.push(Op::Sum, &terms),
        }
    }

    fn product(&mut self, factors: &[Edge]) -> Edge {
        if factors.iter().any(|factor| factor.node() == 0) {
            return Edge::ZERO;
        }
        let negative = factors.iter().filter(|factor| factor.is_negative()).count() % 2 == 1;
        let factors: Vec<Edge> =
            factors.iter().map(|factor| factor.positive()).filter(|&factor| factor != Edge::ONE).collect();
        let edge = match factors[..] {
            [] => Edge::ONE,
            [single] => single,
            _ => self.push(Op::Product, &factors),
        };
        edge.flip_if(negative)
    }

    /// Cosine and sine.
    fn point(&mut self, angle: Scalar) -> (Edge, Edge) {
        let known = match self.known.points.get(&angle.index()) {
            Some(&known) => known,
            None => {
                let point = match *self.graph.node(angle) {
                    ScalarNode::Angle(c, s) => (self.scalar(c), self.scalar(s)),
                    _ => {
                        let edge = self.scalar(angle.positive());
                        if edge.node() == 0 {
                            (Edge::ONE, Edge::ZERO)
                        } else {
                            let cos = self.push(Op::Cos, &[edge]);
                            (cos, self.push(Op::Sin, &[edge]))
                        }
                    }
                };
                self.known.points.insert(angle.index(), point);
                point
            }
        };
        (known.0, known.1.flip_if(angle.is_negative()))
    }

    fn scalar_node(&mut self, index: usize) -> Edge {
        let graph = self.graph;
        match graph.node(graph.scalar_at(index)) {
            ScalarNode::Literal(n) if n.is_zero() => Edge::ZERO,
            ScalarNode::Literal(n) if n.is_one() => Edge::ONE,
            ScalarNode::Literal(n) => self.push(Op::Literal(*n), &[]),
            ScalarNode::Symbol(id) => self.push(Op::Symbol(*id), &[]),
            ScalarNode::Sum(terms) => {
                let terms: Vec<Edge> = terms.iter().map(|&t| self.scalar(t)).collect();
                self.sum(&terms)
            }
            ScalarNode::Product(factors) => {
                let factors: Vec<Edge> = factors.iter().map(|&f| self.scalar(f)).collect();
                self.product(&factors)
            }
            ScalarNode::Reciprocal(x) => {
                let x = self.scalar(*x);
                self.push(Op::Reciprocal, &[x])
            }
            ScalarNode::Sqrt(x) => {
                let x = self.scalar(*x);
                self.push(Op::Sqrt, &[x])
            }
            ScalarNode::Cos(angle) => self.point(*angle).0,
            ScalarNode::Sin(angle) => self.point(*angle).1,
            ScalarNode::Call(call, arguments) => {
                let arguments: Vec<Edge> = arguments.iter().map(|&a| self.scalar(a)).collect();
                self.push(Op::Call(*call), &arguments)
            }
            ScalarNode::Angle(c, s) => {
                let point = [self.scalar(*s), self.scalar(*c)];
                self.push(Op::Call(Call::Atan2), &point)
            }
            ScalarNode::Output(id, k) => {
                let block = match self.known.blocks.get(&id.0) {
                    Some(&block) => block,
                    None => {
                        let block = self.block(*id);
                        self.known.blocks.insert(id.0, block);
                        block
                    }
                };
                self.push(Op::Output(block, *k), &[])
            }
            ScalarNode::Component(v, axis) => self.vector(*v)[*axis],
            ScalarNode::Dot(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                self.dot(a, b)
            }
        }
    }

    fn block(&mut self, id: BlockId) -> usize {
        let block = self.graph.block(id);
        match &block.kind {
            BlockKind::Solve { size, symmetric, groups } => {
                self.system(Work::Solve { size: *size, symmetric: *symmetric, groups: groups.clone() }, &block.operands)
            }
            // By complete pivoting, whatever it is compared with does.
            BlockKind::Eliminate { size, .. } => {
                self.system(Work::Solve { size: *size, symmetric: false, groups: [].into() }, &block.operands)
            }
            BlockKind::Iterate { unknowns, count } => self.iterate(unknowns, *count, &block.operands),
        }
    }

    fn system(&mut self, work: Work, operands: &[Scalar]) -> usize {
        let operands = operands.iter().map(|&s| self.scalar(s)).collect();
        self.tape.blocks.push(Block { work, operands });
        let number = self.tape.blocks.len() - 1;
        self.push(Op::Solve(number), &[]);
        number
    }

    /// What depends on the unknowns is written anew, for this iteration alone.
    fn iterate(&mut self, unknowns: &[SymbolId], count: usize, operands: &[Scalar]) -> usize {
        let graph = self.graph;
        let (start, body) = operands.split_at(unknowns.len());
        let symbols: Vec<Scalar> = unknowns.iter().filter_map(|&id| graph.symbol_handle(id)).collect();
        let reachable = graph.reachable(body);
        let depends = graph.depending(&reachable, symbols.iter().copied());
        let mut inside: Vec<AnyNode> = reachable.into_iter().filter(|&node| depends.has(node)).collect();
        inside.retain(|&node| !symbols.iter().any(|s| node == AnyNode::Scalar(s.index())));
        let mut list: Vec<Edge> = start.iter().map(|&s| self.scalar(s)).collect();
        let number = self.tape.blocks.len();
        let work = Work::Iterate { unknowns: Vec::new(), count, body: (0, 0) };
        self.tape.blocks.push(Block { work, operands: Vec::new() });

        let outer = self.set_aside(&inside, &symbols);
        let unknowns: Vec<usize> = symbols
            .iter()
            .map(|s| {
                let edge = self.push(Op::Unknown, &[]);
                self.known.scalars.insert(s.index(), edge);
                edge.node()
            })
            .collect();
        self.push(Op::Enter(number), &[]);
        let first = self.tape.nodes.len();
        self.write(&inside);
        list.extend(body.iter().map(|&s| self.scalar(s)));
        let last = self.tape.nodes.len();
        self.push(Op::Leave(number), &[]);
        self.set_aside(&inside, &symbols);
        let Known { scalars, vectors, matrices, points, blocks } = outer;
        self.known.scalars.extend(scalars);
        self.known.vectors.extend(vectors);
        self.known.matrices.extend(matrices);
        self.known.points.extend(points);
        self.known.blocks.extend(blocks);
        let work = Work::Iterate { unknowns, count, body: (first, last) };
        self.tape.blocks[number] = Block { work, operands: list };
        number
    }

    /// Forgets what was written of these nodes, and hands it out.
    fn set_aside(&mut self, inside: &[AnyNode], symbols: &[Scalar]) -> Known {
        let mut out = Known::default();
        let own = symbols.iter().map(|s| AnyNode::Scalar(s.index()));
        for node in inside.iter().copied().chain(own) {
            match node {
                AnyNode::Scalar(index) => {
                    out.scalars.extend(self.known.scalars.remove(&index).map(|edge| (index, edge)));
                    out.points.extend(self.known.points.remove(&index).map(|point| (index, point)));
                    if let ScalarNode::Output(id, _) = self.graph.node(self.graph.scalar_at(index)) {
                        out.blocks.extend(self.known.blocks.remove(&id.0).map(|block| (id.0, block)));
                    }
                }
                AnyNode::Vector(index) => {
                    out.vectors.extend(self.known.vectors.remove(&index).map(|edges| (index, edges)));
                }
                AnyNode::Rotation(index) => {
                    out.matrices.extend(self.known.matrices.remove(&index).map(|rows| (index, rows)));
                }
            }
        }
        out
    }

    fn dot(&mut self, a: [Edge; 3], b: [Edge; 3]) -> Edge {
        let products = [0, 1, 2].map(|k| self.product(&[a[k], b[k]]));
        self.sum(&products)
    }

    fn vector_node(&mut self, index: usize) -> [Edge; 3] {
        let graph = self.graph;
        match graph.vector_node_at(index) {
            VectorNode::Triple(components) => components.map(|c| self.scalar(c)),
            VectorNode::Sum(terms) => {
                let terms: Vec<[Edge; 3]> = terms.iter().map(|&t| self.vector(t)).collect();
                [0, 1, 2].map(|k| {
                    let column: Vec<Edge> = terms.iter().map(|t| t[k]).collect();
                    self.sum(&column)
                })
            }
            VectorNode::Scale(s, v) => {
                let (s, v) = (self.scalar(*s), self.vector(*v));
                v.map(|c| self.product(&[s, c]))
            }
            VectorNode::Cross(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                [0, 1, 2].map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let (plus, minus) = (self.product(&[a[j], b[k]]), self.product(&[a[k], b[j]]));
                    self.sum(&[plus, minus.flip_if(true)])
                })
            }
            VectorNode::Rotate(r, v) => {
                let v = self.vector(*v);
                self.rotate(*r, v)
            }
        }
    }

    fn rotate(&mut self, r: Rotation, v: [Edge; 3]) -> [Edge; 3] {
        match *self.graph.rotation_node(r) {
            RotationNode::Identity => v,
            RotationNode::Axis(axis, angle) => {
                let (c, s) = self.point(angle);
                let s = s.flip_if(r.is_transposed());
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut turned = v;
                let (a, b) = (self.product(&[c, v[j]]), self.product(&[s, v[k]]));
                turned[j] = self.sum(&[a, b.flip_if(true)]);
                let (a, b) = (self.product(&[s, v[j]]), self.product(&[c, v[k]]));
                turned[k] = self.sum(&[a, b]);
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
                    self.dot(row, v)
                })
            }
        }
    }

    /// Entries of a matrix or quaternion, not transposed.
    fn matrix(&mut self, r: Rotation) -> [[Edge; 3]; 3] {
        if let Some(&rows) = self.known.matrices.get(&r.index()) {
            return rows;
        }
        let rows = match self.graph.rotation_node(r) {
            RotationNode::Quaternion(q) => {
                let q = q.map(|c| self.scalar(c));
                self.quaternion(q)
            }
            RotationNode::Matrix(rows) => rows.clone().map(|row| row.map(|c| self.scalar(c))),
            _ => [[Edge::ZERO; 3]; 3],
        };
        self.known.matrices.insert(r.index(), rows);
        rows
    }

    fn quaternion(&mut self, [w, i, j, k]: [Edge; 4]) -> [[Edge; 3]; 3] {
        let v = [i, j, k];
        let two = self.push(Op::Literal(Number::integer(2)), &[]);
        let mut m = [[Edge::ONE; 3]; 3];
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let squares = [self.product(&[two, v[b], v[b]]), self.product(&[two, v[c], v[c]])];
            m[a][a] = self.sum(&[Edge::ONE, squares[0].flip_if(true), squares[1].flip_if(true)]);
            let (plain, turned) = (self.product(&[two, v[a], v[b]]), self.product(&[two, w, v[c]]));
            m[a][b] = self.sum(&[plain, turned.flip_if(true)]);
            m[b][a] = self.sum(&[plain, turned]);
        }
        m
    }
}
