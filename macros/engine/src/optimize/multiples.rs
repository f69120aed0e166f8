//! Stage `optimize`, pass: literal multiples that several places need.
//!
//! In: a DAG. Out: c x made a node of its own where several sums hold it, alone or as part of a product: c x y + .. and
//! c x z + .. share the product c x. Coefficients float freely before this pass; what it makes, stays.

use std::collections::BTreeMap;
use std::ops::{Mul, Neg};

use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// A term of a sum: the sum, the term's node.
type Place = (Id, Id);

pub fn multiples(dag: &mut Dag) {
    for _ in 0..16 {
        let mut changed = false;
        for (factor, c, list) in candidates(dag) {
            let list: Vec<Place> = list.into_iter().filter(|&place| stands(dag, place, factor, c)).collect();
            if list.len() > 1 {
                changed |= share(dag, factor, c, &list);
            }
        }
        if !changed {
            return;
        }
    }
}

/// Factors and literals that meet in several sums, those in most sums first.
fn candidates(dag: &Dag) -> Vec<(Id, Number, Vec<Place>)> {
    let order = dag.order();
    let uses = dag.uses(&order);
    let mut places: BTreeMap<(Id, u64), (Number, Vec<Place>)> = BTreeMap::new();
    for &id in &order {
        let Kind::Sum(terms) = &dag.nodes[id].kind else { continue };
        if dag.nodes[id].stage <= Stage::Parameter {
            continue;
        }
        for &(c, term) in terms.iter().filter(|(c, term)| !c.is_unit() && *term != ONE) {
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
    let mut list: Vec<(Id, Number, Vec<Place>)> = places
        .into_iter()
        .filter(|(_, (_, list))| list.len() > 1)
        .map(|((factor, _), (c, list))| (factor, c, list))
        .collect();
    // Stable: ties stay in the order of nodes.
    list.sort_by_key(|(_, _, places)| std::cmp::Reverse(places.len()));
    list
}

/// Whether a sum still has this multiple: an earlier sharing may have taken it.
fn stands(dag: &Dag, (sum, term): Place, factor: Id, c: Number) -> bool {
    let Kind::Sum(terms) = &dag.nodes[sum].kind else { return false };
    terms.iter().any(|t| t.1 == term && t.0.abs() == c)
        && (term == factor || matches!(&dag.nodes[term].kind, Kind::Product(factors) if factors.contains(&factor)))
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
