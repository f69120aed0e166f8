//! Stage `emit`: names and units of the scalars of generated structs, for those who record them: `Columns`.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::layout::leaf::Leaf;
use crate::emit::layout::{FieldKind, Layout, StructKind, groups};
use crate::emit::{Context, names};
use crate::model::types::PartTypeId;

/// Expands to the impls for the model's structs, for `State` and for groups of outputs.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let kinds = StructKind::ALL.into_iter().filter(|group| group.always() || !layout.is_empty(*group, None));
    let mut tokens: TokenStream = kinds.map(|group| implement(layout, group, None)).collect();
    // Without the guess, which is not of the motion: where it started is its solver's affair.
    let state = ["q", "v"].into_iter().chain(layout.has_states().then_some("x"));
    let state = state.map(|name| Named { name: names::ident(name), unit: "", are_rates: false });
    tokens.extend(write(layout, &names::ident("State"), state));
    for group in &layout.model.output_groups {
        let fields = group.fields.iter().map(|field| {
            let first = field.outputs.first().and_then(|&place| layout.model.outputs[place].docs.unit.as_deref());
            Named { name: names::field(&field.name), unit: first.unwrap_or_default(), are_rates: false }
        });
        tokens.extend(write(layout, &groups::name(group), fields));
    }
    tokens
}

/// Expands to `impl<T: Real> Columns<T> for Output<T> { .. }`, of the model or of a part.
pub(super) fn implement(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> TokenStream {
    let fields = layout.fields(group, owner);
    let fields = fields.iter().map(|field| Named {
        name: field.name.clone(),
        unit: field.unit.as_deref().unwrap_or_default(),
        are_rates: matches!(group, StructKind::Velocity | StructKind::Rates)
            && matches!(&field.kind, FieldKind::Leaf(leaf) if holds_both(leaf)),
    });
    write(layout, &group.name(), fields)
}

/// Whether the type is that of a position and of a velocity: then its field says which.
fn holds_both(leaf: &Leaf) -> bool {
    matches!(leaf, Leaf::Coordinates(_)) || leaf.is_free_by_angles()
}

struct Named<'a> {
    name: Ident,
    unit: &'a str,
    are_rates: bool,
}

fn write<'a>(layout: &Layout<'_>, name: &Ident, fields: impl Iterator<Item = Named<'a>>) -> TokenStream {
    let krate = layout.krate();
    let calls: Vec<TokenStream> = fields
        .map(|Named { name, unit, are_rates }| {
            let text = names::plain(&name);
            let column = if are_rates { quote!(rates(#text)) } else { quote!(field(#text, #unit)) };
            quote!(#krate::Columns::columns(&self.#name, &place.#column, f);)
        })
        .collect();
    let [place, f] = if calls.is_empty() { [quote!(_), quote!(_)] } else { [quote!(place), quote!(f)] };
    quote! {
        impl<T: Real> #krate::Columns<T> for #name<T> {
            fn columns(&self, #place: &#krate::Column<'_>, #f: &mut dyn FnMut(&#krate::Column<'_>, T)) {
                #(#calls)*
            }
        }
    }
}
