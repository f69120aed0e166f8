//! The figures as text: every point as CSV, each scene and the recommendations as Markdown.

use std::fmt::Write;

use crate::advice::{Advice, Line, Single};
use crate::analysis::{EVALUATIONS, TARGETS, TIME, best, curves, hull};
use crate::bench::{Bench, Steps};
use crate::plot::long;

/// All points of all scenes.
pub(crate) fn csv(benches: &[Bench]) -> String {
    let mut out = String::from(
        "scene,method,steps,loops,scalar,order,setting,evaluations,jacobians,accepted,rejected,seconds_per_second,\
         error,error_by_growth,gap,energy_drift,hull_evaluations,hull_time\n",
    );
    for bench in benches {
        let on = [EVALUATIONS, TIME].map(|cost| hull(&bench.points, cost));
        for point in &bench.points {
            let series = point.series;
            let steps = if series.steps == Steps::Fixed { "fixed" } else { "adaptive" };
            let marks = on.each_ref().map(|hull| u8::from(hull.iter().any(|other| std::ptr::eq(*other, point))));
            let statistics = point.statistics;
            let _ = writeln!(
                out,
                "{},{},{steps},{},{},{},{:.4e},{},{},{},{},{:.3e},{:.3e},{:.3e},{:.2e},{:.2e},{},{}",
                bench.scene.name,
                series.method,
                series.handling,
                series.scalar,
                series.order,
                point.setting,
                statistics.evaluations,
                statistics.jacobians,
                statistics.accepted,
                statistics.rejected,
                point.seconds,
                point.error,
                point.own,
                point.gap,
                point.drift,
                marks[0],
                marks[1],
            );
        }
    }
    out
}

/// A time with its unit.
pub(crate) fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "us"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    if value < 10.0 { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}

/// One scene: a line for each curve.
pub(crate) fn scene(bench: &Bench) -> String {
    let all = curves(bench);
    let (title, name) = (bench.scene.title, bench.scene.name);
    let mut out = format!("### {title}\n\n![{title}]({name}.svg)\n\n");
    let _ = writeln!(
        out,
        "Growth of errors {:.3}. Columns at an accuracy: evaluations, and time per simulated second; the best in bold.\n",
        bench.growth
    );
    out.push_str("| method | loops | scalar | order | floor |");
    TARGETS.iter().for_each(|target| {
        let _ = write!(out, " {target:.0e} | |");
    });
    out.push_str("\n|---|---|---|---|---|");
    out.push_str(&"---|---|".repeat(TARGETS.len()));
    out.push('\n');
    let least = TARGETS.map(|target| [EVALUATIONS, TIME].map(|cost| best(&all, target, cost).map(|(_, least)| least)));
    for curve in &all {
        let series = curve.series;
        let order = curve.order.map_or_else(String::new, |order| format!("{order:.2}"));
        let _ = write!(
            out,
            "| {} | {} | {} | {order} | {:.0e} |",
            long(series),
            series.handling,
            series.scalar,
            curve.floor
        );
        for (target, least) in TARGETS.into_iter().zip(least) {
            let [evaluations, seconds] = [EVALUATIONS, TIME].map(|cost| curve.cost(target, cost));
            let bold = |text: String, value: f64, least: Option<f64>| {
                if least.is_some_and(|least| value <= least) { format!("**{text}**") } else { text }
            };
            let work = evaluations.map_or_else(String::new, |work| bold(format!("{work:.0}"), work, least[0]));
            let spent = seconds.map_or_else(String::new, |spent| bold(time(spent), spent, least[1]));
            let _ = write!(out, " {work} | {spent} |");
        }
        out.push('\n');
    }
    out
}

/// The recommendations.
pub(crate) fn advice(all: &[Advice]) -> String {
    let mut out = String::from("| scenes | 1e-3 | 1e-6 | 1e-9 | energy within 1e-6 |\n|---|---|---|---|---|\n");
    for advice in all {
        let _ = write!(out, "| {} |", advice.kind);
        for lines in advice.targets.iter().chain([&advice.energy]) {
            let words: Vec<String> = lines.iter().map(|Line { name, ratio }| format!("{name} ({ratio:.1})")).collect();
            let _ = write!(out, " {} |", if words.is_empty() { "none".to_owned() } else { words.join(", ") });
        }
        out.push('\n');
    }
    out
}

/// What single precision reaches and saves.
pub(crate) fn single(all: &[Single]) -> String {
    let mut out = String::from("| scene | least error | time to 1e-3 over that in double precision |\n|---|---|---|\n");
    for Single { scene, floor, time } in all {
        let time = time.map_or_else(|| "not reached".to_owned(), |time| format!("{time:.2}"));
        let _ = writeln!(out, "| {scene} | {floor:.0e} | {time} |");
    }
    out
}
