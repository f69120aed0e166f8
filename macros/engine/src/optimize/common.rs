//! Stage `optimize`, pass: common parts of sums and products.
//!
//! In: a DAG. Out: pairs of terms (with their ratio of coefficients) that several sums hold, and pairs of factors that
//! several products hold, made nodes of their own, those that save most first (Hosangadi, Fallah and Kastner 2006).
//! Whole sums and products that are equal are one node already, by their prints.

use std::collections::HashMap;
use std::ops::{Div, Mul};

use crate::symbolic::fingerprint::Print;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ratio};

/// Repeats until nothing is shared that could be.
pub fn share(dag: &mut Dag) {
    for _ in 0..32 {
        let sums = share_sums(dag);
        let products = share_products(dag);
        if !sums && !products {
            return;
        }
    }
}

fn share_sums(dag: &mut Dag) -> bool {
    let mut pairs: HashMap<(Id, Id, Print), Vec<Id>> = HashMap::new();
    let order = dag.order();
    let uses = dag.uses(&order);
    for &id in &order {
        let Kind::Sum(terms) = &dag.nodes[id].kind else { continue };
        // A term that only this sum has is in no common pair. The constant is a term like others. Ratios are taken of
        // what has all its digits.
        let shared = |&(c, x): &(Number, Id)| uses[x] > 1 && c.is_sharp();
        let shared: Vec<(Number, Id)> = terms.iter().copied().filter(shared).collect();
        if shared.len() > 64 {
            continue;
        }
        for (i, &(c, x)) in shared.iter().enumerate() {
            for &(d, y) in &shared[i + 1..] {
                pairs.entry((x, y, ratio(d, c))).or_default().push(id);
            }
        }
    }
    let mut list: Vec<((Id, Id, Print), Vec<Id>)> = pairs.into_iter().filter(|(_, sums)| sums.len() > 1).collect();
    list.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then_with(|| a.0.cmp(&b.0)));
    let mut changed = false;
    for ((x, y, r), sums) in list {
        let holding: Vec<(Id, Number, Number)> = sums
            .into_iter()
            .filter_map(|id| {
                let Kind::Sum(terms) = &dag.nodes[id].kind else { return None };
                let find = |node| terms.iter().find(|t| t.1 == node).map(|t| t.0);
                let (c, d) = (find(x)?, find(y)?);
                (ratio(d, c) == r).then_some((id, c, d))
            })
            .collect();
        let Some(&(_, c, d)) = holding.first().filter(|_| holding.len() > 1) else { continue };
        let pair = match holding.iter().find(|(id, ..)| matches!(&dag.nodes[*id].kind, Kind::Sum(t) if t.len() == 2)) {
            // One of the sums is this pair already.
            Some(&(whole, c, _)) => {
                for &(id, e, _) in holding.iter().filter(|h| h.0 != whole) {
                    changed |= replace_terms(dag, id, x, y, (e.div(c), whole));
                }
                continue;
            }
            None => dag.sum(vec![(Number::ONE, x), (d.div(c), y)]),
        };
        for &(id, e, _) in &holding {
            if id != pair.1 {
                changed |= replace_terms(dag, id, x, y, (e.mul(pair.0), pair.1));
            }
        }
    }
    changed
}

fn replace_terms(dag: &mut Dag, id: Id, x: Id, y: Id, by: (Number, Id)) -> bool {
    if let Kind::Sum(terms) = &dag.nodes[id].kind {
        let mut terms: Vec<(Number, Id)> = terms.iter().copied().filter(|t| t.1 != x && t.1 != y).collect();
        terms.push(by);
        let terms = dag.normal_terms(terms);
        return dag.rewrite(id, Kind::Sum(terms));
    }
    false
}

fn share_products(dag: &mut Dag) -> bool {
    let mut pairs: HashMap<(Id, Id), Vec<Id>> = HashMap::new();
    let order = dag.order();
    let uses = dag.uses(&order);
    // Products of two factors are what they are, and found by their print; longer ones may hold them.
    for &id in &order {
        let Kind::Product(factors) = &dag.nodes[id].kind else { continue };
        let mut seen = Vec::new();
        for (i, &x) in factors.iter().enumerate() {
            for &y in &factors[i + 1..] {
                if uses[x] > 1 && uses[y] > 1 && !seen.contains(&(x, y)) {
                    seen.push((x, y));
                    pairs.entry((x, y)).or_default().push(id);
                }
            }
        }
    }
    let mut list: Vec<((Id, Id), Vec<Id>)> = pairs.into_iter().filter(|(_, products)| products.len() > 1).collect();
    list.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then_with(|| a.0.cmp(&b.0)));
    let mut changed = false;
    for ((x, y), products) in list {
        let holding: Vec<Id> = products.into_iter().filter(|&id| holds(dag, id, x, y)).collect();
        if holding.len() < 2 {
            continue;
        }
        let (c, pair) = dag.product(vec![x, y]);
        if !c.is_one() {
            continue;
        }
        for id in holding {
            let Kind::Product(factors) = &dag.nodes[id].kind else { continue };
            if id == pair || factors.len() == 2 {
                continue;
            }
            let mut factors = factors.clone();
            for f in [x, y] {
                if let Some(position) = factors.iter().position(|&g| g == f) {
                    factors.remove(position);
                }
            }
            factors.push(pair);
            factors.sort_unstable();
            changed |= dag.rewrite(id, Kind::Product(factors));
        }
    }
    changed
}

fn holds(dag: &Dag, id: Id, x: Id, y: Id) -> bool {
    let Kind::Product(factors) = &dag.nodes[id].kind else { return false };
    if x == y {
        return factors.iter().filter(|&&f| f == x).count() > 1;
    }
    factors.contains(&x) && factors.contains(&y)
}
