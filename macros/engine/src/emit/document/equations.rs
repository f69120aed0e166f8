//! Stage `emit`: equations in documentation.
//!
//! In: the page of a model that says `emit report`. Out: Markdown. The module's page has them as MathML, which browsers set
//! without a script, in `<div>` blocks without empty lines; long sections are folded, and large ones are plain text from some
//! line on. A function has the equations of what it gives as plain text, since editors that show documentation know no MathML.

use crate::contracts::function::FunctionKind;
use crate::mechanics::loops::constraints::is_rate;
use crate::mechanics::written::{Line, Page, Subject};
use crate::model::types::Request;

use super::super::layout::Layout;
use super::shown::{Form, Shown};

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
        let shown = Shown::new(page, section);
        for says in section.says.iter().map(String::as_str).chain(shown.says()) {
            lines.extend([says.to_owned(), String::new()]);
        }
        lines.extend(block(&shown));
    }
    lines
}

/// The equations of a section as one block of HTML.
fn block(shown: &Shown) -> Vec<String> {
    if shown.count() == 0 {
        return Vec::new();
    }
    let mut block = vec![WIDE.to_owned()];
    block.extend(shown.lines.iter().map(equation));
    block.push("</div>".to_owned());
    if !shown.rest.is_empty() {
        block.push(format!("<details><summary>{}</summary>", shown.over_rest()));
        block.push(letters(&shown.rest.join("\n")));
        block.push("</details>".to_owned());
    }
    block.extend(shown.at_end().map(|says| format!("<p>{}</p>", in_block(&says))));
    if shown.is_folded() {
        block.insert(0, format!("<details><summary>{} equations</summary>", shown.count() + shown.more));
        block.push("</details>".to_owned());
    }
    block
}

fn equation(form: &Form) -> String {
    match form {
        Form::Set(math, Line { says: Some(says), .. }) => {
            format!("{math}<p style=\"text-align:center\">{}</p>", in_block(says))
        }
        Form::Set(math, _) => math.clone(),
        Form::Plain(text) => letters(text),
    }
}

fn letters(text: &str) -> String {
    format!("<pre style=\"white-space:pre-wrap\">{}</pre>", in_block(text))
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
        FunctionKind::MassMatrix | FunctionKind::MassMatrixLower => matches!(subject, Subject::Mass(..)),
        FunctionKind::Bias => matches!(subject, Subject::Inertial(_) | Subject::Gravity(_) | Subject::Force(_)),
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics | FunctionKind::Residual => {
            matches!(subject, Subject::Motion(_))
        }
        // What is left of equations of velocities is given with the rates of the others.
        FunctionKind::Constraints => matches!(subject, Subject::Constraint(row) if !is_rate(layout.model, row)),
        FunctionKind::ConstraintRate => matches!(subject, Subject::Constraint(row) if is_rate(layout.model, row)),
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
