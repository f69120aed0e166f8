//! Stage `emit`: what `System` says of singular poses and singular mass matrices.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::arguments::input_type;
use crate::emit::{Context, names};

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
