//! The module that is written: its parts, its expressions, its documentation, and that rustc takes it.

mod blocks;
mod expressions;
mod iterations;
mod looped;
mod loops;
mod module;
mod parsed;
mod samples;
mod skeleton;
