//! What to take for a kind of scene: the methods that cost least at each accuracy, over all scenes of the kind.

use crate::analysis::{Cost, Curve, EVALUATIONS, TARGETS, TIME, curves};
use crate::bench::{Bench, Kind, Series};
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
        Kind::Loops => "loops",
        Kind::Stiff => "stiff",
    }
}

/// Second choices are named if they cost less than that much more.
const CLOSE: f64 = 1.5;

/// For every kind that was run.
pub(crate) fn advice(benches: &[Bench]) -> Vec<Advice> {
    let mut kinds: Vec<Kind> = benches.iter().map(|bench| bench.scene.kind).collect();
    kinds.sort();
    kinds.dedup();
    let one = |kind: Kind| {
        let scenes: Vec<Vec<Curve<'_>>> =
            benches.iter().filter(|bench| bench.scene.kind == kind).map(|bench| curves(bench)).collect();
        let conservative =
            benches.iter().filter(|bench| bench.scene.kind == kind).all(|bench| bench.scene.conservative);
        Advice {
            kind: words(kind),
            targets: TARGETS.map(|target| ranked(&scenes, |curve, cost| curve.cost(target, cost))),
            energy: if conservative { ranked(&scenes, |curve, cost| kept(curve, 1e-6, cost)) } else { Vec::new() },
        }
    };
    kinds.into_iter().map(one).collect()
}

/// What it costs to keep the energy within a share, from there on.
fn kept(curve: &Curve<'_>, share: f64, cost: Cost) -> Option<f64> {
    let last = curve.points.iter().rposition(|point| !(point.drift <= share)).map_or(0, |last| last + 1);
    curve.points.get(last).map(|point| cost(point))
}

fn ranked(scenes: &[Vec<Curve<'_>>], price: impl Fn(&Curve<'_>, Cost) -> Option<f64>) -> Vec<Line> {
    let Some(first) = scenes.first() else { return Vec::new() };
    // Loops count as solved where they can be: other ways are compared with each other in a table of their own.
    let candidates = first.iter().map(|curve| curve.series).filter(|series| {
        series.scalar == "f64" && series.method != "simulate" && matches!(series.handling, "" | "reduced")
    });
    let ratio = |series: Series| {
        let mut sum = 0.0;
        for curves in scenes {
            for cost in [EVALUATIONS, TIME] {
                let same = |curve: &&Curve<'_>| curve.series == series;
                let mine = price(curves.iter().find(same)?, cost)?;
                let others = curves.iter().filter(|curve| {
                    let other = curve.series;
                    other.scalar == "f64" && other.method != "simulate" && matches!(other.handling, "" | "reduced")
                });
                let least = others.filter_map(|curve| price(curve, cost)).fold(f64::INFINITY, f64::min);
                sum += (mine / least).ln();
            }
        }
        Some((sum / (2.0 * scenes.len() as f64)).exp())
    };
    let mut lines: Vec<Line> =
        candidates.filter_map(|series| Some(Line { name: long(series), ratio: ratio(series)? })).collect();
    lines.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    let limit = lines.first().map_or(0.0, |best| best.ratio * CLOSE);
    lines.retain(|line| line.ratio <= limit);
    lines.truncate(2);
    lines
}
