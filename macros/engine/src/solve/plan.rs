//! Stage `solve`: which unknown is found when, and from which equation.
//!
//! In: the links of a cycle. Out: [`Step`]s. An equation without a choice of sign goes before one with it, then the one
//! whose solution costs less. All this happens in small graphs of its own: a graph keeps the form in which a value was
//! derived first, and most equations are derived only to be left aside.

use std::collections::{HashMap, HashSet};

use crate::contracts::cost::Cost;
use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::evaluate::Evaluator;
use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, SymbolId, Vector};
use crate::symbolic::lower::Lowering;
use crate::symbolic::sized::WithSizes;

use super::chain::Link;
use super::pairs::{Candidate, Opened};
use super::primitives::{Known, Primitive};
use super::{Failure, Solved, Unknown, Value, open, settle, winding_of};

/// One unknown, and the equation that it is found from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) unknown: usize,
    pub(super) candidate: Candidate,
    /// Something wanted depends on it.
    pub(super) needed: bool,
}

/// Most candidates for one unknown whose solutions are made to be counted.
const SHORTLIST: usize = 4;
/// Most orders of the unknowns that are compared.
const ORDERS: usize = 8;

/// Links and unknowns in a graph that holds nothing else, and what has been solved of them.
#[derive(Clone)]
struct Bench {
    g: Graph,
    links: Vec<Link>,
    unknowns: Vec<Unknown>,
    winding: Option<Scalar>,
    known: Known,
    solved: Vec<(usize, Candidate, Primitive, Solved)>,
}

/// Values of all symbols: a place where the equations have to tell the unknowns.
pub(super) type Point<'p> = &'p dyn Fn(SymbolId) -> f64;

/// The order in which all wanted unknowns are found. Equations that say nothing at any of the points, if there are some,
/// are left aside: a coefficient may be zero in value only, that of a parameter or of an inexact literal.
pub(super) fn plan(
    g: &mut Graph,
    links: &[Link],
    unknowns: &[Unknown],
    winding: Option<Scalar>,
    points: &[Point<'_>],
) -> Result<Vec<Step>, Failure> {
    let mut search = Search { points, orders: 0, best: None, furthest: None };
    search.extend(Bench::new(g, links, unknowns, winding));
    match (search.best, search.furthest) {
        (Some((_, bench)), _) => Ok(bench.steps()),
        (None, Some(bench)) => {
            let remaining = bench.open_unknowns(true).map(|k| unknowns[k].symbol).collect();
            Err(Failure::NotFound { remaining, solved: bench.solved.len() })
        }
        (None, None) => Ok(Vec::new()),
    }
}

/// The same order and the same equations for other links; nothing where an equation has another form, or where other
/// unknowns are needed.
pub(super) fn adapt(
    g: &mut Graph,
    links: &[Link],
    unknowns: &[Unknown],
    winding: Option<Scalar>,
    steps: &[Step],
) -> Option<Vec<Step>> {
    let mut bench = Bench::new(g, links, unknowns, winding);
    for step in steps {
        let unknown = bench.unknowns.get(step.unknown)?;
        let same = bench.open_unknowns(unknown.wanted).any(|k| k == step.unknown);
        bench.take(step.unknown, &step.candidate).filter(|()| same)?;
        let (_, candidate, primitive, _) = bench.solved.last_mut()?;
        if primitive.describe() != candidate.primitive.describe() {
            return None;
        }
        candidate.primitive = *primitive;
    }
    let adapted = bench.steps();
    let complete = bench.open_unknowns(true).next().is_none();
    let same = adapted.iter().zip(steps).all(|(a, b)| a.needed == b.needed);
    (complete && same).then_some(adapted)
}

/// Depth first through the orders of unknowns, the cheapest equation first.
struct Search<'p> {
    points: &'p [Point<'p>],
    orders: usize,
    /// Number of signs and operations.
    best: Option<((usize, u32), Bench)>,
    furthest: Option<Bench>,
}

impl Search<'_> {
    fn extend(&mut self, bench: Bench) {
        if bench.open_unknowns(true).next().is_none() {
            self.orders += 1;
            let mut bench = bench;
            let score = bench.total();
            if self.best.as_ref().is_none_or(|(least, _)| score < *least) {
                self.best = Some((score, bench));
            }
            return;
        }
        let options = match bench.options(true, self.points) {
            list if list.is_empty() => bench.options(false, self.points),
            list => list,
        };
        if options.is_empty() {
            self.orders += 1;
            if self.furthest.as_ref().is_none_or(|other| other.solved.len() < bench.solved.len()) {
                self.furthest = Some(bench);
            }
            return;
        }
        for (unknown, candidate) in options {
            if self.orders >= ORDERS {
                return;
            }
            let mut next = bench.clone();
            if next.take(unknown, &candidate).is_some() {
                self.extend(next);
            }
        }
    }
}

impl Bench {
    fn new(g: &mut Graph, links: &[Link], unknowns: &[Unknown], winding: Option<Scalar>) -> Bench {
        let mut scalars = Vec::new();
        let offsets: Vec<[Scalar; 3]> = links
            .iter()
            .map(|link| match *link {
                Link::Known { rotation, offset } => {
                    gather(g, rotation, &mut scalars);
                    g.components(offset)
                }
                Link::Free { motion: Motion::Screw(_, pitch), .. } => {
                    scalars.push(pitch);
                    [Scalar::ZERO; 3]
                }
                Link::Free { .. } => [Scalar::ZERO; 3],
            })
            .collect();
        scalars.extend(offsets.iter().flatten());
        scalars.extend(unknowns.iter().map(|u| u.symbol));
        scalars.extend(winding);
        let mut lowering = Lowering::new(g);
        let lowered = lowering.run(&scalars);
        let mut copy = Copy { from: g, to: lowering.to, map: HashMap::new() };
        let pairs = scalars.iter().zip(&lowered).map(|(s, l)| (s.index(), if s.is_negative() { -*l } else { *l }));
        copy.map = pairs.collect();
        let links = links
            .iter()
            .zip(offsets)
            .map(|(link, offset)| match *link {
                Link::Known { rotation, .. } => {
                    Link::Known { rotation: copy.rotation(rotation), offset: copy.vector(offset) }
                }
                Link::Free { motion, unknown } => Link::Free { motion: copy.motion(motion), unknown },
            })
            .collect();
        let unknowns = unknowns
            .iter()
            .map(|u| Unknown { motion: copy.motion(u.motion), symbol: copy.scalar(u.symbol), wanted: u.wanted })
            .collect::<Vec<_>>();
        let winding = winding.map(|sum| copy.scalar(sum));
        Bench { g: copy.to, links, unknowns, winding, known: Known::default(), solved: Vec::new() }
    }

    /// Numbers of what isn't solved.
    fn open_unknowns(&self, wanted: bool) -> impl Iterator<Item = usize> {
        let open = move |k: &usize| {
            let is_open = !self.solved.iter().any(|(number, ..)| number == k);
            is_open && self.unknowns[*k].wanted == wanted && !matches!(self.unknowns[*k].motion, Motion::Ball(_))
        };
        (0..self.unknowns.len()).filter(open)
    }

    /// The best equation in each of the unknowns that are still open, as far as they need the fewest signs.
    fn options(&self, wanted: bool, points: &[Point<'_>]) -> Vec<(usize, Candidate)> {
        let mut scratch = self.g.clone();
        let mut list: Vec<(usize, usize, usize, Candidate)> = Vec::new();
        for number in self.open_unknowns(wanted) {
            let unknown = &self.unknowns[number];
            let rest = open(&self.links, number);
            let winding = winding_of(&mut scratch, self.winding, &self.unknowns, &self.links, number);
            let mut candidates = Opened { motion: unknown.motion, rest: &rest, winding }.candidates(&mut scratch);
            candidates.retain(|candidate| points.is_empty() || tells(&scratch, &candidate.primitive, points));
            list.extend(
                candidates
                    .into_iter()
                    .map(|candidate| (candidate.primitive.signs(), effort(&scratch, &candidate), number, candidate)),
            );
        }
        let least = list.iter().map(|(rank, ..)| *rank).min().unwrap_or(0);
        list.retain(|(rank, ..)| *rank == least);
        list.sort_by_key(|(_, effort, ..)| *effort);
        let mut options: Vec<(u32, usize, Candidate)> = Vec::new();
        for number in self.open_unknowns(wanted) {
            let mine = list.iter().filter(|(_, _, k, _)| *k == number).take(SHORTLIST);
            let priced = mine.map(|(.., candidate)| (self.price(number, candidate), number, *candidate));
            options.extend(priced.min_by_key(|(price, ..)| *price));
        }
        options.sort_by_key(|(price, ..)| *price);
        options.into_iter().map(|(_, number, candidate)| (number, candidate)).collect()
    }

    /// What the solution costs in this place.
    fn price(&self, number: usize, candidate: &Candidate) -> u32 {
        let mut next = self.clone();
        if next.take(number, candidate).is_none() {
            return u32::MAX;
        }
        let roots = next.solved.last().map_or_else(Vec::new, |(.., solved)| results(solved));
        price(&next.g, &roots)
    }

    /// Solves for one unknown. The equation is derived anew, in this graph.
    fn take(&mut self, number: usize, candidate: &Candidate) -> Option<()> {
        let rest = open(&self.links, number);
        let unknown = self.unknowns[number];
        let winding = winding_of(&mut self.g, self.winding, &self.unknowns, &self.links, number);
        let opened = Opened { motion: unknown.motion, rest: &rest, winding };
        let primitive = opened.derive(&mut self.g, candidate.source)?;
        let solved = primitive.solve(&mut self.g, unknown.symbol, Scalar::ONE, &mut self.known, String::new());
        settle(&mut self.g, &mut self.links, &unknown, number);
        self.solved.push((number, *candidate, primitive, solved));
        Some(())
    }

    /// Signs and operations of all that is needed.
    fn total(&mut self) -> (usize, u32) {
        let needed = self.needed();
        let (mut map, mut roots, mut signs) = (HashMap::new(), Vec::new(), 0);
        for ((_, _, primitive, solved), needed) in self.solved.iter().zip(needed) {
            if !needed {
                continue;
            }
            signs += primitive.signs();
            let list = self.g.substitute(&results(solved), &map);
            let value = match list[..] {
                [cos, sin, _] => self.g.angle(cos, sin),
                _ => list[0],
            };
            roots.extend(list);
            map.extend(self.g.symbol_id(solved.symbol).map(|id| (id, value)));
        }
        (signs, price(&self.g, &roots))
    }

    /// What is wanted, or something wanted depends on.
    fn needed(&self) -> Vec<bool> {
        let mut reached = HashSet::new();
        let mut needed: Vec<bool> = Vec::with_capacity(self.solved.len());
        for (number, _, primitive, solved) in self.solved.iter().rev() {
            let is_needed = self.unknowns[*number].wanted || reached.contains(&solved.symbol.index());
            if is_needed {
                reached.extend(self.g.reachable_scalars(&primitive.coefficients()));
            }
            needed.push(is_needed);
        }
        needed.reverse();
        needed
    }

    fn steps(&self) -> Vec<Step> {
        let step = |((unknown, candidate, ..), needed): (&(usize, Candidate, Primitive, Solved), bool)| Step {
            unknown: *unknown,
            candidate: *candidate,
            needed,
        };
        self.solved.iter().zip(self.needed()).map(step).collect()
    }
}

/// Value and inverse slope.
fn results(solved: &Solved) -> Vec<Scalar> {
    match solved.value {
        Value::Angle { cos, sin } => vec![cos, sin, solved.inverse_slope],
        Value::Length(x) => vec![x, solved.inverse_slope],
    }
}

/// Weighed operations.
fn price(g: &Graph, roots: &[Scalar]) -> u32 {
    let mut lowering = Lowering::new(g);
    let lowered = lowering.run(roots);
    let Cost { add, mul, div, sqrt, sincos, compare, other } = lowering.to.cost(&lowered);
    let other = compare + other;
    // Sines and cosines are those of knowns, at hand as a rule, or placeholders.
    add + mul + sincos + 8 * (div + sqrt) + 20 * other
}

/// Whether an equation holds its unknown at one of the points, beyond rounding.
fn tells(g: &Graph, primitive: &Primitive, points: &[Point<'_>]) -> bool {
    let leading = primitive.leading();
    points.iter().any(|symbols| {
        let values = Evaluator::new(g, WithSizes { symbols }).run(&leading);
        values.iter().any(|value| !value.is_rounding())
    })
}

/// A first estimate of the work that a solution takes.
fn effort(g: &Graph, candidate: &Candidate) -> usize {
    let weight = |s: Scalar| match g.literal(s) {
        Some(n) if n.is_zero() => 0,
        Some(_) => 1,
        None => 4 + g.reachable_scalars(&[s]).len(),
    };
    candidate.primitive.coefficients().into_iter().map(weight).sum()
}

/// Scalars that a rotation is made of.
fn gather(g: &Graph, rotation: Rotation, list: &mut Vec<Scalar>) {
    match g.rotation_node(rotation) {
        RotationNode::Identity => {}
        RotationNode::Axis(_, angle) => list.push(*angle),
        RotationNode::Matrix(rows) => list.extend(rows.iter().flatten()),
        RotationNode::Quaternion(q) => list.extend(q),
        &RotationNode::Product(a, b) => {
            gather(g, a, list);
            gather(g, b, list);
        }
    }
}

/// Rotations and vectors of one graph in another, over scalars that are there.
struct Copy<'g> {
    from: &'g Graph,
    to: Graph,
    map: HashMap<usize, Scalar>,
}

impl Copy<'_> {
    fn scalar(&self, s: Scalar) -> Scalar {
        let copy = self.map.get(&s.index()).copied().or_fault("scalars of a copy are there");
        if s.is_negative() { -copy } else { copy }
    }

    fn vector(&mut self, components: [Scalar; 3]) -> Vector {
        let components = components.map(|s| self.scalar(s));
        self.to.vector(components)
    }

    fn motion(&self, motion: Motion) -> Motion {
        match motion {
            Motion::Screw(axis, pitch) => Motion::Screw(axis, self.scalar(pitch)),
            other => other,
        }
    }

    fn rotation(&mut self, r: Rotation) -> Rotation {
        let copy = match self.from.rotation_node(r).clone() {
            RotationNode::Identity => Rotation::IDENTITY,
            RotationNode::Axis(axis, angle) => {
                let angle = self.scalar(angle);
                self.to.axis_rotation(axis, angle)
            }
            RotationNode::Matrix(rows) => {
                let rows = rows.map(|row| row.map(|s| self.scalar(s)));
                self.to.matrix_rotation(rows)
            }
            RotationNode::Quaternion(q) => {
                let q = q.map(|s| self.scalar(s));
                self.to.quaternion_rotation(q)
            }
            RotationNode::Product(a, b) => {
                let (a, b) = (self.rotation(a), self.rotation(b));
                self.to.compose(a, b)
            }
        };
        if r.is_transposed() { copy.transpose() } else { copy }
    }
}
