//! Stage `optimize`, on a program: arithmetic on literals alone is done.
//!
//! In: a program in which literals stand for symbols that were kept apart from each other while they were optimised. Out: the
//! same with one literal for each expression of literals, in the precision of what runs on `f64`. Statements that are a literal
//! go.

use std::collections::HashMap;

use crate::contracts::call::Call;

use super::program::{Expression, Local, Program, Statement};

/// With all literals folded.
pub(super) fn fold(program: &mut Program) {
    let mut known: HashMap<Local, f64> = HashMap::new();
    let put_in = |expression: &Expression, known: &HashMap<Local, f64>| {
        let literal = |local: Local| match known.get(&local) {
            Some(&value) => Expression::Literal(value),
            None => Expression::Local(local),
        };
        folded(expression.with_locals(&literal))
    };
    let mut statements = Vec::with_capacity(program.statements.len());
    for mut statement in std::mem::take(&mut program.statements) {
        statement.each_expression_mut(&mut |expression| *expression = put_in(expression, &known));
        match statement {
            Statement::Let { local, value: Expression::Literal(value) } => {
                known.insert(local, value);
            }
            other => statements.push(other),
        }
    }
    program.statements = statements;
    for result in &mut program.results {
        *result = put_in(result, &known);
    }
}

fn folded(expression: Expression) -> Expression {
    match expression {
        Expression::Neg(inner) => match folded(*inner) {
            Expression::Literal(value) => Expression::Literal(-value),
            other => Expression::Neg(Box::new(other)),
        },
        Expression::Sum(terms) => {
            let signed = |(minus, term): &(bool, Expression)| Some(if *minus { -value(term)? } else { value(term)? });
            let terms = terms.into_iter().map(|(minus, term)| (minus, folded(term)));
            let one = |value: f64| (value.is_sign_negative(), Expression::Literal(value.abs()));
            match gathered(terms.collect(), signed, one, |a, b| a + b) {
                list if list.len() == 1 && signed(&list[0]).is_some() => {
                    Expression::Literal(list.iter().find_map(signed).unwrap_or(0.0))
                }
                list => Expression::Sum(list),
            }
        }
        Expression::Product(factors) => {
            let factors = factors.into_iter().map(folded).collect();
            match gathered(factors, value, Expression::Literal, |a, b| a * b) {
                list if list.len() == 1 && value(&list[0]).is_some() => {
                    Expression::Literal(list.iter().find_map(value).unwrap_or(1.0))
                }
                list => Expression::Product(list),
            }
        }
        Expression::Quotient(above, below) => match (folded(*above), folded(*below)) {
            (Expression::Literal(a), Expression::Literal(b)) => Expression::Literal(a / b),
            (above, below) => Expression::Quotient(Box::new(above), Box::new(below)),
        },
        Expression::Call(call, list) => {
            let list: Vec<Expression> = list.into_iter().map(folded).collect();
            match (call, &list[..]) {
                (Call::Sqrt, [Expression::Literal(value)]) => Expression::Literal(value.sqrt()),
                _ => Expression::Call(call, list),
            }
        }
        other => other,
    }
}

/// All literals as one, where the first of them stands.
fn gathered<T>(
    list: Vec<T>,
    value: impl Fn(&T) -> Option<f64>,
    one: impl Fn(f64) -> T,
    join: impl Fn(f64, f64) -> f64,
) -> Vec<T> {
    let Some(first) = list.iter().position(|item| value(item).is_some()) else { return list };
    if list.iter().skip(first + 1).all(|item| value(item).is_none()) {
        return list;
    }
    let all = list.iter().filter_map(&value).reduce(join).map(one);
    let mut found: Vec<T> = Vec::with_capacity(list.len());
    let mut all = all.into_iter();
    for item in list {
        match value(&item) {
            Some(_) => found.extend(all.next()),
            None => found.push(item),
        }
    }
    found
}

fn value(expression: &Expression) -> Option<f64> {
    match expression {
        Expression::Literal(value) => Some(*value),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn literal(value: f64) -> Expression {
        Expression::Literal(value)
    }

    /// (2 - 0.5) x 4, less what a statement of literals gives, is one number; a local keeps its place between literals.
    #[test]
    fn literals_become_one_literal() {
        let half = Expression::Sum(vec![(false, literal(2.0)), (true, literal(0.5))]);
        let product = Expression::Product(vec![half, Expression::Local(Local(1)), literal(4.0)]);
        let quotient = Expression::Quotient(Box::new(literal(-3.0)), Box::new(Expression::Local(Local(0))));
        let mut program = Program {
            locals: vec!["a".to_owned(), "b".to_owned(), "c".to_owned()],
            statements: vec![
                Statement::Let { local: Local(0), value: Expression::Call(Call::Sqrt, vec![literal(2.25)]) },
                Statement::Let { local: Local(2), value: product },
            ],
            results: vec![
                quotient,
                Expression::Sum(vec![(true, Expression::Local(Local(0))), (false, literal(1.0))]),
                Expression::Neg(Box::new(Expression::Local(Local(2)))),
            ],
            ..Program::default()
        };
        fold(&mut program);
        let product = Expression::Product(vec![literal(6.0), Expression::Local(Local(1))]);
        let [Statement::Let { local: Local(2), value }] = &program.statements[..] else { panic!("one statement") };
        assert_eq!(*value, product);
        let rest = Expression::Neg(Box::new(Expression::Local(Local(2))));
        assert_eq!(program.results, [literal(-2.0), literal(-0.5), rest]);
    }

    /// One literal among others is no reason to change anything.
    #[test]
    fn single_literals_stay_where_they_are() {
        let sum = Expression::Sum(vec![
            (false, Expression::Local(Local(0))),
            (true, literal(0.5)),
            (true, Expression::Local(Local(1))),
        ]);
        assert_eq!(folded(sum.clone()), sum);
    }
}
