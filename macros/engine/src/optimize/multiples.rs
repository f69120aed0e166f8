//! Stage `optimize`, pass: literal multiples that several places need.
//!
//! In: a DAG. Out: c x made a node of its own where several sums hold it, alone or as part of a product: c x y + .. and
//! c x z + .. share the product c x. Coefficients float freely before this pass; what it makes, stays.

use std::collections::BTreeMap;

use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// A term of a sum: the sum, the term's node.
type Place = (Id, Id);

pub fn multiples(dag: &mut Dag) {
    of_results(dag);
    loop {
        let order = dag.order();
        let uses = dag.uses(&order);
        let mut places: BTreeMap<(Id, u64), (Number, Vec<Place>)> = BTreeMap::new();
        for &id in &order {
            let Kind::Sum(terms) = &dag.nodes[id].kind else { continue };
            for &(c, term) in terms {
                if c.is_unit() || term == ONE || dag.nodes[id].stage <= Stage::Parameter {
                    continue;
                }
                let mut add = |factor: Id| {
                    let entry = places.entry((factor, c.abs().residue)).or_insert_with(|| (c.abs(), Vec::new()));
                    if entry.1.last() != Some(&(id, term)) {
                        entry.1.push((id, term));
                    }
                };
                // The multiple may stand as a node already, as a sum of one term.
                add(term);
                if let (Kind::Product(factors), 1) = (&dag.nodes[term].kind, uses[term]) {
                    factors.iter().for_each(|&f| add(f));
                }
            }
        }
        let best = places
            .into_iter()
            .filter(|(_, (_, list))| list.len() > 1)
            .max_by(|a, b| a.1.1.len().cmp(&b.1.1.len()).then_with(|| b.0.cmp(&a.0)));
        let Some(((factor, _), (c, list))) = best else { return };
        if !share(dag, factor, c, &list) {
            return;
        }
    }
}

/// A result that is a multiple becomes a node, so that it is computed once, and by `Model::new` where parameters suffice.
fn of_results(dag: &mut Dag) {
    for k in 0..dag.roots.len() {
        let (c, id) = dag.roots[k];
        if id != ONE && !c.is_unit() {
            let sign = if c.is_negative() { Number::ONE.neg() } else { Number::ONE };
            dag.roots[k] = (sign, dag.plain((c.abs(), id)));
        }
    }
}

fn share(dag: &mut Dag, factor: Id, c: Number, list: &[Place]) -> bool {
    let multiple = dag.plain((c, factor));
    let mut changed = false;
    for &(sum, term) in list {
        if sum == multiple {
            continue;
        }
        let Kind::Sum(mut terms) = dag.nodes[sum].kind.clone() else { continue };
        let Some(at) = terms.iter().position(|t| t.1 == term) else { continue };
        let unit = if terms[at].0 == c { Number::ONE } else { Number::ONE.neg() };
        terms[at] = if term == factor {
            (unit, multiple)
        } else {
            let Kind::Product(mut factors) = dag.nodes[term].kind.clone() else { continue };
            let Some(position) = factors.iter().position(|&f| f == factor) else { continue };
            factors[position] = multiple;
            let (sign, product) = dag.product(factors);
            (unit.mul(sign), product)
        };
        terms.sort_by_key(|t| t.1);
        if terms.windows(2).any(|pair| pair[0].1 == pair[1].1) {
            continue;
        }
        changed |= dag.rewrite(sum, Kind::Sum(terms));
    }
    changed
}
