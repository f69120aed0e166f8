//! Stage `optimize`, on a program: products that are added to something are one operation with one rounding.
//!
//! In: statements and results. Out: the same with [`Expression::Fused`], where the runtime's feature `fma` asks for it.
//!
//! A sum keeps its terms. It begins with the first one that is no product, else with its first product, which is rounded by itself; each
//! other product is fused to what has been added up before it, in their order. So each term and each partial sum is rounded once
//! at most, where plain sums round products too: the bound of the error, a rounding of each partial sum and of each product, loses
//! the products and gains nothing. What is lost is a coincidence: products of equal value that are rounded alike cancel to zero in a plain
//! sum, and to the rounding of one of them in a fused one. Nothing rests on that: what is equal is one node long before, entries of
//! symmetric matrices are one value read twice, and ranks are judged beside the size of the terms. Values that are read more than once, or have
//! a name, keep their statement: a product that is computed anyway is added as any other value. Chains are as long as those of
//! sums, and shorter in time by one product.
//!
//! What packs are filled with stays plain: these are leaves, but for signs. So do parameters' work, tests of parameters and the matrix of
//! `without_inertia`, which are run once.
//!
//! Measured (f64, `target-cpu=native` on AMD EPYC of family 25, level 3, interleaved minima in one process), time with over without, both in
//! the order of [`super::order`]: panda inverse dynamics 0.89, mass matrix 0.99, forward dynamics 0.97, its derivatives 0.86; four legs on a floating body,
//! forward dynamics 0.86, in packs 0.83; humanoid of 32 joints 0.83; Stewart platform, forward dynamics 0.95, leg forces 0.92, strokes with rates and
//! accelerations 0.75. On x86 without the instruction, where what is emitted is a product and a sum in another order of terms, between 0.90 and
//! 1.06, but for the panda's inverse dynamics: 1.33, since the vectoriser no longer sees there what the order alone had shown it.

use super::program::{Expression, Program};
use super::schedule::negated;

/// Fuses what can be fused in all statements and results.
pub fn fuse(program: &mut Program) {
    let visit = &mut |expression: &mut Expression| {
        let plain = std::mem::replace(expression, Expression::Literal(0.0));
        *expression = fused(plain);
    };
    program.statements.iter_mut().for_each(|statement| statement.each_expression_mut(visit));
    program.results.iter_mut().for_each(visit);
}

fn fused(expression: Expression) -> Expression {
    let all = |list: Vec<Expression>| list.into_iter().map(fused).collect();
    match expression {
        Expression::Sum(terms) => sum(terms),
        Expression::Neg(inner) => Expression::Neg(Box::new(fused(*inner))),
        Expression::Product(factors) => Expression::Product(all(factors)),
        Expression::Quotient(above, below) => Expression::Quotient(Box::new(fused(*above)), Box::new(fused(*below))),
        Expression::Call(call, list) => Expression::Call(call, all(list)),
        other => other,
    }
}

fn sum(terms: Vec<(bool, Expression)>) -> Expression {
    let mut terms: Vec<(bool, Expression)> = terms
        .into_iter()
        .map(|(minus, term)| match fused(term) {
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
