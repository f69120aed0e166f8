//! Calls with files beside them.

use std::collections::HashMap;

use multibody_engine::compile;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{Trouble, model, parse_reading};
use proc_macro2::TokenStream;

use crate::interpreter;

/// The models of a call in which every file has this text, and what is said: the text at which, what, help.
pub(crate) fn checked(call: TokenStream, file: &str) -> (Vec<Model>, Vec<String>) {
    let mut diagnostics = Diagnostics::default();
    let source = parse_reading(call, &|_| Ok(file.to_owned()), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let said = diagnostics.errors().iter().map(|error| {
        let help = error.help.as_ref().map_or_else(String::new, |help| format!(" | {help}"));
        format!("{}{help}", error.message)
    });
    (models, said.collect())
}

/// The one model of a call without mistakes.
pub(crate) fn model_of(call: &str, file: &str) -> Model {
    let (mut models, said) = checked(call.parse().unwrap(), file);
    assert!(said.is_empty(), "{said:#?}");
    assert_eq!(models.len(), 1);
    models.remove(0)
}

pub(crate) fn compiled(model: &Model) -> Compiled {
    match compile(model) {
        Ok((_, compiled)) => compiled,
        Err(Trouble::Complaints(complaints)) => {
            let said: Vec<&str> = complaints.iter().map(|complaint| complaint.message.as_str()).collect();
            panic!("`{}` is refused: {said:#?}", model.name)
        }
        Err(_) => panic!("`{}` is refused", model.name),
    }
}

/// A number between -1 and 1 for each symbol, always the same one.
pub(crate) fn value(symbol: Symbol) -> f64 {
    let text = format!("{symbol:?}");
    let hash = text
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    ((hash >> 11) as f64 / (1_u64 << 52) as f64) - 1.0
}

/// All functions at one state, parameters at their defaults, and their operations.
pub(crate) fn functions(model: &Model) -> HashMap<FunctionKind, (Vec<f64>, String)> {
    evaluated(model, &value)
}

/// The same at a state of the caller's.
pub(crate) fn evaluated(model: &Model, state: &dyn Fn(Symbol) -> f64) -> HashMap<FunctionKind, (Vec<f64>, String)> {
    let compiled = compiled(model);
    let symbols = |symbol| match symbol {
        Symbol::Param { param, element } => model.params[param].default[element],
        other => state(other),
    };
    let fields = interpreter::run(&compiled.prelude, &symbols, &|_| unreachable!("fields come from parameters"));
    let functions = compiled.functions.iter().map(|function| {
        let values = interpreter::run(&function.program, &symbols, &|field| fields[field.0]);
        (function.kind, (values, format!("{:?}", function.after)))
    });
    functions.collect()
}

/// Functions of two models that are one mechanism.
pub(crate) fn assert_same(a: &Model, b: &Model, are_counts_equal: bool) {
    assert_same_at(&value, a, b, are_counts_equal);
}

/// The same at a state of the caller's.
pub(crate) fn assert_same_at(state: &dyn Fn(Symbol) -> f64, a: &Model, b: &Model, are_counts_equal: bool) {
    let [a_values, b_values] = [a, b].map(|model| evaluated(model, state));
    assert!(a_values.len() > 1 && a_values.len() == b_values.len());
    for (kind, (values, count)) in &a_values {
        let (others, other_count) = &b_values[kind];
        assert_eq!(values.len(), others.len());
        for (x, y) in values.iter().zip(others) {
            assert!((x - y).abs() <= 1e-12 * x.abs().max(1.0), "{} and {}, {kind:?}: {x} and {y}", a.name, b.name);
        }
        if are_counts_equal {
            assert_eq!(count, other_count, "{kind:?} of {}", b.name);
        }
    }
}
