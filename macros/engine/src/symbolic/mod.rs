//! The expression graph: simplification, trigonometry, differentiation, linear algebra, identity test.
//!
//! It knows no mechanics. See [`graph`] for the normal form.

pub mod count;
pub mod differentiate;
pub mod evaluate;
pub mod fingerprint;
pub mod graph;
pub mod identity;
pub mod linear_algebra;
pub mod lower;
pub mod number;
mod scalar;
mod trigonometry;
mod vector;
