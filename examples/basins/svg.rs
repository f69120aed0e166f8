//! The picture of the basins, as SVG.

use std::fmt::Write;

use crate::Fate;

/// Side of the square of all starts, in pixels.
const SIZE: f64 = 560.0;
const LEFT: f64 = 64.0;
const TOP: f64 = 40.0;
const FONT: &str = "font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"#222\"";

/// One start is a square in the colour of its fate; equal neighbours are one rectangle.
pub(crate) fn basins(side: usize, fates: &[Fate]) -> String {
    let (width, height) = (LEFT + SIZE + 24.0, TOP + SIZE + 64.0);
    let mut out = String::new();
    let _ =
        writeln!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\">");
    let _ = writeln!(out, "<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>");
    text(
        &mut out,
        (LEFT, 24.0),
        "start",
        "Turns after which an arm with two links comes to rest, by the angles it starts from",
    );
    let _ = writeln!(out, "<g shape-rendering=\"crispEdges\">");
    let cell = SIZE / side as f64;
    for (row, line) in fates.chunks(side).enumerate() {
        let mut column = 0;
        while let Some(&fate) = line.get(column) {
            let run = line.iter().skip(column).take_while(|&&other| other == fate).count();
            let (x, y) = (LEFT + cell * column as f64, TOP + SIZE - cell * (row + 1) as f64);
            let (width, colour) = (cell * run as f64, colour(fate));
            let _ = writeln!(
                out,
                "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{cell:.2}\" fill=\"{colour}\"/>"
            );
            column += run;
        }
    }
    let _ = writeln!(out, "</g>");
    let _ = writeln!(
        out,
        "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{SIZE}\" height=\"{SIZE}\" fill=\"none\" stroke=\"#222\"/>"
    );
    for (share, label) in [(0.0, "-180°"), (0.25, "-90°"), (0.5, "0°"), (0.75, "90°"), (1.0, "180°")] {
        text(&mut out, (LEFT + SIZE * share, TOP + SIZE + 18.0), "middle", label);
        text(&mut out, (LEFT - 6.0, TOP + SIZE * (1.0 - share) + 4.0), "end", label);
    }
    text(&mut out, (LEFT + SIZE / 2.0, TOP + SIZE + 36.0), "middle", "shoulder");
    let (x, y) = (14.0, TOP + SIZE / 2.0);
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" transform=\"rotate(-90 {x} {y})\" font-size=\"12\" text-anchor=\"middle\" {FONT}>elbow</text>"
    );
    let known =
        [("none", [0, 0]), ("elbow +", [0, 1]), ("elbow -", [0, -1]), ("shoulder +", [1, 0]), ("shoulder -", [-1, 0])];
    for (place, (label, turns)) in known.into_iter().enumerate() {
        let (x, y, colour) = (LEFT + 112.0 * place as f64, TOP + SIZE + 47.0, colour(Fate::Rests(turns)));
        let _ = writeln!(out, "<rect x=\"{x}\" y=\"{y}\" width=\"12\" height=\"12\" fill=\"{colour}\"/>");
        text(&mut out, (x + 17.0, y + 10.0), "start", label);
    }
    out.push_str("</svg>\n");
    out
}

fn text(out: &mut String, (x, y): (f64, f64), anchor: &str, text: &str) {
    let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" font-size=\"12\" text-anchor=\"{anchor}\" {FONT}>{text}</text>");
}

/// The sense of the turns chooses the hue, the number of those of the elbow the lightness.
fn colour(fate: Fate) -> String {
    match fate {
        Fate::Rests([0, 0]) => "#ececec".to_owned(),
        Fate::Rests([shoulder, elbow]) => {
            let hue = match (shoulder.signum(), elbow.signum()) {
                (1, _) => 140,
                (-1, _) => 290,
                (_, 1) => 210,
                _ => 25,
            };
            format!("hsl({hue},65%,{}%)", 80 - 15 * elbow.abs().min(4))
        }
        Fate::Moves => "#000".to_owned(),
        Fate::Lost => "#f0f".to_owned(),
    }
}
