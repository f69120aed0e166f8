//! Stage `emit`: structs of fields and `State` from vectors and back, in the order of [`super::columns`]. A position with
//! quaternions comes from a vector only by a constructor that normalises.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::emit::layout::places::RESERVED;
use crate::emit::layout::{Layout, StructKind};
use crate::emit::methods::results;
use crate::emit::{Context, names};
use crate::model::types::{InstanceId, Place};

/// Structs of fields, with the variable that one is converted from.
const GROUPS: [(StructKind, &str); 7] = [
    (StructKind::Params, "params"),
    (StructKind::Velocity, "velocity"),
    (StructKind::Rates, "rates"),
    (StructKind::Position, "position"),
    (StructKind::States, "states"),
    (StructKind::Guess, "guess"),
    (StructKind::Input, "input"),
];

/// Expands to the conversions; structs without fields have none.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let groups = GROUPS.into_iter().filter(|(group, _)| !layout.is_empty(*group, None));
    let flat = groups.map(|(group, variable)| {
        let list = scalars(layout, group);
        Flat {
            name: group.name(),
            variable: names::ident(variable),
            components: components(layout, group, &quote!()),
            value: value(layout, group, &list),
            scalars: list,
            has_quaternion: has_quaternion(layout, group),
        }
    });
    let mut tokens: TokenStream = flat.map(|flat| flat.items(layout)).collect();
    if !layout.is_empty(StructKind::Position, None) {
        tokens.extend(state(layout).items(layout));
    }
    tokens
}

/// A struct and its scalars in order.
struct Flat {
    name: Ident,
    /// What it is converted from is called.
    variable: Ident,
    /// Paths of the scalars behind that.
    components: Vec<TokenStream>,
    /// Variables for them.
    scalars: Vec<Ident>,
    /// The struct made of those variables.
    value: TokenStream,
    has_quaternion: bool,
}

/// Positions, velocities, own states. The guess, which is not of the motion, is that of the default.
fn state(layout: &Layout<'_>) -> Flat {
    let groups = [(StructKind::Position, "q"), (StructKind::Velocity, "v"), (StructKind::States, "x")];
    let (mut paths, mut variables, mut fields) = (Vec::new(), Vec::new(), Vec::new());
    for (group, field) in groups {
        let name = names::ident(field);
        if layout.is_empty(group, None) {
            if group.always() {
                let ty = group.name();
                fields.push(quote!(#name: #ty::default()));
            }
            continue;
        }
        paths.extend(components(layout, group, &quote!(.#name)));
        let own: Vec<Ident> = scalars(layout, group).iter().map(|scalar| format_ident!("{field}_{scalar}")).collect();
        let value = value(layout, group, &own);
        fields.push(quote!(#name: #value));
        variables.extend(own);
    }
    if !layout.is_empty(StructKind::Guess, None) {
        fields.push(quote!(guess: Guess::default()));
    }
    Flat {
        name: names::ident("State"),
        variable: names::ident("state"),
        components: paths,
        scalars: variables,
        value: quote!(State { #(#fields),* }),
        has_quaternion: has_quaternion(layout, StructKind::Position),
    }
}

impl Flat {
    fn items(&self, layout: &Layout<'_>) -> TokenStream {
        let mut tokens = self.to_vector(layout);
        tokens.extend(if self.has_quaternion { self.normalised(layout) } else { self.of_vector(layout) });
        tokens
    }

    /// Expands to `impl<T: Real> From<Velocity<T>> for SVector<T, 2> { .. }`.
    fn to_vector(&self, layout: &Layout<'_>) -> TokenStream {
        let Flat { name, variable, components, .. } = self;
        let vector = results::vector_type(layout, components.len());
        quote! {
            impl<T: Real> From<#name<T>> for #vector {
                fn from(#variable: #name<T>) -> Self {
                    Self::from([#(#variable #components),*])
                }
            }
        }
    }

    /// Expands to `impl<T: Real> From<SVector<T, 2>> for Velocity<T> { .. }`.
    fn of_vector(&self, layout: &Layout<'_>) -> TokenStream {
        let Flat { name, scalars, value, .. } = self;
        let vector = results::vector_type(layout, scalars.len());
        quote! {
            impl<T: Real> From<#vector> for #name<T> {
                fn from(vector: #vector) -> Self {
                    let [[#(#scalars),*]] = vector.data.0;
                    #value
                }
            }
        }
    }

    /// Expands to `pub fn normalized(vector: SVector<T, 7>) -> Self`.
    fn normalised(&self, layout: &Layout<'_>) -> TokenStream {
        let Flat { name, scalars, value, .. } = self;
        let vector = results::vector_type(layout, scalars.len());
        quote! {
            impl<T: Real> #name<T> {
                /// From a vector of all coordinates in order, quaternions as w, x, y, z; they are normalised.
                #[must_use]
                pub fn normalized(vector: #vector) -> Self {
                    let [[#(#scalars),*]] = vector.data.0;
                    #value
                }
            }
        }
    }
}

fn has_quaternion(layout: &Layout<'_>, group: StructKind) -> bool {
    layout.table(group).entries.iter().any(|entry| entry.leaf.has_quaternion())
}

/// Expands to the paths of a group's scalars behind a struct that stands at `place`: `.q.legs[2].gimbal.first`.
fn components(layout: &Layout<'_>, group: StructKind, place: &TokenStream) -> Vec<TokenStream> {
    let entries = layout.table(group).entries.iter();
    let scalars = entries.flat_map(|entry| {
        let path = layout.leaf_path(entry);
        (0..entry.leaf.size()).map(move |component| {
            let access = entry.leaf.access(component);
            quote!(#place #path #access)
        })
    });
    scalars.collect()
}

/// Expands to the group's struct of these variables; quaternions among them are normalised.
fn value(layout: &Layout<'_>, group: StructKind, scalars: &[Ident]) -> TokenStream {
    layout.construct(group, InstanceId(0), false, &mut |entry| {
        let own = scalars.iter().skip(entry.offset).take(entry.leaf.size());
        entry.leaf.build_normalised(layout.krate(), &mut own.map(|scalar| quote!(#scalar)))
    })
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
