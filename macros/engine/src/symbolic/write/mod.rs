//! Stage `symbolic`, writing: expressions as people write them.
//!
//! In: nodes of the graph, and the names of its symbols. Out: [`Formula`]s, and equations for what is written apart; printers
//! (`mathml`, `latex`, `text`) say how these look.
//!
//! Generated code wants few operations; a reader wants few symbols. So nothing of the optimiser is used: `compose` multiplies
//! out what stays short, in sums of products of atoms (`polynomial`), where equal terms meet whatever way they came; `sines`
//! takes products of sines together by the angles of their sums; `arrange` takes common factors out again. What would grow
//! beyond a line stays whole: it gets a name and an equation of its own; `share` names what several formulas have in common. Three bounds on the number of terms are tried, and the
//! shortest text is taken.

mod arrange;
mod coefficient;
mod compose;
pub mod formula;
pub mod latex;
pub mod mathml;
mod polynomial;
pub mod share;
mod sines;
pub mod text;

use std::collections::HashSet;

use crate::contracts::call::Call;

use super::graph::{Graph, Scalar, SymbolId};
use super::lower::Lowering;

use arrange::Arranger;
use compose::Composer;
use formula::{Class, Formula, Identifier};
use polynomial::{Atom, Polynomial};

/// Most terms of a value that is multiplied out.
const BOUNDS: [usize; 3] = [64, 24, 12];
/// With more nodes than this only the last bound is tried.
const MOST_NODES_TRIED: usize = 4_000;
/// Symbols on a line: what is longer counts twice.
const LINE: usize = 60;

/// A value to be written.
pub struct Wanted {
    pub value: Scalar,
    /// Symbols whose coefficients stand together, in this order.
    pub collect: Vec<Scalar>,
}

/// What users call things.
pub struct Names<'a> {
    pub symbol: &'a dyn Fn(SymbolId) -> Identifier,
    /// Functions of their own Rust, and slopes of these.
    pub external: &'a dyn Fn(Call) -> Identifier,
}

/// Values as formulas.
#[derive(Default)]
pub struct Writing {
    /// As wanted, in this order.
    pub formulas: Vec<Formula>,
    /// What they and each other read, each before its use.
    pub definitions: Vec<Apart>,
}

/// A value with an equation of its own.
pub struct Apart {
    pub name: Identifier,
    /// What the graph calls it, if it does.
    pub label: Option<String>,
    /// The first of the wanted values that reads it.
    pub reader: usize,
    /// None where it is no formula but solved for.
    pub value: Option<Formula>,
}

/// Writes values of a graph. `taken` are names that definitions can't have.
pub fn write(graph: &Graph, wanted: &[Wanted], names: &Names<'_>, taken: &HashSet<String>) -> Writing {
    let mut lowering = Lowering::new(graph);
    let roots: Vec<Scalar> = wanted.iter().map(|wanted| wanted.value).collect();
    let roots = lowering.run(&roots);
    let lowered = &lowering.to;
    let bounds = if lowered.reachable(&roots).len() > MOST_NODES_TRIED { &BOUNDS[2..] } else { &BOUNDS[..] };
    let written = bounds.iter().map(|&most| {
        let mut composer = Composer::new(lowered, most);
        let values = composer.compose(&roots);
        finish(graph, composer, &values, wanted, names, taken)
    });
    written.min_by_key(weight).unwrap_or_default()
}

fn symbols(graph: &Graph, list: &[Scalar]) -> Vec<SymbolId> {
    list.iter().filter_map(|&s| graph.symbol_id(s)).collect()
}

/// How long it is to read.
fn weight(writing: &Writing) -> usize {
    let long = |formula: &Formula| {
        let length = formula.length();
        length + length.saturating_sub(LINE)
    };
    let apart: usize = writing.definitions.iter().map(|apart| 3 + apart.value.as_ref().map_or(0, long)).sum();
    writing.formulas.iter().map(long).sum::<usize>() + apart
}

fn finish(
    graph: &Graph,
    composer: Composer<'_>,
    values: &[Polynomial],
    wanted: &[Wanted],
    names: &Names<'_>,
    taken: &HashSet<String>,
) -> Writing {
    let Composer { mut atoms, definitions, .. } = composer;
    let mut shortened = |p: &Polynomial| {
        let mut p = sines::shortened(&mut atoms, p);
        atoms.complement(&mut p);
        p
    };
    let values: Vec<Polynomial> = values.iter().map(&mut shortened).collect();
    let apart: Vec<Option<Polynomial>> = definitions.iter().map(|d| d.value.as_ref().map(&mut shortened)).collect();
    let mut readers = vec![None; definitions.len()];
    values.iter().enumerate().for_each(|(reader, p)| mark(&atoms, p, &apart, reader, &mut readers));
    let mut taken = taken.clone();
    let defined: Vec<Identifier> = definitions
        .iter()
        .zip(&readers)
        .map(|(definition, reader)| {
            let wish = definition.name.as_deref().unwrap_or("u_1");
            let text = if reader.is_some() { vacant(wish, &mut taken) } else { wish.to_owned() };
            Identifier { text, dots: 0, index: None, class: Class::Defined, typed: false }
        })
        .collect();
    let lists: Vec<Vec<u32>> = wanted
        .iter()
        .map(|wanted| symbols(graph, &wanted.collect).into_iter().map(|id| atoms.symbol(id)).collect())
        .collect();
    let arranger = Arranger { atoms: &atoms, names, defined: &defined };
    let formulas = values.iter().zip(&lists).map(|(p, by)| arranger.collected(p, by)).collect();
    let labels = definitions.into_iter().map(|definition| definition.name);
    let told = apart.iter().zip(&defined).zip(labels).zip(readers);
    let definitions = told.filter_map(|(((value, name), label), reader)| {
        let value = value.as_ref().map(|p| arranger.formula(p));
        Some(Apart { name: name.clone(), label, reader: reader?, value })
    });
    let definitions = definitions.collect();
    Writing { formulas, definitions }
}

/// Marks definitions that a value reads, and no value before it.
fn mark(
    atoms: &polynomial::Atoms,
    p: &Polynomial,
    apart: &[Option<Polynomial>],
    reader: usize,
    readers: &mut [Option<usize>],
) {
    let mut open: Vec<&Polynomial> = vec![p];
    while let Some(p) = open.pop() {
        for &(atom, _) in p.terms.keys().flatten() {
            match atoms.get(atom) {
                Atom::Symbol(_) => {}
                Atom::Of(_, arguments) => open.extend(arguments),
                Atom::Defined(number) => {
                    if readers[*number].is_none() {
                        readers[*number] = Some(reader);
                        open.extend(&apart[*number]);
                    }
                }
            }
        }
    }
}

/// A name that nothing else has.
pub(crate) fn vacant(wish: &str, taken: &mut HashSet<String>) -> String {
    let stem = wish.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_');
    let mut name = wish.to_owned();
    let mut number = 1;
    while !taken.insert(name.clone()) {
        number += 1;
        name = format!("{stem}_{number}");
    }
    name
}
