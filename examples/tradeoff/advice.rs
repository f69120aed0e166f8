//! What to take for a kind of scene: the methods that cost least at each accuracy, over all scenes of the kind.

use crate::analysis::{Cost, Curve, EVALUATIONS, TARGETS, TIME, best, curves};
use crate::bench::{Bench, Kind, Point, Series};
use crate::plot::long;

/// A method and its cost over that of the best in each scene, in the geometric mean of evaluations, time and scenes.
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) ratio: f64,
}

/// What to take for one kind of scene: at most two for each accuracy, the best first.
pub(crate) struct Advice {
    pub(crate) kind: &'static str,
    pub(crate) targets: [Vec<Line>; TARGETS.len()],
    /// Least work for a change of energy of a millionth at most; empty where energy is not kept.
    pub(crate) energy: Vec<Line>,
}

const fn words(kind: Kind) -> &'static str {
    match kind {
        Kind::Separable => "constant mass matrix, no velocities in the forces",
        Kind::Open => "arms and chains in regular motion",
        Kind::Chaotic => "arms and chains in chaotic motion",
        Kind::Rotation => "free rotation",
        Kind::Loops => "loops, solved",
        Kind::Stiff => "stiff",
    }
}

/// Second choices are named if they cost less than that much more.
const CLOSE: f64 = 1.5;

/// For every kind that was run, and for loops that keep their equations.
pub(crate) fn advice(benches: &[Bench]) -> Vec<Advice> {
    let mut kinds: Vec<Kind> = benches.iter().map(|bench| bench.scene.kind).collect();
    kinds.sort();
    kinds.dedup();
    let mut all: Vec<Advice> = kinds.iter().map(|kind| one(benches, *kind, words(*kind), solved)).collect();
    if kinds.contains(&Kind::Loops) {
        all.push(one(benches, Kind::Loops, "loops kept as equations", |series| !solved(series)));
    }
    all
}

/// Without loops, or with loops that are solved.
fn solved(series: Series) -> bool {
    matches!(series.handling, "" | "reduced")
}

fn one(benches: &[Bench], kind: Kind, name: &'static str, admitted: fn(Series) -> bool) -> Advice {
    let of_kind = || benches.iter().filter(|bench| bench.scene.kind == kind);
    let candidate =
        |series: Series| series.scalar == "f64" && !series.method.starts_with("simulate") && admitted(series);
    let of = |conservative: bool| -> Vec<Vec<Curve<'_>>> {
        let scenes = of_kind().filter(|bench| bench.scene.conservative || !conservative);
        scenes.map(|bench| curves(bench).into_iter().filter(|curve| candidate(curve.series)).collect()).collect()
    };
    let (scenes, conservative) = (of(false), of(true));
    Advice {
        kind: name,
        targets: TARGETS.map(|target| ranked(&scenes, |curve, cost| curve.cost(target, cost))),
        energy: ranked(&conservative, |curve, cost| kept(curve, 1e-6, cost)),
    }
}

/// What it costs to keep the energy within a share, from there on.
fn kept(curve: &Curve<'_>, share: f64, cost: Cost) -> Option<f64> {
    let beyond = |point: &&Point| point.drift > share || point.drift.is_nan();
    let first = curve.points.iter().rposition(beyond).map_or(0, |last| last + 1);
    curve.points.get(first).map(|point| cost(point))
}

/// The candidates that reach the goal in all scenes, by their cost.
fn ranked(scenes: &[Vec<Curve<'_>>], price: impl Fn(&Curve<'_>, Cost) -> Option<f64>) -> Vec<Line> {
    let ratio = |series: Series| {
        let mut sum = 0.0;
        for curves in scenes {
            let mine = curves.iter().find(|curve| curve.series == series)?;
            for cost in [EVALUATIONS, TIME] {
                let least = curves.iter().filter_map(|curve| price(curve, cost)).fold(f64::INFINITY, f64::min);
                sum += (price(mine, cost)? / least).ln();
            }
        }
        Some((sum / (2.0 * scenes.len() as f64)).exp())
    };
    let candidates = scenes.first().into_iter().flatten().map(|curve| curve.series);
    let mut lines: Vec<Line> =
        candidates.filter_map(|series| Some(Line { name: named(series), ratio: ratio(series)? })).collect();
    lines.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    let limit = lines.first().map_or(0.0, |best| best.ratio * CLOSE);
    lines.retain(|line| line.ratio <= limit);
    lines.truncate(2);
    lines
}

/// The method, with what keeps loops closed where something has to.
fn named(series: Series) -> String {
    if solved(series) { long(series) } else { format!("{} with {}", long(series), series.handling) }
}

/// What single precision reaches and saves in one scene.
pub(crate) struct Single {
    pub(crate) scene: &'static str,
    pub(crate) floor: f64,
    /// Time to 1e-3 over that of double precision, each by its best method with loops solved.
    pub(crate) time: Option<f64>,
}

/// For every scene.
pub(crate) fn single(benches: &[Bench]) -> Vec<Single> {
    let one = |bench: &Bench| {
        let curves = curves(bench);
        let of = |scalar| curves.iter().filter(move |curve| curve.series.scalar == scalar && solved(curve.series));
        let time = |scalar| best(of(scalar), TARGETS[0], TIME).map(|(_, time)| time);
        Single {
            scene: bench.scene.name,
            floor: of("f32").map(|curve| curve.floor).fold(f64::INFINITY, f64::min),
            time: time("f32").zip(time("f64")).map(|(single, double)| single / double),
        }
    };
    benches.iter().map(one).collect()
}
