//! Stage `emit`: values of the generated structs, built from those of their leaves.
//!
//! In: the layout, and for each leaf its value. Out: struct literals, parts and arrays of parts inside them.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::model::types::{InstanceId, PartTypeId};

use super::leaf::initialiser;
use super::{Entry, FieldKind, Layout, StructKind};

impl Layout<'_> {
    /// The leaf of `instance` in this field; parts may lack what another instance of theirs has.
    pub(in crate::emit) fn find(&self, group: StructKind, instance: InstanceId, field: &Ident) -> Option<&Entry> {
        let mut entries = self.table(group).entries.iter();
        entries.find(|entry| entry.instance == instance && entry.field == *field)
    }

    /// Children of `instance` in this field, in the order of the array.
    pub(in crate::emit) fn children(&self, instance: InstanceId, field: &Ident) -> Vec<InstanceId> {
        let all = self.model.instances.iter().enumerate();
        let mut children: Vec<(usize, InstanceId)> = all
            .filter(|(_, child)| child.parent == Some(instance) && child.field == *field)
            .map(|(index, child)| (child.index.map_or(0, |(i, _)| i), InstanceId(index)))
            .collect();
        children.sort_unstable();
        children.into_iter().map(|(_, id)| id).collect()
    }

    /// Expands to the struct of `instance`, such as `Position { a: .., legs: [leg::Position { .. }, ..] }`; `leaf`
    /// gives the values. `in_part` says from where types are seen.
    pub(in crate::emit) fn construct(
        &self,
        group: StructKind,
        instance: InstanceId,
        in_part: bool,
        leaf: &mut dyn FnMut(&Entry) -> TokenStream,
    ) -> TokenStream {
        let owner = self.model.instances.get(instance.0).and_then(|i| i.part_type);
        let path = self.path(group, owner, in_part);
        let fields = self.fields(group, owner);
        if fields.is_empty() {
            return quote!(#path { scalar: ::core::marker::PhantomData });
        }
        let fields = fields.iter().map(|field| {
            let value = match &field.kind {
                FieldKind::Leaf(kind) => match self.find(group, instance, &field.name) {
                    Some(entry) => leaf(entry),
                    None => kind.default(self.krate()),
                },
                FieldKind::Part(part, count) => {
                    let mut parts = Vec::new();
                    for child in self.children(instance, &field.name) {
                        parts.push(self.construct(group, child, in_part, leaf));
                    }
                    self.part_value(group, (*part, *count), in_part, &parts)
                }
            };
            initialiser(&field.name, &value)
        });
        quote!(#path { #(#fields),* })
    }

    /// Expands to `[a, b]` for an array of parts, to `a` for a single one; to defaults if this instance has none there.
    pub(in crate::emit) fn part_value(
        &self,
        group: StructKind,
        (part, count): (PartTypeId, Option<usize>),
        in_part: bool,
        parts: &[TokenStream],
    ) -> TokenStream {
        let complete = parts.len() == count.unwrap_or(1);
        let path = self.path(group, Some(part), in_part);
        match count {
            _ if complete && count.is_some() => quote!([#(#parts),*]),
            _ if complete => quote!(#(#parts)*),
            Some(count) => {
                let count = Literal::usize_unsuffixed(count);
                quote!([#path::default(); #count])
            }
            None => quote!(#path::default()),
        }
    }
}
