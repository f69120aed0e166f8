//! Stage `symbolic`: derivatives weighted and gathered from the results' side.
//!
//! In: expressions y_k with weights w_k, and symbols v_i. Out: for each symbol the sum over k of w_k dy_k/dv_i, on the
//! same graph. Reverse accumulation (Griewank and Walther 2008, chapter 3): every node that depends on the symbols passes
//! its adjoint on to what it reads, users before operands, each once, so all sums together cost about what the y_k cost.
//! Adjoints of vectors are vectors: what a rotation has turned is turned back, and what was crossed with is crossed with.
//! For rates that are linear in velocities this is the transposed velocity map: efforts go down the way rates come up.
//!
//! The four symbols of a unit quaternion have derivatives along the sphere alone: the sums over them with a motion of
//! the quaternion mean something, each by itself does not. The outputs of an iteration pass nothing on.

use crate::invariant::injection::{Break, broken};

use super::differentiate::Differentiator;
use super::graph::{
    AnyNode, BlockId, BlockKind, Graph, PlaceMap, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode,
};
use super::walk::Marks;

impl Graph {
    /// For each symbol the sum of weight * d(expression)/d(symbol) over all pairs (expression, weight). Weights may
    /// depend on anything: they are not differentiated.
    pub fn transpose_linear(&mut self, weighted: &[(Scalar, Scalar)], symbols: &[Scalar]) -> Vec<Scalar> {
        self.transpose_vectors(weighted, &[], symbols)
    }

    /// The same with vectors besides, each with a vector of weights in its own axes.
    pub fn transpose_vectors(
        &mut self,
        weighted: &[(Scalar, Scalar)],
        vectors: &[(Vector, Vector)],
        symbols: &[Scalar],
    ) -> Vec<Scalar> {
        let scalar_roots = weighted.iter().map(|(y, _)| AnyNode::Scalar(y.index()));
        let vector_roots = vectors.iter().map(|(y, _)| AnyNode::Vector(y.index()));
        let nodes = self.reachable_from(scalar_roots.chain(vector_roots));
        let depends = self.depending(&nodes, symbols.iter().copied());
        let mut adjoints =
            Adjoints { depends, scalars: PlaceMap::default(), vectors: PlaceMap::default(), block: None };
        for &(y, weight) in weighted {
            adjoints.pass(y, weight);
        }
        for &(y, weight) in vectors {
            adjoints.pass_vector(y, weight);
        }
        let symbol_nodes: Vec<usize> = symbols.iter().map(|s| s.index()).collect();
        for &node in nodes.iter().rev() {
            adjoints.leave_block(self, node);
            match node {
                AnyNode::Scalar(i) if !symbol_nodes.contains(&i) => adjoints.scalar(self, i),
                AnyNode::Vector(i) => adjoints.vector(self, i),
                _ => {}
            }
        }
        let sum = |&s: &Scalar| {
            let terms = adjoints.scalars.get(&s.index()).cloned().unwrap_or_default();
            let sum = self.sum(&terms);
            if s.is_negative() { -sum } else { sum }
        };
        symbols.iter().map(sum).collect()
    }
}

/// What users have passed on, by node.
struct Adjoints {
    depends: Marks,
    scalars: PlaceMap<Vec<Scalar>>,
    vectors: PlaceMap<Vec<Vector>>,
    /// The linear system whose unknowns are being visited, and their adjoints.
    block: Option<(BlockId, Vec<Scalar>)>,
}

impl Adjoints {
    fn moves(&self, s: Scalar) -> bool {
        self.depends.has(AnyNode::Scalar(s.index()))
    }

    fn moves_vector(&self, v: Vector) -> bool {
        self.depends.has(AnyNode::Vector(v.index()))
    }

    fn pass(&mut self, s: Scalar, adjoint: Scalar) {
        if self.moves(s) && adjoint != Scalar::ZERO {
            self.scalars.entry(s.index()).or_default().push(if s.is_negative() { -adjoint } else { adjoint });
        }
    }

    fn pass_vector(&mut self, v: Vector, adjoint: Vector) {
        if self.moves_vector(v) && adjoint != Vector::ZERO {
            self.vectors.entry(v.index()).or_default().push(if v.is_negative() { -adjoint } else { adjoint });
        }
    }

    fn scalar(&mut self, g: &mut Graph, index: usize) {
        let Some(terms) = self.scalars.remove(&index) else { return };
        let adjoint = g.sum(&terms);
        let s = Scalar::new(index, false);
        match g.node(s).clone() {
            ScalarNode::Literal(_) | ScalarNode::Symbol(_) => {}
            ScalarNode::Sum(terms) => {
                let skipped = usize::from(broken(Break::AdjointTerm));
                terms.iter().skip(skipped).for_each(|&t| self.pass(t, adjoint));
            }
            ScalarNode::Product(factors) => {
                for (at, &factor) in factors.iter().enumerate() {
                    if self.moves(factor) {
                        let mut list = factors.to_vec();
                        list[at] = adjoint;
                        let share = g.product(&list);
                        self.pass(factor, share);
                    }
                }
            }
            ScalarNode::Component(v, axis) => {
                let share = g.along(axis, adjoint);
                self.pass_vector(v, share);
            }
            ScalarNode::Dot(a, b) => {
                for (v, other) in [(a, b), (b, a)] {
                    if self.moves_vector(v) {
                        let share = g.scale(adjoint, other);
                        self.pass_vector(v, share);
                    }
                }
            }
            ScalarNode::Output(id, k) => {
                if let BlockKind::Solve { size, .. } | BlockKind::Eliminate { size, .. } = g.block(id).kind {
                    let (_, weights) = self.block.get_or_insert_with(|| (id, vec![Scalar::ZERO; size]));
                    // The rank is constant but where it jumps.
                    if let Some(weight) = weights.get_mut(k) {
                        *weight = adjoint;
                    }
                }
            }
            ScalarNode::Call(_, list) => self.slopes(g, s, &list, adjoint),
            ScalarNode::Angle(c, sin) => self.slopes(g, s, &[c, sin], adjoint),
            ScalarNode::Reciprocal(x) | ScalarNode::Sqrt(x) | ScalarNode::Sin(x) | ScalarNode::Cos(x) => {
                self.slopes(g, s, &[x], adjoint);
            }
        }
    }

    /// By the rules of forward derivatives, operand by operand.
    fn slopes(&mut self, g: &mut Graph, s: Scalar, operands: &[Scalar], adjoint: Scalar) {
        let mut seen: Vec<Scalar> = Vec::with_capacity(operands.len());
        for x in operands.iter().map(|x| x.positive()) {
            if self.moves(x) && !seen.contains(&x) {
                let slope = Differentiator::new(&[(x, Scalar::ONE)]).slope(g, s);
                let share = g.mul(adjoint, slope);
                self.pass(x, share);
                seen.push(x);
            }
        }
    }

    /// The outputs of a block were made in one go, so they are visited in one go: what comes next has seen them all.
    fn leave_block(&mut self, g: &mut Graph, next: AnyNode) {
        let same = |id: BlockId| match next {
            AnyNode::Scalar(i) => matches!(*g.node(Scalar::new(i, false)), ScalarNode::Output(other, _) if other == id),
            _ => false,
        };
        if let Some((id, weights)) = self.block.take_if(|(id, _)| !same(*id)) {
            self.solve(g, id, weights);
        }
    }

    /// A x = b: with A^T u = w, b takes u and A takes -u x^T.
    fn solve(&mut self, g: &mut Graph, id: BlockId, weights: Vec<Scalar>) {
        let block = g.block(id).clone();
        let size = weights.len();
        let (matrix, rest) = block.operands.split_at(size * size);
        let (rhs, measures) = rest.split_at(size);
        let transposed = |at: usize| matrix[(at % size) * size + at / size];
        let sides = weights.into_iter().chain(measures.iter().copied());
        let system: Vec<Scalar> = (0..size * size).map(transposed).chain(sides).collect();
        let u = g.block_outputs(block.kind.clone(), &system);
        let x = g.block_outputs(block.kind.clone(), &block.operands);
        for row in 0..size {
            self.pass(rhs[row], u[row]);
            for column in 0..size {
                let entry = matrix[row * size + column];
                if self.moves(entry) {
                    let share = -g.mul(u[row], x[column]);
                    self.pass(entry, share);
                }
            }
        }
    }

    fn vector(&mut self, g: &mut Graph, index: usize) {
        let Some(terms) = self.vectors.remove(&index) else { return };
        let adjoint = g.sum_vectors(&terms);
        match g.vector_node(Vector::new(index, false)).clone() {
            VectorNode::Triple(components) => {
                for (axis, c) in components.into_iter().enumerate() {
                    if self.moves(c) {
                        let share = g.component(adjoint, axis);
                        self.pass(c, share);
                    }
                }
            }
            VectorNode::Sum(terms) => terms.iter().for_each(|&t| self.pass_vector(t, adjoint)),
            VectorNode::Scale(s, v) => {
                if self.moves(s) {
                    let share = g.dot(adjoint, v);
                    self.pass(s, share);
                }
                if self.moves_vector(v) {
                    let share = g.scale(s, adjoint);
                    self.pass_vector(v, share);
                }
            }
            // w . (da x b) = da . (b x w), w . (a x db) = db . (w x a)
            VectorNode::Cross(a, b) => {
                if self.moves_vector(a) {
                    let share = g.cross(b, adjoint);
                    self.pass_vector(a, share);
                }
                if self.moves_vector(b) {
                    let share = g.cross(adjoint, a);
                    self.pass_vector(b, share);
                }
            }
            VectorNode::Rotate(r, v) => {
                let back = self.rotated(g, r, v, adjoint);
                self.pass_vector(v, back);
            }
        }
    }

    /// The adjoint of a vector whose image has this adjoint; the rotation's own share goes to what it reads.
    fn rotated(&mut self, g: &mut Graph, r: Rotation, v: Vector, adjoint: Vector) -> Vector {
        if !self.depends.has(AnyNode::Rotation(r.index())) {
            return g.rotate(r.transpose(), adjoint);
        }
        match g.rotation_node(r).clone() {
            RotationNode::Product(a, b) => {
                let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
                let between = g.rotate(first, v);
                let inner = self.rotated(g, second, between, adjoint);
                return self.rotated(g, first, v, inner);
            }
            // w . (axis x R v) = axis . (R v x w)
            RotationNode::Axis(axis, angle) => {
                let image = g.rotate(r, v);
                let moment = g.cross(image, adjoint);
                let share = g.component(moment, axis);
                self.pass(angle, if r.is_transposed() { -share } else { share });
            }
            RotationNode::Matrix(rows) => {
                let (left, right) = if r.is_transposed() { (v, adjoint) } else { (adjoint, v) };
                let (left, right) = (g.components(left), g.components(right));
                for (row, &l) in rows.iter().zip(&left) {
                    for (&entry, &x) in row.iter().zip(&right) {
                        if self.moves(entry) {
                            let share = g.mul(l, x);
                            self.pass(entry, share);
                        }
                    }
                }
            }
            RotationNode::Quaternion(q) => self.quaternion(g, r, q, v, adjoint),
            RotationNode::Identity => {}
        }
        g.rotate(r.transpose(), adjoint)
    }

    /// The child turns with w = 2 (q0 dq - dq0 q - q x dq), see [`super::differentiate`].
    fn quaternion(&mut self, g: &mut Graph, r: Rotation, q: [Scalar; 4], v: Vector, adjoint: Vector) {
        let moment = if r.is_transposed() {
            // y = R^T v: dy = -w x y
            let image = g.rotate(r, v);
            -g.cross(image, adjoint)
        } else {
            // dy = R (w x v)
            let back = g.rotate(r.transpose(), adjoint);
            g.cross(v, back)
        };
        let two = g.integer(2);
        let h = g.scale(two, moment);
        let axis = g.vector([q[1], q[2], q[3]]);
        let share = -g.dot(axis, h);
        self.pass(q[0], share);
        // h . (q x dq) = dq . (h x q)
        let (along, across) = (g.scale(q[0], h), g.cross(h, axis));
        let share = g.sub_vectors(along, across);
        for (k, c) in g.components(share).into_iter().enumerate() {
            self.pass(q[k + 1], c);
        }
    }
}
