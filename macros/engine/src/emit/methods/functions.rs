//! Stage `emit`: the methods of `Model`, one per derived function.
//!
//! In: a program with its kind. Out: a documented method whose signature is as small as the function's meaning allows.

use std::borrow::Cow;
use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::layout::places::{RESERVED, Root};
use crate::emit::print::blocks::{body, each_leaf_of};
use crate::emit::print::expressions::Names;
use crate::emit::{Context, document, names};
use crate::optimize::program::{Expression, Function, Program};

use super::arguments::Arguments;
use super::results;

/// Name of the method.
pub fn name(kind: FunctionKind) -> Cow<'static, str> {
    Cow::Borrowed(match kind {
        FunctionKind::ForwardDynamics => "forward_dynamics",
        FunctionKind::InverseDynamics => "inverse_dynamics",
        FunctionKind::MassMatrix => "mass_matrix",
        FunctionKind::Bias => "bias",
        FunctionKind::KineticEnergy => "kinetic_energy",
        FunctionKind::PotentialEnergy => "potential_energy",
        FunctionKind::Outputs => "outputs",
        FunctionKind::Constraints => "constraints",
        FunctionKind::ConstraintJacobian => "constraint_jacobian",
        FunctionKind::ConstraintRate => "constraint_rate",
        FunctionKind::ConstraintBias => "constraint_bias",
        FunctionKind::Residual => "residual",
        FunctionKind::ForwardDerivatives => "forward_derivatives",
        FunctionKind::InverseDerivatives => "inverse_derivatives",
        FunctionKind::Kinematics(0) => "kinematics",
        FunctionKind::Kinematics(number) => return Cow::Owned(format!("kinematics_{}", number + 1)),
        FunctionKind::Guess => "close",
        FunctionKind::DeadCentres => "dead_centres",
        FunctionKind::Margins => "margins",
        FunctionKind::Granted => "granted",
        FunctionKind::Impulse => "impulse",
        FunctionKind::Momentum => "momentum",
        FunctionKind::MomentumRate => "momentum_rate",
        FunctionKind::MomentumVelocity => "velocity",
    })
}

/// The variables that a program reads.
pub(in crate::emit) fn roots(program: &Program) -> BTreeSet<Root> {
    let mut roots = BTreeSet::new();
    each_leaf_of(program, &mut |leaf| {
        if let Expression::Symbol(symbol) = leaf {
            roots.extend(Root::of(*symbol));
        }
    });
    roots
}

/// What the method of a function takes.
pub(in crate::emit) fn arguments(function: &Function) -> Arguments {
    Arguments::of(function.kind, &roots(&function.program))
}

/// Expands to a method of `Model`.
pub(in crate::emit) fn method(context: &Context<'_>, function: &Function) -> TokenStream {
    let layout = &context.layout;
    let kind = function.kind;
    let read = roots(&function.program);
    let arguments = Arguments::of(kind, &read);
    let opened = arguments.open(&read);
    let mut named = read;
    if !context.hollow {
        // What is not computed is handed on.
        named.extend((kind == FunctionKind::InverseDynamics && layout.solves_inputs()).then_some(Root::Input));
        named.extend((kind == FunctionKind::Guess).then_some(Root::Guess));
    }
    let declared = arguments.declare(layout, &named);
    let name = names::ident(&name(kind));
    let result = results::ty(layout, kind);
    let docs = document::attributes(&document::function(layout, function));
    let block = if context.hollow {
        quote!(::core::unimplemented!())
    } else {
        let locals = names::unique(function.program.locals.iter().map(String::as_str), RESERVED);
        let body = body(&function.program, &Names { layout, locals: &locals, fields: &context.fields });
        let statements = body.statements;
        let value = results::value(layout, kind, body.results);
        quote!(#opened #statements #value)
    };
    quote! {
        #docs
        #[must_use]
        pub fn #name(&self, #declared) -> #result { #block }
    }
}
