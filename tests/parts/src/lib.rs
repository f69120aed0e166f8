//! Legs and feet, for models of other crates.

#![deny(missing_docs, unreachable_pub, unused)]

pub mod legs;
pub mod machines;
