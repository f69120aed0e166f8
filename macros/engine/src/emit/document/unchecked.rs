//! Stage `emit`: what could not be checked in numbers, in the module's documentation.
//!
//! In: what stage `verify` has left open. Out: lines of Markdown, none where everything was checked.

use crate::emit::Context;
use crate::emit::methods::functions;
use crate::model::types::Model;
use crate::optimize::program::{Doubt, Part, Unchecked};

use super::facts::Facts;

pub(super) fn lines(facts: &Facts) -> Vec<String> {
    if facts.unchecked.is_empty() {
        return Vec::new();
    }
    let mut lines: Vec<String> = ["", "## Not checked in numbers", ""].map(String::from).into();
    lines.push(
        "Every function is compared with its derived equations in numbers, and with other functions, before it is \
         written. Of these no state was found at which that says something, or none with parameters beside their \
         defaults:"
            .to_string(),
    );
    lines.push(String::new());
    lines.extend(facts.unchecked.iter().map(|item| format!("- {item}")));
    lines
}

/// What could not be checked, and why.
pub(super) fn items(context: &Context<'_>) -> Vec<String> {
    context.compiled.unchecked.iter().map(|unchecked| item(context.layout.model, unchecked)).collect()
}

fn item(model: &Model, unchecked: &Unchecked) -> String {
    let what = match unchecked.part {
        Part::Function(kind) => format!("`{}`", functions::name(model, kind)),
        Part::At(kind) => format!("`At::{}`", functions::name(model, kind)),
        Part::Checks => "`Params::check`".to_string(),
        Part::Inertia => "`System::without_inertia`".to_string(),
        Part::Law(between) => between.to_string(),
    };
    format!("{what}: {}", reason(unchecked.doubt))
}

fn reason(doubt: Doubt) -> &'static str {
    match doubt {
        Doubt::NotFinite => "some value is not finite",
        Doubt::Comparison => "numbers that are compared are equal but for rounding",
        Doubt::Rank => "the rank of a system of equations is less than its size, or hangs on rounding",
        Doubt::Rounding => "rounding leaves too few digits",
        Doubt::Open => "no configuration was found in which the loops are closed",
    }
}
