//! Stage `optimize`, pass: literal multiples that several places need.
//!
//! In: a DAG. Out: c x made a node of its own where several sums hold it, alone or as part of a product: c x y + .. and
//! c x z + .. share the product c x; the entries of a quaternion's matrix double its components, not their products.
//! Coefficients float freely before this pass; what it makes, stays.

use std::collections::BTreeMap;
use std::ops::Mul;

use crate::symbolic::fingerprint::Print;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// Where a multiple stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Occurrence {
    /// The sum, the term's node.
    Term(Id, Id),
    /// The result's number.
    Root(usize),
}

pub fn multiples(dag: &mut Dag) {
    settle(dag);
    for _ in 0..16 {
        let mut changed = false;
        for (factor, c, list) in candidates(dag) {
            let list: Vec<Occurrence> = list.into_iter().filter(|&place| stands(dag, place, factor, c)).collect();
            if list.len() > 1 {
                changed |= share(dag, factor, c, &list);
            }
        }
        if !changed {
            return;
        }
    }
}

/// Results c (x + d y) become c x + c d y: as many products, and multiples of x and y that other places may have.
fn settle(dag: &mut Dag) {
    let uses = dag.uses(&dag.order());
    for k in 0..dag.roots.len() {
        let (c, id) = dag.roots[k];
        let Kind::Sum(terms) = &dag.nodes[id].kind else { continue };
        let plain = terms.iter().filter(|(d, term)| *term != ONE && d.is_unit()).count();
        if c.is_unit() || uses[id] != 1 || plain != 1 || dag.nodes[id].stage <= Stage::Parameter {
            continue;
        }
        let terms = terms.iter().map(|&(d, term)| (c.mul(d), term)).collect();
        let print = dag.nodes[id].print.mul(c.print());
        dag.replace(id, Kind::Sum(terms), print);
        let name = dag.nodes[id].name.take();
        dag.nodes[id].part_of = name.map(|name| name.text);
        dag.roots[k].0 = Number::ONE;
    }
}

/// Factors and literals that meet in several sums, those in most sums first.
fn candidates(dag: &Dag) -> Vec<(Id, Number, Vec<Occurrence>)> {
    let order = dag.order();
    let uses = dag.uses(&order);
    let mut places: BTreeMap<(Id, Print), (Number, Vec<Occurrence>)> = BTreeMap::new();
    for &id in &order {
        let Kind::Sum(terms) = &dag.nodes[id].kind else { continue };
        if dag.nodes[id].stage <= Stage::Parameter {
            continue;
        }
        for &(c, term) in terms.iter().filter(|(c, term)| !c.is_unit() && *term != ONE) {
            let mut add = |factor: Id| {
                let entry = places.entry((factor, c.abs().residue)).or_insert_with(|| (c.abs(), Vec::new()));
                if entry.1.last() != Some(&Occurrence::Term(id, term)) {
                    entry.1.push(Occurrence::Term(id, term));
                }
            };
            // The multiple may stand as a node already, as a sum of one term.
            add(term);
            if let (Kind::Product(factors), 1) = (&dag.nodes[term].kind, uses[term]) {
                factors.iter().for_each(|&f| add(f));
            }
        }
    }
    for (k, &(c, id)) in dag.roots.iter().enumerate() {
        if !c.is_unit() && id != ONE && dag.nodes[id].stage > Stage::Parameter {
            let mut add = |factor: Id| {
                let entry = places.entry((factor, c.abs().residue)).or_insert_with(|| (c.abs(), Vec::new()));
                if entry.1.last() != Some(&Occurrence::Root(k)) {
                    entry.1.push(Occurrence::Root(k));
                }
            };
            add(id);
            if let (Kind::Product(factors), 1) = (&dag.nodes[id].kind, uses[id]) {
                factors.iter().for_each(|&f| add(f));
            }
        }
    }
    let mut list: Vec<(Id, Number, Vec<Occurrence>)> = places
        .into_iter()
        .filter(|(_, (_, list))| list.len() > 1)
        .map(|((factor, _), (c, list))| (factor, c, list))
        .collect();
    // Stable: ties stay in the order of nodes.
    list.sort_by_key(|(_, _, places)| std::cmp::Reverse(places.len()));
    list
}

/// Whether a place still has this multiple: an earlier sharing may have taken it.
fn stands(dag: &Dag, place: Occurrence, factor: Id, c: Number) -> bool {
    match place {
        Occurrence::Root(k) => {
            let (d, id) = dag.roots[k];
            d.abs() == c
                && (id == factor || matches!(&dag.nodes[id].kind, Kind::Product(list) if list.contains(&factor)))
        }
        Occurrence::Term(sum, term) => {
            let Kind::Sum(terms) = &dag.nodes[sum].kind else { return false };
            terms.iter().any(|t| t.1 == term && t.0.abs() == c)
                && (term == factor || matches!(&dag.nodes[term].kind, Kind::Product(list) if list.contains(&factor)))
        }
    }
}

fn share(dag: &mut Dag, factor: Id, c: Number, list: &[Occurrence]) -> bool {
    let multiple = dag.plain((c, factor));
    let unit = |d: Number| if d == c { Number::ONE } else { -Number::ONE };
    let mut changed = false;
    for &place in list {
        match place {
            Occurrence::Root(k) => {
                let (d, id) = dag.roots[k];
                let sign = unit(d);
                dag.roots[k] = if id == factor {
                    (sign, multiple)
                } else {
                    let Kind::Product(mut factors) = dag.nodes[id].kind.clone() else { continue };
                    let Some(position) = factors.iter().position(|&f| f == factor) else { continue };
                    factors[position] = multiple;
                    let (other, product) = dag.product(factors);
                    (sign * other, product)
                };
                changed = true;
            }
            Occurrence::Term(sum, term) if sum != multiple => {
                let Kind::Sum(mut terms) = dag.nodes[sum].kind.clone() else { continue };
                let Some(at) = terms.iter().position(|t| t.1 == term) else { continue };
                let unit = unit(terms[at].0);
                terms[at] = if term == factor {
                    (unit, multiple)
                } else {
                    let Kind::Product(mut factors) = dag.nodes[term].kind.clone() else { continue };
                    let Some(position) = factors.iter().position(|&f| f == factor) else { continue };
                    factors[position] = multiple;
                    // A multiple of a product that stands alone has this very value: it becomes the product.
                    if terms.len() == 1 && unit.is_one() {
                        factors.sort_unstable();
                        changed |= dag.rewrite(sum, Kind::Product(factors));
                        continue;
                    }
                    let (sign, product) = dag.product(factors);
                    (unit * sign, product)
                };
                terms.sort_by_key(|t| t.1);
                if terms.windows(2).all(|pair| pair[0].1 != pair[1].1) {
                    changed |= dag.rewrite(sum, Kind::Sum(terms));
                }
            }
            Occurrence::Term(..) => {}
        }
    }
    changed
}
