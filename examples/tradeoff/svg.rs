//! Panels with logarithmic axes, written by hand as SVG: curves with their names beside them.

use std::fmt::Write;

const TEXT: &str = "text{font-family:DejaVu Sans,Verdana,sans-serif}polyline,path{fill:none}";
/// Greatest number of digits between two lines of the grid.
const LINES: i32 = 6;

/// Pixels between two names at least.
const GAP: f64 = 4.0;

/// How a curve is drawn.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Style {
    pub(crate) colour: &'static str,
    pub(crate) mark: Mark,
    pub(crate) dashed: bool,
    pub(crate) width: f64,
}

/// The shape of its points.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
}

/// A curve: its name beside it, and its points from coarse to fine.
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) style: Style,
    pub(crate) points: Vec<(f64, f64)>,
}

/// One diagram.
pub(crate) struct Panel {
    pub(crate) title: &'static str,
    pub(crate) across: &'static str,
    pub(crate) lines: Vec<Line>,
    /// Points of the hull, from cheap to accurate.
    pub(crate) hull: Vec<(f64, f64)>,
    /// Least and greatest values shown upwards.
    pub(crate) heights: (f64, f64),
}

/// A picture under construction.
pub(crate) struct Picture {
    out: String,
    /// Styles whose marks are defined: by number.
    marks: Vec<Style>,
}

/// A rectangle: left, top, right, bottom.
#[derive(Clone, Copy)]
struct Place {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Place {
    fn meets(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    fn wider(&self, by: f64) -> Self {
        Self { left: self.left - by, right: self.right + by, ..*self }
    }

    fn holds(&self, (x, y): (f64, f64)) -> bool {
        self.left < x && x < self.right && self.top < y && y < self.bottom
    }
}

impl Picture {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
             <style>{TEXT}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
        );
        Self { out, marks: Vec::new() }
    }

    pub(crate) fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }

    pub(crate) fn text(&mut self, (x, y): (f64, f64), size: f64, anchor: &str, colour: &str, words: &str) {
        let words = words.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(
            self.out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{colour}\">{words}</text>"
        );
    }

    /// A name with its style, a note under it.
    pub(crate) fn key(&mut self, (x, y): (f64, f64), style: Style, name: &str, note: &str) {
        self.stroke(&[(x, y - 4.0), (x + 15.0, y - 4.0), (x + 30.0, y - 4.0)], style, "mid");
        self.text((x + 38.0, y), 11.5, "start", "#222", name);
        self.text((x + 38.0, y + 12.5), 9.5, "start", "#777", note);
    }

    /// A curve with its marks, at all points or at those between.
    fn stroke(&mut self, points: &[(f64, f64)], style: Style, marked: &str) {
        let number = self.defined(style);
        let list: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let dash = if style.dashed { " stroke-dasharray=\"5 3\"" } else { "" };
        let ends = if marked == "mid" {
            String::new()
        } else {
            format!(" marker-start=\"url(#m{number})\" marker-end=\"url(#m{number})\"")
        };
        let _ = writeln!(
            self.out,
            "<polyline points=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{dash} marker-mid=\"url(#m{number})\"{ends}/>",
            list.join(" "),
            style.colour,
            style.width
        );
    }

    /// The number of a style's mark, defined where it is first used.
    fn defined(&mut self, style: Style) -> usize {
        if let Some(number) = self.marks.iter().position(|other| *other == style) {
            return number;
        }
        let number = self.marks.len();
        self.marks.push(style);
        let (fill, colour) = (if style.dashed { "white" } else { style.colour }, style.colour);
        let shape = match style.mark {
            Mark::Circle => "a2.1 2.1 0 1 0 4.2 0a2.1 2.1 0 1 0-4.2 0z",
            Mark::Square => "m.2-1.9h3.8v3.8h-3.8z",
            Mark::Triangle => "m2.1-2.9l2.7 4.6h-5.4z",
            Mark::Diamond => "m2.1-2.8l2.8 2.8l-2.8 2.8l-2.8-2.8z",
        };
        let _ = writeln!(
            self.out,
            "<marker id=\"m{number}\" viewBox=\"-4 -4 8 8\" markerWidth=\"8\" markerHeight=\"8\" markerUnits=\"userSpaceOnUse\"><path d=\"M-2.1 0{shape}\" style=\"fill:{fill}\" stroke=\"{colour}\" stroke-dasharray=\"99\"/></marker>"
        );
        number
    }

    /// A panel whose frame has its left upper corner at the given point.
    pub(crate) fn panel(&mut self, panel: &Panel, (left, top): (f64, f64), (width, height): (f64, f64)) {
        let frame = Place { left, top, right: left + width, bottom: top + height };
        let (low, high) = panel.heights;
        let visible = |(x, y): (f64, f64)| x > 0.0 && x.is_finite() && y <= high && y > 0.0;
        let widths =
            panel.lines.iter().flat_map(|line| &line.points).filter(|point| visible(**point)).map(|point| point.0);
        let (mut from, mut to) = (f64::INFINITY, 0.0_f64);
        for x in widths {
            (from, to) = (from.min(x), to.max(x));
        }
        if from >= to {
            (from, to) = (1.0, 10.0);
        }
        let (from, to) = (from.log10() - 0.1, to.log10() + 0.35);
        let (bottom, up) = (low.log10(), high.log10());
        let place = |(x, y): (f64, f64)| {
            let y = y.max(low);
            (
                left + width * (x.log10() - from) / (to - from),
                frame.bottom - height * (y.log10() - bottom) / (up - bottom),
            )
        };
        self.text((left, top - 10.0), 12.5, "start", "#222", panel.title);
        self.grid(&frame, (from, to), (bottom, up));
        self.text(((left + frame.right) / 2.0, frame.bottom + 32.0), 11.0, "middle", "#444", panel.across);

        if panel.hull.len() > 1 {
            let hull: Vec<(f64, f64)> = panel.hull.iter().filter(|point| visible(**point)).map(|p| place(*p)).collect();
            let list: Vec<String> = hull.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            let _ = writeln!(
                self.out,
                "<polyline points=\"{}\" stroke=\"#f5d76e\" stroke-opacity=\"0.75\" stroke-width=\"11\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
                list.join(" ")
            );
        }
        let drawn: Vec<Vec<(f64, f64)>> = panel
            .lines
            .iter()
            .map(|line| line.points.iter().filter(|point| visible(**point)).map(|point| place(*point)).collect())
            .collect();
        for (line, points) in panel.lines.iter().zip(&drawn) {
            self.stroke(points, line.style, "all");
        }
        self.names(panel, &drawn, &frame);
    }

    fn grid(&mut self, frame: &Place, (from, to): (f64, f64), (bottom, up): (f64, f64)) {
        let Place { left, top, right, bottom: floor } = *frame;
        let every = ((up - bottom) / f64::from(LINES)).ceil().max(1.0) as i32;
        let [mut strong, mut weak] = [String::new(), String::new()];
        for power in (bottom.ceil() as i32)..=(up.floor() as i32) {
            let y = floor - (floor - top) * (f64::from(power) - bottom) / (up - bottom);
            let named = power.rem_euclid(every) == 0;
            let _ = write!(if named { &mut strong } else { &mut weak }, "M{left:.1} {y:.1}H{right:.1}");
            if named {
                self.power((left - 6.0, y + 4.0), "end", power);
            }
        }
        for power in (from.ceil() as i32)..=(to.floor() as i32) {
            let x = left + (right - left) * (f64::from(power) - from) / (to - from);
            let _ = write!(strong, "M{x:.1} {top:.1}V{floor:.1}");
            self.power((x, floor + 15.0), "middle", power);
        }
        for (lines, colour) in [(weak, "#f1f1f1"), (strong, "#dcdcdc")] {
            let _ = writeln!(self.out, "<path d=\"{lines}\" stroke=\"{colour}\" stroke-width=\"0.7\"/>");
        }
        let _ = writeln!(
            self.out,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#999\" stroke-width=\"0.8\"/>",
            right - left,
            floor - top
        );
    }

    fn power(&mut self, at: (f64, f64), anchor: &str, power: i32) {
        const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let digits = power.unsigned_abs().to_string();
        let sign = if power < 0 { "⁻" } else { "" };
        let raised: String = digits.bytes().map(|digit| DIGITS[usize::from(digit - b'0')]).collect();
        self.text(at, 10.5, anchor, "#444", &format!("10{sign}{raised}"));
    }

    /// Each curve's name beside it, where it covers least.
    fn names(&mut self, panel: &Panel, drawn: &[Vec<(f64, f64)>], frame: &Place) {
        const SIZE: f64 = 9.5;
        let dense: Vec<(f64, f64)> = drawn.iter().flat_map(|points| densely(points)).collect();
        let mut taken: Vec<Place> = Vec::new();
        for (line, points) in panel.lines.iter().zip(drawn) {
            let wide = line.name.chars().count() as f64 * SIZE * 0.6;
            let mut best: Option<(f64, Place)> = None;
            for (number, &(x, y)) in densely(points).iter().rev().enumerate() {
                for (dx, dy) in [
                    (7.0, 3.5),
                    (7.0, 12.0),
                    (-7.0 - wide, 3.5),
                    (-7.0 - wide, 12.0),
                    (4.0, -6.0),
                    (-wide / 2.0, 16.0),
                    (-wide / 2.0, -8.0),
                ] {
                    let place = Place {
                        left: x + dx - 1.0,
                        right: x + dx + wide + 1.0,
                        top: y + dy - SIZE + 1.0,
                        bottom: y + dy + 2.5,
                    };
                    let inside = place.left > frame.left + 2.0
                        && place.right < frame.right - 2.0
                        && place.top > frame.top + 2.0
                        && place.bottom < frame.bottom - 2.0;
                    if !inside || taken.iter().any(|other| other.meets(&place.wider(GAP))) {
                        continue;
                    }
                    let covered = dense.iter().filter(|&&point| place.holds(point)).count() as f64;
                    let worth = 3.0 * covered + 0.12 * number as f64;
                    if best.as_ref().is_none_or(|(least, _)| worth < *least) {
                        best = Some((worth, place));
                    }
                }
            }
            if let Some((_, place)) = best {
                taken.push(place);
                let at = (place.left + 1.0, place.bottom - 2.5);
                // A white edge first, so that curves do not run into the letters.
                for edge in [" stroke=\"white\" stroke-width=\"2.6\"", ""] {
                    let _ = writeln!(
                        self.out,
                        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{SIZE}\" fill=\"{}\"{edge}>{}</text>",
                        at.0, at.1, line.style.colour, line.name
                    );
                }
            }
        }
    }
}

/// Points along a curve, a few pixels apart.
fn densely(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut list = points.first().copied().into_iter().collect::<Vec<_>>();
    for pair in points.windows(2) {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let parts = ((x1 - x0).hypot(y1 - y0) / 3.0).ceil().max(1.0);
        for k in 1..=parts as usize {
            let share = k as f64 / parts;
            list.push((x0 + share * (x1 - x0), y0 + share * (y1 - y0)));
        }
    }
    list
}
