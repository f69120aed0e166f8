//! Stage `mechanics`: whether equations that were kept are enough wherever the mechanism goes.
//!
//! In: a model with its structure, the axes that its loops are written in. Out: how steady what was kept is, and which equations that were left
//! out are needed at some poses, with a better choice if there is one. An equation that is left out is a combination of kept ones at every closed pose, and what coefficients it has
//! changes with the pose. Where some have a pole, kept equations depend on each other though all of them together do not: a planar
//! loop that turns against the axes of its equations has one where its plane stands upright. Near there accelerations lose their digits, as one over the
//! square of the distance, and at the pole itself a motion is free that is none.
//!
//! Coefficients and the equation itself, which counts one, are a line through the origin, and its direction is smooth where coefficients have poles
//! (homogeneous coordinates). What the equation itself has of the unit vector along it is its share: one where kept equations say nothing like it, zero at a
//! pole. Poses at random tell whether shares are much the same everywhere; if they are not, the line is followed along motions, and a pole is where the share
//! changes its sign. An equation with a pole is exchanged for the kept one that has the greatest coefficient there, which makes as much of the volume
//! that all span, until none has a pole or a choice comes again.

use crate::mechanics::loops::constraints::Writing;
use crate::mechanics::loops::structure::{Means, Role, Row, Structure};
use crate::model::types::{Coordinate, JointId, Model};

use super::configurations::Search;
use super::problem::{Point, Problem, Random};
use super::rank::{self, Basis};
use super::singular::dot;
use super::tape::Values;

/// As steady what is kept has to be for nobody to look any further. Of planar loops, the least share was 0.7 of the greatest and more in axes that go with the
/// plane, 0.25 and less in others.
pub(super) const STEADY: f64 = 0.5;
/// Motions that are followed, each both ways, from the first closed poses; fewer of mechanisms with more equations than `LARGE`.
const MOTIONS: usize = 8;
const FEW: usize = 2;
const LARGE: usize = 60;
/// Steps of each, and the most that a coordinate moves in one. [rad, sizes]
const STEPS: usize = 40;
const STEP: f64 = 0.15;
/// A line that turns by more than this in a step is not known to be the same one: cosine.
const SAME: f64 = 0.7;
/// Choices that are looked at, for each equation that was left out.
const CHOICES: usize = 6;

/// What motions tell.
pub(super) struct Everywhere {
    /// Equations that were left out and are needed at some poses.
    pub needed: Vec<Row>,
    /// If there are any, equations that are enough at all poses in place of those that were kept.
    pub enough: Option<Vec<Row>>,
}

/// The least over the greatest share of any equation that was left out, at the closed poses; one where none was, and where nothing is known.
pub(super) fn steadiness(model: &Model, structure: &Structure, writing: Writing) -> f64 {
    let Some(judged) = Judged::new(model, structure, writing) else { return 1.0 };
    let order: Vec<usize> = (0..judged.rows.len()).collect();
    let mut spread = vec![(f64::INFINITY, 0.0_f64); judged.left_out()];
    let mut values = Values::default();
    for pose in &judged.poses {
        for ((least, greatest), line) in spread.iter_mut().zip(judged.lines(&judged.slopes(pose, &mut values), &order))
        {
            let share = line.map_or(0.0, |line| line[0]);
            (*least, *greatest) = (least.min(share), greatest.max(share));
        }
    }
    // What no kept equations give anywhere doesn't follow from them.
    let shares = spread.iter().map(|&(least, greatest)| if greatest > 0.0 { least / greatest } else { 0.0 });
    shares.fold(1.0, f64::min)
}

/// Looks for poles along motions.
pub(super) fn everywhere(model: &Model, structure: &Structure, writing: Writing) -> Everywhere {
    let mut found = Everywhere { needed: Vec::new(), enough: None };
    let Some(judged) = Judged::new(model, structure, writing) else { return found };
    let motions = judged.motions();
    let mut order: Vec<usize> = (0..judged.rows.len()).collect();
    let first = judged.rows.len() - judged.left_out();
    let mut seen: Vec<Vec<usize>> = Vec::new();
    for number in 0..CHOICES * judged.left_out() {
        let poles = judged.poles(&motions, &order);
        if number == 0 {
            let needed = poles.iter().enumerate().filter(|one| one.1.is_some());
            found.needed = needed.map(|(k, _)| judged.rows[first + k]).collect();
        }
        let kept = |order: &[usize]| {
            let mut kept = order[..judged.kept].to_vec();
            kept.sort_unstable();
            kept
        };
        seen.push(kept(&order));
        let exchanges = poles.iter().enumerate().filter_map(|(k, kept)| Some((first + k, (*kept)?)));
        let exchanged = |(a, b): (usize, usize)| {
            let mut order = order.clone();
            order.swap(a, b);
            order
        };
        if poles.iter().all(Option::is_none) {
            found.enough = (number > 0).then(|| kept(&order).into_iter().map(|k| judged.rows[k]).collect());
            break;
        }
        let Some(next) = exchanges.map(exchanged).find(|order| !seen.contains(&kept(order))) else { break };
        order = next;
    }
    found
}

/// Equations that have to be independent, and those that were left out.
struct Judged {
    problem: Problem,
    /// Kept ones, those that formulas solve, those that were left out.
    rows: Vec<Row>,
    /// The same in the problem.
    equations: Vec<usize>,
    kept: usize,
    solved: usize,
    /// By column: whether no drive moves it.
    free: Vec<bool>,
    /// By equation, one over the longest gradient at any pose. One scale for all: what vanishes at a pose counts for nothing there.
    scales: Vec<f64>,
    poses: Vec<Point>,
}

/// Rows of slopes of all equations at one pose.
type Slopes = Vec<Vec<f64>>;
/// By equation that was left out the line of its coefficients; nothing where kept ones don't give it.
type Lines = Vec<Option<Vec<f64>>>;

impl Judged {
    /// Nothing where nothing is left out, or no pose is known.
    fn new(model: &Model, structure: &Structure, writing: Writing) -> Option<Judged> {
        let kept = kept(structure);
        if kept.is_empty() || structure.dropped.is_empty() || structure.closed.is_empty() {
            return None;
        }
        let problem = Problem::written(model, writing);
        let solved: Vec<Row> = structure.independent.iter().copied().filter(|row| !kept.contains(row)).collect();
        let known = |rows: &[Row]| {
            let known = rows.iter().filter_map(|row| Some((*row, problem.equation_of(*row)?)));
            known.collect::<Vec<(Row, usize)>>()
        };
        let [kept, solved, left_out] = [known(&kept), known(&solved), known(&structure.dropped)];
        let (of_kept, of_solved) = (kept.len(), solved.len());
        let (rows, equations): (Vec<Row>, Vec<usize>) = [kept, solved, left_out].concat().into_iter().unzip();
        let moved = moved(structure);
        let free = problem.columns.iter().map(|column| moved.contains(&column.coordinate)).collect();
        let poses = structure.closed.iter().map(|closed| problem.at(&closed.positions)).collect();
        let scales = vec![1.0; equations.len()];
        let mut judged = Judged { problem, rows, equations, kept: of_kept, solved: of_solved, free, scales, poses };
        judged.scale();
        Some(judged)
    }

    fn scale(&mut self) {
        let mut longest = vec![0.0_f64; self.equations.len()];
        let mut values = Values::default();
        for pose in &self.poses {
            for (longest, row) in longest.iter_mut().zip(self.slopes(pose, &mut values)) {
                *longest = longest.max(dot(&row, &row).sqrt());
            }
        }
        self.scales = longest.iter().map(|&length| if length > 0.0 { 1.0 / length } else { 0.0 }).collect();
    }

    fn left_out(&self) -> usize {
        self.rows.len() - self.kept - self.solved
    }

    fn slopes(&self, point: &Point, values: &mut Values) -> Slopes {
        let at = self.problem.linearise(point, &self.equations, values);
        let rows = at.rows.iter().zip(&self.scales).map(|(row, scale)| {
            let mut dense = self.problem.dense_row(row);
            dense.iter_mut().zip(&self.free).for_each(|(x, &free)| *x *= if free { *scale } else { 0.0 });
            dense
        });
        rows.collect()
    }

    /// With equations in some order, kept ones first, then those that formulas solve.
    fn lines(&self, slopes: &Slopes, order: &[usize]) -> Lines {
        let first = self.kept + self.solved;
        let mut lines = vec![None; self.left_out()];
        let rows: Slopes = order.iter().map(|&k| slopes[k].clone()).collect();
        for combination in rank::combinations(&rows) {
            // The last of a combination is what follows from the others.
            let last = combination.iter().rposition(|&x| x != 0.0);
            let Some(slot) = last.and_then(|last| lines.get_mut(last.checked_sub(first)?)) else { continue };
            let mut line = vec![1.0];
            line.extend(&combination[..self.kept]);
            let length = dot(&line, &line).sqrt();
            line.iter_mut().for_each(|x| *x /= length);
            *slot = Some(line);
        }
        lines
    }

    /// Slopes along motions from closed poses, each until it comes to an end.
    fn motions(&self) -> Vec<Vec<Slopes>> {
        let mut random = Random(0x57EAD);
        let count = if self.problem.equations.len() > LARGE { FEW } else { MOTIONS };
        let mut motions = Vec::new();
        for pose in self.poses.iter().cycle().take(count) {
            let towards: Vec<f64> = self.free.iter().map(|&free| if free { random.next() } else { 0.0 }).collect();
            for sign in [1.0, -1.0] {
                motions.push(self.motion(pose.clone(), towards.iter().map(|x| sign * x).collect()));
            }
        }
        motions
    }

    fn motion(&self, mut point: Point, mut towards: Vec<f64>) -> Vec<Slopes> {
        let equations: Vec<usize> = (0..self.problem.equations.len()).collect();
        let columns: Vec<usize> = (0..self.problem.columns.len()).collect();
        let held: Vec<bool> = self.free.iter().map(|free| !free).collect();
        let search = Search::new(&self.problem, &equations, &columns).holding(&held);
        let mut values = Values::default();
        let mut motion = vec![self.slopes(&point, &mut values)];
        for _ in 0..STEPS {
            let mut allowed = Basis::default();
            for row in motion.last().into_iter().flatten() {
                allowed.grow(row, rank::DEPENDENT);
            }
            towards = allowed.rest(&towards);
            let most = towards.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if most < 1e-6 {
                break;
            }
            towards.iter_mut().for_each(|x| *x *= STEP / most);
            self.problem.displace(&mut point, &towards);
            if !search.close(&mut point, &mut values) {
                break;
            }
            motion.push(self.slopes(&point, &mut values));
        }
        motion
    }

    /// By equation that is left out, if it has a pole, the place of the kept one that has the greatest coefficient there.
    fn poles(&self, motions: &[Vec<Slopes>], order: &[usize]) -> Vec<Option<usize>> {
        let mut poles = vec![None; self.left_out()];
        for motion in motions {
            let mut before: Lines = vec![None; poles.len()];
            for slopes in motion {
                for ((before, now), pole) in before.iter_mut().zip(self.lines(slopes, order)).zip(&mut poles) {
                    *before = now.map(|now| {
                        let Some(before) = before else { return now };
                        let turn = dot(before, &now);
                        let now: Vec<f64> = now.iter().map(|x| x * turn.signum()).collect();
                        if turn.abs() > SAME && now[0] * before[0] < 0.0 {
                            let coefficients = now[1..].iter().map(|x| x.abs()).enumerate();
                            *pole = pole.or(coefficients.max_by(|a, b| a.1.total_cmp(&b.1)).map(|one| one.0));
                        }
                        now
                    });
                }
            }
        }
        poles
    }
}

/// Equations that have to be independent: those with multipliers, and those that Newton's method solves.
fn kept(structure: &Structure) -> Vec<Row> {
    let mut kept = structure.rows.clone();
    for step in &structure.steps {
        if let Means::Newton { rows, .. } = &step.means {
            kept.extend(rows);
        }
    }
    kept
}

/// Coordinates that no drive gives.
fn moved(structure: &Structure) -> Vec<Coordinate> {
    let joints = structure.roles.iter().enumerate();
    let all = joints.flat_map(|(joint, roles)| {
        let coordinate = move |index: usize| Coordinate { joint: JointId(joint), index };
        let free = roles.iter().enumerate().filter(|(_, role)| !matches!(role, Role::Driven(_)));
        free.map(move |(index, _)| coordinate(index))
    });
    all.collect()
}
