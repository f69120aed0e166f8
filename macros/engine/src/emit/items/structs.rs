//! Stage `emit`: the structs whose fields are the model's: `Params`, `Position`, `Velocity`, `States`, `Input`,
//! `Output`, of the model and of its parts.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::layout::{Layout, StructKind, groups};
use crate::emit::{Context, document};
use crate::model::types::PartTypeId;

/// Expands to the model's structs, and to `pub type Input = ();` where nothing acts from outside.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let mut tokens = TokenStream::new();
    for group in StructKind::ALL {
        if group.always() || !layout.is_empty(group, None) {
            tokens.extend(declare(layout, group, None));
        } else if group == StructKind::Input {
            tokens.extend(quote! {
                /// The model has no inputs.
                pub type Input = ();
            });
        }
    }
    tokens.extend(layout.model.output_groups.iter().map(|group| groups::declare(layout, group)));
    tokens
}

/// Expands to `pub struct Position<T = f64> { pub shoulder: T, pub elbow: T }`.
pub(super) fn declare(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> TokenStream {
    let name = group.name();
    let docs = document::attributes(&document::group(layout, group, owner));
    let fields = layout.fields(group, owner);
    let fields = if fields.is_empty() {
        quote!(scalar: ::core::marker::PhantomData<T>)
    } else {
        let fields = fields.iter().map(|field| {
            let docs = document::attributes(&field.docs);
            let ty = layout.field_type(group, &field.kind, owner.is_some());
            let name = &field.name;
            quote!(#docs pub #name: #ty)
        });
        quote!(#(#fields),*)
    };
    let comparison = (!compares_by_hand(layout, group)).then(|| quote!(, PartialEq));
    quote! {
        #docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug #comparison)]
        pub struct #name<T = f64> { #fields }
    }
}

/// Whether a derived `PartialEq` fails: rotations compare only for real scalars.
pub(super) fn compares_by_hand(layout: &Layout<'_>, group: StructKind) -> bool {
    let mut entries = layout.table(group).entries.iter();
    entries.any(|entry| entry.leaf.compares_by_hand())
}
