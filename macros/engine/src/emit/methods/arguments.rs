//! Stage `emit`: what a method of `Model` takes besides `&self`.
//!
//! In: a function's kind and the variables that its program reads. Out: the fewest arguments that both allow, declared and
//! taken apart.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::contracts::function::{Arguments, FunctionKind};
use crate::emit::layout::places::Root;
use crate::emit::layout::{Layout, StructKind};
use crate::emit::names;

use super::results::vector_type;

impl Arguments {
    /// The fewest that the function's meaning and its program allow: a spring may stiffen with time, an input shift it.
    pub(in crate::emit) fn of(kind: FunctionKind, roots: &BTreeSet<Root>) -> Arguments {
        let mut needed = kind.row().takes;
        for root in roots {
            match root {
                Root::Params | Root::Position | Root::Impulse | Root::Rates | Root::Momentum | Root::Alternative => {}
                Root::Velocity | Root::States | Root::Guess => needed.state = true,
                Root::Time if needed.time => {}
                Root::Time if needed.impulse || needed.rates => needed.time = true,
                Root::Acceleration if needed.accel => {}
                Root::Multipliers => needed.multipliers = true,
                Root::Time | Root::Input | Root::Acceleration => {
                    needed = Arguments { time: true, state: true, input: true, ..needed };
                    needed.accel |= *root == Root::Acceleration;
                }
            }
        }
        needed
    }

    /// Expands to `t: T, state: &State<T>, input: &Input<T>`; names of what isn't read start with `_`.
    pub(in crate::emit) fn declare(self, layout: &Layout<'_>, roots: &BTreeSet<Root>) -> TokenStream {
        self.declared(layout, roots, None)
    }

    /// Those of which something is read; a state or position stays.
    pub(in crate::emit) fn read(self, roots: &BTreeSet<Root>) -> Arguments {
        let reads = |root| roots.contains(&root);
        Arguments {
            time: self.time && reads(Root::Time),
            state: self.state,
            input: self.input && reads(Root::Input),
            accel: self.accel && reads(Root::Acceleration),
            multipliers: self.multipliers && reads(Root::Multipliers),
            impulse: self.impulse && reads(Root::Impulse),
            rates: (self.rates || self.impulse) && reads(Root::Rates),
            momentum: self.momentum && reads(Root::Momentum),
            alternative: self.alternative && reads(Root::Alternative),
        }
    }

    /// The same, none of it read, with `A` for the type of the state or position: of a method that can't be called.
    pub(in crate::emit) fn refused(self, layout: &Layout<'_>) -> TokenStream {
        self.declared(layout, &BTreeSet::new(), Some(quote!(A)))
    }

    /// What a function of what `Model::at` gives takes: what its meaning demands beside the position, and what its program reads.
    pub(in crate::emit) fn declare_at(self, layout: &Layout<'_>, roots: &BTreeSet<Root>) -> TokenStream {
        let v = named(roots.contains(&Root::Velocity), "v");
        let v = self.state.then(|| quote!(#v: &Velocity<T>,));
        let input = named(roots.contains(&Root::Input), "input");
        let has_inputs = !layout.is_empty(StructKind::Input, None);
        let input = (self.input && has_inputs).then(|| quote!(#input: &Input<T>,));
        let others = self.others(layout, roots).into_iter().map(|(name, ty)| quote!(#name: #ty));
        quote!(#v #input #(#others),*)
    }

    fn declared(self, layout: &Layout<'_>, roots: &BTreeSet<Root>, refused: Option<TokenStream>) -> TokenStream {
        let list = self.each(layout, roots, refused).into_iter().map(|(name, ty)| quote!(#name: #ty));
        quote!(#(#list),*)
    }

    /// Names of the arguments, for a call by a function that has the same.
    pub(in crate::emit) fn handed_on(self, layout: &Layout<'_>, roots: &BTreeSet<Root>) -> Vec<Ident> {
        self.each(layout, roots, None).into_iter().map(|argument| argument.0).collect()
    }

    /// Names and types.
    fn each(
        self,
        layout: &Layout<'_>,
        roots: &BTreeSet<Root>,
        refused: Option<TokenStream>,
    ) -> Vec<(Ident, TokenStream)> {
        let mut list = Vec::new();
        if self.time {
            let t = named(roots.contains(&Root::Time), "t");
            list.push((t, quote!(T)));
        }
        if self.state {
            let state = named(OF_STATE.iter().any(|root| roots.contains(root)), "state");
            let ty = refused.unwrap_or_else(|| quote!(State<T>));
            list.push((state, quote!(&#ty)));
        } else {
            let q = named(roots.contains(&Root::Position), "q");
            let ty = refused.unwrap_or_else(|| quote!(Position<T>));
            list.push((q, quote!(&#ty)));
        }
        if self.input {
            let (input, ty) = (named(roots.contains(&Root::Input), "input"), input_type(layout));
            list.push((input, quote!(&#ty)));
        }
        list.extend(self.others(layout, roots));
        list
    }

    /// What comes behind the state and the input.
    fn others(self, layout: &Layout<'_>, roots: &BTreeSet<Root>) -> Vec<(Ident, TokenStream)> {
        let krate = layout.krate();
        let mut list = Vec::new();
        if self.accel {
            let accel = named(roots.contains(&Root::Acceleration), "accel");
            list.push((accel, quote!(&Velocity<T>)));
        }
        if self.multipliers {
            let multipliers = named(roots.contains(&Root::Multipliers), "multipliers");
            let count = Literal::usize_unsuffixed(layout.structure.rows.len());
            list.push((multipliers, quote!(&#krate::nalgebra::SVector<T, #count>)));
        }
        if self.impulse {
            let impulse = named(roots.contains(&Root::Impulse), "impulse");
            list.push((impulse, quote!(&Velocity<T>)));
        }
        if (self.impulse || self.rates) && layout.rows() > 0 {
            let rates = named(roots.contains(&Root::Rates), "rates");
            let ty = vector_type(layout, layout.rows());
            list.push((rates, quote!(&#ty)));
        }
        if self.momentum {
            let momentum = named(roots.contains(&Root::Momentum), "momentum");
            list.push((momentum, quote!(&Velocity<T>)));
        }
        if self.alternative {
            let alternative = named(roots.contains(&Root::Alternative), "alternative");
            list.push((alternative, quote!(&#krate::assembly::Alternative<T>)));
        }
        list
    }

    /// Expands to `let q = &state.q;` for the parts of the state that are read.
    pub(in crate::emit) fn open(self, roots: &BTreeSet<Root>) -> TokenStream {
        if !self.state {
            return TokenStream::new();
        }
        let state = names::ident("state");
        let parts = OF_STATE.iter().filter(|root| roots.contains(root));
        let parts = parts.map(|root| names::ident(root.name()));
        quote!(#(let #parts = &#state.#parts;)*)
    }

    /// Expands to the arguments of a call from where all of `t`, `state` and `input` are known.
    pub(in crate::emit) fn pass(self) -> TokenStream {
        let [t, state, input] = ["t", "state", "input"].map(names::ident);
        let (t, input) = (self.time.then(|| quote!(#t,)), self.input.then(|| quote!(, #input)));
        quote!(#t #state #input)
    }

    /// The same where the function may take the position alone: from where `t` and `state` are known.
    pub(in crate::emit) fn pass_state(self) -> TokenStream {
        let [t, state] = ["t", "state"].map(names::ident);
        let t = self.time.then(|| quote!(#t,));
        if self.state { quote!(#t #state) } else { quote!(#t &#state.q) }
    }

    pub(in crate::emit) fn has_time(self) -> bool {
        self.time
    }

    /// Whether it takes the state, and not its position alone.
    pub(in crate::emit) fn has_state(self) -> bool {
        self.state
    }

    pub(in crate::emit) fn has_input(self) -> bool {
        self.input
    }
}

/// A name, with `_` in front where nothing reads it.
fn named(read: bool, name: &str) -> Ident {
    names::ident(&format!("{}{name}", if read { "" } else { "_" }))
}

const OF_STATE: [Root; 4] = [Root::Position, Root::Velocity, Root::States, Root::Guess];

/// Expands to `Input<T>` or `()`.
pub(in crate::emit) fn input_type(layout: &Layout<'_>) -> TokenStream {
    if layout.is_empty(StructKind::Input, None) { quote!(()) } else { quote!(Input<T>) }
}
