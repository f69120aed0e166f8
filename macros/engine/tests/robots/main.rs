//! Robots from their files: what they are, and what is said of files that hold none.

mod arms;
mod files;
#[path = "../common/interpreter.rs"]
mod interpreter;
mod malformed;
mod mjcf;
mod mjcf_trees;
mod options;
mod recursion;
mod support;
mod ties;
mod urdf_plus;
