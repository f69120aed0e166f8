//! Stage `emit`: `Velocity`, `Position` and `Guess` from vectors and back. A position with quaternions comes from a vector only
//! by a constructor that normalises.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::emit::layout::places::RESERVED;
use crate::emit::layout::{Layout, StructKind};
use crate::emit::methods::results;
use crate::emit::{Context, names};
use crate::model::types::{InstanceId, Place};

/// Expands to the conversions; a model without coordinates has none.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let mut tokens = TokenStream::new();
    for group in [StructKind::Velocity, StructKind::Position, StructKind::Guess] {
        if layout.is_empty(group, None) {
            continue;
        }
        tokens.extend(to_vector(layout, group));
        let mut entries = layout.table(group).entries.iter();
        if entries.any(|entry| entry.leaf.has_quaternion()) {
            tokens.extend(normalised(layout));
        } else {
            tokens.extend(from_vector(layout, group));
        }
    }
    tokens
}

/// Expands to `impl<T: Real> From<Velocity<T>> for SVector<T, 2> { .. }`.
fn to_vector(layout: &Layout<'_>, group: StructKind) -> TokenStream {
    let (krate, name) = (layout.krate(), group.name());
    let size = Literal::usize_unsuffixed(layout.table(group).size);
    let from = names::ident(match group {
        StructKind::Velocity => "velocity",
        StructKind::Guess => "guess",
        _ => "position",
    });
    let scalars = layout.table(group).entries.iter().flat_map(|entry| {
        let path = layout.leaf_path(entry);
        let from = from.clone();
        (0..entry.leaf.size()).map(move |component| {
            let access = entry.leaf.access(component);
            quote!(#from #path #access)
        })
    });
    quote! {
        impl<T: Real> From<#name<T>> for #krate::nalgebra::SVector<T, #size> {
            fn from(#from: #name<T>) -> Self {
                Self::from([#(#scalars),*])
            }
        }
    }
}

/// Expands to `impl<T: Real> From<SVector<T, 2>> for Velocity<T> { .. }`.
fn from_vector(layout: &Layout<'_>, group: StructKind) -> TokenStream {
    let (krate, name) = (layout.krate(), group.name());
    let size = Literal::usize_unsuffixed(layout.table(group).size);
    let scalars = scalars(layout, group);
    let list: Vec<TokenStream> = scalars.iter().map(|scalar| quote!(#scalar)).collect();
    let value = results::filled(layout, group, &list);
    quote! {
        impl<T: Real> From<#krate::nalgebra::SVector<T, #size>> for #name<T> {
            fn from(vector: #krate::nalgebra::SVector<T, #size>) -> Self {
                let [[#(#scalars),*]] = vector.data.0;
                #value
            }
        }
    }
}

/// Expands to `pub fn normalized(vector: SVector<T, 7>) -> Self`.
fn normalised(layout: &Layout<'_>) -> TokenStream {
    let krate = layout.krate();
    let size = Literal::usize_unsuffixed(layout.table(StructKind::Position).size);
    let scalars = scalars(layout, StructKind::Position);
    let list: Vec<TokenStream> = scalars.iter().map(|scalar| quote!(#scalar)).collect();
    let value = layout.construct(StructKind::Position, InstanceId(0), false, &mut |entry| {
        let own = list.iter().skip(entry.offset).take(entry.leaf.size());
        entry.leaf.build_normalised(krate, &mut own.cloned())
    });
    quote! {
        impl<T: Real> Position<T> {
            /// From a vector of all coordinates in order, quaternions as w, x, y, z; they are normalised.
            #[must_use]
            pub fn normalized(vector: #krate::nalgebra::SVector<T, #size>) -> Self {
                let [[#(#scalars),*]] = vector.data.0;
                #value
            }
        }
    }
}

/// A variable for every scalar of a group: `shoulder`, `legs_2_gimbal_first`.
fn scalars(layout: &Layout<'_>, group: StructKind) -> Vec<Ident> {
    let texts: Vec<String> = layout
        .table(group)
        .entries
        .iter()
        .flat_map(|entry| {
            let place = Place { instance: entry.instance, field: entry.field.clone() };
            let name = layout.name(&place);
            (0..entry.leaf.size()).map(move |component| {
                let access = entry.leaf.access(component).to_string();
                let text = format!("{name} {access}");
                let text = text.replace(|c: char| c != '_' && !c.is_alphanumeric(), " ");
                text.split_whitespace().collect::<Vec<_>>().join("_")
            })
        })
        .collect();
    let mut reserved = RESERVED.to_vec();
    reserved.push("vector");
    names::unique(texts.iter().map(String::as_str), &reserved)
}
