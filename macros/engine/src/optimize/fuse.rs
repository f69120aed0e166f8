//! Stage `optimize`, on a program: products that are added to something are one operation with one rounding.
//!
//! In: statements and results. Out: the same with [`Expression::Fused`], where the runtime's feature `fma` asks for it.
//!
//! A sum keeps its terms. It begins with the first one that is no product, else with its first product, which is rounded by itself; each
//! other product is fused to what has been added up before it, in their order. So each term and each partial sum is rounded once
//! at most, where plain sums round products too: the bound of the error, a rounding of each partial sum and of each product, loses
//! the products and gains nothing. What is lost is a coincidence: products of equal value that are rounded alike cancel to zero in a plain
//! sum, and to the rounding of one of them in a fused one. What is equal for all values is one node long before, entries of
//! symmetric matrices are one value read twice, and ranks are judged beside the size of the terms; but a root of a a - b b is zero where a
//! and b happen to be equal, and of a rounding below zero it is none. So what leads to the argument of a function with a bounded domain, by sums,
//! products, quotients and the locals in them (`Guarded`), keeps plain sums, but for those whose terms are squares and the like. The way may begin
//! in `Model::at` and end in a function of what it stores: [`bounded_fields`] says which stored values these are. Values that are read more than once, or have
//! a name, keep their statement: a product that is computed anyway is added as any other value. Chains are as long as those of
//! sums, and shorter in time by one product.
//!
//! What packs are filled with stays plain: these are leaves, but for signs. So do parameters' work, tests of parameters and the matrix of
//! `without_inertia`, which are run once. The way to a root goes through packs.
//!
//! Measured, before sums that roots read were exempt (f64, `target-cpu=native` on AMD EPYC of family 25, level 3, interleaved minima in one process), time with over without, both in
//! the order of [`super::order`]: panda inverse dynamics 0.89, mass matrix 0.99, forward dynamics 0.97, its derivatives 0.86; four legs on a floating body,
//! forward dynamics 0.86, in packs 0.83; humanoid of 32 joints 0.83; Stewart platform, forward dynamics 0.95, leg forces 0.92, strokes with rates and
//! accelerations 0.75. On x86 without the instruction, where what is emitted is a product and a sum in another order of terms, between 0.90 and
//! 1.06, but for the panda's inverse dynamics: 1.33, since the vectoriser no longer sees there what the order alone had shown it.

use std::collections::{HashMap, HashSet};

use crate::contracts::call::Call;

use super::program::{Expression, FieldId, Local, Program, Statement};
use super::schedule::negated;

/// Fuses what can be fused in all statements and results. The results of these numbers lead to the argument of a function with a
/// bounded domain in a program that runs later.
pub fn fuse(program: &mut Program, bounded: &[usize]) {
    let guarded = Guarded::of(program, bounded);
    program.statements.iter_mut().for_each(|statement| fuse_in(statement, &guarded));
    for (number, result) in program.results.iter_mut().enumerate() {
        replace(result, bounded.contains(&number));
    }
}

/// Fields that lead to the argument of a function with a bounded domain. Fused or not, a program gives the same ones: what is on
/// the way is fused only where it can't be negative.
pub fn bounded_fields(program: &Program) -> HashSet<FieldId> {
    Guarded::of(program, &[]).fields
}

fn fuse_in(statement: &mut Statement, guarded: &Guarded) {
    match statement {
        Statement::Let { local, value } | Statement::Pack { local, value, .. } => {
            replace(value, guarded.locals.contains(local))
        }
        Statement::Iterate { start, body, next, residual, .. } => {
            start.iter_mut().chain(next).for_each(|value| replace(value, false));
            replace(&mut residual.1, false);
            body.iter_mut().for_each(|statement| fuse_in(statement, guarded));
        }
        other => other.each_expression_mut(&mut |value| replace(value, false)),
    }
}

fn replace(expression: &mut Expression, guarded: bool) {
    let plain = std::mem::replace(expression, Expression::Literal(0.0));
    *expression = fused(plain, guarded);
}

/// What is on the way to an argument of a function with a bounded domain.
#[derive(Default)]
struct Guarded {
    locals: HashSet<Local>,
    fields: HashSet<FieldId>,
}

impl Guarded {
    fn of(program: &Program, bounded: &[usize]) -> Guarded {
        let mut values: HashMap<Local, Vec<&Expression>> = HashMap::new();
        let mut open: Vec<&Expression> = bounded.iter().filter_map(|&number| program.results.get(number)).collect();
        each_value(&program.statements, &mut |local, value| {
            values.entry(local).or_default().push(value);
        });
        for expression in program.expressions() {
            arguments(expression, &mut open);
        }
        let mut guarded = Guarded::default();
        while let Some(expression) = open.pop() {
            match expression {
                Expression::Local(local) => {
                    if !guarded.locals.insert(*local) {
                        continue;
                    }
                    open.extend(values.get(local).into_iter().flatten());
                }
                Expression::Field(field) => {
                    guarded.fields.insert(*field);
                }
                expression if cannot_be_negative(expression) => {}
                Expression::Neg(inner) => open.push(inner),
                Expression::Sum(terms) => open.extend(terms.iter().map(|(_, term)| term)),
                Expression::Product(list) | Expression::Pack(list) => open.extend(list),
                Expression::Quotient(above, below) => open.extend([&**above, &**below]),
                Expression::Call(call, list) if passes(*call) => open.extend(list),
                _ => {}
            }
        }
        guarded
    }
}

/// Every local with its value, inside iterations too.
fn each_value<'a>(statements: &'a [Statement], visit: &mut dyn FnMut(Local, &'a Expression)) {
    for statement in statements {
        match statement {
            Statement::Let { local, value } | Statement::Pack { local, value, .. } => visit(*local, value),
            Statement::Members { pack, members, .. } => {
                members.iter().flatten().for_each(|&member| visit(member, pack));
            }
            Statement::Iterate { unknowns, start, body, next, residual, .. } => {
                for values in [start, next] {
                    unknowns.iter().zip(values).for_each(|(&local, value)| visit(local, value));
                }
                visit(residual.0, &residual.1);
                each_value(body, visit);
            }
            Statement::SinCos(_) | Statement::PackSines(..) | Statement::Called { .. } | Statement::Solve { .. } => {}
        }
    }
}

/// What stands in functions with a bounded domain.
fn arguments<'a>(expression: &'a Expression, found: &mut Vec<&'a Expression>) {
    match expression {
        Expression::Call(call, list) => {
            if is_bounded(*call) {
                found.extend(list);
            }
            list.iter().for_each(|item| arguments(item, found));
        }
        Expression::Product(list) | Expression::Pack(list) => list.iter().for_each(|item| arguments(item, found)),
        Expression::Neg(inner) => arguments(inner, found),
        Expression::Sum(terms) => terms.iter().for_each(|(_, term)| arguments(term, found)),
        Expression::Quotient(above, below) => {
            arguments(above, found);
            arguments(below, found);
        }
        Expression::Fused(operands) => operands.iter().for_each(|item| arguments(item, found)),
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {}
    }
}

/// Whether it is NaN for arguments a rounding beside some for which it is not. Of functions of the user's own nobody knows.
const fn is_bounded(call: Call) -> bool {
    use Call::{Acos, Asin, External, ExternalSlope, Ln, Powf, Sqrt};
    matches!(call, Sqrt | Ln | Powf | Asin | Acos | External(_) | ExternalSlope(..))
}

/// Whether it hands one of its arguments on.
const fn passes(call: Call) -> bool {
    matches!(call, Call::Min | Call::Max | Call::Select)
}

/// Whether rounding can't make it negative, so that sums in it may be fused.
fn cannot_be_negative(expression: &Expression) -> bool {
    match expression {
        Expression::Literal(value) => *value >= 0.0,
        Expression::Sum(terms) => terms.iter().all(|(minus, term)| !minus && cannot_be_negative(term)),
        Expression::Product(factors) => {
            let mut odd: Vec<&Expression> = Vec::new();
            for factor in factors.iter().filter(|factor| !cannot_be_negative(factor)) {
                match odd.iter().position(|other| *other == factor) {
                    Some(at) => drop(odd.swap_remove(at)),
                    None => odd.push(factor),
                }
            }
            odd.is_empty()
        }
        Expression::Quotient(above, below) => cannot_be_negative(above) && cannot_be_negative(below),
        Expression::Call(call, _) => matches!(call, Call::Sqrt | Call::Abs | Call::Exp | Call::Cosh | Call::Epsilon),
        _ => false,
    }
}

/// `guarded`: sums that could come out below zero by rounding alone stay plain.
fn fused(expression: Expression, guarded: bool) -> Expression {
    let guarded = guarded && !cannot_be_negative(&expression);
    let all = |list: Vec<Expression>| list.into_iter().map(|item| fused(item, guarded)).collect();
    match expression {
        Expression::Sum(terms) if guarded => {
            Expression::Sum(terms.into_iter().map(|(minus, term)| (minus, fused(term, true))).collect())
        }
        Expression::Sum(terms) => sum(terms),
        Expression::Neg(inner) => Expression::Neg(Box::new(fused(*inner, guarded))),
        Expression::Product(factors) => Expression::Product(all(factors)),
        Expression::Quotient(above, below) => {
            Expression::Quotient(Box::new(fused(*above, guarded)), Box::new(fused(*below, guarded)))
        }
        Expression::Call(call, list) => {
            let guarded = is_bounded(call) || guarded && passes(call);
            Expression::Call(call, list.into_iter().map(|item| fused(item, guarded)).collect())
        }
        other => other,
    }
}

fn sum(terms: Vec<(bool, Expression)>) -> Expression {
    let mut terms: Vec<(bool, Expression)> = terms
        .into_iter()
        .map(|(minus, term)| match fused(term, false) {
            Expression::Neg(inner) => (!minus, *inner),
            term => (minus, term),
        })
        .collect();
    if terms.is_empty() {
        return Expression::Sum(terms);
    }
    let first = terms.iter().position(|(_, term)| !is_product(term)).unwrap_or(0);
    let mut sum = vec![terms.remove(first)];
    for (minus, term) in terms {
        match term {
            Expression::Product(mut factors) if factors.len() > 1 => {
                let last = factors.remove(factors.len() - 1);
                let rest = if factors.len() == 1 { factors.remove(0) } else { Expression::Product(factors) };
                let rest = if minus { negated(rest) } else { rest };
                sum = vec![(false, Expression::Fused(Box::new([rest, last, whole(sum)])))];
            }
            term => sum.push((minus, term)),
        }
    }
    whole(sum)
}

fn is_product(term: &Expression) -> bool {
    matches!(term, Expression::Product(factors) if factors.len() > 1)
}

/// What has been added up.
fn whole(mut terms: Vec<(bool, Expression)>) -> Expression {
    match terms.pop() {
        Some((false, term)) if terms.is_empty() => term,
        Some((true, term)) if terms.is_empty() => negated(term),
        last => Expression::Sum(terms.into_iter().chain(last).collect()),
    }
}
