//! Stage `emit`: `System`, by which integrators run the model.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::layout::Group;
use crate::emit::{Context, functions};
use crate::optimize::program::FunctionKind;

/// Expands to `impl<T: Real> System for Model<T> { .. }` where forward dynamics has been derived.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let mut functions = context.compiled.functions.iter();
    if !functions.any(|function| function.kind == FunctionKind::ForwardDynamics) {
        return TokenStream::new();
    }
    let krate = layout.krate();
    let input = functions::input_type(layout);
    let (extra, value) = if layout.is_empty(Group::States, None) {
        (quote!(()), quote!((self.forward_dynamics(t, state, input), ())))
    } else {
        let value = quote! {
            let rates = self.forward_dynamics(t, state, input);
            (rates.v, rates.x)
        };
        (quote!(States<T>), value)
    };
    quote! {
        impl<T: Real> #krate::System for Model<T> {
            type Scalar = T;
            type State = State<T>;
            type Input = #input;

            fn derivative(&self, t: T, state: &State<T>, input: &#input) -> (Velocity<T>, #extra) {
                #value
            }
        }
    }
}
