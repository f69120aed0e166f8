//! Stage `symbolic`, writing: nodes as polynomials.
//!
//! In: a graph of scalars. Out: the wanted values as polynomials in atoms, and definitions of what is written apart. A product that would
//! have too many terms keeps a factor whole: this gets a name and an equation of its own, once, however often it is used.

use std::collections::{HashMap, HashSet};

use crate::contracts::call::Call;
use crate::invariant::fault::{OrFault, raise};
use crate::symbolic::graph::{AnyNode, BlockKind, Graph, Scalar, ScalarNode};
use crate::symbolic::number::Number;

use super::polynomial::{Atoms, Head, Polynomial};

/// A value with an equation of its own.
pub(super) struct Definition {
    /// What the graph calls it, if it does.
    pub name: Option<String>,
    /// None of what is no formula: a result of a system of equations.
    pub value: Option<Polynomial>,
}

/// What goes through the graph.
pub(super) struct Composer<'g> {
    graph: &'g Graph,
    pub atoms: Atoms,
    pub definitions: Vec<Definition>,
    values: HashMap<usize, Polynomial>,
    /// Where a value of more than one term is defined already.
    known: HashMap<usize, Polynomial>,
    /// Most terms of one value.
    most: usize,
    /// By node, how often it is read.
    uses: HashMap<usize, usize>,
    /// Nodes that are written apart wherever they are read.
    apart: HashSet<usize>,
}

/// A sum of so few terms stays in brackets where it is not multiplied out.
const MOST_IN_BRACKETS: usize = 3;

impl<'g> Composer<'g> {
    pub(super) fn new(graph: &'g Graph, most: usize) -> Self {
        Composer {
            graph,
            atoms: Atoms::default(),
            definitions: Vec::new(),
            values: HashMap::new(),
            known: HashMap::new(),
            most,
            uses: HashMap::new(),
            apart: HashSet::new(),
        }
    }

    /// Twice: what one user wants written apart all others read by its name, those before it too.
    pub(super) fn compose(&mut self, roots: &[Scalar]) -> Vec<Polynomial> {
        let nodes = self.graph.reachable(roots);
        for &node in &nodes {
            self.graph.each_operand(node, &mut |operand| {
                if let AnyNode::Scalar(index) = operand {
                    *self.uses.entry(index).or_default() += 1;
                }
            });
        }
        self.pass(&nodes);
        if !self.known.is_empty() {
            let shared = |index: &usize| self.uses.get(index).is_some_and(|&uses| uses > 1);
            let apart = self.known.keys().copied().filter(shared).collect();
            let uses = std::mem::take(&mut self.uses);
            *self = Composer { apart, uses, ..Composer::new(self.graph, self.most) };
            self.pass(&nodes);
        }
        roots.iter().map(|&root| self.value(root)).collect()
    }

    /// Operands before users, so nothing here recurses deeply.
    fn pass(&mut self, nodes: &[AnyNode]) {
        for &node in nodes {
            let AnyNode::Scalar(index) = node else { continue };
            let s = Scalar::new(index, false);
            let value = self.node(s);
            let is_long = value.terms.len() > self.most / 3;
            self.values.insert(index, value);
            // What is long and read several times is written once.
            let shared = is_long && self.uses.get(&index).is_some_and(|&uses| uses > 1);
            if shared || self.apart.contains(&index) {
                let whole = self.whole(s);
                self.values.insert(index, whole);
            }
        }
    }

    fn value(&self, s: Scalar) -> Polynomial {
        let value = self.values.get(&s.index()).cloned().or_fault("operands stand before what reads them");
        if s.is_negative() { value.scaled(-Number::ONE) } else { value }
    }

    /// As one term: a definition, if it has more.
    fn whole(&mut self, s: Scalar) -> Polynomial {
        let value = self.values.get(&s.index()).cloned().or_fault("operands stand before what reads them");
        if value.terms.len() < 2 {
            return self.value(s);
        }
        let known = match self.known.get(&s.index()) {
            Some(known) => known.clone(),
            None if value.terms.len() <= MOST_IN_BRACKETS => {
                Polynomial::atom(self.atoms.of(Head::Bracket, vec![value]), 1)
            }
            None => {
                // A name may be that of minus the value: then that is what gets an equation.
                let name = self.graph.name_of(s);
                let sign = if name.is_some_and(|name| name.is_minus) { -Number::ONE } else { Number::ONE };
                let name = name.map(|name| name.text.clone());
                let atom = self.define(Definition { name, value: Some(value.scaled(sign)) }).scaled(sign);
                self.known.insert(s.index(), atom.clone());
                atom
            }
        };
        if s.is_negative() { known.scaled(-Number::ONE) } else { known }
    }

    fn define(&mut self, definition: Definition) -> Polynomial {
        let atom = self.atoms.defined(self.definitions.len());
        self.definitions.push(definition);
        Polynomial::atom(atom, 1)
    }

    fn node(&mut self, s: Scalar) -> Polynomial {
        let graph = self.graph;
        match graph.node(s) {
            ScalarNode::Literal(n) => Polynomial::number(*n),
            ScalarNode::Symbol(id) => Polynomial::atom(self.atoms.symbol(*id), 1),
            ScalarNode::Sum(terms) => self.sum(terms),
            ScalarNode::Product(factors) => self.product(factors),
            ScalarNode::Reciprocal(x) => self.inverse(*x),
            ScalarNode::Sqrt(x) => self.root(*x),
            ScalarNode::Sin(angle) => self.trigonometric(Head::Sine, *angle),
            ScalarNode::Cos(angle) => self.trigonometric(Head::Cosine, *angle),
            ScalarNode::Call(call, list) => self.applied(Head::Call(*call), list),
            ScalarNode::Angle(cos, sin) => self.applied(Head::Call(Call::Atan2), &[*sin, *cos]),
            ScalarNode::Output(id, k) => {
                let block = graph.block(*id);
                let what = match block.kind {
                    BlockKind::Solve { .. } | BlockKind::Eliminate { .. } => "solution",
                    BlockKind::Iterate { .. } => "found",
                };
                let name =
                    graph.name_of(s).map_or_else(|| format!("{what}_{}_{}", id.0, k), |name| name.of_sign(false));
                self.define(Definition { name: Some(name), value: None })
            }
            // The graph has been lowered.
            ScalarNode::Component(..) | ScalarNode::Dot(..) => raise("a lowered graph has scalars alone"),
        }
    }

    fn sum(&mut self, terms: &[Scalar]) -> Polynomial {
        let mut result = Polynomial::default();
        for &term in terms {
            let value = self.value(term);
            result.add(&value, Number::ONE);
        }
        self.atoms.meet(&mut result);
        if result.terms.len() <= self.most {
            return result;
        }
        // The longest terms are written apart.
        let mut lengths: Vec<(usize, usize)> =
            terms.iter().enumerate().map(|(k, &t)| (self.value(t).terms.len(), k)).collect();
        lengths.sort_by_key(|&(n, k)| (std::cmp::Reverse(n), k));
        let mut rest: usize = lengths.iter().map(|entry| entry.0).sum();
        let mut apart = vec![false; terms.len()];
        for (n, k) in lengths {
            if rest <= self.most || n < 2 {
                break;
            }
            apart[k] = true;
            rest -= n - 1;
        }
        let mut result = Polynomial::default();
        for (&term, apart) in terms.iter().zip(apart) {
            let value = if apart { self.whole(term) } else { self.value(term) };
            result.add(&value, Number::ONE);
        }
        result
    }

    /// A sign that conditions choose has a name and a line, as the sign before a root of a book.
    fn choice(&mut self, s: Scalar) {
        let is_number = |s: Scalar| matches!(self.graph.node(s), ScalarNode::Literal(_));
        let is_choice = match self.graph.node(s) {
            ScalarNode::Call(Call::Select, list) => list.get(1).is_some_and(|&chosen| is_number(chosen)),
            _ => false,
        };
        if !is_choice || self.known.contains_key(&s.index()) {
            return;
        }
        let value = self.value(s.positive());
        let name = self.graph.name_of(s).map_or_else(|| "branch".to_owned(), |name| name.text.clone());
        let atom = self.define(Definition { name: Some(name), value: Some(value) });
        self.known.insert(s.index(), atom.clone());
        self.values.insert(s.index(), atom);
    }

    fn product(&mut self, factors: &[Scalar]) -> Polynomial {
        factors.iter().for_each(|&factor| self.choice(factor));
        let expanded = factors.iter().try_fold(Polynomial::number(Number::ONE), |product, &factor| {
            let value = self.value(factor);
            self.atoms.product(&product, &value, self.most)
        });
        if let Some(product) = expanded.filter(|product| product.terms.len() <= self.most) {
            return product;
        }
        // The shortest sum is multiplied out, all others stay whole.
        let mut order: Vec<Scalar> = factors.to_vec();
        order.sort_by_key(|&factor| self.value(factor).terms.len());
        let mut product = Polynomial::number(Number::ONE);
        for factor in order {
            let value = self.value(factor);
            product = match self.atoms.product(&product, &value, self.most / 4) {
                Some(product) => product,
                None => {
                    let whole = self.whole(factor);
                    // One term: the product has as many as before.
                    self.atoms
                        .product(&product, &whole, usize::MAX)
                        .or_fault("a product without a bound is multiplied out")
                }
            };
        }
        product
    }

    fn inverse(&mut self, x: Scalar) -> Polynomial {
        let value = self.value(x);
        if let Some((monomial, n)) = value.single() {
            let mut result = Polynomial::default();
            result.add_term(monomial.iter().map(|&(atom, e)| (atom, -e)).collect(), Number::ONE / n);
            return result;
        }
        self.applied(Head::Inverse, &[x])
    }

    fn root(&mut self, x: Scalar) -> Polynomial {
        self.applied(Head::Root, &[x])
    }

    fn trigonometric(&mut self, head: Head, angle: Scalar) -> Polynomial {
        let angle = self.value(angle);
        self.atoms.trigonometric(head, &angle)
    }

    fn applied(&mut self, head: Head, list: &[Scalar]) -> Polynomial {
        let arguments =
            list.iter().map(|&x| if self.value(x).terms.len() > self.most / 4 { self.whole(x) } else { self.value(x) });
        let mut arguments: Vec<Polynomial> = arguments.collect();
        if head == Head::Root {
            arguments.iter_mut().for_each(|argument| self.atoms.complement(argument));
        }
        Polynomial::atom(self.atoms.of(head, arguments), 1)
    }
}
