//! Stage `solve`: closed-form solutions of loops by the characteristic pair of joints.
//!
//! In: a cycle of known and unknown motions that composes to the identity. Out: for every wanted unknown its value in
//! terms of what is known and of unknowns solved before it, with an equation and its slope, from which rates and
//! accelerations follow by implicit differentiation.
//!
//! The procedure is one for all loops (Woernle 1988; Hiller and Woernle 1987; Modelica's joint assemblies): `pairs`
//! takes two groups of neighbouring joints out of the cycle and measures between them what they leave free. Where one
//! unknown remains, `primitives` solves it; then it counts as known, and the rest follows triangularly.

mod chain;
mod elements;
mod measures;
mod pairs;
mod plan;
mod primitives;

use std::fmt;

use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};

use chain::Link;
use pairs::{Opened, Winding};
use plan::Step;
use primitives::Known;

pub use primitives::{circular, quadratic, three_spheres};

/// One element of a cycle: the next frame in the present one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// The child frame in the parent's: known or constant.
    Fixed { rotation: Rotation, offset: Vector },
    /// A motion about or along a coordinate axis of the present frame. `symbol` stands for its coordinate. Of a ball
    /// nothing can be found; it has no symbol that is used.
    Unknown { motion: Motion, symbol: Scalar, wanted: bool },
}

/// Once around a loop.
#[derive(Clone, Debug, Default)]
pub struct KinematicLoop {
    pub segments: Vec<Segment>,
    /// Vanishes: a sum of the cycle's angles, each once, and of what is known, whole turns included. There where a screw
    /// makes turns count and everything turns about one direction. Points and directions know angles up to whole turns.
    pub winding: Option<Scalar>,
}

/// A coordinate that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// An angle by its point on the circle.
    Angle { cos: Scalar, sin: Scalar },
    /// A travel, or the angle of a screw.
    Length(Scalar),
}

/// One unknown with its solution.
#[derive(Clone, Debug)]
pub struct Solved {
    pub symbol: Scalar,
    pub value: Value,
    /// Vanishes at the solution; in terms of knowns, of unknowns solved before and of this one.
    pub equation: Scalar,
    /// One over the derivative of the equation by the symbol.
    pub inverse_slope: Scalar,
    /// Where the equation comes from and how it was solved.
    pub how: String,
    /// Where this vanishes two solutions meet: a dead centre.
    pub root: Option<Scalar>,
    /// What it was found from, with a word for each.
    pub parts: Vec<(&'static str, Scalar)>,
}

/// All that was asked for, in the order in which it follows.
#[derive(Clone, Debug)]
pub struct Solution {
    pub solved: Vec<Solved>,
    /// Number of signs that are free to choose.
    pub signs: usize,
}

/// Why there is no closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// Symbols of the wanted unknowns that no equation has alone.
    NotFound { remaining: Vec<Scalar>, solved: usize },
    /// The coordinates of a ball were asked for.
    Ball,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::NotFound { remaining, solved } => write!(
                f,
                "no two joints of this loop leave an equation in one unknown alone: {} found, {} remain",
                solved,
                remaining.len()
            ),
            Failure::Ball => write!(f, "the orientation of a ball joint is not solved for in closed form"),
        }
    }
}

/// An unknown as the procedure sees it.
#[derive(Clone, Copy)]
struct Unknown {
    motion: Motion,
    symbol: Scalar,
    wanted: bool,
}

/// Which unknown is found when, and from which equation: what has been decided about a loop, whatever graph it is then
/// derived on.
#[derive(Clone, Debug)]
pub struct Plan {
    steps: Vec<Step>,
}

/// Solves for the wanted unknowns. `signs` are taken in order wherever there are two solutions, `true` for the positive
/// root; those that are missing are positive.
pub fn solve(g: &mut Graph, cycle: &KinematicLoop, signs: &[bool]) -> Result<Solution, Failure> {
    Plan::new(g, cycle)?.solve(g, cycle, &of_signs(signs))
}

/// Constant signs, as a solution takes them.
pub fn of_signs(signs: &[bool]) -> Vec<Scalar> {
    signs.iter().map(|&positive| if positive { Scalar::ONE } else { -Scalar::ONE }).collect()
}

impl Plan {
    /// Decides how a cycle is solved. It depends on the cycle alone, not on what else the graph holds.
    pub fn new(g: &Graph, cycle: &KinematicLoop) -> Result<Plan, Failure> {
        Plan::at(g, cycle, &[])
    }

    /// The same from equations alone that tell their unknown at one of these points at least, given as values of symbols.
    pub fn at(g: &Graph, cycle: &KinematicLoop, points: &[&dyn Fn(SymbolId) -> f64]) -> Result<Plan, Failure> {
        let (links, unknowns) = opened(cycle);
        if unknowns.iter().any(|u| u.wanted && matches!(u.motion, Motion::Ball(_))) {
            return Err(Failure::Ball);
        }
        let steps = plan::plan(&mut g.clone(), &links, &unknowns, cycle.winding, points)?;
        Ok(Plan { steps })
    }

    /// The same plan for a cycle like the one that was planned, if every step of it finds an equation of the same form
    /// there. That costs a small part of the search.
    pub fn adapted(&self, g: &Graph, cycle: &KinematicLoop) -> Option<Plan> {
        let (links, unknowns) = opened(cycle);
        let steps = plan::adapt(&mut g.clone(), &links, &unknowns, cycle.winding, &self.steps)?;
        Some(Plan { steps })
    }

    /// Solves the cycle that was planned. `signs` are one or minus one, or what is so at run time; roots beyond them are positive.
    pub fn solve(&self, g: &mut Graph, cycle: &KinematicLoop, signs: &[Scalar]) -> Result<Solution, Failure> {
        let (mut links, unknowns) = opened(cycle);
        let (mut known, mut solved, mut choices) = (Known::default(), Vec::with_capacity(self.steps.len()), 0);
        for &Step { unknown: number, candidate, needed } in &self.steps {
            let unknown = &unknowns[number];
            if needed {
                let rest = open(&links, number);
                let winding = winding_of(g, cycle.winding, &unknowns, &links, number);
                let opened = Opened { motion: unknown.motion, rest: &rest, winding };
                let Some(primitive) = opened.derive(g, candidate.source) else {
                    return Err(Failure::NotFound { remaining: vec![unknown.symbol], solved: solved.len() });
                };
                let sign = signs.get(choices).copied().unwrap_or(Scalar::ONE);
                choices += primitive.signs();
                solved.push(primitive.solve(g, unknown.symbol, sign, &mut known, candidate.describe()));
            }
            settle(g, &mut links, unknown, number);
        }
        Ok(Solution { solved, signs: choices })
    }
}

/// A cycle as the procedure sees it.
fn opened(cycle: &KinematicLoop) -> (Vec<Link>, Vec<Unknown>) {
    let mut unknowns = Vec::new();
    let links = cycle.segments.iter().map(|&segment| link(segment, &mut unknowns)).collect();
    (links, unknowns)
}

/// A solved unknown is known from here on.
fn settle(g: &mut Graph, links: &mut [Link], unknown: &Unknown, number: usize) {
    for link in links {
        if matches!(link, Link::Free { unknown, .. } if *unknown == number) {
            *link = Link::moved(g, unknown.motion, unknown.symbol);
        }
    }
}

/// What the sum of angles says about one unknown: its slope and the rest; the rest may hold no other open unknown.
fn winding_of(
    g: &mut Graph,
    winding: Option<Scalar>,
    unknowns: &[Unknown],
    links: &[Link],
    number: usize,
) -> Option<Winding> {
    let (sum, symbol) = (winding?, unknowns[number].symbol);
    if !g.depends_on(sum, &[symbol]) {
        return None;
    }
    let open = |k: usize| links.iter().any(|link| matches!(link, Link::Free { unknown, .. } if *unknown == k));
    let others = unknowns.iter().enumerate().filter(|&(k, _)| k != number && open(k)).map(|(_, other)| other.symbol);
    let others: Vec<Scalar> = others.collect();
    if g.depends_on(sum, &others) {
        return Some(Winding::Open);
    }
    let slope = g.derivative(sum, &[(symbol, Scalar::ONE)]);
    // With the unknown at zero, and not by a difference in which it would stand and cancel.
    let still = g.symbol_id(symbol).map(|id| (id, Scalar::ZERO)).into_iter().collect();
    Some(Winding::Known { slope, rest: g.substitute(&[sum], &still)[0] })
}

/// The cycle without one unknown, from its right side round to its left.
fn open(links: &[Link], number: usize) -> Vec<Link> {
    let at = links.iter().position(|link| matches!(link, Link::Free { unknown, .. } if *unknown == number));
    let at = at.or_fault("an open unknown stands in its cycle");
    links[at + 1..].iter().chain(&links[..at]).copied().collect()
}

fn link(segment: Segment, unknowns: &mut Vec<Unknown>) -> Link {
    match segment {
        Segment::Fixed { rotation, offset } => Link::Known { rotation, offset },
        Segment::Unknown { motion, symbol, wanted } => {
            unknowns.push(Unknown { motion, symbol, wanted });
            Link::Free { motion, unknown: unknowns.len() - 1 }
        }
    }
}
