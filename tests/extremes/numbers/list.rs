//! The list of public functions, read from the sources and from the documentation of generated models, held against what
//! these tests call.

use multibody_tests::support::data::path;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// What other calls are made of, or what takes no number.
const REACHED: &[(&str, &str)] = &[
    ("attempt", "of a method: in every step"),
    ("begin", "of a method: before the first step"),
    ("first_slope", "of a method: before the first step, where its length is chosen"),
    ("error", "of a method: in every step chosen by error"),
    ("proceed", "of a method: after every step"),
    ("repeat", "of a method: after every rejected step"),
    ("next_step", "of a method: after every step chosen by error"),
    ("dense", "of a method: by `at` and `share`"),
    ("position", "of what closes loops: in every step of generalised-alpha"),
    ("values", "of events: at every place that is looked at"),
    ("direction", "of events: at every crossing"),
    ("happened", "of events: at every crossing that counts"),
    ("tolerance", "of events: at every crossing"),
    ("samples", "of events: in every step"),
    ("time", "of an interval: by `share`"),
    ("prepare", "of a method that iterates: before its iterations"),
    ("cubic", "dense output: by `at` and `share`"),
    ("displacement", "dense output: by `at` and `share`"),
    ("slope", "of a problem: in every stage"),
    ("stage", "of a problem: in every stage"),
    ("count_factorisation", "of a problem: by implicit methods"),
    ("evaluations", "a count"),
    ("jacobians", "a count"),
    ("factorisations", "a count"),
    ("flops", "a count"),
    ("epsilon", "a constant"),
    ("none", "of a system whose loops can't be open"),
    ("granted", "of a model: at the start of every integration"),
    ("least_displacement", "of a model with many equations: by `least_correction`"),
    ("ambiguity", "of a model with constraints: at the end of every step that is kept"),
    ("of_equation", "an opening: at the start of every integration"),
    ("open_lanes", "of an opening: by `check`"),
    ("tells_crossings", "of equations: by `ambiguity` and projections"),
    ("is_open", "of an opening: at the start of every integration"),
    ("or", "of an opening: at the start of every integration"),
    ("of_positions", "an opening: at the start of every integration"),
    ("of_velocities", "an opening: at the start of every integration"),
    ("of_iterations", "an opening: at the start of every integration"),
    ("of_equations", "an opening: at the start of every integration"),
    ("is_held", "of a literal: by `check`"),
    ("verify", "for users' tests: in runtime/tests/integrators/verify.rs"),
    ("verify_at", "for users' tests: in runtime/tests/integrators/verify.rs"),
    ("worst", "of what `verify` gives"),
    ("free_motion", "of what is verified: by `verify`"),
    ("inertia", "of what is verified: by `verify`"),
    ("efforts", "of what is verified: by `verify`"),
    ("kinetic", "of what is verified: by `verify`"),
    ("modes_by_points", "of a model: by `assembly_modes`"),
    ("modes_by_sides", "of a model: by `assembly_modes`"),
    ("on_circle", "by `assembly_modes`"),
    ("integrate_lanes", "by `simulate_lanes`"),
    ("horizon", "of a system: before every step"),
    ("columns", "names what is recorded: in tests/generated/record.rs"),
    ("each", "names what is recorded: in tests/generated/record.rs"),
    ("field", "names what is recorded: in tests/generated/record.rs"),
    ("finish", "writes: in tests/generated/record.rs"),
    ("observe", "writes: in tests/generated/record.rs"),
    ("rates", "names what is recorded: in tests/generated/record.rs"),
    ("sample", "writes: in tests/generated/record.rs"),
    ("unit", "names what is recorded: in tests/generated/record.rs"),
    ("write", "for serde: in runtime/tests/structs/serial.rs"),
    ("read", "for serde: in runtime/tests/structs/serial.rs"),
    ("element", "for serde: in runtime/tests/structs/serial.rs"),
    ("once", "for serde: in runtime/tests/structs/serial.rs"),
    ("there", "for serde: in runtime/tests/structs/serial.rs"),
    ("are_for", "of matrices of an implicit method: in every step"),
    ("as_displacement", "of a system of second order: a change of type"),
    ("as_velocity", "of a system of second order: a change of type"),
    ("assemble_by", "by `assemble`"),
    ("by_position", "an entry of a Jacobian: in searches for equilibria"),
    ("by_rates", "an entry of a Jacobian: in searches for equilibria"),
    ("constraint_rate_along", "of equations: by `constraints_along`"),
    ("dt", "of matrices of an implicit method: in every step"),
    ("fixed_velocity_correction", "of weights: by `project_fixed`"),
    ("less", "of a Jacobian: by `WithBaumgarte`"),
    ("solve_complex", "of matrices of an implicit method: in every iteration"),
    ("solve_real", "of matrices of an implicit method: in every iteration"),
    ("closed_loop", "a wrapper that computes nothing: in runtime/tests/integrators/wrappers.rs"),
    ("mass_matrix_lower", "entries of `mass_matrix`: in runtime/tests/numbers/lower_triangle.rs"),
    ("centroidal_momentum_matrix", "of the whole: in macros/engine/tests/mechanics/centroidal.rs"),
    ("poses", "positions and rotations of bodies, as `outputs` has them: in tests/laws/output_groups.rs"),
    ("rate_derivatives", "of a model with speeds: by `DifferentiableSystem`"),
    ("position_jacobian", "of a model with speeds and multipliers: by `Constrained`, in the tests of the runtime"),
    ("kinematics_2", "`kinematics`, asked for a second time"),
    ("value", "of a user's own function, which takes what it takes: in runtime/tests/functions"),
    ("slopes", "of a user's own function: in runtime/tests/functions"),
    ("value_and_slopes", "of a user's own function: in runtime/tests/functions"),
    ("slope_deviation", "for users' tests: in runtime/tests/functions/calls.rs"),
];

/// All files below a folder, as one text without comments.
fn text(folder: &Path, into: &mut String) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            text(&entry, into);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            append(&entry, into);
        }
    }
}

fn append(file: &Path, into: &mut String) {
    let text = fs::read_to_string(file).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).for_each(|line| {
        into.push_str(line);
        into.push('\n');
    });
}

/// The word at the start of a text.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}

/// Public functions, and those of public traits.
fn functions(source: &str) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    let mut in_trait = false;
    for line in source.lines() {
        in_trait = (in_trait || line.starts_with("pub trait ")) && line != "}";
        let rest = line.trim_start();
        let start = if in_trait { rest.strip_prefix("fn ") } else { None };
        let start = start.or_else(|| rest.strip_prefix("pub fn ")).or_else(|| rest.strip_prefix("pub const fn "));
        found.extend(start.map(word));
    }
    found
}

/// Names that are followed by arguments, or by types and arguments. What these files define themselves is no call.
fn calls(text: &str) -> BTreeSet<&str> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = BTreeSet::new();
    for (at, _) in text.match_indices('(').chain(text.match_indices("::<")) {
        let before = &text[..at];
        let name = &before[before.trim_end_matches(is_name).len()..];
        if !before[..before.len() - name.len()].ends_with("fn ") {
            found.insert(name);
        }
    }
    found
}

/// Functions of generated models, by the tables of the documentation.
fn generated(table: &str) -> BTreeSet<&str> {
    let functions = table.split("\n# ").find(|section| section.starts_with("Functions of `Model`")).unwrap();
    let rows = functions.lines().filter_map(|line| line.strip_prefix("| `"));
    let names = rows.flat_map(|row| row.split('|').next().unwrap_or_default().split('`'));
    names.map(word).filter(|name| name.starts_with(|c: char| c.is_ascii_lowercase())).collect()
}

#[test]
fn every_public_function_is_met() {
    let (mut source, mut called) = (String::new(), String::new());
    text(&path("../runtime/src"), &mut source);
    text(&path("extremes/numbers"), &mut called);
    let words = calls(&called);
    let docs = fs::read_to_string(path("../runtime/docs/generated.md")).unwrap();
    let (runtime, models) = (functions(&source), generated(&docs));
    assert!(runtime.len() > 100 && models.len() > 20, "{runtime:?} {models:?}");
    let reached: BTreeSet<&str> = REACHED.iter().map(|(name, _)| *name).collect();
    let wanted: BTreeSet<&str> = runtime.union(&models).copied().collect();
    let missed: Vec<_> = wanted.iter().filter(|name| !words.contains(*name) && !reached.contains(*name)).collect();
    println!("{} public functions of the runtime, {} of models", runtime.len(), models.len());
    assert!(missed.is_empty(), "met by no test: {missed:?}");
    let stale: Vec<_> = reached.iter().filter(|name| !wanted.contains(*name)).collect();
    assert!(stale.is_empty(), "no function any more: {stale:?}");
}
