//! Stage `mechanics`: from the checked model to equations on the graph.
//!
//! Rooms: [`translate`] makes the tree of links and the values of expressions, [`loops`] says which coordinates follow and
//! how, [`analysis`] decides that in numbers beforehand, `results` has one file per thing that functions give, [`strut`] the
//! short way for bodies on struts, `headings` what moves on planes; [`derive()`] tells which functions are made, and in which ways. [`scene`] is
//! what a derivation is about, and [`equations`] what it has made. [`poses`] has frames in numbers, for drawings.

pub mod analysis;
mod derive;
pub mod equations;
mod headings;
pub mod limbs;
pub mod loops;
pub mod poses;
mod results;
pub mod scene;
pub mod strut;
pub mod translate;
mod trees;
pub mod written;

pub use derive::{Entry, MOST_FREEDOMS, Patterns, agrees, derive, freedoms, hopes, page, patterns, solutions};
pub use translate::reads::Reads;

use std::rc::Rc;

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Results;
use crate::contracts::symbol::Symbol;
use crate::model::types::{Coordinate, Model};
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::turned::Turn;

use analysis::Complaint;
use loops::advice::Pivoted;
use loops::structure::{Modes, Structure};
use written::Page;

/// Structure and equations of a model.
pub fn of(model: &Model) -> Result<(Structure, Derivation), Vec<Complaint>> {
    let structure = analysis::analyse(model)?;
    translate::agreement::check(model);
    let mut derivation = derive(model, &structure)?;
    let mut structure = structure.with_notes(std::mem::take(&mut derivation.notes));
    structure.dead_centres.clone_from(&derivation.dead_centres);
    structure.modes = derivation.modes;
    structure.pivoted = std::mem::take(&mut derivation.pivoted);
    structure.page = derivation.page.take().map(Rc::new);
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
    /// Those that go on from what is done once for a position, in the order of the model.
    pub at: Vec<FunctionKind>,
    /// Sentences for the report: how loops were solved and checked.
    pub notes: Vec<String>,
    /// Unknowns whose roots [`FunctionKind::DeadCentres`] gives, in this order.
    pub dead_centres: Vec<Coordinate>,
    /// How many assembly modes there are, where the model asks for them.
    pub modes: Option<Modes>,
    /// By candidate of forward dynamics what became of equations with multipliers.
    pub pivoted: Vec<Pivoted>,
    /// The equations for readers, where the model asks for them.
    pub page: Option<Page>,
    /// For `Params::check`.
    pub checks: Vec<Test>,
    /// For `System::without_inertia`: entries row by row.
    pub inertia: Inertia<Vec<Scalar>>,
    /// Functions that were not asked for, which laws compare with those that were.
    pub witnesses: Vec<Witness>,
    /// Headings of motions on planes.
    pub turns: Vec<Turn>,
    /// What may be packed; nothing where the model wants no packs.
    pub limbs: Option<limbs::Limbs>,
}

/// A function in one formulation, for the check in numbers alone.
pub struct Witness {
    pub kind: FunctionKind,
    pub results: Results<Scalar>,
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
    /// Name of the method, and results in the slots of the function.
    pub candidates: Vec<(&'static str, Results<Scalar>)>,
}

/// The mass matrix, where it may become singular.
#[derive(Clone, Debug, Default)]
pub enum Inertia<P> {
    /// It is regular wherever it is finite, or nothing is to be said of it.
    #[default]
    Regular,
    /// The function that the model asks for gives it.
    Requested,
    /// No function gives it.
    Own(P),
}

/// What must hold of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    Finite,
    /// The first value is above rounding of the second.
    Pivot,
    /// Below the square root of the rounding unit.
    Small,
}
