//! Stage `emit`: what `System` says of singular poses and of singular mass matrices.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::{Arguments, FunctionKind};
use crate::emit::layout::leaf;
use crate::emit::layout::places::RESERVED;
use crate::emit::methods::arguments::input_type;
use crate::emit::methods::{functions, results};
use crate::emit::print::blocks::body;
use crate::emit::print::expressions::Names;
use crate::emit::{Context, names};
use crate::mechanics::Inertia;
use crate::optimize::program::Program;

/// Expands to `fn ambiguity(..) -> T`, which tells where rounding would decide which of two motions goes on. For models
/// that implement `Constrained`.
pub(super) fn ambiguity(context: &Context<'_>) -> TokenStream {
    let krate = context.layout.krate();
    let ty = input_type(&context.layout);
    let [t, state, input] = ["t", "state", "_input"].map(names::ident);
    quote! {
        fn ambiguity(&self, #t: T, #state: &State<T>, #input: &#ty) -> T {
            #krate::ambiguity(self, #t, #state)
        }
    }
}

/// Expands to `fn without_inertia(..) -> Option<&'static str>`, which names the first coordinate, from the last, whose pivot
/// of the mass matrix is not positive. For models whose matrix may become singular.
pub(super) fn without_inertia(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    if context.hollow {
        return None;
    }
    let (arguments, matrix) = match &context.compiled.inertia {
        Inertia::Regular => return None,
        Inertia::Requested => call(context)?,
        Inertia::Own(program) => own(context, program),
    };
    let names = layout.structure.speeds().iter().map(|&coordinate| layout.coordinate(coordinate));
    Some(quote! {
        fn without_inertia(&self, #arguments) -> Option<&'static str> {
            #matrix
            #krate::pivots::without_inertia(&matrix, &[#(#names),*])
        }
    })
}

/// The arguments, and `let matrix = ..;` by the function that the model has.
fn call(context: &Context<'_>) -> Option<(TokenStream, TokenStream)> {
    let arguments = functions::arguments(context.function(FunctionKind::MassMatrix)?);
    let ty = input_type(&context.layout);
    let named = |read: bool, name: &str| names::ident(&if read { name.to_string() } else { format!("_{name}") });
    let [t, input] = [named(arguments.has_time(), "t"), named(arguments.has_input(), "input")];
    let state = names::ident("state");
    let passed = if arguments.has_state() { arguments.pass() } else { quote!(&#state.q) };
    Some((quote!(#t: T, #state: &State<T>, #input: &#ty), quote!(let matrix = self.mass_matrix(#passed);)))
}

/// The same by statements of its own.
fn own(context: &Context<'_>, program: &Program) -> (TokenStream, TokenStream) {
    let layout = &context.layout;
    let read = functions::roots(program);
    let arguments = Arguments::of(FunctionKind::ForwardDynamics, &read);
    let opened = arguments.open(&read);
    let locals = names::unique(program.locals.iter().map(String::as_str), RESERVED);
    let body = body(
        program,
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
    let matrix = leaf::matrix(layout.krate(), layout.dof(), layout.dof(), &mut body.results.into_iter());
    let ty = results::ty(layout, FunctionKind::MassMatrix);
    (arguments.declare(layout, &read), quote!(#opened #statements let matrix: #ty = #matrix;))
}
