//! The keywords of Rust, which no name of the user's and none of ours may be.
//!
//! In: a name. Out: whether edition 2024 keeps it for itself, now or later.

const KEYWORDS: &[&str] = &[
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro",
    "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super",
    "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Strict and reserved keywords, and the underscore.
pub(crate) fn is_keyword(name: &str) -> bool {
    name == "_" || KEYWORDS.contains(&name)
}
