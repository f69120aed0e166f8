//! Stage `emit`: what lets serde write and read generated structs, where the runtime has its feature `serde`. The impls are the
//! runtime's own, by a macro that is told of the fields.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::layout::{Layout, StructKind, groups};
use crate::emit::{Context, names};
use crate::model::types::PartTypeId;

/// Expands to the impls for the model's structs of fields and for groups of outputs.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let kinds = StructKind::ALL.into_iter().filter(|group| group.always() || !layout.is_empty(*group, None));
    let mut tokens: TokenStream = kinds.map(|group| implement(layout, group, None)).collect();
    tokens.extend(layout.model.output_groups.iter().map(|group| {
        let fields: Vec<Ident> = group.fields.iter().map(|field| names::field(&field.name)).collect();
        of(layout, &groups::name(group), &fields)
    }));
    tokens
}

/// Expands to those of one struct, of the model or of a part.
pub(super) fn implement(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> TokenStream {
    let fields: Vec<Ident> = layout.fields(group, owner).into_iter().map(|field| field.name).collect();
    of(layout, &group.name(), &fields)
}

/// Expands to `::multibody::serialised! { Position { shoulder: "shoulder", elbow: "elbow" } }`, or to nothing.
pub(super) fn of(layout: &Layout<'_>, name: &Ident, fields: &[Ident]) -> TokenStream {
    if !layout.model.serialised {
        return TokenStream::new();
    }
    let krate = layout.krate();
    let texts = fields.iter().map(names::plain);
    quote!(#krate::serialised! { #name { #(#fields: #texts),* } })
}
