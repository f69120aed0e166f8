//! The picture of a scene: work against error, energy, precision, and how loops are kept closed.

use crate::analysis::{Cost, Curve, EVALUATIONS, TIME, curves, hull};
use crate::bench::{Bench, Point, Series, Steps};
use crate::svg::{Line, Mark, Panel, Picture, Style};

/// The lower edge of all panels.
const LOWEST: f64 = 1e-16;
const PANEL: (f64, f64) = (430.0, 330.0);
const LEFT: f64 = 62.0;
const TOP: f64 = 92.0;
const ACROSS: f64 = PANEL.0 + 72.0;
const DOWN: f64 = PANEL.1 + 88.0;
const KEYS: f64 = LEFT + 2.0 * ACROSS - 36.0;
const WIDTH: f64 = KEYS + 218.0;

/// A method by its family's colour (Okabe and Ito's, told apart by the colour-blind), its order by the mark.
fn method(series: Series) -> Style {
    let colour = match series.method {
        "Euler" | "SemiImplicitEuler" => "#8c8c8c",
        "Verlet" | "Composition4" | "Composition6" => "#009e73",
        "ImplicitMidpoint" | "GaussLegendre4" | "GaussLegendre6" => "#cc79a7",
        "SymplecticMidpoint" | "SymplecticGauss4" | "SymplecticGauss6" => "#7b3294",
        "Rk4" => "#e69f00",
        "DormandPrince" => "#56b4e9",
        "Dop853" => "#0072b2",
        "Radau" => "#d55e00",
        "GeneralisedAlpha" => "#8c5a2b",
        _ => "#000000", // simulate
    };
    let mark = match series.order {
        0..=2 => Mark::Circle,
        3..=4 => Mark::Square,
        5 => Mark::Diamond,
        _ => Mark::Triangle,
    };
    let fixed_too = matches!(series.method, "DormandPrince" | "Dop853") && series.steps == Steps::Fixed;
    let width = if series.method.starts_with("simulate") { 2.4 } else { 1.5 };
    Style { colour, mark, dashed: fixed_too || matches!(series.method, "Euler" | "simulate_stiff"), width }
}

/// A way to keep loops closed.
fn handling(series: Series) -> Style {
    let (colour, mark) = match series.handling {
        "reduced" => ("#000000", Mark::Diamond),
        "none" => ("#8c8c8c", Mark::Circle),
        "projection" => ("#0072b2", Mark::Square),
        "projection by mass" => ("#56b4e9", Mark::Triangle),
        "one correction" => ("#009e73", Mark::Circle),
        "Baumgarte" => ("#e69f00", Mark::Square),
        _ => ("#8c5a2b", Mark::Triangle),
    };
    Style { colour, mark, dashed: series.method == "Rk4", width: 1.5 }
}

/// Short names for beside the curves.
fn short(series: Series) -> String {
    let name = match series.method {
        "SemiImplicitEuler" => "semi-implicit Euler",
        "DormandPrince" => "DP5",
        "Dop853" => "DP8",
        "ImplicitMidpoint" => "midpoint",
        "GaussLegendre4" => "Gauss 4",
        "GaussLegendre6" => "Gauss 6",
        "SymplecticMidpoint" => "midpoint, momenta",
        "SymplecticGauss4" => "Gauss 4, momenta",
        "SymplecticGauss6" => "Gauss 6, momenta",
        "Composition4" => "comp. 4",
        "Composition6" => "comp. 6",
        "Rk4" => "RK4",
        "GeneralisedAlpha" => "gen. alpha",
        other => other,
    };
    let fixed = matches!(series.method, "DormandPrince" | "Dop853") && series.steps == Steps::Fixed;
    if fixed { format!("{name} fixed") } else { name.to_owned() }
}

/// The method's name and its steps.
pub(crate) fn long(series: Series) -> String {
    match (series.method, series.steps) {
        (name @ ("simulate" | "simulate_stiff"), _) => name.to_owned(),
        (name, Steps::Adaptive) => format!("{name}, adaptive"),
        (name, Steps::Fixed) => format!("{name}, fixed"),
    }
}

fn line(curve: &Curve<'_>, name: String, style: Style, cost: Cost, value: fn(&Point) -> f64) -> Line {
    // What goes on below the frame would run along its edge: a curve ends where it first leaves.
    let last = curve.points.iter().position(|point| value(point) < LOWEST).unwrap_or(curve.points.len());
    let points = curve.points.iter().take(last + 1).map(|point| (cost(point), value(point))).collect();
    Line { name, style, points }
}

/// The whole picture.
pub(crate) fn picture(bench: &Bench) -> String {
    let all = curves(bench);
    let loops = bench.points.iter().any(|point| point.gap > 0.0);
    let plain = |curve: &&Curve<'_>| curve.series.scalar == "f64" && matches!(curve.series.handling, "" | "reduced");
    let methods: Vec<&Curve<'_>> = all.iter().filter(plain).collect();
    let rows = if loops { 3.0 } else { 2.0 };
    let mut picture = Picture::new(WIDTH, TOP + rows * DOWN - 20.0);
    picture.text((LEFT, 32.0), 18.0, "start", "#111", bench.scene.title);
    let growth = format!(
        "Errors at the end, relative, divided by the problem's own growth of errors, {:.1}. The yellow band is the hull.",
        bench.growth
    );
    picture.text((LEFT, 54.0), 11.5, "start", "#666", &growth);

    let own: fn(&Point) -> f64 = |point| point.own;
    let work = |title, across, cost: Cost| Panel {
        title,
        across,
        lines: methods.iter().map(|curve| line(curve, short(curve.series), method(curve.series), cost, own)).collect(),
        hull: hull(methods.iter().flat_map(|curve| curve.points.iter().copied()), cost)
            .into_iter()
            .map(|point| (cost(point), point.bound))
            .filter(|point| point.1 >= LOWEST)
            .collect(),
        heights: (LOWEST, 1.0),
    };
    let place = |row: f64, column: f64| (LEFT + column * ACROSS, TOP + row * DOWN);
    picture.panel(&work("Error against work", EVALUATED, EVALUATIONS), place(0.0, 0.0), PANEL);
    picture.panel(&work("Error against time", TIMED, TIME), place(0.0, 1.0), PANEL);
    keys(&mut picture, 0.0, methods.iter().map(|curve| (method(curve.series), long(curve.series), said(curve))));

    let drift = Panel {
        title: if bench.scene.conservative {
            "Greatest change of energy, relative"
        } else {
            "Error of the energy at the end, relative"
        },
        across: EVALUATED,
        lines: methods
            .iter()
            .map(|curve| line(curve, short(curve.series), method(curve.series), EVALUATIONS, |point| point.drift))
            .collect(),
        hull: Vec::new(),
        heights: (LOWEST, 1.0),
    };
    picture.panel(&drift, place(1.0, 0.0), PANEL);
    let precision = |curve: &&Curve<'_>| {
        matches!(curve.series.handling, "" | "reduced")
            && matches!(curve.series.method, "Rk4" | "DormandPrince" | "Dop853" | "Composition6" | "Verlet")
            && (curve.series.steps == Steps::Adaptive || !matches!(curve.series.method, "DormandPrince" | "Dop853"))
    };
    let single = |curve: &Curve<'_>| {
        let style = Style { dashed: curve.series.scalar == "f32", ..method(curve.series) };
        line(curve, format!("{} {}", short(curve.series), curve.series.scalar), style, TIME, own)
    };
    let precisions = Panel {
        title: "Double and single precision",
        across: TIMED,
        lines: all.iter().filter(precision).map(single).collect(),
        hull: Vec::new(),
        heights: (LOWEST, 1.0),
    };
    picture.panel(&precisions, place(1.0, 1.0), PANEL);
    if loops {
        handlings(&mut picture, &all, place);
    }
    picture.finish()
}

const EVALUATED: &str = "evaluations of the equations of motion";
const TIMED: &str = "time per simulated second [s]";

/// The third row: one method, loops kept closed in all ways.
fn handlings(picture: &mut Picture, all: &[Curve<'_>], place: impl Fn(f64, f64) -> (f64, f64)) {
    let chosen = |curve: &&Curve<'_>| {
        let adaptive = curve.series.method == "DormandPrince" && curve.series.steps == Steps::Adaptive;
        curve.series.scalar == "f64" && (adaptive || curve.series.handling == "in the method")
    };
    let ways: Vec<&Curve<'_>> = all.iter().filter(chosen).collect();
    let panel = |title, value: fn(&Point) -> f64| Panel {
        title,
        across: TIMED,
        lines: ways
            .iter()
            .map(|curve| line(curve, way(curve.series), handling(curve.series), TIME, value))
            .filter(|line| line.points.iter().any(|point| point.1 > 0.0))
            .collect(),
        hull: Vec::new(),
        heights: (LOWEST, 1.0),
    };
    picture.panel(
        &panel("DormandPrince, adaptive, by how loops are closed", |point| point.own),
        place(2.0, 0.0),
        PANEL,
    );
    picture.panel(&panel("Greatest gap of a loop [m]", |point| point.gap), place(2.0, 1.0), PANEL);
    keys(picture, 2.0, ways.iter().map(|curve| (handling(curve.series), way(curve.series), said(curve))));
}

/// Its name.
fn way(series: Series) -> String {
    match series.method {
        "GeneralisedAlpha" => format!("gen. alpha, {}", series.handling),
        _ => series.handling.to_owned(),
    }
}

/// What a curve says in words.
fn said(curve: &Curve<'_>) -> String {
    let order = curve.order.map_or_else(String::new, |order| format!("order {order:.1}, "));
    format!("{order}floor {:.0e}", curve.floor)
}

fn keys(picture: &mut Picture, row: f64, list: impl Iterator<Item = (Style, String, String)>) {
    for (number, (style, name, note)) in list.enumerate() {
        picture.key((KEYS, TOP + row * DOWN + 12.0 + 31.0 * number as f64), style, &name, &note);
    }
}
