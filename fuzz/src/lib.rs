//! Random models against truth that the engine did not make.
//!
//! `mechanism` draws mechanisms as data and writes them in the language, `programs` compiles the text and interprets what
//! comes of it, `plain` works the same data out in plain numbers, and `oracle` compares: methods of `Model` and those behind
//! `Model::at`, with limbs in packs or without (`mechanism::limbs`). A failure is made as small as it
//! gets (`mechanism::shrink`) and printed as text. `jury` runs models for `cargo xtask mutants`,
//! `written` puts equations for readers down as they are printed, `differentiated` compares `diff` with differences, `manipulated` random
//! expressions that take others apart with what they are made of. `robots` breaks files of robots.

pub mod algebra;
pub mod campaign;
pub mod closed;
pub mod differentiated;
pub mod grammar;
pub mod grammar_campaign;
pub mod jury;
pub mod manipulated;
pub mod mechanism;
pub mod oracle;
pub mod plain;
pub mod programs;
pub mod random;
pub mod robots;
pub mod written;

#[path = "../../macros/engine/tests/common/corpus.rs"]
#[allow(dead_code)]
mod corpus;
#[path = "../../macros/engine/tests/common/interpreter.rs"]
mod interpreter;
#[path = "../../macros/engine/tests/common/pages.rs"]
mod pages;
