//! Stage `emit`: one module per part used, with those structs that have fields.

use proc_macro2::TokenStream;
use quote::quote;

use super::{columns, defaults, differentiable, serialised, space, structs};
use crate::emit::layout::StructKind;
use crate::emit::{Context, document, names};
use crate::model::types::PartTypeId;

/// Expands to `pub mod leg { pub struct Position<T = f64> { .. } .. }` for every part.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let mut modules = TokenStream::new();
    for (index, part) in layout.model.part_types.iter().enumerate() {
        let owner = Some(PartTypeId(index));
        let groups: Vec<StructKind> =
            StructKind::ALL.into_iter().filter(|group| !layout.is_empty(*group, owner)).collect();
        if groups.is_empty() {
            continue;
        }
        let mut items = TokenStream::new();
        for group in groups {
            items.extend(structs::declare(layout, group, owner));
            items.extend(defaults::implement(layout, group, owner));
            items.extend(columns::implement(layout, group, owner));
            items.extend(serialised::implement(layout, group, owner));
            items.extend(match group {
                StructKind::Velocity | StructKind::Rates | StructKind::States => space::tangent(layout, group, owner),
                StructKind::Input if differentiable::moves_inputs(context) => space::tangent(layout, group, owner),
                StructKind::Position => space::configuration(layout, owner),
                _ => TokenStream::new(),
            });
        }
        let docs = document::item(&part.docs, &format!("Part `{}`.", names::plain(&part.name)));
        let docs = document::attributes(&docs);
        let name = names::field(&part.name);
        modules.extend(quote! {
            #docs
            pub mod #name {
                use ::core::prelude::v1::*;
                use #krate::Real;
                #items
            }
        });
    }
    modules
}
