//! Stage `emit`: what integrators see of the structs: `Tangent`, `Configuration`, `StateSpace`.
//!
//! Everything goes field by field through the runtime's traits, so that no kind of joint is a special case here.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Context;
use crate::emit::layout::{Layout, StructKind};
use crate::model::types::PartTypeId;

/// Expands to the impls for the model's structs.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let mut tokens = tangent(layout, StructKind::Velocity, None);
    if layout.structure.has_speeds() {
        tokens.extend(tangent(layout, StructKind::Rates, None));
    }
    tokens.extend(configuration(layout, None));
    let (extra, split, join) = if layout.is_empty(StructKind::States, None) {
        (quote!(()), quote!(()), quote!((): ()))
    } else {
        tokens.extend(tangent(layout, StructKind::States, None));
        (quote!(States<T>), quote!(self.x), quote!(x: States<T>))
    };
    let x = layout.has_states().then(|| quote!(x,));
    let guess = (!layout.is_empty(StructKind::Guess, None)).then(|| quote!(guess: self.guess,));
    tokens.extend(quote! {
        impl<T: Real> #krate::StateSpace for State<T> {
            type Scalar = T;
            type Position = Position<T>;
            type Velocity = Velocity<T>;
            type Extra = #extra;

            fn split(&self) -> (Position<T>, Velocity<T>, #extra) {
                (self.q, self.v, #split)
            }

            fn join(&self, q: Position<T>, v: Velocity<T>, #join) -> Self {
                Self { q, v, #x #guess }
            }
        }
    });
    tokens
}

/// Expands to `impl<T: Real> Tangent<T> for Velocity<T> { .. }`.
pub(super) fn tangent(layout: &Layout<'_>, group: StructKind, owner: Option<PartTypeId>) -> TokenStream {
    let krate = layout.krate();
    let name = group.name();
    let fields = layout.fields(group, owner);
    let names: Vec<_> = fields.iter().map(|field| &field.name).collect();
    let Some((last, others)) = names.split_last() else {
        return quote! {
            impl<T: Real> #krate::Tangent<T> for #name<T> {
                fn zero() -> Self {
                    Self { scalar: ::core::marker::PhantomData }
                }
                fn zip<F: FnMut(T, T) -> T>(&self, _other: &Self, _f: &mut F) -> Self {
                    *self
                }
                fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, _f: &mut F) -> A {
                    start
                }
            }
        };
    };
    // Assignments, since every `let` opens a scope and there may be a thousand fields.
    let steps = match others {
        [] => TokenStream::new(),
        [one] => quote!(let start = #krate::Tangent::fold(&self.#one, start, f);),
        _ => quote! {
            let mut start = start;
            #(start = #krate::Tangent::fold(&self.#others, start, f);)*
        },
    };
    quote! {
        impl<T: Real> #krate::Tangent<T> for #name<T> {
            fn zero() -> Self {
                Self { #(#names: #krate::Tangent::zero()),* }
            }
            fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
                Self { #(#names: #krate::Tangent::zip(&self.#names, &other.#names, f)),* }
            }
            fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
                #steps
                #krate::Tangent::fold(&self.#last, start, f)
            }
        }
    }
}

/// Expands to `impl<T: Real> Configuration<T> for Position<T> { .. }`.
pub(super) fn configuration(layout: &Layout<'_>, owner: Option<PartTypeId>) -> TokenStream {
    let krate = layout.krate();
    let fields = layout.fields(StructKind::Position, owner);
    let moved = layout.displacement().name();
    if fields.is_empty() {
        return quote! {
            impl<T: Real> #krate::Configuration<T> for Position<T> {
                type Velocity = #moved<T>;

                fn displace(&self, _d: &#moved<T>) -> Self {
                    *self
                }
                fn advance(&self, _d: &#moved<T>, rest: &#moved<T>) -> (Self, #moved<T>) {
                    (*self, *rest)
                }
                fn dexp_inv(_d: &#moved<T>, v: &#moved<T>) -> #moved<T> {
                    *v
                }
                fn magnitude(&self) -> #moved<T> {
                    #moved { scalar: ::core::marker::PhantomData }
                }
            }
        };
    }
    let names: Vec<_> = fields.iter().map(|field| &field.name).collect();
    let types = fields.iter().map(|field| layout.field_type(StructKind::Position, &field.kind, owner.is_some()));
    let types: Vec<_> = types.collect();
    let mut entries = layout.table(StructKind::Position).entries.iter();
    let rotations = if entries.any(|entry| entry.leaf.has_quaternion()) {
        quote! {
            fn dexp_inv(d: &#moved<T>, v: &#moved<T>) -> #moved<T> {
                #moved {
                    #(#names: <#types as #krate::Configuration<T>>::dexp_inv(&d.#names, &v.#names)),*
                }
            }
            fn compose(first: &#moved<T>, second: &#moved<T>) -> #moved<T> {
                #moved {
                    #(#names: <#types as #krate::Configuration<T>>::compose(&first.#names, &second.#names)),*
                }
            }
        }
    } else {
        quote! {
            fn dexp_inv(_d: &#moved<T>, v: &#moved<T>) -> #moved<T> {
                *v
            }
        }
    };
    quote! {
        impl<T: Real> #krate::Configuration<T> for Position<T> {
            type Velocity = #moved<T>;

            fn displace(&self, d: &#moved<T>) -> Self {
                Self { #(#names: #krate::Configuration::displace(&self.#names, &d.#names)),* }
            }
            fn advance(&self, d: &#moved<T>, rest: &#moved<T>) -> (Self, #moved<T>) {
                let (mut end, mut left) = (*self, *rest);
                #((end.#names, left.#names) = #krate::Configuration::advance(&self.#names, &d.#names, &rest.#names);)*
                (end, left)
            }
            #rotations
            fn magnitude(&self) -> #moved<T> {
                #moved { #(#names: #krate::Configuration::magnitude(&self.#names)),* }
            }
        }
    }
}
