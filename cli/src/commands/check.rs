//! `check`: mistakes, else a line for each model, with what the choice for its loops costs.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::emit;

use crate::Stop;
use crate::arguments::Subject;
use crate::build::{self, Built};

pub(crate) fn run(subject: &Subject) -> Result<String, Stop> {
    let models = build::advised_models(subject)?;
    Ok(models.iter().map(|model| format!("{}\n{}", line(model), advice(model))).collect())
}

/// `four_bar: 3 bodies, 1 coordinate, 0 equations with multipliers; forward_dynamics, energy`
fn line(built: &Built) -> String {
    let counted = |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    // A model without outputs has that function all the same.
    let kinds = built.compiled.functions.iter().map(|function| function.kind);
    let kinds = kinds.filter(|kind| *kind != FunctionKind::Outputs || !built.model.outputs.is_empty());
    let functions: Vec<String> = kinds.map(|kind| built.function(kind)).collect();
    format!(
        "{}: {}, {}, {} with multipliers; {}",
        built.name(),
        counted(built.model.bodies.len(), "body", "bodies"),
        counted(built.structure.state.len(), "coordinate", "coordinates"),
        counted(built.structure.rows.len(), "equation", "equations"),
        functions.join(", ")
    )
}

/// What there is to say of loops: equations that are left out, and what the ways to close them cost.
fn advice(built: &Built) -> String {
    let facts = emit::facts(&built.model, &built.structure, &built.compiled);
    facts.left_out.iter().chain(&facts.advice).map(|item| format!("  {item}\n")).collect()
}
