//! Stage `verify`: a tape in numbers, and how its roots depend on every number in it.
//!
//! In: a tape and values of its symbols. Out: a [`Trace`] of all values; from it, by one reverse sweep, the slopes of a
//! weighted sum of roots by the symbols, and the greatest error that one rounding of every intermediate value can leave
//! in it: the sum of |slope| |value| over all operations (Bauer 1974). A solved system counts with what elimination leaves of its
//! equations; an iteration that has converged counts with its last round, whose start makes no difference.

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;
use crate::symbolic::doubled::Doubled;
use crate::symbolic::external;
use crate::symbolic::graph::SymbolId;

use super::arithmetic::{Arithmetic, slopes};
use super::linear::{self, LinearSolution};
use super::tape::{Edge, Op, Tape, Work};

/// Two numbers that are compared count as equal within this share of their size.
const NEAR: f64 = 1e-9;

/// Values of all nodes.
pub(super) struct Trace<'t, T> {
    pub tape: &'t Tape,
    values: Vec<T>,
    blocks: Vec<Results<T>>,
    /// Whether a comparison is so close that rounding may turn it.
    pub kink: bool,
    /// Whether numbers that are compared are equal, so that slopes are those of one side.
    pub corner: bool,
    /// Whether the rank of a system is.
    pub unclear: bool,
    rounds: usize,
}

#[derive(Clone)]
struct Results<T> {
    values: Vec<T>,
    solved: Option<LinearSolution<T>>,
}

/// What a weighted sum of roots answers to.
pub(super) struct Slopes {
    /// By symbol of the graph.
    pub symbols: Vec<Doubled>,
    /// In units of one rounding.
    pub bound: f64,
}

/// A system that was solved, to be recognised.
pub(super) struct Pivots {
    pub matrix: Vec<f64>,
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
}

impl<'t, T: Arithmetic> Trace<'t, T> {
    pub(super) fn new(tape: &'t Tape, symbol: &dyn Fn(SymbolId) -> Doubled) -> Trace<'t, T> {
        Trace::rounds(tape, symbol, usize::MAX)
    }

    /// With no more than so many rounds of each iteration.
    pub(super) fn rounds(tape: &'t Tape, symbol: &dyn Fn(SymbolId) -> Doubled, rounds: usize) -> Trace<'t, T> {
        let mut trace = Trace {
            tape,
            values: vec![T::ONE; tape.nodes.len()],
            blocks: vec![Results { values: Vec::new(), solved: None }; tape.blocks.len()],
            kink: false,
            corner: false,
            unclear: false,
            rounds,
        };
        trace.run(0, tape.nodes.len(), symbol);
        trace
    }

    pub(super) fn roots(&self) -> Vec<T> {
        self.tape.roots.iter().map(|&edge| self.value(edge)).collect()
    }

    fn value(&self, edge: Edge) -> T {
        let value = self.values[edge.node()];
        if edge.is_negative() { value.neg() } else { value }
    }

    fn list(&self, edges: &[Edge]) -> Vec<T> {
        edges.iter().map(|&edge| self.value(edge)).collect()
    }

    fn run(&mut self, from: usize, to: usize, symbol: &dyn Fn(SymbolId) -> Doubled) {
        let tape = self.tape;
        let mut at = from;
        while at < to {
            let node = &tape.nodes[at];
            let operands = tape.operands(node);
            let value = match node.op {
                Op::Literal(n) => T::number(n),
                Op::Symbol(id) => T::doubled(symbol(id)),
                Op::Sum => {
                    let mut sum = self.value(operands[0]);
                    for &edge in &operands[1..] {
                        sum = sum.add(self.value(edge));
                    }
                    sum
                }
                Op::Product => {
                    let mut product = self.value(operands[0]);
                    for &edge in &operands[1..] {
                        product = product.mul(self.value(edge));
                    }
                    product
                }
                Op::Reciprocal => self.value(operands[0]).reciprocal(),
                Op::Sqrt => self.value(operands[0]).sqrt(),
                Op::Cos => {
                    let (c, s) = self.value(operands[0]).point();
                    self.values[at + 1] = s;
                    c
                }
                Op::Sin | Op::Unknown | Op::Leave(_) => self.values[at],
                Op::Call(call) => self.call(call, operands),
                Op::Solve(block) => {
                    self.solve(block);
                    T::ONE
                }
                Op::Enter(block) => {
                    at = self.iterate(block, symbol);
                    continue;
                }
                Op::Output(block, k) => self.blocks[block].values[k],
            };
            self.values[at] = value;
            at += 1;
        }
    }

    fn call(&mut self, call: Call, operands: &[Edge]) -> T {
        let values = self.list(operands);
        match (call, &values[..]) {
            (Call::Less | Call::LessEqual | Call::Equal | Call::Min | Call::Max, [a, b]) => {
                let close = (a.high() - b.high()).abs() <= NEAR * (a.high().abs() + b.high().abs());
                self.corner |= close;
                // Numbers that are read are the same in every evaluation.
                let read = operands.iter().all(|&edge| self.is_read(edge));
                self.kink |= close && !(read && a.sub(*b).high() == 0.0);
            }
            (Call::Abs | Call::Signum, [a]) => {
                self.corner |= a.high() == 0.0;
                self.kink |= a.high() == 0.0 && !self.is_read(operands[0]);
            }
            _ => {}
        }
        T::call(call, &values)
    }

    /// Whether a number has no rounding of its own: a symbol, or a literal that double precision holds.
    fn is_read(&self, edge: Edge) -> bool {
        match self.tape.nodes[edge.node()].op {
            Op::Symbol(_) => true,
            Op::Literal(n) => n.doubled().low == 0.0,
            _ => false,
        }
    }

    fn solve(&mut self, block: usize) {
        let tape = self.tape;
        let Work::Solve { size, symmetric, groups } = &tape.blocks[block].work else { return };
        let values = self.list(&tape.blocks[block].operands);
        let (matrix, rest) = values.split_at(size * size);
        let (rhs, measures) = rest.split_at(*size);
        let solved = match symmetric {
            true => linear::solve_symmetric(matrix, rhs, (measures, groups), None),
            false => linear::solve(matrix, rhs, None),
        };
        self.unclear |= solved.unclear;
        let mut values = solved.x.clone();
        values.push(T::of(solved.rows.len() as f64));
        self.blocks[block] = Results { values, solved: Some(solved) };
    }

    /// Gives the node behind the body.
    fn iterate(&mut self, block: usize, symbol: &dyn Fn(SymbolId) -> Doubled) -> usize {
        let tape = self.tape;
        let Work::Iterate { unknowns, count, body } = &tape.blocks[block].work else { return usize::MAX };
        let (start, next) = tape.blocks[block].operands.split_at(unknowns.len());
        let mut values = self.list(start);
        let mut residual = T::ZERO;
        for _ in 0..self.rounds.min(*count) {
            for (&node, &value) in unknowns.iter().zip(&values) {
                self.values[node] = value;
            }
            self.run(body.0, body.1, symbol);
            values = self.list(next);
            residual = values.pop().or_fault("what an iteration computes ends with its residual");
        }
        values.push(residual);
        self.blocks[block] = Results { values, solved: None };
        body.1
    }

    /// Systems of lesser rank than size: their solutions depend on the order of pivots.
    pub(super) fn deficient(&self) -> Vec<Pivots> {
        let mut list = Vec::new();
        for (block, results) in self.tape.blocks.iter().zip(&self.blocks) {
            let (Work::Solve { size, .. }, Some(solved)) = (&block.work, &results.solved) else { continue };
            if solved.rows.len() < *size {
                let matrix = block.operands[..size * size].iter().map(|&edge| self.value(edge).high()).collect();
                list.push(Pivots { matrix, rows: solved.rows.clone(), columns: solved.columns.clone() });
            }
        }
        list
    }

    /// One reverse sweep for the sum of roots with these weights.
    pub(super) fn slopes<A: Arithmetic>(&self, weights: &[f64], symbols: usize) -> Slopes {
        let tape = self.tape;
        let of = |edge: Edge| A::doubled(self.value(edge).digits());
        let mut slopes_of = vec![A::ZERO; tape.nodes.len()];
        let mut results: Vec<Vec<A>> = self.blocks.iter().map(|block| vec![A::ZERO; block.values.len()]).collect();
        let mut out = Slopes { symbols: vec![Doubled::ZERO; symbols], bound: 0.0 };
        fn add<A: Arithmetic>(list: &mut [A], edge: Edge, x: A) {
            let slot = &mut list[edge.node()];
            *slot = slot.add(if edge.is_negative() { x.neg() } else { x });
        }
        for (&root, &weight) in tape.roots.iter().zip(weights) {
            if weight != 0.0 {
                add(&mut slopes_of, root, A::of(weight));
            }
        }
        for at in (0..tape.nodes.len()).rev() {
            let node = &tape.nodes[at];
            let slope = slopes_of[at];
            match node.op {
                Op::Solve(block) => {
                    out.bound += self.solve_back(block, &results[block], &mut slopes_of);
                    continue;
                }
                Op::Leave(block) => {
                    let Work::Iterate { unknowns, .. } = &tape.blocks[block].work else { continue };
                    let next = &tape.blocks[block].operands[unknowns.len()..];
                    for (&edge, &x) in next.iter().zip(&results[block]).take(unknowns.len()) {
                        add(&mut slopes_of, edge, x);
                    }
                    continue;
                }
                _ if slope.high() == 0.0 => continue,
                _ => {}
            }
            out.bound += (slope.high() * self.values[at].high()).abs();
            let operands = tape.operands(node);
            match node.op {
                Op::Symbol(id) => {
                    if let Some(slot) = out.symbols.get_mut(id.0) {
                        *slot = slot.add(slope.digits());
                    }
                }
                Op::Sum => operands.iter().for_each(|&edge| add(&mut slopes_of, edge, slope)),
                Op::Product => {
                    for (k, &edge) in operands.iter().enumerate() {
                        let mut rest = slope;
                        for (j, &other) in operands.iter().enumerate() {
                            if j != k {
                                rest = rest.mul(of(other));
                            }
                        }
                        add(&mut slopes_of, edge, rest);
                    }
                }
                Op::Reciprocal => {
                    let y = A::doubled(self.values[at].digits());
                    add(&mut slopes_of, operands[0], slope.mul(y).mul(y).neg());
                }
                Op::Sqrt => {
                    let y = A::doubled(self.values[at].digits());
                    add(&mut slopes_of, operands[0], slope.mul(y.add(y).reciprocal()));
                }
                Op::Cos => {
                    let s = A::doubled(self.values[at + 1].digits());
                    add(&mut slopes_of, operands[0], slope.mul(s).neg());
                }
                Op::Sin => {
                    let c = A::doubled(self.values[at - 1].digits());
                    add(&mut slopes_of, operands[0], slope.mul(c));
                }
                Op::Call(call) => self.call_back(call, operands, slope, &mut |edge, x| add(&mut slopes_of, edge, x)),
                Op::Output(block, k) => {
                    if let Some(slot) = results[block].get_mut(k) {
                        *slot = slot.add(slope);
                    }
                }
                Op::Literal(_) | Op::Unknown | Op::Enter(_) | Op::Leave(_) | Op::Solve(_) => {}
            }
        }
        out
    }

    fn call_back<A: Arithmetic>(&self, call: Call, operands: &[Edge], slope: A, add: &mut dyn FnMut(Edge, A)) {
        let values: Vec<A> = operands.iter().map(|&edge| A::doubled(self.value(edge).digits())).collect();
        match (call, &values[..]) {
            (Call::Select, [mask, ..]) => add(operands[if mask.high() != 0.0 { 1 } else { 2 }], slope),
            (Call::Atan2, [y, x]) => {
                let square = x.mul(*x).add(y.mul(*y)).reciprocal();
                add(operands[0], slope.mul(x.mul(square)));
                add(operands[1], slope.mul(y.mul(square)).neg());
            }
            _ if call.external().is_some() => {
                let digits: Vec<Doubled> = values.iter().map(|x| x.digits()).collect();
                let slopes =
                    external::slopes(call, &digits).or_fault("slopes of slopes are refused before numbers are");
                for (&edge, partial) in operands.iter().zip(slopes) {
                    add(edge, slope.mul(A::doubled(partial)));
                }
            }
            _ => {
                let highs: Vec<f64> = values.iter().map(|x| x.high()).collect();
                for (&edge, partial) in operands.iter().zip(slopes(call, &highs)) {
                    if partial != 0.0 {
                        add(edge, slope.mul(A::of(partial)));
                    }
                }
            }
        }
    }

    /// b' = A^-T x', A' = -b' x^T; gives the bound on what elimination leaves.
    fn solve_back<A: Arithmetic>(&self, block: usize, results: &[A], slopes_of: &mut [A]) -> f64 {
        let tape = self.tape;
        let (Work::Solve { size, .. }, Some(solved)) = (&tape.blocks[block].work, &self.blocks[block].solved) else {
            return 0.0;
        };
        if results.iter().all(|x| x.high() == 0.0) {
            return 0.0;
        }
        let n = *size;
        let values: Vec<A> =
            tape.blocks[block].operands.iter().map(|&edge| A::doubled(self.value(edge).digits())).collect();
        let y = linear::transposed(n, &values[..n * n], &solved.rows, &solved.columns, &results[..n]);
        let x: Vec<A> = solved.x.iter().map(|&x| A::doubled(x.digits())).collect();
        let mut add = |edge: Edge, value: A| {
            let slot = &mut slopes_of[edge.node()];
            *slot = slot.add(if edge.is_negative() { value.neg() } else { value });
        };
        let (matrix, rhs) = tape.blocks[block].operands.split_at(n * n);
        for (i, &value) in y.iter().enumerate() {
            if value.high() == 0.0 {
                continue;
            }
            for (j, &x) in x.iter().enumerate() {
                if x.high() != 0.0 {
                    add(matrix[i * n + j], value.mul(x).neg());
                }
            }
            add(rhs[i], value);
        }
        let scaled = |list: &[A], scales: &[f64]| -> f64 {
            list.iter().zip(scales).filter(|(_, s)| **s != 0.0).map(|(x, s)| (x.high() / s).abs()).sum()
        };
        n as f64 * scaled(&y, &solved.row_scales) * scaled(&x, &solved.column_scales)
    }
}
