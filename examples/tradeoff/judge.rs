//! Whether the choice of `simulate` is a good one: every curve of it against the hull, at the accuracies asked for.
//!
//! It is to reach the accuracy, and to cost at most twice what the cheapest method costs, by evaluations and by time: of all
//! methods in the same formulation, and of all methods in all of them (how loops are kept closed is the model's choice, which
//! `simulate` is handed). Curves of other methods are taken at their most favourable setting, found in hindsight.

use std::fmt::Write;

use crate::analysis::{Cost, Curve, EVALUATIONS, TARGETS, TIME, best, curves};
use crate::bench::{Bench, Kind, Point, Series};
use crate::plot::long;
use crate::table::time;

/// What it may cost, over the least.
const BAR: f64 = 2.0;

/// Something's cost, and who has the least with how much.
struct Compared {
    cost: f64,
    least: f64,
    name: String,
}

impl Compared {
    fn ratio(&self) -> f64 {
        self.cost / self.least
    }

    fn told(&self) -> String {
        bold(format!("{:.2}", self.ratio()), self.ratio() > BAR)
    }
}

/// One run of `simulate`.
struct Verdict<'a> {
    bench: &'a Bench,
    series: Series,
    target: f64,
    own: f64,
    /// Evaluations and time, against methods in the same formulation.
    alike: [Compared; 2],
    /// The same against all.
    all: [Compared; 2],
}

impl Verdict<'_> {
    /// Whether it is the choice for a kind of scene in the formulation that suits it.
    fn is_default(&self) -> bool {
        let method = if self.bench.scene.kind == Kind::Stiff { "simulate_stiff" } else { "simulate" };
        let Series { handling, scalar, .. } = self.series;
        self.series.method == method && matches!(handling, "" | "reduced") && scalar == "f64"
    }

    fn reached(&self) -> bool {
        self.own <= self.target
    }

    fn passes(&self) -> bool {
        self.reached() && self.all.iter().all(|compared| compared.ratio() <= BAR)
    }

    fn error(&self) -> String {
        bold(format!("{:.1e}", self.own), !self.reached())
    }
}

fn bold(text: String, so: bool) -> String {
    if so { format!("**{text}**") } else { text }
}

/// Every run of `simulate` at the accuracies, as far as any method reaches them in its scalar.
fn verdicts(bench: &Bench) -> Vec<Verdict<'_>> {
    let all = curves(bench);
    let chooses = |series: Series| series.method.starts_with("simulate");
    let mut out = Vec::new();
    for curve in all.iter().filter(|curve| chooses(curve.series)) {
        let series = curve.series;
        let rivals = || all.iter().filter(|other| !chooses(other.series) && other.series.scalar == series.scalar);
        let alike = || rivals().filter(|other| other.series.handling == series.handling);
        for target in TARGETS {
            let asked = |point: &&&Point| (point.setting / target).ln().abs() < 0.01;
            let Some(point) = curve.points.iter().find(asked) else { continue };
            let pair = [EVALUATIONS, TIME].map(|cost| compared(point, alike(), target, cost));
            let wide = [EVALUATIONS, TIME].map(|cost| compared(point, rivals(), target, cost));
            if let ([Some(a), Some(b)], [Some(c), Some(d)]) = (pair, wide) {
                out.push(Verdict { bench, series, target, own: point.own, alike: [a, b], all: [c, d] });
            }
        }
    }
    out
}

fn compared<'a, 'b: 'a>(
    point: &Point,
    rivals: impl Iterator<Item = &'a Curve<'b>>,
    target: f64,
    cost: Cost,
) -> Option<Compared> {
    let (curve, least) = best(rivals, target, cost)?;
    let ways = if matches!(curve.series.handling, "" | "reduced") { "" } else { curve.series.handling };
    let name = if ways.is_empty() { long(curve.series) } else { format!("{}, {ways}", long(curve.series)) };
    Some(Compared { cost: cost(point), least, name })
}

/// All of it as text.
pub(crate) fn judged(benches: &[Bench]) -> String {
    let all: Vec<Verdict<'_>> = benches.iter().flat_map(verdicts).collect();
    let (default, others): (Vec<_>, Vec<_>) = all.iter().partition(|verdict| verdict.is_default());
    let passed = default.iter().filter(|verdict| verdict.passes()).count();
    let mut out = format!(
        "Asked for 1e-3, 1e-6 and 1e-9: the error reached, and cost over the least of all methods in all formulations, each \
         at its best setting in hindsight. Bold: the accuracy missed, or more than {BAR} times the least. {passed} of {} keep \
         both.\n\n\
         | scene | accuracy | error | evaluations | least | ratio | time | least | ratio |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        default.len()
    );
    for verdict in default {
        let [work, spent] = &verdict.all;
        let _ = writeln!(
            out,
            "| {}, `{}` | {:.0e} | {} | {:.0} | {:.0} by {} | {} | {} | {} by {} | {} |",
            verdict.bench.scene.name,
            verdict.series.method,
            verdict.target,
            verdict.error(),
            work.cost,
            work.least,
            work.name,
            work.told(),
            time(spent.cost),
            time(spent.least),
            spent.name,
            spent.told(),
        );
    }
    out.push_str(
        "\nWith loops kept as equations, in single precision, and by the explicit methods where the scene is stiff; ratios to \
         the least in the same formulation, then in any:\n\n\
         | scene | loops | scalar | accuracy | error | evaluations | time | in any: evaluations | time |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for verdict in others {
        let Verdict { series, alike: [work, spent], all: [all_work, all_spent], .. } = verdict;
        let _ = writeln!(
            out,
            "| {}, `{}` | {} | {} | {:.0e} | {} | {} | {} | {:.2} | {:.2} |",
            verdict.bench.scene.name,
            series.method,
            series.handling,
            series.scalar,
            verdict.target,
            verdict.error(),
            work.told(),
            spent.told(),
            all_work.ratio(),
            all_spent.ratio(),
        );
    }
    out
}
