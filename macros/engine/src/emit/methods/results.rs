//! Stage `emit`: what methods of `Model` give back.
//!
//! In: a function's kind and its scalars, in the slots of its shape. Out: the return type, and the value built from the
//! scalars.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::{FunctionKind, Shape, Sizes, triangle};
use crate::contracts::results::{Parts, Results, Slot};
use crate::contracts::symbol::Symbol;
use crate::emit::layout::{Layout, StructKind, groups, leaf};
use crate::emit::names;
use crate::model::types::{InstanceId, OutputGroup, SolveFor};

impl Layout<'_> {
    /// Number of equations that keep a multiplier.
    pub(in crate::emit) fn rows(&self) -> usize {
        self.structure.rows.len()
    }

    /// Whether the model has states of its own.
    pub(in crate::emit) fn has_states(&self) -> bool {
        !self.is_empty(StructKind::States, None)
    }

    /// Whether forward dynamics gives more than accelerations.
    pub(in crate::emit) fn has_derivative(&self) -> bool {
        self.sizes(FunctionKind::ForwardDynamics).has_derivative()
    }

    /// Whether inverse dynamics finds inputs instead of efforts.
    pub(in crate::emit) fn solves_inputs(&self) -> bool {
        !self.model.solve_for.is_empty() && !self.is_empty(StructKind::Input, None)
    }

    /// What the function gives.
    pub(in crate::emit) fn shape(&self, kind: FunctionKind) -> Shape {
        (kind.row().gives)(&self.sizes(kind))
    }

    /// What shapes and documentation depend on.
    pub(in crate::emit) fn sizes(&self, kind: FunctionKind) -> Sizes {
        let [states, inputs, outputs] =
            [StructKind::States, StructKind::Input, StructKind::Output].map(|group| self.table(group).size);
        let found = match kind {
            FunctionKind::Kinematics(number) => self.model.kinematics[number].find.len(),
            FunctionKind::Assembly => self.model.assembly.as_ref().map_or(0, |wanted| wanted.find.len()),
            _ => 0,
        };
        let grouped = match kind {
            FunctionKind::OutputGroup(number) => {
                self.model.output_groups.get(number).map_or(0, |group| groups::size(self, group))
            }
            _ => 0,
        };
        Sizes {
            dof: self.dof(),
            displacements: self.table(self.displacement()).size,
            speeds: self.structure.has_speeds(),
            rows: self.rows(),
            states,
            inputs,
            outputs,
            guesses: self.structure.guesses(),
            solved: self.solves_inputs().then_some(self.model.solve_for.len()),
            found,
            grouped,
            dead_centres: self.structure.dead_centres.len(),
            margins: self.structure.margins().len(),
            granted: self.structure.granted.len(),
            poses: self.table(StructKind::Poses).size,
        }
    }
}

/// What the method's value is built from.
pub(in crate::emit) fn parts(layout: &Layout<'_>, kind: FunctionKind) -> Parts {
    layout.shape(kind).parts(&layout.sizes(kind))
}

/// The group of outputs that it gives.
fn group<'m>(layout: &Layout<'m>, kind: FunctionKind) -> Option<&'m OutputGroup> {
    match kind {
        FunctionKind::OutputGroup(number) => layout.model.output_groups.get(number),
        _ => None,
    }
}

/// Expands to the method's return type.
pub(in crate::emit) fn ty(layout: &Layout<'_>, kind: FunctionKind) -> TokenStream {
    let krate = layout.krate();
    match layout.shape(kind) {
        Shape::Scalar => quote!(T),
        Shape::Vector(size) => vector_type(layout, size),
        Shape::Matrix(rows, columns) => matrix_type(layout, rows, columns),
        Shape::Lower(rows) => {
            let [rows, entries] = [rows, triangle(rows)].map(Literal::usize_unsuffixed);
            quote!(#krate::LowerTriangle<T, #rows, #entries>)
        }
        Shape::Residual | Shape::Margins(_) => vector_type(layout, parts(layout, kind).count()),
        Shape::Velocity => quote!(Velocity<T>),
        Shape::Rates => quote!(Rates<T>),
        Shape::Derivative => quote!(Derivative<T>),
        Shape::Solved(_) => quote!(Solved<T>),
        Shape::Jump => quote!(Jump<T>),
        Shape::Poses => quote!(Poses<T>),
        Shape::Outputs => quote!(Output<T>),
        Shape::OutputGroup(_) => {
            let name = group(layout, kind).map(groups::name);
            quote!(#name<T>)
        }
        Shape::Kinematics(found) => {
            let count = Literal::usize_unsuffixed(found);
            quote!(#krate::Kinematics<T, #count>)
        }
        Shape::Assembly(found) => {
            let count = Literal::usize_unsuffixed(found);
            quote!(#krate::AssemblyMode<T, #count>)
        }
        Shape::Derivatives(results) => {
            let sizes = layout.sizes(kind);
            let [results, dof, states, inputs] =
                [results, sizes.dof, sizes.states, sizes.inputs].map(Literal::usize_unsuffixed);
            let moved = sizes.speeds.then(|| {
                let moved = Literal::usize_unsuffixed(sizes.displacements);
                quote!(, #moved)
            });
            quote!(#krate::Derivatives<T, #results, #dof, #states, #inputs #moved>)
        }
        Shape::Linearization(state) => {
            let sizes = layout.sizes(kind);
            let [state, inputs, outputs] = [state, sizes.inputs, sizes.outputs].map(Literal::usize_unsuffixed);
            quote!(#krate::Linearization<T, #state, #inputs, #outputs>)
        }
        Shape::Closed => quote!(Closed<T>),
    }
}

/// Expands to the method's value, from its scalars.
pub(in crate::emit) fn value(layout: &Layout<'_>, kind: FunctionKind, results: Vec<TokenStream>) -> TokenStream {
    let krate = layout.krate();
    let results = Results { parts: parts(layout, kind), list: results, apart: Vec::new() };
    match layout.shape(kind) {
        Shape::Scalar => scalar(&results, Slot::Value),
        Shape::Vector(_) | Shape::Residual | Shape::Margins(_) => vector(layout, &results.list),
        Shape::Matrix(rows, columns) => leaf::matrix(krate, rows, columns, &mut results.list.into_iter()),
        Shape::Lower(_) => {
            let entries = results.list.into_iter().map(leaf::element);
            quote!(#krate::LowerTriangle::from_packed([#(#entries),*]))
        }
        Shape::Velocity => filled(layout, StructKind::Velocity, results.of(Slot::Velocity)),
        Shape::Rates => filled(layout, StructKind::Rates, results.of(Slot::Value)),
        Shape::Derivative => derivative(layout, &results),
        Shape::Solved(_) => solved(layout, &results),
        Shape::Jump => jump(layout, &results),
        Shape::Poses => filled(layout, StructKind::Poses, results.of(Slot::Value)),
        Shape::Outputs => filled(layout, StructKind::Output, results.of(Slot::Value)),
        Shape::OutputGroup(_) => {
            let value = group(layout, kind).map(|group| groups::value(layout, group, results.of(Slot::Value)));
            quote!(#value)
        }
        Shape::Kinematics(_) => {
            let [position, velocity, acceleration] =
                [Slot::Positions, Slot::Rates, Slot::Accelerations].map(|slot| vector(layout, results.of(slot)));
            let residual = scalar(&results, Slot::Residual);
            quote! {
                #krate::Kinematics {
                    position: #position, velocity: #velocity, acceleration: #acceleration, residual: #residual
                }
            }
        }
        Shape::Assembly(_) => {
            let position = vector(layout, results.of(Slot::Positions));
            let residual = scalar(&results, Slot::Residual);
            quote!(#krate::AssemblyMode { position: #position, residual: #residual })
        }
        Shape::Derivatives(rows) => {
            let matrix = |slot, group| {
                let columns = layout.table(group).size;
                leaf::matrix(krate, rows, columns, &mut results.of(slot).iter().cloned())
            };
            let position = matrix(Slot::ByPosition, layout.displacement());
            let velocity = matrix(Slot::ByVelocity, StructKind::Velocity);
            let states = matrix(Slot::ByState, StructKind::States);
            let input = matrix(Slot::ByInput, StructKind::Input);
            quote! {
                #krate::Derivatives { position: #position, velocity: #velocity, states: #states, input: #input }
            }
        }
        Shape::Linearization(state) => {
            let sizes = layout.sizes(kind);
            let matrix =
                |slot, rows, columns| leaf::matrix(krate, rows, columns, &mut results.of(slot).iter().cloned());
            let a = matrix(Slot::StateMatrix, state, state);
            let b = matrix(Slot::InputMatrix, state, sizes.inputs);
            let c = matrix(Slot::OutputMatrix, sizes.outputs, state);
            let d = matrix(Slot::Feedthrough, sizes.outputs, sizes.inputs);
            quote!(#krate::Linearization { a: #a, b: #b, c: #c, d: #d })
        }
        Shape::Closed => {
            let state = names::ident("state");
            let residual = scalar(&results, Slot::Residual);
            let guess = filled(layout, StructKind::Guess, &layout.in_leaves(results.of(Slot::Unknowns)));
            quote!(Closed { state: State { guess: #guess, ..*#state }, residual: #residual })
        }
    }
}

/// Expands to `Derivative { v: .., q: .., x: .., multipliers: .., rank: .., residual: .. }`.
fn derivative(layout: &Layout<'_>, results: &Results<TokenStream>) -> TokenStream {
    let v = filled(layout, StructKind::Velocity, results.of(Slot::Velocity));
    let q = layout.structure.has_speeds().then(|| {
        let q = filled(layout, StructKind::Rates, results.of(Slot::Rates));
        quote!(q: #q,)
    });
    let x = layout.has_states().then(|| {
        let x = filled(layout, StructKind::States, results.of(Slot::States));
        quote!(x: #x,)
    });
    let rows = (layout.rows() > 0).then(|| {
        let multipliers = vector(layout, results.of(Slot::Multipliers));
        let rank = scalar(results, Slot::Rank);
        quote!(multipliers: #multipliers, rank: #rank,)
    });
    let residual = (layout.structure.guesses() > 0).then(|| {
        let residual = scalar(results, Slot::Residual);
        quote!(residual: #residual,)
    });
    quote!(Derivative { v: #v, #q #x #rows #residual })
}

/// Expands to `Jump { v: .., multipliers: .., rank: .. }`.
fn jump(layout: &Layout<'_>, results: &Results<TokenStream>) -> TokenStream {
    let v = filled(layout, StructKind::Velocity, results.of(Slot::Velocity));
    let multipliers = vector(layout, results.of(Slot::Multipliers));
    let rank = scalar(results, Slot::Rank);
    quote!(Jump { v: #v, multipliers: #multipliers, rank: #rank })
}

/// Expands to `{ let mut solved = *input; solved.force = ..; Solved { input: solved, rank: .. } }`.
fn solved(layout: &Layout<'_>, results: &Results<TokenStream>) -> TokenStream {
    let [input, solved] = ["input", "solved"].map(names::ident);
    let inputs = &layout.model.solve_for;
    let rank = scalar(results, Slot::Rank);
    let set = inputs.iter().zip(results.of(Slot::Inputs)).map(|(SolveFor { input, element, .. }, value)| {
        let place = layout.path_of(Symbol::Input { input: *input, element: *element });
        quote!(#solved #place = #value;)
    });
    quote! {
        let mut #solved = *#input;
        #(#set)*
        Solved { input: #solved, rank: #rank }
    }
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

/// Expands to what stands in a slot that holds one number.
fn scalar(results: &Results<TokenStream>, slot: Slot) -> TokenStream {
    let value = results.of(slot);
    quote!(#(#value)*)
}

/// Expands to `SVector::from([..])`.
fn vector(layout: &Layout<'_>, scalars: &[TokenStream]) -> TokenStream {
    let krate = layout.krate();
    if scalars.is_empty() {
        return quote!(#krate::nalgebra::SVector::zeros());
    }
    let scalars = scalars.iter().cloned().map(leaf::element);
    quote!(#krate::nalgebra::SVector::from([#(#scalars),*]))
}

/// Expands to a struct of the model from all its scalars.
pub(in crate::emit) fn filled(layout: &Layout<'_>, group: StructKind, scalars: &[TokenStream]) -> TokenStream {
    layout.construct(group, InstanceId(0), false, &mut |entry| {
        let own = scalars.iter().skip(entry.offset).take(entry.leaf.size());
        entry.leaf.build(layout.krate(), &mut own.cloned())
    })
}
