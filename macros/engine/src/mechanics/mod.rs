//! From the checked model to equations on the graph.
//!
//! [`build`] makes the tree of links, the recursions walk it, and [`derive()`] tells which functions are made of them.
//! User expressions are translated by `expressions`.

mod actuation;
pub mod analysis;
pub mod articulated;
pub mod articulated_inertia;
mod branches;
pub mod build;
mod chain;
mod climb;
pub mod closings;
mod columns;
pub mod composite;
mod constants;
mod constrained;
mod cycles;
mod derive;
mod drives;
mod dynamics;
mod energy;
pub mod equations;
mod expressions;
pub mod floating;
mod forces;
mod frames;
mod functions;
mod gathered;
mod gimbals;
pub mod groups;
mod holding;
pub mod inertia;
mod jacobian;
mod jumps;
pub mod kinematics;
mod kinks;
mod linearisation;
mod margins;
mod momentum;
mod names;
mod needs;
pub mod newton_euler;
mod orientation;
pub mod parallel;
mod reactions;
mod reduction;
pub mod regroup;
mod rotors;
mod saddle;
mod springs;
pub mod structure;
pub mod strut;
pub mod symbols;
pub mod time;
pub mod tree;
mod typed;
mod values;
mod velocities;
mod verification;
mod world;

pub use derive::{MOST_FREEDOMS, derive, freedoms};

use crate::model::types::{Coordinate, Model};
use crate::optimize::program::{Condition, FunctionKind, Inertia, Symbol};
use crate::symbolic::graph::{Graph, Scalar};

use analysis::Complaint;
use structure::Structure;

/// Structure and equations of a model.
pub fn of(model: &Model) -> Result<(Structure, Derivation), Vec<Complaint>> {
    let structure = analysis::analyse(model)?;
    let mut derivation = derive(model, &structure)?;
    let mut structure = structure.with_notes(std::mem::take(&mut derivation.notes));
    structure.dead_centres.clone_from(&derivation.dead_centres);
    Ok((structure, derivation))
}

/// Equations of one model, ready for optimisation.
pub struct Derivation {
    pub graph: Graph,
    /// By the number of the symbol in the graph.
    pub symbols: Vec<Symbol>,
    /// Readable names of the symbols, in snake case, such as `elbow`, `elbow_rate`, `m1`.
    pub symbol_names: Vec<String>,
    pub functions: Vec<Derived>,
    /// Sentences for the report: how loops were solved and checked.
    pub notes: Vec<String>,
    /// Unknowns whose roots [`FunctionKind::DeadCentres`] gives, in this order.
    pub dead_centres: Vec<Coordinate>,
    /// For `Params::check`.
    pub checks: Vec<Test>,
    /// For `System::without_inertia`: entries row by row.
    pub inertia: Inertia<Vec<Scalar>>,
}

/// What must hold of parameters.
#[derive(Clone)]
pub struct Test {
    /// What is wrong where it doesn't.
    pub what: String,
    pub condition: Condition,
    /// Of parameters alone.
    pub values: Vec<Scalar>,
}

/// One function with the ways in which it was derived; the cheapest will be taken, ties by order.
pub struct Derived {
    pub kind: FunctionKind,
    /// Name of the method and results in the order that [`FunctionKind`] documents.
    pub candidates: Vec<(&'static str, Vec<Scalar>)>,
}
