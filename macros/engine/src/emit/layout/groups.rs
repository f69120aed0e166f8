//! Stage `emit`: structs of groups of outputs, which are flat: a field for each output, with an array where it stands in an array
//! of parts.
//!
//! In: the layout, the number of a group. Out: its struct, how many scalars it has, its value from these.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::{document, names};
use crate::model::types::{GroupField, OutputGroup};

use super::Layout;
use super::leaf::{Leaf, initialiser};

/// Name of the struct: `OutputPose` of the group `pose`.
pub(in crate::emit) fn name(group: &OutputGroup) -> Ident {
    names::ident(&group.struct_name())
}

/// Number of scalars.
pub(in crate::emit) fn size(layout: &Layout<'_>, group: &OutputGroup) -> usize {
    group.fields.iter().map(|field| leaf(layout, field).size()).sum()
}

/// Expands to `pub struct OutputPose<T = f64> { pub tip: Vector3<T>, .. }`.
pub(in crate::emit) fn declare(layout: &Layout<'_>, group: &OutputGroup) -> TokenStream {
    let model = layout.model;
    let title = format!("Outputs of the group `{}` of `{}`.", names::plain(&group.name), names::plain(&model.name));
    let docs = document::attributes(&[title]);
    let leaves: Vec<Leaf> = group.fields.iter().map(|field| leaf(layout, field)).collect();
    let comparison = (!leaves.iter().any(Leaf::compares_by_hand)).then(|| quote!(, PartialEq));
    let fields = group.fields.iter().zip(&leaves).map(|(field, leaf)| {
        let docs = field.outputs.first().map(|&place| document::item(&model.outputs[place].docs, "output"));
        let docs = document::attributes(&docs.unwrap_or_default());
        let (name, ty) = (names::field(&field.name), leaf.ty(layout.krate()));
        quote!(#docs pub #name: #ty)
    });
    let name = name(group);
    let fields = match group.fields.is_empty() {
        // Beside an error.
        true => quote!(scalar: ::core::marker::PhantomData<T>),
        false => quote!(#(#fields),*),
    };
    quote! {
        #docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug #comparison)]
        pub struct #name<T = f64> { #fields }
    }
}

/// Expands to `OutputPose { tip: .., heading: .. }`.
pub(in crate::emit) fn value(layout: &Layout<'_>, group: &OutputGroup, scalars: &[TokenStream]) -> TokenStream {
    let mut scalars = scalars.iter().cloned();
    let fields = group.fields.iter().map(|field| {
        let value = leaf(layout, field).build(layout.krate(), &mut scalars);
        initialiser(&names::field(&field.name), &value)
    });
    let fields: Vec<TokenStream> = fields.collect();
    let name = name(group);
    quote!(#name { #(#fields),* })
}

fn leaf(layout: &Layout<'_>, field: &GroupField) -> Leaf {
    let first = field.outputs.first().map(|&place| Leaf::value(&layout.model.outputs[place].value.ty, layout.dof()));
    let element = first.unwrap_or(Leaf::Scalar);
    field.counts.iter().rev().fold(element, |inner, &count| Leaf::Array(Box::new(inner), count))
}
