//! Stage `emit`: `State`, and `Derivative` where the model has states of its own.

use proc_macro2::TokenStream;
use quote::quote;

use super::structs::compares_by_hand;
use crate::emit::Context;
use crate::emit::layout::Group;

/// Expands to `pub struct State<T = f64> { pub q: Position<T>, pub v: Velocity<T> }` and its impls.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let states = !layout.is_empty(Group::States, None);
    let field = states.then(|| {
        quote! {
            /// the model's own states
            pub x: States<T>,
        }
    });
    let default = states.then(|| quote!(x: States::default(),));
    let by_hand = compares_by_hand(layout, Group::Position);
    let derived = (!by_hand).then(|| quote!(, PartialEq));
    let comparison = by_hand.then(|| {
        let x = states.then(|| quote!(&&self.x == other.x));
        quote! {
            impl<T: Real> PartialEq for State<T> {
                fn eq(&self, other: &Self) -> bool {
                    self.q == other.q && self.v == other.v #x
                }
            }
        }
    });
    let derivative = states.then(|| {
        quote! {
            /// What forward dynamics gives: accelerations, and the rates of the model's own states.
            #[repr(C)]
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct Derivative<T = f64> {
                /// accelerations
                pub v: Velocity<T>,
                /// rates of the model's own states
                pub x: States<T>,
            }

            impl<T: Real> Default for Derivative<T> {
                fn default() -> Self {
                    Self { v: Velocity::default(), x: States::default() }
                }
            }
        }
    });
    quote! {
        /// All that changes in time. Its default is every joint at zero, at rest.
        #[repr(C)]
        #[derive(Clone, Copy, Debug #derived)]
        pub struct State<T = f64> {
            /// positions
            pub q: Position<T>,
            /// velocities
            pub v: Velocity<T>,
            #field
        }

        impl<T: Real> Default for State<T> {
            fn default() -> Self {
                Self { q: Position::default(), v: Velocity::default(), #default }
            }
        }
        #comparison
        #derivative
    }
}
