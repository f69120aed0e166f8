//! Stage `emit`: the methods of `Model`, one per derived function.
//!
//! In: a program with its kind. Out: a documented method whose signature is as small as the function's meaning allows.

use std::borrow::Cow;
use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::contracts::function::{Asked, FunctionKind};
use crate::emit::layout::places::{RESERVED, Root};
use crate::emit::print::blocks::{body, each_leaf_of};
use crate::emit::print::expressions::Names;
use crate::emit::print::parts;
use crate::emit::{Context, document, names};
use crate::model::site::Site;
use crate::model::types::Model;
use crate::optimize::program::{Expression, Function, Program};

use super::{in_parts, results};
use crate::contracts::function::Arguments;

/// Name of the method.
pub fn name(model: &Model, kind: FunctionKind) -> Cow<'static, str> {
    kind.method(model)
}

/// Name of the method, at the word in `emit` that asks for it.
fn ident(context: &Context<'_>, kind: FunctionKind) -> Ident {
    let model = context.layout.model;
    let asked = match (kind, kind.row().asked) {
        (FunctionKind::Kinematics(number), _) => model.kinematics.get(number).map(|kinematics| kinematics.span),
        (FunctionKind::OutputGroup(number), _) => model.output_groups.get(number).map(|group| group.name.span()),
        (_, Asked::By { request, .. }) => model.asked_at(request).map(Site::span),
        _ => None,
    };
    match asked {
        Some(span) => names::at(span, &name(model, kind)),
        None => names::ident(&name(model, kind)),
    }
}

/// The variables that a program reads.
pub(in crate::emit) fn roots(program: &Program) -> BTreeSet<Root> {
    let mut roots = BTreeSet::new();
    each_leaf_of(program, &mut |leaf| {
        if let Expression::Symbol(symbol) = leaf {
            roots.extend(Root::of(*symbol));
        }
    });
    roots
}

/// What the method of a function takes.
pub(in crate::emit) fn arguments(function: &Function) -> Arguments {
    Arguments::of(function.kind, &roots(&function.program))
}

/// Expands to a method of `Model`.
pub(in crate::emit) fn method(context: &Context<'_>, function: &Function) -> TokenStream {
    let layout = &context.layout;
    let kind = function.kind;
    let read = roots(&function.program);
    let arguments = Arguments::of(kind, &read);
    let opened = arguments.open(&read);
    let mut named = read;
    if !context.hollow {
        // What is not computed is handed on.
        named.extend((kind == FunctionKind::InverseDynamics && layout.solves_inputs()).then_some(Root::Input));
        named.extend((kind == FunctionKind::Guess).then_some(Root::Guess));
    }
    let declared = arguments.declare(layout, &named);
    let name = ident(context, kind);
    let result = results::ty(layout, kind);
    let docs = document::attributes(&document::function(layout, function));
    let mut parts = TokenStream::new();
    let block = if context.hollow {
        quote!(::core::unimplemented!())
    } else if parts::operations(&function.program) > context.most {
        let block;
        (block, parts) = in_parts::method(context, function, &named);
        block
    } else {
        let locals = names::unique(function.program.locals.iter().map(String::as_str), RESERVED);
        let body = body(
            &function.program,
            &Names {
                layout,
                locals: &locals,
                fields: &context.fields,
                stored: None,
                commented: context.commented,
                packed: None,
            },
        );
        let statements = body.statements;
        let value = results::value(layout, kind, body.results);
        quote!(#opened #statements #value)
    };
    quote! {
        #docs
        #[must_use]
        pub fn #name(&self, #declared) -> #result { #block }

        #parts
    }
}
