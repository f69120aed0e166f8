//! Stage `symbolic`: numbers for nodes, in double precision or modulo the prime.
//!
//! In: a value for every symbol. Out: values of nodes, vectors included. The modular evaluation draws its symbols anew
//! from a seed and shares nothing with the prints that the graph has used to merge nodes, so it is an independent check
//! of every rewrite: constant angles on a common base, sine and cosine on the circle.

use std::collections::HashMap;

use super::graph::{AnyNode, Call, Graph, Rotation, RotationNode, Scalar, ScalarNode, SymbolId, Vector, VectorNode};
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
    /// Cosine and sine; the angle is given as a node too, since a field may not know angles as numbers.
    fn point(&self, graph: &Graph, angle: Scalar, value: Self::Value) -> (Self::Value, Self::Value);
}

/// Evaluates nodes of one graph, each once.
pub struct Evaluator<'g, F: Field> {
    graph: &'g Graph,
    field: F,
    scalars: HashMap<usize, F::Value>,
    vectors: HashMap<usize, [F::Value; 3]>,
}

impl<'g, F: Field> Evaluator<'g, F> {
    pub fn new(graph: &'g Graph, field: F) -> Self {
        Evaluator { graph, field, scalars: HashMap::new(), vectors: HashMap::new() }
    }

    /// Values of these scalars; operands go first, so that no recursion is deep.
    pub fn run(&mut self, roots: &[Scalar]) -> Vec<F::Value> {
        for node in self.graph.reachable(roots) {
            match node {
                AnyNode::Scalar(index) => drop(self.scalar(Scalar::new(index, false))),
                AnyNode::Vector(index) => drop(self.vector(Vector::new(index, false))),
                AnyNode::Rotation(_) => {}
            }
        }
        roots.iter().map(|&root| self.scalar(root)).collect()
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
            ScalarNode::Component(v, axis) => self.vector(*v)[*axis],
            ScalarNode::Dot(a, b) => {
                let (a, b) = (self.vector(*a), self.vector(*b));
                self.dot(&a, &b)
            }
        }
    }

    fn point(&mut self, angle: Scalar) -> (F::Value, F::Value) {
        let value = self.scalar(angle);
        self.field.point(self.graph, angle, value)
    }

    fn fold(&self, values: &[F::Value], f: impl Fn(&F, F::Value, F::Value) -> F::Value) -> F::Value {
        let mut rest = values.iter();
        let first = rest.next().copied().unwrap_or_else(|| self.field.literal(Number::ZERO));
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
    fn point(&self, _: &Graph, _: Scalar, angle: f64) -> (f64, f64) {
        (angle.cos(), angle.sin())
    }
}

/// What a function means for numbers; masks are 0 and 1.
pub fn call_f64(call: Call, x: &[f64]) -> f64 {
    let mask = |b: bool| f64::from(u8::from(b));
    match (call, x) {
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
        _ => f64::NAN,
    }
}
