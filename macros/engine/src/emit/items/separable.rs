//! Stage `emit`: the marker of models whose accelerations do not depend on velocities.
//!
//! What counts is the program after all rewrites: a velocity that cancels is no dependence.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::Context;
use crate::emit::layout::places::Root;
use crate::emit::methods::functions;
use crate::mechanics::loops::constraints::is_rate;

/// Expands to `impl<T: Real> Separable for Model<T> {}` where it holds.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let krate = context.layout.krate();
    let separable = is_separable(context);
    let item = separable.then(|| quote!(impl<T: Real> #krate::Separable for Model<T> {}));
    item.unwrap_or_default()
}

/// Whether forward dynamics reads no velocity, and the model has no states of its own and no constraints of velocities: methods for
/// such models close positions alone.
pub(in crate::emit) fn is_separable(context: &Context<'_>) -> bool {
    let forward = context.function(FunctionKind::ForwardDynamics);
    let model = context.layout.model;
    let rolls = context.layout.structure.rows.iter().any(|&row| is_rate(model, row));
    !rolls
        && !context.layout.structure.has_speeds()
        && !context.layout.has_states()
        && forward.is_some_and(|f| !functions::roots(&f.program).contains(&Root::Velocity))
}
