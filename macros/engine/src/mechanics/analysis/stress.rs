//! Stage `mechanics`: outputs that depend on how loops share their loads.
//!
//! In: a model with its structure, how its loops are written; where equations depend on each other and outputs read reactions. Out: complaints about
//! what rigid bodies don't determine. Self-stress ([`super::statics`]) moves nothing, and no equation tells of it. An output is
//! determined if none changes it. If some does, the output still means something where the loads of every joint stand across
//! those of self-stress, force to force and moment to moment: of the elastic energy of joints in these, nothing is
//! mixed then, and it is least without any self-stress, however stiff each joint is. So it is for the hinges of a planar loop that is
//! loaded in its plane, to which the axis of none gives a load: what carries nothing in truth is zero. All else would be what the
//! choice of equations makes of it.

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::loops::constraints::{Writing, closing_name, row_name};
use crate::mechanics::loops::structure::Structure;
use crate::mechanics::translate::dependencies::Dependencies;
use crate::model::site::{Site, Sited};
use crate::model::types::{Expr, ExprNode, JointId, LoopClosure, Model, Output};

use super::Complaint;
use super::configurations::Search;
use super::problem::{Problem, Random};
use super::singular::{add, dot};
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
/// Beside the greatest change of a load.
const ROUNDING: f64 = 1e-12;

/// Outputs that read reactions, where equations may depend on each other.
fn asked<'m>(model: &'m Model, structure: &Structure) -> Vec<&'m Output> {
    let certain = structure.dropped.is_empty() && structure.wavering.is_empty() && !structure.redundant;
    let reads = |output: &&Output| !Dependencies::of(std::iter::once(&output.value)).reactions().is_empty();
    if certain { Vec::new() } else { model.outputs.iter().filter(reads).collect() }
}

/// Outputs that the mechanism doesn't determine, with loops in the axes of `writing`.
pub(super) fn complaints(model: &Model, structure: &Structure, writing: Writing) -> Vec<Complaint> {
    let outputs = asked(model, structure);
    if outputs.is_empty() {
        return Vec::new();
    }
    let problem = Problem::written(model, writing);
    let mut statics = Statics::new(model, structure, writing, &outputs);
    let mut random = Random(0x57E55);
    let samples: Vec<Sample> = poses(&problem, structure)
        .iter()
        .filter_map(|positions| statics.sample(&problem, positions, &mut random))
        .collect();
    let mut found = Vec::new();
    for (number, output) in outputs.iter().enumerate() {
        let open = match samples.is_empty() {
            // Nothing is known of it.
            true => Some(HashSet::new()),
            false => samples
                .iter()
                .filter(|sample| is_typical(sample, &samples))
                .find_map(|sample| statics.open(sample, number)),
        };
        found.extend(open.map(|joints| complaint(model, structure, output, &joints)));
    }
    found
}

/// The same in other axes than the structure was found in.
pub(in super::super) fn are_determined(model: &Model, structure: &Structure, writing: Writing) -> bool {
    complaints(model, structure, writing).is_empty()
}

/// Closed poses. Those that the structure knows have the greatest rank; where some branch of what is kept has less, as that on which a coupler moves on
/// three parallel bars, others are looked for.
fn poses(problem: &Problem, structure: &Structure) -> Vec<Vec<Vec<f64>>> {
    let size = problem.columns.len() + problem.equations.len();
    let count = if size > LARGE { FEW } else { POSES };
    let known = structure.closed.iter().take(count).map(|closed| closed.positions.clone());
    let mut poses: Vec<Vec<Vec<f64>>> = known.collect();
    if structure.redundant {
        let (equations, columns): (Vec<usize>, Vec<usize>) =
            ((0..problem.equations.len()).collect(), (0..problem.columns.len()).collect());
        let (search, mut values) = (Search::new(problem, &equations, &columns), Values::default());
        let mut random = Random(0xB4A2);
        for amplitude in AMPLITUDES {
            let mut point = problem.shaken(&problem.origin(), &mut random, amplitude, &[]);
            if search.close(&mut point, &mut values) {
                poses.push(problem.positions(&point));
            }
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
    /// Joints that have self-stress which an output depends on, if there are any and it is not zero in truth.
    fn open(&mut self, sample: &Sample, output: usize) -> Option<HashSet<usize>> {
        let multipliers = &sample.multipliers[0];
        let loads = self.wrenches(sample, multipliers);
        let mut stresses: Vec<(&Vec<f64>, Wrenches)> = Vec::new();
        for stress in &sample.stress {
            let with = |factor: f64| multipliers.iter().zip(stress).map(|(a, b)| a + factor * b).collect::<Vec<f64>>();
            // Far enough for what is cut off where a load has one sign.
            if [1.0, -1.0, 10.0, -10.0].iter().any(|&factor| self.is_moved(sample, &with(factor), output)) {
                stresses.push((stress, difference(&self.wrenches(sample, &with(1.0)), &loads)));
            }
        }
        let touched = |(_, wrenches): &(&Vec<f64>, Wrenches)| {
            let most = greatest(wrenches);
            let joints = wrenches.iter().enumerate();
            joints.filter(|one| greatest(&vec![*one.1]) > NOTHING * most).map(|one| one.0).collect::<Vec<_>>()
        };
        let joints: HashSet<usize> = stresses.iter().flat_map(touched).collect();
        let is_zero = |multipliers: &Vec<f64>| {
            let loads = self.wrenches(sample, multipliers);
            stands_across(&loads, &stresses) && self.bears_nothing(multipliers, &stresses)
        };
        (!stresses.is_empty() && !sample.multipliers.iter().all(is_zero)).then_some(joints)
    }

    /// Whether an output has another value with other multipliers, beyond roundings of what it is made of.
    fn is_moved(&mut self, sample: &Sample, others: &[f64], output: usize) -> bool {
        let multipliers = &sample.multipliers[0];
        let (own, other) = (self.output(sample, multipliers, output), self.output(sample, others, output));
        let step: Vec<f64> = multipliers.iter().zip(others).map(|(a, b)| (a - b).abs()).collect();
        let bounds = self.bounds(sample, &step, output);
        // What is zero at the pose, as an axis across an axis, is rounding beside nothing.
        let rounding =
            ROUNDING * greatest(&difference(&self.wrenches(sample, others), &self.wrenches(sample, multipliers)));
        let differs = |((a, b), bound): ((&f64, &f64), &f64)| {
            // What has no number tells nothing.
            let change = (a - b).abs();
            change.is_nan() || change > NOTHING * bound + rounding
        };
        own.iter().zip(&other).zip(&bounds).any(differs)
    }

    /// Whether constraints that hold by no joint, such as rods, bear none of the loads where self-stress has a part of them.
    fn bears_nothing(&self, multipliers: &[f64], stresses: &[(&Vec<f64>, Wrenches)]) -> bool {
        let most = multipliers.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        self.rows().iter().enumerate().all(|(k, row)| {
            let strained = |(stress, _): &(&Vec<f64>, Wrenches)| {
                stress[k].abs() > NOTHING * stress.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
            };
            matches!(row.closing, LoopClosure::Cut(_))
                || multipliers[k].abs() <= NOTHING * most
                || !stresses.iter().any(strained)
        })
    }
}

/// Whether at each joint force and moment have no part along any of self-stress.
fn stands_across(loads: &Wrenches, stresses: &[(&Vec<f64>, Wrenches)]) -> bool {
    let (most, strained) = (greatest(loads), stresses.iter().map(|one| greatest(&one.1)).fold(0.0, f64::max));
    (0..loads.len()).all(|joint| {
        (0..2).all(|part| {
            let mut basis: Vec<Vec<f64>> = Vec::new();
            for (_, wrenches) in stresses {
                let mut rest = wrenches[joint][part].to_vec();
                for unit in basis.iter().chain(&basis) {
                    let along = dot(unit, &rest);
                    add(&mut rest, -along, unit);
                }
                let length = dot(&rest, &rest).sqrt();
                if length > NOTHING * strained {
                    basis.push(rest.iter().map(|x| x / length).collect());
                }
            }
            basis.iter().all(|unit| dot(unit, &loads[joint][part]).abs() <= NOTHING * most)
        })
    })
}

fn complaint(model: &Model, structure: &Structure, output: &Output, joints: &HashSet<usize>) -> Complaint {
    let (joint, at) = first_read(&output.value, joints).unwrap_or_else(|| (None, output.value.site()));
    let what = match joint {
        Some(joint) => format!("a reaction of `{}`", closing_name(model, LoopClosure::Cut(joint))),
        None => format!("the output `{}`", output.place.field),
    };
    let rows: Vec<String> =
        structure.dropped.iter().map(|row| format!("`{}`", row_name(model, row.closing, row.index))).collect();
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
