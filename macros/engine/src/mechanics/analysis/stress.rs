//! Stage `mechanics`: outputs that depend on how loops share their loads.
//!
//! In: a model with its structure, how its loops are written; where equations depend on each other and outputs read reactions. Out: complaints about
//! what rigid bodies don't determine. Self-stress ([`super::statics`]) moves nothing, and no equation tells of it. An output is
//! determined if none changes it. If some does, the output still means something where the loads of every joint stand across
//! those of self-stress, force to force and moment to moment: of the elastic energy of joints in these, nothing is
//! mixed then if each joint gives way alike in all directions, and it is least without any self-stress, however stiff one joint is beside another.
//! So it is for the hinges of a planar loop that is loaded in its plane, whose mirror image it is: what carries nothing in truth is zero. All else
//! would be what the choice of equations makes of it. Loads and outputs that are made of pieces (`max`, `select`) are looked at with some of
//! each piece too: what acts only beyond a stop would else be missed. What rests on loads that are next to nothing is looked at again where each
//! input and the like outweighs all else.

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::loops::constraints::{Writing, closing_name, row_name};
use crate::mechanics::loops::structure::{Row, Structure};
use crate::mechanics::translate::dependencies::Dependencies;
use crate::mechanics::translate::manipulations::holds;
use crate::model::site::{Site, Sited};
use crate::model::types::{ConstraintId, Expr, ExprNode, JointId, LoopClosure, Model, Output};

use super::configurations::{self, Search};
use super::problem::{Point, Problem, Random};
use super::rank::{self, Basis};
use super::rates::{LATE, OFF};
use super::singular::add;
use super::statics::{Emphasis, Sample, Slopes, Statics, Wrenches, difference, greatest};
use super::tape::Values;
use super::{Complaint, shared};

/// As many closed poses are looked at, and as many of mechanisms with more freedoms and equations than `LARGE`.
const POSES: usize = 4;
const FEW: usize = 2;
const LARGE: usize = 100;
/// How far further ones are looked for from where coordinates stand by default.
const AMPLITUDES: [f64; 8] = [0.1, 0.1, 0.2, 0.2, 0.4, 0.4, 0.8, 0.8];
/// Beside all terms that a change is made of, and beside the greatest load.
const NOTHING: f64 = 1e-7;
/// Beside what all loads are made of.
const DIGITS: f64 = 1e-11;
/// As often a sample is drawn that has no numbers.
const DRAWS: usize = 8;
/// So much more than all else inputs, states and parameters count, in so many parts, one part after the other.
const EMPHASIS: f64 = 1e6;
const SHARES: usize = 12;
/// Where there are inputs or states, the same in fewer parts for loads as they are, with these factors: an exponential is next to nothing below some of
/// them and no number above.
const GROWING: [f64; 4] = [8.0, 128.0, 2048.0, 32768.0];
const GROWING_SHARES: usize = 2;
/// Beside all terms that a change would be made of where nothing is closed, or that loads are sums of.
const ROUNDING: f64 = 1e-9;

/// Self-stress: joints that it loads, and equations that hold it.
#[derive(Default)]
struct Open {
    joints: HashSet<usize>,
    rows: Vec<Row>,
}

/// What an output makes of self-stress.
enum Verdict {
    /// No self-stress changes it.
    Determined,
    /// Some does, and none is there.
    Unstressed,
    Open(Open),
}

/// Outputs that read reactions or multipliers, where equations may depend on each other.
fn asked<'m>(model: &'m Model, structure: &Structure) -> Vec<&'m Output> {
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
    model.outputs.iter().filter(|one| reads(one) && !is_told(one)).collect()
}

/// Outputs that the mechanism doesn't determine, with loops in the axes of `writing`.
pub(super) fn complaints(model: &Model, structure: &Structure, writing: Writing) -> Vec<Complaint> {
    let outputs = asked(model, structure);
    if outputs.is_empty() || model.cuts.is_empty() && model.constraints.is_empty() {
        return Vec::new();
    }
    let problem = Problem::written(model, writing);
    let certain = structure.dropped.is_empty() && structure.wavering.is_empty() && !structure.redundant;
    let declared = configurations::start(&problem).filter(|point| is_singular(&problem, structure, point));
    if certain && declared.is_none() {
        return Vec::new();
    }
    let mut samples = Samples::new(model, structure, writing, &outputs, &problem);
    let mut found: Vec<Option<(Open, bool)>> = match declared {
        Some(point) => samples.here(&point, outputs.len()).into_iter().map(|one| Some((one?, true))).collect(),
        None => (0..outputs.len()).map(|_| None).collect(),
    };
    if !certain {
        let poses = poses(model, &problem, structure);
        let also = samples.judged(&poses, outputs.len());
        found.iter_mut().zip(also).for_each(|(slot, open)| *slot = slot.take().or(open.map(|open| (open, false))));
    }
    let told = outputs.iter().zip(found);
    told.filter_map(|(output, open)| open.map(|(open, here)| complaint(model, structure, output, &open, here)))
        .collect()
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

/// Whether equations that don't follow from others elsewhere do so at a pose.
fn is_singular(problem: &Problem, structure: &Structure, point: &Point) -> bool {
    let (names, rows) = shared::all(problem, structure, point);
    let kept = names.iter().filter(|row| !structure.dropped.contains(row)).count();
    rank::of(&rows, &(0..rows.len()).collect::<Vec<usize>>()) < kept
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
fn is_typical(count: usize, all: &[usize]) -> bool {
    all.iter().min() == Some(&count) || all.iter().filter(|&&other| other == count).count() > 1
}

/// A sample, and which of the programs it came of.
struct Seen {
    sample: Sample,
    program: usize,
}

/// Looks at poses, with pieces as they are and with blends of them.
struct Samples<'a> {
    programs: [Statics; 2],
    problem: &'a Problem,
    random: Random,
}

const PLAIN: usize = 0;
const BLENDED: usize = 1;

impl<'a> Samples<'a> {
    fn new(
        model: &'a Model,
        structure: &'a Structure,
        writing: Writing,
        outputs: &'a [&'a Output],
        problem: &'a Problem,
    ) -> Samples<'a> {
        Samples { programs: Statics::both(model, structure, writing, outputs), problem, random: Random(0x57E55) }
    }

    /// Again with other numbers where something has no value, as the root of an input has.
    fn at(&mut self, point: &Point, emphasis: Emphasis, program: usize) -> Option<Seen> {
        let (problem, random) = (self.problem, &mut self.random);
        let statics = &mut self.programs[program];
        let sample = (0..DRAWS).find_map(|_| statics.sample(problem, point, emphasis, random))?;
        Some(Seen { sample, program })
    }

    fn verdict(&mut self, seen: &Seen, output: usize) -> Verdict {
        self.programs[seen.program].verdict(&seen.sample, output, self.problem.size)
    }

    /// What is open of each output where all stands as it is declared, at rest and in motion.
    fn here(&mut self, point: &Point, outputs: usize) -> Vec<Option<Open>> {
        let ways =
            [(Emphasis::Rest, PLAIN), (Emphasis::None, PLAIN), (Emphasis::Rest, BLENDED), (Emphasis::None, BLENDED)];
        let all: Vec<Seen> =
            ways.into_iter().filter_map(|(emphasis, program)| self.at(point, emphasis, program)).collect();
        // Nothing is known where nothing has numbers.
        if all.is_empty() {
            return (0..outputs).map(|_| Some(Open::default())).collect();
        }
        self.open(&all.iter().map(|seen| (point, seen)).collect::<Vec<_>>(), outputs)
    }

    /// What is open of each output at any of these poses.
    fn judged(&mut self, poses: &[Point], outputs: usize) -> Vec<Option<Open>> {
        let mut all: Vec<(&Point, Seen)> = Vec::new();
        for (number, point) in poses.iter().enumerate() {
            let blended = self.at(point, Emphasis::None, BLENDED);
            let is_plain = number % POSES == 0 || blended.is_none();
            let plain = if is_plain { self.at(point, Emphasis::None, PLAIN) } else { None };
            all.extend(blended.into_iter().chain(plain).map(|seen| (point, seen)));
        }
        if all.is_empty() {
            return (0..outputs).map(|_| Some(Open::default())).collect();
        }
        let counts: Vec<usize> = all.iter().map(|(_, seen)| seen.sample.stress.len()).collect();
        let typical = all.iter().zip(&counts).filter(|one| is_typical(*one.1, &counts));
        self.open(&typical.map(|one| (one.0.0, &one.0.1)).collect::<Vec<_>>(), outputs)
    }

    /// What is open of each output in any of these samples.
    fn open(&mut self, all: &[(&Point, &Seen)], outputs: usize) -> Vec<Option<Open>> {
        let mut found: Vec<Option<Open>> = Vec::new();
        let mut is_unstressed = vec![false; outputs];
        for (number, unstressed) in is_unstressed.iter_mut().enumerate() {
            let open = all.iter().find_map(|(_, seen)| match self.verdict(seen, number) {
                Verdict::Determined => None,
                Verdict::Unstressed => {
                    *unstressed = true;
                    None
                }
                Verdict::Open(open) => Some(open),
            });
            found.push(open);
        }
        // What is zero there may be small alone.
        let moved = self.programs[BLENDED].moved();
        // Inputs and states may have either sign.
        let has_signs = self.programs[BLENDED].has_inputs();
        let shares = |factor: f64, most: usize, program: usize| {
            let of = moved.min(most);
            let signs = [factor, -factor].into_iter().take(if has_signs { 2 } else { 1 });
            signs.flat_map(move |factor| (0..of).map(move |first| (Emphasis::Share { first, of, factor }, program)))
        };
        let growing = GROWING.into_iter().filter(|_| has_signs);
        let growing = growing.flat_map(|factor| shares(factor, GROWING_SHARES, PLAIN));
        let ways = shares(EMPHASIS, SHARES, BLENDED).chain([(Emphasis::Velocities, BLENDED)]).chain(growing);
        for ((emphasis, program), (point, _)) in ways.zip(all.iter().cycle()) {
            let in_doubt: Vec<usize> = (0..outputs).filter(|&k| is_unstressed[k] && found[k].is_none()).collect();
            if in_doubt.is_empty() {
                break;
            }
            let other = PLAIN + BLENDED - program;
            let seen = self.at(point, emphasis, program).or_else(|| self.at(point, emphasis, other));
            for number in in_doubt {
                found[number] = match &seen {
                    Some(seen) => self.verdict(seen, number).open(),
                    None => Some(Open::default()),
                };
            }
        }
        found
    }
}

impl Verdict {
    fn open(self) -> Option<Open> {
        if let Verdict::Open(open) = self { Some(open) } else { None }
    }
}

impl Statics {
    /// `size`: of the mechanism [m].
    fn verdict(&mut self, sample: &Sample, output: usize, size: f64) -> Verdict {
        let multipliers = &sample.multipliers[0];
        let with = |stress: &[f64]| multipliers.iter().zip(stress).map(|(a, b)| a + b).collect::<Vec<f64>>();
        // With some of all self-stress, so that a product of loads is moved by any one of them.
        let mut some = multipliers.clone();
        for (k, stress) in sample.stress.iter().enumerate() {
            add(&mut some, 0.4 + (0.618_033_988_749_895 * k as f64).fract(), stress);
        }
        let slopes = self.slopes(sample, &some, output);
        let is_moved = |stress: &&Vec<f64>| slopes.iter().any(|one| is_moved(one, &some, stress));
        let open: Vec<&Vec<f64>> = sample.stress.iter().filter(is_moved).collect();
        if open.is_empty() {
            return Verdict::Determined;
        }
        let loads = self.wrenches(sample, multipliers);
        let mut stresses: Vec<(&Vec<f64>, Wrenches)> = Vec::new();
        for stress in open {
            stresses.push((stress, difference(&self.wrenches(sample, &with(stress)), &loads)));
        }
        let touched = |(_, wrenches): &(&Vec<f64>, Wrenches)| {
            let most = greatest(wrenches);
            let joints = wrenches.iter().enumerate();
            let is_touched = |one: &(usize, &[[f64; 3]; 2])| one.1.iter().flatten().any(|x| x.abs() > NOTHING * most);
            joints.filter(is_touched).map(|one| one.0).collect::<Vec<_>>()
        };
        let joints: HashSet<usize> = stresses.iter().flat_map(touched).collect();
        let is_zero = |multipliers: &Vec<f64>| {
            let loads = self.wrenches(sample, multipliers);
            let bounds = self.wrench_bounds(sample, multipliers);
            // Of what the stress is in: what hangs elsewhere may weigh more.
            let most = greatest(&joints.iter().filter_map(|&joint| loads.get(joint).copied()).collect());
            stand_across(&loads, &bounds, &stresses, most, size) && self.bears_nothing(multipliers, &stresses, most)
        };
        if sample.multipliers.iter().all(is_zero) {
            return Verdict::Unstressed;
        }
        Verdict::Open(Open { rows: strained(&stresses).into_iter().map(|k| self.rows()[k]).collect(), joints })
    }

    /// Whether constraints that hold by no joint, such as rods, bear none of the loads where self-stress has a part of them.
    fn bears_nothing(&self, multipliers: &[f64], stresses: &[(&Vec<f64>, Wrenches)], most: f64) -> bool {
        let strained = strained(stresses);
        let most = strained.iter().fold(most, |most, &k| most.max(multipliers[k].abs()));
        let is_cut = |k: usize| matches!(self.rows()[k].closing, LoopClosure::Cut(_));
        strained.iter().all(|&k| is_cut(k) || multipliers[k].abs() <= NOTHING * most)
    }
}

/// Whether self-stress changes a scalar, beyond roundings of what the change is made of.
fn is_moved(slopes: &Slopes, multipliers: &[f64], stress: &[f64]) -> bool {
    let change = slopes.change(stress);
    // What is zero at a closed pose, as an axis across an axis, is rounding beside what it is elsewhere; and self-stress is known to so many digits
    // of all multipliers.
    let [here, anywhere] = slopes.bounds(stress);
    let [whole, _] = slopes.bounds(multipliers);
    // What has no number tells nothing.
    change.is_nan() || change.abs() > NOTHING * here + ROUNDING * anywhere + DIGITS * whole
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

/// Whether at no joint force or moment has a part along any of self-stress. Such a part counts as nothing if it is small beside the greatest load of
/// its kind, and also beside the sum of the sizes of its own terms (`bounds`): that sum is large where stiff springs cancel, and as small as the
/// part itself where nothing else acts in its direction, so neither is enough alone.
fn stand_across(loads: &Wrenches, bounds: &Wrenches, stresses: &[(&Vec<f64>, Wrenches)], most: f64, size: f64) -> bool {
    let strained = stresses.iter().map(|one| greatest(&one.1)).fold(0.0, f64::max);
    // Forces and moments have units of their own; of forces, with moments over the mechanism's size.
    let of_kind = |part: usize| loads.iter().flat_map(move |w| w[part]).fold(0.0_f64, |most, x| most.max(x.abs()));
    let scale = of_kind(0).max(of_kind(1) / size);
    [0, 1].into_iter().all(|part| {
        let most_of =
            |wrenches: &Wrenches| wrenches.iter().flat_map(|w| w[part]).fold(0.0_f64, |most, x| most.max(x.abs()));
        let (load, terms) = (NOTHING * most_of(loads).min(most), DIGITS * most_of(bounds));
        // All loads of a kind may be what rounding and loops that are open by it leave of the other kind.
        let open = (ROUNDING * scale * [1.0, size][part]).min(NOTHING * most);
        loads.iter().zip(bounds).enumerate().all(|(joint, (own, bound))| {
            let mut basis = Basis::default();
            for (_, wrenches) in stresses {
                basis.grow(&wrenches[joint][part], NOTHING * strained);
            }
            basis.vectors().iter().all(|direction| {
                let along: f64 = direction.iter().zip(own[part]).map(|(d, x)| d * x).sum();
                let made_of: f64 = direction.iter().zip(bound[part]).map(|(d, x)| d.abs() * x).sum();
                along.abs() <= load + open && along.abs() <= NOTHING * made_of + terms
            })
        })
    })
}

/// Of what is open in any pose, or in the declared one.
fn complaint(model: &Model, structure: &Structure, output: &Output, open: &Open, declared: bool) -> Complaint {
    let (joint, at) = first_read(&output.value, &open.joints).unwrap_or_else(|| (None, output.value.site()));
    let what = match joint {
        Some(joint) => format!("a reaction of `{}`", closing_name(model, LoopClosure::Cut(joint))),
        None => format!("the output `{}`", output.place.field),
    };
    let dropped = structure.dropped.iter().filter(|row| open.rows.contains(row));
    let rows: Vec<String> = dropped.map(|row| format!("`{}`", row_name(model, row.closing, row.index))).collect();
    let why = match rows.is_empty() {
        _ if declared => {
            "where coordinates are declared to stand, more equations of loops depend on each other than elsewhere"
                .to_owned()
        }
        true => "equations of loops depend on each other".to_owned(),
        false => format!("{} follow{} from other equations", rows.join(", "), if rows.len() == 1 { "s" } else { "" }),
    };
    let help = match declared {
        true => "read what is determined there too, or place frames so that coordinates are zero in another pose",
        false => {
            "read what is determined, such as components in the plane of a loop (`.express(frame)`), or let its joints hold no more than they \
             have to: a loop of four hinges where one is a `Ball` and one is `Cylindrical`"
        }
    };
    Complaint {
        at,
        message: format!("{what} depends on how loops share their load, which rigid bodies don't determine: {why}"),
        help: Some(help.to_owned()),
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
