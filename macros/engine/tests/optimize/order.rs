//! Long programs get an order of their own: no value changes, long ways begin early, few values are kept.

use std::collections::{HashMap, HashSet};

use crate::interpreter;
use crate::together::{is_in_order, local, number, set, sine, sum};
use multibody_engine::optimize::order::{FEWEST, MANY, order};
use multibody_engine::optimize::program::{Expression, Local, Program, Statement};

fn product(list: &[Expression]) -> Expression {
    Expression::Product(list.to_vec())
}

/// xorshift.
fn next(seed: &mut u64, below: usize) -> usize {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 33) as usize % below
}

/// Orders, and demands that nothing is lost, that all stands behind what it reads, and that results are the same to the last bit.
fn ordered(statements: Vec<Statement>, results: &[Expression], locals: usize) -> Vec<Statement> {
    let after = order(statements.clone(), &results.iter().collect::<Vec<_>>());
    assert!(is_in_order(&after, HashSet::new()), "{after:#?}");
    assert_eq!(after.len(), statements.len());
    let program = |statements| Program {
        locals: (0..locals).map(|k| format!("x{k}")).collect(),
        statements,
        results: results.to_vec(),
        ..Program::default()
    };
    let run = |statements| interpreter::run(&program(statements), &|_| f64::NAN, &|_| f64::NAN);
    let bits = |list: Vec<f64>| list.into_iter().map(f64::to_bits).collect::<Vec<u64>>();
    assert_eq!(bits(run(statements)), bits(run(after.clone())));
    after
}

/// First locals of statements.
fn first(statements: &[Statement]) -> Vec<usize> {
    statements.iter().map(|statement| statement.defined()[0].0).collect()
}

/// Values that are kept at a time, on average.
fn kept(statements: &[Statement], results: &[Expression]) -> f64 {
    let mut last: HashMap<Local, usize> = HashMap::new();
    for (number, statement) in statements.iter().enumerate() {
        for expression in statement.expressions() {
            expression.each_local(&mut |local| {
                last.insert(local, number);
            });
        }
    }
    for expression in results {
        expression.each_local(&mut |local| {
            last.insert(local, statements.len());
        });
    }
    let defined = statements.iter().enumerate().flat_map(|(at, s)| s.defined().into_iter().map(move |l| (l, at)));
    let lives: usize = defined.filter_map(|(local, at)| Some(last.get(&local)? - at)).sum();
    lives as f64 / statements.len() as f64
}

/// Sums, products, sines of what stands before them, and an iteration in the middle.
fn random(seed: &mut u64, count: usize) -> (Vec<Statement>, usize) {
    let mut statements = vec![set(0, number(0.7)), set(1, number(-0.4))];
    let mut known = vec![0, 1];
    let mut locals = 2;
    let draw = |seed: &mut u64, known: &[usize]| {
        let pick = |seed: &mut u64| local(known[known.len() - 1 - next(seed, known.len().min(40))]);
        let list: Vec<Expression> = (0..2 + next(seed, 2)).map(|_| pick(seed)).collect();
        match next(seed, 3) {
            0 => sum(&list),
            1 => product(&list),
            _ => Expression::Sum(vec![(true, product(&list)), (false, number(0.3))]),
        }
    };
    while statements.len() < count {
        let value = draw(seed, &known);
        if statements.len() == count / 2 {
            let (unknown, inner, residual) = (locals, locals + 1, locals + 2);
            let inside: Vec<usize> = known.iter().copied().chain([unknown]).collect();
            let mut body: Vec<Statement> = vec![set(inner, draw(seed, &inside))];
            body.extend(
                (0..FEWEST).map(|k| set(locals + 3 + k, sum(&[local(unknown), local(inner), number(k as f64)]))),
            );
            let last = locals + 2 + FEWEST;
            statements.push(Statement::Iterate {
                count: 3,
                unknowns: vec![Local(unknown)],
                start: vec![value],
                body,
                next: vec![product(&[local(last), number(0.01)])],
                residual: (Local(residual), local(locals + 3)),
            });
            known.extend([unknown, residual]);
            locals += 3 + FEWEST;
        } else if next(seed, 8) == 0 {
            statements.push(sine(locals, locals + 1, value));
            known.extend([locals, locals + 1]);
            locals += 2;
        } else {
            statements.push(set(locals, product(&[value, number(0.5)])));
            known.push(locals);
            locals += 1;
        }
    }
    (statements, locals)
}

#[test]
fn no_value_changes() {
    let mut seed = 0x9e37_79b9_7f4a_7c15;
    for (count, times) in [(FEWEST, 20), (500, 20), (MANY + 100, 3)] {
        for _ in 0..times {
            let (statements, locals) = random(&mut seed, count);
            // Some statements define what nothing reads.
            let all: Vec<Expression> = statements.iter().flat_map(Statement::defined).map(Expression::Local).collect();
            let some: Vec<Expression> = all.iter().rev().step_by(7).cloned().collect();
            for results in [all, some] {
                let after = ordered(statements.clone(), &results, locals);
                assert!(count > MANY || first(&after) != first(&statements));
                assert_eq!(first(&after), first(&order(statements.clone(), &results.iter().collect::<Vec<_>>())));
            }
        }
    }
}

#[test]
fn short_programs_stay_as_they_are() {
    let mut seed = 42;
    let (statements, _) = random(&mut seed, FEWEST - 1);
    assert_eq!(first(&order(statements.clone(), &[])), first(&statements));
}

/// A long chain behind many short ways.
#[test]
fn long_ways_begin_early() {
    let half = FEWEST / 2;
    let mut statements: Vec<Statement> = (0..half).map(|k| set(k, number(k as f64))).collect();
    statements.push(set(half, number(1.5)));
    statements.extend((half + 1..FEWEST + 1).map(|k| set(k, product(&[local(k - 1), number(1.01)]))));
    let results: Vec<Expression> = (0..half).chain([FEWEST]).map(local).collect();
    let after = ordered(statements, &results, FEWEST + 1);
    assert_eq!(first(&after)[0], half);
}

/// Values are made one after the other, and added up in pairs only then: each sum frees two values.
#[test]
fn few_values_are_kept() {
    for pairs in [FEWEST, MANY] {
        let mut statements: Vec<Statement> = (0..2 * pairs).map(|k| set(k, number(k as f64))).collect();
        statements.extend((0..pairs).map(|k| set(2 * pairs + k, sum(&[local(2 * k), local(2 * k + 1)]))));
        let results: Vec<Expression> = (2 * pairs..3 * pairs).map(local).collect();
        let before = kept(&statements, &results);
        let after = ordered(statements, &results, 3 * pairs);
        assert!(kept(&after, &results) < 0.55 * before, "{before} {}", kept(&after, &results));
    }
}

/// Of a long program the operand that takes more values while it is made comes first: the other one would be kept meanwhile.
#[test]
fn what_needs_more_comes_first() {
    let pairs = MANY / 2;
    // A value, then a sum of pairs of sums, as a tree of four leaves: it needs more.
    let mut statements = vec![set(0, number(0.5))];
    statements.extend((1..5).map(|k| set(k, number(k as f64))));
    statements.extend([set(5, sum(&[local(1), local(2)])), set(6, sum(&[local(3), local(4)]))]);
    statements.push(set(7, sum(&[local(5), local(6)])));
    statements.push(set(8, sum(&[local(0), local(7)])));
    statements.extend((9..9 + 2 * pairs).map(|k| set(k, number(k as f64))));
    let results: Vec<Expression> = (8..9 + 2 * pairs).map(local).collect();
    let after = ordered(statements, &results, 9 + 2 * pairs);
    assert_eq!(first(&after)[..9], [1, 2, 5, 3, 4, 6, 7, 0, 8]);
}

/// What many statements read makes no work for each pair of them.
#[test]
fn values_that_everything_reads_cost_little() {
    let count = 100_000;
    let mut statements = vec![set(0, number(1.0))];
    statements.extend((1..count).map(|k| set(k, product(&[local(0), number(k as f64)]))));
    let results: Vec<Expression> = (1..count).map(local).collect();
    let start = std::time::Instant::now();
    ordered(statements, &results, count);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}
