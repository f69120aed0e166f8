//! Stage `emit`: `System`, by which integrators run the model.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::arguments::{Arguments, input_type};
use crate::emit::blocks::groups_argument;
use crate::emit::{Context, functions, names, results};
use crate::optimize::program::FunctionKind;

/// Expands to `impl<T: Real> System for Model<T> { .. }` where forward dynamics has been derived.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    if context.function(FunctionKind::ForwardDynamics).is_none() {
        return TokenStream::new();
    }
    let krate = layout.krate();
    let input = input_type(layout);
    let (extra, value) = match (layout.has_states(), layout.has_derivative()) {
        (true, _) => {
            let value = quote! {
                let rates = self.forward_dynamics(t, state, input);
                (rates.v, rates.x)
            };
            (quote!(States<T>), value)
        }
        (false, true) => (quote!(()), quote!((self.forward_dynamics(t, state, input).v, ()))),
        (false, false) => (quote!(()), quote!((self.forward_dynamics(t, state, input), ()))),
    };
    let accepted = accepted(context);
    let constrained = constrained(context);
    quote! {
        impl<T: Real> #krate::System for Model<T> {
            type Scalar = T;
            type State = State<T>;
            type Input = #input;

            fn derivative(&self, t: T, state: &State<T>, input: &#input) -> (Velocity<T>, #extra) {
                #value
            }
            #accepted
        }
        #constrained
    }
}

/// Expands to `fn accepted(..) -> State<T>`, which keeps the solutions of the loops, where there are any to keep.
fn accepted(context: &Context<'_>) -> Option<TokenStream> {
    let close = context.function(FunctionKind::Guess)?;
    let arguments = functions::arguments(close);
    let [t, state, input] = ["t", "state", "input"].map(names::ident);
    let passed = arguments.pass();
    let ty = input_type(&context.layout);
    // A name that isn't read starts with `_`.
    let t_name = if arguments.has_time() { t } else { names::ident("_t") };
    let input_name = if arguments.has_input() { input } else { names::ident("_input") };
    Some(quote! {
        fn accepted(&self, #t_name: T, #state: &State<T>, #input_name: &#ty) -> State<T> {
            self.close(#passed).state
        }
    })
}

/// Expands to `impl<T: Real> Constrained for Model<T> { .. }` where constraint equations are left that depend on what the
/// trait knows.
fn constrained(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    for kind in [FunctionKind::Constraints, FunctionKind::ConstraintJacobian, FunctionKind::ConstraintRate] {
        if functions::arguments(context.function(kind)?) != Arguments::least(kind) {
            return None;
        }
    }
    if layout.rows() == 0 || layout.dof() == 0 {
        return None;
    }
    let krate = layout.krate();
    let residual = results::vector_type(layout, layout.rows());
    let weights = results::vector_type(layout, layout.dof());
    let groups = layout.structure.row_groups(layout.model);
    let least_norm = names::ident(if groups.is_empty() { "least_norm" } else { "least_norm_in_groups" });
    let groups = groups_argument(&groups);
    Some(quote! {
        impl<T: Real> #krate::Constrained for Model<T> {
            type Residual = #residual;

            fn constraints(&self, t: T, q: &Position<T>) -> #residual {
                self.constraints(t, q)
            }

            fn constraint_rate(&self, t: T, state: &State<T>) -> #residual {
                self.constraint_rate(t, state)
            }

            fn correction(
                &self,
                t: T,
                q: &Position<T>,
                residual: &#residual,
                weights: &Velocity<T>,
            ) -> (Velocity<T>, T) {
                let weights: #weights = (*weights).into();
                let jacobian = self.constraint_jacobian(t, q);
                let (change, rank) = #krate::linear::#least_norm(&jacobian, residual, &weights #groups);
                (change.into(), rank)
            }
        }
    })
}
