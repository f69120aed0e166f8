//! Stage `optimize`, last pass: from a DAG to a straight-line program.
//!
//! In: an optimised DAG. Out: a [`Program`]. Values that are used more than once or have a name get a statement of their
//! own; the others stand in the expression that uses them, up to a readable size. Signs are chosen so that a sum starts
//! with a positive term where it can. Statements come in the order in which results need them, which keeps few values
//! alive.

use std::collections::{HashMap, HashSet};

use crate::symbolic::fingerprint::Print;
use crate::symbolic::graph::Call;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::names::Names;
use super::program::{Expression, FieldId, Local, Program, Statement, Symbol};
use super::stage::Stage;

/// Operands that one expression may hold before a part of it becomes a statement.
const READABLE: usize = 10;

/// Fields of `Model` by the print that stands for their value and its negative, with the print of the value itself.
pub type Fields = HashMap<Print, (FieldId, Print)>;

/// Prints a DAG as a program. Nodes found in `fields` are read from there.
pub fn schedule(dag: &Dag, fields: &Fields) -> Program {
    let mut scheduler = Scheduler::new(dag, fields);
    for id in dag.order() {
        scheduler.visit(id);
    }
    let results = dag.roots.iter().map(|&root| scheduler.term(root)).collect();
    let mut program = scheduler.program;
    program.results = results;
    program
}

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
    hints: Vec<Option<String>>,
    names: Names,
    program: Program,
}

impl<'a> Scheduler<'a> {
    fn new(dag: &'a Dag, fields: &'a Fields) -> Self {
        let order = dag.order();
        Scheduler {
            dag,
            fields,
            uses: dag.uses(&order),
            flipped: vec![false; dag.nodes.len()],
            written: vec![None; dag.nodes.len()],
            angles: HashMap::new(),
            sines: of_kind(dag, &order, |kind| if let Kind::Sin(x) = kind { Some(*x) } else { None }),
            cosines: of_kind(dag, &order, |kind| if let Kind::Cos(x) = kind { Some(*x) } else { None }),
            hints: dag.hints(),
            names: Names::default(),
            program: Program::default(),
        }
    }

    fn field(&self, id: Id) -> Option<(bool, FieldId)> {
        let print = self.dag.nodes[id].print;
        let &(field, value) = self.fields.get(&print.canonical())?;
        Some((print != value, field))
    }

    fn visit(&mut self, id: Id) {
        let node = &self.dag.nodes[id];
        if node.stage <= Stage::Parameter
            && id != ONE
            && let Some((negative, field)) = self.field(id)
        {
            self.flipped[id] = negative;
            self.written[id] = Some((Expression::Field(field), 1));
            return;
        }
        let (expression, size) = match &node.kind {
            Kind::One => (Expression::Literal(1.0), 1),
            Kind::Symbol(symbol) => match self.dag.symbols.get(symbol.0) {
                Some(&symbol) => (Expression::Symbol(symbol), 1),
                None => (Expression::Literal(0.0), 1),
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
            Kind::Sin(angle) => (Expression::Local(self.sin_cos(*angle).0), 1),
            Kind::Cos(angle) => (Expression::Local(self.sin_cos(*angle).1), 1),
            Kind::Call(call, arguments) => {
                let arguments: Vec<(Expression, usize)> = arguments.iter().map(|&a| self.signed(a)).collect();
                let size = arguments.iter().map(|a| a.1).sum();
                (Expression::Call(*call, arguments.into_iter().map(|a| a.0).collect()), size)
            }
        };
        let leaf = matches!(expression, Expression::Literal(_) | Expression::Symbol(_) | Expression::Local(_));
        let quotient = self.dag.is_quotient(id) && self.uses[id] == 1;
        let alone = leaf || quotient || (self.uses[id] == 1 && node.name.is_none() && size <= READABLE);
        self.written[id] = Some(if alone {
            (expression, size)
        } else {
            let local = self.local(self.name_of(id));
            self.program.statements.push(Statement::Let { local, value: expression });
            (Expression::Local(local), 1)
        });
    }

    /// A value's own name, or that it is a part of a named one.
    fn name_of(&self, id: Id) -> String {
        match (&self.dag.nodes[id].name, &self.hints[id]) {
            (Some(name), _) => name.clone(),
            (None, Some(hint)) => format!("{hint}_part"),
            (None, None) => "value".to_owned(),
        }
    }

    fn local(&mut self, name: String) -> Local {
        self.program.locals.push(self.names.unique(&name));
        Local(self.program.locals.len() - 1)
    }

    fn sin_cos(&mut self, angle: Id) -> (Local, Local) {
        if let Some(&locals) = self.angles.get(&angle) {
            return locals;
        }
        let (expression, _) = self.signed(angle);
        let name = match self.dag.nodes[angle].kind {
            Kind::Symbol(id) => self.dag.symbol_name(id),
            _ => self.hints[angle].clone().unwrap_or_else(|| "angle".to_owned()),
        };
        let (sin, cos) = (self.sines.contains(&angle), self.cosines.contains(&angle));
        let prefix = |used: bool, f: &str| format!("{}{f}_{name}", if used { "" } else { "_" });
        let locals = (self.local(prefix(sin, "sin")), self.local(prefix(cos, "cos")));
        self.program.statements.push(Statement::SinCos { sin: locals.0, cos: locals.1, angle: expression });
        self.angles.insert(angle, locals);
        locals
    }

    /// An operand as it is written, without its sign.
    fn bare(&self, id: Id) -> (Expression, usize) {
        self.written[id].clone().unwrap_or((Expression::Literal(f64::NAN), 1))
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
            let expression = list.pop().map_or(Expression::Literal(0.0), |t| t.1);
            return (expression, size);
        }
        (Expression::Sum(list.into_iter().map(|(sign, e, _)| (sign, e)).collect()), size)
    }

    fn product(&mut self, id: Id, factors: &[Id]) -> (Expression, usize) {
        self.flipped[id] = factors.iter().filter(|&&f| self.flipped[f]).count() % 2 == 1;
        let divisor = factors.iter().position(|&f| self.uses[f] == 1 && self.dag.is_quotient(f));
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

fn of_kind(dag: &Dag, order: &[Id], f: impl Fn(&Kind) -> Option<Id>) -> HashSet<Id> {
    order.iter().filter_map(|&id| f(&dag.nodes[id].kind)).collect()
}

fn negated(expression: Expression) -> Expression {
    match expression {
        Expression::Literal(x) => Expression::Literal(-x),
        Expression::Neg(inner) => *inner,
        other => Expression::Neg(Box::new(other)),
    }
}

impl Dag {
    /// Names for all nodes: a value without one takes that of the first named value it serves.
    pub fn hints(&self) -> Vec<Option<String>> {
        let mut hints: Vec<Option<String>> = vec![None; self.nodes.len()];
        for &id in self.order().iter().rev() {
            if let Some(name) = &self.nodes[id].name {
                hints[id] = Some(name.clone());
            }
            let Some(hint) = hints[id].clone() else { continue };
            for operand in super::dag::operands(&self.nodes[id].kind) {
                hints[operand].get_or_insert_with(|| hint.clone());
            }
        }
        hints
    }

    /// A readable name for a symbol, from its kind alone where the owner gave none.
    pub fn symbol_name(&self, id: crate::symbolic::graph::SymbolId) -> String {
        let named = self.symbol_names.get(id.0).filter(|name| !name.is_empty());
        named.cloned().unwrap_or_else(|| match self.symbols.get(id.0) {
            Some(Symbol::Time) => "t".to_owned(),
            _ => "angle".to_owned(),
        })
    }
}
