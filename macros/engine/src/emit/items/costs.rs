//! Stage `emit`: the constants `DOF` and `COSTS`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::emit::{Context, functions};
use crate::optimize::program::Cost;

/// Expands to `pub const DOF: usize = 2;` and `pub const COSTS: &[Cost] = &[..];`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let krate = context.layout.krate();
    let dof = Literal::usize_unsuffixed(context.layout.dof());
    let compiled = context.compiled;
    let prelude = std::iter::once(("new", &compiled.prelude_cost));
    let functions = compiled.functions.iter();
    let functions = functions.map(|function| (functions::name(function.kind), &function.after));
    let rows = prelude.chain(functions).map(|(function, cost)| {
        let Cost { add, mul, div, sqrt, sincos, other } = *cost;
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
    });
    quote! {
        /// Number of degrees of freedom: components of a velocity.
        pub const DOF: usize = #dof;
        /// Operation counts of every function, and of `Model::new`.
        pub const COSTS: &[#krate::Cost] = &[#(#rows),*];
    }
}
