//! Stage `emit`: symbols of programs as paths into the generated structs.
//!
//! In: the layout. Out: for a symbol the tokens `q.legs[2].gimbal.first`, `params.feet[3].x`, `input.u`, `t`.

use proc_macro2::TokenStream;
use quote::quote;

use super::layout::{Entry, Group, Layout};
use super::names;
use crate::optimize::program::Symbol;

/// The variable that a symbol's path starts with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Root {
    Time,
    Params,
    Position,
    Velocity,
    States,
    Input,
    Acceleration,
}

impl Root {
    pub(super) fn of(symbol: Symbol) -> Root {
        match symbol {
            Symbol::Time => Root::Time,
            Symbol::Param { .. } => Root::Params,
            Symbol::Input { .. } => Root::Input,
            Symbol::State { .. } => Root::States,
            Symbol::Position { .. } => Root::Position,
            Symbol::Velocity { .. } => Root::Velocity,
            Symbol::Acceleration { .. } => Root::Acceleration,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Root::Time => "t",
            Root::Params => "params",
            Root::Position => "q",
            Root::Velocity => "v",
            Root::States => "x",
            Root::Input => "input",
            Root::Acceleration => "accel",
        }
    }
}

/// Names that locals of programs can't have.
pub(super) const RESERVED: &[&str] = &["t", "params", "q", "v", "x", "input", "accel", "state", "scalar"];

impl Layout<'_> {
    /// Expands to the path of `symbol`.
    pub(super) fn symbol(&self, symbol: Symbol) -> TokenStream {
        let root = names::ident(Root::of(symbol).name());
        let (entry, component) = match symbol {
            Symbol::Time => return quote!(#root),
            Symbol::Param { param, element } => (self.entry(Group::Params, param.0), element),
            Symbol::Input { input, element } => (self.entry(Group::Input, input.0), element),
            Symbol::State { state } => (self.entry(Group::States, state.0), 0),
            Symbol::Position { joint, component } => (self.joint(Group::Position, joint), component),
            Symbol::Velocity { joint, component } | Symbol::Acceleration { joint, component } => {
                (self.joint(Group::Velocity, joint), component)
            }
        };
        entry.map_or_else(
            || quote!(#root),
            |entry| {
                let (path, access) = (self.leaf_path(entry), entry.leaf.access(component));
                quote!(#root #path #access)
            },
        )
    }

    fn entry(&self, group: Group, index: usize) -> Option<&Entry> {
        self.table(group).entries.get(index)
    }
}
