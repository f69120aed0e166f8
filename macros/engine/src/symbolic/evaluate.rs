//! Stage `symbolic`: numbers for nodes, in double precision or modulo the prime.
//!
//! In: a value for every symbol. Out: values of nodes, vectors included. The modular evaluation draws its symbols anew
//! from a seed and shares nothing with the prints that the graph has used to merge nodes, so it is an independent check
//! of every rewrite: constant angles on a common base, sine and cosine on the circle.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;

use super::doubled::Doubled;
use super::external;
use super::graph::{
    AnyNode, BlockId, BlockKind, Graph, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector, VectorNode,
};
use super::number::Number;

/// A field in which a graph can be evaluated.
pub trait Field {
    type Value: Copy;
    fn literal(&self, n: Number) -> Self::Value;
    fn symbol(&self, id: SymbolId) -> Self::Value;
    fn add(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    fn mul(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    fn neg(&self, a: Self::Value) -> Self::Value;
    fn reciprocal(&self, a: Self::Value) -> Self::Value;
    fn call(&self, call: Call, arguments: &[Self::Value]) -> Self::Value;
    /// Cosine and sine; the angle is given as a node too, since a field may not know angles as numbers, and
    /// with the values of what it is the sum of.
    fn point(
        &self,
        graph: &Graph,
        angle: Scalar,
        value: Self::Value,
        known: &dyn Fn(Scalar) -> Self::Value,
    ) -> (Self::Value, Self::Value);

    /// The unknowns of a linear system given by rows, then its rank.
    fn solve(&self, symmetric: bool, matrix: &[Self::Value], rhs: &[Self::Value]) -> Vec<Self::Value>;
}

/// A node's position and its value.
type Known<V> = Option<(usize, V)>;

/// Evaluates nodes of one graph, each once.
pub struct Evaluator<'g, F: Field> {
    graph: &'g Graph,
    field: F,
    scalars: HashMap<usize, F::Value>,
    vectors: HashMap<usize, [F::Value; 3]>,
    blocks: HashMap<BlockId, Vec<F::Value>>,
}

impl<'g, F: Field> Evaluator<'g, F> {
    pub fn new(graph: &'g Graph, field: F) -> Self {
        Evaluator { graph, field, scalars: HashMap::new(), vectors: HashMap::new(), blocks: HashMap::new() }
    }

    /// What was evaluated in, with what it keeps of its own.
    pub fn field(&self) -> &F {
        &self.field
    }

    /// Values of these scalars; operands go first, so that no recursion is deep.
    pub fn run(&mut self, roots: &[Scalar]) -> Vec<F::Value> {
        for node in self.graph.reachable(roots) {
            self.visit(node);
        }
        roots.iter().map(|&root| self.scalar(root)).collect()
    }

    fn visit(&mut self, node: AnyNode) {
        match node {
            AnyNode::Scalar(index) => drop(self.scalar(Scalar::new(index, false))),
            AnyNode::Vector(index) => drop(self.vector(Vector::new(index, false))),
            AnyNode::Rotation(_) => {}
        }
    }

    fn scalar(&mut self, s: Scalar) -> F::Value {
        let value = match self.scalars.get(&s.index()) {
            Some(&value) => value,
            None => {
                let value = self.node(s);
                self.scalars.insert(s.index(), value);
                value
            }
        };
        if s.is_negative() { self.field.neg(value) } else { value }
    }

    fn node(&mut self, s: Scalar) -> F::Value {
        let graph = self.graph;
        match graph.node(s) {
            ScalarNode::Literal(n) => self.field.literal(*n),
            ScalarNode::Symbol(id) => self.field.symbol(*id),
            ScalarNode::Sum(terms) => {
                let values: Vec<F::Value> = terms.iter().map(|&t| self.scalar(t)).collect();
                self.fold(&values, F::add)
            }
            ScalarNode::Product(factors) => {
                let values: Vec<F::Value> = factors.iter().map(|&f| self.scalar(f)).collect();
                self.fold(&values, F::mul)
            }
            ScalarNode::Reciprocal(x) => {
                let x = self.scalar(*x);
                self.field.reciprocal(x)
            }
            ScalarNode::Sqrt(x) => {
                let x = self.scalar(*x);
                self.field.call(Call::Sqrt, &[x])
            }
            ScalarNode::Cos(angle) => self.point(*angle).0,
            ScalarNode::Sin(angle) => self.point(*angle).1,
            ScalarNode::Call(call, arguments) => {
                let values: Vec<F::Value> = arguments.iter().map(|&a| self.scalar(a)).collect();
                self.field.call(*call, &values)
            }
            ScalarNode::Angle(c, s) => {
                let point = [self.scalar(*s), self.scalar(*c)];
                self.field.call(Call::Atan2, &point)
            }
            ScalarNode::Output(id, k) => {
                if !self.blocks.contains_key(id) {
                    let results = self.block(*id);
                    self.blocks.insert(*id, results);
                }
                self.blocks[id][*k]
            }
            ScalarNode::Component(v, axis) => self.vector(*v)[*axis],
            ScalarNode::Dot(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                self.dot(&a, &b)
            }
        }
    }

    fn block(&mut self, id: BlockId) -> Vec<F::Value> {
        let block = self.graph.block(id);
        match &block.kind {
            &(BlockKind::Solve { size, .. } | BlockKind::Eliminate { size, .. }) => {
                let symmetric = matches!(block.kind, BlockKind::Solve { symmetric: true, .. });
                let values: Vec<F::Value> = block.operands.iter().map(|&s| self.scalar(s)).collect();
                let (matrix, rest) = values.split_at(size * size);
                self.field.solve(symmetric, matrix, &rest[..size])
            }
            BlockKind::Iterate { unknowns, count } => {
                let (start, body) = block.operands.split_at(unknowns.len());
                self.iterate(unknowns, *count, start, body)
            }
        }
    }

    /// What depends on the unknowns gets a value of its own in every round; afterwards it has the one it had before.
    fn iterate(&mut self, unknowns: &[SymbolId], count: usize, start: &[Scalar], body: &[Scalar]) -> Vec<F::Value> {
        let graph = self.graph;
        let mut values: Vec<F::Value> = start.iter().map(|&s| self.scalar(s)).collect();
        let mut residual = self.field.literal(Number::ZERO);
        let symbols: Vec<Scalar> =
            unknowns.iter().map(|&id| graph.symbol_handle(id).or_fault("unknowns are symbols of the graph")).collect();
        let nodes = graph.reachable(body);
        let depends = graph.depending(&nodes, symbols.iter().copied());
        let own: Vec<AnyNode> = symbols.iter().map(|s| AnyNode::Scalar(s.index())).collect();
        let body_nodes = nodes.into_iter().filter(|&node| depends.has(node) && !own.contains(&node));
        let inside: Vec<AnyNode> = own.iter().copied().chain(body_nodes).collect();
        let outside: (Vec<_>, Vec<_>) = inside.iter().map(|&node| self.take(node)).unzip();
        for _ in 0..count {
            self.forget(&inside);
            for (symbol, &value) in symbols.iter().zip(&values) {
                self.scalars.insert(symbol.index(), value);
            }
            inside.iter().for_each(|&node| self.visit(node));
            let mut results = body.iter().map(|&s| self.scalar(s)).collect::<Vec<_>>();
            residual = results.pop().or_fault("what an iteration computes ends with its residual");
            values = results;
        }
        self.forget(&inside);
        self.scalars.extend(outside.0.into_iter().flatten());
        self.vectors.extend(outside.1.into_iter().flatten());
        values.push(residual);
        values
    }

    fn forget(&mut self, nodes: &[AnyNode]) {
        for &node in nodes {
            self.take(node);
        }
    }

    /// Forgets the value of a node, and hands it out.
    fn take(&mut self, node: AnyNode) -> (Known<F::Value>, Known<[F::Value; 3]>) {
        match node {
            AnyNode::Scalar(i) => {
                if let ScalarNode::Output(id, _) = self.graph.node(Scalar::new(i, false)) {
                    self.blocks.remove(id);
                }
                (self.scalars.remove(&i).map(|value| (i, value)), None)
            }
            AnyNode::Vector(i) => (None, self.vectors.remove(&i).map(|value| (i, value))),
            AnyNode::Rotation(_) => (None, None),
        }
    }

    fn point(&mut self, angle: Scalar) -> (F::Value, F::Value) {
        let value = self.scalar(angle);
        // Terms were evaluated with the sum.
        let known = |s: Scalar| {
            let value = self.scalars.get(&s.index()).copied().or_fault("terms of an angle are evaluated with it");
            if s.is_negative() { self.field.neg(value) } else { value }
        };
        self.field.point(self.graph, angle, value, &known)
    }

    fn fold(&self, values: &[F::Value], f: impl Fn(&F, F::Value, F::Value) -> F::Value) -> F::Value {
        let mut rest = values.iter();
        let first = rest.next().copied().or_fault("sums and products have operands");
        rest.fold(first, |a, &b| f(&self.field, a, b))
    }

    fn dot(&self, a: &[F::Value; 3], b: &[F::Value; 3]) -> F::Value {
        let products: [F::Value; 3] = std::array::from_fn(|k| self.field.mul(a[k], b[k]));
        self.fold(&products, F::add)
    }

    fn vector(&mut self, v: Vector) -> [F::Value; 3] {
        let value = match self.vectors.get(&v.index()) {
            Some(&value) => value,
            None => {
                let value = self.vector_node(v);
                self.vectors.insert(v.index(), value);
                value
            }
        };
        if v.is_negative() { value.map(|x| self.field.neg(x)) } else { value }
    }

    fn vector_node(&mut self, v: Vector) -> [F::Value; 3] {
        let graph = self.graph;
        match graph.vector_node(v) {
            VectorNode::Triple(components) => components.map(|c| self.scalar(c)),
            VectorNode::Sum(terms) => {
                let values: Vec<[F::Value; 3]> = terms.iter().map(|&t| self.vector(t)).collect();
                std::array::from_fn(|k| {
                    let column: Vec<F::Value> = values.iter().map(|v| v[k]).collect();
                    self.fold(&column, F::add)
                })
            }
            VectorNode::Scale(s, v) => {
                let (s, v) = (self.scalar(*s), self.vector(*v));
                v.map(|x| self.field.mul(s, x))
            }
            VectorNode::Cross(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                std::array::from_fn(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let minus = self.field.neg(self.field.mul(a[k], b[j]));
                    self.field.add(self.field.mul(a[j], b[k]), minus)
                })
            }
            VectorNode::Rotate(r, v) => {
                let v = self.vector(*v);
                self.rotate(*r, &v)
            }
        }
    }

    fn rotate(&mut self, r: Rotation, v: &[F::Value; 3]) -> [F::Value; 3] {
        if let &RotationNode::Product(a, b) = self.graph.rotation_node(r) {
            // (A B)^T = B^T A^T
            let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
            let inner = self.rotate(first, v);
            return self.rotate(second, &inner);
        }
        let m = self.matrix(r);
        std::array::from_fn(|i| self.dot(&m[i], v))
    }

    fn matrix(&mut self, r: Rotation) -> [[F::Value; 3]; 3] {
        let (zero, one) = (self.field.literal(Number::ZERO), self.field.literal(Number::ONE));
        let mut m = [[zero; 3]; 3];
        match self.graph.rotation_node(r) {
            RotationNode::Identity | RotationNode::Product(..) => {
                for (i, row) in m.iter_mut().enumerate() {
                    row[i] = one;
                }
            }
            &RotationNode::Axis(axis, angle) => {
                let (c, s) = self.point(angle.positive());
                let s = if angle.is_negative() { self.field.neg(s) } else { s };
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                m[axis][axis] = one;
                (m[j][j], m[j][k], m[k][j], m[k][k]) = (c, self.field.neg(s), s, c);
            }
            RotationNode::Matrix(rows) => m = rows.map(|row| row.map(|s| self.scalar(s))),
            RotationNode::Quaternion(q) => {
                let [w, i, j, k] = q.map(|s| self.scalar(s));
                m = self.quaternion([w, i, j, k]);
            }
        }
        if r.is_transposed() { std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])) } else { m }
    }

    fn quaternion(&self, [w, i, j, k]: [F::Value; 4]) -> [[F::Value; 3]; 3] {
        let f = &self.field;
        let v = [i, j, k];
        let twice = |x| f.add(x, x);
        let minus = |a, b| f.add(a, f.neg(b));
        let one = f.literal(Number::ONE);
        let mut m = [[one; 3]; 3];
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            m[a][a] = minus(one, twice(f.add(f.mul(v[b], v[b]), f.mul(v[c], v[c]))));
            m[a][b] = twice(minus(f.mul(v[a], v[b]), f.mul(w, v[c])));
            m[b][a] = twice(f.add(f.mul(v[a], v[b]), f.mul(w, v[c])));
        }
        m
    }
}

/// Double precision.
pub struct Real<'a> {
    pub symbols: &'a dyn Fn(SymbolId) -> f64,
}

impl Field for Real<'_> {
    type Value = f64;
    fn literal(&self, n: Number) -> f64 {
        n.value()
    }
    fn symbol(&self, id: SymbolId) -> f64 {
        (self.symbols)(id)
    }
    fn add(&self, a: f64, b: f64) -> f64 {
        a + b
    }
    fn mul(&self, a: f64, b: f64) -> f64 {
        a * b
    }
    fn neg(&self, a: f64) -> f64 {
        -a
    }
    fn reciprocal(&self, a: f64) -> f64 {
        1.0 / a
    }
    fn call(&self, call: Call, x: &[f64]) -> f64 {
        call_f64(call, x)
    }
    fn point(&self, _: &Graph, _: Scalar, angle: f64, _: &dyn Fn(Scalar) -> f64) -> (f64, f64) {
        (angle.cos(), angle.sin())
    }
    fn solve(&self, _: bool, matrix: &[f64], rhs: &[f64]) -> Vec<f64> {
        solve_f64(matrix, rhs)
    }
}

/// What a function means for numbers; masks are 0 and 1.
pub fn call_f64(call: Call, x: &[f64]) -> f64 {
    let mask = |b: bool| f64::from(u8::from(b));
    match (call, x) {
        (Call::Epsilon, []) => f64::EPSILON,
        (Call::Nan, []) => f64::NAN,
        (Call::Tan, [a]) => a.tan(),
        (Call::Asin, [a]) => a.asin(),
        (Call::Acos, [a]) => a.acos(),
        (Call::Atan, [a]) => a.atan(),
        (Call::Atan2, [a, b]) => a.atan2(*b),
        (Call::Sinh, [a]) => a.sinh(),
        (Call::Cosh, [a]) => a.cosh(),
        (Call::Tanh, [a]) => a.tanh(),
        (Call::Exp, [a]) => a.exp(),
        (Call::Ln, [a]) => a.ln(),
        (Call::Powf, [a, b]) => a.powf(*b),
        (Call::Sqrt, [a]) => a.sqrt(),
        (Call::Abs, [a]) => a.abs(),
        (Call::Signum, [a]) => {
            if *a == 0.0 {
                *a
            } else {
                a.signum()
            }
        }
        (Call::Min, [a, b]) => {
            if a.is_nan() || a < b {
                *a
            } else {
                *b
            }
        }
        (Call::Max, [a, b]) => {
            if a.is_nan() || a > b {
                *a
            } else {
                *b
            }
        }
        (Call::Less, [a, b]) => mask(a < b),
        (Call::LessEqual, [a, b]) => mask(a <= b),
        (Call::Equal, [a, b]) => mask(a == b),
        (Call::And, [a, b]) => mask(*a != 0.0 && *b != 0.0),
        (Call::Or, [a, b]) => mask(*a != 0.0 || *b != 0.0),
        (Call::Not, [a]) => mask(*a == 0.0),
        (Call::Select, [m, a, b]) => {
            if *m != 0.0 {
                *a
            } else {
                *b
            }
        }
        (call, x) => {
            let x: Vec<Doubled> = x.iter().map(|&x| Doubled::new(x)).collect();
            external::value(call, &x).map_or(f64::NAN, Doubled::value)
        }
    }
}

/// The unknowns of a linear system given by rows, then its rank: complete pivoting after rows and columns have been brought
/// to one scale, as in the runtime. Unknowns beyond the rank are zero.
pub fn solve_f64(matrix: &[f64], rhs: &[f64]) -> Vec<f64> {
    solve_above(matrix, rhs, 16.0 * rhs.len() as f64 * f64::EPSILON)
}

/// The same with a threshold of the pivots, of which the greatest possible is one.
pub(super) fn solve_above(matrix: &[f64], rhs: &[f64], threshold: f64) -> Vec<f64> {
    let n = rhs.len();
    let mut a: Vec<Vec<f64>> = (0..n).map(|i| matrix[i * n..(i + 1) * n].to_vec()).collect();
    let mut b = rhs.to_vec();
    let scale = |largest: f64| if largest > 0.0 { 1.0 / largest } else { 1.0 };
    for (row, b) in a.iter_mut().zip(&mut b) {
        let factor = scale(row.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
        row.iter_mut().chain([b]).for_each(|x| *x *= factor);
    }
    let columns: Vec<f64> =
        (0..n).map(|j| scale(a.iter().fold(0.0, |most: f64, row| most.max(row[j].abs())))).collect();
    for row in &mut a {
        row.iter_mut().zip(&columns).for_each(|(x, factor)| *x *= factor);
    }
    let mut origin: Vec<usize> = (0..n).collect();
    let mut rank = 0;
    while rank < n {
        let candidates = (rank..n).flat_map(|i| (rank..n).map(move |j| (i, j)));
        let pivot = candidates.max_by(|&(i, j), &(k, l)| a[i][j].abs().total_cmp(&a[k][l].abs()));
        let Some((i, j)) = pivot.filter(|&(i, j)| a[i][j].abs() > threshold) else { break };
        a.swap(rank, i);
        b.swap(rank, i);
        a.iter_mut().for_each(|row| row.swap(rank, j));
        origin.swap(rank, j);
        let (row, right) = (a[rank].clone(), b[rank]);
        for i in rank + 1..n {
            let factor = a[i][rank] / row[rank];
            a[i].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            b[i] -= factor * right;
        }
        rank += 1;
    }
    let mut x = vec![0.0; n];
    for k in (0..rank).rev() {
        let known: f64 = (k + 1..rank).map(|j| a[k][j] * x[origin[j]]).sum();
        x[origin[k]] = (b[k] - known) / a[k][k];
    }
    x.iter_mut().zip(&columns).for_each(|(x, factor)| *x *= factor);
    x.push(rank as f64);
    x
}
