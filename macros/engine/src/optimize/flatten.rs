//! Stage `optimize`, pass: sums within sums and products within products.
//!
//! In: a DAG. Out: the same with every sum that one other sum uses alone dissolved in it, and products likewise; what is
//! shared stays a node. Parameter parts stay together.

use std::ops::Mul;

use crate::invariant::injection::{Break, broken};

use super::dag::{Dag, Kind};
use super::stage::Stage;

pub fn flatten(dag: &mut Dag) {
    let order = dag.order();
    let uses = dag.uses(&order);
    for id in order {
        let late = dag.nodes[id].stage > Stage::Parameter;
        let keeps = |dag: &Dag, inner: usize| late && dag.nodes[inner].stage <= Stage::Parameter;
        match &dag.nodes[id].kind {
            Kind::Sum(terms) => {
                let mut flat = Vec::with_capacity(terms.len());
                for &(c, term) in terms {
                    match &dag.nodes[term].kind {
                        Kind::Sum(inner)
                            if inner.len() == 1 && (uses[term] == 1 || !c.is_unit() || inner[0].0.is_unit()) =>
                        {
                            flat.push((c.mul(inner[0].0), inner[0].1));
                        }
                        Kind::Sum(inner) if uses[term] == 1 && c.is_unit() && !keeps(dag, term) => {
                            let dropped = usize::from(broken(Break::FlattenedTerm));
                            flat.extend(inner.iter().skip(dropped).map(|&(d, t)| (c.mul(d), t)));
                        }
                        _ => flat.push((c, term)),
                    }
                }
                let flat = dag.normal_terms(flat);
                dag.dissolve(id, Kind::Sum(flat));
            }
            Kind::Product(factors) => {
                let mut flat = Vec::with_capacity(factors.len());
                for &factor in factors {
                    let factor = same(dag, factor);
                    match &dag.nodes[factor].kind {
                        Kind::Product(inner) if uses[factor] == 1 && !keeps(dag, factor) => {
                            flat.extend(inner.iter().copied())
                        }
                        _ => flat.push(factor),
                    }
                }
                flat.sort_unstable();
                dag.dissolve(id, Kind::Product(flat));
            }
            _ => {}
        }
    }
}

/// The node behind one that is only another name for it.
fn same(dag: &Dag, mut id: usize) -> usize {
    while let Kind::Sum(terms) = &dag.nodes[id].kind {
        match terms[..] {
            [(c, inner)] if c.is_one() => id = inner,
            _ => break,
        }
    }
    id
}
