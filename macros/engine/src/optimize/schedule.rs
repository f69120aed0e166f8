//! Stage `optimize`, last pass: from a DAG to a straight-line program.
//!
//! In: an optimised DAG. Out: a [`Program`]. Values that are used more than once or have a name get a statement of their
//! own; the others stand in the expression that uses them, up to a readable size. Signs are chosen so that a sum starts
//! with a positive term where it can. Statements come in the order in which results need them, which keeps few values
//! alive; then sines are gathered ([`super::together`]), and long functions get an order of their own ([`super::order`]).

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::contracts::call::{Call, ExternalId};
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::limbs::Limbs;
use crate::symbolic::fingerprint::Print;
use crate::symbolic::graph::{BlockKind, SymbolId};
use crate::symbolic::number::Number;

use super::dag::{Block, Dag, Id, Kind, ONE};
use super::fold;
use super::fuse;
use super::hints::{headings, hints};
use super::names::Names;
use super::order;
use super::packs;
use super::program::{Expression, FieldId, Local, Program, Sine, Statement};
use super::stage::Stage;
use super::together;
use super::wording::{Wording, behind};

/// Operands that one expression may hold before a part of it becomes a statement.
const READABLE: usize = 10;

/// Fields of `Model` by the print that stands for their value and its negative, with the print of the value itself.
pub type Fields = HashMap<Print, (FieldId, Print)>;

/// Prints a DAG as a program. Nodes found in `fields` are read from there; `names` are those of fields.
pub fn schedule(dag: &Dag, fields: &Fields, names: &[String]) -> Program {
    schedule_as(dag, fields, names, Form::default())
}

/// What becomes of a program's operations.
#[derive(Clone, Copy, Debug, Default)]
pub struct Form<'a> {
    /// Limbs that are alike go into packs.
    pub limbs: Option<&'a Limbs>,
    /// Products are fused to sums.
    pub fused: bool,
    /// Numbers of results that a later program hands to functions with a bounded domain: see [`fuse`].
    pub bounded: &'a [usize],
    /// Long programs get an order of their own: not where they are run once.
    pub ordered: bool,
}

/// The same in a form.
pub fn schedule_as(dag: &Dag, fields: &Fields, names: &[String], form: Form<'_>) -> Program {
    let mut scheduler = Scheduler::new(dag, fields, names);
    scheduler.limbs = form.limbs;
    scheduler.make(dag.roots.iter().map(|root| root.1));
    let results = dag.roots.iter().map(|&root| scheduler.term(root)).collect();
    let mut program = scheduler.program;
    program.results = results;
    if let Some(limbs) = form.limbs {
        if !limbs.numbers.is_empty() {
            fold::fold(&mut program);
        }
        program = packs::pack(program, limbs);
    }
    if form.fused {
        fuse::fuse(&mut program, form.bounded);
    }
    program.statements = together::gather(program.statements);
    if form.ordered {
        let after: Vec<&Expression> = program.results.iter().collect();
        program.statements = order::order(program.statements, &after);
    }
    program
}

/// A function with the values of its arguments: a negative one may stand in several nodes.
type Sloped = (ExternalId, Vec<Print>);

struct Scheduler<'a> {
    dag: &'a Dag,
    fields: &'a Fields,
    uses: Vec<u32>,
    /// Nodes whose emitted value is minus their own.
    flipped: Vec<bool>,
    /// How a node is written where it is used, and its number of operands.
    written: Vec<Option<(Expression, usize)>>,
    angles: HashMap<Id, (Local, Local)>,
    /// Angles whose sine or cosine is used.
    sines: HashSet<Id>,
    cosines: HashSet<Id>,
    /// Calls of the user's own functions of which slopes are read: the nodes of their value and of each slope.
    sloped: HashMap<Sloped, Vec<Option<Id>>>,
    /// Locals of those that have been written, in the same order.
    called: HashMap<Sloped, Vec<Local>>,
    hints: Vec<Option<String>>,
    headings: Vec<Option<Arc<str>>>,
    /// Of what is being written.
    heading: Option<Arc<str>>,
    names: Names,
    wording: Wording<'a>,
    /// What belongs into the body of each iteration, and what its body reads.
    loops: Vec<Loop>,
    /// What the bodies read.
    boundary: HashSet<Id>,
    /// Locals of the results of blocks that have been written.
    results: HashMap<usize, Vec<Local>>,
    /// Whose numbers symbols may stand for.
    limbs: Option<&'a Limbs>,
    program: Program,
}

impl<'a> Scheduler<'a> {
    fn new(dag: &'a Dag, fields: &'a Fields, names: &'a [String]) -> Self {
        let order = dag.order();
        let loops = Loop::all(dag, &order);
        Scheduler {
            dag,
            fields,
            uses: dag.uses(&order),
            flipped: vec![false; dag.nodes.len()],
            written: vec![None; dag.nodes.len()],
            angles: HashMap::new(),
            sines: of_kind(dag, &order, |kind| if let Kind::Sin(x) = kind { Some(*x) } else { None }),
            cosines: of_kind(dag, &order, |kind| if let Kind::Cos(x) = kind { Some(*x) } else { None }),
            sloped: sloped(dag, &order, fields),
            called: HashMap::new(),
            hints: hints(dag),
            headings: headings(dag),
            heading: None,
            names: Names::default(),
            wording: Wording::new(dag, names),
            boundary: loops.iter().flat_map(|l| l.frontier.iter().copied()).collect(),
            loops,
            results: HashMap::new(),
            limbs: None,
            program: Program::default(),
        }
    }

    fn field(&self, id: Id) -> Option<(bool, FieldId)> {
        let print = self.dag.nodes[id].print;
        let &(field, value) = self.fields.get(&print.canonical())?;
        Some((print != value, field))
    }

    /// Writes what these nodes need and what isn't written, operands before users. Bodies of iterations wait until their
    /// iteration is written; what they read from outside goes before it.
    fn make(&mut self, wanted: impl DoubleEndedIterator<Item = Id>) {
        let mut stack: Vec<(Id, bool)> = wanted.rev().map(|id| (id, false)).collect();
        let mut seen = vec![false; self.dag.nodes.len()];
        while let Some((id, done)) = stack.pop() {
            if self.written[id].is_some() {
                continue;
            }
            if done {
                self.visit(id);
                continue;
            }
            if std::mem::replace(&mut seen[id], true) {
                continue;
            }
            stack.push((id, true));
            let before = stack.len();
            match self.dag.nodes[id].kind {
                Kind::Output { block, .. } if self.loops[block].is_loop => {
                    let (start, _) = self.parts(block);
                    stack.extend(start.iter().chain(&self.loops[block].frontier).map(|&id| (id, false)));
                }
                _ => stack.extend(self.dag.operands(&self.dag.nodes[id].kind).map(|id| (id, false))),
            }
            stack[before..].reverse();
        }
    }

    /// Starting values of an iteration; next values and the residual.
    fn parts(&self, block: usize) -> (&'a [Id], &'a [Id]) {
        let dag: &'a Dag = self.dag;
        let Block { kind, operands } = &dag.blocks[block];
        match kind {
            BlockKind::Iterate { unknowns, .. } => operands.split_at(unknowns.len()),
            BlockKind::Solve { .. } | BlockKind::Eliminate { .. } => (operands, &[]),
        }
    }

    /// The local of a block's result; the block is written when the first is asked for.
    fn result(&mut self, block: usize, index: usize) -> Expression {
        if !self.results.contains_key(&block) {
            let locals = self.block(block);
            self.results.insert(block, locals);
        }
        Expression::Local(self.results[&block][index])
    }

    fn block(&mut self, block: usize) -> Vec<Local> {
        let dag: &'a Dag = self.dag;
        let Block { kind, operands } = &dag.blocks[block];
        match kind {
            BlockKind::Solve { size, symmetric, groups } => {
                let (size, symmetric) = (*size, *symmetric);
                let operands: Vec<Expression> = operands.iter().map(|&id| self.signed(id).0).collect();
                let (matrix, rest) = operands.split_at(size * size);
                let (rhs, measures) = rest.split_at(size);
                let named = |k| {
                    self.output(block, k).unwrap_or(if k == size {
                        "rank".to_owned()
                    } else {
                        format!("solution_{}", k + 1)
                    })
                };
                let names: Vec<String> = (0..=size).map(named).collect();
                let results: Vec<Local> = names.iter().map(|name| self.local(name, &[])).collect();
                self.program.statements.push(Statement::Solve {
                    size,
                    symmetric,
                    groups: groups.clone(),
                    matrix: matrix.to_vec(),
                    rhs: rhs.to_vec(),
                    measures: measures.to_vec(),
                    results: results.clone(),
                });
                results
            }
            BlockKind::Eliminate { .. } => raise("eliminations are written out when vectors become scalars"),
            BlockKind::Iterate { unknowns, count } => self.iterate(block, unknowns, *count),
        }
    }

    /// A result's own name.
    fn output(&self, block: usize, index: usize) -> Option<String> {
        let kind = Kind::Output { block, index };
        let id = self.loops[block].outputs.iter().find(|&&id| self.dag.nodes[id].kind == kind)?;
        self.dag.nodes[*id].name.as_ref().map(|name| name.of_sign(false))
    }

    /// Nodes of the body are written for this body alone: another iteration over the same symbols has its own.
    fn iterate(&mut self, block: usize, symbols: &[SymbolId], count: usize) -> Vec<Local> {
        let (start, body) = self.parts(block);
        let start: Vec<Expression> = start.iter().map(|&id| self.signed(id).0).collect();
        let names = symbols.iter().enumerate().map(|(k, &id)| {
            let named = self.dag.symbol_names.get(id.0).filter(|name| !name.is_empty());
            self.output(block, k).or(named.cloned()).unwrap_or("unknown".to_owned())
        });
        let names: Vec<String> = names.collect();
        let mut locals: Vec<Local> = names.iter().map(|name| self.local(name, &[])).collect();
        let inside = self.loops[block].inside.clone();
        let is_inside: HashSet<Id> = inside.iter().copied().collect();
        let outer = std::mem::take(&mut self.program.statements);
        let kept: Vec<_> = inside.iter().map(|&id| (id, self.written[id].take(), self.flipped[id])).collect();
        for &id in &inside {
            if let Kind::Symbol(symbol) = self.dag.nodes[id].kind
                && let Some(at) = symbols.iter().position(|&s| s == symbol)
            {
                self.written[id] = Some((Expression::Local(locals[at]), 1));
            }
        }
        self.make(body.iter().copied());
        let mut next: Vec<Expression> = body.iter().map(|&id| self.signed(id).0).collect();
        let residual = next.pop().or_fault("what an iteration computes ends with its residual");
        for (id, written, flipped) in kept {
            (self.written[id], self.flipped[id]) = (written, flipped);
            if let Kind::Output { block, .. } = self.dag.nodes[id].kind {
                self.results.remove(&block);
            }
        }
        self.angles.retain(|angle, _| !is_inside.contains(angle));
        let changing: HashSet<Print> = inside.iter().map(|&id| self.dag.nodes[id].print).collect();
        self.called.retain(|(_, arguments), _| !arguments.iter().any(|argument| changing.contains(argument)));
        let body = std::mem::replace(&mut self.program.statements, outer);
        let unknowns = locals.clone();
        let name = self.output(block, symbols.len()).unwrap_or("residual".to_owned());
        let local = self.local(&name, &[]);
        locals.push(local);
        let residual = (local, residual);
        self.program.statements.push(Statement::Iterate { count, unknowns, start, body, next, residual });
        locals
    }

    fn visit(&mut self, id: Id) {
        self.heading.clone_from(&self.headings[id]);
        let node = &self.dag.nodes[id];
        if (node.stage <= Stage::Parameter || node.kind == Kind::Stored)
            && id != ONE
            && let Some((negative, field)) = self.field(id)
        {
            self.flipped[id] = negative;
            self.written[id] = Some((Expression::Field(field), 1));
            return;
        }
        let (expression, size) = match &node.kind {
            Kind::One => (Expression::Literal(1.0), 1),
            Kind::Stored => raise("what is stored has a field"),
            Kind::Symbol(symbol) => match self.dag.symbols[symbol.0] {
                // Outside its iteration an unknown is read only by values that don't change with it.
                Symbol::Unknown { .. } => (Expression::Literal(1.0), 1),
                Symbol::UnknownPoint { component, .. } => (Expression::Literal([1.0, 0.0][component]), 1),
                Symbol::Number { .. } => {
                    let value = self.limbs.and_then(|limbs| limbs.numbers.get(symbol));
                    (Expression::Literal(*value.or_fault("a symbol stands for a number of a limb")), 1)
                }
                symbol => (Expression::Symbol(symbol), 1),
            },
            Kind::Sum(terms) => self.sum(id, terms),
            Kind::Product(factors) => self.product(id, factors),
            Kind::Reciprocal(x) => {
                // A reciprocal that a product takes alone becomes that product's quotient.
                self.flipped[id] = self.flipped[*x];
                let (x, size) = self.bare(*x);
                (Expression::Quotient(Box::new(Expression::Literal(1.0)), Box::new(x)), size)
            }
            Kind::Sqrt(x) => {
                let (x, size) = self.signed(*x);
                (Expression::Call(Call::Sqrt, vec![x]), size)
            }
            &Kind::Output { block, index } => (self.result(block, index), 1),
            Kind::Sin(angle) => (Expression::Local(self.sin_cos(*angle).0), 1),
            Kind::Cos(angle) => (Expression::Local(self.sin_cos(*angle).1), 1),
            Kind::Call(call, arguments) if self.is_sloped(*call, arguments) => {
                (Expression::Local(self.called(*call, arguments)), 1)
            }
            Kind::Call(call, arguments) => {
                let arguments: Vec<(Expression, usize)> = arguments.iter().map(|&a| self.signed(a)).collect();
                let size = arguments.iter().map(|a| a.1).sum();
                (Expression::Call(*call, arguments.into_iter().map(|a| a.0).collect()), size)
            }
        };
        let leaf = matches!(expression, Expression::Literal(_) | Expression::Symbol(_) | Expression::Local(_));
        let once = self.uses[id] == 1 && !self.boundary.contains(&id);
        let stands_alone = node.name.as_ref().is_some_and(|name| name.stands_alone);
        let alone = leaf || self.is_divisor(id) || (once && !stands_alone && size <= READABLE);
        self.written[id] = Some(if alone {
            (expression, size)
        } else {
            let local = self.local_of(id, &expression);
            self.program.statements.push(Statement::Let { local, value: expression });
            (Expression::Local(local), 1)
        });
    }

    /// A reciprocal that stands where it is used.
    fn is_divisor(&self, id: Id) -> bool {
        self.dag.is_quotient(id) && self.uses[id] == 1
    }

    /// A local with the value's own name, one by what it is of a named value, or by what it does.
    fn local_of(&mut self, id: Id, expression: &Expression) -> Local {
        let dag = self.dag;
        let named = |id: Id| dag.nodes[id].name.as_ref().map(|name| name.of_sign(self.flipped[id]));
        // The name of what is written, or of what stands within an expression, unless another value has that name.
        let of = |id: Id, is_minus: bool| match &self.written[id] {
            Some((Expression::Local(local), _)) => {
                dag.nodes[id].name.as_ref().map(|_| self.program.locals[local.0].clone())
            }
            _ => {
                let name = dag.nodes[id].name.as_ref()?.of_sign(is_minus);
                self.names.is_free(&name).then_some(name)
            }
        };
        let by_form = || match &dag.nodes[id].kind {
            Kind::Reciprocal(x) => behind(&of(*x, self.flipped[*x])?, "inv"),
            // A root reads its operand with its sign.
            Kind::Sqrt(x) if !self.flipped[*x] => behind(&of(*x, false)?, "root"),
            Kind::Product(factors) => match factors[..] {
                [a, b] if a == b => behind(&of(a, self.flipped[a])?, "squared"),
                _ => None,
            },
            _ => None,
        };
        match named(id).or_else(by_form) {
            Some(name) => self.local(&name, &[expression]),
            None => {
                let hint = self.hints[id].as_deref();
                let name = self.wording.described(&mut self.names, hint, expression);
                self.push(name)
            }
        }
    }

    fn local(&mut self, name: &str, values: &[&Expression]) -> Local {
        let name = self.wording.named(&mut self.names, name, values);
        self.push(name)
    }

    fn push(&mut self, name: String) -> Local {
        self.program.locals.push(name);
        self.program.headings.push(self.heading.clone());
        Local(self.program.locals.len() - 1)
    }

    fn sin_cos(&mut self, angle: Id) -> (Local, Local) {
        if let Some(&locals) = self.angles.get(&angle) {
            return locals;
        }
        let (expression, _) = self.signed(angle);
        let name = match self.dag.nodes[angle].kind {
            Kind::Symbol(id) => self.dag.symbol_name(id),
            _ => {
                let own = self.dag.nodes[angle].name.as_ref().map(|name| name.of_sign(false));
                self.wording.of_angle(own, &expression).unwrap_or_else(|| "angle".to_owned())
            }
        };
        let (sin, cos) = (self.sines.contains(&angle), self.cosines.contains(&angle));
        let prefix = |used: bool, f: &str| format!("{}{f}_{name}", if used { "" } else { "_" });
        let values = [&expression];
        let locals = (self.local(&prefix(sin, "sin"), &values), self.local(&prefix(cos, "cos"), &values));
        let sine = Sine { sin: locals.0, cos: locals.1, angle: expression };
        self.program.statements.push(Statement::SinCos(vec![sine]));
        self.angles.insert(angle, locals);
        locals
    }

    fn is_sloped(&self, call: Call, arguments: &[Id]) -> bool {
        call.external().is_some_and(|function| self.sloped.contains_key(&(function, prints(self.dag, arguments))))
    }

    /// The local of a value or slope; the call is written when the first of them is asked for.
    fn called(&mut self, call: Call, arguments: &[Id]) -> Local {
        let function = call.external().or_fault("only functions of the user's own have slopes that are read");
        let key = (function, prints(self.dag, arguments));
        let place = match call {
            Call::ExternalSlope(_, argument) => 1 + argument,
            _ => 0,
        };
        if let Some(known) = self.called.get(&key) {
            return known[place];
        }
        let arguments: Vec<Expression> = arguments.iter().map(|&id| self.signed(id).0).collect();
        let values: Vec<&Expression> = arguments.iter().collect();
        let nodes = self.sloped[&key].clone();
        let locals: Vec<Local> = nodes
            .iter()
            .enumerate()
            .map(|(place, node)| {
                let own = node.and_then(|id| self.dag.nodes[id].name.as_ref()).map(|name| name.of_sign(false));
                let name =
                    own.unwrap_or_else(|| if place == 0 { "called".to_owned() } else { format!("slope_{place}") });
                self.local(&if node.is_some() { name } else { format!("_{name}") }, &values)
            })
            .collect();
        let (value, slopes) = (locals[0], locals[1..].to_vec());
        self.program.statements.push(Statement::Called { function, arguments, value, slopes });
        self.called.insert(key, locals.clone());
        locals[place]
    }

    /// An operand as it is written, without its sign.
    fn bare(&self, id: Id) -> (Expression, usize) {
        self.written[id].clone().or_fault("operands are written before their users")
    }

    /// An operand with its sign.
    fn signed(&self, id: Id) -> (Expression, usize) {
        let (expression, size) = self.bare(id);
        (if self.flipped[id] { negated(expression) } else { expression }, size)
    }

    /// A root or term on its own.
    fn term(&self, (c, id): (Number, Id)) -> Expression {
        let (negative, expression, _) = self.scaled(c, id);
        if negative { negated(expression) } else { expression }
    }

    /// Sign and magnitude of a coefficient times a node.
    fn scaled(&self, c: Number, id: Id) -> (bool, Expression, usize) {
        let negative = c.is_negative() != self.flipped[id];
        let magnitude = c.abs();
        if id == ONE {
            return (c.is_negative(), Expression::Literal(magnitude.value()), 1);
        }
        let (expression, size) = self.bare(id);
        if magnitude.is_one() {
            return (negative, expression, size);
        }
        let literal = Expression::Literal(magnitude.value());
        let product = match expression {
            Expression::Product(factors) => Expression::Product(std::iter::once(literal).chain(factors).collect()),
            // 1 / x with a literal: one quotient.
            Expression::Quotient(numerator, denominator) if *numerator == Expression::Literal(1.0) => {
                Expression::Quotient(Box::new(literal), denominator)
            }
            other => Expression::Product(vec![literal, other]),
        };
        (negative, product, size + 1)
    }

    fn sum(&mut self, id: Id, terms: &[(Number, Id)]) -> (Expression, usize) {
        if terms.is_empty() {
            return (Expression::Literal(0.0), 1);
        }
        let mut list: Vec<(bool, Expression, usize)> = terms.iter().map(|&(c, t)| self.scaled(c, t)).collect();
        if list.iter().all(|t| t.0) {
            self.flipped[id] = true;
            list.iter_mut().for_each(|t| t.0 = false);
        }
        let size = list.iter().map(|t| t.2).sum();
        if let Some(first) = list.iter().position(|t| !t.0) {
            list[..=first].rotate_right(1);
        }
        if list.len() == 1 {
            return (list.remove(0).1, size);
        }
        (Expression::Sum(list.into_iter().map(|(sign, e, _)| (sign, e)).collect()), size)
    }

    fn product(&mut self, id: Id, factors: &[Id]) -> (Expression, usize) {
        self.flipped[id] = factors.iter().filter(|&&f| self.flipped[f]).count() % 2 == 1;
        let divisor = factors.iter().position(|&f| self.is_divisor(f));
        let mut size = 0;
        let mut list = Vec::with_capacity(factors.len());
        for (at, &factor) in factors.iter().enumerate() {
            if Some(at) != divisor {
                let (expression, n) = self.bare(factor);
                size += n;
                match expression {
                    Expression::Product(inner) => list.extend(inner),
                    other => list.push(other),
                }
            }
        }
        let mut product = if list.len() == 1 { list.swap_remove(0) } else { Expression::Product(list) };
        if let Some(at) = divisor
            && let (Expression::Quotient(_, x), n) = self.bare(factors[at])
        {
            size += n;
            product = Expression::Quotient(Box::new(product), x);
        }
        (product, size)
    }
}

/// The body of an iteration; empty for other blocks.
#[derive(Default)]
struct Loop {
    is_loop: bool,
    /// Nodes that change in every round, operands before users.
    inside: Vec<Id>,
    /// What they read that doesn't.
    frontier: Vec<Id>,
    /// Living results of the block.
    outputs: Vec<Id>,
}

impl Loop {
    /// One for each block of a DAG. Blocks stand before those whose bodies hold them.
    fn all(dag: &Dag, order: &[Id]) -> Vec<Loop> {
        let mut loops: Vec<Loop> = Vec::with_capacity(dag.blocks.len());
        for (number, block) in dag.blocks.iter().enumerate() {
            let is_output = |&id: &Id| matches!(dag.nodes[id].kind, Kind::Output { block, .. } if block == number);
            let outputs = order.iter().copied().filter(is_output).collect();
            let body = match &block.kind {
                BlockKind::Iterate { unknowns, .. } => Loop::of(dag, order, unknowns, block, &loops),
                BlockKind::Solve { .. } | BlockKind::Eliminate { .. } => Loop::default(),
            };
            loops.push(Loop { outputs, ..body });
        }
        loops
    }

    fn of(dag: &Dag, order: &[Id], unknowns: &[SymbolId], block: &Block, before: &[Loop]) -> Loop {
        // Another iteration reads what it starts from and what its body reads, and nothing that is inside.
        let operands = |id: Id| -> Box<dyn Iterator<Item = Id> + '_> {
            match dag.nodes[id].kind {
                Kind::Output { block, .. } if before.get(block).is_some_and(|l| l.is_loop) => {
                    let Block { kind, operands } = &dag.blocks[block];
                    let BlockKind::Iterate { unknowns, .. } = kind else { return Box::new(std::iter::empty()) };
                    Box::new(operands[..unknowns.len()].iter().chain(&before[block].frontier).copied())
                }
                _ => dag.operands(&dag.nodes[id].kind),
            }
        };
        let mut changes = vec![false; dag.nodes.len()];
        let mut needed = vec![false; dag.nodes.len()];
        for &id in order {
            changes[id] = match &dag.nodes[id].kind {
                Kind::Symbol(symbol) => unknowns.contains(symbol),
                _ => operands(id).any(|id| changes[id]),
            };
        }
        block.operands[unknowns.len()..].iter().for_each(|&id| needed[id] = true);
        let (mut inside, mut frontier) = (Vec::new(), Vec::new());
        for &id in order.iter().rev().filter(|&&id| id != ONE) {
            if needed[id] && changes[id] {
                inside.push(id);
                operands(id).for_each(|operand| needed[operand] = true);
            } else if needed[id] {
                frontier.push(id);
            }
        }
        inside.reverse();
        frontier.reverse();
        Loop { is_loop: true, inside, frontier, outputs: Vec::new() }
    }
}

fn of_kind(dag: &Dag, order: &[Id], f: impl Fn(&Kind) -> Option<Id>) -> HashSet<Id> {
    order.iter().filter_map(|&id| f(&dag.nodes[id].kind)).collect()
}

/// Calls of which slopes are read here, and not from fields.
fn sloped(dag: &Dag, order: &[Id], fields: &Fields) -> HashMap<Sloped, Vec<Option<Id>>> {
    let mut calls: HashMap<Sloped, Vec<Option<Id>>> = HashMap::new();
    for &id in order {
        let node = &dag.nodes[id];
        let Kind::Call(call, arguments) = &node.kind else { continue };
        let place = match call {
            Call::External(_) => 0,
            Call::ExternalSlope(_, argument) => 1 + argument,
            _ => continue,
        };
        let is_stored = node.stage <= Stage::Parameter && fields.contains_key(&node.print.canonical());
        if let (Some(function), false) = (call.external(), is_stored) {
            let key = (function, prints(dag, arguments));
            calls.entry(key).or_insert_with(|| vec![None; 1 + arguments.len()])[place] = Some(id);
        }
    }
    calls.retain(|_, nodes| nodes[1..].iter().any(Option::is_some));
    calls
}

fn prints(dag: &Dag, list: &[Id]) -> Vec<Print> {
    list.iter().map(|&id| dag.nodes[id].print).collect()
}

pub(super) fn negated(expression: Expression) -> Expression {
    match expression {
        Expression::Literal(x) => Expression::Literal(-x),
        Expression::Neg(inner) => *inner,
        other => Expression::Neg(Box::new(other)),
    }
}

impl Dag {
    /// A readable name for a symbol, from its kind alone where the owner gave none.
    pub fn symbol_name(&self, id: SymbolId) -> String {
        let named = self.symbol_names.get(id.0).filter(|name| !name.is_empty());
        named.cloned().unwrap_or_else(|| match self.symbols.get(id.0) {
            Some(Symbol::Time) => "t".to_owned(),
            _ => "angle".to_owned(),
        })
    }
}
