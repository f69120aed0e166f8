//! Stage `optimize`: ways into the form in which passes rewrite.
//!
//! In: a graph of scalars, or another DAG. Out: the same expressions in a [`Dag`], literals drawn into coefficients.

use std::collections::HashMap;
use std::ops::{Div, Mul, Neg};

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{BlockId, Graph, Scalar, ScalarNode};
use crate::symbolic::number::Number;

use super::dag::{Block, Dag, Id, Kind, ONE};

impl Dag {
    /// Takes over the roots of a graph of scalars. `symbols` tells what each of its symbols is.
    pub fn import(graph: &Graph, roots: &[Scalar], symbols: &[Symbol]) -> Dag {
        let mut dag = Dag::new(symbols);
        let mut map: HashMap<usize, (Number, Id)> = HashMap::new();
        let mut blocks = HashMap::new();
        let reachable = graph.reachable_scalars(roots);
        let shared = graph.shared(&reachable, roots);
        for index in reachable {
            let s = graph.scalar_at(index);
            let mut value = dag.import_node(graph, s, &map, &mut blocks);
            // A multiple that several places use stays a value of its own.
            if shared[index] && value.1 != ONE && !value.0.is_unit() {
                value = (Number::ONE, dag.plain(value));
            }
            if let Some(name) = graph.name_of(s) {
                dag.name(value, name);
            }
            map.insert(index, value);
        }
        dag.roots = roots.iter().map(|&root| operand(&map, root)).collect();
        dag
    }

    fn import_node(
        &mut self,
        graph: &Graph,
        s: Scalar,
        map: &HashMap<usize, (Number, Id)>,
        blocks: &mut HashMap<BlockId, usize>,
    ) -> (Number, Id) {
        match graph.node(s) {
            ScalarNode::Literal(n) => (*n, ONE),
            ScalarNode::Symbol(id) => (Number::ONE, self.make(Kind::Symbol(*id), graph.print(s))),
            ScalarNode::Sum(terms) => {
                let terms = terms.iter().map(|&t| operand(map, t)).collect();
                self.sum(terms)
            }
            ScalarNode::Product(factors) => {
                let mut coefficient = Number::ONE;
                let mut ids = Vec::with_capacity(factors.len());
                for &factor in factors {
                    let (c, id) = operand(map, factor);
                    coefficient = coefficient.mul(c);
                    ids.push(id);
                }
                let (c, id) = self.product(ids);
                (coefficient.mul(c), id)
            }
            ScalarNode::Reciprocal(x) => {
                let (c, id) = self.divisor(operand(map, *x));
                (Number::ONE.div(c), self.make(Kind::Reciprocal(id), self.nodes[id].print.inverse()))
            }
            ScalarNode::Sqrt(x) => {
                let x = self.plain(operand(map, *x));
                (Number::ONE, self.make(Kind::Sqrt(x), graph.print(s)))
            }
            ScalarNode::Sin(angle) => {
                let point = graph.point(*angle);
                let angle = self.plain(operand(map, *angle));
                self.points.insert(angle, point);
                (Number::ONE, self.make(Kind::Sin(angle), graph.print(s)))
            }
            ScalarNode::Cos(angle) => {
                let point = graph.point(*angle);
                let angle = self.plain(operand(map, *angle));
                self.points.insert(angle, point);
                (Number::ONE, self.make(Kind::Cos(angle), graph.print(s)))
            }
            ScalarNode::Call(call, arguments) => {
                let arguments = arguments.iter().map(|&a| self.plain(operand(map, a))).collect();
                (Number::ONE, self.make(Kind::Call(*call, arguments), graph.print(s)))
            }
            &ScalarNode::Angle(cos, sin) => {
                let point = [sin, cos].map(|x| self.plain(operand(map, x))).to_vec();
                (Number::ONE, self.make(Kind::Call(Call::Atan2, point), graph.print(s)))
            }
            &ScalarNode::Output(id, index) => {
                // The operands of a block are many: once is enough.
                let known = blocks.get(&id).copied();
                let block = known.unwrap_or_else(|| {
                    let block = graph.block(id);
                    let operands = block.operands.iter().map(|&s| self.plain(operand(map, s))).collect();
                    self.block(Block { kind: block.kind.clone(), operands })
                });
                blocks.insert(id, block);
                (Number::ONE, self.make(Kind::Output { block, index }, graph.print(s)))
            }
            // Lowering leaves no vectors; were one left, it would stand out as a symbol that nobody knows.
            ScalarNode::Component(..) | ScalarNode::Dot(..) => (Number::ZERO, ONE),
        }
    }

    /// A divisor whose coefficient has all its digits: what has cancelled is divided by as it stands.
    fn divisor(&mut self, (c, id): (Number, Id)) -> (Number, Id) {
        if c.is_sharp() { (c, id) } else { (Number::ONE, self.plain((c, id))) }
    }

    /// Takes over a node of another DAG with the same symbols, and what it needs. `map` remembers what has been taken.
    pub fn adopt(&mut self, from: &Dag, id: Id, map: &mut HashMap<Id, (Number, Id)>) -> (Number, Id) {
        if id == ONE {
            return (Number::ONE, ONE);
        }
        if let Some(&known) = map.get(&id) {
            return known;
        }
        let node = &from.nodes[id];
        let value = match &node.kind {
            Kind::One => (Number::ONE, ONE),
            Kind::Symbol(_) => (Number::ONE, self.make(node.kind.clone(), node.print)),
            Kind::Sum(terms) => {
                let terms = terms.iter().map(|&(c, t)| {
                    let (d, t) = self.adopt(from, t, map);
                    (c.mul(d), t)
                });
                let terms = terms.collect();
                self.sum(terms)
            }
            Kind::Product(factors) => {
                let mut coefficient = Number::ONE;
                let factors = factors.iter().map(|&f| {
                    let (c, f) = self.adopt(from, f, map);
                    coefficient = coefficient.mul(c);
                    f
                });
                let factors = factors.collect();
                let (c, id) = self.product(factors);
                (coefficient.mul(c), id)
            }
            Kind::Reciprocal(x) => {
                let x = self.adopt(from, *x, map);
                let (c, x) = self.divisor(x);
                (Number::ONE.div(c), self.make(Kind::Reciprocal(x), self.nodes[x].print.inverse()))
            }
            &Kind::Output { block, index } => {
                let Block { kind, operands } = &from.blocks[block];
                let take = |x: &Id| {
                    let value = self.adopt(from, *x, map);
                    self.plain(value)
                };
                let operands = operands.iter().map(take).collect();
                let block = self.block(Block { kind: kind.clone(), operands });
                (Number::ONE, self.make(Kind::Output { block, index }, node.print))
            }
            kind => {
                let mut take = |x: Id| {
                    let value = self.adopt(from, x, map);
                    self.plain(value)
                };
                let kind = match kind {
                    Kind::Sqrt(x) => Kind::Sqrt(take(*x)),
                    Kind::Sin(x) => Kind::Sin(take(*x)),
                    Kind::Cos(x) => Kind::Cos(take(*x)),
                    Kind::Call(call, list) => Kind::Call(*call, list.iter().map(|&x| take(x)).collect()),
                    other => other.clone(),
                };
                (Number::ONE, self.make(kind, node.print))
            }
        };
        if let Some(name) = &node.name {
            self.name(value, name);
        }
        if let Some(text) = &node.part_of {
            self.nodes[value.1].part_of.get_or_insert_with(|| text.clone());
        }
        map.insert(id, value);
        value
    }
}

fn operand(map: &HashMap<usize, (Number, Id)>, s: Scalar) -> (Number, Id) {
    let (c, id) = map.get(&s.index()).copied().or_fault("operands are imported before their users");
    (if s.is_negative() { c.neg() } else { c }, id)
}
