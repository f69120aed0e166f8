//! What is told of the choices of one model: a table, reasons of refusals, a recommendation.

use std::cmp::Ordering;
use std::fmt::Write;

use super::choice::{Choice, Constraints};
use super::{Figures, JUDGED, Row};
use crate::commands::counts::{KINDS, numbers};
use crate::table::Table;

/// Times that differ by less are equal: so much they do from one run to the next.
const EQUAL: f64 = 1.05;
/// Work says less of times: see `effort.rs`.
const SIMILAR: f64 = 1.1;

/// What is written, with `Auto` and without it, and all rows.
pub(super) fn text(name: &str, written: Choice, own: Choice, rows: &[Row]) -> String {
    let mut text = format!("{name}\n{}", table(rows, own));
    if rows.iter().any(|row| row.choice == own) {
        text.push_str("  * as it is written");
        let is_auto = written.constraints == Constraints::Auto;
        text.push_str(if is_auto { ": what `constraints: Auto` stands for\n" } else { "\n" });
    }
    for row in rows {
        if let Err(reason) = &row.result {
            let _ = writeln!(text, "  {} is refused: {reason}", row.choice.words());
        }
    }
    for row in rows {
        if let Some(sizes) = row.result.as_ref().ok().and_then(|figures| left(&figures.pivoted)) {
            let _ = writeln!(text, "  {}: {sizes}", row.choice.words());
        }
    }
    for row in untimed(rows) {
        let _ =
            writeln!(text, "  {} is not timed: accelerations near the default position are not finite", row.words());
    }
    text.push_str(&advice(rows, own));
    text
}

/// What becomes of equations with multipliers, where there are some.
fn left((absorbed, cores): &(usize, Vec<usize>)) -> Option<String> {
    let left: usize = cores.iter().sum();
    let all = absorbed + left;
    let largest = cores.iter().max().map_or_else(String::new, |size| format!(", in systems of {size} at most"));
    (all > 0).then(|| format!("limbs absorb {absorbed} of {all} equations, {left} are solved with pivots{largest}"))
}

/// Choices without a time where others have one.
fn untimed(rows: &[Row]) -> impl Iterator<Item = &Row> {
    let has_time = |row: &&Row| row.result.as_ref().is_ok_and(|figures| figures.time(JUDGED).is_some());
    let is_measured = rows.iter().any(|row| has_time(&row));
    rows.iter().filter(move |row| is_measured && row.result.is_ok() && !has_time(row))
}

fn table(rows: &[Row], own: Choice) -> String {
    let all = || rows.iter().filter_map(|row| row.result.as_ref().ok());
    let mut functions: Vec<&str> = Vec::new();
    for (name, _) in all().flat_map(|figures| &figures.others) {
        if !functions.contains(&name.as_str()) {
            functions.push(name);
        }
    }
    let quickest = |function: &str| {
        let times = all().filter_map(|figures| figures.time(function));
        times.min_by(f64::total_cmp)
    };
    // Columns of times, where there are any.
    let timed: Vec<(&str, f64)> = std::iter::once(JUDGED)
        .chain(functions.iter().copied())
        .filter_map(|function| Some((function, quickest(function)?)))
        .collect();
    let is_measured = !timed.is_empty();

    let heads = ["coordinates", "constraints", "state", "multipliers", "equations"].into_iter();
    let mut heads: Vec<String> = heads.chain(KINDS).chain(["work"]).map(String::from).collect();
    let mut titles = vec![(5, JUDGED)];
    if !functions.is_empty() {
        titles.push((heads.len(), "work of the other functions"));
        heads.extend(functions.iter().map(|name| (*name).to_owned()));
    }
    if is_measured {
        titles.push((heads.len(), "time, over the least"));
        heads.extend(timed.iter().flat_map(|(name, _)| [(*name).to_owned(), String::new()]));
    }
    heads.push("derived".to_owned());

    let mut table = Table::new(2, heads).titled(titles);
    for Row { choice, result } in rows {
        let mark = if *choice == own { "*" } else { "" };
        let held = match (choice.constraints, result) {
            (Constraints::Multipliers, Ok(figures)) if figures.multipliers == 0 => "no equations",
            (constraints, _) => constraints.word(),
        };
        let words = [format!("{}{mark}", choice.coordinates.word()), held.to_owned()];
        let Ok(figures) = result else {
            table.row(words.into_iter().chain(["refused".to_owned()]));
            continue;
        };
        let sizes = [figures.state, figures.multipliers, figures.equations()].map(|n| n.to_string());
        let counts = numbers(&figures.cost).map(|n| n.to_string());
        let others = functions.iter().map(|name| {
            let work = figures.others.iter().find(|(other, _)| other == name);
            work.map_or_else(|| "-".to_owned(), |(_, work)| work.to_string())
        });
        let times = timed.iter().flat_map(|(function, least)| match figures.time(function) {
            Some(time) => [nanoseconds(time), format!("{:.2}", time / least)],
            None => ["-".to_owned(), "-".to_owned()],
        });
        let derived = format!("{:.0} ms", figures.derived.as_secs_f64() * 1e3);
        let cells = words.into_iter().chain(sizes).chain(counts).chain([figures.work.to_string()]);
        table.row(cells.chain(others).chain(times).chain([derived]));
    }
    table.text()
}

fn nanoseconds(time: f64) -> String {
    match time {
        time if time < 100.0 => format!("{time:.1} ns"),
        time if time < 1e4 => format!("{time:.0} ns"),
        time => format!("{:.1} us", time / 1e3),
    }
}

/// Which choice to take, and why: by time where that was measured, else by work.
fn advice(rows: &[Row], own: Choice) -> String {
    let good = || rows.iter().filter_map(|row| Some((row, row.result.as_ref().ok()?)));
    let timed: Vec<Judged<'_>> =
        good().filter_map(|(row, figures)| Some(Judged { row, figures, amount: figures.time(JUDGED)? })).collect();
    let chosen = if timed.is_empty() {
        let all = good().map(|(row, figures)| Judged { row, figures, amount: f64::from(figures.work) });
        choose(all.collect(), own, SIMILAR, "work", |work| work.to_string())
    } else {
        choose(timed, own, EQUAL, "time", nanoseconds)
    };
    let Some((row, figures, reason)) = chosen else { return "  no choice is admitted\n".to_owned() };
    let same = if row.choice == own { ", as it is written" } else { "" };
    let mut text = format!("  recommended: {}{same}\n    since {reason}\n", row.words());
    if figures.multipliers > 0 {
        let _ = writeln!(text, "    loops drift: they are kept closed by projection or by Baumgarte's terms");
    } else if figures.has_dead_centres {
        let _ = writeln!(text, "    loops cannot drift; motions end at the dead centres of their solution");
    }
    text
}

/// A choice with the number that it is judged by.
struct Judged<'a> {
    row: &'a Row,
    figures: &'a Figures,
    amount: f64,
}

/// Of choices whose amounts differ by less than the factor `equal` the one with fewest multipliers, since those have a price
/// of their own: loops drift.
fn choose<'a>(
    mut list: Vec<Judged<'a>>,
    own: Choice,
    equal: f64,
    what: &str,
    written: impl Fn(f64) -> String,
) -> Option<(&'a Row, &'a Figures, String)> {
    list.sort_by(|a, b| a.amount.total_cmp(&b.amount));
    let most = equal * list.first()?.amount;
    let equals = list.iter().take_while(|judged| judged.amount <= most);
    let best = equals.min_by_key(|Judged { row, figures, .. }| {
        // The first of equal ones has the least amount, but that the user's own stands before those.
        (figures.multipliers, figures.equations(), row.choice != own)
    })?;
    let reason = match list.iter().find(|other| other.row.choice != best.row.choice) {
        None => "no other choice is admitted".to_owned(),
        Some(next) if next.amount >= best.amount * equal => format!(
            "{JUDGED} takes least {what}, {}; next are {} with {:.2} times as much{}",
            written(best.amount),
            next.row.words(),
            next.amount / best.amount.max(f64::MIN_POSITIVE),
            next.figures.burden.as_ref().map_or_else(String::new, |burden| format!(" ({burden})"))
        ),
        Some(next) => {
            let with = match next.figures.multipliers.cmp(&best.figures.multipliers) {
                Ordering::Greater => ", and it has fewer multipliers",
                _ => "",
            };
            format!(
                "{JUDGED} takes {what} {}, about as much as with {}, {}{with}",
                written(best.amount),
                next.row.words(),
                written(next.amount)
            )
        }
    };
    Some((best.row, best.figures, reason))
}
