//! Stage `optimize`: when a value is known.
//!
//! In: symbols. Out: the order literal, parameter, time, position, velocity, input, acceleration. What depends on
//! parameters alone is computed once, in `Model::new`; sums and products are split so that as much as possible does.

use std::ops::{Mul, Neg};

use crate::contracts::symbol::Symbol;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};

/// The stage of a node is the latest among its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    Literal,
    Parameter,
    Time,
    Position,
    Velocity,
    Input,
    Acceleration,
}

impl Stage {
    /// User states are known with the positions.
    pub fn of(symbol: Symbol) -> Stage {
        match symbol {
            Symbol::Param { .. } => Stage::Parameter,
            Symbol::Time => Stage::Time,
            Symbol::Position { .. }
            | Symbol::State { .. }
            | Symbol::Guess { .. }
            | Symbol::Alternative { .. }
            | Symbol::Unknown { .. }
            | Symbol::UnknownPoint { .. }
            | Symbol::Number { .. } => Stage::Position,
            Symbol::Velocity { .. } => Stage::Velocity,
            Symbol::Input { .. } | Symbol::Multiplier { .. } | Symbol::Rate { .. } => Stage::Input,
            Symbol::Impulse { .. } | Symbol::Momentum { .. } => Stage::Input,
            Symbol::Acceleration { .. } => Stage::Acceleration,
        }
    }
}

/// Makes nodes of their own of the parameter parts of later sums and products, literals drawn into them.
pub fn split(dag: &mut Dag) {
    for id in dag.order() {
        if dag.nodes[id].stage <= Stage::Parameter {
            continue;
        }
        match dag.nodes[id].kind.clone() {
            Kind::Sum(terms) => split_sum(dag, id, terms),
            Kind::Product(factors) => split_product(dag, id, factors),
            _ => {}
        }
    }
}

/// The same of what the position decides, for sums and products of which more is known later: as many operations as before, of
/// which fewer are left. `inside` are values that have no meaning outside of their iteration.
pub fn split_positions(dag: &mut Dag, inside: &[bool]) {
    let is_early = |dag: &Dag, id: Id| {
        dag.nodes[id].stage <= Stage::Position && !dag.is_mask(id) && !inside.get(id).copied().unwrap_or(false)
    };
    for id in dag.order() {
        if dag.nodes[id].stage <= Stage::Position || inside[id] {
            continue;
        }
        match dag.nodes[id].kind.clone() {
            Kind::Sum(terms) => {
                let (now, mut later): (Vec<_>, Vec<_>) = terms.into_iter().partition(|&(_, t)| is_early(dag, t));
                let scales = |&(c, t): &(Number, Id)| dag.nodes[t].stage > Stage::Parameter && !c.is_unit();
                if now.len() > 1 || now.iter().any(scales) {
                    let sum = dag.sum(now);
                    later.push(if sum.1 == ONE { sum } else { (Number::ONE, dag.plain(sum)) });
                    let list = dag.normal_terms(later);
                    dag.rewrite(id, Kind::Sum(list));
                }
            }
            Kind::Product(factors) => {
                let (now, mut later): (Vec<Id>, Vec<Id>) = factors.into_iter().partition(|&f| is_early(dag, f));
                if now.len() > 1 {
                    let product = dag.product(now);
                    later.push(dag.plain(product));
                    later.sort_unstable();
                    dag.rewrite(id, Kind::Product(later));
                }
            }
            _ => {}
        }
    }
}

fn early(dag: &Dag, id: Id) -> bool {
    dag.nodes[id].stage <= Stage::Parameter
}

fn split_sum(dag: &mut Dag, id: Id, terms: Vec<(Number, Id)>) {
    let (mut now, later): (Vec<_>, Vec<_>) = terms.into_iter().partition(|&(_, t)| early(dag, t));
    let mut list: Vec<(Number, Id)> = later.into_iter().map(|term| with_parameter(dag, term)).collect();
    if now.len() > 1 || now.iter().any(|(c, t)| *t != ONE && !c.is_unit()) {
        let sum = dag.sum(std::mem::take(&mut now));
        let plain = if sum.1 == ONE { sum } else { (Number::ONE, dag.plain(sum)) };
        list.push(plain);
    }
    list.extend(now);
    let list = dag.normal_terms(list);
    dag.rewrite(id, Kind::Sum(list));
}

/// A literal coefficient of a product with a parameter in it goes into the parameter: c (p x) = (c p) x.
fn with_parameter(dag: &mut Dag, (c, id): (Number, Id)) -> (Number, Id) {
    if c.is_unit() {
        return (c, id);
    }
    let Kind::Product(factors) = &dag.nodes[id].kind else { return (c, id) };
    let (now, mut later): (Vec<Id>, Vec<Id>) = factors.clone().into_iter().partition(|&f| early(dag, f));
    if now.is_empty() {
        return (c, id);
    }
    let (d, parameter) = dag.product(now);
    let c = c.mul(d);
    let sign = if c.is_negative() { Number::ONE.neg() } else { Number::ONE };
    later.push(dag.plain((c.abs(), parameter)));
    later.sort_unstable();
    let print = dag.factors_print(&later);
    match dag.find(print) {
        Some((found, id)) => (sign.mul(found), id),
        None => (sign, dag.push(Kind::Product(later), print)),
    }
}

fn split_product(dag: &mut Dag, id: Id, factors: Vec<Id>) {
    let (now, mut later): (Vec<Id>, Vec<Id>) = factors.into_iter().partition(|&f| early(dag, f));
    if now.len() < 2 {
        return;
    }
    let product = dag.product(now);
    later.push(dag.plain(product));
    later.sort_unstable();
    dag.rewrite(id, Kind::Product(later));
}
