//! Stage `optimize`: what `Model::at` computes.
//!
//! In: all ways to the functions that are asked for at one position, as derived and as optimised. Out: one DAG with the results
//! of all of them, and the *cut* through it: values that depend on parameters, time, positions, own states and guesses alone and
//! are read by later work, or returned. `Model::at` computes the cut once; each function goes on from there.
//!
//! The cut moves operations and adds none: what a function does behind it and what is done before it are the operations of one
//! program, in which only work on velocities, inputs and accelerations that several functions have in common stands in each of
//! them. Ways of the functions are chosen for what all of this costs together: the mass matrix in the axes in which inverse
//! dynamics turns its links anyway may be cheaper than the one that is cheapest alone.

use std::collections::{HashMap, HashSet};
use std::ops::{Mul, Range};

use crate::contracts::cost::Cost;
use crate::contracts::symbol::Symbol;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::fingerprint::Print;
use crate::symbolic::graph::{BlockKind, SymbolId};
use crate::symbolic::number::Number;

use super::common;
use super::dag::{Block, Dag, Id, Kind};
use super::stage::{self, Stage};

/// As many combinations of ways are all tried; of more, the one that is best among some is bettered function by function.
const MOST_COMBINATIONS: usize = 12;

/// Beyond so many nodes of all optimised functions no combinations are tried but the first: a bound on time.
const MOST_NODES: usize = 20_000;

/// A function that is asked for at a position: its ways, optimised each for itself.
pub(super) type Ways = Vec<Dag>;

/// All functions together.
pub(super) struct Together {
    /// The way of each function.
    pub ways: Vec<usize>,
    /// Its roots are the results of all functions, one behind the other.
    pub dag: Dag,
    /// Those of each function.
    pub results: Vec<Range<usize>>,
}

impl Together {
    /// Of these ways, their work shared where values are the same; `None` if that would change one.
    fn of(ways: Vec<usize>, functions: &[Ways], symbols: &[Symbol]) -> Option<Together> {
        let chosen: Vec<&Dag> = functions.iter().zip(&ways).map(|(dags, &way)| &dags[way]).collect();
        Together::cut_of(ways, union(&chosen, symbols), chosen.iter().map(|dag| dag.roots.len()))
    }

    /// The cheapest form of a DAG, sums and products split by what depends on the position alone.
    fn cut_of(ways: Vec<usize>, mut dag: Dag, counts: impl Iterator<Item = usize>) -> Option<Together> {
        let expected = dag.root_prints();
        let results = ranges(counts);
        let mut found = Together { ways, dag: dag.clone(), results: results.clone() };
        found.root_multiples();
        for shares in [false, true] {
            if shares {
                common::share(&mut dag);
            }
            let inside = inside_iterations(&dag);
            stage::split_positions(&mut dag, &inside);
            let mut split = Together { ways: found.ways.clone(), dag: dag.clone(), results: results.clone() };
            split.root_multiples();
            if split.dag.is_sound(&expected) && split.weight() <= found.weight() {
                found = split;
            }
        }
        found.dag.is_sound(&expected).then_some(found)
    }

    /// As they were derived, in one import: nothing is rewritten.
    pub(super) fn plain(ways: Vec<usize>, dag: Dag, counts: impl Iterator<Item = usize>) -> Together {
        let mut found = Together { ways, dag, results: ranges(counts) };
        found.root_multiples();
        found
    }

    /// A multiple of what the position decides is computed with it.
    fn root_multiples(&mut self) {
        let inside = inside_iterations(&self.dag);
        for at in 0..self.dag.roots.len() {
            let (c, id) = self.dag.roots[at];
            if !c.is_unit() && is_early(&self.dag, &inside, id) {
                self.dag.roots[at] = (Number::ONE, self.dag.plain((c, id)));
            }
        }
    }

    /// What everything costs, `Model::at` first, then each function.
    pub(super) fn costs(&self) -> Vec<Cost> {
        let (position, late) = self.parts();
        let mut late = late;
        let all = late.roots.clone();
        let functions = self.results.iter().map(|results| {
            late.roots = all[results.clone()].to_vec();
            late.cost().0
        });
        std::iter::once(position.cost().0).chain(functions).collect()
    }

    fn weight(&self) -> u32 {
        self.costs().iter().map(Cost::weight).sum()
    }

    /// What `Model::at` computes: its roots are the cut. What is left: values of the cut stand in it as [`Kind::Stored`].
    pub(super) fn parts(&self) -> (Dag, Dag) {
        let cut = self.cut();
        let (mut position, mut late) = (self.dag.clone(), self.dag.clone());
        let mut prints: HashSet<Print> = HashSet::new();
        let different = cut.iter().filter(|&&id| prints.insert(self.dag.nodes[id].print.canonical()));
        position.roots = different.map(|&id| (Number::ONE, id)).collect();
        for &id in &cut {
            late.nodes[id].kind = Kind::Stored;
        }
        (position, late)
    }

    /// Values that the position decides and that later work reads, or that are results, in the order of results.
    fn cut(&self) -> Vec<Id> {
        let dag = &self.dag;
        let inside = inside_iterations(dag);
        let uses = dag.uses(&dag.order());
        let mut seen = vec![false; dag.nodes.len()];
        let mut cut = Vec::new();
        let mut stack: Vec<(Id, bool)> = dag.roots.iter().rev().map(|root| (root.1, false)).collect();
        while let Some((id, by_product)) = stack.pop() {
            if dag.nodes[id].stage <= Stage::Parameter || std::mem::replace(&mut seen[id], true) {
                continue;
            }
            // A quotient stands with the product that divides: apart, both would be paid for.
            let divides = by_product && uses[id] == 1 && dag.is_quotient(id);
            if is_early(dag, &inside, id) && !divides {
                cut.push(id);
                continue;
            }
            let kind = &dag.nodes[id].kind;
            let is_product = matches!(kind, Kind::Product(_));
            let before = stack.len();
            stack.extend(dag.operands(kind).map(|operand| (operand, is_product)));
            stack[before..].reverse();
        }
        cut
    }
}

/// The cheapest of what was tried. `derived` imports the equations of these ways together.
pub(super) fn choose(
    functions: &[Ways],
    symbols: &[Symbol],
    mut derived: impl FnMut(&[usize]) -> Option<Dag>,
) -> Option<Together> {
    let mut best: Option<(u32, Together)> = None;
    let take = |best: &mut Option<(u32, Together)>, tried: Option<Together>| {
        let Some(tried) = tried else { return false };
        let weight = tried.weight();
        let better = best.as_ref().is_none_or(|(least, _)| weight < *least);
        if better {
            *best = Some((weight, tried));
        }
        better
    };
    let cheapest: Vec<usize> = functions.iter().map(|ways| cheapest(ways)).collect();
    take(&mut best, Together::of(cheapest.clone(), functions, symbols));
    let nodes: usize = functions.iter().flatten().map(|dag| dag.nodes.len()).sum();
    if nodes <= MOST_NODES {
        let combinations = functions.iter().fold(1_usize, |product, ways| product.saturating_mul(ways.len()));
        if combinations <= MOST_COMBINATIONS {
            for number in 0..combinations {
                take(&mut best, Together::of(combination(number, functions), functions, symbols));
            }
        } else {
            // Ways of one number are mostly those in the same axes.
            let most = functions.iter().map(Vec::len).max().unwrap_or(0);
            for way in 0..most {
                let same = functions.iter().map(|ways| way.min(ways.len() - 1)).collect();
                take(&mut best, Together::of(same, functions, symbols));
            }
            for (at, ways) in functions.iter().enumerate() {
                for way in 0..ways.len() {
                    let mut other = best.as_ref().map_or_else(|| cheapest.clone(), |(_, found)| found.ways.clone());
                    if std::mem::replace(&mut other[at], way) != way {
                        take(&mut best, Together::of(other, functions, symbols));
                    }
                }
            }
        }
    }
    // Passes may do better on all equations than on those of each function.
    let mut joint: Vec<Vec<usize>> =
        vec![best.as_ref().map_or_else(|| cheapest.clone(), |(_, found)| found.ways.clone())];
    if nodes <= MOST_NODES && joint[0] != cheapest {
        joint.push(cheapest);
    }
    for ways in joint {
        let Some(dag) = derived(&ways) else { continue };
        let counts: Vec<usize> = functions.iter().zip(&ways).map(|(dags, &way)| dags[way].roots.len()).collect();
        take(&mut best, Together::cut_of(ways, dag, counts.into_iter()));
    }
    best.map(|(_, found)| found)
}

fn cheapest(ways: &[Dag]) -> usize {
    let weights = ways.iter().map(|dag| dag.cost().0.weight());
    weights.enumerate().min_by_key(|&(number, weight)| (weight, number)).map_or(0, |(number, _)| number)
}

/// Of all combinations the one with this number.
fn combination(mut number: usize, functions: &[Ways]) -> Vec<usize> {
    let digit = |ways: &Ways| {
        let way = number % ways.len();
        number /= ways.len();
        way
    };
    functions.iter().map(digit).collect()
}

fn ranges(counts: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let mut end = 0;
    counts
        .map(|count| {
            let start = end;
            end += count;
            start..end
        })
        .collect()
}

/// All of several DAGs in one, equal values once.
fn union(dags: &[&Dag], symbols: &[Symbol]) -> Dag {
    let mut all = Dag::new(symbols);
    for dag in dags {
        let mut map = HashMap::new();
        // Operands first, so that none is fetched from far below.
        for id in dag.order() {
            let value = all.adopt(dag, id, &mut map);
            // A multiple that several places share stays one: dissolved, each of them would pay for it.
            if let Kind::Sum(terms) = &dag.nodes[id].kind
                && terms.len() == 1
            {
                map.insert(id, (Number::ONE, all.plain(value)));
            }
        }
        for &(c, id) in &dag.roots {
            let (d, adopted) = all.adopt(dag, id, &mut map);
            all.roots.push((c.mul(d), adopted));
        }
        all.symbol_names.clone_from(&dag.symbol_names);
    }
    all
}

/// Whether a value is known with the position, and a number that can be stored.
fn is_early(dag: &Dag, inside: &[bool], id: Id) -> bool {
    let stage = dag.nodes[id].stage;
    let inside = inside.get(id).copied().unwrap_or(false);
    let last = if broken(Break::EarlyVelocity) { Stage::Velocity } else { Stage::Position };
    stage > Stage::Parameter && stage <= last && !inside && !dag.is_mask(id)
}

/// Values that change in the rounds of an iteration, and have no meaning outside.
fn inside_iterations(dag: &Dag) -> Vec<bool> {
    let mut open: Vec<Vec<SymbolId>> = vec![Vec::new(); dag.nodes.len()];
    let mut blocks: Vec<Option<Vec<SymbolId>>> = vec![None; dag.blocks.len()];
    for id in dag.order() {
        open[id] = match dag.nodes[id].kind {
            Kind::Symbol(symbol) => match dag.symbols[symbol.0] {
                Symbol::Unknown { .. } | Symbol::UnknownPoint { .. } => vec![symbol],
                _ => Vec::new(),
            },
            Kind::Output { block, .. } => {
                if blocks[block].is_none() {
                    blocks[block] = Some(of_block(&dag.blocks[block], &open));
                }
                blocks[block].clone().unwrap_or_default()
            }
            _ => gathered(dag.operands(&dag.nodes[id].kind), &open),
        };
    }
    open.iter().map(|unknowns| !unknowns.is_empty()).collect()
}

/// Of an iteration what its start hangs on, and of its body what is not its own.
fn of_block(block: &Block, open: &[Vec<SymbolId>]) -> Vec<SymbolId> {
    let BlockKind::Iterate { unknowns, .. } = &block.kind else {
        return gathered(block.operands.iter().copied(), open);
    };
    let (start, body) = block.operands.split_at(unknowns.len());
    let mut found = gathered(body.iter().copied(), open);
    found.retain(|symbol| !unknowns.contains(symbol));
    for symbol in gathered(start.iter().copied(), open) {
        if !found.contains(&symbol) {
            found.push(symbol);
        }
    }
    found
}

fn gathered(operands: impl Iterator<Item = Id>, open: &[Vec<SymbolId>]) -> Vec<SymbolId> {
    let mut found: Vec<SymbolId> = Vec::new();
    for id in operands {
        for &symbol in &open[id] {
            if !found.contains(&symbol) {
                found.push(symbol);
            }
        }
    }
    found
}
