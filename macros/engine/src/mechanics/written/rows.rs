//! Room `written`: what lines have in common is written once.
//!
//! In: lines of constraints and of their Jacobian. Out: the same, where what the equations of one loop share has a name and a line
//! before them, as long as the loop takes no more than eight lines; entries of the Jacobian read these names. In all other lines what
//! is long and stands in several has a name.

use std::collections::HashSet;

use crate::model::types::LoopClosure;
use crate::symbolic::write::formula::{Class, Equation, Formula, Identifier};
use crate::symbolic::write::share::{By, Shared, put_in, share};
use crate::symbolic::write::vacant;

use super::{Line, Subject};

/// Lines of one loop.
const MOST_LINES: usize = 8;

/// Names what the equations of each loop share. `closing` is what an entry of the Jacobian belongs to, `part` the part of a line.
pub(super) fn shared(
    mut lines: Vec<Line>,
    closing: &dyn Fn(Subject) -> Option<LoopClosure>,
    part: &dyn Fn(Subject) -> Option<String>,
    taken: &mut HashSet<String>,
) -> Vec<Line> {
    let mut loops: Vec<LoopClosure> = Vec::new();
    for one in lines.iter().filter_map(|line| closing(line.subject)) {
        if !loops.contains(&one) {
            loops.push(one);
        }
    }
    for one in loops {
        let of_loop = |line: &Line| closing(line.subject) == Some(one);
        let is_row = |line: &Line| of_loop(line) && matches!(line.subject, Subject::Constraint(_));
        let rows: Vec<usize> = (0..lines.len()).filter(|&at| is_row(&lines[at])).collect();
        let Some(&first) = rows.first() else { continue };
        let prefix = part(lines[first].subject).map_or(String::new(), |part| part + ".");
        let mut formulas: Vec<Formula> = rows.iter().map(|&at| lines[at].equation.right.clone()).collect();
        let most = MOST_LINES.saturating_sub(rows.len());
        let name = format!("{prefix}u_1");
        let shared = share(&mut formulas, By::Operations, most, &mut |_| apart_name(vacant(&name, taken)));
        for (&at, formula) in rows.iter().zip(&formulas) {
            lines[at].equation.right = formula.clone();
        }
        for line in lines.iter_mut().filter(|line| of_loop(line) && matches!(line.subject, Subject::Slope(..))) {
            put_in(&mut line.equation.right, &shared);
        }
        insert(&mut lines, &rows, &formulas, shared);
    }
    lines
}

/// Sections of more symbols are left as they are.
const MOST_SYMBOLS: usize = 4_000;
/// Names of what lines of a section have in common.
const MOST_NAMES: usize = 6;

/// Names what is long and stands in several lines of a section.
pub(super) fn shortened(mut lines: Vec<Line>, taken: &mut HashSet<String>) -> Vec<Line> {
    if lines.iter().map(|line| line.equation.right.length()).sum::<usize>() > MOST_SYMBOLS {
        return lines;
    }
    let all: Vec<usize> = (0..lines.len()).collect();
    let mut formulas: Vec<Formula> = lines.iter().map(|line| line.equation.right.clone()).collect();
    let shared = share(&mut formulas, By::Length, MOST_NAMES, &mut |_| apart_name(vacant("u_1", taken)));
    for (line, formula) in lines.iter_mut().zip(&formulas) {
        line.equation.right = formula.clone();
    }
    insert(&mut lines, &all, &formulas, shared);
    lines
}

fn apart_name(text: String) -> Identifier {
    Identifier { text, dots: 0, index: None, class: Class::Defined, typed: false }
}

/// Puts lines of names before the first that reads each.
fn insert(lines: &mut Vec<Line>, rows: &[usize], formulas: &[Formula], shared: Vec<Shared>) {
    let places = places(rows, formulas, &shared);
    let mut all: Vec<(usize, Shared)> = places.into_iter().zip(shared).collect();
    // From behind, so that places before stay what they are; those of one place stay in their order.
    all.sort_by_key(|entry| entry.0);
    for (at, shared) in all.into_iter().rev() {
        let equation = Equation { left: Formula::Name(shared.name), right: shared.value };
        lines.insert(at, Line { subject: Subject::Definition, equation, says: None });
    }
}

/// Lines that read each name first, by itself or through another name.
fn places(rows: &[usize], formulas: &[Formula], shared: &[Shared]) -> Vec<usize> {
    let mut places = vec![usize::MAX; shared.len()];
    for k in (0..shared.len()).rev() {
        let name = &shared[k].name;
        let direct = rows.iter().zip(formulas).find(|(_, formula)| reads(formula, name)).map(|(&at, _)| at);
        let others =
            (k + 1..shared.len()).filter(|&other| reads(&shared[other].value, name)).map(|other| places[other]);
        places[k] = direct.into_iter().chain(others).min().unwrap_or(rows[0]);
    }
    places
}

fn reads(formula: &Formula, name: &Identifier) -> bool {
    let mut found = matches!(formula, Formula::Name(own) if own == name);
    formula.each_part(&mut |part| found |= reads(part, name));
    found
}
