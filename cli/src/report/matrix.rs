//! The structure of a matrix as a grid of squares.

use std::fmt::Write;

use multibody_engine::mechanics::Entry;

use super::document::Figure;
use super::svg::{Picture, number, width};

const LABEL: f64 = 11.0;

/// Beyond so many rows or columns squares have no names.
const MOST_NAMED: usize = 48;

const LEGEND: [(&str, &str); 4] = [
    ("zero", "always zero"),
    ("constant", "a number"),
    ("parameters", "depends on parameters alone"),
    ("varying", "changes with the motion"),
];

/// Rows are named, columns are numbered as the names of `columns` are.
pub(super) fn figure(title: &str, entries: &[Entry], rows: &[String], columns: &[String]) -> Figure {
    let count = |entry: Entry| entries.iter().filter(|other| **other == entry).count();
    let (all, zero) = (entries.len(), count(Entry::Zero));
    let percent = 100.0 * zero as f64 / all.max(1) as f64;
    let shown = |class: &str| entries.iter().any(|entry| self::class(*entry) == class);
    Figure {
        svg: svg(title, entries, rows, columns.len()),
        text: text(entries, rows, columns.len()),
        caption: format!(
            "{} by {}; {zero} of {all} entries are always zero ({percent:.0} %).",
            rows.len(),
            columns.len()
        ),
        legend: LEGEND.into_iter().filter(|(class, _)| shown(class)).collect(),
    }
}

fn class(entry: Entry) -> &'static str {
    match entry {
        Entry::Zero => "zero",
        Entry::Constant => "constant",
        Entry::Parameters => "parameters",
        Entry::Varying => "varying",
    }
}

fn svg(title: &str, entries: &[Entry], rows: &[String], columns: usize) -> String {
    let size = rows.len().max(columns);
    let named = size <= MOST_NAMED;
    let cell = match size {
        0..=24 => 18.0,
        25..=MOST_NAMED => 13.0,
        _ => (600.0 / size as f64).clamp(3.0, 9.0),
    };
    let digits = if named { width(&size.to_string(), LABEL) } else { 0.0 };
    let names = rows.iter().map(|name| width(name, LABEL)).fold(0.0, f64::max);
    let (left, top) = if named { (names + digits + 22.0, 20.0) } else { (2.0, 2.0) };
    let [w, h] = [left + columns as f64 * cell + 2.0, top + rows.len() as f64 * cell + 2.0];
    let mut picture = Picture::new("matrix", title.to_owned(), w, h);
    if named {
        for (k, name) in rows.iter().enumerate() {
            let y = top + (k as f64 + 0.5) * cell + 4.0;
            picture.text("label", "start", [0.0, y], name);
            picture.text("label", "end", [left - 6.0, y], &(k + 1).to_string());
        }
        for k in 0..columns {
            let text = (k + 1).to_string();
            // Numbers of two digits are as wide as two small squares: every other one stands.
            if cell > 14.0 || k % 2 == 0 {
                picture.text("label", "middle", [left + (k as f64 + 0.5) * cell, top - 6.0], &text);
            }
        }
    }
    // Small squares of zeros, which are nearly all, are one.
    if !named {
        let [width, height] = [columns, rows.len()].map(|count| number(count as f64 * cell));
        picture
            .add(&format!("<rect class=\"ground\" x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/>"));
    }
    let gap = if cell > 6.0 { 1.5 } else { 0.0 };
    let drawn = entries.iter().enumerate().filter(|(_, entry)| named || **entry != Entry::Zero);
    for (k, entry) in drawn {
        let (row, column) = (k / columns, k % columns);
        let [x, y] = [left + column as f64 * cell, top + row as f64 * cell].map(|at| number(at + gap / 2.0));
        let side = number(cell - gap);
        let class = class(*entry);
        picture.add(&format!("<rect class=\"entry {class}\" x=\"{x}\" y=\"{y}\" width=\"{side}\" height=\"{side}\"/>"));
    }
    picture.finish()
}

/// `.` for zero, `1` for a number, `p` for parameters, `x` for what changes.
fn text(entries: &[Entry], rows: &[String], columns: usize) -> String {
    let letter = |entry: &Entry| match entry {
        Entry::Zero => '.',
        Entry::Constant => '1',
        Entry::Parameters => 'p',
        Entry::Varying => 'x',
    };
    let mut text = String::new();
    for (row, name) in entries.chunks(columns.max(1)).zip(rows) {
        let _ = writeln!(text, "{}  {name}", row.iter().map(letter).collect::<String>());
    }
    text
}
