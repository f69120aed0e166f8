//! Stage `emit`: symbols of programs as paths into the generated structs.
//!
//! In: the layout. Out: for a symbol the tokens `q.legs[2].gimbal.first`, `params.feet[3].x`, `input.u`, `t`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::symbol::Symbol;
use crate::emit::names;
use crate::invariant::fault::OrFault;

use super::{Entry, Layout, StructKind};

/// The variable that a symbol's path starts with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::emit) enum Root {
    Time,
    Params,
    Position,
    Velocity,
    States,
    Guess,
    Input,
    Acceleration,
    Multipliers,
    Impulse,
    Rates,
    Momentum,
    Alternative,
}

impl Root {
    /// Nothing for what a program defines itself.
    pub(in crate::emit) fn of(symbol: Symbol) -> Option<Root> {
        Some(match symbol {
            Symbol::Time => Root::Time,
            Symbol::Param { .. } => Root::Params,
            Symbol::Input { .. } => Root::Input,
            Symbol::State { .. } => Root::States,
            Symbol::Position { .. } => Root::Position,
            Symbol::Velocity { .. } => Root::Velocity,
            Symbol::Acceleration { .. } => Root::Acceleration,
            Symbol::Multiplier { .. } => Root::Multipliers,
            Symbol::Impulse { .. } => Root::Impulse,
            Symbol::Rate { .. } => Root::Rates,
            Symbol::Momentum { .. } => Root::Momentum,
            Symbol::Alternative { .. } => Root::Alternative,
            Symbol::Guess { .. } => Root::Guess,
            Symbol::Unknown { .. } | Symbol::UnknownPoint { .. } | Symbol::Number { .. } => return None,
        })
    }

    pub(in crate::emit) fn name(self) -> &'static str {
        match self {
            Root::Time => "t",
            Root::Params => "params",
            Root::Position => "q",
            Root::Velocity => "v",
            Root::States => "x",
            Root::Guess => "guess",
            Root::Input => "input",
            Root::Acceleration => "accel",
            Root::Multipliers => "multipliers",
            Root::Impulse => "impulse",
            Root::Rates => "rates",
            Root::Momentum => "momentum",
            Root::Alternative => "alternative",
        }
    }
}

/// Names that locals of programs can't have.
pub(in crate::emit) const RESERVED: &[&str] = &[
    "t",
    "params",
    "q",
    "v",
    "x",
    "guess",
    "input",
    "accel",
    "multipliers",
    "impulse",
    "rates",
    "momentum",
    "alternative",
    "state",
    "solved",
    "scalar",
];

impl Layout<'_> {
    /// Expands to the path of `symbol`.
    pub(in crate::emit) fn symbol(&self, symbol: Symbol) -> TokenStream {
        let root = Root::of(symbol).map(|root| names::ident(root.name()));
        let path = self.path_of(symbol);
        quote!(#root #path)
    }

    /// Expands to the path behind its variable: `.legs[2].force`.
    pub(in crate::emit) fn path_of(&self, symbol: Symbol) -> TokenStream {
        let place = match symbol {
            Symbol::Time | Symbol::Unknown { .. } | Symbol::UnknownPoint { .. } | Symbol::Number { .. } => {
                return TokenStream::new();
            }
            Symbol::Multiplier { row: index } | Symbol::Rate { row: index } => {
                let index = Literal::usize_unsuffixed(index);
                return quote!([#index]);
            }
            Symbol::Alternative { component } => {
                let (field, index) = if component < 2 { ("point", component) } else { ("sides", component - 2) };
                let (field, index) = (names::ident(field), Literal::usize_unsuffixed(index));
                return quote!(.#field[#index]);
            }
            Symbol::Param { param, element } => self.entry(StructKind::Params, param.0, element),
            Symbol::Input { input, element } => self.entry(StructKind::Input, input.0, element),
            Symbol::Guess { index } => self.guessed(index),
            Symbol::State { state } => self.entry(StructKind::States, state.0, 0),
            Symbol::Position { joint, component } => self.joint(StructKind::Position, joint, component),
            Symbol::Velocity { joint, component }
            | Symbol::Acceleration { joint, component }
            | Symbol::Impulse { joint, component }
            | Symbol::Momentum { joint, component } => self.joint(StructKind::Velocity, joint, component),
        };
        let (entry, component) = place.or_fault("each symbol has a place in a struct");
        let (path, access) = (self.leaf_path(entry), entry.leaf.access(component));
        quote!(#path #access)
    }

    fn entry(&self, group: StructKind, index: usize, component: usize) -> Option<(&Entry, usize)> {
        Some((self.table(group).entries.get(index)?, component))
    }
}
