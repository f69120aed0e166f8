//! Stage `emit`: `Model::at` and `At`, what is known at a position.
//!
//! In: the programs of what a position decides and of what is left of each function. Out: a struct that holds the model and
//! the values that are read later, and a method of it for each function. What depends on the time, own states or the guess of
//! Newton's method is known with the position, so these go to `Model::at`, where anything reads them.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::contracts::function::{Arguments, FunctionKind};
use crate::emit::layout::StructKind;
use crate::emit::layout::leaf::initialiser;
use crate::emit::layout::places::{RESERVED, Root};
use crate::emit::methods::{functions, results};
use crate::emit::print::blocks::body;
use crate::emit::print::expressions::Names;
use crate::emit::{Context, document, names};
use crate::model::site::Site;
use crate::model::types::Request;
use crate::optimize::program::{At, Function};

/// What `Model::at` takes, in this order.
const GIVEN: [Root; 4] = [Root::Time, Root::Position, Root::States, Root::Guess];

/// Expands to `pub struct At<'m, T = f64> { .. }`, `impl At { .. }` and `impl Model { pub fn at(..) }` where they are asked for.
pub(super) fn items(context: &Context<'_>) -> Option<TokenStream> {
    let at = context.compiled.at.as_ref()?;
    let layout = &context.layout;
    let stored = names::unique(at.fields.iter().map(String::as_str), &["model", "self"]);
    let docs = document::attributes(&document::at(layout, at));
    let fields = stored.iter().map(|field| quote!(#field: T));
    let new = new(context, at, &stored);
    let methods = at.functions.iter().map(|function| method(context, &stored, function));
    Some(quote! {
        #docs
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct At<'m, T = f64> {
            model: &'m Model<T>,
            #(#fields),*
        }

        impl<T: Real> Model<T> {
            #new
        }

        impl<'m, T: Real> At<'m, T> {
            /// The model.
            #[must_use]
            pub fn model(&self) -> &'m Model<T> {
                self.model
            }

            #(#methods)*
        }
    })
}

/// Expands to `pub fn at(&self, q: &Position<T>) -> At<'_, T> { .. }`.
fn new(context: &Context<'_>, at: &At, stored: &[Ident]) -> TokenStream {
    let layout = &context.layout;
    let docs = document::attributes(&document::new_at(layout, at));
    let read = functions::roots(&at.program);
    let given = GIVEN.iter().filter(|root| **root == Root::Position || read.contains(root));
    let given = given.map(|root| {
        let name = names::ident(&format!("{}{}", if read.contains(root) { "" } else { "_" }, root.name()));
        let group = match root {
            Root::States => StructKind::States,
            Root::Guess => StructKind::Guess,
            Root::Time => return quote!(#name: T),
            _ => StructKind::Position,
        };
        let ty = group.name();
        quote!(#name: &#ty<T>)
    });
    let locals = names::unique(at.program.locals.iter().map(String::as_str), RESERVED);
    let block = if context.hollow {
        quote!(::core::unimplemented!())
    } else {
        let commented = context.commented;
        let names = Names { layout, locals: &locals, fields: &context.fields, stored: None, commented, packed: None };
        let body = body(&at.program, &names);
        let statements = body.statements;
        let fields = stored.iter().zip(&body.results).map(|(field, value)| initialiser(field, value));
        quote!(#statements At { model: self, #(#fields),* })
    };
    let word = layout.model.asked_at(Request::At).map(Site::span);
    let name = word.map_or_else(|| names::ident("at"), |span| names::at(span, "at"));
    quote! {
        #docs
        #[must_use]
        pub fn #name(&self, #(#given),*) -> At<'_, T> { #block }
    }
}

/// Expands to `pub fn bias(&self, v: &Velocity<T>, input: &Input<T>) -> SVector<T, 2> { .. }`.
fn method(context: &Context<'_>, stored: &[Ident], function: &Function) -> TokenStream {
    let layout = &context.layout;
    let kind = function.kind;
    let mut read: BTreeSet<Root> = functions::roots(&function.program);
    let arguments = Arguments::of(kind, &read);
    if !context.hollow && kind == FunctionKind::InverseDynamics && layout.solves_inputs() {
        // What is not computed is handed on.
        read.insert(Root::Input);
    }
    let declared = arguments.declare_at(layout, &read);
    let text = functions::name(layout.model, kind);
    let word = layout.model.at.iter().find(|wanted| wanted.name == text);
    let name = word.map_or_else(|| names::ident(&text), |wanted| names::at(wanted.span, &text));
    let result = results::ty(layout, kind);
    let docs = document::attributes(&document::of_at(layout, function));
    let block = if context.hollow {
        quote!(::core::unimplemented!())
    } else {
        let locals = names::unique(function.program.locals.iter().map(String::as_str), RESERVED);
        let (fields, commented) = (&context.fields, context.commented);
        let names = Names { layout, locals: &locals, fields, stored: Some(stored), commented, packed: None };
        let body = body(&function.program, &names);
        let statements = body.statements;
        let value = results::value(layout, kind, body.results);
        quote!(#statements #value)
    };
    quote! {
        #docs
        #[must_use]
        pub fn #name(&self, #declared) -> #result { #block }
    }
}
