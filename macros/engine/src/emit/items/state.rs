//! Stage `emit`: `State`, and what functions give that is more than one of the other structs: `Derivative`, `Closed`,
//! `Solved`, `Jump`.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::layout::StructKind;
use crate::emit::methods::results;
use crate::emit::{Context, document, names};

use super::serialised;
use super::structs::compares_by_hand;

/// Expands to `pub struct State<T = f64> { pub q: Position<T>, pub v: Velocity<T> }` and its impls, and to the others.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let mut tokens = state(context);
    tokens.extend(derivative(context));
    tokens.extend(closed(context));
    tokens.extend(solved(context));
    tokens.extend(jump(context));
    tokens
}

/// A field with its type, its text and its default.
struct Field {
    name: Ident,
    ty: TokenStream,
    docs: String,
    start: TokenStream,
}

impl Field {
    /// Of another generated struct.
    fn of(name: &str, ty: &str, docs: &str) -> Field {
        let ty = names::ident(ty);
        Field { name: names::ident(name), ty: quote!(#ty<T>), docs: docs.to_string(), start: quote!(#ty::default()) }
    }

    fn scalar(name: &str, docs: &str) -> Field {
        Field { name: names::ident(name), ty: quote!(T), docs: docs.to_string(), start: quote!(T::lit(0.0)) }
    }

    fn vector(context: &Context<'_>, name: &str, size: usize, docs: &str) -> Field {
        let krate = context.layout.krate();
        Field {
            name: names::ident(name),
            ty: results::vector_type(&context.layout, size),
            docs: docs.to_string(),
            start: quote!(#krate::nalgebra::SVector::zeros()),
        }
    }
}

fn state(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let mut fields = vec![Field::of("q", "Position", "positions"), Field::of("v", "Velocity", "velocities")];
    if layout.has_states() {
        fields.push(Field::of("x", "States", "the model's own states"));
    }
    let mut docs = "All that changes in time. Its default is every joint at zero, at rest.".to_owned();
    if !layout.is_empty(StructKind::Guess, None) {
        let text = "where Newton's method starts to close loops; not integrated, renewed by every accepted step";
        fields.push(Field::of("guess", "Guess", text));
        docs += " Its guess is then one that closes the loops, if the macro found any with these joints at zero and \
                 parameters at their defaults, and else one near by.";
    }
    declare(context, "State", &docs, &fields, compares_by_hand(layout, StructKind::Position))
}

fn derivative(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let mut fields = vec![Field::of("v", "Velocity", "accelerations")];
    let mut also = Vec::new();
    if layout.structure.has_speeds() {
        also.push("the rates of positions");
        fields.push(Field::of("q", "Rates", "rates of positions"));
    }
    if layout.has_states() {
        also.push("the rates of the model's own states");
        fields.push(Field::of("x", "States", "rates of the model's own states"));
    }
    if layout.rows() > 0 {
        also.push("the multipliers of the constraint equations");
        let text = "of the constraint equations: `M * accel + bias + G^T * multipliers` are the efforts";
        fields.push(Field::vector(context, "multipliers", layout.rows(), text));
        fields.push(Field::scalar("rank", "rank of the equations for the multipliers"));
    }
    if layout.structure.guesses() > 0 {
        also.push("how well the loops are closed");
        fields.push(Field::scalar("residual", "the greatest residual of the loops that Newton's method closes"));
    }
    let docs = match also.split_last() {
        Some((last, [])) => format!("What forward dynamics gives: accelerations, and {last}."),
        Some((last, others)) => {
            format!("What forward dynamics gives: accelerations, {}, and {last}.", others.join(", "))
        }
        None => return None,
    };
    Some(declare(context, "Derivative", &docs, &fields, false))
}

/// What `close` gives.
fn closed(context: &Context<'_>) -> Option<TokenStream> {
    context.function(FunctionKind::Guess)?;
    let fields = [
        Field::of("state", "State", "the state whose guess is the solution"),
        Field::scalar("residual", "the greatest residual that is left"),
    ];
    let by_hand = compares_by_hand(&context.layout, StructKind::Position);
    Some(declare(context, "Closed", "A state with its loops closed by Newton's method.", &fields, by_hand))
}

/// What inverse dynamics gives where inputs are looked for.
fn solved(context: &Context<'_>) -> Option<TokenStream> {
    context.function(FunctionKind::InverseDynamics).filter(|_| context.layout.solves_inputs())?;
    let fields = [
        Field::of("input", "Input", "the given inputs, with those that were looked for in their places"),
        Field::scalar("rank", "rank of their equations"),
    ];
    let by_hand = compares_by_hand(&context.layout, StructKind::Input);
    Some(declare(
        context,
        "Solved",
        "What inverse dynamics gives: the inputs that produce the motion.",
        &fields,
        by_hand,
    ))
}

/// What an impulse does where equations keep multipliers.
fn jump(context: &Context<'_>) -> Option<TokenStream> {
    let rows = context.layout.rows();
    context.function(FunctionKind::Impulse).filter(|_| rows > 0)?;
    let text = "impulses of the constraint equations: `M * v + G^T * multipliers` is the impulse";
    let fields = [
        Field::of("v", "Velocity", "the jump of the velocities"),
        Field::vector(context, "multipliers", rows, text),
        Field::scalar("rank", "rank of the equations for the multipliers"),
    ];
    Some(declare(
        context,
        "Jump",
        "What an impulse does: the jump of the velocities, and what holds the loops.",
        &fields,
        false,
    ))
}

/// Expands to a struct with its `Default`, if need be `PartialEq`, and what serde needs.
fn declare(context: &Context<'_>, name: &str, docs: &str, fields: &[Field], by_hand: bool) -> TokenStream {
    let docs = document::attributes(&[docs.to_string()]);
    let name = names::ident(name);
    let list = fields.iter().map(|Field { name, ty, docs, .. }| {
        let docs = document::attributes(std::slice::from_ref(docs));
        quote!(#docs pub #name: #ty,)
    });
    let starts = fields.iter().map(|Field { name, start, .. }| quote!(#name: #start));
    let serialised = {
        let names: Vec<Ident> = fields.iter().map(|field| field.name.clone()).collect();
        serialised::of(&context.layout, &name, &names)
    };
    let derived = (!by_hand).then(|| quote!(, PartialEq));
    let comparison = by_hand.then(|| {
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
        #docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug #derived)]
        pub struct #name<T = f64> {
            #(#list)*
        }

        impl<T: Real> Default for #name<T> {
            fn default() -> Self {
                Self { #(#starts),* }
            }
        }
        #comparison
        #serialised
    }
}
