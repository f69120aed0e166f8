//! Stage `optimize`, pass: common factors.
//!
//! In: a DAG. Out: a x + b x + c = (a + b) x + c in every sum, greedily by the products it saves; literal coefficients
//! that several terms share come out likewise. Products that others use too are left alone.

use std::collections::BTreeMap;
use std::ops::{Mul, Neg};

use crate::invariant::injection::{Break, broken};
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

pub fn factor(dag: &mut Dag) {
    let order = dag.order();
    let mut uses = dag.uses(&order);
    for id in order {
        while let Kind::Sum(terms) = &dag.nodes[id].kind {
            if terms.len() < 2 {
                break;
            }
            let terms = terms.clone();
            let Some(best) = best_factor(dag, &terms, &uses) else { break };
            if !extract(dag, id, &terms, &best, &mut uses) {
                break;
            }
        }
    }
}

enum Common {
    Node(Id),
    Literal(Number),
}

struct Choice {
    common: Common,
    terms: Vec<usize>,
}

fn best_factor(dag: &Dag, terms: &[(Number, Id)], uses: &[u32]) -> Option<Choice> {
    let mut nodes: BTreeMap<Id, Vec<usize>> = BTreeMap::new();
    let mut literals: Vec<(Number, Vec<usize>)> = Vec::new();
    for (at, &(c, term)) in terms.iter().enumerate() {
        match &dag.nodes[term].kind {
            Kind::Product(factors) if uses.get(term) == Some(&1) => {
                let mut last = None;
                for &f in factors {
                    if last != Some(f) {
                        nodes.entry(f).or_default().push(at);
                    }
                    last = Some(f);
                }
            }
            Kind::One => {}
            _ => nodes.entry(term).or_default().push(at),
        }
        if term != ONE && !c.is_unit() {
            match literals.iter_mut().find(|(l, _)| *l == c || *l == c.neg()) {
                Some((_, list)) => list.push(at),
                None => literals.push((c, vec![at])),
            }
        }
    }
    let mut best: Option<(u32, Choice)> = None;
    for (node, list) in nodes {
        let saving = saving(dag, terms, node, &list);
        if list.len() > 1 && saving > 0 && best.as_ref().is_none_or(|(s, _)| saving as u32 > *s) {
            best = Some((saving as u32, Choice { common: Common::Node(node), terms: list }));
        }
    }
    for (literal, list) in literals {
        let saving = list.len() as u32 - 1;
        if saving > 0 && list.len() < terms.len() && best.as_ref().is_none_or(|(s, _)| saving > *s) {
            best = Some((saving, Choice { common: Common::Literal(literal), terms: list }));
        }
    }
    best.map(|(_, choice)| choice)
}

/// Products saved: each term loses one, the common one is new. Parameter work is free, so cofactors made of parameters
/// save the additions too.
fn saving(dag: &Dag, terms: &[(Number, Id)], node: Id, list: &[usize]) -> i64 {
    let mut saved = -1;
    let mut early = 0;
    for &at in list {
        let (c, term) = terms[at];
        if term == node {
            saved += i64::from(!c.is_unit());
            early += 1;
            continue;
        }
        saved += 1;
        if let Kind::Product(factors) = &dag.nodes[term].kind {
            let mut rest = factors.iter().filter(|&&f| f != node);
            early += i64::from(rest.all(|&f| dag.nodes[f].stage <= Stage::Parameter));
        }
    }
    if dag.nodes[node].stage > Stage::Parameter { saved + (early - 1).max(0) } else { saved }
}

fn extract(dag: &mut Dag, id: Id, terms: &[(Number, Id)], choice: &Choice, uses: &mut Vec<u32>) -> bool {
    let mut inner = Vec::with_capacity(choice.terms.len());
    let mut outer: Vec<(Number, Id)> = Vec::with_capacity(terms.len());
    for (at, &(c, term)) in terms.iter().enumerate() {
        if !choice.terms.contains(&at) {
            outer.push((c, term));
            continue;
        }
        match choice.common {
            Common::Literal(l) if c == l || broken(Break::FactoredSign) => inner.push((Number::ONE, term)),
            Common::Literal(_) => inner.push((Number::ONE.neg(), term)),
            Common::Node(node) if term == node => inner.push((c, ONE)),
            Common::Node(node) => {
                let mut rest = match &dag.nodes[term].kind {
                    Kind::Product(factors) => factors.clone(),
                    _ => vec![term],
                };
                if let Some(position) = rest.iter().position(|&f| f == node) {
                    rest.remove(position);
                }
                let (d, cofactor) = dag.product(rest);
                let c = if broken(Break::FactoredSign) { c.neg() } else { c };
                inner.push((c.mul(d), cofactor));
            }
        }
    }
    let (sign, sum) = dag.sum(inner);
    let (coefficient, term) = match choice.common {
        Common::Literal(l) => (l.mul(sign), sum),
        // The whole sum is the product: it must be made anew, since by its value the sum itself would be found.
        Common::Node(node) if outer.is_empty() => {
            let mut factors = vec![node, sum];
            factors.sort_unstable();
            let print = dag.factors_print(&factors);
            (sign, dag.push(Kind::Product(factors), print))
        }
        Common::Node(node) => {
            let (c, product) = dag.product(vec![node, sum]);
            (sign.mul(c), product)
        }
    };
    uses.resize(dag.nodes.len(), 1);
    uses[sum] += 1;
    outer.push((coefficient, term));
    outer.sort_by_key(|t| t.1);
    if outer.windows(2).any(|pair| pair[0].1 == pair[1].1) {
        outer = dag.normal_terms(outer);
    }
    dag.rewrite(id, Kind::Sum(outer))
}
