//! Legs and feet, and brakes, for models of other crates.

#![deny(missing_docs, unreachable_pub, unused)]

pub mod brakes;
pub mod legs;
pub mod machines;
