//! Stage `optimize`, its result: straight-line programs, ready to be printed.
//!
//! In: nothing. Out: the types that `schedule` fills, and `emit`, the interpreter and the ledger read. A program is a
//! list of statements in single-assignment form; expressions that are used once and need no name stand inside the
//! statement that uses them.

use std::sync::Arc;

use crate::contracts::call::{Call, ExternalId};
use crate::contracts::cost::Cost;
use crate::contracts::function::FunctionKind;
use crate::contracts::results::Parts;
use crate::contracts::symbol::Symbol;
use crate::mechanics::{Condition, Inertia};

/// Index into [`Program::locals`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Local(pub usize);

/// Index into [`Compiled::fields`]: a value that depends on parameters alone and is stored in `Model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FieldId(pub usize);

/// An expression over symbols, fields and locals.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// Finite; the sign stands here.
    Literal(f64),
    Symbol(Symbol),
    Field(FieldId),
    Local(Local),
    Neg(Box<Expression>),
    /// Terms are added from left to right; `true` subtracts. The first term may be negative.
    Sum(Vec<(bool, Expression)>),
    /// The product of the first two added to the third with one rounding, where the target has an instruction for it.
    Fused(Box<[Expression; 3]>),
    Product(Vec<Expression>),
    Quotient(Box<Expression>, Box<Expression>),
    Call(Call, Vec<Expression>),
    /// Inside of packs alone: a list of one scalar, which all members are, or of [`MEMBERS`], of which packs of two read the first two.
    Pack(Vec<Expression>),
}

/// As many members has a pack at most.
pub const MEMBERS: usize = 4;

/// How many members a pack has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    Two,
    Four,
}

impl Size {
    pub fn members(self) -> usize {
        match self {
            Size::Two => 2,
            Size::Four => MEMBERS,
        }
    }
}

#[derive(Clone, Debug)]
pub enum Statement {
    Let {
        local: Local,
        value: Expression,
    },
    /// Sines and cosines of one angle or several, together.
    SinCos(Vec<Sine>),
    /// A pack: operations of `value` work on each member, its leaves are packs.
    Pack {
        size: Size,
        local: Local,
        value: Expression,
    },
    /// Sines and cosines of a pack of angles.
    PackSines(Size, Sine),
    /// What is in a pack; members that nothing reads have no local.
    Members {
        size: Size,
        pack: Expression,
        members: [Option<Local>; MEMBERS],
    },
    /// A function of the user's own Rust, of which slopes are read: all of them together, with the value where it is read too.
    Called {
        function: ExternalId,
        arguments: Vec<Expression>,
        value: Local,
        /// One by each argument.
        slopes: Vec<Local>,
    },
    /// A pivoted solution of a linear system in the runtime; `results` are the unknowns, then the rank.
    Solve {
        size: usize,
        symmetric: bool,
        /// Equations of one unit, see [`BlockKind::Solve`](crate::symbolic::graph::BlockKind).
        groups: Box<[usize]>,
        /// Row by row.
        matrix: Vec<Expression>,
        rhs: Vec<Expression>,
        /// What pivots of a symmetric system are measured by; empty where that is the diagonal.
        measures: Vec<Expression>,
        results: Vec<Local>,
    },
    /// A counted loop. `unknowns` start at `start` and become `next` in every round; they are read inside and behind it.
    /// `residual` is set in every round, before the unknowns are, and read behind the loop; it is zero where there is none.
    Iterate {
        count: usize,
        unknowns: Vec<Local>,
        start: Vec<Expression>,
        body: Vec<Statement>,
        next: Vec<Expression>,
        residual: (Local, Expression),
    },
}

/// Sine and cosine of one angle.
#[derive(Clone, Debug)]
pub struct Sine {
    pub sin: Local,
    pub cos: Local,
    pub angle: Expression,
}

/// One function body.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Readable names, unique within the program, valid Rust identifiers, snake case.
    pub locals: Vec<String>,
    /// What is derived where a local is: headings of paragraphs. Locals beyond its length have none.
    pub headings: Vec<Option<Arc<str>>>,
    pub statements: Vec<Statement>,
    /// In the order that [`FunctionKind`] documents.
    pub results: Vec<Expression>,
}

impl Expression {
    /// Every literal, symbol, field and local in it.
    pub fn each_leaf(&self, visit: &mut dyn FnMut(&Expression)) {
        match self {
            Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => visit(self),
            Expression::Neg(inner) => inner.each_leaf(visit),
            Expression::Sum(terms) => terms.iter().for_each(|(_, term)| term.each_leaf(visit)),
            Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
                list.iter().for_each(|item| item.each_leaf(visit));
            }
            Expression::Fused(operands) => operands.iter().for_each(|item| item.each_leaf(visit)),
            Expression::Quotient(above, below) => [above, below].into_iter().for_each(|item| item.each_leaf(visit)),
        }
    }

    /// Every local in it.
    pub fn each_local(&self, visit: &mut dyn FnMut(Local)) {
        self.each_leaf(&mut |leaf| {
            if let Expression::Local(local) = leaf {
                visit(*local);
            }
        });
    }
}

impl Expression {
    /// The same with something else for every local.
    #[must_use]
    pub fn with_locals(&self, of: &dyn Fn(Local) -> Expression) -> Expression {
        let all = |list: &[Expression]| list.iter().map(|item| item.with_locals(of)).collect();
        match self {
            Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) => self.clone(),
            Expression::Local(local) => of(*local),
            Expression::Neg(inner) => Expression::Neg(Box::new(inner.with_locals(of))),
            Expression::Sum(terms) => {
                Expression::Sum(terms.iter().map(|(minus, term)| (*minus, term.with_locals(of))).collect())
            }
            Expression::Fused(operands) => {
                Expression::Fused(Box::new(operands.each_ref().map(|item| item.with_locals(of))))
            }
            Expression::Product(list) => Expression::Product(all(list)),
            Expression::Quotient(above, below) => {
                Expression::Quotient(Box::new(above.with_locals(of)), Box::new(below.with_locals(of)))
            }
            Expression::Call(call, list) => Expression::Call(*call, all(list)),
            Expression::Pack(list) => Expression::Pack(all(list)),
        }
    }
}

impl Sine {
    pub fn defined(&self) -> [Local; 2] {
        [self.sin, self.cos]
    }
}

impl Statement {
    /// Its expressions, those of statements inside included.
    pub fn expressions(&self) -> Box<dyn Iterator<Item = &Expression> + '_> {
        match self {
            Statement::Let { value, .. } | Statement::Pack { value, .. } | Statement::Members { pack: value, .. } => {
                Box::new(std::iter::once(value))
            }
            Statement::PackSines(_, sine) => Box::new(std::iter::once(&sine.angle)),
            Statement::SinCos(sines) => Box::new(sines.iter().map(|sine| &sine.angle)),
            Statement::Called { arguments, .. } => Box::new(arguments.iter()),
            Statement::Solve { matrix, rhs, measures, .. } => Box::new(matrix.iter().chain(rhs).chain(measures)),
            Statement::Iterate { start, body, next, residual, .. } => {
                let inside = body.iter().flat_map(Statement::expressions);
                Box::new(start.iter().chain(inside).chain(next).chain(std::iter::once(&residual.1)))
            }
        }
    }

    /// All that it reads, to be changed in its place.
    pub fn each_expression_mut(&mut self, visit: &mut dyn FnMut(&mut Expression)) {
        match self {
            Statement::Let { value, .. } | Statement::Pack { value, .. } | Statement::Members { pack: value, .. } => {
                visit(value);
            }
            Statement::PackSines(_, sine) => visit(&mut sine.angle),
            Statement::SinCos(sines) => sines.iter_mut().for_each(|sine| visit(&mut sine.angle)),
            Statement::Called { arguments, .. } => arguments.iter_mut().for_each(visit),
            Statement::Solve { matrix, rhs, measures, .. } => {
                matrix.iter_mut().chain(rhs).chain(measures).for_each(visit);
            }
            Statement::Iterate { start, body, next, residual, .. } => {
                start.iter_mut().for_each(&mut *visit);
                body.iter_mut().for_each(|statement| statement.each_expression_mut(visit));
                next.iter_mut().for_each(&mut *visit);
                visit(&mut residual.1);
            }
        }
    }

    /// Locals that later statements may read.
    pub fn defined(&self) -> Vec<Local> {
        match self {
            Statement::Let { local, .. } | Statement::Pack { local, .. } => vec![*local],
            Statement::PackSines(_, sine) => sine.defined().to_vec(),
            Statement::Members { members, .. } => members.iter().copied().flatten().collect(),
            Statement::SinCos(sines) => sines.iter().flat_map(Sine::defined).collect(),
            Statement::Called { value, slopes, .. } => std::iter::once(*value).chain(slopes.iter().copied()).collect(),
            Statement::Solve { results, .. } => results.clone(),
            Statement::Iterate { unknowns, residual, .. } => unknowns.iter().copied().chain([residual.0]).collect(),
        }
    }
}

impl Program {
    /// All expressions of statements and results.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> + '_ {
        self.statements.iter().flat_map(Statement::expressions).chain(&self.results)
    }

    /// All numbers that are written in it.
    pub fn literals(&self) -> impl Iterator<Item = f64> + '_ {
        let mut stack: Vec<&Expression> = self.expressions().collect();
        std::iter::from_fn(move || {
            while let Some(expression) = stack.pop() {
                match expression {
                    Expression::Literal(x) => return Some(*x),
                    Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {}
                    Expression::Neg(inner) => stack.push(inner),
                    Expression::Sum(terms) => stack.extend(terms.iter().map(|t| &t.1)),
                    Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
                        stack.extend(list)
                    }
                    Expression::Fused(operands) => stack.extend(operands.iter()),
                    Expression::Quotient(a, b) => stack.extend([&**a, &**b]),
                }
            }
            None
        })
    }
}

/// One generated function.
#[derive(Clone, Debug)]
pub struct Function {
    pub kind: FunctionKind,
    /// What its results are.
    pub parts: Parts,
    pub program: Program,
    /// As derived, before optimisation.
    pub before: Cost,
    /// As emitted.
    pub after: Cost,
    /// What it was made from, such as `composite rigid body, LDL^T` or `articulated body`.
    pub method: &'static str,
    /// Its number among the candidates of the derivation.
    pub candidate: usize,
    /// The candidates that cost more, in the order in which they were derived; of equal ones the first is taken.
    pub rivals: Vec<Rival>,
}

/// What `Model::at` computes, and what functions do with it.
#[derive(Clone, Debug, Default)]
pub struct At {
    /// Names of its fields, unique, readable, none of them one of [`Compiled::fields`].
    pub fields: Vec<String>,
    /// One result for each field.
    pub program: Program,
    pub cost: Cost,
    /// They read fields of the model, and those of this struct, which are numbered behind them.
    pub functions: Vec<Function>,
}

/// A way to a function that was not taken.
#[derive(Clone, Debug)]
pub struct Rival {
    pub method: &'static str,
    /// As it would have been emitted.
    pub cost: Cost,
}

/// Everything that `emit` prints for one model, besides the model itself.
#[derive(Clone, Debug, Default)]
pub struct Compiled {
    /// Names of the fields of `Model`, unique, readable.
    pub fields: Vec<String>,
    /// Computes the fields from parameters: one result per field.
    pub prelude: Program,
    pub prelude_cost: Cost,
    pub functions: Vec<Function>,
    /// What is done once for a position, where the model asks for that.
    pub at: Option<At>,
    /// What `Params::check` computes from parameters.
    pub checks: Checks,
    /// What `System::without_inertia` looks at: entries row by row. It reads fields.
    pub inertia: Inertia<Program>,
    /// Whether every rewrite passed the identity test, and every program the check of stage `verify`. Where one didn't, the
    /// function stands as it was derived: right, but more expensive than need be. The tests see to it that this never happens.
    pub sound: bool,
    /// What stage `verify` could not compare with its derived equations.
    pub unchecked: Vec<Unchecked>,
}

/// What has no clear value at any state that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unchecked {
    pub part: Part,
    pub doubt: Doubt,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Function(FunctionKind),
    /// A function of what `Model::at` gives.
    At(FunctionKind),
    /// The program of `Params::check`.
    Checks,
    /// The mass matrix of `System::without_inertia`.
    Inertia,
    /// What two functions must have in common, in words.
    Law(&'static str),
}

/// Why values are not clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    NotFinite,
    /// Two numbers that are compared are equal but for rounding.
    Comparison,
    /// The rank of a system is less than its size, or hangs on rounding.
    Rank,
    /// Rounding leaves few digits.
    Rounding,
    /// Loops don't close.
    Open,
}

/// Tests of parameters.
#[derive(Clone, Debug, Default)]
pub struct Checks {
    /// Reads parameters and no fields; its results are the values of all tests in order.
    pub program: Program,
    /// What is wrong where a test fails, the test, and how many values it takes.
    pub list: Vec<(String, Condition, usize)>,
}
