//! `diff`: what has changed between two files in the operations of functions, and in equations.

use std::fmt::Write;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::mechanics::written::Page;
use multibody_engine::symbolic::write::text;

use super::counts::{KINDS, numbers, rows};
use crate::Stop;
use crate::arguments::Subject;
use crate::build::{self, Built};
use crate::table::Table;

pub(crate) fn run(old: &Subject, new: &Subject) -> Result<String, Stop> {
    let (old_pages, new_pages) = (build::pages(old)?, build::pages(new)?);
    let (old, new) = (build::models(old)?, build::models(new)?);
    let mut text = String::new();
    for (model, page) in old.iter().zip(&old_pages) {
        match new.iter().zip(&new_pages).find(|(other, _)| other.name() == model.name()) {
            Some((other, new_page)) => {
                text.push_str(&changes(model, other));
                text.push_str(&equations(&page.1, &new_page.1));
            }
            None => {
                let _ = writeln!(text, "{}: is gone", model.name());
            }
        }
    }
    for model in &new {
        if !old.iter().any(|other| other.name() == model.name()) {
            let _ = writeln!(text, "{}: is new", model.name());
        }
    }
    Ok(text)
}

/// Equations that stand in one page and not in the other, beside each other where their left sides are the same.
fn equations(old: &Page, new: &Page) -> String {
    let lines = |page: &Page| -> Vec<(String, String)> {
        let lines = page.sections.iter().flat_map(|section| &section.lines);
        lines.map(|line| (text::formula(&line.equation.left), text::equation(&line.equation))).collect()
    };
    let (old, new) = (lines(old), lines(new));
    let mut out = String::new();
    for (left, equation) in old.iter().filter(|line| !new.contains(line)) {
        let _ = writeln!(out, "  - {equation}");
        if let Some((_, equation)) = new.iter().find(|line| line.0 == *left && !old.contains(line)) {
            let _ = writeln!(out, "  + {equation}");
        }
    }
    for (left, equation) in new.iter().filter(|line| !old.contains(line)) {
        if !old.iter().any(|line| line.0 == *left && !new.contains(line)) {
            let _ = writeln!(out, "  + {equation}");
        }
    }
    out
}

/// Functions of one model that have changed.
fn changes(old: &Built, new: &Built) -> String {
    let name = new.name();
    let (old, new) = (rows(old), rows(new));
    let find = |rows: &[(String, Option<Cost>, Cost)], function: &str| {
        rows.iter().find(|(name, ..)| name == function).map(|(.., cost)| *cost)
    };
    let mut table = Table::new(1, ["function"].into_iter().chain(KINDS).chain(["work"]));
    let mut changed = false;
    for (function, _, before) in &old {
        let after = find(&new, function);
        match after {
            Some(after) if after == *before => {}
            Some(after) => {
                changed = true;
                let pairs = numbers(before).into_iter().zip(numbers(&after));
                let cells = pairs.map(|(before, after)| change(before, after)).chain([work(before, &after)]);
                table.row(std::iter::once(function.clone()).chain(cells));
            }
            None => {
                changed = true;
                table.row([function.clone(), "is gone".to_owned()]);
            }
        }
    }
    for (function, ..) in new.iter().filter(|(function, ..)| find(&old, function).is_none()) {
        changed = true;
        table.row([function.clone(), "is new".to_owned()]);
    }
    if changed { format!("{name}\n{}", table.text()) } else { format!("{name}: the same operations\n") }
}

/// `12 -> 9`, or one number where nothing has changed.
fn change(before: u32, after: u32) -> String {
    if before == after { before.to_string() } else { format!("{before} -> {after}") }
}

/// The change of the weighted sum of all operations.
fn work(before: &Cost, after: &Cost) -> String {
    let (before, after) = (f64::from(before.weight()), f64::from(after.weight()));
    if before == 0.0 { "new".to_owned() } else { format!("{:+.1} %", 100.0 * (after / before - 1.0)) }
}
