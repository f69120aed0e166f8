//! `expand`: the generated code, formatted, with a heading over each paragraph of statements.

use multibody_engine::emit;

use crate::Stop;
use crate::arguments::Subject;
use crate::build::{self, Built};

pub(crate) fn run(subject: &Subject) -> Result<String, Stop> {
    let models = build::models(subject)?;
    let modules: Result<Vec<String>, Stop> = models.iter().map(module).collect();
    modules.map(|modules| modules.join("\n"))
}

fn module(built: &Built) -> Result<String, Stop> {
    let tokens = emit::commented(&built.model, &built.structure, &built.compiled);
    let file = syn::parse2(tokens)
        .map_err(|error| Stop::Usage(format!("the code of `{}` is no Rust: {error}", built.name())))?;
    Ok(headings(&prettyplease::unparse(&file)))
}

/// Headings stand in the tokens as the attribute `#[doc = "// .."]`, which no user of the macro ever sees.
fn headings(code: &str) -> String {
    let lines = code.lines().map(|line| match line.split_once("#[doc = \"// ") {
        Some((indent, heading)) => format!("{indent}// {}\n", heading.trim_end_matches("\"]")),
        None => format!("{line}\n"),
    });
    lines.collect()
}
