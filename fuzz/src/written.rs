//! Equations for readers as printed, beside what compiled functions give, for a reader that shares nothing with the engine:
//! `tests/scripts/equations.py`.
//!
//! One line of JSON for each model: the names of its symbols and its equations as each printer sets them, and the values of
//! symbols and results of functions at states drawn at random.

use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::freedoms;
use multibody_engine::mechanics::written::Subject;
use multibody_engine::model::types::{JointId, Model, Request};
use multibody_engine::symbolic::write::formula::Formula;
use multibody_engine::symbolic::write::{latex, mathml, text};
use serde_json::{Value, json};

use crate::corpus;
use crate::pages::{Random, Written};

/// What it takes.
pub const USAGE: &str = "[--models N] [--states N] [--seed S] [--most-freedoms N] [FILE..]";

/// What is written.
pub struct Plan {
    /// Of all models as many as this, chosen at random.
    pub models: usize,
    /// For each model.
    pub states: usize,
    /// Of the choice and of the states.
    pub seed: u64,
    /// Larger models are left out.
    pub most_freedoms: usize,
    /// Rust or Markdown with models; all places of the project where there is none.
    pub files: Vec<String>,
}

/// Writes a line for each model that has a page, and says how many have.
pub fn run(plan: &Plan, to: &mut dyn Write) -> std::io::Result<usize> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let here = PathBuf::new();
    let places: Vec<(&Path, &str)> = match plan.files.is_empty() {
        true => corpus::PLACES.iter().map(|place| (root.as_path(), *place)).collect(),
        false => plan.files.iter().map(|file| (here.as_path(), file.as_str())).collect(),
    };
    let calls = places.into_iter().flat_map(|(root, place)| corpus::calls_of(root, place));
    let mut models: Vec<(String, Model)> = calls
        .flat_map(|(file, call)| corpus::models(call).into_iter().map(move |model| (file.clone(), model)))
        .filter(|(_, model)| freedoms(model) <= plan.most_freedoms)
        .collect();
    let mut random = Random(plan.seed);
    let mut written = 0;
    while written < plan.models && !models.is_empty() {
        let drawn = ((random.unit() + 1.0) / 2.0 * models.len() as f64) as usize;
        let (file, model) = models.remove(drawn.min(models.len() - 1));
        let Some(of) = Written::new(model, &[Request::ForwardDynamics]) else { continue };
        serde_json::to_writer(&mut *to, &shown(&file, &of, plan.states, &mut random))?;
        writeln!(to)?;
        written += 1;
    }
    Ok(written)
}

fn shown(file: &str, of: &Written, states: usize, random: &mut Random) -> Value {
    let symbols: Vec<Value> = of.page.symbols.iter().map(|(name, symbol)| {
        json!({ "text": text::name(name), "latex": latex::name(name), "mathml": mathml::name(name), "given": !of.follows(*symbol) })
    }).collect();
    let lines = of.page.sections.iter().flat_map(|section| &section.lines);
    let lines: Vec<Value> = lines
        .map(|line| {
            let (what, at) = subject(of, line.subject);
            let sides = &line.equation;
            json!({ "subject": what, "at": at, "left": printed(&sides.left), "right": printed(&sides.right) })
        })
        .collect();
    let states: Vec<Value> = (0..states).map_while(|_| of.state(random)).map(|at| state(of, &at)).collect();
    json!({ "file": file, "model": of.model.name.to_string(), "freedoms": of.structure.freedoms(), "symbols": symbols, "lines": lines, "states": states })
}

fn printed(formula: &Formula) -> Value {
    json!({ "text": text::formula(formula), "latex": latex::formula(formula), "mathml": mathml::alone(formula) })
}

/// What a line states, and which entry.
fn subject(of: &Written, subject: Subject) -> (&'static str, Vec<usize>) {
    match subject {
        Subject::Definition => ("definition", vec![]),
        Subject::Mass(i, j) => ("mass", vec![i, j]),
        Subject::Inertial(i) => ("inertial", vec![i]),
        Subject::Gravity(i) => ("gravity", vec![i]),
        Subject::Force(i) => ("force", vec![i]),
        Subject::Motion(i) => ("motion", vec![i]),
        Subject::Position(_) => ("position", vec![]),
        Subject::Cosine(_) => ("cosine", vec![]),
        Subject::Sine(_) => ("sine", vec![]),
        Subject::Rate(_) => ("rate", vec![]),
        Subject::Speed(_) => ("speed", vec![]),
        Subject::Rolling(_) => ("rolling", vec![]),
        Subject::Driven(..) => ("driven", vec![]),
        Subject::Follows(..) => ("follows", vec![]),
        Subject::Rest(_) => ("rest", vec![]),
        Subject::Acceleration(_) => ("acceleration", vec![]),
        Subject::Constraint(row) => {
            ("constraint", of.structure.rows.iter().position(|known| *known == row).into_iter().collect())
        }
        Subject::Closing(_) => ("closing", vec![]),
        Subject::Slope(i, j) => ("slope", vec![i, j]),
        Subject::Output(k) => ("output", vec![k]),
        Subject::StateRate(k) => ("state rate", vec![k]),
    }
}

/// Values of symbols, those that the motion would have, and results of functions.
fn state(of: &Written, at: &HashMap<Symbol, f64>) -> Value {
    let values: Vec<f64> = of.page.symbols.iter().map(|(_, symbol)| at[symbol]).collect();
    let forward = of.run(FunctionKind::ForwardDynamics, at);
    // Accelerations, rates of states, rates of positions where velocities are others, multipliers: in this order.
    let freedoms = of.structure.freedoms();
    let moved = if of.structure.has_speeds() { of.structure.state.len() } else { 0 };
    let moving = |symbol: Symbol| -> Option<f64> {
        let forward = forward.as_ref()?;
        let place = match symbol {
            // The page has it.
            _ if of.follows(symbol) => return at.get(&symbol).copied(),
            Symbol::Acceleration { joint, component } => place(of, joint, component)?,
            Symbol::Multiplier { row } => freedoms + of.model.states.len() + moved + row,
            _ => return at.get(&symbol).copied(),
        };
        Some(forward[place])
    };
    let moving: Vec<Option<f64>> = of.page.symbols.iter().map(|&(_, symbol)| moving(symbol)).collect();
    let number = |symbol: Symbol| of.page.symbols.iter().position(|known| known.1 == symbol);
    let mut solved = at.clone();
    solved.extend(of.page.symbols.iter().zip(&moving).filter_map(|((_, symbol), value)| Some((*symbol, (*value)?))));
    let followed: Vec<(Option<usize>, f64)> =
        of.followed(&solved).into_iter().map(|(symbol, value)| (number(symbol), value)).collect();
    json!({
        "values": values,
        "followed": followed,
        "moving": moving,
        "mass": of.run(FunctionKind::MassMatrix, at),
        "bias": of.run(FunctionKind::Bias, at),
        "motion": of.motion(at),
        "constraints": of.gaps(at),
        "jacobian": of.run(FunctionKind::ConstraintJacobian, at),
        "outputs": of.run(FunctionKind::Outputs, at),
        "rates": forward.map(|list| list[freedoms..freedoms + of.model.states.len()].to_vec()),
    })
}

/// Where the acceleration of a velocity coordinate stands.
fn place(of: &Written, joint: JointId, component: usize) -> Option<usize> {
    of.structure.speeds().iter().position(|coordinate| coordinate.joint == joint && coordinate.index == component)
}
