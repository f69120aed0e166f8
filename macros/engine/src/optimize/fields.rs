//! Stage `optimize`: what `Model::new` computes.
//!
//! In: the optimised DAGs of all functions. Out: one DAG with every value that depends on parameters alone and is read by
//! later work or returned, each once, and its field by print. A reciprocal of a parameter is computed there as well.

use std::collections::HashMap;

use crate::symbolic::number::Number;

use super::dag::{Dag, Id, ONE, operands};
use super::program::{FieldId, Symbol};
use super::schedule::Fields;
use super::stage::Stage;

/// Gathers the fields; the roots of the result are their values in order.
pub fn gather(functions: &[&Dag], symbols: &[Symbol]) -> (Dag, Fields) {
    let mut prelude = Dag::new(symbols);
    let mut fields = Fields::new();
    for &dag in functions {
        let mut map = HashMap::new();
        for id in frontier(dag) {
            let print = dag.nodes[id].print.canonical();
            if fields.contains_key(&print) {
                continue;
            }
            fields.insert(print, FieldId(prelude.roots.len()));
            let (c, adopted) = prelude.adopt(dag, id, &mut map);
            let sign = if print == dag.nodes[id].print { Number::ONE } else { Number::ONE.neg() };
            prelude.roots.push((c.mul(sign), adopted));
        }
    }
    (prelude, fields)
}

/// Early values that later ones or the results read.
fn frontier(dag: &Dag) -> Vec<Id> {
    let early = |id: Id| id != ONE && dag.nodes[id].stage <= Stage::Parameter;
    let mut found: Vec<Id> = Vec::new();
    for id in dag.order() {
        if dag.nodes[id].stage > Stage::Parameter {
            found.extend(operands(&dag.nodes[id].kind).filter(|&operand| early(operand)));
        }
    }
    found.extend(dag.roots.iter().map(|root| root.1).filter(|&id| early(id)));
    let mut seen = vec![false; dag.nodes.len()];
    found.retain(|&id| !std::mem::replace(&mut seen[id], true));
    found
}
