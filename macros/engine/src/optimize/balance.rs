//! Stage `optimize`, pass: where literal factors stand.
//!
//! In: a DAG. Out: the same with every sum scaled by a literal so that as few coefficients as possible differ from one:
//! a value that is only ever used three times as large is computed three times as large. A scaled sum scales the
//! products that hold it, and through them other sums' coefficients; quotients scale inversely. Only literals move: a
//! parameter might be zero.

use std::ops::{Div, Mul};

use crate::symbolic::fingerprint::Print;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// Scales sums one after the other while that saves products, at most a few rounds.
pub fn balance(dag: &mut Dag) {
    for _ in 0..4 {
        let order = dag.order();
        let users = users(dag, &order);
        let mut changed = false;
        for &id in order.iter().rev() {
            if dag.nodes[id].stage > Stage::Parameter && matches!(dag.nodes[id].kind, Kind::Sum(_)) {
                changed |= rescale(dag, id, &users);
            }
        }
        if !changed {
            return;
        }
        dag.forget_dead();
    }
}

struct Users {
    nodes: Vec<Vec<Id>>,
    roots: Vec<Vec<usize>>,
}

fn users(dag: &Dag, order: &[Id]) -> Users {
    let mut nodes = vec![Vec::new(); dag.nodes.len()];
    let mut roots = vec![Vec::new(); dag.nodes.len()];
    for &id in order {
        for operand in dag.operands(&dag.nodes[id].kind) {
            if nodes[operand].last() != Some(&id) {
                nodes[operand].push(id);
            }
        }
    }
    for (k, &(_, id)) in dag.roots.iter().enumerate() {
        roots[id].push(k);
    }
    Users { nodes, roots }
}

/// What a scaling reaches: products and reciprocals with the power of the factor they take, sums and roots behind them.
struct Reach {
    /// Node and power.
    scaled: Vec<(Id, i32)>,
    /// Sum, term, power of the factor by which the term grows.
    coefficients: Vec<(Id, Id, i32)>,
    roots: Vec<(usize, i32)>,
}

fn reach(dag: &Dag, start: Id, users: &Users) -> Option<Reach> {
    let mut reach = Reach { scaled: vec![(start, 1)], coefficients: Vec::new(), roots: Vec::new() };
    let mut at = 0;
    while at < reach.scaled.len() {
        let (id, power) = reach.scaled[at];
        at += 1;
        reach.roots.extend(users.roots[id].iter().map(|&k| (k, power)));
        for &user in &users.nodes[id] {
            match &dag.nodes[user].kind {
                Kind::Sum(_) => reach.coefficients.push((user, id, power)),
                Kind::Product(factors) => {
                    // A product met twice would need both powers at once: rare, so left alone.
                    if reach.scaled.iter().any(|&(s, _)| s == user) {
                        return None;
                    }
                    let others = factors.iter().any(|f| *f != id && reach.scaled.iter().any(|&(s, _)| s == *f));
                    if others {
                        return None;
                    }
                    let count = factors.iter().filter(|&&f| f == id).count() as i32;
                    reach.scaled.push((user, power * count));
                }
                Kind::Reciprocal(_) => {
                    if reach.scaled.iter().any(|&(s, _)| s == user) {
                        return None;
                    }
                    reach.scaled.push((user, -power));
                }
                _ => return None,
            }
        }
        if reach.scaled.len() > 64 || reach.coefficients.len() > 256 {
            return None;
        }
    }
    Some(reach)
}

fn rescale(dag: &mut Dag, id: Id, users: &Users) -> bool {
    let Kind::Sum(terms) = dag.nodes[id].kind.clone() else { return false };
    let Some(reach) = reach(dag, id, users) else { return false };
    if reach.coefficients.iter().any(|&(sum, term, _)| coefficient(dag, sum, term).is_none()) {
        return false;
    }
    let mut candidates: Vec<Number> = Vec::new();
    let mut propose = |n: Number| {
        let n = n.abs();
        // Nothing is divided by what has cancelled, and nothing is scaled by it.
        if !n.is_sharp() {
            return;
        }
        if !n.is_one() && !n.is_zero() && n.value().is_finite() && !candidates.contains(&n) {
            candidates.push(n);
        }
    };
    for &(c, term) in &terms {
        if term != ONE && !c.is_unit() {
            propose(inverse(c));
        }
    }
    for &(sum, term, power) in &reach.coefficients {
        if let (Some(c), 1 | -1) = (coefficient(dag, sum, term), power) {
            propose(if power == 1 { c } else { inverse(c) });
        }
    }
    for &(k, power) in &reach.roots {
        if power.abs() == 1 {
            let c = dag.roots[k].0;
            propose(if power == 1 { c } else { inverse(c) });
        }
    }
    let before = expense(dag, &terms, &reach, Number::ONE);
    let mut best: Option<(usize, Number)> = None;
    for candidate in candidates {
        let cost = expense(dag, &terms, &reach, candidate);
        if cost < best.map_or(before, |(c, _)| c) {
            best = Some((cost, candidate));
        }
    }
    let Some((_, factor)) = best else { return false };
    apply(dag, id, terms, &reach, factor);
    true
}

fn coefficient(dag: &Dag, sum: Id, term: Id) -> Option<Number> {
    match &dag.nodes[sum].kind {
        Kind::Sum(terms) => terms.iter().find(|t| t.1 == term).map(|t| t.0),
        _ => None,
    }
}

/// One over a literal; of what isn't sharp itself, which is then not proposed.
fn inverse(c: Number) -> Number {
    if c.is_sharp() { Number::ONE.div(c) } else { c }
}

fn power(n: Number, exponent: i32) -> Number {
    let p = (0..exponent.unsigned_abs()).fold(Number::ONE, |p, _| p.mul(n));
    if exponent < 0 { Number::ONE.div(p) } else { p }
}

/// Coefficients that would not be one.
fn expense(dag: &Dag, terms: &[(Number, Id)], reach: &Reach, factor: Number) -> usize {
    let inside = terms.iter().filter(|t| t.1 != ONE && !t.0.is_inverse_of(factor)).count();
    // c / factor^p is one where c is that power.
    let costs = |c: Number, p: i32| match p {
        1 => !c.equals_up_to_sign(factor),
        -1 => !c.is_inverse_of(factor),
        _ => !c.equals_up_to_sign(power(factor, p)),
    };
    let outside =
        reach.coefficients.iter().filter(|&&(sum, term, p)| coefficient(dag, sum, term).is_some_and(|c| costs(c, p)));
    let roots = reach.roots.iter().filter(|&&(k, p)| costs(dag.roots[k].0, p));
    inside + outside.count() + roots.count()
}

fn apply(dag: &mut Dag, id: Id, terms: Vec<(Number, Id)>, reach: &Reach, factor: Number) {
    // Users first: their sums keep their values while the terms change theirs.
    let scaled: Vec<(Id, Print)> =
        reach.scaled.iter().map(|&(node, p)| (node, dag.nodes[node].print.mul(power(factor, p).print()))).collect();
    let terms = terms.into_iter().map(|(c, t)| (c.mul(factor), t)).collect();
    for &(node, print) in &scaled {
        let kind = if node == id { Kind::Sum(Vec::clone(&terms)) } else { dag.nodes[node].kind.clone() };
        dag.replace(node, kind, print);
        // What is three times a moment is not called that moment.
        let name = dag.nodes[node].name.take();
        dag.nodes[node].part_of = name.map(|name| name.text);
    }
    // Several terms of one sum may be scaled: its value is kept only by all of them together.
    let mut sums: Vec<Id> = reach.coefficients.iter().map(|&(sum, ..)| sum).collect();
    sums.sort_unstable();
    sums.dedup();
    for sum in sums {
        if let Kind::Sum(mut list) = dag.nodes[sum].kind.clone() {
            for &(_, term, p) in reach.coefficients.iter().filter(|c| c.0 == sum) {
                for t in list.iter_mut().filter(|t| t.1 == term) {
                    t.0 = t.0.mul(power(factor, -p));
                }
            }
            dag.rewrite(sum, Kind::Sum(list));
        }
    }
    for &(k, p) in &reach.roots {
        dag.roots[k].0 = dag.roots[k].0.mul(power(factor, -p));
    }
}
