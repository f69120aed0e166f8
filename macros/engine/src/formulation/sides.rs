//! Stage `formulation`: conditions that choose one solution of a loop.
//!
//! In: all solutions of a loop in numbers, at closed poses near the default one and at random configurations. Out: the conditions that
//! hold for the solution which goes through these poses, and for no other one. Where two solutions meet they are mirror images: the
//! middle between them is then the same at all configurations, with all parameters, for some angle, sum of angles or length. What
//! is on one side of it is told apart for good. Of what has no such middle (what is true at all configurations that were looked at,
//! and false for the others) nothing is known elsewhere, so that is asked only where no parameter could make use of it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::mechanics::analysis::{Closable, Pose};
use crate::mechanics::loops::solutions::{Sample, Solutions};
use crate::model::formulated::{Measure, Origin, Side};
use crate::model::types::{Coordinate, Model, ParamId, Type};

/// Poses that have to close, configurations that a middle has to be the same at, and those that others are looked at.
const LEAST_POSES: usize = 7;
const LEAST_PAIRS: usize = 8;

/// What differs by less is the same: poses are closed to eleven digits.
const SAME: f64 = 1e-6;

/// Solutions that are nearer to each other say nothing of their middle.
const APART: f64 = 1e-3;

/// How well the middle has to be the same.
const STEADY: f64 = 1e-8;

/// How far from the middle the default pose has to be, and poses near it: sines, and lengths beside their own size.
const MARGIN: f64 = 0.05;
const MARGIN_NEAR: f64 = 0.01;

/// Angles in one sum, and conditions of one loop.
const MOST_TERMS: usize = 5;
const MOST_SIDES: usize = 4;

/// Decimals of a middle that is a number: few, or those that are certain.
const DECIMALS: [f64; 2] = [1e6, 1e12];

/// From such a margin on there is room enough.
const ROOM: f64 = 0.3;

/// What chooses a solution.
#[derive(Default)]
pub(super) struct Choice {
    pub sides: Vec<Side>,
    /// Whether the condition that was offered holds, where nothing else tells some solutions apart.
    pub offered: Option<bool>,
}

/// The condition that was offered.
struct Offered {
    is_so: bool,
    /// By number of another solution.
    excludes: Vec<bool>,
}

/// A condition, and what is known of it.
struct Candidate {
    side: Side,
    /// By number of another solution.
    excludes: Vec<bool>,
    /// Whether there is a middle.
    is_exact: bool,
    /// At the default pose.
    margin: f64,
}

/// The conditions that choose the solution of the default pose; none where there is only one. Nothing where the default pose is no
/// solution or is one where solutions meet, or where nothing tells them apart.
pub(super) fn sides(
    model: &Model,
    loop_: &Closable,
    unknowns: &[Coordinate],
    poses: &[Pose],
    solutions: &Solutions,
) -> Option<Choice> {
    let looked = Looked { model, loop_, unknowns, poses, solutions };
    let own = looked.own()?;
    let others = looked.others(own)?;
    if others.is_empty() {
        return Some(Choice::default());
    }
    let mut candidates = looked.candidates(own, &others);
    // Of margins that are large the first is taken, which is the same one in identical parts.
    let room = |one: &Candidate| one.margin.min(ROOM);
    let order = |a: &Candidate, b: &Candidate| {
        let terms = a.side.terms.len().cmp(&b.side.terms.len());
        b.is_exact.cmp(&a.is_exact).then(terms).then(room(b).total_cmp(&room(a)))
    };
    candidates.sort_by(order);
    chosen(&candidates, &looked.offered(own, &others), others.len())
}

/// As few conditions as exclude all other solutions; what was offered where nothing else excludes some of them.
fn chosen(candidates: &[Candidate], offered: &Offered, others: usize) -> Option<Choice> {
    let mut left: Vec<usize> = (0..others).collect();
    let mut choice = Choice::default();
    let is_excluded = |k: &usize| candidates.iter().any(|candidate| candidate.excludes[*k]);
    if !left.iter().all(is_excluded) {
        choice.offered = Some(offered.is_so);
        left.retain(|&k| !offered.excludes[k]);
    }
    while !left.is_empty() && choice.sides.len() < MOST_SIDES {
        // What excludes most; of those that exclude as many the first.
        let count = |candidate: &Candidate| left.iter().filter(|&&k| candidate.excludes[k]).count();
        let most = candidates.iter().map(count).max().filter(|&most| most > 0)?;
        let best = candidates.iter().find(|candidate| count(candidate) == most)?;
        left.retain(|&k| !best.excludes[k]);
        choice.sides.push(best.side.clone());
    }
    choice.sides.sort_by(|a, b| a.terms.cmp(&b.terms));
    left.is_empty().then_some(choice)
}

struct Looked<'a> {
    model: &'a Model,
    loop_: &'a Closable,
    unknowns: &'a [Coordinate],
    poses: &'a [Pose],
    solutions: &'a Solutions,
}

impl Looked<'_> {
    fn samples(&self) -> impl Iterator<Item = &Sample> {
        self.solutions.near.iter().chain(&self.solutions.wide)
    }

    fn count(&self) -> usize {
        self.samples().map(|sample| sample.solutions.len()).max().unwrap_or(0)
    }

    /// The solution that goes through all poses, turns counted as they are there.
    fn own(&self) -> Option<usize> {
        if self.poses.len() < LEAST_POSES {
            return None;
        }
        let goes = |solution: &usize| {
            self.poses.iter().zip(&self.solutions.near).all(|(pose, sample)| {
                let at = |unknown: &Coordinate| pose.positions[unknown.joint.0][unknown.index];
                let Some(found) = &sample.solutions[*solution] else { return false };
                self.unknowns.iter().zip(found).all(|(unknown, x)| (x - at(unknown)).abs() <= SAME * (1.0 + x.abs()))
            })
        };
        let all: Vec<usize> = (0..self.count()).filter(goes).collect();
        let &first = all.first()?;
        // Two that go through them are one, or the default pose says nothing.
        all.iter().all(|&other| self.is_same(first, other)).then_some(first)
    }

    fn is_same(&self, one: usize, other: usize) -> bool {
        self.samples().all(|sample| match (&sample.solutions[one], &sample.solutions[other]) {
            (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * (1.0 + a.abs())),
            (a, b) => a.is_none() && b.is_none(),
        })
    }

    /// Those from which the own one is to be told apart; nothing where one of them meets it at the default pose.
    fn others(&self, own: usize) -> Option<Vec<usize>> {
        let is_real = |&k: &usize| self.samples().any(|sample| sample.solutions[k].is_some());
        let all: Vec<usize> =
            (0..self.count()).filter(|&k| k != own && !self.is_same(own, k)).filter(is_real).collect();
        let first = self.solutions.near.first()?;
        let meets = |&k: &usize| self.distance(first, own, k).is_some_and(|distance| distance < APART);
        (!all.iter().any(meets)).then_some(all)
    }

    /// How far two solutions are apart.
    fn distance(&self, sample: &Sample, one: usize, other: usize) -> Option<f64> {
        let (a, b) = (sample.solutions[one].as_ref()?, sample.solutions[other].as_ref()?);
        let apart = self.unknowns.iter().zip(a.iter().zip(b)).map(|(unknown, (a, b))| {
            let is_length = self.loop_.lengths.contains(unknown);
            if is_length {
                (a - b).abs() / (a.abs() + b.abs()).max(f64::MIN_POSITIVE)
            } else {
                wrapped(a - b, TAU).abs()
            }
        });
        apart.reduce(f64::max)
    }

    /// What the offered condition is for the own solution, and for which others it is the opposite wherever they are apart.
    fn offered(&self, own: usize, others: &[usize]) -> Offered {
        let first = self.solutions.near.first().and_then(|sample| Some((sample, *sample.holds[own].first()?)));
        let Some((first, is_so)) = first else { return Offered { is_so: false, excludes: vec![false; others.len()] } };
        let is_own = |sample: &Sample| sample.solutions[own].is_none() || sample.holds[own][0] == is_so;
        let is_clear = |other: usize| self.distance(first, own, other).is_none_or(|apart| apart >= 2.0 * MARGIN);
        let is_other = |sample: &Sample, other: usize| {
            let meets = self.distance(sample, own, other).is_some_and(|apart| apart < APART);
            sample.solutions[other].is_none() || meets || (is_own(sample) && sample.holds[other][0] != is_so)
        };
        let excluded = |&other: &usize| is_clear(other) && self.samples().all(|sample| is_other(sample, other));
        Offered { is_so, excludes: others.iter().map(excluded).collect() }
    }

    fn candidates(&self, own: usize, others: &[usize]) -> Vec<Candidate> {
        let mut sides: Vec<(Side, bool)> = Vec::new();
        let mut add = |side: Option<Side>, is_exact: bool| {
            if let Some(side) = side.filter(|side| !sides.iter().any(|known| known.0 == *side)) {
                sides.push((side, is_exact));
            }
        };
        for terms in self.sums() {
            for &other in others {
                add(self.between(own, other, &terms), true);
            }
            if !self.loop_.is_adjustable && terms.len() <= 2 {
                [Measure::Sine, Measure::Cosine]
                    .into_iter()
                    .for_each(|measure| add(self.plain(own, &terms, measure), false));
            }
        }
        for &length in self.unknowns.iter().filter(|&unknown| self.loop_.lengths.contains(unknown)) {
            let terms = [(length, false)];
            for &other in others {
                add(self.between_lengths(own, other, length), true);
            }
            if !self.loop_.is_adjustable {
                add(self.plain(own, &terms, Measure::Travel), false);
            }
        }
        sides.into_iter().filter_map(|(side, is_exact)| self.candidate(own, others, side, is_exact)).collect()
    }

    /// Sums of angles of the loop, one unknown among them at least, the shortest first.
    fn sums(&self) -> Vec<Vec<(Coordinate, bool)>> {
        let angles = &self.loop_.angles;
        let mut all: Vec<Vec<(Coordinate, bool)>> = Vec::new();
        let mut longest: Vec<(usize, Vec<(Coordinate, bool)>)> = vec![(0, Vec::new())];
        for _ in 0..MOST_TERMS.min(angles.len()) {
            let mut longer = Vec::new();
            for (from, terms) in &longest {
                for (at, &angle) in angles.iter().enumerate().skip(*from) {
                    let signs = if terms.is_empty() { &[false][..] } else { &[false, true][..] };
                    longer.extend(signs.iter().map(|&sign| (at + 1, [&terms[..], &[(angle, sign)]].concat())));
                }
            }
            all.extend(longer.iter().map(|one| one.1.clone()));
            longest = longer;
        }
        all.retain(|terms| terms.iter().any(|term| self.unknowns.contains(&term.0)));
        all
    }

    fn sum(&self, sample: &Sample, solution: usize, terms: &[(Coordinate, bool)]) -> Option<f64> {
        let signed = |&(coordinate, is_subtracted): &(Coordinate, bool)| {
            let value = sample.value(self.unknowns, solution, coordinate)?;
            Some(if is_subtracted { -value } else { value })
        };
        terms.iter().map(signed).sum()
    }

    /// The side of the middle between two solutions of a sum of angles, if that is the same everywhere.
    fn between(&self, own: usize, other: usize, terms: &[(Coordinate, bool)]) -> Option<Side> {
        let (mut middle, mut best, mut pairs): (Option<f64>, f64, usize) = (None, 0.0, 0);
        for sample in self.samples() {
            if self.distance(sample, own, other).is_none_or(|distance| distance < APART) {
                continue;
            }
            let (a, b) = (self.sum(sample, own, terms)?, self.sum(sample, other, terms)?);
            let (found, apart) = (0.5 * (a + b), (0.5 * (a - b)).sin().abs());
            if apart < APART {
                return None;
            }
            if middle.is_some_and(|known| wrapped(found - known, PI).abs() > STEADY / apart) {
                return None;
            }
            if apart > best {
                (middle, best) = (Some(found), apart);
            }
            pairs += 1;
        }
        if pairs < LEAST_PAIRS {
            return None;
        }
        let middle = tidy_angle(wrapped(middle?, PI));
        let (measure, from) = match middle {
            0.0 => (Measure::Sine, 0.0),
            x if x.abs() == FRAC_PI_2 => (Measure::Cosine, 0.0),
            x => (Measure::Sine, x),
        };
        self.at_default(own, Side { measure, terms: terms.to_vec(), from: Origin::Number(from), is_above: true })
    }

    /// The same of a length.
    fn between_lengths(&self, own: usize, other: usize, length: Coordinate) -> Option<Side> {
        let mut middles: Vec<(&Sample, f64)> = Vec::new();
        for sample in self.samples() {
            if self.distance(sample, own, other).is_none_or(|distance| distance < APART) {
                continue;
            }
            let value = |solution: usize| sample.value(self.unknowns, solution, length);
            let (a, b) = (value(own)?, value(other)?);
            if (a - b).abs() < APART * (a.abs() + b.abs()) {
                return None;
            }
            middles.push((sample, 0.5 * (a + b)));
        }
        if middles.len() < LEAST_PAIRS {
            return None;
        }
        // Of large travels less is left.
        let size = |sample: &Sample| sample.value(self.unknowns, own, length).map_or(1.0, |x| 1.0 + x.abs());
        let is_all = |value: &dyn Fn(&Sample) -> f64| {
            middles.iter().all(|(sample, middle)| (middle - value(sample)).abs() <= STEADY * size(sample))
        };
        let nearest = middles.iter().min_by(|a, b| size(a.0).total_cmp(&size(b.0)))?.1;
        let rounded = DECIMALS.map(|decimals| (nearest * decimals).round() / decimals + 0.0);
        let number = rounded.into_iter().find(|&number| is_all(&|_| number));
        let from = if let Some(number) = number {
            Some(Origin::Number(number))
        } else {
            let parameters = (0..self.model.params.len()).map(ParamId);
            let scalars = parameters.filter(|&of| self.model.params[of].ty == Type::Scalar);
            let both = scalars.flat_map(|of| [false, true].map(|is_negative| Origin::Parameter { of, is_negative }));
            both.into_iter().find(|&from| is_all(&|sample| self.origin(sample, from)))
        };
        let side = Side { measure: Measure::Travel, terms: vec![(length, false)], from: from?, is_above: true };
        self.at_default(own, side)
    }

    fn origin(&self, sample: &Sample, from: Origin) -> f64 {
        match from {
            Origin::Number(value) => value,
            Origin::Parameter { of, is_negative } => {
                let moved = sample.pose.parameters.iter().find(|moved| moved.0 == (of.0, 0));
                let value = moved.map_or_else(|| self.model.params[of].default[0], |moved| moved.1);
                if is_negative { -value } else { value }
            }
        }
    }

    fn plain(&self, own: usize, terms: &[(Coordinate, bool)], measure: Measure) -> Option<Side> {
        self.at_default(own, Side { measure, terms: terms.to_vec(), from: Origin::Number(0.0), is_above: true })
    }

    /// The side on which the default pose is.
    fn at_default(&self, own: usize, side: Side) -> Option<Side> {
        let is_above = self.value(self.solutions.near.first()?, own, &side)? > 0.0;
        Some(Side { is_above, ..side })
    }

    /// How far a solution is from the middle.
    fn value(&self, sample: &Sample, solution: usize, side: &Side) -> Option<f64> {
        let (sum, from) = (self.sum(sample, solution, &side.terms)?, self.origin(sample, side.from));
        Some(match side.measure {
            Measure::Sine => (sum - from).sin(),
            Measure::Cosine => (sum - from).cos(),
            Measure::Travel if sum == from => 0.0,
            Measure::Travel => (sum - from) / (sum.abs() + from.abs()),
        })
    }

    /// What excludes other solutions wherever it was looked at, and holds for the own one.
    fn candidate(&self, own: usize, others: &[usize], side: Side, is_exact: bool) -> Option<Candidate> {
        let signed = |sample: &Sample, solution: usize| {
            sample.solutions[solution].as_ref()?;
            let value = self.value(sample, solution, &side)?;
            Some(if side.is_above { value } else { -value })
        };
        let margin = signed(self.solutions.near.first()?, own)?;
        let near = self.solutions.near.iter().filter_map(|sample| signed(sample, own));
        let is_clear = margin >= MARGIN && near.reduce(f64::min).is_some_and(|least| least >= MARGIN_NEAR);
        // Where solutions meet the sign is rounding.
        let blur = if is_exact { STEADY } else { 0.0 };
        let holds = self.samples().filter_map(|sample| signed(sample, own)).all(|value| value > -blur);
        if !is_clear || !holds {
            return None;
        }
        let excluded = |&other: &usize| {
            let values: Vec<f64> = self.samples().filter_map(|sample| signed(sample, other)).collect();
            values.len() >= LEAST_PAIRS && values.iter().all(|&value| value < blur)
        };
        let excludes: Vec<bool> = others.iter().map(excluded).collect();
        Some(Candidate { side, excludes, is_exact, margin })
    }
}

/// Between minus and plus half a period.
fn wrapped(x: f64, period: f64) -> f64 {
    x - period * (x / period).round()
}

/// A twelfth of a half turn, if it is one but for rounding; else with the digits that are certain.
fn tidy_angle(x: f64) -> f64 {
    let part = PI / 12.0;
    let parts = (x / part).round();
    if (parts * part - x).abs() < STEADY { parts * part + 0.0 } else { (x * 1e13).round() / 1e13 }
}
