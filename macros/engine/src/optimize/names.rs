//! Stage `optimize`: readable, unique names of locals and fields.
//!
//! In: hints from the derivation, such as `w_lower_z`. Out: Rust identifiers in snake case, numbered where they would
//! meet, never a keyword.

use std::collections::HashMap;

/// Names given so far.
#[derive(Default)]
pub struct Names {
    used: HashMap<String, u32>,
}

const RESERVED: &[&str] = &[
    "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else", "enum",
    "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod", "move",
    "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true", "try",
    "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield", "t", "state", "input", "accel",
    "q", "params", "abstract",
];

impl Names {
    /// The hint itself if it is free, else with a number.
    pub fn unique(&mut self, hint: &str) -> String {
        let base = identifier(hint);
        let count = self.used.entry(base.clone()).or_insert(0);
        *count += 1;
        let number = *count;
        if number == 1 && !RESERVED.contains(&base.as_str()) {
            return base;
        }
        let name = format!("{base}_v{number}");
        self.used.entry(name.clone()).or_insert(1);
        name
    }
}

/// Lower case, digits and underscores; starts with a letter or an underscore.
fn identifier(hint: &str) -> String {
    let mut name: String = hint
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || c == '_' { c.to_ascii_lowercase() } else { '_' })
        .collect();
    while name.contains("__") {
        name = name.replace("__", "_");
    }
    if name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()) || name == "_" {
        name.insert(0, 'v');
    }
    name
}
