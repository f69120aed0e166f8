//! Stage `mechanics`: values and gradients of many scalars, quickly, again and again.
//!
//! In: a graph of scalars, roots. Out: a [`Tape`]: the nodes in order with flat lists of operands, evaluated forwards for
//! values, and backwards for the gradient of one root over the nodes that it needs (reverse accumulation, Griewank and
//! Walther 2008, chapter 3). The sampling of closed configurations runs it some thousand times in an unoptimised build.

use crate::contracts::call::Call;
use crate::symbolic::evaluate::call_f64;
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};

#[derive(Clone, Copy, Debug)]
enum Op {
    Literal(f64),
    Symbol(usize),
    Sum,
    Product,
    Reciprocal,
    Sin,
    Cos,
    Call(Call),
    /// So much of the last operand but one, the rest of the last, and more or less of these by a mask before them.
    Blend(f64),
    /// The first operand less the second.
    Apart,
    /// So much of the first operand, beside a constant.
    Part(f64, f64),
    /// A function of the user's own with some of each of its operands.
    Beside(Call, f64),
    /// The root of the size.
    Root,
    /// What has no number here.
    Unknown,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    op: Op,
    /// Operands in the flat list.
    first: usize,
    last: usize,
}

/// A node's place and its sign.
#[derive(Clone, Copy, Debug)]
struct Edge {
    node: usize,
    sign: f64,
}

/// How much more of one piece a mask makes of a blend.
const MASK: f64 = 0.1;

/// A straight-line program for numbers.
#[derive(Clone)]
pub(super) struct Tape {
    nodes: Vec<Node>,
    operands: Vec<Edge>,
    roots: Vec<Edge>,
    /// By root: the nodes that it needs, in order.
    needs: Vec<Vec<usize>>,
}

/// Working memory of one evaluation.
#[derive(Clone, Default)]
pub(super) struct Values {
    values: Vec<f64>,
    slopes: Vec<f64>,
}

impl Tape {
    /// The graph must be lowered.
    pub(super) fn new(g: &Graph, roots: &[Scalar]) -> Tape {
        let reachable = g.reachable_scalars(roots);
        let mut place = vec![usize::MAX; g.len()];
        let (mut nodes, mut operands): (Vec<Node>, Vec<Edge>) = (Vec::new(), Vec::new());
        let edge = |place: &[usize], s: &Scalar| Edge {
            node: place[s.index()],
            sign: if s.is_negative() { -1.0 } else { 1.0 },
        };
        for &index in &reachable {
            let first = operands.len();
            let op = match g.node(g.scalar_at(index)) {
                ScalarNode::Literal(n) => Op::Literal(n.value()),
                ScalarNode::Symbol(id) => Op::Symbol(id.0),
                ScalarNode::Sum(list) => {
                    operands.extend(list.iter().map(|s| edge(&place, s)));
                    Op::Sum
                }
                ScalarNode::Product(list) => {
                    operands.extend(list.iter().map(|s| edge(&place, s)));
                    Op::Product
                }
                ScalarNode::Reciprocal(x) => {
                    operands.push(edge(&place, x));
                    Op::Reciprocal
                }
                ScalarNode::Sqrt(x) => {
                    operands.push(edge(&place, x));
                    Op::Call(Call::Sqrt)
                }
                ScalarNode::Sin(x) => {
                    operands.push(edge(&place, x));
                    Op::Sin
                }
                ScalarNode::Cos(x) => {
                    operands.push(edge(&place, x));
                    Op::Cos
                }
                ScalarNode::Call(call, list) => {
                    operands.extend(list.iter().map(|s| edge(&place, s)));
                    Op::Call(*call)
                }
                ScalarNode::Angle(c, s) => {
                    operands.extend([edge(&place, s), edge(&place, c)]);
                    Op::Call(Call::Atan2)
                }
                ScalarNode::Output(..) | ScalarNode::Component(..) | ScalarNode::Dot(..) => Op::Unknown,
            };
            place[index] = nodes.len();
            nodes.push(Node { op, first, last: operands.len() });
        }
        let roots: Vec<Edge> = roots.iter().map(|root| edge(&place, root)).collect();
        let mut tape = Tape { nodes, operands, roots, needs: Vec::new() };
        tape.needs = (0..tape.roots.len()).map(|root| tape.needs_of(root)).collect();
        tape
    }

    /// The same with some of each piece in place of one of them, whatever would choose: what acts beyond a stop acts a little. Functions that
    /// are flat somewhere (`tanh`, `exp`) become parts of their arguments, with what they are at zero, and those of the user's own have such parts beside
    /// them: a step that is smooth is as good as zero on one side of it. Roots are those of sizes, so they have values. What some `exact` roots need stays.
    pub(super) fn blended(mut self, exact: impl Iterator<Item = usize>) -> Tape {
        let mut stays = vec![false; self.nodes.len()];
        for root in exact {
            self.needs[root].iter().for_each(|&node| stays[node] = true);
        }
        for (k, node) in self.nodes.iter_mut().enumerate() {
            let Op::Call(call) = node.op else { continue };
            if stays[k] {
                continue;
            }
            // Another one for each, between 0.3 and 0.7.
            let share = 0.3 + 0.4 * (0.618_033_988_749_895 * k as f64).fract();
            node.op = match call {
                Call::Min | Call::Max | Call::Select => Op::Blend(share),
                Call::Abs | Call::Signum | Call::Sinh | Call::Tanh | Call::Asin | Call::Atan => Op::Part(share, 0.0),
                // The exponent, and what an angle is measured from, decide no zero.
                Call::Powf | Call::Atan2 => Op::Part(share, 0.0),
                Call::Exp | Call::Cosh | Call::Acos => Op::Part(share, 1.0),
                // Of one it is zero.
                Call::Ln => Op::Part(share, -share),
                Call::External(_) => Op::Beside(call, share),
                Call::Sqrt => Op::Root,
                Call::And | Call::Or | Call::Not => Op::Sum,
                Call::Less | Call::LessEqual | Call::Equal => Op::Apart,
                _ => node.op,
            };
        }
        self
    }

    fn needs_of(&self, root: usize) -> Vec<usize> {
        let Some(root) = self.roots.get(root) else { return Vec::new() };
        let mut marked = vec![false; root.node + 1];
        marked[root.node] = true;
        let mut list = Vec::new();
        for index in (0..=root.node).rev() {
            if marked[index] {
                list.push(index);
                let node = &self.nodes[index];
                for operand in &self.operands[node.first..node.last] {
                    marked[operand.node] = true;
                }
            }
        }
        list.reverse();
        list
    }

    /// Numbers of the symbols that a root depends on.
    pub(super) fn symbols(&self, root: usize) -> Vec<usize> {
        let symbol = |&index: &usize| match self.nodes[index].op {
            Op::Symbol(id) => Some(id),
            _ => None,
        };
        self.needs[root].iter().filter_map(symbol).collect()
    }

    /// Whether a root is the same function wherever it has a value, and not another one in pieces.
    pub(super) fn is_analytic(&self, root: usize) -> bool {
        self.needs[root].iter().all(|&index| match self.nodes[index].op {
            Op::Call(Call::Min | Call::Max | Call::Select | Call::Abs | Call::Signum | Call::Nan)
            | Op::Blend(_)
            | Op::Apart
            | Op::Part(..)
            | Op::Beside(..)
            | Op::Root
            | Op::Unknown => false,
            Op::Call(call) => !call.is_comparison(),
            Op::Literal(_) | Op::Symbol(_) | Op::Sum | Op::Product | Op::Reciprocal | Op::Sin | Op::Cos => true,
        })
    }

    /// Evaluates all nodes.
    pub(super) fn run(&self, values: &mut Values, symbols: &[f64]) {
        let list = &mut values.values;
        list.clear();
        list.resize(self.nodes.len(), f64::NAN);
        for index in 0..self.nodes.len() {
            list[index] = self.evaluate(list, index, symbols);
        }
    }

    /// Evaluates what some roots need.
    pub(super) fn run_for(&self, values: &mut Values, symbols: &[f64], roots: impl Iterator<Item = usize>) {
        values.values.clear();
        values.values.resize(self.nodes.len(), f64::NAN);
        self.run_also(values, symbols, roots);
    }

    /// Evaluates what some roots need beside what was evaluated at the same place.
    pub(super) fn run_also(&self, values: &mut Values, symbols: &[f64], roots: impl Iterator<Item = usize>) {
        let list = &mut values.values;
        for root in roots {
            for &index in &self.needs[root] {
                // What another root has needed too is there.
                if list[index].is_nan() {
                    list[index] = self.evaluate(list, index, symbols);
                }
            }
        }
    }

    fn evaluate(&self, list: &[f64], index: usize, symbols: &[f64]) -> f64 {
        let node = &self.nodes[index];
        let operands = &self.operands[node.first..node.last];
        match node.op {
            Op::Literal(x) => x,
            Op::Symbol(id) => symbols[id],
            Op::Sum => {
                let mut sum = 0.0;
                for edge in operands {
                    sum += edge.sign * list[edge.node];
                }
                sum
            }
            Op::Product => {
                let mut product = 1.0;
                for edge in operands {
                    product *= edge.sign * list[edge.node];
                }
                product
            }
            Op::Reciprocal => 1.0 / operand(list, &operands[0]),
            Op::Sin => operand(list, &operands[0]).sin(),
            Op::Cos => operand(list, &operands[0]).cos(),
            Op::Blend(share) => {
                let [before @ .., a, b] = operands else { return f64::NAN };
                let share = share + before.iter().map(|mask| MASK * operand(list, mask)).sum::<f64>();
                share * operand(list, a) + (1.0 - share) * operand(list, b)
            }
            Op::Part(share, constant) => constant + share * operand(list, &operands[0]),
            Op::Beside(call, share) => {
                let x = arguments(list, operands);
                let beside: f64 =
                    operands.iter().zip(parts(share)).map(|(edge, part)| part * operand(list, edge)).sum();
                call_f64(call, &x[..operands.len().min(3)]) + beside
            }
            Op::Root => operand(list, &operands[0]).abs().sqrt(),
            Op::Apart => operand(list, &operands[0]) - operands.get(1).map_or(f64::NAN, |edge| operand(list, edge)),
            Op::Call(call) => {
                let mut x = [0.0; 3];
                for (slot, edge) in x.iter_mut().zip(operands) {
                    *slot = edge.sign * list[edge.node];
                }
                call_f64(call, &x[..operands.len().min(3)])
            }
            Op::Unknown => f64::NAN,
        }
    }

    /// After `run`.
    pub(super) fn value(&self, values: &Values, root: usize) -> f64 {
        operand(&values.values, &self.roots[root])
    }

    /// After `run`: (symbol, derivative by it) of one root.
    pub(super) fn gradient(&self, values: &mut Values, root: usize, mut found: impl FnMut(usize, f64)) {
        let Values { values, slopes } = values;
        slopes.resize(self.nodes.len(), 0.0);
        let (Some(edge), Some(needs)) = (self.roots.get(root), self.needs.get(root)) else { return };
        for &index in needs {
            slopes[index] = 0.0;
        }
        slopes[edge.node] = edge.sign;
        for &index in needs.iter().rev() {
            let slope = slopes[index];
            if slope == 0.0 {
                continue;
            }
            let node = &self.nodes[index];
            let operands = &self.operands[node.first..node.last];
            match node.op {
                Op::Literal(_) | Op::Unknown => {}
                Op::Symbol(id) => found(id, slope),
                Op::Sum => {
                    for edge in operands {
                        slopes[edge.node] += edge.sign * slope;
                    }
                }
                Op::Product => {
                    for (k, edge) in operands.iter().enumerate() {
                        let mut rest = slope * edge.sign;
                        for (other, edge) in operands.iter().enumerate() {
                            if other != k {
                                rest *= edge.sign * values[edge.node];
                            }
                        }
                        slopes[edge.node] += rest;
                    }
                }
                Op::Reciprocal => {
                    if let Some(edge) = operands.first() {
                        slopes[edge.node] -= edge.sign * slope * values[index] * values[index];
                    }
                }
                Op::Sin => {
                    if let Some(edge) = operands.first() {
                        slopes[edge.node] += edge.sign * slope * operand(values, &operands[0]).cos();
                    }
                }
                Op::Cos => {
                    if let Some(edge) = operands.first() {
                        slopes[edge.node] -= edge.sign * slope * operand(values, &operands[0]).sin();
                    }
                }
                Op::Blend(share) => {
                    if let [before @ .., a, b] = operands {
                        let apart = operand(values, a) - operand(values, b);
                        let share = share + before.iter().map(|mask| MASK * operand(values, mask)).sum::<f64>();
                        slopes[a.node] += a.sign * slope * share;
                        slopes[b.node] += b.sign * slope * (1.0 - share);
                        for mask in before {
                            slopes[mask.node] += mask.sign * slope * MASK * apart;
                        }
                    }
                }
                Op::Part(share, _) => {
                    if let Some(edge) = operands.first() {
                        slopes[edge.node] += edge.sign * slope * share;
                    }
                }
                Op::Root => {
                    if let Some(edge) = operands.first() {
                        let sign = operand(values, edge).signum();
                        slopes[edge.node] += edge.sign * slope * sign * 0.5 / values[index];
                    }
                }
                Op::Beside(_, share) => {
                    for (edge, part) in operands.iter().zip(parts(share)) {
                        slopes[edge.node] += edge.sign * slope * part;
                    }
                }
                Op::Apart => {
                    if let [a, b, ..] = operands {
                        slopes[a.node] += a.sign * slope;
                        slopes[b.node] -= b.sign * slope;
                    }
                }
                Op::Call(call) => {
                    let x = arguments(values, operands);
                    for (k, edge) in operands.iter().enumerate().take(3) {
                        slopes[edge.node] += edge.sign * slope * call_slope(call, &x, k, values[index]);
                    }
                }
            }
        }
    }

    /// After `run`: a bound of what the slopes of one root are made of: the sum over all symbols, each counted with its
    /// `unit`, of all products along all ways with nothing cancelled, sines and cosines taken as one. Some roundings of it
    /// bound the error of the slopes (Higham 2002, chapter 3).
    pub(super) fn slope_bound(&self, values: &Values, root: usize, unit: impl Fn(usize) -> f64) -> f64 {
        let mut bound = 0.0;
        self.slope_bounds(values, root, |symbol, slope| bound += slope * unit(symbol));
        if bound.is_finite() { bound } else { 0.0 }
    }

    /// The same symbol by symbol: (symbol, bound of what the slope by it is made of).
    pub(super) fn slope_bounds(&self, values: &Values, root: usize, mut found: impl FnMut(usize, f64)) {
        let sizes = self.sizes(values, root);
        let values = &values.values;
        let (edge, needs) = (&self.roots[root], &self.needs[root]);
        let mut slopes = vec![0.0_f64; edge.node + 1];
        slopes[edge.node] = 1.0;
        for &index in needs.iter().rev() {
            let slope = slopes[index];
            if slope == 0.0 || !slope.is_finite() {
                continue;
            }
            let node = &self.nodes[index];
            let operands = &self.operands[node.first..node.last];
            for (k, edge) in operands.iter().enumerate() {
                let factor = match node.op {
                    Op::Literal(_) | Op::Symbol(_) | Op::Unknown => 0.0,
                    Op::Sum | Op::Sin | Op::Cos | Op::Apart | Op::Part(..) | Op::Beside(..) => 1.0,
                    Op::Root => 0.5 / values[index].abs(),
                    Op::Blend(_) => {
                        let mut all: Vec<f64> = operands.iter().map(|edge| sizes[edge.node]).collect();
                        all[k] = 1.0;
                        blend_bound(&all)
                    }
                    Op::Product => {
                        let others = operands.iter().enumerate().filter(|other| other.0 != k);
                        others.map(|other| sizes[other.1.node]).product()
                    }
                    Op::Reciprocal => values[index] * values[index],
                    Op::Call(call) => {
                        let x = arguments(values, operands);
                        call_slope(call, &x, k, values[index]).abs()
                    }
                };
                slopes[edge.node] += slope * factor;
            }
            if let Op::Symbol(id) = node.op {
                found(id, slope);
            }
        }
    }

    /// After `run`: what a root is made of: the sum of the sizes of all its terms, none cancelled, sines and cosines taken as one.
    pub(super) fn size_bound(&self, values: &Values, root: usize) -> f64 {
        self.sizes(values, root).last().copied().filter(|size| size.is_finite()).unwrap_or(0.0)
    }

    /// By node up to that of the root.
    fn sizes(&self, values: &Values, root: usize) -> Vec<f64> {
        let values = &values.values;
        let (edge, needs) = (&self.roots[root], &self.needs[root]);
        let mut sizes = vec![0.0_f64; edge.node + 1];
        for &index in needs {
            let node = &self.nodes[index];
            let operands = &self.operands[node.first..node.last];
            let size = |k: usize| sizes[operands[k].node];
            sizes[index] = match node.op {
                Op::Literal(_) | Op::Symbol(_) | Op::Unknown => values[index].abs(),
                Op::Sum => operands.iter().map(|edge| sizes[edge.node]).sum(),
                Op::Product => operands.iter().map(|edge| sizes[edge.node]).product(),
                Op::Reciprocal => size(0) * values[index] * values[index],
                Op::Sin | Op::Cos => 1.0,
                Op::Blend(_) => blend_bound(&operands.iter().map(|edge| sizes[edge.node]).collect::<Vec<_>>()),
                Op::Apart => (0..operands.len()).map(size).sum(),
                Op::Part(_, constant) => constant.abs() + size(0),
                Op::Beside(..) => values[index].abs() + (0..operands.len()).map(size).sum::<f64>(),
                Op::Root => values[index].abs() + 0.5 / values[index].abs() * size(0),
                Op::Call(call) => {
                    let x = arguments(values, operands);
                    let slope = |k: usize| call_slope(call, &x, k, values[index]).abs();
                    let parts = (0..operands.len().min(3)).map(|k| slope(k) * size(k));
                    parts.filter(|part| part.is_finite()).sum::<f64>() + values[index].abs()
                }
            };
        }
        sizes
    }

    /// Whether a root depends on sines or cosines.
    pub(super) fn turns(&self, root: usize) -> bool {
        self.needs[root].iter().any(|&index| matches!(self.nodes[index].op, Op::Sin | Op::Cos))
    }
}

fn operand(values: &[f64], edge: &Edge) -> f64 {
    edge.sign * values[edge.node]
}

/// Of a function, which reads as many of them as it has.
fn arguments(values: &[f64], operands: &[Edge]) -> [f64; 3] {
    [0, 1, 2].map(|k| operands.get(k).map_or(f64::NAN, |edge| operand(values, edge)))
}

/// How much counts of each operand.
fn parts(share: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(share), move |part| Some(share * part))
}

/// Of a blend, from bounds of its operands.
fn blend_bound(operands: &[f64]) -> f64 {
    let [before @ .., a, b] = operands else { return 0.0 };
    (1.0 + MASK * before.iter().sum::<f64>()) * (a + b)
}

/// Derivative of a function by its argument number k; `y` is its value.
fn call_slope(call: Call, x: &[f64; 3], k: usize, y: f64) -> f64 {
    let mask = |b: bool| f64::from(u8::from(b));
    match call {
        Call::Tan => 1.0 + y * y,
        Call::Asin => 1.0 / (1.0 - x[0] * x[0]).sqrt(),
        Call::Acos => -1.0 / (1.0 - x[0] * x[0]).sqrt(),
        Call::Atan => 1.0 / (1.0 + x[0] * x[0]),
        Call::Atan2 => {
            let square = x[0] * x[0] + x[1] * x[1];
            if k == 0 { x[1] / square } else { -x[0] / square }
        }
        Call::Sinh => x[0].cosh(),
        Call::Cosh => x[0].sinh(),
        Call::Tanh => 1.0 - y * y,
        Call::Exp => y,
        Call::Ln => 1.0 / x[0],
        Call::Powf if k == 0 => x[1] * x[0].powf(x[1] - 1.0),
        Call::Powf => y * x[0].ln(),
        Call::Sqrt => 0.5 / y,
        Call::Abs => x[0].signum(),
        Call::Min => mask((x[0] < x[1]) == (k == 0)),
        Call::Max => mask((x[0] > x[1]) == (k == 0)),
        Call::Select if k > 0 => mask((x[0] != 0.0) == (k == 1)),
        // None decides a position.
        Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => f64::NAN,
        Call::Epsilon
        | Call::Nan
        | Call::Signum
        | Call::Less
        | Call::LessEqual
        | Call::Equal
        | Call::And
        | Call::Or
        | Call::Not
        | Call::Select => 0.0,
    }
}
