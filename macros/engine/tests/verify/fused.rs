//! Fused products in every model of the project: the check finds nothing wrong with them, and symmetric matrices stay symmetric.

use crate::corpus;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::Plain;
use multibody_engine::optimize::program::{Expression, Program};
use multibody_engine::{mechanics, optimize, verify};

/// One model of so many is looked at, unless `VERIFY_ONLY` asks for more.
const SHARE: usize = 3;

/// Products that are fused.
fn count(program: &Program) -> usize {
    let mut stack: Vec<&Expression> = program.expressions().collect();
    let mut found = 0;
    while let Some(expression) = stack.pop() {
        match expression {
            Expression::Fused(operands) => {
                found += 1;
                stack.extend(operands.iter());
            }
            Expression::Neg(inner) => stack.push(inner),
            Expression::Sum(terms) => stack.extend(terms.iter().map(|(_, term)| term)),
            Expression::Product(list) | Expression::Call(_, list) => stack.extend(list),
            Expression::Quotient(above, below) => stack.extend([&**above, &**below]),
            _ => {}
        }
    }
    found
}

#[test]
fn no_model_of_the_project_is_wrong() {
    let only = std::env::var("VERIFY_ONLY").unwrap_or_default();
    let (mut number, mut fused, mut symmetric, mut complaints) = (0, 0, 0, Vec::new());
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let name = format!("{file} {}", model.name);
            number += 1;
            // `VERIFY_ONLY=.` has all.
            if !name.contains(&only) || (only.is_empty() && number % SHARE != 0) {
                continue;
            }
            let model = Model { fused: true, ..model };
            let Ok((structure, derivation)) = mechanics::of(&model) else { continue };
            let compiled = optimize::compile_with(&derivation, Plain::default(), true).unwrap();
            println!("{name}");
            let found = verify::check(&model, &structure, &derivation, &compiled);
            if !found.wrong.is_empty() || found.broken.is_some() || !found.unchecked.is_empty() {
                complaints.push(format!("{name}: {found:?}"));
            }
            // Nothing else has changed: neither counts, nor what is computed of parameters.
            let plain = optimize::compile(&derivation).unwrap();
            assert_eq!(count(&compiled.prelude) + count(&compiled.checks.program), 0, "{name}");
            for (function, same) in compiled.functions.iter().zip(&plain.functions) {
                assert_eq!(function.after, same.after, "{name}");
                assert_eq!(count(&same.program), 0, "{name}");
                fused += count(&function.program);
                if function.kind == FunctionKind::MassMatrix {
                    let entries = &function.program.results;
                    let size = (1..).find(|size| size * size >= entries.len()).unwrap();
                    let pairs = (0..size).flat_map(|i| (0..i).map(move |j| (i, j)));
                    pairs.for_each(|(i, j)| assert_eq!(entries[i * size + j], entries[j * size + i], "{name}"));
                    symmetric += 1;
                }
            }
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(!only.is_empty() || fused > 10_000 && symmetric > 10, "{fused} {symmetric}");
}
