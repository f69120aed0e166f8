//! Sines of angles that are known at the same time go together, and no angle goes before what it is made of.

use std::collections::HashSet;

use crate::interpreter;
use multibody_engine::optimize::program::{Expression, Local, Program, Sine, Statement};
use multibody_engine::optimize::together::{MOST, gather};

pub(crate) fn local(number: usize) -> Expression {
    Expression::Local(Local(number))
}

pub(crate) fn number(value: f64) -> Expression {
    Expression::Literal(value)
}

pub(crate) fn sum(list: &[Expression]) -> Expression {
    Expression::Sum(list.iter().map(|term| (false, term.clone())).collect())
}

pub(crate) fn set(number: usize, value: Expression) -> Statement {
    Statement::Let { local: Local(number), value }
}

pub(crate) fn sine(sin: usize, cos: usize, angle: Expression) -> Statement {
    Statement::SinCos(vec![Sine { sin: Local(sin), cos: Local(cos), angle }])
}

/// Sines by the number of the first local of each, group by group.
fn groups(statements: &[Statement]) -> Vec<Vec<usize>> {
    let sines = statements.iter().filter_map(|statement| match statement {
        Statement::SinCos(sines) => Some(sines.iter().map(|sine| sine.sin.0).collect()),
        _ => None,
    });
    sines.collect()
}

/// Whatever is read stands before; members of a group read nothing of each other.
pub(crate) fn is_in_order(statements: &[Statement], mut written: HashSet<Local>) -> bool {
    statements.iter().all(|statement| {
        let mut ready = true;
        let mut look = |expression: &Expression, written: &HashSet<Local>| {
            expression.each_local(&mut |local| ready &= written.contains(&local));
        };
        if let Statement::Iterate { unknowns, start, body, next, residual, .. } = statement {
            start.iter().for_each(|expression| look(expression, &written));
            let mut inside = written.clone();
            inside.extend(unknowns);
            if !is_in_order(body, inside.clone()) {
                return false;
            }
            inside.extend(body.iter().flat_map(Statement::defined));
            next.iter().chain([&residual.1]).for_each(|expression| look(expression, &inside));
        } else {
            statement.expressions().for_each(|expression| look(expression, &written));
        }
        written.extend(statement.defined());
        ready
    })
}

/// Gathers, and demands that all results are the same to the last bit.
fn gathered(statements: Vec<Statement>, locals: usize) -> Vec<Statement> {
    let results = (0..locals).map(local).collect::<Vec<_>>();
    let program = |statements| Program {
        locals: (0..locals).map(|k| format!("x{k}")).collect(),
        statements,
        results: results.clone(),
        ..Program::default()
    };
    let run = |statements| interpreter::run(&program(statements), &|_| f64::NAN, &|_| f64::NAN);
    let after = gather(statements.clone());
    assert!(is_in_order(&after, HashSet::new()), "{after:#?}");
    let bits = |list: Vec<f64>| list.into_iter().map(f64::to_bits).collect::<Vec<u64>>();
    assert_eq!(bits(run(statements)), bits(run(after.clone())));
    after
}

#[test]
fn angles_that_are_known_go_together() {
    let statements = vec![
        set(0, number(0.731_284_519_006_37)),
        sine(1, 2, local(0)),
        set(3, sum(&[local(1), local(2)])),
        // Known from the start, by a statement that moves.
        set(4, sum(&[local(0), number(1.117_390_284_661_7)])),
        sine(5, 6, local(4)),
        // Made of the first sine.
        sine(7, 8, sum(&[local(3), local(0)])),
        sine(9, 10, number(-2.360_912_735_81)),
        // Made of the group after.
        sine(11, 12, sum(&[local(7), local(5)])),
        sine(13, 14, sum(&[local(5), local(10)])),
    ];
    let after = gathered(statements, 15);
    assert_eq!(groups(&after), [vec![1, 5, 9], vec![7, 13], vec![11]]);
    let order: Vec<Vec<Local>> = after.iter().map(Statement::defined).collect();
    assert_eq!(order[..2], [vec![Local(0)], vec![Local(4)]]);
}

#[test]
fn groups_are_bounded() {
    let statements: Vec<Statement> =
        (0..2 * MOST + 3).map(|k| sine(2 * k, 2 * k + 1, number(0.1 + k as f64))).collect();
    let sizes: Vec<usize> = groups(&gathered(statements, 4 * MOST + 6)).iter().map(Vec::len).collect();
    assert_eq!(sizes, [MOST, MOST, 3]);
}

/// What a linear system or an iteration gives is not known before; what stands inside an iteration stays there.
#[test]
fn blocks_stay_where_they_are() {
    let statements = vec![
        sine(0, 1, number(0.377_201_649_3)),
        Statement::Solve {
            size: 1,
            symmetric: false,
            groups: Box::default(),
            matrix: vec![number(1.7)],
            rhs: vec![local(0)],
            measures: Vec::new(),
            results: vec![Local(2), Local(3)],
        },
        sine(4, 5, local(2)),
        sine(6, 7, number(1.913_370_482_5)),
        Statement::Iterate {
            count: 3,
            unknowns: vec![Local(8)],
            start: vec![local(4)],
            body: vec![
                sine(9, 10, local(8)),
                set(11, sum(&[local(8), local(6)])),
                sine(12, 13, local(11)),
                sine(14, 15, local(12)),
                sine(16, 17, local(7)),
            ],
            next: vec![sum(&[local(14), local(9)])],
            residual: (Local(18), local(16)),
        },
        sine(19, 20, local(8)),
        sine(21, 22, local(5)),
    ];
    let after = gather(statements);
    assert!(is_in_order(&after, HashSet::new()), "{after:#?}");
    assert_eq!(groups(&after), [vec![0, 6], vec![4], vec![19, 21]]);
    let body = after.iter().find_map(|statement| match statement {
        Statement::Iterate { body, .. } => Some(groups(body)),
        _ => None,
    });
    assert_eq!(body.expect("an iteration"), [vec![9, 12, 16], vec![14]]);
}
