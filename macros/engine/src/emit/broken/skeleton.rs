//! Stage `emit`: what stands beside errors, so that one mistake doesn't cause forty.
//!
//! In: a model whose mistakes have been filled in, and whether it is known how it hangs together. Out: the module that it
//! would be, with all functions and no bodies: what the user's code says about `Model`, `State` and their fields still
//! resolves, and only the mistake itself is reported.

use proc_macro2::TokenStream;

use crate::contracts::cost::Cost;
use crate::contracts::function::{Asked, FunctionKind};
use crate::contracts::results::Parts;
use crate::emit::{context, module};
use crate::mechanics;
use crate::model::{Checked, Soundness};
use crate::optimize::program::{At, Compiled, Function, Program};

use super::guesses;

/// The stand-in of one model.
pub fn skeleton(checked: &Checked) -> TokenStream {
    let model = &checked.model;
    let small = mechanics::freedoms(model) <= mechanics::MOST_FREEDOMS;
    let known = (checked.state != Soundness::Guessed && small).then(|| mechanics::analysis::analyse(model).ok());
    let structure = known.flatten().unwrap_or_else(|| guesses::structure(model));
    let mut compiled = Compiled::default();
    let kinds = FunctionKind::ALL.into_iter().flat_map(|kind| match (kind, kind.row().asked) {
        (FunctionKind::Kinematics(_), _) => (0..model.kinematics.len()).map(FunctionKind::Kinematics).collect(),
        (FunctionKind::OutputGroup(_), _) => (0..model.output_groups.len()).map(FunctionKind::OutputGroup).collect(),
        // Its struct is there only where it is asked for.
        (FunctionKind::Poses, _) => vec![kind; usize::from(model.shows_poses())],
        (FunctionKind::PositionJacobian, _) if !structure.has_speeds() => Vec::new(),
        (_, Asked::Equations) if structure.rows.is_empty() => Vec::new(),
        (_, Asked::Guesses) if structure.guesses() == 0 => Vec::new(),
        (_, Asked::Speeds) if !structure.has_speeds() => Vec::new(),
        (_, Asked::Found) => Vec::new(),
        (_, Asked::By { .. } | Asked::Outputs | Asked::Equations | Asked::Speeds | Asked::Guesses) => vec![kind],
    });
    compiled.functions.extend(kinds.map(stand_in));
    if !model.at.is_empty() {
        let kinds = compiled.functions.iter().map(|function| function.kind);
        let named = kinds.filter(|kind| model.at.iter().any(|wanted| kind.method(model) == wanted.name));
        compiled.at = Some(At { functions: named.map(stand_in).collect(), ..At::default() });
    }
    module(&context(model, &structure, &compiled, true))
}

/// A function without a body.
fn stand_in(kind: FunctionKind) -> Function {
    Function {
        kind,
        parts: Parts::default(),
        program: Program::default(),
        before: Cost::default(),
        after: Cost::default(),
        method: "",
        candidate: 0,
        rivals: Vec::new(),
    }
}
