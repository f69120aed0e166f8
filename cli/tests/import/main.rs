//! `import`: models that come of URDF files, beside data of another library, closed forms and the messages of mistakes.

mod arms;
mod elements;
mod wrong;

/// Compiled functions as numbers.
#[path = "../../../macros/engine/tests/common/interpreter.rs"]
mod interpreter;

use std::path::PathBuf;
use std::process::Command;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::types::{JointId, Model};
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{compile, model, syntax};
use proc_macro2::{TokenStream, TokenTree};

/// Output, messages, exit code of the program, which runs beside the data.
fn run(words: &[&str]) -> (String, String, i32) {
    let output = Command::new(env!("CARGO_BIN_EXE_cargo-multibody"))
        .args(words)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/urdf"))
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr), output.status.code().unwrap())
}

/// What is written of a file, and the notes.
fn imported(words: &[&str]) -> (String, String) {
    let all: Vec<&str> = ["import"].iter().chain(words).copied().collect();
    let (text, notes, code) = run(&all);
    assert_eq!(code, 0, "{notes}");
    assert!(notes.lines().all(|line| line.starts_with("note: ")), "{notes}");
    (text, notes)
}

/// A file among those that tests write.
fn written(name: &str, text: &str) -> String {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, text).unwrap();
    file.to_str().unwrap().to_owned()
}

/// A model with its functions, to be called with numbers.
struct Functions {
    model: Model,
    compiled: Compiled,
}

/// What the state is, and what acts: by joint and component.
#[derive(Default)]
struct At<'a> {
    q: Vec<(&'a str, usize, f64)>,
    v: Vec<(&'a str, usize, f64)>,
    a: Vec<(&'a str, usize, f64)>,
    /// By the number of the input.
    inputs: Vec<f64>,
}

impl Functions {
    fn of(text: &str) -> Functions {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(call(text.parse().unwrap()).unwrap(), &mut diagnostics);
        let model = model::check_all(&source, &mut diagnostics).remove(0).model;
        assert!(diagnostics.errors().is_empty(), "{text}");
        let Ok((_, compiled)) = compile(&model) else { panic!("no functions come of\n{text}") };
        Functions { model, compiled }
    }

    fn run(&self, kind: FunctionKind, at: &At<'_>) -> Vec<f64> {
        let function = self.compiled.functions.iter().find(|function| function.kind == kind).unwrap();
        let find = |list: &[(&str, usize, f64)], joint: JointId, component: usize| {
            let name = self.model.joints[joint].place.field.to_string();
            let found = list.iter().find(|(of, number, _)| *of == name && *number == component);
            found.map_or(0.0, |(_, _, value)| *value)
        };
        let symbols = |symbol: Symbol| match symbol {
            Symbol::Position { joint, component } => find(&at.q, joint, component),
            Symbol::Velocity { joint, component } => find(&at.v, joint, component),
            Symbol::Acceleration { joint, component } => find(&at.a, joint, component),
            Symbol::Input { input, .. } => at.inputs[input.0],
            other => panic!("{other:?} has no value"),
        };
        let fields = interpreter::run(&self.compiled.prelude, &symbols, &|_| f64::NAN);
        interpreter::run(&function.program, &symbols, &|field| fields[field.0])
    }
}

/// What stands in the braces of `multibody! { .. }`.
fn call(tokens: TokenStream) -> Option<TokenStream> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Group(group) => Some(group.stream()),
        _ => None,
    })
}

/// Largest difference over the largest number.
fn difference(got: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(got.len(), expected.len());
    let size = expected.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    got.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, |most, x| if x <= most { most } else { x }) / size
}
