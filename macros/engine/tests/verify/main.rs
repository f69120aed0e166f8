//! The check of compiled programs in numbers: it accepts every model of the project, and tells every error that is put in.

mod accepted;
mod at;
mod breaks;
#[path = "../common/corpus.rs"]
mod corpus;
mod fused;
mod held_loops;
#[path = "../common/interpreter.rs"]
mod interpreter;
mod packs;
#[allow(dead_code, reason = "other areas use the rest")]
#[path = "../common/rng.rs"]
mod rng;
mod states;

use std::time::Instant;

use multibody_engine::optimize::program::{Expression, Part, Statement};
use multibody_engine::{mechanics, optimize, verify};

/// What no state was found for, and why.
const UNCHECKED: [(&str, Part); 0] = [];

#[test]
fn no_model_of_the_project_is_refused() {
    let only = std::env::var("VERIFY_ONLY").unwrap_or_default();
    let (mut checked, mut all, mut own) = (0, 0.0, 0.0);
    let mut complaints = Vec::new();
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let name = format!("{file} {}", model.name);
            // Some are there to be refused.
            if !name.contains(&only) {
                continue;
            }
            let start = Instant::now();
            let Ok((structure, derivation)) = mechanics::of(&model) else { continue };
            let compiled = optimize::compile(&derivation).unwrap();
            let between = start.elapsed().as_secs_f64();
            let found = verify::check(&model, &structure, &derivation, &compiled);
            let after = start.elapsed().as_secs_f64() - between;
            (all, own) = (all + between, own + after);
            println!("{name}: {:.1} ms + {:.1} ms, {:.1} %", between * 1e3, after * 1e3, after / between * 100.0);
            let clear = found.unchecked.iter().all(|unchecked| UNCHECKED.contains(&(name.as_str(), unchecked.part)));
            let wrong = found.wrong_checks || found.wrong_inertia || !found.wrong.is_empty();
            if !clear || wrong || found.broken.is_some() {
                complaints.push(format!("{name}: {found:?}"));
            }
            checked += 1;
        }
    }
    println!("{checked} models, {all:.1} s + {own:.1} s");
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(checked >= 200 || !only.is_empty(), "{checked}");
}

/// An entry that is exactly zero, carried as a literal of 8e-17 that others are divided by.
#[test]
fn a_literal_of_nothing() {
    for text in [
        "pub mod arm {
            world { gravity: -9.81 * Z }
            body b0 { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
            body b1 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
            body b2 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
            joint j0: Revolute { parent: ground, child: b0, axis: X }
            joint j1: Revolute { parent: b0.at(X).rotated([1, 1, 1], deg(60)), child: b1, axis: [1, 0, 1] }
            joint j2: Revolute { parent: b1.at(Y).rotated(X, deg(60)), child: b2, axis: [1, 0, 1] }
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
        }",
        "pub mod small {
            body b0 { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
            body b1 { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
            body b2 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
            joint j0: Revolute { parent: ground, child: b0, axis: X }
            joint j1: Revolute { parent: b0.rotated([1, 1, 1], deg(60)), child: b1, axis: [1, 0, 1] }
            joint j2: Revolute { parent: b1, child: b2, axis: Y }
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
        }",
        "pub mod two {
            body b1 { mass: 1.0, com: Y, inertia: diag(0.1, 0.2, 0.25) }
            body b2 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
            joint j0: Revolute { parent: ground, child: b1, axis: X }
            joint j1: Revolute { parent: b1.rotated([1, 1, 1], deg(60)), child: b2, axis: [1, 0, 1] }
            emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
        }",
    ] {
        let model = corpus::model(text);
        let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|c| panic!("{c:?}"));
        let compiled = verify::compile(&model, &structure, &derivation).unwrap_or_else(|r| panic!("{r:?}"));
        let found = verify::check(&model, &structure, &derivation, &compiled);
        assert!(found.wrong.is_empty() && found.broken.is_none(), "{}: {found:?}", model.name);
    }
}

/// A condition of parameters alone is no number: it is made where it is read, and `Model` has no field for it.
#[test]
fn masks_are_no_fields() {
    for (output, fields) in [
        ("select(p > 0.5, j, 1)", 1),
        ("select(p > 0.5 && p < 2.0 * s, j.rate, s)", 3),
        // All of it is a number of parameters.
        ("j * select(p > 0.5, s, p)", 1),
    ] {
        let model = corpus::model(&format!(
            "pub mod m {{
                param p = 0.3;
                param s = 0.7;
                body a {{ mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }}
                joint j: Revolute {{ parent: ground, child: a, axis: Z }}
                output o = {output};
            }}"
        ));
        let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|c| panic!("{c:?}"));
        let compiled = optimize::compile(&derivation).unwrap();
        let mask = |e: &Expression| matches!(e, Expression::Call(call, _) if call.is_mask());
        assert!(!compiled.prelude.results.iter().any(mask), "{output}");
        assert_eq!(compiled.fields.len(), fields, "{output}: {:?}", compiled.fields);
        let locals = compiled.prelude.results.iter().filter_map(|e| match e {
            Expression::Local(local) => Some(*local),
            _ => None,
        });
        for local in locals {
            let of_mask = |s: &Statement| matches!(s, Statement::Let { local: l, value } if *l == local && mask(value));
            assert!(!compiled.prelude.statements.iter().any(of_mask), "{output}");
        }
        let found = verify::check(&model, &structure, &derivation, &compiled);
        assert!(found.wrong.is_empty() && found.unchecked.is_empty(), "{found:?}");
    }
}
