//! The expression graph: normal form, lowering, derivatives, substitution, linear systems, the identity test.

mod adjoints;
mod blocks;
mod differentiation;
#[path = "../common/expressions.rs"]
mod expressions;
mod identity;
mod inputs;
mod literals;
#[path = "../common/rng.rs"]
mod rng;
mod signs;
mod sparse_factors;
mod structured;
mod substitution;
mod turned;
mod vectors;
