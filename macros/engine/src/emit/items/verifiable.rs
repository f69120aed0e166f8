//! Stage `emit`: `Verifiable`, by which users' tests compare the functions of a model.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::{Arguments, FunctionKind};
use crate::emit::methods::arguments::input_type;
use crate::emit::methods::functions;
use crate::emit::{Context, names};
use crate::optimize::program::Function;

/// Expands to `impl<T: Real> Verifiable<2> for Model<T> { .. }` where the functions that it compares have been derived.
pub(super) fn item(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let forward = context.function(FunctionKind::ForwardDynamics)?;
    let inverse = context.function(FunctionKind::InverseDynamics)?;
    let mass = context.function(FunctionKind::MassMatrix)?;
    let energy = context.function(FunctionKind::KineticEnergy)?;
    let jacobian = context.function(FunctionKind::ConstraintJacobian).filter(|_| layout.rows() > 0);
    // Without it nothing tells what multipliers do.
    if layout.dof() == 0 || layout.solves_inputs() || jacobian.is_some() != (layout.rows() > 0) {
        return None;
    }
    let krate = layout.krate();
    let count = Literal::usize_unsuffixed(layout.dof());
    let input = input_type(layout);
    let [state, q] = ["state", "q"].map(names::ident);
    // Functions of the position alone take nothing else.
    let call = |function: &Function| {
        let arguments = functions::arguments(function);
        let (name, passed) = (names::ident(&functions::name(layout.model, function.kind)), arguments.pass());
        match arguments.has_state() {
            true => quote!(self.#name(#passed)),
            false => quote!({ let #state = &#state.#q; self.#name(#passed) }),
        }
    };
    // What isn't read has a name that starts with `_`.
    let declared = |read: &[&Function]| {
        let any = |f: fn(Arguments) -> bool| read.iter().any(|function| f(functions::arguments(function)));
        let named = |read: bool, name: &str| names::ident(&format!("{}{name}", if read { "" } else { "_" }));
        let (t, given) = (named(any(Arguments::has_time), "t"), named(any(Arguments::has_input), "input"));
        quote!(#t: T, #state: &State<T>, #given: &#input)
    };
    let vector = quote!(#krate::nalgebra::SVector<T, #count>);
    let zeros = quote!(#krate::nalgebra::SVector::zeros());
    let found = call(forward);
    let free = match jacobian.map(call) {
        Some(jacobian) => quote! {
            let found = #found;
            (found.v.into(), #jacobian.tr_mul(&found.multipliers))
        },
        None if layout.has_derivative() => quote!((#found.v.into(), #zeros)),
        None => quote!((#found.into(), #zeros)),
    };
    let of_free = declared(&std::iter::once(forward).chain(jacobian).collect::<Vec<_>>());
    let (of_inverse, of_mass, of_energy) = (declared(&[inverse]), declared(&[mass]), declared(&[energy]));
    let passed = functions::arguments(inverse).pass();
    let (mass, energy) = (call(mass), call(energy));
    Some(quote! {
        impl<T: Real> #krate::Verifiable<#count> for Model<T> {
            fn free_motion(&self, #of_free) -> (#vector, #vector) {
                #free
            }

            fn efforts(&self, #of_inverse, accelerations: &#vector) -> #vector {
                self.inverse_dynamics(#passed, &(*accelerations).into()).into()
            }

            fn inertia(&self, #of_mass) -> #krate::nalgebra::SMatrix<T, #count, #count> {
                #mass
            }

            fn kinetic(&self, #of_energy) -> T {
                #energy
            }
        }
    })
}
