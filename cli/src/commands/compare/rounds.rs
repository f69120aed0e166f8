//! What an evaluation costs where it iterates: the compiler's count has one round of each iteration, since that is enough to
//! choose between ways to one function. Formulations differ in whether they iterate at all, so here every round counts.

use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::cost::Cost;
use multibody_engine::optimize::program::{Expression, Function, Statement};
use multibody_engine::symbolic::graph::BlockKind;

/// The weighted sum of all operations.
pub(super) fn work(function: &Function) -> u32 {
    function.after.weight() + beyond_first(&function.program.statements)
}

/// Work of all rounds but the first.
fn beyond_first(statements: &[Statement]) -> u32 {
    let rounds = statements.iter().map(|statement| match statement {
        Statement::Iterate { count, body, next, .. } => {
            let again = u32::try_from(count.saturating_sub(1)).unwrap_or(u32::MAX);
            let round =
                body.iter().map(of_statement).chain(next.iter().map(of_expression)).fold(Cost::default(), Cost::plus);
            again.saturating_mul(round.weight()) + beyond_first(body) * (again + 1)
        }
        _ => 0,
    });
    rounds.sum()
}

/// With one round of what iterates.
fn of_statement(statement: &Statement) -> Cost {
    let inside = statement.expressions().map(of_expression).fold(Cost::default(), Cost::plus);
    let own = match statement {
        Statement::SinCos { .. } => Cost { sincos: 1, ..Cost::default() },
        Statement::Solve { size, symmetric, groups, .. } => {
            Cost::of_block(&BlockKind::Solve { size: *size, symmetric: *symmetric, groups: groups.clone() })
        }
        Statement::Let { .. } | Statement::Iterate { .. } => Cost::default(),
    };
    own.plus(inside)
}

fn of_expression(expression: &Expression) -> Cost {
    let (own, operands): (Cost, Vec<&Expression>) = match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {
            (Cost::default(), Vec::new())
        }
        Expression::Neg(inner) => (Cost::default(), vec![inner]),
        Expression::Sum(terms) => {
            (Cost { add: count(terms) - 1, ..Cost::default() }, terms.iter().map(|(_, term)| term).collect())
        }
        Expression::Product(factors) => (Cost { mul: count(factors) - 1, ..Cost::default() }, factors.iter().collect()),
        Expression::Quotient(a, b) => (Cost { div: 1, ..Cost::default() }, vec![a, b]),
        Expression::Call(call, arguments) => (of_call(*call), arguments.iter().collect()),
    };
    operands.into_iter().map(of_expression).fold(own, Cost::plus)
}

fn of_call(call: Call) -> Cost {
    let cost = Cost::default();
    match call {
        Call::Nan | Call::Epsilon => cost,
        Call::Sqrt => Cost { sqrt: 1, ..cost },
        Call::Min | Call::Max | Call::Select => Cost { add: 1, ..cost },
        call if call.is_comparison() => Cost { compare: 1, ..cost },
        _ => Cost { other: 1, ..cost },
    }
}

fn count<T>(list: &[T]) -> u32 {
    u32::try_from(list.len().max(1)).unwrap_or(u32::MAX)
}
