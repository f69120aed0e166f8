//! Reference data in `data`, as numbers.

use std::path::PathBuf;

use serde_json::Value;

/// A path within this package.
pub fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The file `data/NAME.json`.
pub fn read(name: &str) -> Value {
    let file = path(&format!("data/{name}.json"));
    let text = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    serde_json::from_str(&text).unwrap()
}

/// A number, or a decimal string with more digits than `f64` holds.
pub fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap_or_else(|_| panic!("{text} is no number")),
        value => value.as_f64().unwrap_or_else(|| panic!("{value} is no number")),
    }
}

/// All numbers of nested lists, row by row.
pub fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        value => vec![number(value)],
    }
}

/// A vector of `N` numbers.
pub fn array<const N: usize>(value: &Value) -> [f64; N] {
    flat(value).try_into().unwrap_or_else(|_| panic!("{value} has not {N} numbers"))
}

/// The elements of a list.
pub fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is no list"))
}
