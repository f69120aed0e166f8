//! Stage `solve`: which unknown is found when, and from which equation.
//!
//! In: cycles with unknowns in common. Out: [`Step`]s. An equation without a choice of sign goes before one with it, then the one
//! whose solution costs less; slides and turns are sought together where no unknown stands in an equation alone. All this happens in small
//! graphs of its own: a graph keeps the form in which a value was derived first, and most equations are derived only to be left
//! aside.

use std::collections::{HashMap, HashSet};

use crate::contracts::cost::Cost;
use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::evaluate::Evaluator;
use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, SymbolId, Vector};
use crate::symbolic::lower::Lowering;
use crate::symbolic::sized::WithSizes;

use super::chain::Link;
use super::orientation::{Found, Orientation};
use super::pairs::Candidate;
use super::primitives::{Known, Primitive};
use super::system::{Cycle, System, Unknown};
use super::translation::{self, Translation};
use super::{Failure, Solved, Value};

/// What is found next.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// One unknown from an equation of one cycle.
    Coordinate {
        cycle: usize,
        unknown: usize,
        candidate: Candidate,
        /// Something wanted depends on it.
        needed: bool,
    },
    /// What three unknowns turn by together: a new cycle, from which they follow.
    Orientation(Orientation),
    /// Two or three slides.
    Translation(Translation),
}

/// Most candidates for one unknown whose solutions are made to be counted.
const SHORTLIST: usize = 4;
/// Most orders of the unknowns that are compared.
const ORDERS: usize = 8;

/// Cycles in a graph that holds nothing else, and what has been solved of them.
#[derive(Clone)]
struct Bench {
    g: Graph,
    system: System,
    done: Vec<Done>,
}

/// A step, with what it led to.
#[derive(Clone)]
enum Done {
    Coordinate { cycle: usize, unknown: usize, candidate: Candidate, primitive: Primitive, solved: Solved },
    Orientation(Orientation, Found),
    Translation(Translation, translation::Found),
}

/// What may come next.
#[derive(Clone, Copy)]
enum Next {
    Coordinate { cycle: usize, unknown: usize, candidate: Candidate },
    Orientation(Orientation),
    Translation(Translation),
}

/// Values of all symbols: a place where the equations have to tell the unknowns.
pub(super) type Point<'p> = &'p dyn Fn(SymbolId) -> f64;

/// The order in which all wanted unknowns are found. Equations that say nothing at any of the points, if there are some,
/// are left aside: a coefficient may be zero in value only, that of a parameter or of an inexact literal.
pub(super) fn plan(g: &mut Graph, system: &System, points: &[Point<'_>]) -> Result<Vec<Step>, Failure> {
    let mut search = Search { points, orders: 0, best: None, furthest: None };
    search.extend(Bench::new(g, system));
    match (search.best, search.furthest) {
        (Some((_, bench)), _) => Ok(bench.steps()),
        (None, Some(bench)) => {
            let remaining = bench.open_unknowns(true).map(|k| system.unknowns[k].symbol).collect();
            Err(Failure::NotFound { remaining, solved: bench.solved().count(), cycles: system.cycles.len() })
        }
        (None, None) => Ok(Vec::new()),
    }
}

/// The same order and the same equations for other cycles; nothing where an equation has another form, or where other
/// unknowns are needed.
pub(super) fn adapt(g: &mut Graph, system: &System, steps: &[Step]) -> Option<Vec<Step>> {
    let mut bench = Bench::new(g, system);
    for step in steps {
        match step {
            &Step::Coordinate { cycle, unknown: number, candidate, .. } => {
                let unknown = bench.system.unknowns.get(number)?;
                let same = bench.open_unknowns(unknown.wanted).any(|k| k == number)
                    && bench.system.cycles_with(number).any(|other| other == cycle);
                if !same {
                    return None;
                }
                bench.take(Next::Coordinate { cycle, unknown: number, candidate })?;
                let Some(Done::Coordinate { candidate, primitive, .. }) = bench.done.last_mut() else { return None };
                if primitive.describe() != candidate.primitive.describe() {
                    return None;
                }
                candidate.primitive = *primitive;
            }
            Step::Orientation(orientation) => {
                let mut scratch = bench.g.clone();
                let own = orientation.ordered(&mut scratch, &bench.system)?;
                bench.take(Next::Orientation(own))?;
            }
            &Step::Translation(translation) => bench.take(Next::Translation(translation))?,
        }
    }
    let complete = bench.open_unknowns(true).next().is_none();
    let adapted = bench.steps();
    let needed = |step: &Step| !matches!(step, Step::Coordinate { needed: false, .. });
    let same = adapted.iter().zip(steps).all(|(a, b)| needed(a) == needed(b));
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
            list if list.is_empty() => match bench.options(false, self.points) {
                list if list.is_empty() => match bench.translations(self.points) {
                    list if list.is_empty() => bench.orientations(self.points),
                    list => list,
                },
                list => list,
            },
            list => list,
        };
        if options.is_empty() {
            self.orders += 1;
            if self.furthest.as_ref().is_none_or(|other| other.solved().count() < bench.solved().count()) {
                self.furthest = Some(bench);
            }
            return;
        }
        for option in options {
            if self.orders >= ORDERS {
                return;
            }
            let mut next = bench.clone();
            if next.take(option).is_some() {
                self.extend(next);
            }
        }
    }
}

impl Bench {
    fn new(g: &mut Graph, system: &System) -> Bench {
        let mut scalars = Vec::new();
        let offsets: Vec<Vec<[Scalar; 3]>> = system
            .cycles
            .iter()
            .map(|cycle| {
                let components = cycle.links.iter().map(|link| match *link {
                    Link::Known { rotation, offset } => {
                        gather(g, rotation, &mut scalars);
                        g.components(offset)
                    }
                    Link::Free { motion: Motion::Screw(_, pitch), .. } => {
                        scalars.push(pitch);
                        [Scalar::ZERO; 3]
                    }
                    Link::Free { .. } => [Scalar::ZERO; 3],
                });
                components.collect()
            })
            .collect();
        scalars.extend(offsets.iter().flatten().flatten());
        scalars.extend(system.unknowns.iter().map(|u| u.symbol));
        scalars.extend(system.cycles.iter().filter_map(|cycle| cycle.winding));
        let mut lowering = Lowering::new(g);
        let lowered = lowering.run(&scalars);
        let mut copy = Copy { from: g, to: lowering.to, map: HashMap::new() };
        let pairs = scalars.iter().zip(&lowered).map(|(s, l)| (s.index(), if s.is_negative() { -*l } else { *l }));
        copy.map = pairs.collect();
        let cycles = system.cycles.iter().zip(offsets).map(|(cycle, offsets)| {
            let links = cycle.links.iter().zip(offsets).map(|(link, offset)| match *link {
                Link::Known { rotation, .. } => {
                    Link::Known { rotation: copy.rotation(rotation), offset: copy.vector(offset) }
                }
                Link::Free { motion, unknown } => Link::Free { motion: copy.motion(motion), unknown },
            });
            let links = links.collect();
            Cycle { links, winding: cycle.winding.map(|sum| copy.scalar(sum)) }
        });
        let cycles = cycles.collect();
        let unknowns = system
            .unknowns
            .iter()
            .map(|u| Unknown { motion: copy.motion(u.motion), symbol: copy.scalar(u.symbol), wanted: u.wanted })
            .collect();
        Bench { g: copy.to, system: System { cycles, unknowns, known: Known::default() }, done: Vec::new() }
    }

    /// Unknowns that are solved, by number.
    fn solved(&self) -> impl Iterator<Item = usize> {
        self.done.iter().flat_map(|done| match done {
            Done::Coordinate { unknown, .. } => vec![*unknown],
            Done::Orientation(..) => Vec::new(),
            Done::Translation(translation, _) => translation.unknowns.list(),
        })
    }

    /// Numbers of what isn't solved.
    fn open_unknowns(&self, wanted: bool) -> impl Iterator<Item = usize> {
        let unknowns = &self.system.unknowns;
        let open = move |k: &usize| {
            let is_open = !self.solved().any(|number| number == *k);
            is_open && unknowns[*k].wanted == wanted && !matches!(unknowns[*k].motion, Motion::Ball(_))
        };
        (0..unknowns.len()).filter(open)
    }

    /// The best equation in each of the unknowns that are still open, as far as they need the fewest signs.
    fn options(&self, wanted: bool, points: &[Point<'_>]) -> Vec<Next> {
        let mut scratch = self.g.clone();
        // Signs, a first estimate of the work, the unknown.
        let mut list: Vec<(usize, usize, usize, Next)> = Vec::new();
        for unknown in self.open_unknowns(wanted) {
            for cycle in self.system.cycles_with(unknown) {
                let rest = self.system.rest(cycle, unknown);
                let mut candidates = self.system.opened(&mut scratch, cycle, unknown, &rest).candidates(&mut scratch);
                candidates.retain(|candidate| points.is_empty() || tells(&scratch, &candidate.primitive, points));
                list.extend(candidates.into_iter().map(|candidate| {
                    let effort = effort(&scratch, &candidate.primitive.coefficients());
                    (candidate.primitive.signs(), effort, unknown, Next::Coordinate { cycle, unknown, candidate })
                }));
            }
        }
        let least = list.iter().map(|(rank, ..)| *rank).min().unwrap_or(0);
        list.retain(|(rank, ..)| *rank == least);
        list.sort_by_key(|(_, effort, ..)| *effort);
        let mut options: Vec<(u32, Next)> = Vec::new();
        for number in self.open_unknowns(wanted) {
            let mine = list.iter().filter(|(_, _, k, _)| *k == number).take(SHORTLIST);
            let priced = mine.map(|&(.., next)| (self.price(next), next));
            options.extend(priced.min_by_key(|(price, _)| *price));
        }
        options.sort_by_key(|(price, _)| *price);
        options.into_iter().map(|(_, next)| next).collect()
    }

    /// The best orientation of each three unknowns that are still open.
    fn orientations(&self, points: &[Point<'_>]) -> Vec<Next> {
        let mut scratch = self.g.clone();
        let mut list: Vec<(usize, [usize; 3], Next)> = Vec::new();
        // What is known already would be found from itself.
        let oriented: Vec<[usize; 3]> = self
            .done
            .iter()
            .filter_map(|done| match done {
                Done::Coordinate { .. } | Done::Translation(..) => None,
                Done::Orientation(orientation, _) => {
                    let mut unknowns = orientation.unknowns;
                    unknowns.sort_unstable();
                    Some(unknowns)
                }
            })
            .collect();
        for orientation in Orientation::candidates(&mut scratch, &self.system) {
            let Some(leading) = orientation.leading(&mut scratch, &self.system) else { continue };
            let told = |point: &Point<'_>| leading.iter().all(|&s| is_told(&scratch, &[s], *point));
            if !points.is_empty() && !points.iter().any(told) {
                continue;
            }
            let mut unknowns = orientation.unknowns;
            unknowns.sort_unstable();
            if oriented.contains(&unknowns) {
                continue;
            }
            list.push((effort(&scratch, &leading), unknowns, Next::Orientation(orientation)));
        }
        self.best(list)
    }

    /// The best way to find slides together, three at once before two.
    fn translations(&self, points: &[Point<'_>]) -> Vec<Next> {
        let mut scratch = self.g.clone();
        let mut list: Vec<(usize, Vec<usize>, Next)> = Vec::new();
        for translation in Translation::candidates(&mut scratch, &self.system) {
            let Some(leading) = translation.leading(&mut scratch, &self.system) else { continue };
            let told = |point: &Point<'_>| leading.iter().all(|&s| is_told(&scratch, &[s], *point));
            if !points.is_empty() && !points.iter().any(told) {
                continue;
            }
            let effort = effort(&scratch, &leading);
            list.push((effort, translation.unknowns.list(), Next::Translation(translation)));
        }
        self.best(list)
    }

    /// The best of each set of unknowns, by the work and a first estimate of it.
    fn best<U: Ord + Clone>(&self, mut list: Vec<(usize, U, Next)>) -> Vec<Next> {
        list.sort_by_key(|(effort, ..)| *effort);
        let mut sets: Vec<U> = list.iter().map(|(_, unknowns, _)| unknowns.clone()).collect();
        sets.sort_unstable();
        sets.dedup();
        let best = sets.into_iter().filter_map(|set| {
            let mine = list.iter().filter(|(_, unknowns, _)| *unknowns == set).take(SHORTLIST);
            mine.map(|&(.., next)| (self.price(next), next)).min_by_key(|(price, _)| *price)
        });
        let mut options: Vec<(u32, Next)> = best.collect();
        options.sort_by_key(|(price, _)| *price);
        options.into_iter().map(|(_, next)| next).collect()
    }

    /// What the solution costs in this place.
    fn price(&self, next: Next) -> u32 {
        let mut bench = self.clone();
        if bench.take(next).is_none() {
            return u32::MAX;
        }
        let roots = match bench.done.last() {
            Some(Done::Coordinate { solved, .. }) => results(solved),
            Some(Done::Orientation(_, found)) => found.rows.concat(),
            Some(Done::Translation(_, found)) => found.solved.iter().flat_map(results).collect(),
            None => Vec::new(),
        };
        price(&bench.g, &roots)
    }

    /// Takes one step. The equation is derived anew, in this graph.
    fn take(&mut self, next: Next) -> Option<()> {
        let (g, system) = (&mut self.g, &mut self.system);
        match next {
            Next::Coordinate { cycle, unknown, candidate } => {
                let rest = system.rest(cycle, unknown);
                let symbol = system.unknowns[unknown].symbol;
                let primitive = system.opened(g, cycle, unknown, &rest).derive(g, candidate.source)?;
                let solved = primitive.solve(g, symbol, Scalar::ONE, &mut system.known, String::new());
                system.settle(g, unknown);
                self.done.push(Done::Coordinate { cycle, unknown, candidate, primitive, solved });
            }
            Next::Orientation(orientation) => {
                let found = orientation.solve(g, system, Scalar::ONE)?;
                self.done.push(Done::Orientation(orientation, found));
            }
            Next::Translation(translation) => {
                let found = translation.solve(g, system, Scalar::ONE)?;
                translation.unknowns.list().into_iter().for_each(|number| system.settle(g, number));
                self.done.push(Done::Translation(translation, found));
            }
        }
        Some(())
    }

    /// Signs and operations of all that is needed.
    fn total(&mut self) -> (usize, u32) {
        let needed = self.needed();
        let (mut map, mut roots, mut signs) = (HashMap::new(), Vec::new(), 0);
        for (done, needed) in self.done.iter().zip(needed) {
            let (all, own) = match done {
                Done::Coordinate { primitive, solved, .. } if needed => {
                    (std::slice::from_ref(solved), primitive.signs())
                }
                Done::Coordinate { .. } => continue,
                Done::Orientation(..) => (&[][..], 1),
                Done::Translation(_, found) => (&found.solved[..], 1),
            };
            signs += own;
            for solved in all {
                let list = self.g.substitute(&results(solved), &map);
                let value = match solved.value {
                    Value::Angle { .. } => self.g.angle(list[0], list[1]),
                    Value::Length(_) => list[0],
                };
                roots.extend(list);
                map.extend(self.g.symbol_id(solved.symbol).map(|id| (id, value)));
            }
        }
        (signs, price(&self.g, &roots))
    }

    /// What is wanted, or something wanted depends on.
    fn needed(&mut self) -> Vec<bool> {
        let mut reached = HashSet::new();
        let mut needed: Vec<bool> = Vec::with_capacity(self.done.len());
        for done in self.done.iter().rev() {
            let (is_needed, read) = match done {
                Done::Coordinate { unknown, primitive, solved, .. } => {
                    let is_read = reached.contains(&solved.symbol.index());
                    (self.system.unknowns[*unknown].wanted || is_read, primitive.coefficients())
                }
                // What is found together is wanted.
                Done::Orientation(_, found) => (true, found.coefficients(&mut self.g)),
                Done::Translation(_, found) => (true, found.coefficients.clone()),
            };
            if is_needed {
                reached.extend(self.g.reachable_scalars(&read));
            }
            needed.push(is_needed);
        }
        needed.reverse();
        needed
    }

    fn steps(mut self) -> Vec<Step> {
        let needed = self.needed();
        let steps = self.done.into_iter().zip(needed).map(|(done, needed)| match done {
            Done::Coordinate { cycle, unknown, candidate, .. } => {
                Step::Coordinate { cycle, unknown, candidate, needed }
            }
            Done::Orientation(orientation, _) => Step::Orientation(orientation),
            Done::Translation(translation, _) => Step::Translation(translation),
        });
        steps.collect()
    }
}

/// Value and inverse slopes.
fn results(solved: &Solved) -> Vec<Scalar> {
    let mut list = match solved.value {
        Value::Angle { cos, sin } => vec![cos, sin],
        Value::Length(x) => vec![x],
    };
    list.extend(solved.balances.iter().map(|balance| balance.inverse_slope));
    list
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
    points.iter().any(|point| is_told(g, &leading, *point))
}

/// Whether one of these is more than rounding.
fn is_told(g: &Graph, leading: &[Scalar], symbols: Point<'_>) -> bool {
    let values = Evaluator::new(g, WithSizes { symbols }).run(leading);
    values.iter().any(|value| !value.is_rounding())
}

/// A first estimate of the work that a solution takes.
fn effort(g: &Graph, coefficients: &[Scalar]) -> usize {
    let weight = |s: Scalar| match g.literal(s) {
        Some(n) if n.is_zero() => 0,
        Some(_) => 1,
        None => 4 + g.reachable_scalars(&[s]).len(),
    };
    coefficients.iter().copied().map(weight).sum()
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
