//! Stage `mechanics`: outputs that depend on how loops share their loads.
//!
//! In: a model with its structure, how its loops are written; where equations depend on each other and outputs read reactions. Out: complaints about
//! what rigid bodies don't determine. Self-stress ([`super::statics`]) moves nothing, and no equation tells of it. An output is
//! determined if none changes it. If some does, the output still means something where the loads of every joint stand across
//! those of self-stress, force to force and moment to moment: of the elastic energy of joints in these, nothing is
//! mixed then if each joint gives way alike in all directions, and it is least without any self-stress, however stiff one joint is beside another.
//! So it is for the hinges of a planar loop that is loaded in its plane, whose mirror image it is: what carries nothing in truth is zero. All else
//! would be what the choice of equations makes of it. Loads and outputs that are made of pieces (`max`, `select`) are looked at with some of
//! each piece: what acts only beyond a stop would else be missed.

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::loops::constraints::{Writing, closing_name, row_name};
use crate::mechanics::loops::structure::{Row, Structure};
use crate::mechanics::translate::dependencies::Dependencies;
use crate::mechanics::translate::manipulations::holds;
use crate::model::site::{Site, Sited};
use crate::model::types::{ConstraintId, Expr, ExprNode, JointId, LoopClosure, Model, Output};

use super::Complaint;
use super::configurations::Search;
use super::problem::{Point, Problem, Random};
use super::rank::Basis;
use super::rates::{LATE, OFF};
use super::singular::add;
use super::statics::{Sample, Statics, Wrenches, difference, greatest};
use super::tape::Values;

/// As many closed poses are looked at, and as many of mechanisms with more freedoms and equations than `LARGE`.
const POSES: usize = 4;
const FEW: usize = 2;
const LARGE: usize = 100;
/// How far further ones are looked for from where coordinates stand by default.
const AMPLITUDES: [f64; 8] = [0.1, 0.1, 0.2, 0.2, 0.4, 0.4, 0.8, 0.8];
/// Beside all terms that a change is made of, and beside the greatest load.
const NOTHING: f64 = 1e-7;
/// Of a value that is made of much else.
const DIGITS: f64 = 1e-11;
/// Beside all terms that a change would be made of where nothing is closed.
const ROUNDING: f64 = 1e-9;

/// Self-stress: joints that it loads, and equations that hold it.
#[derive(Default)]
struct Open {
    joints: HashSet<usize>,
    rows: Vec<Row>,
}

/// Outputs that read reactions or multipliers, where equations may depend on each other.
fn asked<'m>(model: &'m Model, structure: &Structure) -> Vec<&'m Output> {
    let certain = structure.dropped.is_empty() && structure.wavering.is_empty() && !structure.redundant;
    let reads = |output: &&Output| {
        let needs = Dependencies::of(std::iter::once(&output.value));
        needs.multipliers || !needs.reactions().is_empty()
    };
    // What reads a multiplier that others share is refused when outputs are derived.
    let is_told = |output: &&Output| {
        let shared =
            |row: &Row| matches!(row.closing, LoopClosure::Constraint(id) if reads_multiplier(&output.value, id));
        structure.shared.iter().any(shared)
    };
    if certain { Vec::new() } else { model.outputs.iter().filter(|one| reads(one) && !is_told(one)).collect() }
}

/// Outputs that the mechanism doesn't determine, with loops in the axes of `writing`.
pub(super) fn complaints(model: &Model, structure: &Structure, writing: Writing) -> Vec<Complaint> {
    let outputs = asked(model, structure);
    if outputs.is_empty() {
        return Vec::new();
    }
    let problem = Problem::written(model, writing);
    let poses = poses(model, &problem, structure);
    let sampled = |blends: bool| {
        let mut statics = Statics::new(model, structure, writing, &outputs, blends);
        let mut random = Random(0x57E55);
        let samples: Vec<Sample> =
            poses.iter().filter_map(|point| statics.sample(&problem, point, &mut random)).collect();
        (statics, samples)
    };
    let (mut statics, mut samples) = sampled(true);
    if samples.is_empty() {
        // The root of a blend may have no value.
        (statics, samples) = sampled(false);
    }
    let mut found = Vec::new();
    for (number, output) in outputs.iter().enumerate() {
        let open = match samples.is_empty() {
            // Nothing is known of it.
            true => Some(Open::default()),
            false => samples
                .iter()
                .filter(|sample| is_typical(sample, &samples))
                .find_map(|sample| statics.open(sample, number)),
        };
        found.extend(open.map(|open| complaint(model, structure, output, &open)));
    }
    found
}

/// The same in other axes than the structure was found in.
pub(in super::super) fn are_determined(model: &Model, structure: &Structure, writing: Writing) -> bool {
    complaints(model, structure, writing).is_empty()
}

/// Closed poses. Those that the structure knows have the greatest rank, stand at time zero, and what is in no loop stands at its default in the
/// first; so others are looked for: of other branches, such as that on which a coupler moves on three parallel bars, at other times, and with
/// other parameters, where the loops close with these.
fn poses(model: &Model, problem: &Problem, structure: &Structure) -> Vec<Point> {
    let size = problem.columns.len() + problem.equations.len();
    let (known, further) = if size > LARGE { (FEW, FEW) } else { (POSES, AMPLITUDES.len()) };
    let mut poses: Vec<Point> =
        structure.closed.iter().take(known).map(|closed| problem.at(&closed.positions)).collect();
    poses.extend(further_poses(problem, &AMPLITUDES[..further]));
    if problem.is_adjustable() {
        poses.extend(further_poses(&problem.moved(model, OFF), &AMPLITUDES[..further.min(POSES)]));
    }
    poses
}

fn further_poses(problem: &Problem, amplitudes: &[f64]) -> Vec<Point> {
    let equations: Vec<usize> = (0..problem.equations.len()).collect();
    let columns: Vec<usize> = (0..problem.columns.len()).collect();
    let driven = problem.driven_columns();
    let search = Search::new(problem, &equations, &columns).holding(&driven);
    let (mut values, mut random) = (Values::default(), Random(0xB4A2));
    let mut poses = Vec::new();
    for &amplitude in amplitudes {
        let mut point = problem.shaken(&problem.origin(), &mut random, amplitude, &driven);
        problem.put_time(&mut point, LATE * random.next().abs());
        problem.drive(&mut point, &mut values);
        if search.close(&mut point, &mut values) && !problem.locks(&point, &columns) {
            poses.push(point);
        }
    }
    poses
}

/// A pose where all stands in line has self-stress that others don't have.
fn is_typical(sample: &Sample, all: &[Sample]) -> bool {
    let count = |sample: &Sample| sample.stress.len();
    let least = all.iter().map(count).min().unwrap_or(0);
    count(sample) == least || all.iter().filter(|other| count(other) == count(sample)).count() > 1
}

impl Statics {
    /// Self-stress that an output depends on, if there is any and it is not zero in truth.
    fn open(&mut self, sample: &Sample, output: usize) -> Option<Open> {
        let multipliers = &sample.multipliers[0];
        let loads = self.wrenches(sample, multipliers);
        let with = |stress: &[f64]| multipliers.iter().zip(stress).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let all: Vec<usize> = (0..sample.stress.len()).collect();
        let moves = |statics: &mut Statics, &k: &usize| statics.is_moved(sample, &with(&sample.stress[k]), output);
        let mut open: Vec<usize> = all.iter().copied().filter(|k| moves(self, k)).collect();
        if open.is_empty() && all.len() > 1 {
            // A product of loads may be moved by no one stress alone.
            let mut sum = vec![0.0; multipliers.len()];
            for (k, stress) in sample.stress.iter().enumerate() {
                add(&mut sum, 0.4 + (0.618_033_988_749_895 * k as f64).fract(), stress);
            }
            if self.is_moved(sample, &with(&sum), output) {
                open = all;
            }
        }
        let mut stresses: Vec<(&Vec<f64>, Wrenches)> = Vec::new();
        for stress in open.into_iter().map(|k| &sample.stress[k]) {
            stresses.push((stress, difference(&self.wrenches(sample, &with(stress)), &loads)));
        }
        let touched = |(_, wrenches): &(&Vec<f64>, Wrenches)| {
            let most = greatest(wrenches);
            let joints = wrenches.iter().enumerate();
            joints.filter(|one| greatest(&vec![*one.1]) > NOTHING * most).map(|one| one.0).collect::<Vec<_>>()
        };
        let joints: HashSet<usize> = stresses.iter().flat_map(touched).collect();
        let is_zero = |multipliers: &Vec<f64>| {
            let loads = self.wrenches(sample, multipliers);
            // Of what the stress is in: what hangs elsewhere may weigh more.
            let most = greatest(&joints.iter().filter_map(|&joint| loads.get(joint).copied()).collect());
            stands_across(&loads, &stresses, most) && self.bears_nothing(multipliers, &stresses, most)
        };
        let is_open = !stresses.is_empty() && !sample.multipliers.iter().all(is_zero);
        is_open.then(|| Open { rows: strained(&stresses).into_iter().map(|k| self.rows()[k]).collect(), joints })
    }

    /// Whether an output has another value with other multipliers, beyond roundings of what it is made of.
    fn is_moved(&mut self, sample: &Sample, others: &[f64], output: usize) -> bool {
        let multipliers = &sample.multipliers[0];
        let (own, other) = (self.output(sample, multipliers, output), self.output(sample, others, output));
        let step: Vec<f64> = multipliers.iter().zip(others).map(|(a, b)| (a - b).abs()).collect();
        // What is zero at a closed pose, as an axis across an axis, is rounding beside what it is elsewhere.
        let [here, anywhere] = self.bounds(sample, &step, output);
        let least = here.iter().zip(anywhere).map(|(here, anywhere)| NOTHING * here + ROUNDING * anywhere);
        // What has no number tells nothing.
        let differs = |((a, b), least): ((&f64, &f64), f64)| {
            (a - b).is_nan() || (a - b).abs() > least + DIGITS * a.abs().max(b.abs())
        };
        own.iter().zip(&other).zip(least).any(differs)
    }

    /// Whether constraints that hold by no joint, such as rods, bear none of the loads where self-stress has a part of them.
    fn bears_nothing(&self, multipliers: &[f64], stresses: &[(&Vec<f64>, Wrenches)], most: f64) -> bool {
        let strained = strained(stresses);
        let most = strained.iter().fold(most, |most, &k| most.max(multipliers[k].abs()));
        let is_cut = |k: usize| matches!(self.rows()[k].closing, LoopClosure::Cut(_));
        strained.iter().all(|&k| is_cut(k) || multipliers[k].abs() <= NOTHING * most)
    }
}

/// Places of rows that take part in any of self-stress.
fn strained(stresses: &[(&Vec<f64>, Wrenches)]) -> Vec<usize> {
    let takes_part = |stress: &[f64], k: usize| {
        let most = stress.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        stress[k].abs() > NOTHING * most
    };
    let count = stresses.first().map_or(0, |one| one.0.len());
    (0..count).filter(|&k| stresses.iter().any(|(stress, _)| takes_part(stress, k))).collect()
}

/// Whether at each joint force and moment have no part along any of self-stress.
fn stands_across(loads: &Wrenches, stresses: &[(&Vec<f64>, Wrenches)], most: f64) -> bool {
    let strained = stresses.iter().map(|one| greatest(&one.1)).fold(0.0, f64::max);
    (0..loads.len()).all(|joint| {
        (0..2).all(|part| {
            let mut basis = Basis::default();
            for (_, wrenches) in stresses {
                basis.grow(&wrenches[joint][part], NOTHING * strained);
            }
            let load = loads[joint][part];
            let across = basis.rest(&load);
            load.iter().zip(across).all(|(whole, across)| (whole - across).abs() <= NOTHING * most)
        })
    })
}

fn complaint(model: &Model, structure: &Structure, output: &Output, open: &Open) -> Complaint {
    let (joint, at) = first_read(&output.value, &open.joints).unwrap_or_else(|| (None, output.value.site()));
    let what = match joint {
        Some(joint) => format!("a reaction of `{}`", closing_name(model, LoopClosure::Cut(joint))),
        None => format!("the output `{}`", output.place.field),
    };
    let dropped = structure.dropped.iter().filter(|row| open.rows.contains(row));
    let rows: Vec<String> = dropped.map(|row| format!("`{}`", row_name(model, row.closing, row.index))).collect();
    let why = match rows.is_empty() {
        true => "equations of loops depend on each other".to_owned(),
        false => format!("{} follow{} from other equations", rows.join(", "), if rows.len() == 1 { "s" } else { "" }),
    };
    Complaint {
        at,
        message: format!("{what} depends on how loops share their load, which rigid bodies don't determine: {why}"),
        help: Some(
            "read what is determined, such as components in the plane of a loop (`.express(frame)`), or let its joints hold no more than they \
             have to: a loop of four hinges where one is a `Ball` and one is `Cylindrical`"
                .to_owned(),
        ),
    }
}

fn reads_multiplier(value: &Expr, constraint: ConstraintId) -> bool {
    holds(value, |node| matches!(node, ExprNode::Multiplier(id) if *id == constraint))
}

/// The first reaction that is read of some joints.
fn first_read(value: &Expr, joints: &HashSet<usize>) -> Option<(Option<JointId>, Site)> {
    let (mut open, mut seen) = (vec![value], HashSet::new());
    while let Some(expr) = open.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        match &*expr.node {
            ExprNode::Reaction { joint, .. } if joints.contains(&joint.0) => return Some((Some(*joint), expr.site())),
            node => open.extend(node.operands()),
        }
    }
    None
}
