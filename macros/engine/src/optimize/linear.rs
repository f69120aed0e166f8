//! Stage `optimize`, pass: sums as linear combinations.
//!
//! In: a DAG. Out: every sum whose terms cancel or meet once the sums within it are multiplied out, multiplied out: in
//! a + c (b - d a) + e d what is left of a and d may be nothing at all. Only scaled sums are opened, never products, and
//! only where the result is cheaper than what it replaces, so the pass never costs anything.

use std::collections::HashMap;
use std::ops::Mul;

use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// Longer combinations are left alone.
const MOST_TERMS: usize = 24;

pub fn combine(dag: &mut Dag) {
    let order = dag.order();
    let uses = dag.uses(&order);
    let mut forms: HashMap<Id, Vec<(Number, Id)>> = HashMap::new();
    for id in order {
        let Kind::Sum(terms) = dag.nodes[id].kind.clone() else { continue };
        let opens = |(_, inner): &(Number, Id)| forms.contains_key(inner) && is_late(dag, *inner);
        if !terms.iter().any(opens) {
            forms.insert(id, terms);
            continue;
        }
        let mut open = Vec::with_capacity(terms.len());
        for &(c, inner) in &terms {
            match forms.get(&inner).filter(|_| is_late(dag, inner)) {
                Some(form) => open.extend(form.iter().map(|&(d, atom)| (c.mul(d), atom))),
                None => open.push((c, inner)),
            }
        }
        let open = dag.normal_terms(open);
        if open.len() > MOST_TERMS {
            continue;
        }
        if !open.is_empty() && expense(&open) < within(dag, &terms, &uses) {
            dag.rewrite(id, Kind::Sum(open.clone()));
        }
        forms.insert(id, open);
    }
}

/// Sums of parameters are computed once: they stay together.
fn is_late(dag: &Dag, id: Id) -> bool {
    dag.nodes[id].stage > Stage::Parameter
}

/// Additions and products of a sum.
fn expense(terms: &[(Number, Id)]) -> usize {
    terms.len() - 1 + terms.iter().filter(|(c, id)| *id != ONE && !c.is_unit()).count()
}

/// The same with those of the sums that nothing else needs.
fn within(dag: &Dag, terms: &[(Number, Id)], uses: &[u32]) -> usize {
    let own = |&(_, id): &(Number, Id)| match &dag.nodes[id].kind {
        Kind::Sum(inner) if uses.get(id) == Some(&1) && is_late(dag, id) && !inner.is_empty() => {
            within(dag, inner, uses)
        }
        _ => 0,
    };
    expense(terms) + terms.iter().map(own).sum::<usize>()
}
