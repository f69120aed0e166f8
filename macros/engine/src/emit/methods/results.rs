//! Stage `emit`: what methods of `Model` give back.
//!
//! In: a function's kind and its scalars, in the order that [`FunctionKind`] documents. Out: the return type, and the value
//! built from the scalars.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::contracts::symbol::Symbol;
use crate::emit::layout::{Group, Layout, leaf};
use crate::emit::names;
use crate::model::types::{InstanceId, SolveFor};

impl Layout<'_> {
    /// Number of equations that keep a multiplier.
    pub(in crate::emit) fn rows(&self) -> usize {
        self.structure.rows.len()
    }

    /// Whether the model has states of its own.
    pub(in crate::emit) fn has_states(&self) -> bool {
        !self.is_empty(Group::States, None)
    }

    /// Whether forward dynamics gives more than accelerations.
    pub(in crate::emit) fn has_derivative(&self) -> bool {
        self.has_states() || self.rows() > 0 || self.structure.guesses() > 0
    }

    /// Whether inverse dynamics finds inputs instead of efforts.
    pub(in crate::emit) fn solves_inputs(&self) -> bool {
        !self.model.solve_for.is_empty() && !self.is_empty(Group::Input, None)
    }
}

/// Number of scalars that the method's value is built from.
pub(in crate::emit) fn count(layout: &Layout<'_>, kind: FunctionKind) -> usize {
    let (dof, rows) = (layout.dof(), layout.rows());
    let [states, inputs, outputs] = [Group::States, Group::Input, Group::Output].map(|group| layout.table(group).size);
    // With the rank of their system.
    let multipliers = if rows > 0 { rows + 1 } else { 0 };
    match kind {
        FunctionKind::ForwardDynamics => dof + states + multipliers + usize::from(layout.structure.guesses() > 0),
        FunctionKind::InverseDynamics if layout.solves_inputs() => layout.model.solve_for.len() + 1,
        FunctionKind::InverseDynamics
        | FunctionKind::Bias
        | FunctionKind::Momentum
        | FunctionKind::MomentumRate
        | FunctionKind::MomentumVelocity => dof,
        FunctionKind::MassMatrix => dof * dof,
        FunctionKind::KineticEnergy | FunctionKind::PotentialEnergy => 1,
        FunctionKind::Constraints | FunctionKind::ConstraintRate | FunctionKind::ConstraintBias => rows,
        FunctionKind::ConstraintJacobian => rows * dof,
        FunctionKind::Residual => dof + rows,
        FunctionKind::Kinematics(number) => 3 * found(layout, number),
        FunctionKind::Guess => layout.structure.guesses() + 1,
        FunctionKind::DeadCentres => layout.structure.dead_centres.len(),
        FunctionKind::Margins => margins(layout),
        FunctionKind::Granted => layout.structure.granted.len(),
        FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives => {
            differentiated(layout, kind) * (2 * dof + states + inputs)
        }
        FunctionKind::Impulse => dof + multipliers,
        FunctionKind::Outputs => outputs,
    }
}

/// Margins with their rates, and how far loops of Newton's method are open.
fn margins(layout: &Layout<'_>) -> usize {
    2 * layout.structure.margins().len() + usize::from(layout.structure.guesses() > 0)
}

/// Expands to the method's return type.
pub(in crate::emit) fn ty(layout: &Layout<'_>, kind: FunctionKind) -> TokenStream {
    let dof = layout.dof();
    match kind {
        FunctionKind::ForwardDynamics if layout.has_derivative() => quote!(Derivative<T>),
        FunctionKind::InverseDynamics if layout.solves_inputs() => quote!(Solved<T>),
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics => quote!(Velocity<T>),
        FunctionKind::MassMatrix => matrix_type(layout, dof, dof),
        FunctionKind::Bias => vector_type(layout, dof),
        FunctionKind::KineticEnergy | FunctionKind::PotentialEnergy => quote!(T),
        FunctionKind::Outputs => quote!(Output<T>),
        FunctionKind::Constraints | FunctionKind::ConstraintRate | FunctionKind::ConstraintBias => {
            vector_type(layout, layout.rows())
        }
        FunctionKind::ConstraintJacobian => matrix_type(layout, layout.rows(), dof),
        FunctionKind::Residual => vector_type(layout, dof + layout.rows()),
        FunctionKind::Kinematics(number) => {
            let (krate, count) = (layout.krate(), Literal::usize_unsuffixed(found(layout, number)));
            quote!(#krate::Kinematics<T, #count>)
        }
        FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives => {
            let krate = layout.krate();
            let [results, states, inputs] =
                [differentiated(layout, kind), layout.table(Group::States).size, layout.table(Group::Input).size]
                    .map(Literal::usize_unsuffixed);
            let dof = Literal::usize_unsuffixed(dof);
            quote!(#krate::Derivatives<T, #results, #dof, #states, #inputs>)
        }
        FunctionKind::Guess => quote!(Closed<T>),
        FunctionKind::Impulse if layout.rows() > 0 => quote!(Jump<T>),
        FunctionKind::Impulse
        | FunctionKind::Momentum
        | FunctionKind::MomentumRate
        | FunctionKind::MomentumVelocity => quote!(Velocity<T>),
        FunctionKind::DeadCentres => vector_type(layout, layout.structure.dead_centres.len()),
        FunctionKind::Margins => vector_type(layout, margins(layout)),
        FunctionKind::Granted => vector_type(layout, layout.structure.granted.len()),
    }
}

/// Expands to the method's value, from its scalars.
pub(in crate::emit) fn value(layout: &Layout<'_>, kind: FunctionKind, results: Vec<TokenStream>) -> TokenStream {
    let krate = layout.krate();
    let dof = layout.dof();
    match kind {
        FunctionKind::ForwardDynamics if layout.has_derivative() => derivative(layout, results),
        FunctionKind::InverseDynamics if layout.solves_inputs() => solved(layout, results),
        FunctionKind::ForwardDynamics | FunctionKind::InverseDynamics => filled(layout, Group::Velocity, &results),
        FunctionKind::MassMatrix => leaf::matrix(krate, dof, dof, &mut results.into_iter()),
        FunctionKind::ConstraintJacobian => leaf::matrix(krate, layout.rows(), dof, &mut results.into_iter()),
        FunctionKind::KineticEnergy | FunctionKind::PotentialEnergy => quote!(#(#results)*),
        FunctionKind::Impulse if layout.rows() > 0 => jump(layout, results),
        FunctionKind::Impulse
        | FunctionKind::Momentum
        | FunctionKind::MomentumRate
        | FunctionKind::MomentumVelocity => filled(layout, Group::Velocity, &results),
        FunctionKind::Outputs => filled(layout, Group::Output, &results),
        FunctionKind::Kinematics(number) => {
            let mut results = results.into_iter();
            let mut next = || vector(layout, results.by_ref().take(found(layout, number)).collect());
            let (position, velocity, acceleration) = (next(), next(), next());
            quote!(#krate::Kinematics { position: #position, velocity: #velocity, acceleration: #acceleration })
        }
        FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives => {
            let rows = differentiated(layout, kind);
            let mut results = results.into_iter();
            let mut next = |group| {
                let columns = layout.table(group).size;
                leaf::matrix(krate, rows, columns, &mut results.by_ref().take(rows * columns))
            };
            let [position, velocity] = [next(Group::Velocity), next(Group::Velocity)];
            let [states, input] = [next(Group::States), next(Group::Input)];
            quote! {
                #krate::Derivatives { position: #position, velocity: #velocity, states: #states, input: #input }
            }
        }
        FunctionKind::Guess => {
            let (mut results, state) = (results, names::ident("state"));
            let residual = results.split_off(layout.structure.guesses().min(results.len()));
            let guess = filled(layout, Group::Guess, &layout.in_leaves(&results));
            quote!(Closed { state: State { guess: #guess, ..*#state }, residual: #(#residual)* })
        }
        FunctionKind::Bias
        | FunctionKind::Constraints
        | FunctionKind::ConstraintRate
        | FunctionKind::ConstraintBias
        | FunctionKind::DeadCentres
        | FunctionKind::Margins
        | FunctionKind::Granted
        | FunctionKind::Residual => vector(layout, results),
    }
}

/// Expands to `Derivative { v: .., x: .., multipliers: .., rank: .., residual: .. }`.
fn derivative(layout: &Layout<'_>, results: Vec<TokenStream>) -> TokenStream {
    let mut results = results.into_iter();
    let mut next = |count: usize| -> Vec<TokenStream> { results.by_ref().take(count).collect() };
    let v = filled(layout, Group::Velocity, &next(layout.dof()));
    let x = layout.has_states().then(|| {
        let x = filled(layout, Group::States, &next(layout.table(Group::States).size));
        quote!(x: #x,)
    });
    let rows = (layout.rows() > 0).then(|| {
        let multipliers = vector(layout, next(layout.rows()));
        let rank = next(1);
        quote!(multipliers: #multipliers, rank: #(#rank)*,)
    });
    let residual = (layout.structure.guesses() > 0).then(|| {
        let residual = next(1);
        quote!(residual: #(#residual)*,)
    });
    quote!(Derivative { v: #v, #x #rows #residual })
}

/// Expands to `Jump { v: .., multipliers: .., rank: .. }`.
fn jump(layout: &Layout<'_>, results: Vec<TokenStream>) -> TokenStream {
    let mut results = results.into_iter();
    let mut next = |count: usize| -> Vec<TokenStream> { results.by_ref().take(count).collect() };
    let v = filled(layout, Group::Velocity, &next(layout.dof()));
    let multipliers = vector(layout, next(layout.rows()));
    let rank = next(1);
    quote!(Jump { v: #v, multipliers: #multipliers, rank: #(#rank)* })
}

/// Expands to `{ let mut solved = *input; solved.force = ..; Solved { input: solved, rank: .. } }`.
fn solved(layout: &Layout<'_>, results: Vec<TokenStream>) -> TokenStream {
    let [input, solved] = ["input", "solved"].map(names::ident);
    let inputs = &layout.model.solve_for;
    let rank = results.get(inputs.len()).into_iter();
    let set = inputs.iter().zip(&results).map(|(SolveFor { input, element, .. }, value)| {
        let place = layout.path_of(Symbol::Input { input: *input, element: *element });
        quote!(#solved #place = #value;)
    });
    quote! {
        let mut #solved = *#input;
        #(#set)*
        Solved { input: #solved, rank: #(#rank)* }
    }
}

/// Number of results that have derivatives: accelerations and rates of own states, or efforts.
fn differentiated(layout: &Layout<'_>, kind: FunctionKind) -> usize {
    let states = layout.table(Group::States).size;
    layout.dof() + if kind == FunctionKind::ForwardDerivatives { states } else { 0 }
}

/// Number of scalars that these kinematics find.
fn found(layout: &Layout<'_>, number: usize) -> usize {
    layout.model.kinematics.get(number).map_or(0, |kinematics| kinematics.find.len())
}

pub(in crate::emit) fn vector_type(layout: &Layout<'_>, size: usize) -> TokenStream {
    let (krate, size) = (layout.krate(), Literal::usize_unsuffixed(size));
    quote!(#krate::nalgebra::SVector<T, #size>)
}

fn matrix_type(layout: &Layout<'_>, rows: usize, columns: usize) -> TokenStream {
    let krate = layout.krate();
    let [rows, columns] = [rows, columns].map(Literal::usize_unsuffixed);
    quote!(#krate::nalgebra::SMatrix<T, #rows, #columns>)
}

/// Expands to `SVector::from([..])`.
fn vector(layout: &Layout<'_>, scalars: Vec<TokenStream>) -> TokenStream {
    let krate = layout.krate();
    if scalars.is_empty() {
        return quote!(#krate::nalgebra::SVector::zeros());
    }
    let scalars = scalars.into_iter().map(leaf::element);
    quote!(#krate::nalgebra::SVector::from([#(#scalars),*]))
}

/// Expands to a struct of the model from all its scalars.
pub(in crate::emit) fn filled(layout: &Layout<'_>, group: Group, scalars: &[TokenStream]) -> TokenStream {
    layout.construct(group, InstanceId(0), false, &mut |entry| {
        let own = scalars.iter().skip(entry.offset).take(entry.leaf.size());
        entry.leaf.build(layout.krate(), &mut own.cloned())
    })
}
