//! `counts`: operations of every function, as derived and as emitted, which are the generated `DERIVED` and `COSTS`.

use multibody_engine::contracts::cost::Cost;

use crate::Stop;
use crate::arguments::Subject;
use crate::build::{self, Built};
use crate::table::Table;

/// Kinds of operations, as the fields of `multibody::Cost`.
pub(crate) const KINDS: [&str; 6] = ["add", "mul", "div", "sqrt", "sincos", "other"];

pub(crate) fn run(subject: &Subject) -> Result<String, Stop> {
    let models = build::models(subject)?;
    let tables: Vec<String> = models.iter().map(|model| format!("{}\n{}", model.name(), table(model))).collect();
    Ok(tables.join("\n"))
}

/// By function the operations as derived, if that is known, and as emitted.
pub(crate) fn rows(built: &Built) -> Vec<(String, Option<Cost>, Cost)> {
    let new = ("new".to_owned(), None, built.compiled.prelude_cost);
    let functions = built.compiled.functions.iter();
    let at = built.compiled.at.iter().flat_map(|at| {
        let functions = at.functions.iter();
        let functions = functions.map(|f| (format!("at.{}", built.function(f.kind)), Some(f.before), f.after));
        std::iter::once(("at".to_owned(), None, at.cost)).chain(functions)
    });
    std::iter::once(new)
        .chain(functions.map(|function| (built.function(function.kind), Some(function.before), function.after)))
        .chain(at)
        .collect()
}

/// Numbers of operations in the order of [`KINDS`].
pub(crate) fn numbers(cost: &Cost) -> [u32; 6] {
    let Cost { add, mul, div, sqrt, sincos, compare, other } = *cost;
    [add, mul, div, sqrt, sincos, compare + other]
}

fn table(built: &Built) -> String {
    let heads = ["function"].into_iter().chain(KINDS).chain(KINDS);
    let mut table = Table::new(1, heads).titled([(1, "as derived"), (7, "as emitted")]);
    for (name, before, after) in rows(built) {
        let before = before.map_or_else(|| [const { String::new() }; 6], |cost| numbers(&cost).map(|n| n.to_string()));
        let after = numbers(&after).map(|n| n.to_string());
        table.row(std::iter::once(name).chain(before).chain(after));
    }
    table.text()
}
