//! Stage `emit`: `Default` for all structs (declared values, else zero or the identity), and `PartialEq` where it can't
//! be derived.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Context;
use crate::emit::layout::{Entry, Field, FieldKind, Layout, StructKind, leaf};
use crate::emit::print::literals;
use crate::model::types::{InstanceId, PartTypeId};

use super::structs::compares_by_hand;

/// Expands to the impls for the model's structs.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let groups = StructKind::ALL.into_iter();
    let groups = groups.filter(|group| group.always() || !layout.is_empty(*group, None));
    groups.map(|group| implement(layout, group, None)).collect()
}

/// Expands to `impl<T: Real> Default for Params<T> { .. }`, and `PartialEq` if need be.
pub(super) fn implement(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> TokenStream {
    let name = group.name();
    let fields = layout.fields(group, owner);
    // All instances of a part share its type; its default is that of the first one.
    let value = match layout.instances(owner).first() {
        Some(first) if !fields.is_empty() => {
            let fields = fields.iter().map(|field| {
                let value = field_default(layout, group, *first, field, owner.is_some());
                leaf::initialiser(&field.name, &value)
            });
            quote!(Self { #(#fields),* })
        }
        _ => quote!(Self { scalar: ::core::marker::PhantomData }),
    };
    let comparison = compares_by_hand(layout, group).then(|| {
        let names = fields.iter().map(|field| &field.name);
        quote! {
            impl<T: Real> PartialEq for #name<T> {
                fn eq(&self, other: &Self) -> bool {
                    #(self.#names == other.#names)&&*
                }
            }
        }
    });
    quote! {
        impl<T: Real> Default for #name<T> {
            fn default() -> Self { #value }
        }
        #comparison
    }
}

fn field_default(
    layout: &Layout<'_>,
    group: StructKind,
    instance: InstanceId,
    field: &Field,
    in_part: bool,
) -> TokenStream {
    let (part, count) = match &field.kind {
        FieldKind::Leaf(kind) => {
            return match layout.find(group, instance, &field.name) {
                Some(entry) => entry_default(layout, entry),
                None => kind.default(layout.krate()),
            };
        }
        FieldKind::Part(part, count) => (*part, *count),
    };
    let spelled_out =
        |instance: InstanceId| layout.construct(group, instance, in_part, &mut |entry| entry_default(layout, entry));
    let path = layout.path(group, Some(part), in_part);
    let of_the_type = layout.instances(Some(part)).first().map(|first| spelled_out(*first).to_string());
    let mut all_alike = true;
    let parts: Vec<TokenStream> = layout
        .children(instance, &field.name)
        .into_iter()
        .map(|child| {
            let value = spelled_out(child);
            if Some(value.to_string()) == of_the_type {
                quote!(#path::default())
            } else {
                all_alike = false;
                value
            }
        })
        .collect();
    // Without values of its own an array is one default, repeated.
    let values = if all_alike { &[] } else { &parts[..] };
    layout.part_value(group, (part, count), in_part, values)
}

/// Expands to the declared value, else to zero or the identity.
fn entry_default(layout: &Layout<'_>, entry: &Entry) -> TokenStream {
    match &entry.default {
        Some(values) => {
            let mut values = values.iter().map(|value| literals::scalar(*value));
            entry.leaf.build(layout.krate(), &mut values)
        }
        None => entry.leaf.default(layout.krate()),
    }
}
