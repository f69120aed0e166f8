//! Stage `mechanics`: all solutions of a loop in numbers.
//!
//! In: a `solve` item, poses. Out: what its closed form gives for every combination of the roots' signs, at these poses and at random
//! ones, parameters moved at every other, and where its conditions hold. Which combination goes through the poses, and what tells it
//! from the others, is read off these numbers; nothing is decided here. Coordinates that other loops give are taken as they stand.

use std::rc::Rc;

use crate::contracts::symbol::Symbol;
use crate::mechanics::analysis::Pose;
use crate::mechanics::equations::Equations;
use crate::model::types::{Coordinate, Expr, ParamId, Solve, SolveHow};
use crate::solve::{KinematicLoop, Plan};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};

use super::branches::unit;
use super::reduction::Reduction;

/// Random configurations, and how many are kept where something is real.
const DRAWS: u64 = 900;
const MOST_SAMPLES: usize = 40;

/// How far parameters are moved at every other one.
const MOVED: f64 = 0.2;

/// Solutions beyond so many are not told apart.
const MOST_SOLUTIONS: usize = 32;

/// Solutions of one loop at one configuration, closed or not.
#[derive(Clone, Debug)]
pub struct Sample {
    pub pose: Pose,
    /// By solution the unknowns; nothing where they are not real, or not as assumed.
    pub solutions: Vec<Option<Vec<f64>>>,
    /// By solution whether each of the item's conditions holds.
    pub holds: Vec<Vec<bool>>,
}

impl Sample {
    /// A coordinate of the tree, in one of the solutions; nothing of a part of a quaternion.
    pub fn value(&self, unknowns: &[Coordinate], solution: usize, coordinate: Coordinate) -> Option<f64> {
        match unknowns.iter().position(|&unknown| unknown == coordinate) {
            Some(at) => self.solutions[solution].as_ref().map(|list| list[at]),
            None => self.pose.positions.get(coordinate.joint.0)?.get(coordinate.index).copied(),
        }
    }
}

/// Solutions of one loop.
#[derive(Clone, Debug)]
pub struct Solutions {
    /// At the poses that were given, in their order.
    pub near: Vec<Sample>,
    /// At random configurations where at least one is real.
    pub wide: Vec<Sample>,
}

/// Coordinates that follow from others do so at poses if they come out as they stand there.
const AGREES: f64 = 1e-6;

impl Equations<'_> {
    /// Whether all that follows stands at some poses where these have it, with no turn more or less. Newton's method starts there.
    pub(in crate::mechanics) fn agrees(&mut self, reduction: &Reduction, poses: &[Pose]) -> bool {
        let structure = Rc::clone(&self.scene.structure);
        let guessed = structure.guessed();
        let follows: Vec<Coordinate> = structure.steps.iter().flat_map(|step| step.unknowns.iter().copied()).collect();
        let symbols: Vec<Scalar> = follows.iter().map(|&coordinate| self.coordinate_symbols(coordinate)[0]).collect();
        let roots = self.finish(reduction, &symbols);
        poses.iter().all(|pose| {
            let at = |coordinate: Coordinate| pose.positions[coordinate.joint.0][coordinate.index];
            let value = |id: SymbolId| match self.scene.symbols.table.get(id.0) {
                Some(&Symbol::Guess { index }) => at(guessed[index]),
                _ => self.at_pose(pose, id),
            };
            let values = Evaluator::new(&self.g, Real { symbols: &value }).run(&roots);
            let is_so = |(&coordinate, x): (&Coordinate, f64)| (x - at(coordinate)).abs() <= AGREES * (1.0 + x.abs());
            follows.iter().zip(values).all(is_so)
        })
    }

    /// Of a `solve` item; nothing where no closed form is found. Plans that served for other loops are tried first.
    pub(in crate::mechanics) fn solutions_at(
        &mut self,
        number: usize,
        poses: &[Pose],
        plans: &mut Vec<Plan>,
    ) -> Option<Solutions> {
        let model = self.scene.model;
        let item = &model.solves[number];
        let SolveHow::From { branches, .. } = &item.how else { return None };
        let cycles = self.cycles(item);
        let alike = plans.iter().find_map(|plan| plan.adapted(&self.g, &cycles));
        let plan = alike.or_else(|| Plan::new(&self.g, &cycles).ok())?;
        if let Some(found) = self.tabulated(item, branches, &cycles, &plan, poses) {
            plans.push(plan);
            return Some(found);
        }
        // An equation may say nothing with the declared parameters: others are looked for.
        let value = |draw: u64| move |e: &Self, id: SymbolId| e.sample(id, draw, 1.0);
        let [first, second] = [value(0), value(1)];
        let points: [&dyn Fn(SymbolId) -> f64; 2] = [&|id| first(self, id), &|id| second(self, id)];
        let plan = Plan::at(&self.g, &cycles, &points).ok()?;
        self.tabulated(item, branches, &cycles, &plan, poses)
    }

    /// Nothing where no solution is real at the first pose.
    fn tabulated(
        &mut self,
        item: &Solve,
        conditions: &[Expr],
        cycles: &[KinematicLoop],
        plan: &Plan,
        poses: &[Pose],
    ) -> Option<Solutions> {
        let choices = self.solutions(cycles, plan).ok().filter(|choices| choices.len() <= MOST_SOLUTIONS)?;
        let unknowns: Vec<Scalar> = item.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect();
        let model = self.scene.model;
        let assumed: Vec<Scalar> = model.assumptions.iter().map(|condition| self.scalar(condition)).collect();
        let conditions: Vec<Scalar> = conditions.iter().map(|condition| self.scalar(condition)).collect();
        let asked = [&unknowns[..], &conditions, &assumed].concat();
        let count = conditions.len();
        let mut roots = Vec::with_capacity(choices.len() * asked.len());
        for (_, solved) in choices {
            let map = self.solution_map(&solved, &Reduction::default());
            roots.extend(self.g.substitute(&asked, &map));
        }
        let sample = |value: &dyn Fn(SymbolId) -> f64, pose: Pose| -> Sample {
            let values = Evaluator::new(&self.g, Real { symbols: &value }).run(&roots);
            let (mut solutions, mut holds) = (Vec::new(), Vec::new());
            for values in values.chunks(asked.len()) {
                let (found, masks) = values.split_at(unknowns.len());
                let (own, assumed) = masks.split_at(count);
                let is_real = found.iter().all(|x| x.is_finite()) && assumed.iter().all(|&mask| mask != 0.0);
                solutions.push(is_real.then(|| found.to_vec()));
                holds.push(own.iter().map(|&mask| mask != 0.0).collect());
            }
            Sample { pose, solutions, holds }
        };
        let is_real = |sample: &Sample| sample.solutions.iter().any(Option::is_some);
        let at_pose = |pose: &Pose| sample(&|id| self.at_pose(pose, id), pose.clone());
        let near: Vec<Sample> = poses.iter().map(at_pose).collect();
        if !near.first().is_some_and(is_real) {
            return None;
        }
        let draws = (0..DRAWS).map(|draw| {
            let value = |id: SymbolId| self.drawn(id, draw);
            sample(&value, self.read_off(&value))
        });
        let wide = draws.filter(is_real).take(MOST_SAMPLES).collect();
        Some(Solutions { near, wide })
    }

    /// At time zero.
    fn at_pose(&self, pose: &Pose, id: SymbolId) -> f64 {
        match self.scene.symbols.table.get(id.0) {
            Some(&Symbol::Position { joint, component }) => pose.positions[joint.0][component],
            Some(&Symbol::Param { param: ParamId(param), element }) => {
                let moved = pose.parameters.iter().find(|moved| moved.0 == (param, element));
                moved.map_or_else(|| self.scene.model.params[ParamId(param)].default[element], |moved| moved.1)
            }
            _ => 0.0,
        }
    }

    fn drawn(&self, id: SymbolId, draw: u64) -> f64 {
        // Lengths of any size: metres to millimetres.
        let scale = 10_f64.powf(1.0 - 4.0 * unit(draw, 0));
        let value = self.sample(id, draw, scale);
        let is_parameter = matches!(self.scene.symbols.table.get(id.0), Some(Symbol::Param { .. }));
        match is_parameter && draw % 2 == 1 {
            true => value + MOVED * (2.0 * unit(draw, id.0 as u64 + 1) - 1.0) * if value == 0.0 { 1.0 } else { value },
            false => value,
        }
    }

    fn read_off(&self, value: &dyn Fn(SymbolId) -> f64) -> Pose {
        let of = |&symbol: &Scalar| self.g.symbol_id(symbol).map_or(0.0, value);
        let positions = self.scene.symbols.positions.iter();
        let positions = positions.map(|list| list.iter().map(of).collect()).collect();
        let table = self.scene.symbols.table.iter().enumerate();
        let parameters = table.filter_map(|(id, symbol)| match *symbol {
            Symbol::Param { param, element } => {
                let found = value(SymbolId(id));
                (found != self.scene.model.params[param].default[element]).then_some(((param.0, element), found))
            }
            _ => None,
        });
        Pose { positions, parameters: parameters.collect() }
    }
}
