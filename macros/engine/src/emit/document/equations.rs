//! Stage `emit`: equations in documentation.
//!
//! In: the page of a model that says `emit report`. Out: Markdown. The module's page has them as MathML, which browsers set
//! without a script, in `<div>` blocks without empty lines, long sections folded; a function has the equations of what it gives
//! as plain text, since editors that show documentation know no MathML.

use crate::contracts::function::FunctionKind;
use crate::mechanics::written::{Line, Page, Section, Subject};
use crate::model::types::Request;
use crate::symbolic::write::mathml;

use super::super::layout::Layout;

/// A section of more equations is folded.
const MOST_UNFOLDED: usize = 24;
/// Beyond this many a section is cut: nobody reads them on a page, and constants and files have them all.
const MOST_WRITTEN: usize = 400;
/// Lines in the documentation of a function, each no longer than this.
const MOST_LINES: usize = 10;
const MOST_CHARACTERS: usize = 140;

/// Browsers break no lines in equations: what is too long for the page is moved by hand.
const WIDE: &str = "<div style=\"overflow-x:auto\">";

fn page<'a>(layout: &Layout<'a>) -> Option<&'a Page> {
    let asked = layout.model.emit.contains(&Request::Report);
    layout.structure.page.as_deref().filter(|_| asked)
}

/// The sections of the module's page.
pub(in crate::emit) fn lines(layout: &Layout<'_>) -> Vec<String> {
    let Some(page) = page(layout) else { return Vec::new() };
    let mut lines = vec![String::new(), "## Equations".to_owned()];
    for section in &page.sections {
        lines.extend([String::new(), format!("### {}", section.title), String::new()]);
        for says in &section.says {
            lines.extend([says.clone(), String::new()]);
        }
        lines.extend(block(page, section));
    }
    lines
}

/// The equations of a section as one block of HTML.
fn block(page: &Page, section: &Section) -> Vec<String> {
    let shown = page.folded(section);
    let count = shown.len();
    if count == 0 {
        return Vec::new();
    }
    let mut block: Vec<String> = shown.iter().take(MOST_WRITTEN).map(|folded| equation(&folded.line)).collect();
    if count > MOST_WRITTEN {
        block.push(format!("<p>and {} more</p>", count - MOST_WRITTEN));
    }
    let (open, close) = match count > MOST_UNFOLDED {
        true => (format!("<details><summary>{count} equations</summary>{WIDE}"), "</div></details>"),
        false => (WIDE.to_owned(), "</div>"),
    };
    std::iter::once(open).chain(block).chain([close.to_owned()]).collect()
}

fn equation(line: &Line) -> String {
    let math = mathml::equation(&line.equation);
    match &line.says {
        Some(says) => format!("{math}<p style=\"text-align:center\">{}</p>", in_block(says)),
        None => math,
    }
}

/// Markdown for a block of HTML, inside which it is not read.
fn in_block(says: &str) -> String {
    let mut html = String::new();
    let mut is_code = false;
    for letter in says.chars() {
        match letter {
            '`' => {
                is_code = !is_code;
                html.push_str(if is_code { "<code>" } else { "</code>" });
            }
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '&' => html.push_str("&amp;"),
            '_' => html.push_str("&#95;"),
            '*' => html.push_str("&#42;"),
            other => html.push(other),
        }
    }
    html
}

/// Equations of what a function gives, where they are few and short.
pub(super) fn of_function(layout: &Layout<'_>, kind: FunctionKind) -> Vec<String> {
    let Some(page) = page(layout) else { return Vec::new() };
    let wanted = |subject: Subject| match kind {
        FunctionKind::MassMatrix => matches!(subject, Subject::Mass(..)),
        FunctionKind::Bias => matches!(subject, Subject::Inertial(_) | Subject::Gravity(_) | Subject::Force(_)),
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics | FunctionKind::Residual => {
            matches!(subject, Subject::Motion(_))
        }
        FunctionKind::Constraints => matches!(subject, Subject::Constraint(_)),
        FunctionKind::ConstraintJacobian => matches!(subject, Subject::Slope(..)),
        FunctionKind::Outputs => matches!(subject, Subject::Output(_)),
        _ => false,
    };
    // Sections that say nothing of it are not folded.
    let sections = page.sections.iter().filter(|section| section.lines.iter().any(|line| wanted(line.subject)));
    let lines = sections.flat_map(|section| page.folded(section));
    let lines = lines.filter(|folded| wanted(folded.line.subject));
    let lines: Vec<String> = lines.map(|folded| folded.text()).collect();
    let long = lines.len() > MOST_LINES || lines.iter().any(|line| line.chars().count() > MOST_CHARACTERS);
    if lines.is_empty() || long {
        return Vec::new();
    }
    let mut block = vec![String::new(), "```text".to_owned()];
    block.extend(lines);
    block.push("```".to_owned());
    block
}
