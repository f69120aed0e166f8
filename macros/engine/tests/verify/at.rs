//! What is done once for a position, in every model of the project: all functions that may go on from there are asked for
//! together. Nothing of them is wrong, no operation is done that the functions alone would not do, and errors are noticed.

use proc_macro2::Span;

use crate::corpus;
use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::{self, Derivation, Derived};
use multibody_engine::model::types::{AtFunction, Model};
use multibody_engine::optimize::program::{At, Compiled, Expression, Program};
use multibody_engine::optimize::{self, Plain};
use multibody_engine::verify;

/// One model of so many is looked at.
const SHARE: usize = 4;

fn may_go_on(kind: FunctionKind) -> bool {
    use FunctionKind as F;
    !matches!(
        kind,
        F::Guess
            | F::DeadCentres
            | F::Margins
            | F::Granted
            | F::Displacement
            | F::Kinematics(_)
            | F::AssemblyCondition
            | F::Assembly
    )
}

/// The model with all that may go on from a position, if that is more than one function.
fn asked_for_all(model: &Model) -> Option<Model> {
    let (_, derivation) = mechanics::of(model).ok()?;
    let kinds = derivation.functions.iter().map(|function| function.kind).filter(|&kind| may_go_on(kind));
    let name = |kind: FunctionKind| AtFunction { name: kind.method(model).into_owned(), span: Span::call_site() };
    let at: Vec<AtFunction> = kinds.map(name).collect();
    (at.len() > 1).then(|| Model { at, ..model.clone() })
}

/// What everything costs: what choices between ways compare.
fn of_at(at: &At) -> u32 {
    at.cost.weight() + at.functions.iter().map(|function| function.after.weight()).sum::<u32>()
}

fn alone(compiled: &Compiled) -> u32 {
    let functions = compiled.functions.iter().filter(|function| may_go_on(function.kind));
    functions.map(|function| function.after.weight()).sum()
}

/// The equations of these functions as if they were those of one.
fn joint(derivation: Derivation, at: &At) -> u32 {
    let list = at.functions.iter().flat_map(|function| {
        let derived = derivation.functions.iter().find(|derived| derived.kind == function.kind).unwrap();
        derived.candidates[function.candidate].1.list.clone()
    });
    let results = multibody_engine::contracts::results::Results::vector(list.collect());
    let functions = vec![Derived { kind: FunctionKind::Bias, candidates: vec![("", results)] }];
    let compiled = optimize::compile(&Derivation { functions, at: Vec::new(), ..derivation }).unwrap();
    compiled.functions[0].after.weight()
}

/// Whether a symbol is decided by the position; parameters stand in statements that are not read.
fn is_early(symbol: Symbol) -> bool {
    !matches!(
        symbol,
        Symbol::Param { .. }
            | Symbol::Velocity { .. }
            | Symbol::Acceleration { .. }
            | Symbol::Input { .. }
            | Symbol::Multiplier { .. }
            | Symbol::Rate { .. }
            | Symbol::Impulse { .. }
            | Symbol::Momentum { .. }
    )
}

fn each_symbol(program: &Program, visit: &mut dyn FnMut(Symbol)) {
    program.expressions().for_each(|expression| {
        expression.each_leaf(&mut |leaf| {
            if let Expression::Symbol(symbol) = leaf {
                visit(*symbol);
            }
        });
    });
}

#[test]
fn no_model_of_the_project_is_wrong() {
    let only = std::env::var("VERIFY_ONLY").unwrap_or_default();
    let (mut number, mut asked, mut complaints) = (0, 0, Vec::new());
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let name = format!("{file} {}", model.name);
            number += 1;
            // A share of them, which says enough; `VERIFY_ONLY=.` has all.
            if !name.contains(&only) || (only.is_empty() && number % SHARE != 0) {
                continue;
            }
            let Some(model) = asked_for_all(&model) else { continue };
            let Ok((structure, derivation)) = mechanics::of(&model) else { continue };
            let compiled = optimize::compile(&derivation).unwrap();
            let at = compiled.at.as_ref().unwrap();
            asked += 1;
            let found = verify::check(&model, &structure, &derivation, &compiled);
            let mut complain = |what: String| complaints.push(format!("{name}: {what}"));
            if found.wrong_at.is_some() || found.broken.is_some() || !found.wrong.is_empty() || !compiled.sound {
                complain(format!("{found:?}"));
            }
            if !found.unchecked.is_empty() {
                complain(format!("{:?}", found.unchecked));
            }
            let [together, alone] = [of_at(at), alone(&compiled)];
            if together > alone {
                complain(format!("{together} operations, {alone} alone"));
            }
            // What the position decides is nowhere done behind it.
            each_symbol(&at.program, &mut |symbol| {
                if !is_early(symbol) && !matches!(symbol, Symbol::Param { .. }) {
                    complain(format!("`at` reads {symbol:?}"));
                }
            });
            for function in &at.functions {
                each_symbol(&function.program, &mut |symbol| {
                    if is_early(symbol) {
                        complain(format!("{:?} reads {symbol:?}", function.kind));
                    }
                });
            }
            println!("{name}: {} values, {together} operations, {alone} alone", at.fields.len());
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(asked >= 40 || !only.is_empty(), "{asked}");
}

const ARM: &str = "pub mod arm {
    param l = 0.7;
    input torque;
    world { gravity: [0.3, -9.81, 0.2] }
    body a { mass: 1.3, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.03) }
    body b { mass: 0.7, com: [0.1, -0.2, 0.4], inertia: diag(0.02, 0.03, 0.04) }
    body c { mass: 0.5, com: [0.2, 0.03, 0.1], inertia: diag(0.01, 0.02, 0.015) }
    joint first: Revolute { parent: ground, child: a, axis: [1, 2, 0.5] }
    joint second: Prismatic { parent: a.at([l, 0.1, 0]).rotated(Y, 0.4), child: b, axis: [0, 1, 1] }
    joint third: Revolute { parent: b.at([0.1, l, 0.2]), child: c, axis: [0.3, 1, -0.4] }
    force motor: Effort { joint: first, value: torque - 0.1 * first.rate }
    output tool = c.at(0.2 * X).jacobian;
    emit inverse_dynamics, mass_matrix, bias, at { functions: [FUNCTIONS] };
}";

/// Results of functions of the position alone, and one function of velocities: all work is shared, so that the costs are those
/// of one program with all these results.
#[test]
fn it_costs_what_one_program_does() {
    for functions in ["mass_matrix, outputs", "mass_matrix, bias", "mass_matrix, outputs, inverse_dynamics"] {
        let model = corpus::model(&ARM.replace("FUNCTIONS", functions));
        let (_, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
        let compiled = optimize::compile(&derivation).unwrap();
        let at = compiled.at.unwrap();
        let together = of_at(&at);
        let joint = joint(derivation, &at);
        println!("{functions}: {together}, as one program {joint}");
        assert!(together <= joint, "{functions}: {together}, as one program {joint}");
    }
}

/// With a function of the position alone nothing is left to do behind it.
#[test]
fn functions_of_the_position_are_stored() {
    let model = corpus::model(&ARM.replace("FUNCTIONS", "mass_matrix, outputs"));
    let (_, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let at = optimize::compile(&derivation).unwrap().at.unwrap();
    assert!(at.functions.iter().all(|function| function.after == Cost::default()));
    assert!(at.functions.iter().all(|function| function.program.statements.is_empty()));
    // A symmetric matrix is stored once, signs are no values: six entries, and what of 18 of the Jacobian is neither a number
    // nor another one's negative.
    assert!(at.fields.len() <= 6 + 15, "{:?}", at.fields);
}

/// Each result of each program with its sign turned, one at a time.
#[test]
fn errors_are_noticed() {
    let model = corpus::model(&ARM.replace("FUNCTIONS", "mass_matrix, bias, inverse_dynamics"));
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = optimize::compile(&derivation).unwrap();
    let wrong = |compiled: &Compiled| verify::check(&model, &structure, &derivation, compiled).wrong_at.is_some();
    assert!(!wrong(&compiled));
    let count = compiled.at.as_ref().unwrap().functions.len();
    let mut tried = 0;
    for number in 0..=count {
        let program = |at: &At| match number {
            0 => at.program.clone(),
            _ => at.functions[number - 1].program.clone(),
        };
        let clean = program(compiled.at.as_ref().unwrap());
        for place in 0..clean.results.len() {
            // What is zero has no sign.
            if matches!(clean.results[place], Expression::Literal(_)) {
                continue;
            }
            let mut program = clean.clone();
            program.results[place] = Expression::Neg(Box::new(program.results[place].clone()));
            let mut broken = compiled.clone();
            let at = broken.at.as_mut().unwrap();
            match number {
                0 => at.program = program,
                _ => at.functions[number - 1].program = program,
            }
            assert!(wrong(&broken), "result {place} of program {number}");
            tried += 1;
        }
    }
    assert!(tried > 20, "{tried}");
}

/// As derived, without a rewrite: what is left where the optimiser is wrong.
#[test]
fn what_is_not_rewritten_is_right() {
    let model = corpus::model(&ARM.replace("FUNCTIONS", "mass_matrix, bias, inverse_dynamics, outputs"));
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let plain = Plain { at: true, ..Plain::default() };
    let compiled = optimize::compile_with(&derivation, plain, false).unwrap();
    let found = verify::check_with(&model, &structure, &derivation, &compiled, plain);
    assert!(found.wrong_at.is_none() && found.broken.is_none() && found.unchecked.is_empty(), "{found:?}");
    let optimised = optimize::compile(&derivation).unwrap();
    assert!(of_at(optimised.at.as_ref().unwrap()) < of_at(compiled.at.as_ref().unwrap()));
}

/// Spin of a body on a ball: half of one component stands in two results, and products of whole components in others.
#[test]
fn shared_multiples_stay_shared() {
    let model = corpus::model(
        "pub mod spinning {
            body b { mass: 1.0, com: X, inertia: diag(1.0, 1.0, 1.0) }
            joint j: Ball { parent: ground, child: b }
            emit forward_dynamics, bias, at { functions: [forward_dynamics, bias] };
        }",
    );
    let (_, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = optimize::compile(&derivation).unwrap();
    assert!(of_at(compiled.at.as_ref().unwrap()) <= alone(&compiled));
}
