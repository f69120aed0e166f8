//! Stage `mechanics`: an expression of another model, closed.
//!
//! In: a model, an expression of it. Out: the expression in symbols of the model's state, inputs, parameters and time, with loops
//! solved as they are in the model's own functions.

use std::rc::Rc;

use crate::contracts::results::Results;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::mechanics::analysis::{Complaint, analyse};
use crate::mechanics::loops::structure::Structure;
use crate::mechanics::translate::{formulas, manipulations};
use crate::model::site::Sited;
use crate::model::types::{ExternalId, Formula};
use crate::symbolic::graph::{Graph, Scalar, SymbolId};

use super::Deriving;

/// A formula, solved.
pub(in crate::mechanics) struct Solved {
    pub graph: Graph,
    /// As many as its type has.
    pub scalars: Vec<Scalar>,
    /// What they read.
    pub reads: Vec<(SymbolId, Symbol)>,
    pub structure: Structure,
    /// A function of the user's own Rust that it calls, itself or by what it is made of.
    pub calls: Option<ExternalId>,
}

/// Why there is none.
pub(in crate::mechanics) enum Unsolved {
    /// The model has a mistake of its own, which is reported there.
    Elsewhere,
    /// What is asked of it.
    Here(Complaint),
}

/// Solved once for each question, however often its value is needed.
pub(in crate::mechanics) fn solved(formula: &Formula) -> Rc<Result<Solved, Unsolved>> {
    formula.solved.get_or(|| solve(formula))
}

fn solve(formula: &Formula) -> Result<Solved, Unsolved> {
    let Formula { model, of, .. } = formula;
    // It may ask others.
    formulas::complaints_of(vec![of])
        .map_err(|complaints| complaints.into_iter().next().map_or(Unsolved::Elsewhere, Unsolved::Here))?;
    let structure = analyse(model).map_err(|_| Unsolved::Elsewhere)?;
    let complaints = manipulations::complaints_of(model, &structure, vec![of]);
    if let Some(complaint) = complaints.into_iter().next() {
        return Err(Unsolved::Here(complaint));
    }
    let mut deriving = Deriving::new(model, &structure);
    deriving.check_manipulations().map_err(|_| Unsolved::Elsewhere)?;
    deriving.check().map_err(|_| Unsolved::Elsewhere)?;
    let found = deriving.only("", |e| {
        let reduction = e.reduce()?;
        let mut scalars = Vec::new();
        e.value(of).flatten(&mut e.g, &mut scalars);
        Ok(Results::vector(e.finish(&reduction, &scalars)))
    });
    let found = found.map_err(|complaints| match complaints.into_iter().next() {
        Some(complaint) if deriving.curved => Unsolved::Here(Complaint { at: formula.site(), ..complaint }),
        _ => Unsolved::Elsewhere,
    })?;
    let (_, results) = found.into_iter().next().or_fault("there is a way to each formula");
    let scalars = results.list;
    let Some(read) = deriving.graph.formula_symbols(&scalars) else {
        let message = format!("a loop of `{}` that this reads is closed by iteration: there is no formula", model.name);
        let help = Some(format!("write `solve (..) from ..` in `{}`", model.name));
        return Err(Unsolved::Here(Complaint { at: formula.site(), message, help }));
    };
    let reads = read.into_iter().map(|id| (id, deriving.symbols.table[id.0])).collect();
    let calls = deriving.graph.external(&scalars);
    Ok(Solved { graph: deriving.graph, scalars, reads, structure, calls })
}
