//! Packs of limbs in every model of the project: the check finds nothing wrong with them, and tells of one that is.

use crate::corpus;
use crate::interpreter;
use multibody_engine::model::types::{Model, Packs};
use multibody_engine::optimize::program::{Compiled, Expression, Statement};
use multibody_engine::{mechanics, optimize, verify};

fn is_packed(compiled: &Compiled) -> bool {
    let is_pack = |statement: &Statement| matches!(statement, Statement::Pack { .. } | Statement::PackSines(_));
    compiled.functions.iter().any(|function| function.program.statements.iter().any(is_pack))
}

#[test]
fn no_model_of_the_project_is_wrong() {
    let only = std::env::var("VERIFY_ONLY").unwrap_or_default();
    let (mut packed, mut complaints) = (0, Vec::new());
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let name = format!("{file} {}", model.name);
            if !name.contains(&only) {
                continue;
            }
            let model = Model { packs: Packs::Four, ..model };
            let Ok((structure, derivation)) = mechanics::of(&model) else { continue };
            let compiled = optimize::compile(&derivation).unwrap();
            if !is_packed(&compiled) {
                continue;
            }
            packed += 1;
            println!("{name}");
            let found = verify::check(&model, &structure, &derivation, &compiled);
            if !found.wrong.is_empty() || found.broken.is_some() || !found.unchecked.is_empty() {
                complaints.push(format!("{name}: {found:?}"));
            }
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(packed >= 10 || !only.is_empty(), "{packed}");
}

/// A sign of one member, a member in the place of another, a pack that reads another member.
#[test]
fn a_wrong_member_is_noticed() {
    let model = corpus::model(
        "pub mod spider {
            formulation { packs: Four }
            world { gravity: [0.3, -0.2, -9.7] }
            body trunk { mass: 2.1, com: [0.02, -0.01, 0.03], inertia: diag(0.031, 0.043, 0.059) }
            joint float: Free { parent: ground, child: trunk }
            part legs: [leg; 4] = |i| leg { hip: trunk.at(HIPS[i]).rotated(Z, TURNS[i]), };
            const HIPS: [Vec3; 4] = [[0.31, 0.22, 0.03], [0.29, -0.21, 0.02], [-0.33, 0.19, 0.01], [-0.28, -0.24, 0.05]];
            const TURNS: [Scalar; 4] = [0.3, -0.7, 2.2, -2.6];
            emit forward_dynamics, inverse_dynamics;
        }
        mod leg {
            port hip: Frame;
            param m = 0.4;
            body thigh { mass: m, com: [0.12, 0.03, -0.02], inertia: inertia(0.002, 0.004, 0.005, 0.0003, -0.0002, 0.0001) }
            body shin { mass: 0.3, com: [0.17, -0.02, 0.01], inertia: diag(0.001, 0.003, 0.003) }
            joint lift: Revolute { parent: hip, child: thigh, axis: [0.1, 1.0, 0.2] }
            joint knee: Revolute { parent: thigh.at([0.3, 0.02, -0.01]), child: shin, axis: [0.2, 1.0, -0.1] }
        }",
    );
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = optimize::compile(&derivation).unwrap();
    assert!(is_packed(&compiled));
    let wrong = |compiled: &Compiled| !verify::check(&model, &structure, &derivation, compiled).wrong.is_empty();
    assert!(!wrong(&compiled));
    let mut tried = 0;
    for function in 0..compiled.functions.len() {
        for number in 0..compiled.functions[function].program.statements.len() {
            let mut broken = compiled.clone();
            let done = match &mut broken.functions[function].program.statements[number] {
                Statement::Members { members, .. } => {
                    let taken: Vec<usize> = (0..members.len()).filter(|&k| members[k].is_some()).collect();
                    taken.len() > 1 && {
                        members.swap(taken[0], taken[1]);
                        true
                    }
                }
                Statement::Pack { value, .. } => is_negated(value),
                _ => false,
            };
            // Members that are only summed may change places.
            if done && number % 3 == 0 && differs(&compiled, &broken, function) {
                tried += 1;
                assert!(wrong(&broken), "function {function}, statement {number}");
            }
        }
    }
    assert!(tried > 20, "{tried}");
}

/// Whether a function gives other values, with numbers for all that it reads.
fn differs(a: &Compiled, b: &Compiled, function: usize) -> bool {
    let number = |text: String| {
        let sum = text.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(131).wrapping_add(u64::from(byte)));
        0.2 + 1e-6 * (sum % 1_000_003) as f64
    };
    let [a, b] = [a, b].map(|compiled| {
        let program = &compiled.functions[function].program;
        interpreter::run(program, &|symbol| number(format!("{symbol:?}")), &|field| number(format!("{field:?}")))
    });
    a.iter().zip(&b).any(|(a, b)| (a - b).abs() > 1e-9 * (1.0 + a.abs()))
}

/// The second member of the first pack of literals or coordinates takes the other sign.
fn is_negated(value: &mut Expression) -> bool {
    match value {
        Expression::Pack(list) => {
            let mut all: Vec<Expression> = list.iter().cycle().take(4).cloned().collect();
            all[1] = Expression::Neg(Box::new(all[1].clone()));
            *list = all;
            true
        }
        Expression::Neg(inner) => is_negated(inner),
        Expression::Sum(terms) => terms.iter_mut().any(|(_, term)| is_negated(term)),
        Expression::Product(list) | Expression::Call(_, list) => list.iter_mut().any(is_negated),
        Expression::Quotient(above, _) => is_negated(above),
        _ => false,
    }
}
