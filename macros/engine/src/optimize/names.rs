//! Stage `optimize`: readable, unique names of locals and fields.
//!
//! In: hints from the derivation, such as `w_lower_z`. Out: Rust identifiers in snake case, numbered where they would
//! meet, never a keyword.

use std::collections::HashMap;

use crate::rust_keywords::is_keyword;

/// Names given so far. That of a value and that of its negative are one: `minus_x` is minus `x`, and no other value.
#[derive(Default)]
pub struct Names {
    used: HashMap<String, u32>,
}

/// What generated functions call their arguments.
const RESERVED: &[&str] = &["t", "state", "input", "accel", "q", "v", "params"];

impl Names {
    /// Whether a hint is given back as it is.
    pub fn is_free(&self, hint: &str) -> bool {
        let base = identifier(hint);
        !self.used.contains_key(unsigned(&base)) && !RESERVED.contains(&base.as_str()) && !is_keyword(&base)
    }

    /// The hint itself if it is free, else with a number.
    pub fn unique(&mut self, hint: &str) -> String {
        let base = identifier(hint);
        let reserved = RESERVED.contains(&base.as_str()) || is_keyword(&base);
        loop {
            let count = self.used.entry(unsigned(&base).to_owned()).or_insert(0);
            *count += 1;
            let number = *count;
            if number == 1 {
                if !reserved {
                    return base;
                }
                continue;
            }
            // A hint may look like a numbered name.
            let name = format!("{base}_v{number}");
            if !self.used.contains_key(unsigned(&name)) {
                self.used.insert(unsigned(&name).to_owned(), 1);
                return name;
            }
        }
    }
}

fn unsigned(name: &str) -> &str {
    name.strip_prefix("minus_").unwrap_or(name)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_never_meet() {
        let mut names = Names::default();
        let hints = ["x_v2", "x", "x", "x", "type", "q", "x_v3", "X", ""];
        let given: std::collections::HashSet<String> = hints.iter().map(|hint| names.unique(hint)).collect();
        assert_eq!(given.len(), hints.len());
        assert!(given.iter().all(|name| !is_keyword(name) && !RESERVED.contains(&name.as_str())));
    }

    #[test]
    fn what_is_minus_a_name_is_no_other_value() {
        let mut names = Names::default();
        assert_eq!(names.unique("side"), "side");
        assert!(!names.is_free("minus_side"));
        assert_eq!(
            ["minus_side", "side", "minus_side"].map(|hint| names.unique(hint)),
            ["minus_side_v2", "side_v3", "minus_side_v4"]
        );
    }
}
