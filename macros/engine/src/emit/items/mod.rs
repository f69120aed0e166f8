//! Stage `emit`: the items of a generated module, one file each.

mod assembly;
mod at;
mod check;
mod columns;
mod conversions;
mod costs;
mod defaults;
mod differentiable;
mod equations;
mod impulses;
mod missing;
mod model;
mod parts;
pub(super) mod separable;
mod serialised;
mod singular;
mod space;
mod state;
mod structs;
mod system;
mod verifiable;
mod written;

use proc_macro2::TokenStream;

use super::Context;

/// Expands to all items of the module: what is called stands before what is looked up.
pub(super) fn all(context: &Context<'_>) -> TokenStream {
    [
        costs::dof(context),
        structs::items(context),
        defaults::items(context),
        check::item(context),
        state::items(context),
        space::items(context),
        columns::items(context),
        conversions::items(context),
        serialised::items(context),
        model::items(context),
        missing::items(context),
        system::item(context),
        differentiable::item(context),
        separable::item(context),
        assembly::items(context).unwrap_or_default(),
        at::items(context).unwrap_or_default(),
        impulses::items(context),
        verifiable::item(context).unwrap_or_default(),
        parts::items(context),
        equations::items(context),
        written::items(context),
        costs::items(context),
    ]
    .into_iter()
    .collect()
}
