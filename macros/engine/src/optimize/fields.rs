//! Stage `optimize`: what `Model::new` computes.
//!
//! In: the optimised DAGs of all functions. Out: one DAG with every value that depends on parameters alone and is read by
//! later work or returned, each once, and its field by print. A reciprocal of a parameter is computed there as well.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::Name;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::hints::hints;
use super::names::Names;
use super::program::{Expression, FieldId, Program};
use super::schedule::Fields;
use super::stage::Stage;
use super::wording::Wording;

/// What `Model` stores.
pub struct StoredFields {
    /// Its roots are the fields' values in order.
    pub prelude: Dag,
    pub fields: Fields,
    /// Unique, readable.
    pub names: Vec<String>,
}

impl StoredFields {
    /// Adds what a program reads of parameters that no field holds yet: parameters themselves, so that `Model::new` has
    /// nothing more to compute.
    pub fn take_parameters(&mut self, dag: &Dag) {
        let mut taken = Names::default();
        for name in &self.names {
            taken.unique(name);
        }
        let mut seen = vec![false; dag.nodes.len()];
        let mut stack: Vec<Id> = dag.roots.iter().rev().map(|root| root.1).collect();
        while let Some(id) = stack.pop() {
            let node = &dag.nodes[id];
            let print = node.print.canonical();
            // What is written with the position is not read from a field, even where all of that cancels.
            let is_stored = node.stage <= Stage::Parameter && self.fields.contains_key(&print);
            if std::mem::replace(&mut seen[id], true) || is_stored {
                continue;
            }
            if let (Kind::Symbol(symbol), Stage::Parameter) = (&node.kind, node.stage) {
                self.fields.insert(print, (FieldId(self.prelude.roots.len()), node.print));
                let adopted = self.prelude.adopt(dag, id, &mut HashMap::new());
                self.prelude.roots.push(adopted);
                self.names.push(taken.unique(&dag.symbol_name(*symbol)));
            } else {
                stack.extend(dag.operands(&node.kind));
            }
        }
    }
}

/// Gathers the fields of all functions.
pub fn gather(functions: &[&Dag], symbols: &[Symbol]) -> StoredFields {
    let mut names = Names::default();
    let mut list = Vec::new();
    let mut prelude = Dag::new(symbols);
    let mut fields = Fields::new();
    for &dag in functions {
        let mut map = HashMap::new();
        let hints = hints(dag);
        let wording = Wording::new(dag, &[]);
        for id in frontier(dag) {
            let print = dag.nodes[id].print.canonical();
            if fields.contains_key(&print) {
                continue;
            }
            fields.insert(print, (FieldId(prelude.roots.len()), dag.nodes[id].print));
            let adopted = prelude.adopt(dag, id, &mut map);
            prelude.roots.push(if broken(Break::FieldOfParameters) { (Number::ONE, ONE) } else { adopted });
            let text = name(dag, id, &hints, &wording, &mut names, "constant");
            prelude.name(adopted, &Name { text: text.clone(), stands_alone: false, is_minus: false, heading: None });
            list.push(text);
        }
    }
    StoredFields { prelude, fields, names: list }
}

/// Names of values that `Model::at` stores, none of them one of `taken`: those that they have in the program that computes them.
pub fn names_of_roots(dag: &Dag, program: &Program, taken: &[String]) -> Vec<String> {
    let mut names = Names::default();
    for name in taken {
        names.unique(name);
    }
    let (hints, wording) = (hints(dag), Wording::new(dag, taken));
    let local = |expression: &Expression| match expression {
        Expression::Local(local) => Some(program.locals[local.0].trim_start_matches('_').to_owned()),
        _ => None,
    };
    let minus = |name: String| match name.strip_prefix("minus_") {
        Some(positive) => positive.to_owned(),
        None => format!("minus_{name}"),
    };
    let each = dag.roots.iter().zip(&program.results).map(|(root, result)| {
        let known = match result {
            Expression::Neg(inner) => local(inner).map(minus),
            other => local(other),
        };
        match known {
            Some(known) => names.unique(&known),
            None => name(dag, root.1, &hints, &wording, &mut names, "value"),
        }
    });
    each.collect()
}

/// A name that is free.
fn name(
    dag: &Dag,
    id: Id,
    hints: &[Option<String>],
    wording: &Wording<'_>,
    names: &mut Names,
    otherwise: &str,
) -> String {
    let text = hint(dag, id, hints, otherwise);
    let words = if names.is_free(&text) { None } else { wording.of_node(dag, id) };
    names.unique(words.as_ref().unwrap_or(&text))
}

/// A symbol's own name, the name of the value, or that of the value which it serves.
fn hint(dag: &Dag, id: Id, hints: &[Option<String>], otherwise: &str) -> String {
    if let Kind::Symbol(symbol) = dag.nodes[id].kind {
        return dag.symbol_name(symbol);
    }
    match (&dag.nodes[id].name, &hints[id]) {
        (Some(name), _) => name.of_sign(false),
        (None, Some(served)) => format!("{served}_factor"),
        (None, None) => otherwise.to_owned(),
    }
}

/// Early values that later ones or the results read.
fn frontier(dag: &Dag) -> Vec<Id> {
    // A number that stands alone, as in `max(x, 0)`, is written where it is read.
    let epsilon = |id: Id| matches!(&dag.nodes[id].kind, Kind::Call(Call::Epsilon | Call::Nan, _));
    let number = |id: Id| match &dag.nodes[id].kind {
        Kind::Sum(terms) => terms.iter().all(|&(_, t)| t == ONE || epsilon(t)),
        _ => epsilon(id),
    };
    let early = |id: Id| id != ONE && dag.nodes[id].stage <= Stage::Parameter && !number(id);
    let mut found: Vec<Id> = Vec::new();
    // A mask is no number: it is made where it is read, of fields.
    let mut take = |id: Id| {
        let mut stack = vec![id];
        while let Some(id) = stack.pop() {
            if early(id) && dag.is_mask(id) {
                stack.extend(dag.operands(&dag.nodes[id].kind));
            } else if early(id) {
                found.push(id);
            }
        }
    };
    for id in dag.order() {
        if dag.nodes[id].stage > Stage::Parameter {
            dag.operands(&dag.nodes[id].kind).for_each(&mut take);
        }
    }
    dag.roots.iter().for_each(|root| take(root.1));
    let mut seen = vec![false; dag.nodes.len()];
    found.retain(|&id| !std::mem::replace(&mut seen[id], true));
    found
}
