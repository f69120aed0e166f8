//! Stage `emit`: `Impulsive` and `Canonical`, by which stops, projections and symplectic methods know the model.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::methods::arguments::input_type;
use crate::emit::methods::{functions, results};
use crate::emit::{Context, document, names};

/// Expands to the impls where the functions have been derived, and to `Model::velocity` where `Model::impulse` is the same.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let mut tokens = impulsive(context).unwrap_or_default();
    tokens.extend(velocity(context));
    tokens.extend(canonical(context));
    tokens
}

/// Expands to `impl<T: Real> Impulsive for Model<T> { .. }`.
fn impulsive(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let impulse = context.function(FunctionKind::Impulse)?;
    context.function(FunctionKind::ForwardDynamics)?;
    let with_time = functions::arguments(impulse).has_time();
    let [t, unread, state] = ["t", "_t", "state"].map(names::ident);
    let time = if with_time { &t } else { &unread };
    let passed = functions::arguments(impulse).pass_state();
    let (ty, rates, value) = if layout.rows() > 0 {
        let value = quote! {
            let jump = self.impulse(#passed, impulse, rates);
            (jump.v, jump.rank)
        };
        (results::vector_type(layout, layout.rows()), quote!(rates), value)
    } else {
        (quote!(()), quote!(_rates), quote!((self.impulse(#passed, impulse), T::lit(0.0))))
    };
    Some(quote! {
        impl<T: Real> #krate::Impulsive for Model<T> {
            type Rates = #ty;

            fn jump(&self, #time: T, #state: &State<T>, impulse: &Velocity<T>, #rates: &#ty) -> (Velocity<T>, T) {
                #value
            }
        }
    })
}

/// Expands to `pub fn velocity(..) -> Velocity<T>` where momenta are asked for and the jump under an impulse is there.
fn velocity(context: &Context<'_>) -> Option<TokenStream> {
    context.function(FunctionKind::Momentum)?;
    if context.function(FunctionKind::MomentumVelocity).is_some() {
        return None;
    }
    let docs = "Velocities `M^-1 * momentum` that belong to momenta: the same function as `impulse`.".to_owned();
    let docs = document::attributes(&[docs]);
    Some(quote! {
        impl<T: Real> Model<T> {
            #docs
            #[must_use]
            pub fn velocity(&self, q: &Position<T>, momentum: &Velocity<T>) -> Velocity<T> {
                self.impulse(q, momentum)
            }
        }
    })
}

/// Expands to `impl<T: Real> Canonical for Model<T> { .. }`.
fn canonical(context: &Context<'_>) -> Option<TokenStream> {
    context.function(FunctionKind::Momentum)?;
    context.function(FunctionKind::ForwardDynamics)?;
    let layout = &context.layout;
    if layout.structure.has_speeds() {
        return None;
    }
    let (krate, input) = (layout.krate(), input_type(layout));
    Some(quote! {
        impl<T: Real> #krate::Canonical for Model<T> {
            fn momentum(&self, state: &State<T>) -> Velocity<T> {
                self.momentum(state)
            }

            fn velocity(&self, q: &Position<T>, momentum: &Velocity<T>) -> Velocity<T> {
                self.velocity(q, momentum)
            }

            fn momentum_rate(&self, t: T, state: &State<T>, input: &#input) -> Velocity<T> {
                self.momentum_rate(t, state, input)
            }
        }
    })
}
