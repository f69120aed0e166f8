//! Stage `emit`: identifiers of generated code.
//!
//! In: names from the model and from programs. Out: identifiers that are valid, unique where they must be, and resolve
//! at the macro (`mixed_site`), so that no name of the user's can capture one of ours. What the user named keeps the
//! place of the user's token, for editors and error messages, but counts as generated: lints about unread fields or
//! capital letters don't fire on it.

use std::collections::HashSet;

use proc_macro2::{Ident, Span};
use syn::ext::IdentExt;

use crate::rust_keywords::is_keyword;

use super::references::for_an_editor;

/// An identifier for generated code; what can't be one is mended.
pub(super) fn ident(name: &str) -> Ident {
    Ident::new(&valid(name), Span::mixed_site())
}

/// The user's identifier, at the user's place.
pub(super) fn field(user: &Ident) -> Ident {
    let mut ident = user.clone();
    ident.set_span(place_of(user.span()));
    ident
}

/// A place of the user's for what is generated. To an editor it is the user's token itself: of others it shows the macro too, and
/// renames none; it has no lints.
fn place_of(user: Span) -> Span {
    if for_an_editor() { user } else { Span::mixed_site().located_at(user) }
}

/// A name made from the user's, at the user's place.
pub(super) fn derived(user: &Ident, name: &str) -> Ident {
    at(user.span(), name)
}

/// A name of ours at a place of the user's.
pub(super) fn at(place: Span, name: &str) -> Ident {
    Ident::new(&valid(name), place_of(place))
}

/// The user's name as text, without `r#`.
pub(super) fn plain(user: &Ident) -> String {
    user.unraw().to_string()
}

/// One identifier per name, all different, none of them in `reserved`.
pub(super) fn unique<'a>(names: impl IntoIterator<Item = &'a str>, reserved: &[&str]) -> Vec<Ident> {
    let mut taken: HashSet<String> = reserved.iter().map(|name| (*name).to_string()).collect();
    let mut idents = Vec::new();
    for name in names {
        let base = valid(name);
        let mut candidate = base.clone();
        let mut number = 1;
        while !taken.insert(candidate.clone()) {
            number += 1;
            candidate = format!("{base}_{number}");
        }
        idents.push(Ident::new(&candidate, Span::mixed_site()));
    }
    idents
}

/// `name` itself where it is an identifier, else the nearest one.
fn valid(name: &str) -> String {
    if name != "_" && is_keyword(name) {
        return format!("{name}_");
    }
    let start = |c: char| c == '_' || c.is_ascii_alphabetic();
    let ascii = name.starts_with(start) && name.chars().all(|c| start(c) || c.is_ascii_digit());
    if name != "_" && (ascii || syn::parse_str::<Ident>(name).is_ok()) {
        return name.to_string();
    }
    let letters = |c: char| {
        if start(c) || c.is_ascii_digit() { c } else { '_' }
    };
    format!("n_{}", name.chars().map(letters).collect::<String>())
}
