//! Stage `symbolic`: exact derivatives along a direction.
//!
//! In: scalars and vectors of a graph, and a seed for each symbol that moves. Out: their derivatives, on the same graph.
//! With rates as seeds this is the time derivative, with a single one the partial derivative. Every node is
//! differentiated once per [`Differentiator`], operands before users (forward accumulation, Griewank and Walther 2008,
//! chapter 3), vectors and rotations whole: turning about an axis adds axis x, a quaternion its angular velocity x.
//!
//! Where a function has a kink the derivative is that of the branch which its value is taken from. Four symbols of a
//! unit quaternion must be seeded along the sphere, all four at once: nodes were merged by its equation.

use crate::contracts::call::Call;
use crate::invariant::fault::raise;
use crate::invariant::injection::{Break, broken};

use super::graph::{
    AnyNode, BlockId, BlockKind, Graph, PlaceMap, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode,
};

impl Graph {
    /// Derivative of a scalar along the seeds, given as (symbol, seed). Symbols without one rest.
    pub fn derivative(&mut self, s: Scalar, seeds: &[(Scalar, Scalar)]) -> Scalar {
        Differentiator::new(seeds).scalar(self, s)
    }

    /// Partial derivatives of a scalar.
    pub fn gradient(&mut self, s: Scalar, symbols: &[Scalar]) -> Vec<Scalar> {
        symbols.iter().map(|&symbol| self.derivative(s, &[(symbol, Scalar::ONE)])).collect()
    }
}

/// Derivatives along one direction, shared by all that is asked for.
pub struct Differentiator {
    scalars: PlaceMap<Scalar>,
    vectors: PlaceMap<Vector>,
    rotations: PlaceMap<Turning>,
    /// What stands on one body is taken to turn with it.
    bodies_turn: bool,
}

/// How a rotation changes, whichever way it is applied.
#[derive(Clone, Copy)]
enum Turning {
    Rests,
    /// About an axis that both frames share.
    Axis(Vector),
    /// With this angular velocity in the child's axes.
    Child(Vector),
    /// By its entries' derivatives, row by row.
    Entries([Vector; 3]),
    /// Factor by factor.
    Product(Rotation, Rotation),
}

impl Differentiator {
    /// Seeds are (symbol, derivative of the symbol).
    pub fn new(seeds: &[(Scalar, Scalar)]) -> Self {
        let scalars = seeds.iter().map(|&(s, seed)| (s.index(), seed.flip_if(s.is_negative() && seed != Scalar::ZERO)));
        let (vectors, rotations) = (PlaceMap::default(), PlaceMap::default());
        Differentiator { scalars: scalars.collect(), vectors, rotations, bodies_turn: false }
    }

    /// The same, where what several rotations turn together has one angular velocity: (A B C x)' = w x (A B C x) with w = a + A (b + B c),
    /// which is that of a body, for all its points, and not the sum of what each rotation adds to each point.
    pub fn with_turns_of_bodies(self) -> Self {
        Differentiator { bodies_turn: true, ..self }
    }

    /// Of a node whose operands rest, but for those with a seed.
    pub(super) fn slope(&self, g: &mut Graph, s: Scalar) -> Scalar {
        self.scalar_rule(g, s)
    }

    pub fn scalar(&mut self, g: &mut Graph, s: Scalar) -> Scalar {
        self.walk(g, AnyNode::Scalar(s.index()));
        self.of(s)
    }

    pub fn vector(&mut self, g: &mut Graph, v: Vector) -> Vector {
        self.walk(g, AnyNode::Vector(v.index()));
        self.of_vector(v)
    }

    pub fn scalars(&mut self, g: &mut Graph, list: &[Scalar]) -> Vec<Scalar> {
        list.iter().map(|&s| self.scalar(g, s)).collect()
    }

    /// Differentiates what a node needs, then the node; a stack of its own, since graphs are deep.
    fn walk(&mut self, g: &mut Graph, root: AnyNode) {
        let mut stack = vec![(root, false)];
        while let Some((node, ready)) = stack.pop() {
            if self.is_known(node) {
                continue;
            }
            if ready {
                self.differentiate(g, node);
            } else {
                stack.push((node, true));
                g.each_operand(node, &mut |operand| stack.push((operand, false)));
            }
        }
    }

    fn is_known(&self, node: AnyNode) -> bool {
        match node {
            AnyNode::Scalar(i) => self.scalars.contains_key(&i),
            AnyNode::Vector(i) => self.vectors.contains_key(&i),
            AnyNode::Rotation(i) => self.rotations.contains_key(&i),
        }
    }

    fn differentiate(&mut self, g: &mut Graph, node: AnyNode) {
        match node {
            AnyNode::Scalar(i) => {
                let result = self.scalar_rule(g, Scalar::new(i, false));
                self.scalars.insert(i, result);
            }
            AnyNode::Vector(i) => {
                let result = self.vector_rule(g, Vector::new(i, false));
                self.vectors.insert(i, result);
            }
            AnyNode::Rotation(i) => {
                let result = self.rotation_rule(g, Rotation::new(i, false));
                self.rotations.insert(i, result);
            }
        }
    }

    /// Of an operand, differentiated already.
    fn of(&self, s: Scalar) -> Scalar {
        let d = self.scalars.get(&s.index()).copied().unwrap_or(Scalar::ZERO);
        if s.is_negative() { -d } else { d }
    }

    fn of_vector(&self, v: Vector) -> Vector {
        let d = self.vectors.get(&v.index()).copied().unwrap_or(Vector::ZERO);
        if v.is_negative() { -d } else { d }
    }

    fn scalar_rule(&self, g: &mut Graph, s: Scalar) -> Scalar {
        match g.node(s).clone() {
            // A symbol that moves has its seed.
            ScalarNode::Literal(_) | ScalarNode::Symbol(_) => Scalar::ZERO,
            ScalarNode::Sum(terms) => {
                let terms: Vec<Scalar> = terms.iter().map(|&t| self.of(t)).collect();
                g.sum(&terms)
            }
            ScalarNode::Product(factors) => self.product_rule(g, &factors),
            ScalarNode::Reciprocal(x) => -g.product(&[self.of(x), s, s]),
            ScalarNode::Sqrt(x) => self.root_rule(g, s, x),
            ScalarNode::Sin(angle) => {
                let slope = g.cos(angle);
                g.mul(slope, self.of(angle))
            }
            ScalarNode::Cos(angle) => {
                let slope = g.sin(angle);
                -g.mul(slope, self.of(angle))
            }
            ScalarNode::Call(call, x) => {
                if x.iter().all(|&x| self.of(x) == Scalar::ZERO) {
                    return Scalar::ZERO;
                }
                self.call_rule(g, s, call, &x)
            }
            // c ds - s dc on the unit circle
            ScalarNode::Angle(c, sin) => {
                let (plus, minus) = (g.mul(c, self.of(sin)), g.mul(sin, self.of(c)));
                g.sub(plus, minus)
            }
            ScalarNode::Output(id, k) => self.block_rule(g, id, k),
            ScalarNode::Component(v, axis) => g.component(self.of_vector(v), axis),
            ScalarNode::Dot(a, b) => {
                let left = g.dot(self.of_vector(a), b);
                let right = g.dot(a, self.of_vector(b));
                g.add(left, right)
            }
        }
    }

    /// A x = b: A dx = db - dA x. The rank is constant but where it jumps. An iteration has a derivative of zero: who
    /// iterates knows the equation that is solved, and differentiates that.
    fn block_rule(&self, g: &mut Graph, id: BlockId, k: usize) -> Scalar {
        let block = g.block(id).clone();
        let (BlockKind::Solve { size, .. } | BlockKind::Eliminate { size, .. }) = block.kind else {
            return Scalar::ZERO;
        };
        if k >= size || block.operands.iter().all(|&s| self.of(s) == Scalar::ZERO) {
            return Scalar::ZERO;
        }
        let x = g.block_outputs(block.kind.clone(), &block.operands);
        let (matrix, rest) = block.operands.split_at(size * size);
        let (rhs, measures) = rest.split_at(size);
        let mut system = matrix.to_vec();
        for (row, &b) in matrix.chunks(size).zip(rhs) {
            let mut terms = vec![self.of(b)];
            terms.extend(row.iter().zip(&x).map(|(&a, &x)| -g.mul(self.of(a), x)));
            system.push(g.sum(&terms));
        }
        system.extend(measures);
        g.block_outputs(block.kind, &system)[k]
    }

    fn product_rule(&self, g: &mut Graph, factors: &[Scalar]) -> Scalar {
        let mut terms = Vec::with_capacity(factors.len());
        for (k, &factor) in factors.iter().enumerate() {
            let slope = self.of(factor);
            if slope == Scalar::ZERO || broken(Break::ProductRule) && k + 1 == factors.len() {
                continue;
            }
            let mut list = factors.to_vec();
            list[k] = slope;
            terms.push(g.product(&list));
        }
        g.sum(&terms)
    }

    /// dx / (2 sqrt(x))
    fn root_rule(&self, g: &mut Graph, root: Scalar, x: Scalar) -> Scalar {
        let dx = self.of(x);
        if dx == Scalar::ZERO {
            return Scalar::ZERO;
        }
        let half = g.decimal(0.5);
        let inverse = g.reciprocal(root);
        g.product(&[half, dx, inverse])
    }

    fn call_rule(&self, g: &mut Graph, s: Scalar, call: Call, x: &[Scalar]) -> Scalar {
        match (call, x) {
            (Call::Sqrt, &[x]) => self.root_rule(g, s, x),
            (Call::Powf, &[base, exponent]) => self.power_rule(g, s, base, exponent),
            // (x dy - y dx) / (x^2 + y^2)
            (Call::Atan2, &[y, x]) => {
                let (plus, minus) = (g.mul(x, self.of(y)), g.mul(y, self.of(x)));
                let numerator = g.sub(plus, minus);
                let squares = [g.mul(x, x), g.mul(y, y)];
                let square = g.sum(&squares);
                g.div(numerator, square)
            }
            (Call::Abs, &[x]) => {
                let negative = g.call(Call::Less, &[x, Scalar::ZERO]);
                self.choose(g, negative, -self.of(x), self.of(x))
            }
            (Call::Min, &[a, b]) => {
                let first = g.call(Call::Less, &[a, b]);
                self.choose(g, first, self.of(a), self.of(b))
            }
            (Call::Max, &[a, b]) => {
                let first = g.call(Call::Less, &[b, a]);
                self.choose(g, first, self.of(a), self.of(b))
            }
            (Call::Select, &[mask, a, b]) => self.choose_defined(g, mask, [a, b]),
            (Call::External(function), _) => {
                let moving = x.iter().enumerate().filter(|(_, x)| self.of(**x) != Scalar::ZERO);
                let changes = moving.map(|(k, &argument)| {
                    let slope = g.call(Call::ExternalSlope(function, k), x);
                    if let Some(name) = g.name_of(s).map(|name| name.text.clone()) {
                        g.label(slope, || format!("{name}_slope_{k}"));
                    }
                    g.mul(slope, self.of(argument))
                });
                let changes: Vec<Scalar> = changes.collect();
                g.sum(&changes)
            }
            (Call::ExternalSlope(function, _) | Call::ExternalCurvature(function), _) => {
                let changes = x.iter().map(|&x| self.of(x));
                let operands: Vec<Scalar> = std::iter::once(s).chain(changes).collect();
                g.call(Call::ExternalCurvature(function), &operands)
            }
            (call, &[x]) => {
                let slope = slope(g, s, call, x);
                g.mul(slope, self.of(x))
            }
            // Masks are constant but where they jump.
            (call, _) if call.is_mask() => Scalar::ZERO,
            _ => raise("a function has a derivative for its number of arguments"),
        }
    }

    /// What is no number has a slope that is none either, beside one that has a slope.
    fn choose_defined(&self, g: &mut Graph, mask: Scalar, values: [Scalar; 2]) -> Scalar {
        let slopes = values.map(|value| self.of(value));
        let moves = slopes.iter().any(|&slope| slope != Scalar::ZERO);
        let undefined = |g: &Graph, value: Scalar| matches!(g.node(value), ScalarNode::Call(Call::Nan, _));
        let [a, b] = [0, 1].map(|k| if moves && undefined(g, values[k]) { values[k] } else { slopes[k] });
        self.choose(g, mask, a, b)
    }

    fn choose(&self, g: &mut Graph, mask: Scalar, a: Scalar, b: Scalar) -> Scalar {
        g.call(Call::Select, &[mask, a, b])
    }

    /// b a^(b - 1) da + a^b ln(a) db, with no logarithm where the power is zero, which it stays.
    fn power_rule(&self, g: &mut Graph, power: Scalar, base: Scalar, exponent: Scalar) -> Scalar {
        let (da, db) = (self.of(base), self.of(exponent));
        let mut terms = Vec::with_capacity(2);
        if da != Scalar::ZERO {
            let less = g.sub(exponent, Scalar::ONE);
            let lower = g.call(Call::Powf, &[base, less]);
            terms.push(g.product(&[exponent, lower, da]));
        }
        if db != Scalar::ZERO {
            let none = g.call(Call::Equal, &[power, Scalar::ZERO]);
            let base = self.choose(g, none, Scalar::ONE, base);
            let logarithm = g.call(Call::Ln, &[base]);
            terms.push(g.product(&[power, logarithm, db]));
        }
        g.sum(&terms)
    }

    fn vector_rule(&self, g: &mut Graph, v: Vector) -> Vector {
        match g.vector_node(v).clone() {
            VectorNode::Triple(components) => g.vector(components.map(|c| self.of(c))),
            VectorNode::Sum(terms) => {
                let terms: Vec<Vector> = terms.iter().map(|&t| self.of_vector(t)).collect();
                g.sum_vectors(&terms)
            }
            VectorNode::Scale(s, v) => {
                let (grown, moved) = (g.scale(self.of(s), v), g.scale(s, self.of_vector(v)));
                g.add_vectors(grown, moved)
            }
            VectorNode::Cross(a, b) => {
                let (left, right) = (g.cross(self.of_vector(a), b), g.cross(a, self.of_vector(b)));
                g.add_vectors(left, right)
            }
            VectorNode::Rotate(r, inner) => match self.turn(g, v) {
                Some(rate) => g.cross(rate, v),
                None => self.rotated(g, r, inner, self.of_vector(inner)).1,
            },
        }
    }

    /// The angular velocity of what several rotations turn, one behind the other, and what is constant before them.
    fn turn(&self, g: &mut Graph, v: Vector) -> Option<Vector> {
        if !self.bodies_turn {
            return None;
        }
        // From the outermost on.
        let mut chain = Vec::new();
        let mut inner = v;
        while let &VectorNode::Rotate(r, next) = g.vector_node(inner) {
            self.factors(r, &mut chain);
            inner = next;
        }
        let moving = chain.iter().filter(|(_, turning)| !matches!(turning, Turning::Rests)).count();
        if moving < 2 || self.of_vector(inner) != Vector::ZERO {
            return None;
        }
        let mut rate = Vector::ZERO;
        for (r, turning) in chain.into_iter().rev() {
            let own = match turning {
                Turning::Rests => Vector::ZERO,
                Turning::Axis(own) | Turning::Child(own) if r.is_transposed() => -own,
                Turning::Axis(own) => own,
                Turning::Child(own) => g.rotate(r, own),
                Turning::Entries(_) | Turning::Product(..) => return None,
            };
            let carried = g.rotate(r, rate);
            rate = g.add_vectors(carried, own);
        }
        Some(rate)
    }

    /// Adds the factors of a rotation, from the left.
    fn factors(&self, r: Rotation, chain: &mut Vec<(Rotation, Turning)>) {
        match self.rotations.get(&r.index()).copied().unwrap_or(Turning::Rests) {
            Turning::Product(a, b) => {
                let [first, second] = if r.is_transposed() { [b.transpose(), a.transpose()] } else { [a, b] };
                self.factors(first, chain);
                self.factors(second, chain);
            }
            turning => chain.push((r, turning)),
        }
    }

    /// A vector that a rotation is applied to, and its derivative.
    fn rotated(&self, g: &mut Graph, r: Rotation, v: Vector, dv: Vector) -> (Vector, Vector) {
        let turning = self.rotations.get(&r.index()).copied().unwrap_or(Turning::Rests);
        if let Turning::Product(a, b) = turning {
            let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
            let (v, dv) = self.rotated(g, first, v, dv);
            return self.rotated(g, second, v, dv);
        }
        let result = g.rotate(r, v);
        let carried = |g: &mut Graph, dv: Vector| g.rotate(r, dv);
        let derivative = match turning {
            Turning::Rests | Turning::Product(..) => carried(g, dv),
            Turning::Axis(rate) => {
                let rate = if r.is_transposed() { -rate } else { rate };
                let (swept, carried) = (g.cross(rate, result), carried(g, dv));
                g.add_vectors(swept, carried)
            }
            Turning::Child(rate) if r.is_transposed() => {
                let (swept, carried) = (g.cross(rate, result), carried(g, dv));
                g.sub_vectors(carried, swept)
            }
            Turning::Child(rate) => {
                let swept = g.cross(rate, v);
                let sum = g.add_vectors(dv, swept);
                carried(g, sum)
            }
            Turning::Entries(rows) => {
                let swept = if r.is_transposed() {
                    let x = g.components(v);
                    let parts: [Vector; 3] = std::array::from_fn(|k| g.scale(x[k], rows[k]));
                    g.sum_vectors(&parts)
                } else {
                    let x = rows.map(|row| g.dot(row, v));
                    g.vector(x)
                };
                let carried = carried(g, dv);
                g.add_vectors(swept, carried)
            }
        };
        (result, derivative)
    }

    fn rotation_rule(&self, g: &mut Graph, r: Rotation) -> Turning {
        match g.rotation_node(r).clone() {
            RotationNode::Identity => Turning::Rests,
            RotationNode::Axis(axis, angle) => match self.of(angle) {
                Scalar::ZERO => Turning::Rests,
                rate => Turning::Axis(g.along(axis, rate)),
            },
            RotationNode::Matrix(rows) => {
                let rows = rows.map(|row| g.vector(row.map(|s| self.of(s))));
                if rows == [Vector::ZERO; 3] { Turning::Rests } else { Turning::Entries(rows) }
            }
            RotationNode::Quaternion(q) => {
                let dq = q.map(|s| self.of(s));
                match angular_velocity(g, q, dq) {
                    Vector::ZERO => Turning::Rests,
                    rate => Turning::Child(rate),
                }
            }
            RotationNode::Product(a, b) => {
                let rests = |r: Rotation| matches!(self.rotations.get(&r.index()), None | Some(Turning::Rests));
                if rests(a) && rests(b) { Turning::Rests } else { Turning::Product(a, b) }
            }
        }
    }
}

/// df/dx of a function of one argument, whose value is `s`. Zero for steps.
fn slope(g: &mut Graph, s: Scalar, call: Call, x: Scalar) -> Scalar {
    let square = |g: &mut Graph, x: Scalar| g.mul(x, x);
    match call {
        Call::Tan => {
            let square = square(g, s);
            g.add(Scalar::ONE, square)
        }
        Call::Asin | Call::Acos => {
            let square = square(g, x);
            let rest = g.sub(Scalar::ONE, square);
            let root = g.sqrt(rest);
            let inverse = g.reciprocal(root);
            if call == Call::Asin { inverse } else { -inverse }
        }
        Call::Atan => {
            let square = square(g, x);
            let sum = g.add(Scalar::ONE, square);
            g.reciprocal(sum)
        }
        Call::Sinh => g.call(Call::Cosh, &[x]),
        Call::Cosh => g.call(Call::Sinh, &[x]),
        Call::Tanh => {
            let square = square(g, s);
            g.sub(Scalar::ONE, square)
        }
        Call::Exp => s,
        Call::Ln => g.reciprocal(x),
        Call::Signum | Call::Less | Call::LessEqual | Call::Equal | Call::And | Call::Or | Call::Not => Scalar::ZERO,
        Call::Atan2 | Call::Powf | Call::Sqrt | Call::Abs | Call::Min | Call::Max | Call::Select => {
            raise("a function with a rule of its own is derived by it")
        }
        Call::Epsilon | Call::Nan => raise("a function of one argument is derived"),
        Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => {
            raise("a function with a rule of its own is derived by it")
        }
    }
}

/// Of a unit quaternion, in the child's axes: the vector of 2 q* dq.
fn angular_velocity(g: &mut Graph, q: [Scalar; 4], dq: [Scalar; 4]) -> Vector {
    let [w, x, y, z] = q;
    let [dw, dx, dy, dz] = dq;
    if [dw, dx, dy, dz] == [Scalar::ZERO; 4] {
        return Vector::ZERO;
    }
    let (v, dv) = (g.vector([x, y, z]), g.vector([dx, dy, dz]));
    let (along, across, back) = (g.scale(w, dv), g.cross(v, dv), g.scale(dw, v));
    let half = g.sum_vectors(&[along, -across, -back]);
    let two = g.integer(2);
    g.scale(two, half)
}
