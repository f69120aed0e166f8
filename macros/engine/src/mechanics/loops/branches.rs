//! Stage `mechanics`: which solution of a loop is meant.
//!
//! In: a `solve` item with its cycles. Out: its closed form on the branch that the user's conditions choose. Every
//! combination of the roots' signs is evaluated at random configurations that have real solutions and satisfy the user's
//! assumptions, with parameters at their defaults; the one for which all conditions hold at all of them is taken.
//!
//! With other parameters another root may be the one that is meant: a frame turned by half a turn, a length below zero.
//! So a condition stays a part of the equations unless it cannot change: no parameter has a say in it, or its sign is
//! proven whatever they are ([`crate::symbolic::signs`]). Roots are then taken in *stages*, the shortest runs that
//! conditions decide on their own: the combination of signs for which the stage's conditions hold is found by evaluating
//! them, the declared one first, and where none holds the sign is no number, nor is anything that follows from it.
//! Conditions that no root decides are guards: the first result is no number where they fail.

use std::collections::HashMap;
use std::ops::Range;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::injection::{Break, broken};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::model::site::Sited;
use crate::model::types::{Coordinate, Expr, LoopClosure, Solve, SolveHow};
use crate::solve::{self, Failure, KinematicLoop, Plan, Solved, of_signs};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::fingerprint::mix;
use crate::symbolic::graph::{Scalar, SymbolId};
use crate::symbolic::lower::Lowering;
use crate::symbolic::signs::is_proven;

use super::constraints::coordinate_name;
use super::groups::Group;
use super::reduction::{Map, Reduction};

/// Configurations with real solutions at which conditions are tried, and random ones among which these are sought; more
/// where few of them are as the user assumes.
const SAMPLES: usize = 12;
const DRAWS: u64 = 600;
const MOST_DRAWS: u64 = 6000;
/// Most signs that one loop may leave to choose.
const MOST_SIGNS: usize = 5;
/// Most signs that are chosen together at run time.
const MOST_TOGETHER: usize = 3;

/// How a loop is solved: the plan, the signs of its roots with the declared parameters, and what other parameters change.
#[derive(Clone)]
struct Branch {
    plan: Plan,
    signs: Vec<bool>,
    stages: Vec<Stage>,
    /// Conditions that no root decides.
    guards: Vec<usize>,
}

/// How loops are solved, by `solve` item: decided once.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Branches(HashMap<usize, Branch>);

impl Branches {
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether parameters change nothing about how an item's loop is solved.
    pub(in crate::mechanics) fn is_fixed(&self, item: usize) -> bool {
        self.0.get(&item).is_some_and(Branch::is_fixed)
    }
}

/// Roots whose signs are chosen at run time, by conditions, all by number.
#[derive(Clone)]
struct Stage {
    roots: Range<usize>,
    conditions: Vec<usize>,
}

/// Signs of roots, and the solution with them.
type Choice = (Vec<bool>, Vec<Solved>);

/// Signs, and what they lead to.
struct Candidate {
    signs: Vec<bool>,
    /// The user's conditions at their solution.
    conditions: Vec<Scalar>,
}

impl Branch {
    /// Whether parameters may change what is chosen.
    fn is_fixed(&self) -> bool {
        self.stages.is_empty() && self.guards.is_empty()
    }
}

impl Equations<'_> {
    /// The unknowns of a `solve` item in the order in which they are found.
    pub(super) fn closed_form(
        &mut self,
        number: usize,
        reduction: &Reduction,
    ) -> Result<Vec<(Coordinate, Solved)>, Vec<Complaint>> {
        let model = self.scene.model;
        let item = &model.solves[number];
        let SolveHow::From { branches, .. } = &item.how else { return Ok(Vec::new()) };
        let cycles = self.cycles(item);
        if let Some(branch) = self.decided.branches.0.get(&number).cloned() {
            return self.on_branch(item, &cycles, &branch, branches, reduction);
        }
        let conditions: Vec<Scalar> = branches.iter().map(|condition| self.scalar(condition)).collect();
        let plan = match self.plan_alike(item, &cycles) {
            Some(plan) => plan,
            None => Plan::new(&self.g, &cycles).map_err(|failure| not_found(item, &failure))?,
        };
        let mut branch = self.choose(item, &cycles, plan, &conditions, reduction)?;
        if branch.is_none() {
            // An equation may say nothing with the declared parameters: others are looked for.
            let value = |draw: u64| move |e: &Self, id: SymbolId| e.sample(id, draw, 1.0);
            let [first, second] = [value(0), value(1)];
            let points: [&dyn Fn(SymbolId) -> f64; 2] = [&|id| first(self, id), &|id| second(self, id)];
            let plan = Plan::at(&self.g, &cycles, &points).map_err(|failure| not_found(item, &failure))?;
            branch = self.choose(item, &cycles, plan, &conditions, reduction)?;
        }
        let branch = branch.ok_or_else(|| {
            complaint(
                item,
                format!("{} no real solution at any configuration that was tried", having(item)),
                "check the lengths, the defaults of parameters, and what is assumed",
            )
        })?;
        let found = self.on_branch(item, &cycles, &branch, branches, reduction);
        self.decided.branches.0.insert(number, branch);
        found
    }

    /// The plan of a loop that is identical up to parameters, if it turns out to serve here.
    fn plan_alike(&self, item: &Solve, cycles: &[KinematicLoop]) -> Option<Plan> {
        let is_in = |group: &Group, closing: Option<LoopClosure>| closing.is_some_and(|c| group.closings.contains(&c));
        let groups = &self.scene.structure.groups;
        // What each closing of the item is a member of, in order: an item whose closings are members of the same ones is alike.
        let own: Option<Vec<&Group>> =
            item.closings().map(|closing| groups.iter().find(|group| is_in(group, Some(closing)))).collect();
        let own = own?;
        let alike = |solve: &Solve| {
            let mut closings = solve.closings();
            own.iter().all(|group| is_in(group, closings.next())) && closings.next().is_none()
        };
        let solves = self.scene.model.solves.iter().enumerate();
        let known =
            solves.filter(|(_, solve)| alike(solve)).filter_map(|(number, _)| self.decided.branches.0.get(&number));
        known.into_iter().find_map(|branch| branch.plan.adapted(&self.g, cycles))
    }

    /// The solution with the signs of a branch.
    fn on_branch(
        &mut self,
        item: &Solve,
        cycles: &[KinematicLoop],
        branch: &Branch,
        conditions: &[Expr],
        reduction: &Reduction,
    ) -> Result<Vec<(Coordinate, Solved)>, Vec<Complaint>> {
        let complain = |failure: Failure| not_found(item, &failure);
        let declared = of_signs(&branch.signs);
        let mut signs = declared.clone();
        if !branch.is_fixed() {
            let conditions: Vec<Scalar> = conditions.iter().map(|condition| self.scalar(condition)).collect();
            for stage in &branch.stages {
                let chosen = self.stage_signs(cycles, branch, stage, &signs, &conditions, reduction);
                signs.splice(stage.roots.clone(), chosen.map_err(complain)?);
            }
        }
        if broken(Break::ClosedFormSign) {
            signs.iter_mut().for_each(|sign| *sign = -*sign);
        }
        let mut solution = branch.plan.solve(&mut self.g, cycles, &signs).map_err(complain)?;
        // Roots that come out negative tell that another branch than the declared one was taken.
        for root in solution.solved.iter_mut().flat_map(|solved| &mut solved.roots) {
            let at = |signs: &[Scalar]| signs.get(root.sign).copied().unwrap_or(Scalar::ONE);
            let kept = self.g.mul(at(&signs), at(&declared));
            root.value = self.g.mul(kept, root.value);
        }
        if !branch.guards.is_empty() {
            let conditions: Vec<Scalar> = conditions.iter().map(|condition| self.scalar(condition)).collect();
            let put = self.put(&solution.solved, &branch.guards, &conditions, reduction);
            let guard = self.either(&[(put, Scalar::ZERO)]);
            if let Some(first) = solution.solved.first_mut() {
                first.value = match first.value {
                    solve::Value::Angle { cos, sin } => solve::Value::Angle { cos: self.g.add(cos, guard), sin },
                    solve::Value::Length(x) => solve::Value::Length(self.g.add(x, guard)),
                };
                for balance in &mut first.balances {
                    balance.inverse_slope = self.g.add(balance.inverse_slope, guard);
                }
            }
        }
        let solved = self.without_unwanted(item, solution.solved);
        Ok(self.in_order(item, solved))
    }

    /// The signs of a stage's roots: of the first combination for which its conditions hold.
    fn stage_signs(
        &mut self,
        cycles: &[KinematicLoop],
        branch: &Branch,
        stage: &Stage,
        before: &[Scalar],
        conditions: &[Scalar],
        reduction: &Reduction,
    ) -> Result<Vec<Scalar>, Failure> {
        let (roots, mut tried) = (stage.roots.clone(), Vec::new());
        for choice in 0..1_usize << roots.len() {
            let declared = branch.signs[roots.clone()].iter().enumerate();
            let own: Vec<bool> = declared.map(|(k, &sign)| sign != (choice >> k & 1 == 1)).collect();
            let mut signs = before.to_vec();
            signs.splice(roots.clone(), of_signs(&own));
            let solution = branch.plan.solve(&mut self.g, cycles, &signs)?;
            tried.push((self.put(&solution.solved, &stage.conditions, conditions, reduction), own));
        }
        let chosen = (0..roots.len()).map(|k| {
            let options: Vec<(Vec<Scalar>, Scalar)> =
                tried.iter().map(|(masks, own)| (masks.clone(), of_signs(&own[k..=k])[0])).collect();
            self.either(&options)
        });
        Ok(chosen.collect())
    }

    /// The first value whose conditions all hold; no number if there is none.
    fn either(&mut self, options: &[(Vec<Scalar>, Scalar)]) -> Scalar {
        let g = &mut self.g;
        let nothing = g.call(Call::Nan, &[]);
        options.iter().rev().fold(nothing, |otherwise, (masks, value)| {
            let all = masks.iter().copied().reduce(|a, b| g.call(Call::And, &[a, b]));
            match all {
                Some(mask) => g.call(Call::Select, &[mask, *value, otherwise]),
                None => *value,
            }
        })
    }

    /// Some of the conditions at a solution.
    fn put(&mut self, solved: &[Solved], which: &[usize], conditions: &[Scalar], reduction: &Reduction) -> Vec<Scalar> {
        let map = self.solution_map(solved, reduction);
        let conditions: Vec<Scalar> = which.iter().filter_map(|&k| conditions.get(k).copied()).collect();
        self.g.substitute(&conditions, &map)
    }

    /// A solution's values beside those of the steps before it.
    pub(super) fn solution_map(&mut self, solved: &[Solved], reduction: &Reduction) -> Map {
        let mut map = reduction.map.clone();
        for one in solved {
            let value = self.value_of(one);
            let value = self.g.substitute(&[value], &map)[0];
            map.extend(self.g.symbol_id(one.symbol).map(|id| (id, value)));
        }
        map
    }

    fn value_of(&mut self, solved: &Solved) -> Scalar {
        match solved.value {
            solve::Value::Angle { cos, sin } => self.g.angle(cos, sin),
            solve::Value::Length(x) => x,
        }
    }

    /// What was found on the way, as the angle of a thread, is put into what follows from it.
    fn without_unwanted(&mut self, item: &Solve, solved: Vec<Solved>) -> Vec<Solved> {
        let (mut map, mut wanted): (Map, Vec<Solved>) = (HashMap::new(), Vec::with_capacity(solved.len()));
        for mut one in solved {
            if !map.is_empty() {
                let put = |e: &mut Self, list: &[Scalar]| e.g.substitute(list, &map);
                one.value = match one.value {
                    solve::Value::Angle { cos, sin } => match put(self, &[cos, sin])[..] {
                        [cos, sin] => solve::Value::Angle { cos, sin },
                        _ => one.value,
                    },
                    solve::Value::Length(x) => solve::Value::Length(put(self, &[x])[0]),
                };
                for balance in &mut one.balances {
                    balance.equation = put(self, &[balance.equation])[0];
                    balance.inverse_slope = put(self, &[balance.inverse_slope])[0];
                }
                one.roots.iter_mut().for_each(|root| root.value = put(self, &[root.value])[0]);
            }
            if self.unknown_of(item, &one).is_some() {
                wanted.push(one);
                continue;
            }
            let value = self.value_of(&one);
            map.extend(self.g.symbol_id(one.symbol).map(|id| (id, value)));
        }
        wanted
    }

    fn unknown_of(&self, item: &Solve, solved: &Solved) -> Option<Coordinate> {
        let symbol = solved.symbol.index();
        item.unknowns.iter().copied().find(|&u| self.coordinate_symbols(u)[0].index() == symbol)
    }

    fn in_order(&self, item: &Solve, solved: Vec<Solved>) -> Vec<(Coordinate, Solved)> {
        solved.into_iter().filter_map(|solved| Some((self.unknown_of(item, &solved)?, solved))).collect()
    }

    /// What a plan leads to, for every choice of signs.
    pub(super) fn solutions(&mut self, cycles: &[KinematicLoop], plan: &Plan) -> Result<Vec<Choice>, Failure> {
        let first = plan.solve(&mut self.g, cycles, &[])?;
        let count = first.signs.min(MOST_SIGNS);
        let mut solutions = vec![(vec![true; count], first.solved)];
        for choice in 1..1_usize << count {
            let signs: Vec<bool> = (0..count).map(|k| choice >> k & 1 == 0).collect();
            if let Ok(other) = plan.solve(&mut self.g, cycles, &of_signs(&signs)) {
                solutions.push((signs, other.solved));
            }
        }
        Ok(solutions)
    }

    /// The candidate for which all conditions hold, and what is left of them for run time; nothing where none of them is
    /// real at any configuration.
    fn choose(
        &mut self,
        item: &Solve,
        cycles: &[KinematicLoop],
        plan: Plan,
        conditions: &[Scalar],
        reduction: &Reduction,
    ) -> Result<Option<Branch>, Vec<Complaint>> {
        let solutions = self.solutions(cycles, &plan).map_err(|failure| not_found(item, &failure))?;
        if solutions.len() == 1 && conditions.is_empty() {
            let signs = solutions.into_iter().next().map_or_else(Vec::new, |one| one.0);
            return Ok(Some(Branch { plan, signs, stages: Vec::new(), guards: Vec::new() }));
        }
        let unknowns: Vec<Scalar> = item.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect();
        let mut candidates: Vec<Candidate> = Vec::with_capacity(solutions.len());
        // Per candidate: the unknowns, then the conditions, at configurations.
        let mut samples: Vec<Vec<Vec<f64>>> = Vec::with_capacity(solutions.len());
        for (signs, solved) in solutions {
            let map = self.solution_map(&solved, reduction);
            let roots: Vec<Scalar> = unknowns.iter().chain(conditions).copied().collect();
            let table = self.g.substitute(&roots, &map);
            samples.push(self.samples(&table, &map));
            candidates.push(Candidate { signs, conditions: table[unknowns.len()..].to_vec() });
        }
        let holds = |table: &Vec<Vec<f64>>| {
            !table.is_empty() && table.iter().all(|row| row[unknowns.len()..].iter().all(|&mask| mask != 0.0))
        };
        let mut fitting: Vec<usize> = (0..samples.len()).filter(|&k| holds(&samples[k])).collect();
        // Sign choices that give the same solution are one.
        fitting.dedup_by(|b, a| same(&samples[*a], &samples[*b], unknowns.len()));
        match fitting[..] {
            [only] => {
                let holding = |k: usize, which: &[usize]| {
                    !samples[k].is_empty()
                        && samples[k].iter().all(|row| which.iter().all(|c| row[unknowns.len() + c] != 0.0))
                };
                Ok(Some(self.left_open(plan, &candidates, only, holding)))
            }
            [] if samples.iter().all(Vec::is_empty) => Ok(None),
            _ => {
                let list = self.list(item, &samples);
                let what = if conditions.is_empty() {
                    format!("{} {} solutions", having(item), candidates.len())
                } else if fitting.is_empty() {
                    format!("no solution of {} satisfies the conditions everywhere", these(item))
                } else {
                    format!("{} solutions of {} satisfy the conditions", fitting.len(), these(item))
                };
                let help =
                    "choose one by conditions that hold on its branch alone, `solve .. from .. { sin(a) > 0.0 }`";
                Err(complaint(item, what, &format!("{help}; at one configuration they are {list}")))
            }
        }
    }

    /// What parameters may change about a choice. `holding` tells of a candidate whether it satisfies some conditions.
    fn left_open(
        &self,
        plan: Plan,
        candidates: &[Candidate],
        only: usize,
        holding: impl Fn(usize, &[usize]) -> bool,
    ) -> Branch {
        let chosen = &candidates[only];
        let count = chosen.signs.len();
        let parameters: Vec<Scalar> = self.scene.symbols.parameters();
        let open = |&k: &usize| {
            let condition = chosen.conditions[k];
            if !self.g.depends_on(condition, &parameters) {
                return false;
            }
            let mut lowering = Lowering::new(&self.g);
            let lowered = lowering.run(&[condition]);
            !lowered.iter().all(|&condition| is_proven(&lowering.to, condition))
        };
        // The last root whose sign a condition depends on, counted from one.
        let level = |k: usize| {
            let differs = |root: &usize| {
                candidates.iter().any(|a| {
                    let other =
                        candidates.iter().find(|b| (0..count).all(|at| (a.signs[at] == b.signs[at]) == (at != *root)));
                    other.is_some_and(|b| a.conditions[k] != b.conditions[k])
                })
            };
            (0..count).rev().find(differs).map_or(0, |root| root + 1)
        };
        let levels: Vec<usize> = (0..chosen.conditions.len()).map(level).collect();
        let of_level = |wanted: &dyn Fn(usize) -> bool| -> Vec<usize> {
            (0..levels.len()).filter(|&k| wanted(levels[k])).collect()
        };
        let guards: Vec<usize> = of_level(&|level| level == 0).into_iter().filter(|k| open(k)).collect();
        let (mut stages, mut start) = (Vec::new(), 0);
        for end in 1..=count {
            let (own, all) = (of_level(&|level| start < level && level <= end), of_level(&|level| level <= end));
            // Whether no other signs of these roots do with the declared signs of all others.
            let alone = candidates.iter().enumerate().all(|(k, other)| {
                let elsewhere = (0..count).all(|at| (start..end).contains(&at) || other.signs[at] == chosen.signs[at]);
                k == only || !elsewhere || !holding(k, &all)
            });
            if (own.is_empty() || !alone) && end < count {
                continue;
            }
            if own.iter().any(&open) {
                stages.push(Stage { roots: start..end, conditions: own });
            }
            start = end;
        }
        // So many roots that conditions decide together only: the declared ones, where their conditions hold.
        let (together, too_many): (Vec<Stage>, Vec<Stage>) =
            stages.into_iter().partition(|stage| stage.roots.len() <= MOST_TOGETHER);
        let mut guards = guards;
        guards.extend(too_many.into_iter().flat_map(|stage| stage.conditions));
        Branch { plan, signs: chosen.signs.clone(), stages: together, guards }
    }

    /// Solutions at one configuration, for the message.
    fn list(&self, item: &Solve, samples: &[Vec<Vec<f64>>]) -> String {
        let solutions = samples.iter().filter_map(|table| table.first());
        let texts = solutions.map(|row| {
            let values = item.unknowns.iter().zip(row);
            let texts: Vec<String> = values
                .map(|(&unknown, value)| format!("{} = {value:.3}", coordinate_name(self.scene.model, unknown)))
                .collect();
            format!("({})", texts.join(", "))
        });
        texts.collect::<Vec<String>>().join(", ")
    }

    /// Values at configurations where all are real and all that the user assumes is so. `map` gives the coordinates
    /// outside the state that assumptions may speak of.
    pub(in crate::mechanics) fn samples(&mut self, roots: &[Scalar], map: &Map) -> Vec<Vec<f64>> {
        let model = self.scene.model;
        let assumed: Vec<Scalar> = model.assumptions.iter().map(|condition| self.scalar(condition)).collect();
        let mut all = self.g.substitute(&assumed, map);
        let count = all.len();
        all.extend(roots);
        let mut found = Vec::new();
        for draw in 0..MOST_DRAWS {
            if found.len() == SAMPLES || (draw >= DRAWS && (count == 0 || found.len() > 1)) {
                break;
            }
            // Lengths of any size: metres to millimetres.
            let scale = 10_f64.powf(1.0 - 4.0 * unit(draw, 0));
            let value = |id: SymbolId| self.sample(id, draw, scale);
            let values = Evaluator::new(&self.g, Real { symbols: &value }).run(&all);
            let (masks, values) = values.split_at(count);
            if masks.iter().all(|&mask| mask != 0.0) && values.iter().all(|x| x.is_finite()) {
                found.push(values.to_vec());
            }
        }
        found
    }

    /// A random value of a symbol; parameters have their defaults.
    pub(super) fn sample(&self, id: SymbolId, draw: u64, scale: f64) -> f64 {
        let random = 2.0 * unit(draw, id.0 as u64 + 1) - 1.0;
        match self.scene.symbols.table.get(id.0) {
            Some(&Symbol::Param { param, element }) => self.scene.model.params[param].default[element],
            Some(&Symbol::Position { joint, component }) => {
                let length = self.scene.model.joints[joint].kind.is_slide(component);
                if length { scale * random } else { std::f64::consts::PI * random }
            }
            // Any point of its circle is as good.
            Some(&Symbol::UnknownPoint { component, .. }) => [0.6, 0.8][component],
            _ => random,
        }
    }
}

fn same(a: &[Vec<f64>], b: &[Vec<f64>], count: usize) -> bool {
    a.iter().zip(b).all(|(x, y)| x.iter().zip(y).take(count).all(|(x, y)| (x - y).abs() <= 1e-9 * (1.0 + x.abs())))
}

/// Random, between 0 and 1.
pub(super) fn unit(draw: u64, key: u64) -> f64 {
    (mix(mix(draw ^ 0x5A17) ^ key) >> 11) as f64 / (1_u64 << 53) as f64
}

fn complaint(item: &Solve, message: String, help: &str) -> Vec<Complaint> {
    vec![Complaint { at: item.site(), message, help: Some(help.to_owned()) }]
}

/// The loops of an item, in a sentence.
pub(super) fn these(item: &Solve) -> &'static str {
    if item.closings().count() > 1 { "these loops" } else { "this loop" }
}

fn having(item: &Solve) -> &'static str {
    if item.closings().count() > 1 { "these loops have" } else { "this loop has" }
}

fn not_found(item: &Solve, failure: &Failure) -> Vec<Complaint> {
    complaint(
        item,
        format!("no closed form was found for {}: {failure}", these(item)),
        "leave the `solve` item out to have the loop solved by Newton's method, or write the solution yourself: \
         `solve (a, b) = (.., ..);`",
    )
}
