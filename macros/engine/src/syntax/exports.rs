//! Stage `syntax`: parts that other calls may use.
//!
//! In: the modules of a call, before those of other calls are among them. Out: for each part that is not private its own tokens
//! and those of all parts that it may mean, of this call and of others.
//!
//! What a part means is told by words alone: a module whose name stands in it comes along. That may be more than is needed, and
//! never less.

use std::collections::{BTreeSet, HashMap};

use proc_macro2::{Delimiter, Ident, Literal, TokenTree};
use quote::quote;
use syn::Visibility;

use super::externals;
use super::imports::{Bundle, VERSION};
use super::tree::{Export, ItemKind, Module};

/// The kinds of parts that stand in robots' files (see the stage `robots`).
pub(crate) const URDF: &str = "Urdf";
pub(crate) const MJCF: &str = "Mjcf";
const ROBOTS: [&str; 2] = [URDF, MJCF];

/// Of all modules of a call.
pub(super) fn of(modules: &[Module], bundles: &[Bundle]) -> Vec<Export> {
    let places: HashMap<String, usize> =
        modules.iter().enumerate().map(|(index, module)| (module.name.to_string(), index)).collect();
    let mut exports = Vec::new();
    for (index, module) in modules.iter().enumerate() {
        if !is_part(module) || matches!(module.vis, Visibility::Inherited) {
            continue;
        }
        let (needed, words) = closure(index, modules, &places);
        let name = &module.name;
        let version = Literal::u32_unsuffixed(VERSION);
        let model = needed.iter().find(|&&other| !is_part(&modules[other]));
        let tokens = match model {
            Some(model) => {
                let why = format!("it asks the model `{}` of its own call", modules[*model].name);
                quote!(#version #name #why)
            }
            None if needed.iter().any(|index| reads_robot(&modules[*index], &places)) => {
                let why = "it holds a robot, whose file is read in the part's own call";
                quote!(#version #name #why)
            }
            None => {
                let bundles = bundles.iter().filter(|bundle| words.contains(&bundle.local.to_string()));
                let bundles = bundles.map(|bundle| &bundle.tokens);
                let modules = needed.iter().map(|index| externals::from_elsewhere(&modules[*index]));
                quote!(#version #name #(#bundles)* #(#modules)*)
            }
        };
        exports.push(Export { module: index, tokens });
    }
    exports
}

fn is_part(module: &Module) -> bool {
    module.items.iter().any(|item| matches!(item.kind, ItemKind::Port { .. }))
}

/// Whether a part of it stands in a robot's file: the path is that of the file which names it.
fn reads_robot(module: &Module, places: &HashMap<String, usize>) -> bool {
    let is_robot = |kind: &Ident| ROBOTS.iter().any(|robot| kind == robot && !places.contains_key(*robot));
    module.items.iter().any(|item| matches!(&item.kind, ItemKind::Part(part) if is_robot(&part.kind)))
}

/// The modules that a part may mean, in source order, and all words that stand in these. A model is meant by a call of its name
/// alone: bodies often have the names of models.
fn closure(part: usize, modules: &[Module], places: &HashMap<String, usize>) -> (BTreeSet<usize>, BTreeSet<String>) {
    let mut needed = BTreeSet::from([part]);
    let mut words = BTreeSet::new();
    let mut waiting = vec![part];
    while let Some(index) = waiting.pop() {
        let mut streams = vec![modules[index].tokens.clone()];
        while let Some(stream) = streams.pop() {
            let mut tokens = stream.into_iter().peekable();
            while let Some(token) = tokens.next() {
                let name = match token {
                    TokenTree::Group(group) => {
                        streams.push(group.stream());
                        continue;
                    }
                    TokenTree::Ident(name) => name.to_string(),
                    _ => continue,
                };
                let called = matches!(tokens.peek(), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
                if let Some(&other) = places.get(&name)
                    && (called || is_part(&modules[other]))
                    && needed.insert(other)
                {
                    waiting.push(other);
                }
                words.insert(name);
            }
        }
    }
    (needed, words)
}
