//! Stage `optimize`, on a program: sines of angles that are known at the same time are taken together.
//!
//! In: statements in the order in which results need them. Out: the same with fewer [`Statement::SinCos`], each with several angles.
//! A scalar takes several angles at once in less time than one after the other (`Real::sin_cos_all` of the runtime).
//!
//! Where the first sine stands that has no group yet, the next ones join it whose angles are known there, or follow from what
//! is known there by `let` statements, which move in front of the group. An angle that depends on a sine, a linear system or an
//! iteration behind that place starts a later group, or joins one. Nothing moves back, into an iteration or out of
//! one, and no value changes. A group has at most [`MOST`] angles, in the order in which they are needed: sines that wait long for
//! their use only take up registers.

use std::collections::HashMap;

use super::program::{Local, Statement};

/// As many angles go together: two vectors of four `f64`, one of eight `f32`.
pub const MOST: usize = 8;

/// Statements with their sines in groups, those inside iterations too.
pub fn gather(statements: Vec<Statement>) -> Vec<Statement> {
    let reads = reads(&statements);
    let mut left: Vec<Option<Statement>> = statements.into_iter().map(|statement| Some(inside(statement))).collect();
    let mut gathered = Vec::with_capacity(left.len());
    for at in 0..left.len() {
        if !matches!(left[at], Some(Statement::SinCos(_))) {
            gathered.extend(left[at].take());
            continue;
        }
        let members = members(&left, &reads, at);
        for needed in needed(&left, &reads, &members) {
            gathered.extend(left[needed].take());
        }
        let sines = members.into_iter().filter_map(|member| match left[member].take() {
            Some(Statement::SinCos(sines)) => Some(sines),
            _ => None,
        });
        gathered.push(Statement::SinCos(sines.flatten().collect()));
    }
    gathered
}

/// With what stands inside it gathered.
fn inside(statement: Statement) -> Statement {
    match statement {
        Statement::Iterate { count, unknowns, start, body, next, residual } => {
            Statement::Iterate { count, unknowns, start, body: gather(body), next, residual }
        }
        other => other,
    }
}

/// For each statement the numbers of those that define what it reads.
fn reads(statements: &[Statement]) -> Vec<Vec<usize>> {
    let mut defined: HashMap<Local, usize> = HashMap::new();
    let mut reads = Vec::with_capacity(statements.len());
    for (number, statement) in statements.iter().enumerate() {
        let mut list = Vec::new();
        for expression in statement.expressions() {
            expression.each_local(&mut |local| list.extend(defined.get(&local)));
        }
        reads.push(list);
        defined.extend(statement.defined().into_iter().map(|local| (local, number)));
    }
    reads
}

/// The sine at `at`, and the next ones that can be taken with it.
fn members(left: &[Option<Statement>], reads: &[Vec<usize>], at: usize) -> Vec<usize> {
    let mut found = Vec::new();
    // Whether a statement behind `at` could as well stand there.
    let mut known = vec![false; left.len()];
    for number in at..left.len() {
        let ready = reads[number].iter().all(|&read| left[read].is_none() || known[read]);
        match &left[number] {
            Some(Statement::Let { .. }) => known[number] = ready,
            Some(Statement::SinCos(_)) if ready => found.push(number),
            _ => {}
        }
        if found.len() == MOST {
            break;
        }
    }
    found
}

/// What these read and is not written, in order.
fn needed(left: &[Option<Statement>], reads: &[Vec<usize>], members: &[usize]) -> Vec<usize> {
    let mut found: Vec<usize> = Vec::new();
    let mut stack: Vec<usize> = members.iter().flat_map(|&member| reads[member].iter().copied()).collect();
    let mut seen = vec![false; left.len()];
    while let Some(number) = stack.pop() {
        if left[number].is_some() && !std::mem::replace(&mut seen[number], true) {
            found.push(number);
            stack.extend(&reads[number]);
        }
    }
    found.sort_unstable();
    found
}
