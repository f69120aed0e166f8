//! Stage `mechanics`: loops as cycles for the stage `solve`, and the choice of a branch.
//!
//! In: a `solve` item. Out: its closed form. A loop is walked once around: from the last link that carries both ends out to
//! the closing's parent frame, through the closing, and back from its child frame. Motions that are known stay as they
//! are, unknown ones keep the symbols of their coordinates as placeholders. A motion that is walked against its sense is
//! the same motion about the opposite axis: turned by half a turn before and after.
//!
//! Signs of roots are chosen by the user's conditions: every combination is evaluated at random configurations that have
//! real solutions, with parameters at their defaults; the one for which all conditions hold at all of them is taken.

use crate::model::types::{Closing, ConstraintKind, Coordinate, JointKind, Solve, SolveHow};
use crate::solve::{self, Failure, Plan, Segment, Solved};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::fingerprint::mix;
use crate::symbolic::graph::{Rotation, Scalar, SymbolId, Vector};

use super::analysis::Complaint;
use super::build::Place;
use super::closings::coordinate_name;
use super::constants;
use super::equations::Equations;
use super::reduction::Reduction;
use super::tree::{Link, Motion};

/// Configurations with real solutions at which conditions are tried, and random ones among which these are sought.
const SAMPLES: usize = 12;
const DRAWS: u64 = 600;
/// Most signs that one loop may leave to choose.
const MOST_SIGNS: usize = 5;

/// How a loop is solved: the plan, and the signs of its roots.
pub(super) type Branch = (Plan, Vec<bool>);

impl Equations<'_> {
    /// The unknowns of a `solve` item in the order in which they are found.
    pub(super) fn closed_form(
        &mut self,
        number: usize,
        reduction: &Reduction,
    ) -> Result<Vec<(Coordinate, Solved)>, Vec<Complaint>> {
        let model = self.model;
        let Some(item) = model.solves.get(number) else { return Ok(Vec::new()) };
        let SolveHow::From { closing, branches } = &item.how else { return Ok(Vec::new()) };
        let cycle = self.cycle(*closing, item);
        if let Some((plan, signs)) = self.branches.get(&number).cloned() {
            let solution = plan.solve(&mut self.g, &cycle, &signs).map_err(|failure| not_found(item, &failure))?;
            return Ok(self.in_order(item, solution.solved));
        }
        let plan = match self.plan_alike(*closing, &cycle) {
            Some(plan) => plan,
            None => Plan::new(&self.g, &cycle).map_err(|failure| not_found(item, &failure))?,
        };
        let first = plan.solve(&mut self.g, &cycle, &[]).map_err(|failure| not_found(item, &failure))?;
        let count = first.signs.min(MOST_SIGNS);
        let mut candidates = vec![(vec![true; count], first.solved)];
        for choice in 1..1_usize << count {
            let signs: Vec<bool> = (0..count).map(|k| choice >> k & 1 == 0).collect();
            if let Ok(other) = plan.solve(&mut self.g, &cycle, &signs) {
                candidates.push((signs, other.solved));
            }
        }
        let conditions: Vec<Scalar> = branches.iter().map(|condition| self.scalar(condition)).collect();
        let (signs, chosen) = self.choose(item, candidates, &conditions, reduction)?;
        self.branches.insert(number, (plan, signs));
        Ok(self.in_order(item, chosen))
    }

    /// The plan of a loop that is identical up to parameters, if it turns out to serve here.
    fn plan_alike(&self, closing: Closing, cycle: &[Segment]) -> Option<Plan> {
        let group = self.structure.groups.iter().find(|group| group.closings.contains(&closing))?;
        let known = self.model.solves.iter().enumerate().filter_map(|(number, solve)| match &solve.how {
            SolveHow::From { closing, .. } if group.closings.contains(closing) => self.branches.get(&number),
            _ => None,
        });
        known.into_iter().find_map(|(plan, _)| plan.adapted(&self.g, cycle))
    }

    fn in_order(&self, item: &Solve, solved: Vec<Solved>) -> Vec<(Coordinate, Solved)> {
        let of = |symbol: Scalar| {
            let unknowns = item.unknowns.iter().copied();
            let mut unknowns = unknowns.filter(|&u| self.coordinate_symbols(u)[0].index() == symbol.index());
            unknowns.next()
        };
        solved.into_iter().filter_map(|solved| Some((of(solved.symbol)?, solved))).collect()
    }

    /// The candidate for which all conditions hold.
    fn choose(
        &mut self,
        item: &Solve,
        mut candidates: Vec<(Vec<bool>, Vec<Solved>)>,
        conditions: &[Scalar],
        reduction: &Reduction,
    ) -> Result<(Vec<bool>, Vec<Solved>), Vec<Complaint>> {
        if candidates.len() == 1 && conditions.is_empty() {
            return Ok(candidates.remove(0));
        }
        let unknowns: Vec<Scalar> = item.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect();
        // Per candidate: the unknowns, then the conditions, at configurations.
        let mut tables = Vec::with_capacity(candidates.len());
        for (_, candidate) in &candidates {
            let mut map = reduction.map.clone();
            for solved in candidate {
                let value = match solved.value {
                    solve::Value::Angle { cos, sin } => self.g.angle(cos, sin),
                    solve::Value::Length(x) => x,
                };
                let value = self.g.substitute(&[value], &map)[0];
                map.extend(self.g.symbol_id(solved.symbol).map(|id| (id, value)));
            }
            let roots: Vec<Scalar> = unknowns.iter().chain(conditions).copied().collect();
            tables.push(self.g.substitute(&roots, &map));
        }
        let samples: Vec<Vec<Vec<f64>>> = tables.iter().map(|roots| self.samples(roots)).collect();
        let holds = |table: &Vec<Vec<f64>>| {
            !table.is_empty() && table.iter().all(|row| row[unknowns.len()..].iter().all(|&mask| mask != 0.0))
        };
        let mut fitting: Vec<usize> = (0..samples.len()).filter(|&k| holds(&samples[k])).collect();
        // Sign choices that give the same solution are one.
        fitting.dedup_by(|b, a| same(&samples[*a], &samples[*b], unknowns.len()));
        match fitting[..] {
            [only] => Ok(candidates.swap_remove(only)),
            [] if samples.iter().all(Vec::is_empty) => Err(complaint(
                item,
                "this loop has no real solution at any configuration that was tried".to_owned(),
                "check the lengths, and the defaults of parameters",
            )),
            _ => {
                let list = self.list(item, &samples);
                let what = if conditions.is_empty() {
                    format!("this loop has {} solutions", candidates.len())
                } else if fitting.is_empty() {
                    "no solution of this loop satisfies the conditions everywhere".to_owned()
                } else {
                    format!("{} solutions of this loop satisfy the conditions", fitting.len())
                };
                let help =
                    "choose one by conditions that hold on its branch alone, `solve .. from .. { sin(a) > 0.0 }`";
                Err(complaint(item, what, &format!("{help}; at one configuration they are {list}")))
            }
        }
    }

    /// Solutions at one configuration, for the message.
    fn list(&self, item: &Solve, samples: &[Vec<Vec<f64>>]) -> String {
        let solutions = samples.iter().filter_map(|table| table.first());
        let texts = solutions.map(|row| {
            let values = item.unknowns.iter().zip(row);
            let texts: Vec<String> = values
                .map(|(&unknown, value)| format!("{} = {value:.3}", coordinate_name(self.model, unknown)))
                .collect();
            format!("({})", texts.join(", "))
        });
        texts.collect::<Vec<String>>().join(", ")
    }

    /// Values at configurations where all are real.
    pub(super) fn samples(&self, roots: &[Scalar]) -> Vec<Vec<f64>> {
        let mut found = Vec::new();
        for draw in 0..DRAWS {
            // Lengths of any size: metres to millimetres.
            let scale = 10_f64.powf(1.0 - 4.0 * unit(draw, 0));
            let value = |id: SymbolId| self.sample(id, draw, scale);
            let values = Evaluator::new(&self.g, Real { symbols: &value }).run(roots);
            if values.iter().all(|x| x.is_finite()) {
                found.push(values);
            }
            if found.len() == SAMPLES {
                break;
            }
        }
        found
    }

    /// A random value of a symbol; parameters have their defaults.
    fn sample(&self, id: SymbolId, draw: u64, scale: f64) -> f64 {
        use crate::optimize::program::Symbol;
        let random = 2.0 * unit(draw, id.0 as u64 + 1) - 1.0;
        match self.symbols.table.get(id.0) {
            Some(&Symbol::Param { param, element }) => {
                let param = self.model.params.get(param.0);
                param.and_then(|param| param.default.get(element)).copied().unwrap_or(0.0)
            }
            Some(&Symbol::Position { joint, component }) => {
                let kind = self.model.joints.get(joint.0).map(|joint| &joint.kind);
                let length = match kind {
                    Some(JointKind::Prismatic { .. }) => true,
                    Some(JointKind::Cylindrical { .. }) => component == 0,
                    Some(JointKind::Planar { .. }) => component < 2,
                    Some(JointKind::Free(_)) => component < 3,
                    _ => false,
                };
                if length { scale * random } else { std::f64::consts::PI * random }
            }
            _ => random,
        }
    }

    /// Once around the loop of a closing.
    fn cycle(&mut self, closing: Closing, item: &Solve) -> Vec<Segment> {
        let model = self.model;
        let mut cycle = Vec::new();
        match closing {
            Closing::Cut(id) => {
                let Some(joint) = model.joints.get(id.0) else { return cycle };
                let (from, to) = (self.place(&joint.parent), self.place(&joint.child));
                let common = self.common(from.link, to.link);
                self.outwards_to(&from, common, item, &mut cycle);
                self.closing_motions(&joint.kind, &mut cycle);
                self.back_from(&to, common, item, &mut cycle);
            }
            Closing::Constraint(id) => {
                let Some(ConstraintKind::Rod { between, length }) = model.constraints.get(id.0).map(|c| &c.kind) else {
                    return cycle;
                };
                let (from, to) = (self.place(&between[0]), self.place(&between[1]));
                let length = self.scalar(length);
                let common = self.common(from.link, to.link);
                self.outwards_to(&from, common, item, &mut cycle);
                cycle.push(self.unwanted(Motion::Ball([Scalar::ZERO; 4]), 0));
                let offset = self.g.along(0, length);
                cycle.push(Segment::Fixed { rotation: Rotation::IDENTITY, offset });
                cycle.push(self.unwanted(Motion::Ball([Scalar::ZERO; 4]), 3));
                self.back_from(&to, common, item, &mut cycle);
            }
        }
        cycle
    }

    /// The links from the common carrier (excluded) to a place's link, outwards.
    fn links_between(&self, link: Option<usize>, common: Option<usize>) -> Vec<usize> {
        let mut path = Vec::new();
        let mut at = link;
        while let (true, Some(index)) = (at != common, at) {
            path.push(index);
            at = self.mechanism.tree.links.get(index).and_then(|link| link.parent);
        }
        path.reverse();
        path
    }

    fn outwards_to(&mut self, place: &Place, common: Option<usize>, item: &Solve, cycle: &mut Vec<Segment>) {
        let mechanism = std::rc::Rc::clone(&self.mechanism);
        for index in self.links_between(place.link, common) {
            let Some(link) = mechanism.tree.links.get(index) else { continue };
            cycle.push(Segment::Fixed { rotation: link.rotation, offset: link.offset });
            self.motion(link, false, item, cycle);
        }
        cycle.push(Segment::Fixed { rotation: place.rotation, offset: place.offset });
    }

    fn back_from(&mut self, place: &Place, common: Option<usize>, item: &Solve, cycle: &mut Vec<Segment>) {
        let mechanism = std::rc::Rc::clone(&self.mechanism);
        self.inverse(place.rotation, place.offset, cycle);
        for index in self.links_between(place.link, common).into_iter().rev() {
            let Some(link) = mechanism.tree.links.get(index) else { continue };
            self.motion(link, true, item, cycle);
            self.inverse(link.rotation, link.offset, cycle);
        }
    }

    fn inverse(&mut self, rotation: Rotation, offset: Vector, cycle: &mut Vec<Segment>) {
        let back = constants::rotate(&mut self.g, rotation.transpose(), offset);
        cycle.push(Segment::Fixed { rotation: rotation.transpose(), offset: -back });
    }

    /// A link's motion, or its inverse.
    fn motion(&mut self, link: &Link, back: bool, item: &Solve, cycle: &mut Vec<Segment>) {
        let unknown = item.unknowns.iter().any(|&u| {
            let symbol = self.coordinate_symbols(u)[0];
            symbol.index() == link.q.index() && symbol != Scalar::ZERO
        });
        if unknown {
            let against = back != link.q.is_negative();
            let axis = match link.motion {
                Motion::Revolute(axis) | Motion::Prismatic(axis) | Motion::Screw(axis, _) => axis,
                Motion::Ball(_) => 0,
            };
            let half = against.then(|| {
                let pi = self.g.pi();
                self.g.axis_rotation((axis + 1) % 3, pi)
            });
            let turn = half.map(|rotation| Segment::Fixed { rotation, offset: Vector::ZERO });
            cycle.extend(turn);
            cycle.push(Segment::Unknown { motion: link.motion, symbol: link.q.positive(), wanted: true });
            cycle.extend(turn);
            return;
        }
        let mut still = link.clone();
        (still.rotation, still.offset) = (Rotation::IDENTITY, Vector::ZERO);
        let rotation = self.mechanism.tree.rotation(&mut self.g, &still);
        let offset = self.mechanism.tree.origin(&mut self.g, &still);
        if back {
            // The travel lies on the axis of the turn, so it needs no turning back.
            cycle.push(Segment::Fixed { rotation: rotation.transpose(), offset: -offset });
        } else {
            cycle.push(Segment::Fixed { rotation, offset });
        }
    }

    /// The motions of what closes the loop, from its parent frame to its child frame.
    fn closing_motions(&mut self, kind: &JointKind, cycle: &mut Vec<Segment>) {
        let mut axes: Vec<(constants::Axis, Option<Scalar>, bool)> = Vec::new();
        match kind {
            JointKind::Fixed | JointKind::Free(_) => {}
            JointKind::Revolute { axis } => axes.push((self.axis(axis), None, true)),
            JointKind::Prismatic { axis } => axes.push((self.axis(axis), None, false)),
            JointKind::Screw { axis, pitch } => {
                let pitch = self.scalar(pitch);
                axes.push((self.axis(axis), Some(pitch), true));
            }
            JointKind::Cylindrical { axis } => {
                let axis = self.axis(axis);
                axes.extend([(axis, None, false), (axis, None, true)]);
            }
            JointKind::Universal { axes: pair } => {
                axes.extend(pair.each_ref().map(|axis| (self.axis(axis), None, true)));
            }
            JointKind::Planar { axis } => {
                let axis = self.axis(axis);
                let along = |k: usize| constants::Axis { index: (axis.index + k) % 3, flipped: false, ..axis };
                axes.extend([(along(1), None, false), (along(2), None, false), (axis, None, true)]);
            }
            JointKind::Ball(_) => cycle.push(self.unwanted(Motion::Ball([Scalar::ZERO; 4]), 0)),
        }
        for (number, (axis, pitch, turns)) in axes.into_iter().enumerate() {
            let motion = match (pitch, turns) {
                (Some(pitch), _) => Motion::Screw(axis.index, pitch),
                (None, true) => Motion::Revolute(axis.index),
                (None, false) => Motion::Prismatic(axis.index),
            };
            let place = |rotation| Segment::Fixed { rotation, offset: Vector::ZERO };
            cycle.push(place(axis.turn));
            cycle.push(self.unwanted(motion, number));
            cycle.push(place(axis.turn.transpose()));
        }
    }

    /// An unknown that nobody asks for.
    fn unwanted(&self, motion: Motion, number: usize) -> Segment {
        Segment::Unknown { motion, symbol: self.symbols.unwanted(number), wanted: false }
    }
}

fn same(a: &[Vec<f64>], b: &[Vec<f64>], count: usize) -> bool {
    a.iter().zip(b).all(|(x, y)| x.iter().zip(y).take(count).all(|(x, y)| (x - y).abs() <= 1e-9 * (1.0 + x.abs())))
}

/// Random, between 0 and 1.
fn unit(draw: u64, key: u64) -> f64 {
    (mix(mix(draw ^ 0x5A17) ^ key) >> 11) as f64 / (1_u64 << 53) as f64
}

fn complaint(item: &Solve, message: String, help: &str) -> Vec<Complaint> {
    vec![Complaint { span: item.span, message, help: Some(help.to_owned()) }]
}

fn not_found(item: &Solve, failure: &Failure) -> Vec<Complaint> {
    complaint(
        item,
        format!("no closed form was found for this loop: {failure}"),
        "leave the `solve` item out to have the loop solved by Newton's method, or write the solution yourself: \
         `solve (a, b) = (.., ..);`",
    )
}
