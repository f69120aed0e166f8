//! From the checked model to equations on the graph.
//!
//! [`build`] makes the tree of links, the recursions walk it, and [`derive()`] tells which functions are made of them.
//! User expressions are translated by `expressions`.

pub mod articulated;
pub mod articulated_inertia;
pub mod build;
mod chain;
mod climb;
mod columns;
pub mod composite;
mod constants;
mod derive;
mod dynamics;
mod energy;
pub mod equations;
mod expressions;
mod forces;
mod frames;
mod functions;
pub mod inertia;
mod jacobian;
pub mod kinematics;
mod names;
pub mod newton_euler;
mod orientation;
pub mod parallel;
mod reactions;
pub mod regroup;
mod springs;
pub mod symbols;
pub mod tree;
mod values;
mod velocities;
mod world;

pub use derive::{MOST_FREEDOMS, derive, freedoms};

use crate::optimize::program::{FunctionKind, Symbol};
use crate::symbolic::graph::{Graph, Scalar};

/// Equations of one model, ready for optimisation.
pub struct Derivation {
    pub graph: Graph,
    /// By the number of the symbol in the graph.
    pub symbols: Vec<Symbol>,
    /// Readable names of the symbols, in snake case, such as `elbow`, `elbow_rate`, `m1`.
    pub symbol_names: Vec<String>,
    pub functions: Vec<Derived>,
}

/// One function with the ways in which it was derived; the cheapest will be taken, ties by order.
pub struct Derived {
    pub kind: FunctionKind,
    /// Name of the method and results in the order that [`FunctionKind`] documents.
    pub candidates: Vec<(&'static str, Vec<Scalar>)>,
}
