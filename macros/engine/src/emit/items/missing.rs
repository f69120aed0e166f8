//! Stage `emit`: methods that were not asked for.
//!
//! In: which functions there are. Out: a method for each other one that an `emit` would give, which can't be called: its
//! argument would have to implement a trait that nothing implements, and that trait tells, at the user's call, what to
//! write. The types of its result are unknown with it, so that nothing else is said about the call.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::layout::Group;
use crate::emit::methods::arguments::Arguments;
use crate::emit::methods::functions;
use crate::emit::{Context, document, names};

/// Functions with the words of `emit`, and the traits of the runtime's `emitted` that speak of them.
const WORDS: [(FunctionKind, &str, &str); 14] = [
    (FunctionKind::ForwardDynamics, "forward_dynamics", "ForwardDynamics"),
    (FunctionKind::InverseDynamics, "inverse_dynamics", "InverseDynamics"),
    (FunctionKind::MassMatrix, "mass_matrix", "MassMatrix"),
    (FunctionKind::Bias, "bias", "Bias"),
    (FunctionKind::KineticEnergy, "energy", "Energy"),
    (FunctionKind::PotentialEnergy, "energy", "Energy"),
    (FunctionKind::Residual, "residual", "Residual"),
    (FunctionKind::Kinematics(0), "kinematics { given: .., find: .. }", "Kinematics"),
    (FunctionKind::ForwardDerivatives, "derivatives", "Derivatives"),
    (FunctionKind::InverseDerivatives, "derivatives", "Derivatives"),
    (FunctionKind::Impulse, "impulse", "Impulse"),
    (FunctionKind::Momentum, "momentum", "Momentum"),
    (FunctionKind::MomentumRate, "momentum", "Momentum"),
    (FunctionKind::MomentumVelocity, "momentum", "Momentum"),
];

/// Expands to `impl<T: Real> Model<T> { pub fn mass_matrix<A: emitted::MassMatrix>(&self, _q: &A) -> A::Result { .. } }`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let is_missing = |kind: FunctionKind| match kind {
        // Where impulses and momenta are asked for one function does for both.
        FunctionKind::MomentumVelocity => context.function(FunctionKind::Momentum).is_none(),
        kind => context.function(kind).is_none(),
    };
    let missing = WORDS.iter().filter(|(kind, ..)| is_missing(*kind));
    let methods = missing.map(|(kind, word, of)| {
        method(context, *kind, &format!("Not derived: `emit {word}` in the model asks for it."), of)
    });
    let outputs = context.layout.is_empty(Group::Output, None).then(|| {
        let docs = "The model has no `output`.";
        method(context, FunctionKind::Outputs, docs, "Outputs")
    });
    quote! {
        impl<T: Real> Model<T> {
            #(#methods)*
            #outputs
        }
    }
}

fn method(context: &Context<'_>, kind: FunctionKind, docs: &str, of: &str) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let docs = document::attributes(&[docs.to_string()]);
    let (name, of) = (names::ident(&functions::name(kind)), names::ident(of));
    let arguments = Arguments::least(kind).refused(layout);
    quote! {
        #docs
        #[doc(hidden)]
        #[must_use]
        pub fn #name<A: #krate::emitted::#of>(&self, #arguments) -> A::Result {
            A::never()
        }
    }
}
