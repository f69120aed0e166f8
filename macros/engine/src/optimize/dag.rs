//! Stage `optimize`: the form in which passes rewrite.
//!
//! In: a graph of scalars and its roots. Out: a [`Dag`] whose sums carry literal coefficients and whose products carry
//! none, so that a sign or a literal factor has one place to be. Nodes keep the prints of the symbolic stage, by which
//! [`Dag::is_sound`] tells after all passes whether every value is still what it was.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::ops::{Add, Mul, Neg};

use crate::contracts::call::Call;
use crate::contracts::cost::Cost;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::symbolic::fingerprint::{Point, Print};
use crate::symbolic::graph::{BlockKind, Name, PassHasher, SymbolId};
use crate::symbolic::number::Number;

use super::stage::Stage;

/// Position of a node.
pub type Id = usize;

/// The literal one, on which a sum's constant term hangs.
pub const ONE: Id = 0;

/// Operations; operands of products carry no sign, operands of sums a literal coefficient.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    One,
    Symbol(SymbolId),
    /// Coefficient and term, sorted by term, each term once. A single term is a multiple of another node.
    Sum(Vec<(Number, Id)>),
    /// At least two factors, sorted; powers repeat a factor.
    Product(Vec<Id>),
    Reciprocal(Id),
    Sqrt(Id),
    Sin(Id),
    Cos(Id),
    Call(Call, Vec<Id>),
    /// A result of the block with this number in [`Dag::blocks`].
    Output {
        block: usize,
        index: usize,
    },
    /// Computed elsewhere: what it is made of is not looked at.
    Stored,
}

/// Work that is no formula, see [`BlockKind`]. Its operands stay what they are: passes rewrite the nodes themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    pub kind: BlockKind,
    pub operands: Vec<Id>,
}

/// One node with what passes ask of it.
#[derive(Clone, Debug)]
pub struct Node {
    pub kind: Kind,
    pub print: Print,
    pub stage: Stage,
    pub name: Option<Name>,
    /// The name of a multiple of it.
    pub part_of: Option<String>,
}

/// Expressions under optimisation.
#[derive(Clone)]
pub struct Dag {
    pub nodes: Vec<Node>,
    pub blocks: Vec<Block>,
    index: HashMap<Print, Id, BuildHasherDefault<PassHasher>>,
    pub roots: Vec<(Number, Id)>,
    pub symbols: Vec<Symbol>,
    /// Where angles lie on the circle.
    pub(super) points: HashMap<Id, Point>,
    /// Readable names of the symbols, where known.
    pub symbol_names: Vec<String>,
}

impl Dag {
    /// Nothing but the literal one.
    pub fn new(symbols: &[Symbol]) -> Dag {
        let mut dag = Dag {
            nodes: Vec::new(),
            blocks: Vec::new(),
            index: HashMap::default(),
            roots: Vec::new(),
            symbols: symbols.to_vec(),
            points: HashMap::new(),
            symbol_names: Vec::new(),
        };
        dag.push(Kind::One, Print::ONE);
        dag
    }

    /// The number of a block, a new one if need be.
    pub(super) fn block(&mut self, block: Block) -> usize {
        // By value: a negative operand may stand in several nodes.
        let print = |id: &Id| self.nodes[*id].print;
        let same = |known: &Block| {
            let mut pairs = known.operands.iter().map(print).zip(block.operands.iter().map(print));
            known.kind == block.kind && known.operands.len() == block.operands.len() && pairs.all(|(a, b)| a == b)
        };
        self.blocks.iter().position(same).unwrap_or_else(|| {
            self.blocks.push(block);
            self.blocks.len() - 1
        })
    }

    /// A node for a multiple of another node: where an operand must be plain.
    pub fn plain(&mut self, (c, id): (Number, Id)) -> Id {
        if c.is_one() {
            return id;
        }
        let print = self.nodes[id].print.mul(c.print());
        match self.find(print) {
            Some((sign, found)) if sign.is_one() => found,
            _ => self.push(Kind::Sum(vec![(c, id)]), print),
        }
    }

    /// A node with this value up to sign.
    pub fn find(&self, print: Print) -> Option<(Number, Id)> {
        let id = *self.index.get(&print.canonical())?;
        let sign = if self.nodes[id].print == print { Number::ONE } else { Number::ONE.neg() };
        // Passes change nodes in place; an entry of a former value doesn't count.
        (self.nodes[id].print.canonical() == print.canonical()).then_some((sign, id))
    }

    /// A node with this value, a new one if need be.
    pub(super) fn make(&mut self, kind: Kind, print: Print) -> Id {
        match self.find(print) {
            Some((sign, id)) if sign.is_one() => id,
            _ => self.push(kind, print),
        }
    }

    /// A new node, whatever exists.
    pub fn push(&mut self, kind: Kind, print: Print) -> Id {
        let id = self.nodes.len();
        let stage = self.stage_of(&kind);
        self.nodes.push(Node { kind, print, stage, name: None, part_of: None });
        self.index.entry(print.canonical()).or_insert(id);
        id
    }

    /// Takes over the name of a multiple of a node: the node's own where it is plain or negative.
    pub(super) fn name(&mut self, (c, id): (Number, Id), name: &Name) {
        if !c.is_unit() && id != ONE {
            self.nodes[id].part_of.get_or_insert_with(|| name.text.clone());
            return;
        }
        let known = &mut self.nodes[id].name;
        if known.as_ref().is_none_or(|known| name.stands_alone && !known.stands_alone) {
            *known = Some(Name { is_minus: name.is_minus != c.is_negative(), ..name.clone() });
        }
    }

    fn stage_of(&self, kind: &Kind) -> Stage {
        match kind {
            Kind::One => Stage::Literal,
            Kind::Symbol(id) => Stage::of(self.symbols[id.0]),
            Kind::Stored => Stage::Position,
            _ => self.operands(kind).map(|id| self.nodes[id].stage).max().unwrap_or(Stage::Literal),
        }
    }

    /// A sum: gathers equal terms, drops zeros; a multiple of one node stays a multiple.
    pub fn sum(&mut self, terms: Vec<(Number, Id)>) -> (Number, Id) {
        let terms = self.normal_terms(terms);
        match terms[..] {
            [] => return (Number::ZERO, ONE),
            [single] => return single,
            _ => {}
        }
        let print = self.terms_print(&terms);
        match self.find(print) {
            Some(found) => found,
            None => (Number::ONE, self.push(Kind::Sum(terms), print)),
        }
    }

    /// The sine or cosine that completes the pair of an angle: its print follows from the other's up to sign, so it is
    /// looked up or, being new, drawn afresh.
    pub fn trigonometric(&mut self, angle: Id, sine: bool) -> Id {
        let kind = if sine { Kind::Sin(angle) } else { Kind::Cos(angle) };
        let print = self.points.get(&angle).map_or_else(
            || Print::opaque(u64::from(sine), &[self.nodes[angle].print]),
            |point| if sine { point.sin } else { point.cos },
        );
        match self.find(print) {
            Some((sign, found)) if sign.is_one() && self.nodes[found].kind == kind => found,
            _ => self.push(kind, print),
        }
    }

    /// A product of nodes without coefficients, with the signs of its factors in front.
    pub fn product(&mut self, mut factors: Vec<Id>) -> (Number, Id) {
        let mut coefficient = Number::ONE;
        factors.retain(|&f| f != ONE);
        for f in &mut factors {
            if let Kind::Sum(terms) = &self.nodes[*f].kind
                && let [(c, id)] = terms[..]
                && (c.is_unit() || id == ONE)
            {
                coefficient = coefficient.mul(c);
                *f = id;
            }
        }
        factors.retain(|&f| f != ONE);
        factors.sort_unstable();
        match factors[..] {
            [] => return (coefficient, ONE),
            [single] => return (coefficient, single),
            _ => {}
        }
        let print = self.factors_print(&factors);
        match self.find(print) {
            Some((c, id)) => (coefficient.mul(c), id),
            None => (coefficient, self.push(Kind::Product(factors), print)),
        }
    }

    pub fn terms_print(&self, terms: &[(Number, Id)]) -> Print {
        terms.iter().fold(Print::ZERO, |sum, &(c, id)| sum.add(self.nodes[id].print.mul(c.print())))
    }

    pub fn factors_print(&self, factors: &[Id]) -> Print {
        factors.iter().fold(Print::ONE, |product, &id| product.mul(self.nodes[id].print))
    }

    pub fn normal_terms(&self, mut terms: Vec<(Number, Id)>) -> Vec<(Number, Id)> {
        for term in &mut terms {
            while let Kind::Sum(inner) = &self.nodes[term.1].kind {
                match inner[..] {
                    [] => {
                        *term = (Number::ZERO, ONE);
                        break;
                    }
                    // A multiple of a multiple costs nothing more; the constant and shared multiples stay.
                    [(c, id)] if id == ONE || c.is_unit() || !term.0.is_unit() => *term = (term.0.mul(c), id),
                    _ => break,
                }
            }
        }
        terms.sort_by_key(|t| t.1);
        let mut merged: Vec<(Number, Id)> = Vec::with_capacity(terms.len());
        for (c, id) in terms {
            match merged.last_mut() {
                Some(last) if last.1 == id => last.0 = last.0.add(c),
                _ => merged.push((c, id)),
            }
        }
        merged.retain(|(c, _)| !c.is_zero());
        merged
    }

    /// Replaces a node's operation by another of the same value. Refuses what would make the node depend on itself: a
    /// part that was found by its value may have been derived from this very node.
    pub fn rewrite(&mut self, id: Id, kind: Kind) -> bool {
        if self.depends(&kind, id) {
            return false;
        }
        self.dissolve(id, kind);
        true
    }

    /// The same for an operation on what the node has read already, directly or not.
    pub fn dissolve(&mut self, id: Id, kind: Kind) {
        self.nodes[id].stage = self.stage_of(&kind);
        self.nodes[id].kind = kind;
    }

    /// Whether an operation reads a node, directly or not.
    fn depends(&self, kind: &Kind, id: Id) -> bool {
        let known: Vec<Id> = self.operands(&self.nodes[id].kind).collect();
        let mut stack: Vec<Id> = self.operands(kind).filter(|operand| !known.contains(operand)).collect();
        let mut seen = vec![false; if stack.is_empty() { 0 } else { self.nodes.len() }];
        while let Some(node) = stack.pop() {
            if node == id {
                return true;
            }
            if seen[node] || self.nodes[node].stage < self.nodes[id].stage {
                continue;
            }
            seen[node] = true;
            self.each_operand(&self.nodes[node].kind, &mut |operand| stack.push(operand));
        }
        false
    }

    /// Changes a node's value together with its operation; users must be changed too.
    pub fn replace(&mut self, id: Id, kind: Kind, print: Print) {
        self.nodes[id].stage = self.stage_of(&kind);
        self.nodes[id].kind = kind;
        self.nodes[id].print = print;
        self.index.entry(print.canonical()).or_insert(id);
    }

    /// Nodes that nothing needs any more don't follow when others are scaled: they must not be found again.
    pub fn forget_dead(&mut self) {
        self.index.clear();
        self.index.insert(Print::ONE, ONE);
        for id in self.order() {
            self.index.entry(self.nodes[id].print.canonical()).or_insert(id);
        }
    }

    /// Values of the roots.
    pub fn root_prints(&self) -> Vec<Print> {
        self.roots.iter().map(|&(c, id)| self.nodes[id].print * c.print()).collect()
    }

    /// Whether the roots, computed anew from the symbols, have these values: the identity test, in every build.
    pub fn is_sound(&self, expected: &[Print]) -> bool {
        let mut prints: Vec<Option<Print>> = vec![None; self.nodes.len()];
        for id in self.order() {
            let node = &self.nodes[id];
            let value = |id: Id| prints[id].or_fault("operands stand before their users");
            let print = match &node.kind {
                Kind::One => Print::ONE,
                Kind::Sum(terms) => terms.iter().fold(Print::ZERO, |sum, &(c, t)| sum + value(t) * c.print()),
                Kind::Product(factors) => factors.iter().fold(Print::ONE, |product, &f| product * value(f)),
                Kind::Reciprocal(x) if !value(*x).is_zero() => value(*x).inverse(),
                // Opaque: what it was, of operands that are what they were.
                kind => {
                    if self.operands(kind).any(|operand| value(operand) != self.nodes[operand].print) {
                        return false;
                    }
                    node.print
                }
            };
            prints[id] = Some(print);
        }
        let value = |id: Id| prints[id].or_fault("roots stand in the order of nodes");
        self.roots.len() == expected.len()
            && self.roots.iter().zip(expected).all(|(&(c, id), &print)| value(id) * c.print() == print)
    }

    /// Nodes that the roots need, operands before users.
    pub fn order(&self) -> Vec<Id> {
        let mut state = vec![0_u8; self.nodes.len()];
        let mut order = Vec::new();
        let mut seen = vec![false; self.blocks.len()];
        let mut stack: Vec<(Id, bool)> = self.roots.iter().rev().map(|r| (r.1, false)).collect();
        while let Some((id, done)) = stack.pop() {
            if done {
                order.push(id);
                continue;
            }
            if state[id] != 0 {
                continue;
            }
            state[id] = 1;
            stack.push((id, true));
            // What a block reads stands before its first result.
            if self.is_seen(id, &mut seen) {
                continue;
            }
            let before = stack.len();
            self.each_operand(&self.nodes[id].kind, &mut |id| stack.push((id, false)));
            stack[before..].reverse();
        }
        order
    }

    /// How often each node is used by living nodes and roots.
    pub fn uses(&self, order: &[Id]) -> Vec<u32> {
        let mut uses = vec![0; self.nodes.len()];
        let mut seen = vec![false; self.blocks.len()];
        for &id in order {
            if self.is_seen(id, &mut seen) {
                continue;
            }
            self.each_operand(&self.nodes[id].kind, &mut |operand| uses[operand] += 1);
        }
        for &(_, id) in &self.roots {
            uses[id] += 1;
        }
        uses
    }

    /// Whether a node is a further result of a block that has been seen.
    fn is_seen(&self, id: Id, seen: &mut [bool]) -> bool {
        match self.nodes[id].kind {
            Kind::Output { block, .. } => std::mem::replace(&mut seen[block], true),
            _ => false,
        }
    }

    /// Nodes that an operation reads.
    pub fn operands<'a>(&'a self, kind: &'a Kind) -> Box<dyn Iterator<Item = Id> + 'a> {
        match kind {
            Kind::One | Kind::Symbol(_) | Kind::Stored => Box::new(std::iter::empty()),
            Kind::Sum(terms) => Box::new(terms.iter().map(|t| t.1)),
            Kind::Product(list) | Kind::Call(_, list) => Box::new(list.iter().copied()),
            Kind::Reciprocal(x) | Kind::Sqrt(x) | Kind::Sin(x) | Kind::Cos(x) => Box::new(std::iter::once(*x)),
            Kind::Output { block, .. } => Box::new(self.blocks[*block].operands.iter().copied()),
        }
    }

    /// Visits them: half the time of [`Dag::operands`] where this library is not optimised, as inside of a user's build.
    fn each_operand(&self, kind: &Kind, visit: &mut impl FnMut(Id)) {
        let list = match kind {
            Kind::One | Kind::Symbol(_) | Kind::Stored => return,
            Kind::Sum(terms) => {
                for term in terms {
                    visit(term.1);
                }
                return;
            }
            Kind::Reciprocal(x) | Kind::Sqrt(x) | Kind::Sin(x) | Kind::Cos(x) => return visit(*x),
            Kind::Product(list) | Kind::Call(_, list) => list,
            Kind::Output { block, .. } => &self.blocks[*block].operands,
        };
        for &id in list {
            visit(id);
        }
    }

    /// Operations of all living nodes at a stage later than parameters, and of those at parameters.
    pub fn cost(&self) -> (Cost, Cost) {
        let (mut runtime, mut prelude) = (Cost::default(), Cost::default());
        let order = self.order();
        let mut angles = std::collections::HashSet::new();
        let uses = self.uses(&order);
        let mut seen = vec![false; self.blocks.len()];
        let late = self.late_masks(&order);
        for &id in &order {
            let node = &self.nodes[id];
            let cost = match node.stage {
                Stage::Literal => continue,
                Stage::Parameter if !late.contains(&id) => &mut prelude,
                _ => &mut runtime,
            };
            match &node.kind {
                Kind::One | Kind::Symbol(_) | Kind::Stored => {}
                Kind::Sum(terms) => {
                    cost.add += terms.len() as u32 - 1;
                    cost.mul += terms.iter().filter(|(c, id)| *id != ONE && !c.is_unit()).count() as u32;
                }
                Kind::Product(factors) => {
                    // A reciprocal used once makes a quotient of the product.
                    let quotients = factors.iter().filter(|&&f| uses[f] == 1 && self.is_quotient(f)).count() as u32;
                    cost.mul += factors.len() as u32 - 1 - quotients.min(1);
                }
                Kind::Reciprocal(_) => cost.div += 1,
                Kind::Sqrt(_) => cost.sqrt += 1,
                Kind::Sin(angle) | Kind::Cos(angle) => {
                    if angles.insert(*angle) {
                        cost.sincos += 1;
                    }
                }
                Kind::Call(Call::Nan, _) => {}
                Kind::Call(Call::Min | Call::Max | Call::Select, _) => cost.add += 1,
                Kind::Call(call, _) if call.is_comparison() => cost.compare += 1,
                Kind::Call(..) => cost.other += 1,
                Kind::Output { .. } if self.is_seen(id, &mut seen) => {}
                Kind::Output { block, .. } => *cost = cost.plus(Cost::of_block(&self.blocks[*block].kind)),
            }
        }
        for &(c, id) in &self.roots {
            let stage = self.nodes[id].stage;
            if id != ONE && !c.is_unit() {
                if stage <= Stage::Parameter { prelude.mul += 1 } else { runtime.mul += 1 }
            }
        }
        (runtime, prelude)
    }

    /// Masks of parameters that later work reads: they run there.
    fn late_masks(&self, order: &[Id]) -> std::collections::HashSet<Id> {
        let mut late = std::collections::HashSet::new();
        for &id in order.iter().rev() {
            if self.nodes[id].stage > Stage::Parameter || late.contains(&id) {
                let masks = self.operands(&self.nodes[id].kind);
                late.extend(masks.filter(|&id| self.nodes[id].stage == Stage::Parameter && self.is_mask(id)));
            }
        }
        late
    }

    /// Whether a node's value is a mask, see [`Call::is_mask`].
    pub fn is_mask(&self, id: Id) -> bool {
        matches!(&self.nodes[id].kind, Kind::Call(call, _) if call.is_mask())
    }

    /// A reciprocal that runs in the stage of its users.
    pub fn is_quotient(&self, id: Id) -> bool {
        matches!(self.nodes[id].kind, Kind::Reciprocal(_)) && self.nodes[id].stage > Stage::Parameter
    }
}

/// Residue of a ratio of coefficients, sign included.
pub fn ratio(a: Number, b: Number) -> Print {
    a.residue * b.residue.inverse()
}

#[cfg(test)]
mod tests {
    use super::Dag;
    use crate::contracts::symbol::Symbol;
    use crate::symbolic::fingerprint::Print;

    #[test]
    fn a_pair_is_completed_once() {
        let mut dag = Dag::new(&[Symbol::Time]);
        let angle = dag.push(super::Kind::Symbol(crate::symbolic::graph::SymbolId(0)), Print::opaque(7, &[]));
        let [sin, cos] = [true, false].map(|sine| dag.trigonometric(angle, sine));
        assert_ne!(sin, cos);
        assert_eq!([true, false].map(|sine| dag.trigonometric(angle, sine)), [sin, cos]);
    }
}
