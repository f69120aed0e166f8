//! The expression graph: simplification, trigonometry, differentiation, linear algebra, identity test.
//!
//! It knows no mechanics. See [`graph`] for the normal form.

pub mod adjoint;
pub mod check;
mod constants;
mod cost;
pub mod count;
pub mod dependence;
pub mod differentiate;
pub mod doubled;
mod echelon;
mod elementary;
pub mod evaluate;
pub mod external;
pub mod fingerprint;
pub mod graph;
pub mod identity;
pub mod inputs;
pub mod linear_algebra;
pub mod lower;
pub mod modular;
pub mod number;
pub mod pairs;
pub mod pivoted;
pub mod radical;
pub(crate) mod rotations;
mod scalar;
pub mod signs;
pub mod sized;
pub mod sparse_factors;
pub mod structured;
pub mod substitute;
mod transplant;
pub mod triangular_form;
mod trigonometry;
pub mod turned;
mod vector;
pub mod walk;
pub mod write;
