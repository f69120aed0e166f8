//! The two pictures, written by hand as SVG.

use std::fmt::Write;

use multibody::nalgebra::{Matrix3, Vector3};

use crate::models::{FEET, PINS};

/// [N] of the six legs at a time [s]
pub(crate) type Sample = (f64, [f64; 6]);

/// One per leg, told apart by lightness too.
const COLOURS: [&str; 6] = ["#0b4f8a", "#3f9bdc", "#1b7f4d", "#8fc93a", "#b3261e", "#f0913a"];
const TEXT: &str = "font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"#222\"";

/// The structure of one constraint Jacobian.
pub(crate) struct Structure {
    pub(crate) title: &'static str,
    pub(crate) coordinates: &'static [&'static str],
    pub(crate) equations: &'static [&'static str],
    pub(crate) rows: &'static [&'static str],
}

/// Which leg a coordinate or an equation belongs to.
fn leg(name: &str) -> Option<usize> {
    name.strip_prefix("legs[")?.chars().next()?.to_digit(10).map(|digit| digit as usize)
}

/// Jacobians side by side, a square for each entry that is not always zero, in the colour of its leg.
pub(crate) fn jacobians(list: &[Structure]) -> String {
    const SIDE: f64 = 300.0;
    const GAP: f64 = 46.0;
    const TOP: f64 = 88.0;
    let width = GAP + (SIDE + GAP) * list.len() as f64;
    let tallest = list.iter().map(|one| one.rows.len() as f64 / one.coordinates.len() as f64).fold(0.0, f64::max);
    let height = TOP + SIDE * tallest + 58.0;
    let mut out = String::new();
    open(&mut out, width, height);
    text(&mut out, (GAP, 26.0), 16.0, "start", "Constraint Jacobians of the Stewart-Gough platform");
    for (number, structure) in list.iter().enumerate() {
        let left = GAP + (SIDE + GAP) * number as f64;
        let (rows, columns) = (structure.rows.len(), structure.coordinates.len());
        let cell = SIDE / columns as f64;
        let heading = format!("{}: {rows} equations, {columns} coordinates", structure.title);
        text(&mut out, (left, TOP - 28.0), 12.5, "start", &heading);
        // What the columns belong to.
        for owner in std::iter::once(None).chain((0..6).map(Some)) {
            let of: Vec<usize> = (0..columns).filter(|&column| leg(structure.coordinates[column]) == owner).collect();
            if let (Some(first), Some(last)) = (of.first(), of.last()) {
                let middle = left + cell * (first + last + 1) as f64 / 2.0;
                let label = owner.map_or_else(|| "plate".to_owned(), |leg| format!("leg {leg}"));
                text(&mut out, (middle, TOP - 7.0), 9.5, "middle", &label);
            }
        }
        for (row, entries) in structure.rows.iter().enumerate() {
            for (column, _) in entries.chars().enumerate().filter(|(_, entry)| *entry == 'x') {
                let of = leg(structure.equations[row]);
                let colour = of.map_or("#555", |leg| COLOURS[leg]);
                let opacity = if leg(structure.coordinates[column]) == of { 1.0 } else { 0.5 };
                let (x, y) = (left + cell * column as f64, TOP + cell * row as f64);
                let _ = writeln!(
                    out,
                    "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{0:.2}\" height=\"{0:.2}\" fill=\"{colour}\" opacity=\"{opacity}\"/>",
                    cell * 0.9
                );
            }
        }
        let _ = writeln!(
            out,
            "<rect x=\"{left:.2}\" y=\"{TOP:.2}\" width=\"{SIDE:.2}\" height=\"{:.2}\" fill=\"none\" stroke=\"#999\"/>",
            cell * rows as f64
        );
    }
    let base = height - 22.0;
    for (leg, colour) in COLOURS.iter().enumerate() {
        let x = GAP + 92.0 * leg as f64;
        let _ =
            writeln!(out, "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"13\" height=\"13\" fill=\"{colour}\"/>", base - 11.0);
        text(&mut out, (x + 19.0, base), 12.5, "start", &format!("leg {leg}"));
    }
    let note = "pale: what an equation takes from the plate or another leg";
    text(&mut out, (GAP + 92.0 * 6.0, base), 12.5, "start", note);
    out.push_str("</svg>\n");
    out
}

/// The manipulator at three times, and its forces over time as lines with points of the reference on them.
pub(crate) fn forces(poses: &[Vector3<f64>; 3], lines: &[Sample], points: &[Sample]) -> String {
    const MACHINE: f64 = 400.0;
    let mut out = String::new();
    open(&mut out, MACHINE + 850.0, 460.0);
    text(&mut out, (24.0, 30.0), 16.0, "start", "Stewart-Gough platform in a diagonal heave");
    machine(&mut out, poses);
    let _ = writeln!(out, "<g transform=\"translate({MACHINE} 0)\">");
    curves(&mut out, lines, points);
    out.push_str("</g>\n</svg>\n");
    out
}

/// The manipulator seen from above and aside: the outer poses pale, the middle one in full.
fn machine(out: &mut String, [low, middle, high]: &[Vector3<f64>; 3]) {
    let (across, up) = (38.0_f64.to_radians().sin_cos(), 36.0_f64.to_radians().sin_cos());
    let view = |p: Vector3<f64>| {
        let (right, away) = (across.1 * p.x + across.0 * p.y, across.1 * p.y - across.0 * p.x);
        (334.0 + 108.0 * right, 312.0 - 108.0 * (up.1 * p.z + up.0 * away))
    };
    let polygon = |out: &mut String, corners: Vec<Vector3<f64>>, style: &str| {
        let corners: Vec<String> = corners
            .into_iter()
            .map(|corner| {
                let (x, y) = view(corner);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let _ = writeln!(out, "<polygon points=\"{}\" {style}/>", corners.join(" "));
    };
    let line = |out: &mut String, from: Vector3<f64>, to: Vector3<f64>, style: &str| {
        let ((x1, y1), (x2, y2)) = (view(from), view(to));
        let _ = writeln!(
            out,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style} stroke-linecap=\"round\"/>"
        );
    };
    let feet = FEET.map(Vector3::from);
    polygon(out, feet.to_vec(), "fill=\"#eeeeee\" stroke=\"#bbbbbb\"");
    let (axes, origin) = (Matrix3::identity() * 0.45, Vector3::new(-0.9, -1.9, 0.0));
    for (axis, name) in axes.column_iter().zip(["x", "y", "z"]) {
        line(out, origin, origin + axis, "stroke=\"#555\" stroke-width=\"1.3\"");
        let (x, y) = view(origin + axis * 1.3);
        text(out, (x, y + 4.0), 12.0, "middle", name);
    }
    for (pose, opacity) in [(low, 0.2), (high, 0.2), (middle, 1.0)] {
        let _ = writeln!(out, "<g opacity=\"{opacity}\">");
        let pins = PINS.map(|pin| pose + Vector3::from(pin));
        for ((foot, pin), colour) in feet.iter().zip(pins).zip(COLOURS) {
            let half = foot + (pin - foot) * 0.55;
            line(out, *foot, pin, &format!("stroke=\"{colour}\" stroke-width=\"2.5\""));
            line(out, *foot, half, &format!("stroke=\"{colour}\" stroke-width=\"6\""));
        }
        let plate = "fill=\"#9aa4ad\" fill-opacity=\"0.55\" stroke=\"#4c5661\" stroke-width=\"1.5\"";
        polygon(out, pins.to_vec(), plate);
        out.push_str("</g>\n");
    }
    for (leg, (foot, (dx, dy))) in feet
        .iter()
        .zip([(0.0, -12.0), (-22.0, -6.0), (-24.0, 8.0), (4.0, 20.0), (20.0, 18.0), (22.0, -4.0)])
        .enumerate()
    {
        let (x, y) = view(*foot);
        text(out, (x + dx, y + dy), 12.5, "middle", &format!("leg {leg}"));
    }
}

fn curves(out: &mut String, lines: &[Sample], points: &[Sample]) {
    const LEFT: f64 = 66.0;
    const RIGHT: f64 = 736.0;
    const TOP: f64 = 56.0;
    const BOTTOM: f64 = 396.0;
    let all = || lines.iter().flat_map(|(_, forces)| forces.iter().copied());
    let (low, high) = (all().fold(f64::MAX, f64::min).floor(), all().fold(f64::MIN, f64::max).ceil());
    let end = lines.last().map_or(1.0, |sample| sample.0);
    let x = |t: f64| LEFT + (RIGHT - LEFT) * t / end;
    let y = |force: f64| BOTTOM - (BOTTOM - TOP) * (force - low) / (high - low);
    text(out, (LEFT, 30.0), 16.0, "start", "Leg forces over one period");
    let mut force = low;
    while force <= high {
        let at = y(force);
        let _ = writeln!(out, "<line x1=\"{LEFT}\" x2=\"{RIGHT}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"#ddd\"/>");
        text(out, (LEFT - 9.0, at + 4.5), 12.5, "end", &format!("{force:.0}"));
        force += if high - low > 12.0 { 2.0 } else { 1.0 };
    }
    for tenth in 0..=(end * 10.0) as u32 {
        let at = x(f64::from(tenth) * 0.1);
        let length = if tenth % 5 == 0 { 8.0 } else { 4.0 };
        let _ = writeln!(
            out,
            "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{BOTTOM}\" y2=\"{:.1}\" stroke=\"#555\"/>",
            BOTTOM + length
        );
        if tenth % 5 == 0 {
            text(out, (at, BOTTOM + 24.0), 12.5, "middle", &format!("{:.1}", f64::from(tenth) * 0.1));
        }
    }
    let _ = writeln!(out, "<line x1=\"{LEFT}\" x2=\"{RIGHT}\" y1=\"{BOTTOM}\" y2=\"{BOTTOM}\" stroke=\"#555\"/>");
    text(out, ((LEFT + RIGHT) / 2.0, BOTTOM + 46.0), 13.0, "middle", "time [s]");
    let middle = (TOP + BOTTOM) / 2.0;
    let _ = writeln!(
        out,
        "<text x=\"22\" y=\"{middle}\" font-size=\"13\" text-anchor=\"middle\" transform=\"rotate(-90 22 {middle})\" {TEXT}>force [N]</text>"
    );
    for (leg, colour) in COLOURS.iter().enumerate() {
        let path: Vec<String> = lines.iter().map(|(t, forces)| format!("{:.1},{:.2}", x(*t), y(forces[leg]))).collect();
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
            path.join(" ")
        );
        for (t, forces) in points {
            let (cx, cy) = (x(*t), y(forces[leg]));
            let _ = writeln!(
                out,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.2}\" r=\"3\" fill=\"white\" stroke=\"{colour}\" stroke-width=\"1.4\"/>"
            );
        }
        let at = TOP + 14.0 + 24.0 * leg as f64;
        let (from, to) = (RIGHT + 14.0, RIGHT + 40.0);
        let _ = writeln!(
            out,
            "<line x1=\"{from}\" x2=\"{to}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        text(out, (to + 7.0, at + 4.5), 12.5, "start", &format!("leg {leg}"));
    }
    let at = TOP + 14.0 + 24.0 * 6.0;
    let _ = writeln!(
        out,
        "<circle cx=\"{}\" cy=\"{at:.1}\" r=\"3\" fill=\"white\" stroke=\"#555\" stroke-width=\"1.4\"/>",
        RIGHT + 27.0
    );
    text(out, (RIGHT + 47.0, at + 4.5), 12.5, "start", "40 digits");
}

fn open(out: &mut String, width: f64, height: f64) {
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>"
    );
}

fn text(out: &mut String, (x, y): (f64, f64), size: f64, anchor: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" {TEXT}>{words}</text>"
    );
}
