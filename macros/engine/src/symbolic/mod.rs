//! The expression graph: simplification, trigonometry, differentiation, linear algebra, identity test.
//!
//! It knows no mechanics. See [`graph`] for the normal form.

pub mod fingerprint;
pub mod graph;
pub mod number;
pub mod count;
pub mod differentiate;
pub mod evaluate;
pub mod identity;
pub mod linear_algebra;
pub mod lower;
mod scalar;
mod trigonometry;
mod vector;
