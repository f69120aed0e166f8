//! Stage `emit`: methods that were not asked for.
//!
//! In: which functions there are. Out: a method for each other one that an `emit` would give, which can't be called: its
//! argument would have to implement a trait that nothing implements, and that trait tells, at the user's call, what to
//! write. The types of its result are unknown with it, so that nothing else is said about the call.

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::{Arguments, Asked, FunctionKind};
use crate::emit::layout::StructKind;
use crate::emit::methods::functions;
use crate::emit::{Context, document, names};

use super::assembly;

/// Expands to `impl<T: Real> Model<T> { pub fn mass_matrix<A: emitted::MassMatrix>(&self, _q: &A) -> A::Result { .. } }`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let is_missing = |kind: FunctionKind| match kind {
        // Where impulses and momenta are asked for one function does for both.
        FunctionKind::MomentumVelocity => context.function(FunctionKind::Momentum).is_none(),
        kind => context.function(kind).is_none(),
    };
    let methods =
        FunctionKind::ALL.into_iter().filter(|kind| is_missing(*kind)).filter_map(|kind| match kind.row().asked {
            // Groups have a name only where they are declared; for a triangle, poses and the like nothing is
            // added to models without them.
            Asked::By { .. }
                if matches!(
                    kind,
                    FunctionKind::OutputGroup(_)
                        | FunctionKind::MassMatrixLower
                        | FunctionKind::CentroidalMomentumMatrix
                        | FunctionKind::Poses
                ) =>
            {
                None
            }
            // Who asks calls what goes through all of them.
            Asked::By { .. } if kind == FunctionKind::AssemblyCondition => None,
            Asked::By { word, missing, .. } => {
                Some(method(context, kind, &format!("Not derived: `emit {word}` in the model asks for it."), missing))
            }
            _ => None,
        });
    let outputs = context.layout.is_empty(StructKind::Output, None).then(|| {
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
    let (name, takes) = match kind {
        FunctionKind::Assembly => (assembly::NAME.into(), Arguments { alternative: false, ..kind.row().takes }),
        kind => (functions::name(layout.model, kind), kind.row().takes),
    };
    let (name, of) = (names::ident(&name), names::ident(of));
    let arguments = takes.refused(layout);
    quote! {
        #docs
        #[doc(hidden)]
        #[must_use]
        pub fn #name<A: #krate::emitted::#of>(&self, #arguments) -> A::Result {
            A::never()
        }
    }
}
