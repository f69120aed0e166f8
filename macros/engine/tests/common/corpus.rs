//! Every model of the project: tests, examples, the ones that must compile, README.

use std::fs;
use std::path::{Path, PathBuf};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model;
use multibody_engine::model::types::Model;
use proc_macro2::{TokenStream, TokenTree};

/// Places of models, from the root of the project.
pub(crate) const PLACES: [&str; 9] = [
    "tests/models",
    "tests/ui/pass",
    "examples/models",
    "examples",
    "runtime/tests/integrators",
    "runtime/tests/loops",
    "runtime/tests/numbers",
    "runtime/tests/rolling",
    "README.md",
];

/// Calls with the files that they stand in.
pub(crate) fn calls() -> Vec<(String, TokenStream)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    PLACES.iter().flat_map(|place| calls_of(&root, place)).collect()
}

/// The same of one place: a folder or a file.
pub(crate) fn calls_of(root: &Path, place: &str) -> Vec<(String, TokenStream)> {
    let mut found = Vec::new();
    for file in files(&root.join(place)) {
        let text = fs::read_to_string(&file).unwrap();
        let name = file.strip_prefix(root).unwrap().display().to_string();
        let text = if name.ends_with(".md") { code(&text) } else { text };
        let Ok(tokens) = text.parse::<TokenStream>() else { panic!("{name}: no tokens") };
        collect(&name, tokens, &mut found);
    }
    found
}

/// Models of a call; nothing of one with mistakes.
pub(crate) fn models(call: TokenStream) -> Vec<Model> {
    let mut diagnostics = Diagnostics::default();
    let source = multibody_engine::parse(call, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    if diagnostics.is_empty() { models } else { Vec::new() }
}

/// The one model of a text without mistakes.
pub(crate) fn model(text: &str) -> Model {
    let mut diagnostics = Diagnostics::default();
    let source = multibody_engine::parse(text.parse().unwrap(), &mut diagnostics);
    let mut models = model::check(&source, &mut diagnostics);
    let errors: Vec<&str> = diagnostics.errors().iter().map(|e| e.message.as_str()).collect();
    assert!(errors.is_empty() && models.len() == 1, "{errors:#?}");
    models.remove(0)
}

fn files(place: &Path) -> Vec<PathBuf> {
    if place.is_file() {
        return vec![place.to_owned()];
    }
    let mut list: Vec<PathBuf> = fs::read_dir(place).unwrap().map(|entry| entry.unwrap().path()).collect();
    list.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    list.sort();
    list
}

/// The Rust in a page.
fn code(page: &str) -> String {
    let mut inside = false;
    let lines = page.lines().filter(|line| {
        if line.starts_with("```") {
            inside = !inside && line.starts_with("```rust");
            return false;
        }
        inside
    });
    lines.map(|line| format!("{line}\n")).collect()
}

/// `multibody! { .. }`, however deep.
fn collect(file: &str, tokens: TokenStream, found: &mut Vec<(String, TokenStream)>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (at, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let before = |back: usize| at.checked_sub(back).and_then(|at| tokens.get(at));
        let bang = matches!(before(1), Some(TokenTree::Punct(p)) if p.as_char() == '!');
        let call = matches!(before(2), Some(TokenTree::Ident(word)) if word == "multibody");
        if bang && call {
            found.push((file.to_owned(), group.stream()));
        } else {
            collect(file, group.stream(), found);
        }
    }
}
