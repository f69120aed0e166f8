//! Stage `model`: parts that other calls may use, as they are documented.
//!
//! In: the syntax tree of a call. Out: of each part that is not private its tokens, from `syntax/exports`, and what a reader wants
//! to know of it.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use syn::Visibility;

use crate::syntax::tree::{self, ItemKind, UNREADABLE};

use super::docs;
use super::types::Docs;

/// A part of this call that other calls may use.
pub struct Export {
    pub name: Ident,
    pub vis: Visibility,
    pub docs: Docs,
    /// In source order.
    pub items: Vec<Shown>,
    /// What `@part(..)` says of it.
    pub tokens: TokenStream,
}

/// An item of a part that matters to those who use it.
pub struct Shown {
    /// `port`, `param`, ..
    pub keyword: &'static str,
    pub name: String,
    /// The type of a port, the kind of a joint.
    pub kind: Option<String>,
    /// Of a param.
    pub default: Option<String>,
    pub docs: Docs,
}

/// Of a whole call; where that `has_mistakes`, without the parts' own tokens.
pub fn of(source: &tree::Source, has_mistakes: bool) -> Vec<Export> {
    let exports = source.exports.iter().filter_map(|export| {
        let module = source.modules.get(export.module)?;
        Some(Export {
            name: module.name.clone(),
            vis: module.vis.clone(),
            docs: docs::docs(&module.attrs),
            items: module.items.iter().filter_map(shown).collect(),
            tokens: if has_mistakes { export.withheld() } else { export.tokens.clone() },
        })
    });
    exports.collect()
}

fn shown(item: &tree::Item) -> Option<Shown> {
    let of = |keyword, name: &Ident, kind: Option<&Ident>, default| {
        let kind = kind.map(Ident::to_string);
        Shown { keyword, name: name.to_string(), kind, default, docs: docs::docs(&item.attrs) }
    };
    let shown = match &item.kind {
        ItemKind::Port { name, ty, .. } => of("port", name, Some(ty), None),
        ItemKind::Param(value) => {
            let default = value.value.as_ref().map(|expr| expr.to_token_stream().to_string());
            of("param", &value.name, None, default)
        }
        ItemKind::Input(value) => of("input", &value.name, None, None),
        ItemKind::State { name, .. } => of("state", name, None, None),
        ItemKind::Body { name, .. } => of("body", name, None, None),
        ItemKind::Joint { name, kind, .. } => of("joint", name, Some(kind), None),
        ItemKind::Part(part) => of("part", &part.name, Some(&part.kind), None),
        ItemKind::Speed(value) => of("speed", &value.name, None, None),
        ItemKind::Output(value) => of("output", &value.name, None, None),
        _ => return None,
    };
    (shown.name != UNREADABLE).then_some(shown)
}
