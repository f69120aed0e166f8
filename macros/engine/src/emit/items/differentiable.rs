//! Stage `emit`: `Differentiable`, by which implicit methods and equilibria take the exact derivatives of the model, and
//! `Tangent` for its inputs.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::layout::{FieldKind, Layout, StructKind};
use crate::emit::methods::arguments::input_type;
use crate::emit::methods::results;
use crate::emit::{Context, names};
use crate::model::types::{InstanceId, PartTypeId};

use super::space;

/// Expands to `impl<T: Real> Differentiable for Model<T> { .. }` where forward dynamics and its derivatives have been
/// derived, and to `impl Tangent for Input<T> { .. }` where anything has been differentiated by inputs.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    if !moves_inputs(context) {
        return TokenStream::new();
    }
    let layout = &context.layout;
    let mut tokens = if layout.is_empty(StructKind::Input, None) {
        TokenStream::new()
    } else {
        space::tangent(layout, StructKind::Input, None)
    };
    if is_derived(context) && context.function(FunctionKind::ForwardDynamics).is_some() {
        tokens.extend(differentiable(layout));
    }
    tokens
}

/// Whether something has been differentiated by inputs.
pub(super) fn moves_inputs(context: &Context<'_>) -> bool {
    is_derived(context) || context.function(FunctionKind::Linearization).is_some()
}

/// Whether there are derivatives.
fn is_derived(context: &Context<'_>) -> bool {
    context.function(FunctionKind::ForwardDerivatives).is_some()
}

fn differentiable(layout: &Layout<'_>) -> TokenStream {
    let krate = layout.krate();
    let input = input_type(layout);
    if layout.structure.has_speeds() {
        return full(layout);
    }
    let places = places(layout);
    let size = Literal::usize_unsuffixed(places.len());
    let derivatives = quote!(self.forward_derivatives(t, state, input));
    let is_plain = places.iter().enumerate().all(|(place, of)| *of == Some(place));
    let jacobian = if is_plain {
        quote!(#derivatives.jacobian())
    } else {
        let places = numbers(&places);
        quote!(#derivatives.jacobian_at(&#places))
    };
    let along = input_derivative(layout, &derivatives);
    quote! {
        impl<T: Real> #krate::Differentiable for Model<T> {
            type Matrix = [[T; #size]; #size];

            fn jacobian(&self, t: T, state: &State<T>, input: &#input) -> #krate::Jacobian<[[T; #size]; #size]> {
                #jacobian
            }
            #along
        }
    }
}

/// The same where displacements have rows and columns of their own.
fn full(layout: &Layout<'_>) -> TokenStream {
    let krate = layout.krate();
    let input = input_type(layout);
    let mut places = Vec::new();
    walk(layout, StructKind::Rates, None, InstanceId(0), &mut places);
    let moved = layout.table(StructKind::Rates).size;
    places.extend(self::places(layout).into_iter().map(|place| Some(place? + moved)));
    let size = Literal::usize_unsuffixed(places.len());
    let places = numbers(&places);
    let derivatives = quote!(self.forward_derivatives(t, state, input));
    let along = input_derivative(layout, &derivatives);
    let rates = quote!(self.rate_derivatives(t, state));
    quote! {
        impl<T: Real> #krate::Differentiable for Model<T> {
            type Matrix = #krate::FullJacobian<[[T; #size]; #size]>;

            fn jacobian(&self, t: T, state: &State<T>, input: &#input) -> #krate::FullJacobian<[[T; #size]; #size]> {
                #krate::FullJacobian::of(&#rates, &#derivatives, &#places)
            }
            #along
        }
    }
}

/// Expands to `[0, 1, usize::MAX]`, the last of which is no place.
fn numbers(places: &[Option<usize>]) -> TokenStream {
    let places = places.iter().map(|place| match place {
        Some(place) => {
            let place = Literal::usize_unsuffixed(*place);
            quote!(#place)
        }
        None => quote!(usize::MAX),
    });
    quote!([#(#places),*])
}

/// Expands to `fn input_derivative(..) -> (Velocity<T>, ()) { .. }`.
fn input_derivative(layout: &Layout<'_>, derivatives: &TokenStream) -> TokenStream {
    let krate = layout.krate();
    let input = input_type(layout);
    let has_states = layout.has_states();
    let extra = if has_states { quote!(States<T>) } else { quote!(()) };
    if layout.is_empty(StructKind::Input, None) {
        let rest = if has_states { quote!(#krate::Tangent::<T>::zero()) } else { quote!(()) };
        return quote! {
            fn input_derivative(&self, _t: T, _state: &State<T>, _input: &(), _change: &()) -> (Velocity<T>, #extra) {
                (#krate::Tangent::<T>::zero(), #rest)
            }
        };
    }
    let changes = layout.table(StructKind::Input).entries.iter().flat_map(|entry| {
        let path = layout.leaf_path(entry);
        (0..entry.leaf.size()).map(move |component| {
            let access = entry.leaf.access(component);
            quote!(change #path #access)
        })
    });
    let count = layout.dof() + layout.table(StructKind::States).size;
    let rates = names::ident(if count == 0 { "_rates" } else { "rates" });
    let list: Vec<TokenStream> = (0..count)
        .map(|at| {
            let at = Literal::usize_unsuffixed(at);
            quote!(#rates[#at])
        })
        .collect();
    let (velocities, states) = list.split_at(layout.dof());
    let velocities = results::filled(layout, StructKind::Velocity, velocities);
    let states = if has_states { results::filled(layout, StructKind::States, states) } else { quote!(()) };
    quote! {
        fn input_derivative(
            &self,
            t: T,
            state: &State<T>,
            input: &#input,
            change: &#input,
        ) -> (Velocity<T>, #extra) {
            let #rates = #derivatives.along_input(&[#(#changes),*]);
            (#velocities, #states)
        }
    }
}

/// Where integrators find the velocities and own states: the place of each component among all, or nothing for the
/// components of a part's struct that this instance of the part does not have.
fn places(layout: &Layout<'_>) -> Vec<Option<usize>> {
    let mut places = Vec::new();
    walk(layout, StructKind::Velocity, None, InstanceId(0), &mut places);
    let velocities = places.len();
    walk(layout, StructKind::States, None, InstanceId(0), &mut places);
    for place in places.iter_mut().skip(velocities).flatten() {
        *place += layout.dof();
    }
    places
}

/// In the order of the fields.
fn walk(
    layout: &Layout<'_>,
    group: StructKind,
    owner: Option<PartTypeId>,
    instance: InstanceId,
    places: &mut Vec<Option<usize>>,
) {
    for field in layout.fields(group, owner) {
        match &field.kind {
            FieldKind::Leaf(leaf) => {
                let entry = layout.find(group, instance, &field.name);
                places.extend((0..leaf.size()).map(|k| entry.map(|entry| entry.offset + k)));
            }
            FieldKind::Part(part, count) => {
                // A struct of the part that this instance has not is full of zeros.
                let mut children = layout.children(instance, &field.name).into_iter();
                for _ in 0..count.unwrap_or(1) {
                    let child = children.next().unwrap_or(InstanceId(usize::MAX));
                    walk(layout, group, Some(*part), child, places);
                }
            }
        }
    }
}
