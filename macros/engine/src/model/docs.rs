//! Stage `model`: documentation and waivers from the attributes of items.
//!
//! In: attributes as written. Out: `Docs` with the unit taken out of the text.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Attribute, Expr, ExprLit, Lit, Meta};

use super::report::Report;
use super::types::Docs;

/// What the attributes of one item say.
#[derive(Default)]
pub(super) struct Attributes {
    pub(super) docs: Docs,
    /// `#[allow(unphysical_inertia)]`
    pub(super) unphysical_inertia: Option<Span>,
    /// `#[cut]`
    pub(super) cut: Option<Span>,
}

/// Documentation only: for places where other attributes are passed on untouched.
pub(super) fn docs(attrs: &[Attribute]) -> Docs {
    let mut docs = Docs::default();
    for attr in attrs {
        let Meta::NameValue(pair) = &attr.meta else {
            continue;
        };
        let Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) = &pair.value else {
            continue;
        };
        if pair.path.is_ident("doc") {
            docs.text.extend(text.value().split('\n').map(str::to_string));
        }
    }
    take_unit(&mut docs);
    docs
}

/// Reads the attributes of an item; refuses those that mean nothing here.
pub(super) fn attributes(attrs: &[Attribute], report: &mut Report<'_>) -> Attributes {
    let mut found = Attributes { docs: docs(attrs), ..Attributes::default() };
    for attr in attrs {
        let path = attr.path();
        if path.is_ident("doc") {
            continue;
        }
        if path.is_ident("cut") {
            found.cut = Some(path.span());
        } else if path.is_ident("allow") {
            match attr.parse_args::<syn::Ident>() {
                Ok(name) if name == "unphysical_inertia" => {
                    found.unphysical_inertia = Some(name.span());
                }
                Ok(name) => report.unknown(
                    name.span(),
                    format!("`{name}` cannot be allowed here"),
                    &name.to_string(),
                    ["unphysical_inertia"],
                    None,
                ),
                Err(_) => report.help(path.span(), "`allow` takes one name", "write `#[allow(unphysical_inertia)]`"),
            }
        } else if path.is_ident("cfg") {
            report.help(path.span(), "`cfg` stands on a whole model, not on an item", "write it above `mod`");
        } else if is_derive(attr) {
            refuse_derive(attr, report);
        } else {
            report.help(
                path.span(),
                "this attribute means nothing here",
                "items take `///` text, `#[cut]` and `#[allow(unphysical_inertia)]`",
            );
        }
    }
    found
}

/// `#[derive(..)]`, `#[serde(..)]`
pub(super) fn is_derive(attr: &Attribute) -> bool {
    attr.path().is_ident("derive") || attr.path().is_ident("serde")
}

/// Nothing can be derived for the generated structs.
pub(super) fn refuse_derive(attr: &Attribute, report: &mut Report<'_>) {
    report.help(
        attr.path().span(),
        "generated structs take no attributes: they have `Clone`, `Copy`, `Debug`, `Default` and `PartialEq`",
        "to store them turn on the feature `serde` of `multibody`: then all of them have `Serialize` and `Deserialize` too",
    );
}

/// A leading `[kg]` is the unit.
fn take_unit(docs: &mut Docs) {
    let Some(first) = docs.text.first_mut() else {
        return;
    };
    let Some((unit, rest)) = first.trim_start().strip_prefix('[').and_then(|text| text.split_once(']')) else {
        return;
    };
    // `[name](link)` and `[name][link]` are Markdown, not a unit.
    if rest.starts_with(['(', '[']) || unit.is_empty() {
        return;
    }
    docs.unit = Some(unit.trim().to_string());
    let rest = rest.to_string();
    *first = rest;
    if docs.text.len() == 1 && docs.text.iter().all(|line| line.trim().is_empty()) {
        docs.text.clear();
    }
}
