//! Stage `emit`: what stands beside errors, so that one mistake doesn't cause forty.
//!
//! In: a model whose mistakes have been filled in, and whether it is known how it hangs together. Out: the module that it
//! would be, with all functions and no bodies: what the user's code says about `Model`, `State` and their fields still
//! resolves, and only the mistake itself is reported.

use proc_macro2::TokenStream;

use crate::contracts::cost::Cost;
use crate::contracts::function::FunctionKind;
use crate::emit::{context, module};
use crate::mechanics;
use crate::model::{Checked, Soundness};
use crate::optimize::program::{Compiled, Function, Program};

use super::guesses;

/// The stand-in of one model.
pub fn skeleton(checked: &Checked) -> TokenStream {
    let model = &checked.model;
    let small = mechanics::freedoms(model) <= mechanics::MOST_FREEDOMS;
    let known = (checked.state != Soundness::Guessed && small).then(|| mechanics::analysis::analyse(model).ok());
    let structure = known.flatten().unwrap_or_else(|| guesses::structure(model));
    let mut compiled = Compiled::default();
    let mut kinds = vec![
        FunctionKind::ForwardDynamics,
        FunctionKind::InverseDynamics,
        FunctionKind::MassMatrix,
        FunctionKind::Bias,
        FunctionKind::KineticEnergy,
        FunctionKind::PotentialEnergy,
        FunctionKind::Outputs,
        FunctionKind::Residual,
        FunctionKind::ForwardDerivatives,
        FunctionKind::InverseDerivatives,
        FunctionKind::Impulse,
        FunctionKind::Momentum,
        FunctionKind::MomentumRate,
        FunctionKind::MomentumVelocity,
    ];
    if !structure.rows.is_empty() {
        kinds.extend([
            FunctionKind::Constraints,
            FunctionKind::ConstraintJacobian,
            FunctionKind::ConstraintRate,
            FunctionKind::ConstraintBias,
        ]);
    }
    kinds.extend((0..model.kinematics.len()).map(FunctionKind::Kinematics));
    kinds.extend((structure.guesses() > 0).then_some(FunctionKind::Guess));
    compiled.functions.extend(kinds.into_iter().map(|kind| Function {
        kind,
        program: Program::default(),
        before: Cost::default(),
        after: Cost::default(),
        method: "",
        candidate: 0,
    }));
    module(&context(model, &structure, &compiled, true))
}
