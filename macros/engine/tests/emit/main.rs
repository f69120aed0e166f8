//! The module that is written: its parts, its expressions, its documentation, and that rustc takes it.

mod blocks;
#[path = "../common/corpus.rs"]
#[allow(dead_code)]
mod corpus;
mod expressions;
mod functions;
mod iterations;
mod looped;
mod loops;
mod module;
mod parsed;
mod parts;
mod references;
mod samples;
mod skeleton;
