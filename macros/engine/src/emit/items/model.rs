//! Stage `emit`: `Model` and its methods.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::layout::StructKind;
use crate::emit::layout::leaf::initialiser;
use crate::emit::layout::places::RESERVED;
use crate::emit::methods::functions;
use crate::emit::print::blocks::{body, each_leaf_of};
use crate::emit::print::expressions::Names;
use crate::emit::{Context, document, names};
use crate::optimize::program::Expression;

/// Expands to `pub struct Model<T = f64> { .. }`, its fields with their formulas, `impl<T: Real> Model<T> { .. }` and `Default`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let docs = document::attributes(&document::model(context));
    let fields = if context.fields.is_empty() {
        quote!(scalar: ::core::marker::PhantomData<T>)
    } else {
        let prelude = &context.compiled.prelude;
        let locals = names::unique(prelude.locals.iter().map(String::as_str), RESERVED);
        let locals: Vec<String> = locals.iter().map(ToString::to_string).collect();
        let formulas = document::fields::lines(&context.layout, prelude, &locals);
        let fields = context.fields.iter().zip(formulas).map(|(field, formula)| {
            let docs = document::attributes(&[formula]);
            quote!(#docs #field: T)
        });
        quote!(#(#fields),*)
    };
    let new = new(context);
    let methods = context
        .compiled
        .functions
        .iter()
        .filter(|function| function.kind != FunctionKind::Outputs || !context.layout.is_empty(StructKind::Output, None))
        .map(|function| functions::method(context, function));
    quote! {
        #docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Model<T = f64> { #fields }

        impl<T: Real> Model<T> {
            #new
            #(#methods)*
        }

        impl<T: Real> Default for Model<T> {
            fn default() -> Self {
                Self::new(&Params::default())
            }
        }
    }
}

/// Expands to `pub fn new(params: &Params<T>) -> Self { .. }`.
fn new(context: &Context<'_>) -> TokenStream {
    let prelude = &context.compiled.prelude;
    let docs = document::attributes(&document::new(context.compiled));
    let mut read = false;
    each_leaf_of(prelude, &mut |leaf| read |= matches!(leaf, Expression::Symbol(_)));
    let params = names::ident(if read { "params" } else { "_params" });
    let locals = names::unique(prelude.locals.iter().map(String::as_str), RESERVED);
    let mut body = body(
        prelude,
        &Names {
            layout: &context.layout,
            locals: &locals,
            fields: &[],
            stored: None,
            commented: context.commented,
            packed: None,
        },
    );
    let value = if context.hollow {
        body.statements = TokenStream::new();
        quote!(::core::unimplemented!())
    } else if context.fields.is_empty() {
        body.statements = TokenStream::new();
        quote!(Self { scalar: ::core::marker::PhantomData })
    } else {
        let fields = context.fields.iter().zip(&body.results);
        let fields = fields.map(|(field, value)| initialiser(field, value));
        quote!(Self { #(#fields),* })
    };
    let statements = body.statements;
    quote! {
        #docs
        #[must_use]
        pub fn new(#params: &Params<T>) -> Self {
            #statements
            #value
        }
    }
}
