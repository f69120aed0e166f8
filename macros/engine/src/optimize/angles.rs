//! Stage `optimize`, pass: sines and cosines of sums of angles.
//!
//! In: a DAG. Out: where an angle is the sum or difference of two others whose sines and cosines are there anyway, the
//! addition theorems (4 products, 2 sums) in place of another sincos, which weighs 20.

use std::collections::{BTreeMap, HashMap};
use std::ops::{Mul, Neg};

use crate::symbolic::fingerprint::Print;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::stage::Stage;

/// Known angles that are tried as a part of another, for each of its units: a bound, not a rule.
const MOST_TRIED: usize = 64;

/// An angle as a combination of units.
type Combination = BTreeMap<Id, Number>;

struct Angle {
    id: Id,
    units: Combination,
    sin: Option<Id>,
    cos: Option<Id>,
}

pub fn angles(dag: &mut Dag) {
    let mut known = Known::default();
    let mut list = gather(dag);
    // Few units first, and halves before wholes, so that a double angle finds its half.
    let size = |angle: &Angle| angle.units.values().fold(0.0, |most: f64, c| most.max(c.value().abs()));
    list.sort_by(|a, b| (a.units.len().cmp(&b.units.len())).then(size(a).total_cmp(&size(b))).then(a.id.cmp(&b.id)));
    for angle in list {
        let late = dag.nodes[angle.id].stage > Stage::Parameter;
        let pair = if late { find_pair(&known, &angle.units) } else { None };
        if let Some((a, b, minus)) = pair {
            expand(dag, &angle, [&known.angles[a], &known.angles[b]], minus);
        }
        if late {
            known.push(angle);
        }
    }
}

fn gather(dag: &Dag) -> Vec<Angle> {
    let mut list: Vec<Angle> = Vec::new();
    let mut places: HashMap<Id, usize> = HashMap::new();
    for id in dag.order() {
        let (argument, is_sin) = match dag.nodes[id].kind {
            Kind::Sin(argument) => (argument, true),
            Kind::Cos(argument) => (argument, false),
            _ => continue,
        };
        let at = *places.entry(argument).or_insert(list.len());
        if at == list.len() {
            list.push(Angle { id: argument, units: units(dag, argument), sin: None, cos: None });
        }
        if is_sin {
            list[at].sin = Some(id);
        } else {
            list[at].cos = Some(id);
        }
    }
    list
}

fn units(dag: &Dag, id: Id) -> Combination {
    let mut combination = BTreeMap::new();
    let mut stack = vec![(Number::ONE, id)];
    while let Some((factor, id)) = stack.pop() {
        match &dag.nodes[id].kind {
            Kind::Sum(terms) => stack.extend(terms.iter().map(|&(c, t)| (c * factor, t))),
            _ => {
                let entry = combination.entry(id).or_insert(Number::ZERO);
                *entry = *entry + factor;
            }
        }
    }
    combination.retain(|_, c| !c.is_zero());
    combination
}

/// Two known angles whose sum (or difference, first minus second) this is. The first shares a unit with it; the second is
/// then looked up.
fn find_pair(known: &Known, units: &Combination) -> Option<(usize, usize, bool)> {
    let mut tried = Vec::new();
    for unit in units.keys() {
        for &a in known.by_unit.get(unit).into_iter().flatten().rev().take(MOST_TRIED) {
            if tried.contains(&a) {
                continue;
            }
            tried.push(a);
            let first = &known.angles[a].units;
            if let Some(b) = known.find(&minus(units, first)) {
                return Some((a, b, false));
            }
            if let Some(b) = known.find(&minus(first, units)) {
                return Some((a, b, true));
            }
        }
    }
    None
}

fn minus(a: &Combination, b: &Combination) -> Combination {
    let mut difference = a.clone();
    for (&id, &c) in b {
        let entry = difference.entry(id).or_insert(Number::ZERO);
        *entry = *entry - c;
    }
    difference.retain(|_, c| !c.is_zero());
    difference
}

/// Angles whose sines and cosines are there.
#[derive(Default)]
struct Known {
    angles: Vec<Angle>,
    by_unit: BTreeMap<Id, Vec<usize>>,
    by_units: HashMap<Vec<(Id, Print)>, usize>,
}

impl Known {
    fn key(units: &Combination) -> Vec<(Id, Print)> {
        units.iter().map(|(&id, c)| (id, c.residue)).collect()
    }

    fn find(&self, units: &Combination) -> Option<usize> {
        self.by_units.get(&Known::key(units)).copied()
    }

    fn push(&mut self, angle: Angle) {
        let at = self.angles.len();
        for &unit in angle.units.keys() {
            self.by_unit.entry(unit).or_default().push(at);
        }
        self.by_units.entry(Known::key(&angle.units)).or_insert(at);
        self.angles.push(angle);
    }
}

fn expand(dag: &mut Dag, angle: &Angle, parts: [&Angle; 2], minus: bool) {
    let [(sa, ca), (sb, cb)] = parts.map(|part| (sine(dag, part), cosine(dag, part)));
    let sign = if minus { Number::ONE.neg() } else { Number::ONE };
    // sin(a + b) = sin a cos b + cos a sin b, cos(a + b) = cos a cos b - sin a sin b
    for (node, [x, y], [u, v], sign) in
        [(angle.sin, [sa, cb], [ca, sb], sign), (angle.cos, [ca, cb], [sa, sb], sign.neg())]
    {
        let Some(node) = node else { continue };
        let (c, first) = dag.product(vec![x, y]);
        let (d, second) = dag.product(vec![u, v]);
        let terms = dag.normal_terms(vec![(c, first), (d.mul(sign), second)]);
        if first != ONE && second != ONE {
            dag.rewrite(node, Kind::Sum(terms));
        }
    }
}

fn sine(dag: &mut Dag, angle: &Angle) -> Id {
    angle.sin.unwrap_or_else(|| dag.trigonometric(angle.id, true))
}

fn cosine(dag: &mut Dag, angle: &Angle) -> Id {
    angle.cos.unwrap_or_else(|| dag.trigonometric(angle.id, false))
}
