//! Stage `mechanics`: whether equations that were kept are enough wherever the mechanism goes.
//!
//! In: a model with its structure, the axes that its loops are written in. Out: how steady what was kept is, which equations that were left
//! out are needed at some poses, and a better choice if there is one. An equation that is left out is a combination of kept ones at every closed
//! pose, and its coefficients change with the pose. Where one has a pole, kept equations depend on each other though all of
//! them together do not: a planar loop that turns against the axes of its equations has one where its plane stands upright. Near there
//! accelerations lose their digits, as one over the square of the distance, and at the pole itself a motion seems free that is not.
//!
//! The coefficients, with a one for the equation itself, are the direction of a line, and that is smooth where coefficients have poles
//! (homogeneous coordinates). The component of the equation itself in the unit vector along the line is its *share*: one where kept equations say
//! nothing like it, zero at a pole. If shares are not the same at all poses that are known, lines are followed along motions, in steps that are halved
//! where a line turns fast or a share is small. Then the equation takes the place of the kept one that has the greatest coefficient at the pole: of all
//! exchanges that one leaves most of what the rows span. So it goes on until no equation has a pole, or a choice comes again.

use std::collections::HashSet;

use crate::mechanics::loops::constraints::Writing;
use crate::mechanics::loops::structure::{Means, Role, Row, Structure};
use crate::model::types::{LoopClosure, Model};

use super::configurations::Search;
use super::problem::{Point, Problem, Random, Source};
use super::rank::{self, Basis};
use super::singular::dot;
use super::tape::Values;
use super::{CoupledRows, groups, row_of};

/// As steady what is kept should be: of two choices one that is not is looked at later. Of planar loops, the least share was 0.7 of the greatest and more
/// in axes that go with the plane, 0.25 and less in others.
pub(super) const STEADY: f64 = 0.5;
/// Shares that are the same at all poses differ by less.
const CONSTANT: f64 = 1.0 - 1e-6;
/// A share below this is that of a pole near by: coefficients above 50.
const POLE: f64 = 0.02;
/// Motions that are followed, each both ways, from the first closed poses; fewer of groups with more equations than `LARGE`.
const MOTIONS: usize = 6;
const FEW: usize = 2;
const LARGE: usize = 30;
/// Steps of each, and the most that a coordinate moves in one. [rad, sizes]
const STEPS: usize = 30;
const STEP: f64 = 0.2;
/// The time of a step, where it has a say. [s]
const PERIOD: f64 = 0.2;
/// Steps are halved as often at most, where a line turns by more than this (cosine).
const HALVINGS: usize = 7;
const CLEAR: f64 = 0.94;
/// They are halved down to this number where a share is below that.
const COARSE: usize = 4;
const NEAR: f64 = 0.1;
/// Choices that are looked at, for each equation that was left out.
const CHOICES: usize = 6;
/// Slopes below this, in units of the equation, are those of rounding.
const ROUNDING: f64 = 1e-7;

/// The least over the greatest share of any equation that was left out, at the closed poses; one where none was, and where nothing is known.
pub(super) fn steadiness(model: &Model, structure: &Structure, writing: Writing) -> f64 {
    let problem = Problem::written(model, writing);
    let groups = Judged::groups(&problem, structure);
    groups.iter().map(Judged::steadiness).fold(1.0, f64::min)
}

/// Equations that were left out and are needed at some poses.
pub(super) fn needed(model: &Model, structure: &Structure, writing: Writing) -> Vec<Row> {
    let problem = Problem::written(model, writing);
    Judged::groups(&problem, structure).iter().flat_map(Judged::needed).collect()
}

/// Equations that are enough in place of those that were kept, by what motions tell.
pub(super) fn enough(model: &Model, structure: &Structure, writing: Writing) -> Option<Vec<Row>> {
    let problem = Problem::written(model, writing);
    let enough: Option<Vec<Vec<Row>>> = Judged::groups(&problem, structure).iter().map(Judged::enough).collect();
    enough.map(|groups| groups.concat())
}

/// Equations of one group that have to be independent, and those that were left out.
struct Judged<'p> {
    problem: &'p Problem,
    group: CoupledRows,
    kept: Vec<Row>,
    left_out: Vec<Row>,
    /// In the problem: kept ones, formulas and couplings, those that were left out.
    equations: Vec<usize>,
    /// By column: whether no drive moves it.
    free: Vec<bool>,
    /// By equation, one over the longest gradient at any pose. One scale for all: what vanishes at a pose counts for nothing there.
    scales: Vec<f64>,
    poses: Vec<Point>,
}

/// By equation that was left out, in the order of a choice, the line of its coefficients; nothing where others don't give it.
type Lines = Vec<Option<Vec<f64>>>;

/// A step of a motion: where it begins, by how much columns and the time move in it before loops are closed again, where it ends.
struct Step {
    from: Point,
    way: Vec<f64>,
    time: f64,
    to: Point,
}

/// A choice of equations, by place: kept ones first, then formulas and couplings, then those that are left out.
type Order = Vec<usize>;

impl<'p> Judged<'p> {
    /// Those in which something is kept and something is left out.
    fn groups(problem: &'p Problem, structure: &Structure) -> Vec<Judged<'p>> {
        if structure.dropped.is_empty() || structure.closed.is_empty() {
            return Vec::new();
        }
        let kept: HashSet<Row> = structure.rows.iter().chain(iterated(structure)).copied().collect();
        let coupled: HashSet<LoopClosure> = structure.steps.iter().filter_map(|step| coupling(&step.means)).collect();
        let free = problem.columns.iter().map(|one| !matches!(structure.role(one.coordinate), Role::Driven(_)));
        let free: Vec<bool> = free.collect();
        let poses: Vec<Point> = structure.closed.iter().map(|closed| problem.at(&closed.positions)).collect();
        let judged = |group: CoupledRows| {
            let of = |is: &dyn Fn(usize) -> bool| -> Vec<usize> {
                group.equations.iter().copied().filter(|&k| is(k)).collect()
            };
            let row = |k: usize| row_of(problem, k);
            let of_kept = of(&|k| row(k).is_some_and(|row| kept.contains(&row)));
            let left_out = of(&|k| row(k).is_some_and(|row| structure.dropped.contains(&row) && !kept.contains(&row)));
            let given = of(&|k| match problem.equations[k].source {
                Source::Row(row) => coupled.contains(&row.closing),
                Source::Formula(..) => structure.rows.is_empty(),
            });
            let rows = |list: &[usize]| list.iter().filter_map(|&k| row(k)).collect::<Vec<Row>>();
            let (kept, rows_left_out) = (rows(&of_kept), rows(&left_out));
            let equations = [of_kept, given, left_out].concat();
            let scales = vec![1.0; equations.len()];
            let (free, poses) = (free.clone(), poses.clone());
            let left_out = rows_left_out;
            Judged { problem, group, kept, left_out, equations, free, scales, poses }.scaled()
        };
        let all = groups(problem, &[]).into_iter().map(judged);
        all.filter(|one| !one.kept.is_empty() && !one.left_out.is_empty()).collect()
    }

    fn scaled(mut self) -> Self {
        let mut longest = vec![0.0_f64; self.equations.len()];
        let mut values = Values::default();
        for pose in &self.poses {
            for (longest, row) in longest.iter_mut().zip(self.slopes(pose, &mut values)) {
                *longest = longest.max(dot(&row, &row).sqrt());
            }
        }
        self.scales = longest.iter().map(|&length| if length > ROUNDING { 1.0 / length } else { 0.0 }).collect();
        self
    }

    fn as_found(&self) -> Order {
        (0..self.equations.len()).collect()
    }

    fn steadiness(&self) -> f64 {
        let mut spread = vec![(f64::INFINITY, 0.0_f64); self.left_out.len()];
        let mut values = Values::default();
        for pose in &self.poses {
            let lines = self.lines(pose, &self.as_found(), &mut values);
            for ((least, greatest), line) in spread.iter_mut().zip(lines) {
                let share = line.map_or(0.0, |line| line[0]);
                (*least, *greatest) = (least.min(share), greatest.max(share));
            }
        }
        // What no kept equations give anywhere doesn't follow from them.
        let shares = spread.iter().map(|&(least, greatest)| if greatest > 0.0 { least / greatest } else { 0.0 });
        shares.fold(1.0, f64::min)
    }

    /// Whether time has a say: poses are all those of time zero.
    fn is_timed(&self) -> bool {
        self.group.equations.iter().any(|&k| self.problem.equations[k].timed)
    }

    /// Whether shares are the same at all poses.
    fn is_constant(&self) -> bool {
        !self.is_timed() && self.steadiness() > CONSTANT
    }

    fn needed(&self) -> Vec<Row> {
        if self.is_constant() {
            return Vec::new();
        }
        let poles = self.poles(&self.motions(), &self.as_found());
        self.left_out.iter().zip(poles).filter(|one| one.1.is_some()).map(|one| *one.0).collect()
    }

    /// What is kept already where it is enough.
    fn enough(&self) -> Option<Vec<Row>> {
        if self.is_constant() {
            return Some(self.kept.clone());
        }
        let (motions, mut order) = (self.motions(), self.as_found());
        let first = self.equations.len() - self.left_out.len();
        let mut seen: HashSet<Vec<usize>> = HashSet::new();
        for _ in 0..CHOICES * self.left_out.len() {
            seen.insert(self.chosen(&order));
            let poles = self.poles(&motions, &order);
            if poles.iter().all(Option::is_none) {
                return Some(
                    self.chosen(&order).into_iter().filter_map(|k| row_of(self.problem, self.equations[k])).collect(),
                );
            }
            let exchanged = poles.iter().enumerate().filter_map(|(k, pole)| {
                let mut next = order.clone();
                next.swap(first + k, (*pole)?);
                Some(next)
            });
            order = exchanged.into_iter().find(|next| !seen.contains(&self.chosen(next)))?;
        }
        None
    }

    /// Places of what is kept.
    fn chosen(&self, order: &Order) -> Vec<usize> {
        let mut chosen = order[..self.kept.len()].to_vec();
        chosen.sort_unstable();
        chosen
    }

    /// Rows of slopes of all equations.
    fn slopes(&self, point: &Point, values: &mut Values) -> Vec<Vec<f64>> {
        let at = self.problem.linearise(point, &self.equations, values);
        let rows = at.rows.iter().zip(&self.scales).map(|(row, scale)| {
            let mut dense = self.problem.dense_row(row);
            dense.iter_mut().zip(&self.free).for_each(|(x, &free)| *x *= if free { *scale } else { 0.0 });
            self.group.columns.iter().map(|&column| dense[column]).collect()
        });
        rows.collect()
    }

    fn lines(&self, point: &Point, order: &Order, values: &mut Values) -> Lines {
        let slopes = self.slopes(point, values);
        let rows: Vec<Vec<f64>> = order.iter().map(|&k| slopes[k].clone()).collect();
        let first = rows.len() - self.left_out.len();
        let mut lines = vec![None; self.left_out.len()];
        for combination in rank::combinations(&rows) {
            // The last of a combination is what follows from the others.
            let last = combination.iter().rposition(|&x| x != 0.0);
            let Some(slot) = last.and_then(|last| lines.get_mut(last.checked_sub(first)?)) else { continue };
            let mut line = vec![1.0];
            line.extend(&combination[..self.kept.len()]);
            let length = dot(&line, &line).sqrt();
            line.iter_mut().for_each(|x| *x /= length);
            *slot = Some(line);
        }
        lines
    }

    /// Motions from closed poses. What is driven moves as all else does: at some time it will be there.
    fn motions(&self) -> Vec<Vec<Step>> {
        let mut random = Random(0x57EAD);
        let count = if self.group.equations.len() > LARGE { FEW } else { MOTIONS };
        let mut motions = Vec::new();
        for pose in self.poses.iter().cycle().take(count) {
            let towards: Vec<f64> = self.group.columns.iter().map(|_| random.next()).collect();
            for sign in [1.0, -1.0] {
                motions.push(self.motion(pose, towards.iter().map(|x| sign * x).collect()));
            }
        }
        motions
    }

    /// One motion, until it comes to an end.
    fn motion(&self, pose: &Point, mut towards: Vec<f64>) -> Vec<Step> {
        let CoupledRows { equations, columns } = &self.group;
        let search = Search::new(self.problem, equations, columns);
        let (mut values, mut from, mut steps) = (Values::default(), pose.clone(), Vec::new());
        let time = if self.is_timed() { PERIOD * towards.first().map_or(1.0, |x| x.signum()) } else { 0.0 };
        for _ in 0..STEPS {
            let mut allowed = Basis::default();
            for row in search.jacobian_at(&from, &mut values) {
                allowed.grow(&row, rank::DEPENDENT);
            }
            towards = allowed.rest(&towards);
            let most = towards.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            // What time alone moves goes on.
            if most < 1e-6 && time == 0.0 {
                break;
            }
            towards.iter_mut().for_each(|x| *x *= STEP / most.max(1e-6));
            let mut way = vec![0.0; self.problem.columns.len()];
            columns.iter().zip(&towards).for_each(|(&column, x)| way[column] = *x);
            let mut step = Step { from: from.clone(), way, time, to: from };
            let Some(to) = self.moved(&search, &step, 1.0, &mut values) else { break };
            step.to = to.clone();
            steps.push(step);
            from = to;
        }
        steps
    }

    /// A part of a step.
    fn moved(&self, search: &Search<'_>, step: &Step, part: f64, values: &mut Values) -> Option<Point> {
        let mut point = step.from.clone();
        let way: Vec<f64> = step.way.iter().map(|x| part * x).collect();
        self.problem.displace(&mut point, &way);
        if let Some(time) = self.problem.time_at(&step.from) {
            self.problem.put_time(&mut point, time + part * step.time);
        }
        search.close(&mut point, values).then_some(point)
    }

    /// By equation that is left out, if it has a pole, the place of the kept one that has the greatest coefficient there. The first motion that meets
    /// any is the last.
    fn poles(&self, motions: &[Vec<Step>], order: &Order) -> Vec<Option<usize>> {
        let search = Search::new(self.problem, &self.group.equations, &self.group.columns);
        let mut values = Values::default();
        let mut poles = Poles(vec![None; self.left_out.len()]);
        for motion in motions {
            let Some(first) = motion.first() else { continue };
            let mut before = self.lines(&first.from, order, &mut values);
            poles.look(&before);
            for step in motion {
                let after = self.lines(&step.to, order, &mut values);
                poles.look(&after);
                // Places of a step that are still to be compared with each other.
                let mut open = vec![(0.0, before, 1.0, after.clone(), HALVINGS)];
                while let Some((a, of_a, b, of_b, halvings)) = open.pop() {
                    let middle = 0.5 * (a + b);
                    let halved = (halvings > 0 && poles.is_open(&of_a, &of_b, halvings > COARSE))
                        .then(|| self.moved(&search, step, middle, &mut values));
                    if let Some(point) = halved.flatten() {
                        let lines = self.lines(&point, order, &mut values);
                        poles.look(&lines);
                        open.push((a, of_a, middle, lines.clone(), halvings - 1));
                        open.push((middle, lines, b, of_b, halvings - 1));
                    } else {
                        poles.compare(&of_a, &of_b);
                    }
                }
                before = after;
            }
            if poles.0.iter().any(Option::is_some) {
                break;
            }
        }
        poles.0
    }
}

/// By equation that is left out, the place of the kept one that has the greatest coefficient at a pole.
struct Poles(Vec<Option<usize>>);

impl Poles {
    /// At one pose.
    fn look(&mut self, lines: &Lines) {
        for (pole, line) in self.0.iter_mut().zip(lines) {
            if let Some(line) = line.as_ref().filter(|line| line[0].abs() < POLE) {
                *pole = pole.or(greatest(line));
            }
        }
    }

    /// Whether it is not known what is between two poses; if they are `far`, small shares are looked at, too.
    fn is_open(&self, before: &Lines, after: &Lines, far: bool) -> bool {
        let mut pairs = self.0.iter().zip(before.iter().zip(after));
        pairs.any(|(pole, pair)| match pair {
            (Some(a), Some(b)) if pole.is_none() => dot(a, b).abs() < CLEAR || far && a[0].abs().min(b[0].abs()) < NEAR,
            _ => false,
        })
    }

    /// A share that has changed its sign, where the line is known to be the same one.
    fn compare(&mut self, before: &Lines, after: &Lines) {
        for (pole, pair) in self.0.iter_mut().zip(before.iter().zip(after)) {
            let (Some(a), Some(b)) = pair else { continue };
            let turn = dot(a, b);
            if turn.abs() >= CLEAR && turn * a[0] * b[0] < 0.0 {
                *pole = pole.or(greatest(if a[0].abs() < b[0].abs() { a } else { b }));
            }
        }
    }
}

/// The place of the greatest coefficient of a line.
fn greatest(line: &[f64]) -> Option<usize> {
    let coefficients = line[1..].iter().map(|x| x.abs()).enumerate();
    coefficients.max_by(|a, b| a.1.total_cmp(&b.1)).map(|one| one.0)
}

/// Equations that Newton's method solves.
fn iterated(structure: &Structure) -> impl Iterator<Item = &Row> {
    structure.steps.iter().flat_map(|step| match &step.means {
        Means::Newton { rows, .. } => rows.as_slice(),
        Means::Linear(_) | Means::Explicit(_) | Means::Solve(_) => &[],
    })
}

/// The coupling that gives an unknown.
fn coupling(means: &Means) -> Option<LoopClosure> {
    match means {
        Means::Linear(id) | Means::Explicit(id) => Some(LoopClosure::Constraint(*id)),
        Means::Solve(_) | Means::Newton { .. } => None,
    }
}
