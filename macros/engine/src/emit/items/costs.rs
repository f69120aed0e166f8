//! Stage `emit`: the constants `DOF`, before all other items, and `COSTS` and `DERIVED`, behind them.

use std::borrow::Cow;

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::Path;

use crate::contracts::cost::Cost;
use crate::emit::Context;
use crate::emit::methods::functions;

/// Expands to `pub const DOF: usize = 2;`.
pub(super) fn dof(context: &Context<'_>) -> TokenStream {
    let dof = Literal::usize_unsuffixed(context.layout.dof());
    quote! {
        /// Number of degrees of freedom: components of a velocity.
        pub const DOF: usize = #dof;
    }
}

/// Expands to `pub const COSTS: &[Cost] = &[..];` and `pub const DERIVED: &[Cost] = &[..];`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let krate = context.layout.krate();
    let compiled = context.compiled;
    let functions =
        || compiled.functions.iter().map(|function| (functions::name(context.layout.model, function.kind), function));
    let after = functions().map(|(name, function)| row(krate, name, &function.after));
    let at = compiled.at.iter().flat_map(|at| {
        let functions = at.functions.iter();
        let name = |kind| format!("at.{}", functions::name(context.layout.model, kind));
        let functions = functions.map(move |function| row(krate, name(function.kind).into(), &function.after));
        std::iter::once(row(krate, "at".into(), &at.cost)).chain(functions)
    });
    let costs = std::iter::once(row(krate, "new".into(), &compiled.prelude_cost)).chain(after).chain(at);
    let derived = functions().map(|(name, function)| row(krate, name, &function.before));
    let docs = match compiled.at {
        None => " Operation counts of every function, and of `Model::new`.",
        Some(_) => {
            " Operation counts of every function, of `Model::new`, of `Model::at` and of the functions that go on from there."
        }
    };
    quote! {
        #[doc = #docs]
        pub const COSTS: &[#krate::Cost] = &[#(#costs),*];
        /// The same of every function as it was derived, before optimisation, with the work on parameters in it.
        pub const DERIVED: &[#krate::Cost] = &[#(#derived),*];
    }
}

/// `Cost { function: "bias", add: 3, .. }`
fn row(krate: &Path, function: Cow<'_, str>, cost: &Cost) -> TokenStream {
    let Cost { add, mul, div, sqrt, sincos, compare, other } = *cost;
    let other = compare + other;
    let [add, mul, div, sqrt, sincos, other] = [add, mul, div, sqrt, sincos, other].map(Literal::u32_unsuffixed);
    quote! {
        #krate::Cost {
            function: #function,
            add: #add,
            mul: #mul,
            div: #div,
            sqrt: #sqrt,
            sincos: #sincos,
            other: #other,
        }
    }
}
