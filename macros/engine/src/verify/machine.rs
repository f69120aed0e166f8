//! Stage `verify`: programs in double precision, statement by statement, as the emitted code runs.
//!
//! In: a program and the values that it reads. Out: its results. Where a system has lesser rank than size, its solution is
//! one of many, and rounding chooses among them: then pivots are taken in the order that the derived equations took.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::optimize::program::{Expression, Local, MEMBERS, Program, Statement};
use crate::symbolic::evaluate::call_f64;

use super::linear::{solve, solve_symmetric};
use super::trace::Pivots;

/// Matrices of one system differ by rounding alone.
const SAME: f64 = 1e-6;

/// What a program reads.
pub(super) struct Reads<'a> {
    pub symbol: &'a dyn Fn(Symbol) -> f64,
    pub fields: &'a [f64],
    pub deficient: &'a [Pivots],
    /// No more of each iteration.
    pub rounds: usize,
}

/// Results of a program.
pub(super) fn run(program: &Program, reads: &Reads<'_>) -> Vec<f64> {
    let mut machine = Machine { locals: vec![f64::NAN; program.locals.len()], packs: HashMap::new(), member: 0, reads };
    machine.run(&program.statements);
    program.results.iter().map(|result| machine.value(result)).collect()
}

struct Machine<'a> {
    locals: Vec<f64>,
    packs: HashMap<Local, [f64; MEMBERS]>,
    /// Of packs that is worked with.
    member: usize,
    reads: &'a Reads<'a>,
}

impl Machine<'_> {
    fn run(&mut self, statements: &[Statement]) {
        for statement in statements {
            self.statement(statement);
        }
    }

    fn set(&mut self, local: Local, value: f64) {
        self.locals[local.0] = value;
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let { local, value } => {
                let value = self.value(value);
                self.set(*local, value);
            }
            Statement::SinCos(sines) => {
                // All angles are read first: none may be a sine or cosine of its own group.
                let angles: Vec<f64> = sines.iter().map(|sine| self.value(&sine.angle)).collect();
                for (sine, angle) in sines.iter().zip(angles) {
                    let (s, c) = angle.sin_cos();
                    self.set(sine.sin, s);
                    self.set(sine.cos, c);
                }
            }
            Statement::Called { function, arguments, value, slopes } => {
                let arguments = self.values(arguments);
                let slope = |(argument, &local)| (local, Call::ExternalSlope(*function, argument));
                let calls = slopes.iter().enumerate().map(slope);
                for (local, call) in std::iter::once((*value, Call::External(*function))).chain(calls) {
                    self.set(local, call_f64(call, &arguments));
                }
            }
            Statement::Pack { local, value, .. } => {
                let members = self.members(value);
                self.packs.insert(*local, members);
            }
            Statement::PackSines(_, sine) => {
                let points = self.members(&sine.angle).map(f64::sin_cos);
                self.packs.insert(sine.sin, points.map(|point| point.0));
                self.packs.insert(sine.cos, points.map(|point| point.1));
            }
            Statement::Members { pack, members, .. } => {
                let values = self.members(pack);
                for (local, value) in members.iter().zip(values) {
                    local.iter().for_each(|&local| self.set(local, value));
                }
            }
            Statement::Solve { size, symmetric, groups, matrix, rhs, measures, results } => {
                let [matrix, rhs, measures] = [matrix, rhs, measures].map(|list| self.values(list));
                let known = self.reads.deficient.iter().find(|pivots| is_same(&pivots.matrix, &matrix, *size));
                let mut solved = match symmetric {
                    true => solve_symmetric(&matrix, &rhs, (&measures, groups), known.map(|pivots| &pivots.rows[..])),
                    false => solve(&matrix, &rhs, known.map(|pivots| (&pivots.rows[..], &pivots.columns[..]))),
                };
                solved.x.push(solved.rows.len() as f64);
                for (&local, x) in results.iter().zip(solved.x) {
                    self.set(local, x);
                }
            }
            Statement::Iterate { count, unknowns, start, body, next, residual } => {
                let mut values = self.values(start);
                for _ in 0..self.reads.rounds.min(*count) {
                    unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
                    self.run(body);
                    let size = self.value(&residual.1);
                    self.set(residual.0, size);
                    values = self.values(next);
                }
                unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
            }
        }
    }

    /// Of an expression on packs.
    fn members(&mut self, expression: &Expression) -> [f64; MEMBERS] {
        let values = std::array::from_fn(|member| {
            self.member = member;
            self.value(expression)
        });
        self.member = 0;
        values
    }

    fn values(&self, list: &[Expression]) -> Vec<f64> {
        list.iter().map(|expression| self.value(expression)).collect()
    }

    fn value(&self, expression: &Expression) -> f64 {
        match expression {
            Expression::Literal(x) => *x,
            Expression::Symbol(symbol) => (self.reads.symbol)(*symbol),
            Expression::Field(field) => self.reads.fields[field.0],
            Expression::Local(local) => self.packs.get(local).map_or(self.locals[local.0], |pack| pack[self.member]),
            Expression::Pack(list) => self.value(&list[self.member.min(list.len() - 1)]),
            Expression::Neg(x) => -self.value(x),
            Expression::Sum(terms) => {
                let mut sum = -0.0;
                for (minus, term) in terms {
                    let term = self.value(term);
                    sum += if *minus { -term } else { term };
                }
                sum
            }
            Expression::Fused(operands) => {
                let [a, b, c] = operands.each_ref().map(|operand| self.value(operand));
                a.mul_add(b, c)
            }
            Expression::Product(list) => {
                let mut product = 1.0;
                for factor in list {
                    product *= self.value(factor);
                }
                product
            }
            Expression::Quotient(a, b) => self.value(a) / self.value(b),
            Expression::Call(Call::Sqrt, x) => self.value(&x[0]).sqrt(),
            Expression::Call(call, list) => call_f64(*call, &self.values(list)),
        }
    }
}

/// Whether two matrices are one, row by row.
fn is_same(a: &[f64], b: &[f64], n: usize) -> bool {
    let largest = |row: &[f64]| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let close = |(a, b): (&[f64], &[f64])| {
        let size = largest(a).max(largest(b));
        a.iter().zip(b).all(|(x, y)| (x - y).abs() <= SAME * size)
    };
    a.len() == b.len() && a.chunks(n.max(1)).zip(b.chunks(n.max(1))).all(close)
}
