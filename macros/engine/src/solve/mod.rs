//! Stage `solve`: closed-form solutions of loops by the characteristic pair of joints.
//!
//! In: cycles of known and unknown motions that compose to the identity. Out: for every wanted unknown its value in
//! terms of what is known and of unknowns solved before it, with an equation and its slope, from which rates and
//! accelerations follow by implicit differentiation.
//!
//! The procedure is one for all loops (Woernle 1988; Hiller and Woernle 1987; Modelica's joint assemblies): `pairs`
//! takes two groups of neighbouring joints out of the cycle and measures between them what they leave free. Where one
//! unknown remains, `primitives` solves it; then it counts as known, and the rest follows triangularly. Several cycles that
//! hold unknowns in common are one system: any of them may give the next unknown. Where three turns about one point are
//! left that no equation has alone, `orientation` finds them together, and `translation` slides that follow each other.

mod chain;
mod distances;
mod elements;
mod measures;
mod orientation;
mod pairs;
pub mod placement;
mod plan;
mod primitives;
mod system;
mod translation;

use std::fmt;

use crate::dynamics::tree::Motion;
use crate::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};

use plan::Step;
use system::System;

pub use primitives::{circular, quadratic};

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

/// An equation that moves an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// Vanishes at the solution; in terms of knowns, of unknowns solved before and of those that are found with it.
    pub equation: Scalar,
    /// How far the unknown follows one unit of it: one over the derivative by the unknown, where it is found alone.
    pub inverse_slope: Scalar,
}

/// Where this vanishes two solutions meet: a dead centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    pub value: Scalar,
    /// The number of its sign.
    pub sign: usize,
}

/// One unknown with its solution.
#[derive(Clone, Debug)]
pub struct Solved {
    pub symbol: Scalar,
    pub value: Value,
    /// Its rate is minus the sum of the equations' rates, each times its inverse slope, with what is found together at rest.
    pub balances: Vec<Balance>,
    /// Symbols of all unknowns that these equations give together, this one among them.
    pub together: Vec<Scalar>,
    /// Where the equation comes from and how it was solved.
    pub how: String,
    pub roots: Vec<Root>,
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
    NotFound { remaining: Vec<Scalar>, solved: usize, cycles: usize },
    /// The coordinates of a ball were asked for.
    Ball,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::NotFound { remaining, solved, cycles } => write!(
                f,
                "no two joints of {} leave an equation in one unknown alone: {} found, {} remain",
                if *cycles > 1 { "these loops" } else { "this loop" },
                solved,
                remaining.len()
            ),
            Failure::Ball => write!(f, "the orientation of a ball joint is not solved for in closed form"),
        }
    }
}

/// Which unknown is found when, and from which equation: what has been decided about a loop, whatever graph it is then
/// derived on.
#[derive(Clone, Debug)]
pub struct Plan {
    steps: Vec<Step>,
}

/// Solves for the wanted unknowns of cycles that hold them together. `signs` are taken in order wherever there are two solutions,
/// `true` for the positive root; those that are missing are positive.
pub fn solve(g: &mut Graph, cycles: &[KinematicLoop], signs: &[bool]) -> Result<Solution, Failure> {
    Plan::new(g, cycles)?.solve(g, cycles, &of_signs(signs))
}

/// Constant signs, as a solution takes them.
pub fn of_signs(signs: &[bool]) -> Vec<Scalar> {
    signs.iter().map(|&positive| if positive { Scalar::ONE } else { -Scalar::ONE }).collect()
}

impl Plan {
    /// Decides how cycles are solved. It depends on the cycles alone, not on what else the graph holds.
    pub fn new(g: &Graph, cycles: &[KinematicLoop]) -> Result<Plan, Failure> {
        Plan::at(g, cycles, &[])
    }

    /// The same from equations alone that tell their unknown at one of these points at least, given as values of symbols.
    pub fn at(g: &Graph, cycles: &[KinematicLoop], points: &[&dyn Fn(SymbolId) -> f64]) -> Result<Plan, Failure> {
        let system = System::new(cycles);
        if system.unknowns.iter().any(|u| u.wanted && matches!(u.motion, Motion::Ball(_))) {
            return Err(Failure::Ball);
        }
        let steps = plan::plan(&mut g.clone(), &system, points)?;
        Ok(Plan { steps })
    }

    /// The same plan for cycles like those that were planned, if every step of it finds an equation of the same form
    /// there. That costs a small part of the search.
    pub fn adapted(&self, g: &Graph, cycles: &[KinematicLoop]) -> Option<Plan> {
        let steps = plan::adapt(&mut g.clone(), &System::new(cycles), &self.steps)?;
        Some(Plan { steps })
    }

    /// Solves the cycles that were planned. `signs` are one or minus one, or what is so at run time; roots beyond them are positive.
    pub fn solve(&self, g: &mut Graph, cycles: &[KinematicLoop], signs: &[Scalar]) -> Result<Solution, Failure> {
        self.solve_system(g, &mut System::new(cycles), signs)
    }

    fn solve_system(&self, g: &mut Graph, system: &mut System, signs: &[Scalar]) -> Result<Solution, Failure> {
        let cycles = system.cycles.len();
        let (mut solved, mut choices): (Vec<Solved>, usize) = (Vec::with_capacity(self.steps.len()), 0);
        let mut orientations = Vec::new();
        for step in &self.steps {
            let sign = signs.get(choices).copied().unwrap_or(Scalar::ONE);
            match step {
                Step::Orientation(orientation) => {
                    let found = orientation.solve(g, system, sign).ok_or_else(|| Failure::NotFound {
                        remaining: orientation.unknowns.map(|number| system.unknowns[number].symbol).to_vec(),
                        solved: solved.len(),
                        cycles,
                    })?;
                    orientations.push((found, choices, orientation.describe()));
                    choices += 1;
                }
                Step::Translation(translation) => {
                    let numbers = translation.unknowns.list();
                    let found = translation.solve(g, system, sign).ok_or_else(|| Failure::NotFound {
                        remaining: numbers.iter().map(|&number| system.unknowns[number].symbol).collect(),
                        solved: solved.len(),
                        cycles,
                    })?;
                    let own = found.solved.into_iter().map(|mut one| {
                        one.roots.iter_mut().for_each(|root| root.sign = choices);
                        one
                    });
                    solved.extend(own);
                    choices += 1;
                    numbers.into_iter().for_each(|number| system.settle(g, number));
                }
                &Step::Coordinate { cycle, unknown: number, candidate, needed } => {
                    if needed {
                        let symbol = system.unknowns[number].symbol;
                        let rest = system.rest(cycle, number);
                        let opened = system.opened(g, cycle, number, &rest);
                        let Some(primitive) = opened.derive(g, candidate.source) else {
                            let (remaining, solved) = (vec![symbol], solved.len());
                            return Err(Failure::NotFound { remaining, solved, cycles });
                        };
                        let how = candidate.describe();
                        let mut one = primitive.solve(g, symbol, sign, &mut system.known, how);
                        one.roots.iter_mut().for_each(|root| root.sign = choices);
                        choices += primitive.signs();
                        solved.push(one);
                    }
                    system.settle(g, number);
                }
            }
        }
        for (found, sign, how) in orientations {
            let symbols = found.unknowns.map(|number| system.unknowns[number].symbol);
            let balances = found.balances(g, system);
            let mut three: Vec<&mut Solved> = solved.iter_mut().filter(|one| symbols.contains(&one.symbol)).collect();
            for (&symbol, balances) in symbols.iter().zip(balances) {
                let Some(one) = three.iter_mut().find(|one| one.symbol == symbol) else { continue };
                (one.balances, one.together) = (balances, symbols.to_vec());
            }
            // The first tells where they come from. Its root goes with one that takes none, so that each is told apart.
            if let Some(first) = three.first_mut() {
                first.parts.splice(0..0, found.parts);
                first.how = format!("{how}; {}", first.how);
            }
            let free = three.iter().rposition(|one| one.roots.is_empty());
            if let Some(one) = free.or(three.len().checked_sub(1)).and_then(|k| three.get_mut(k)) {
                one.roots.push(Root { value: found.root, sign });
            }
        }
        Ok(Solution { solved, signs: choices })
    }
}
