//! Stages flow one way: no source reads what the table in the documentation of `lib.rs` does not open to its stage.

mod paths;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use paths::{Reading, readings};

/// What each stage may read, as `lib.rs` has it.
type Table = BTreeMap<String, Vec<String>>;

/// Crates of tokens and places in the user's text, and the stages that may name them.
const TOKENS: [&str; 5] = ["proc_macro2", "quote", "syn", "span", "Span"];
const WITH_TOKENS: [&str; 7] = ["diagnostics", "syntax", "robots", "compounds", "model", "emit", "rust_keywords"];

#[test]
fn no_source_reads_upwards() {
    let table = table();
    let mut wrong = Vec::new();
    for (module, text) in sources() {
        wrong.extend(upward(&table, &module, &text));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_stage_stands_in_the_table() {
    let table = table();
    let stages: Vec<String> = sources().into_iter().filter_map(|(module, _)| module.first().cloned()).collect();
    for stage in &stages {
        assert!(table.contains_key(stage), "{stage} is missing in the table of lib.rs");
    }
    for stage in table.keys() {
        assert!(stages.contains(stage), "the table of lib.rs has {stage}, which is no module");
    }
}

/// What the check is there to find, in every way to write it.
#[test]
fn an_upward_path_is_found() {
    let table = table();
    let cases = [
        ("symbolic::graph", "use crate::optimize::program::Program;"),
        ("symbolic::graph", "use crate::{model, contracts::cost::Cost};"),
        ("symbolic::graph", "use super::super::model::types::Model;"),
        ("symbolic", "use super::mechanics::{self};"),
        ("symbolic::graph", "fn f(s: crate::contracts::symbol::Symbol) {}"),
        ("dynamics::tree", "mod inner { use super::super::super::model::types::Joint; }"),
        ("dynamics::tree", "fn f() { let x = crate::mechanics::of; }"),
        ("dynamics::tree", "use proc_macro2::Ident;"),
        ("dynamics::tree", "fn f() -> ::syn::Ident { todo!() }"),
        ("mechanics::derive", "fn f(model: &Model) { g(model.name.span()); }"),
        ("solve::plan", "macro_rules! m { () => { crate::mechanics::of } }"),
        ("mechanics::derive", "use crate::emit::emit;"),
        ("optimize", "pub use crate::verify;"),
        ("emit::items", "use crate::symbolic::graph::Graph;"),
    ];
    for (module, text) in cases {
        let module: Vec<String> = module.split("::").map(str::to_owned).collect();
        assert_eq!(upward(&table, &module, text).len(), 1, "{module:?}: {text}");
    }
    let allowed = [
        ("symbolic::graph", "use crate::contracts::{call::Call, cost::Cost};"),
        ("symbolic::graph", "use super::{number, scalar}; mod tests { use super::*; }"),
        ("mechanics::derive", "fn f() { crate::solve::of(self::x()); } // crate::emit"),
    ];
    for (module, text) in allowed {
        let module: Vec<String> = module.split("::").map(str::to_owned).collect();
        assert_eq!(upward(&table, &module, text), Vec::<String>::new());
    }
}

/// Stops of the walk in ARCHITECTURE.md are there, and lead down the stages.
#[test]
fn the_walk_is_true() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("../../ARCHITECTURE.md")).unwrap();
    let walk = page.split("## A walk through the house").nth(1).unwrap().split("\n## ").next().unwrap();
    let mut stops = 0;
    for row in walk.lines().filter(|line| line.contains(".rs` |")) {
        let names: Vec<&str> = row.split('`').collect();
        let (file, function) = (names[1], names[3]);
        let text = fs::read_to_string(root.join("src").join(file)).unwrap_or_else(|_| panic!("{file} is gone"));
        let declared = text.contains(&format!("fn {function}(")) || text.contains(&format!("fn {function}<"));
        assert!(declared, "{file} has no function {function}");
        stops += 1;
    }
    assert!(stops > 15, "{stops} stops");
}

/// What a source reads and may not.
fn upward(table: &Table, module: &[String], text: &str) -> Vec<String> {
    let Some(stage) = module.first() else { return Vec::new() };
    let open = &table[stage];
    let wrong = |reading: &Reading| match reading {
        Reading::Inside(path) => {
            let path = path.join("::");
            let own = [stage].into_iter().chain(open);
            !own.into_iter().any(|open| path == *open || path.starts_with(&format!("{open}::")))
        }
        Reading::Name(name) => TOKENS.contains(&name.as_str()) && !WITH_TOKENS.contains(&stage.as_str()),
    };
    let found = readings(module, text.parse().expect("tokens"));
    found.iter().filter(|reading| wrong(reading)).map(|reading| format!("{}: {reading:?}", module.join("::"))).collect()
}

/// The lines `stage: what it reads` between the fences.
fn table() -> Table {
    let text = fs::read_to_string(root().join("lib.rs")).expect("lib.rs");
    let lines = text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim);
    let block = lines.skip_while(|line| *line != "```text").skip(1).take_while(|line| *line != "```");
    let table: Table = block
        .map(|line| {
            let (stage, reads) = line.split_once(':').expect("`stage: reads`");
            (stage.to_owned(), reads.split_whitespace().map(str::to_owned).collect())
        })
        .collect();
    assert!(table.len() > 5, "{table:?}");
    table
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// All sources but `lib.rs`, with their modules.
fn sources() -> Vec<(Vec<String>, String)> {
    let mut folders = vec![root()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            // Parts of `compounds` are texts in the language.
            if path.extension().is_none_or(|extension| extension != "rs") {
                continue;
            }
            let inside = path.strip_prefix(root()).expect("inside").with_extension("");
            let mut module: Vec<String> =
                inside.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
            module.pop_if(|last| last == "mod");
            if module != ["lib"] {
                found.push((module, fs::read_to_string(&path).expect("a source")));
            }
        }
    }
    found
}
