//! Stage `emit`: the methods of `Model`, one per derived function.
//!
//! In: a program with its kind. Out: a documented method whose signature is as small as the function's meaning allows.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::blocks::{body, each_leaf_of};
use super::expressions::Names;
use super::layout::{Group, Layout};
use super::places::{RESERVED, Root};
use super::{Context, document, leaf, names};
use crate::model::types::InstanceId;
use crate::optimize::program::{Expression, Function, FunctionKind, Program};

/// Name of the method.
pub(super) fn name(kind: FunctionKind) -> &'static str {
    match kind {
        FunctionKind::ForwardDynamics => "forward_dynamics",
        FunctionKind::InverseDynamics => "inverse_dynamics",
        FunctionKind::MassMatrix => "mass_matrix",
        FunctionKind::Bias => "bias",
        FunctionKind::KineticEnergy => "kinetic_energy",
        FunctionKind::PotentialEnergy => "potential_energy",
        FunctionKind::Outputs => "outputs",
    }
}

/// What a method takes besides `&self`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Arguments {
    Position,
    State,
    TimeStateInput,
    TimeStateInputAccel,
}

impl Arguments {
    /// The fewest that the function's meaning and its program allow.
    fn of(kind: FunctionKind, roots: &BTreeSet<Root>) -> Arguments {
        let least = match kind {
            FunctionKind::ForwardDynamics | FunctionKind::Bias | FunctionKind::Outputs => Arguments::TimeStateInput,
            FunctionKind::InverseDynamics => Arguments::TimeStateInputAccel,
            FunctionKind::KineticEnergy => Arguments::State,
            FunctionKind::MassMatrix | FunctionKind::PotentialEnergy => Arguments::Position,
        };
        // A spring that stiffens with time, or an input that shifts it.
        let needed = roots.iter().map(|root| match root {
            Root::Params | Root::Position => Arguments::Position,
            Root::Velocity | Root::States => Arguments::State,
            Root::Time | Root::Input => Arguments::TimeStateInput,
            Root::Acceleration => Arguments::TimeStateInputAccel,
        });
        needed.fold(least, Arguments::max)
    }

    /// Expands to `t: T, state: &State<T>, input: &Input<T>`; names of what isn't read start with `_`.
    fn declare(self, layout: &Layout<'_>, roots: &BTreeSet<Root>) -> TokenStream {
        let named = |read: bool, name: &str| names::ident(&format!("{}{name}", if read { "" } else { "_" }));
        let of_state = [Root::Position, Root::Velocity, Root::States];
        let q = named(roots.contains(&Root::Position), "q");
        let t = named(roots.contains(&Root::Time), "t");
        let state = named(of_state.iter().any(|root| roots.contains(root)), "state");
        let input = named(roots.contains(&Root::Input), "input");
        let accel = named(roots.contains(&Root::Acceleration), "accel");
        let input_type = input_type(layout);
        match self {
            Arguments::Position => quote!(#q: &Position<T>),
            Arguments::State => quote!(#state: &State<T>),
            Arguments::TimeStateInput => quote!(#t: T, #state: &State<T>, #input: &#input_type),
            Arguments::TimeStateInputAccel => {
                quote!(#t: T, #state: &State<T>, #input: &#input_type, #accel: &Velocity<T>)
            }
        }
    }

    /// Expands to `let q = &state.q;` for the parts of the state that are read.
    fn open(self, roots: &BTreeSet<Root>) -> TokenStream {
        if self == Arguments::Position {
            return TokenStream::new();
        }
        let state = names::ident("state");
        let of_state = [Root::Position, Root::Velocity, Root::States];
        let parts = of_state.iter().filter(|root| roots.contains(root));
        let parts = parts.map(|root| names::ident(root.name()));
        quote!(#(let #parts = &#state.#parts;)*)
    }
}

/// Expands to `Input<T>` or `()`.
pub(super) fn input_type(layout: &Layout<'_>) -> TokenStream {
    if layout.is_empty(Group::Input, None) { quote!(()) } else { quote!(Input<T>) }
}

/// The variables that a program reads.
fn roots(program: &Program) -> BTreeSet<Root> {
    let mut roots = BTreeSet::new();
    each_leaf_of(program, &mut |leaf| {
        if let Expression::Symbol(symbol) = leaf {
            roots.insert(Root::of(*symbol));
        }
    });
    roots
}

/// Expands to a method of `Model`.
pub(super) fn method(context: &Context<'_>, function: &Function) -> TokenStream {
    let layout = &context.layout;
    let roots = roots(&function.program);
    let arguments = Arguments::of(function.kind, &roots);
    let declared = arguments.declare(layout, &roots);
    let opened = arguments.open(&roots);
    let name = names::ident(name(function.kind));
    let result = result_type(layout, function.kind);
    let docs = document::attributes(&document::function(layout, function));
    let block = if context.hollow {
        quote!(::core::unimplemented!())
    } else {
        let locals = names::unique(function.program.locals.iter().map(String::as_str), RESERVED);
        let body = body(&function.program, &Names { layout, locals: &locals, fields: &context.fields });
        let statements = body.statements;
        let value = result_value(layout, function.kind, body.results);
        quote!(#opened #statements #value)
    };
    quote! {
        #docs
        #[must_use]
        pub fn #name(&self, #declared) -> #result { #block }
    }
}

/// Expands to the method's return type.
fn result_type(layout: &Layout<'_>, kind: FunctionKind) -> TokenStream {
    let krate = layout.krate();
    let dof = Literal::usize_unsuffixed(layout.dof());
    match kind {
        FunctionKind::ForwardDynamics if !layout.is_empty(Group::States, None) => {
            quote!(Derivative<T>)
        }
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics => quote!(Velocity<T>),
        FunctionKind::MassMatrix => quote!(#krate::nalgebra::SMatrix<T, #dof, #dof>),
        FunctionKind::Bias => quote!(#krate::nalgebra::SVector<T, #dof>),
        FunctionKind::KineticEnergy | FunctionKind::PotentialEnergy => quote!(T),
        FunctionKind::Outputs => quote!(Output<T>),
    }
}

/// Expands to the method's value, from its scalars.
fn result_value(layout: &Layout<'_>, kind: FunctionKind, results: Vec<TokenStream>) -> TokenStream {
    let krate = layout.krate();
    let dof = layout.dof();
    match kind {
        FunctionKind::ForwardDynamics if !layout.is_empty(Group::States, None) => {
            let (accelerations, rates) = results.split_at(dof.min(results.len()));
            let v = filled(layout, Group::Velocity, accelerations);
            let x = filled(layout, Group::States, rates);
            quote!(Derivative { v: #v, x: #x })
        }
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics => filled(layout, Group::Velocity, &results),
        FunctionKind::MassMatrix => leaf::matrix(krate, dof, dof, &mut results.into_iter()),
        FunctionKind::Bias if dof == 0 => quote!(#krate::nalgebra::SVector::zeros()),
        FunctionKind::Bias => {
            let results = results.into_iter().map(leaf::element);
            quote!(#krate::nalgebra::SVector::from([#(#results),*]))
        }
        FunctionKind::KineticEnergy | FunctionKind::PotentialEnergy => quote!(#(#results)*),
        FunctionKind::Outputs => filled(layout, Group::Output, &results),
    }
}

/// Expands to a struct of the model from all its scalars.
pub(super) fn filled(layout: &Layout<'_>, group: Group, scalars: &[TokenStream]) -> TokenStream {
    layout.construct(group, InstanceId(0), false, &mut |entry| {
        let own = scalars.iter().skip(entry.offset).take(entry.leaf.size());
        entry.leaf.build(layout.krate(), &mut own.cloned())
    })
}
