//! Stage `syntax`: the models and parts of one call.
//!
//! In: all tokens of the call. Out: the tree.

use proc_macro2::{Delimiter, TokenStream};
use syn::{Attribute, Path, Visibility};

use super::cursor::Cursor;
use super::expressions::is_name;
use super::imports::Handed;
use super::items::items;
use super::tree::{Home, Module, Source};
use super::{attributes, exports, imports, link};
use crate::diagnostics::Diagnostics;

const FORM: &str = "write `pub mod name { .. }`";

/// The whole call.
pub(super) fn source(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Source {
    let mut cursor = Cursor::new(tokens);
    let runtime = runtime(&mut cursor, diagnostics);
    let fused = runtime.is_some() && fused(&mut cursor);
    let handed = if runtime.is_some() { imports::handed(&mut cursor, diagnostics) } else { Handed::default() };
    let mut source = Source {
        krate: None,
        fused,
        serialised: false,
        modules: Vec::new(),
        exports: Vec::new(),
        lost: handed.lost,
        pending: None,
    };
    let errors = diagnostics.errors().len();
    beginning(&mut source, &mut cursor, diagnostics);
    source.krate = source.krate.or(runtime);
    let uses = imports::uses(&mut cursor, &mut source.lost, diagnostics);
    if !uses.is_empty() {
        source.pending = Some(imports::pending(&source, handed.tokens, uses, cursor.rest()));
        return source;
    }
    let mut seen = false;
    while !cursor.at_end() {
        seen = true;
        if imports::late(&mut cursor, diagnostics) {
            source.lost = true;
            continue;
        }
        if let Some(semicolon) = cursor.take(";") {
            diagnostics.error_help(semicolon, "expected a model, found `;`", "remove the `;`");
            continue;
        }
        let (before, start_of_module) = (cursor.span(), cursor.position());
        let attrs = attributes::outer(&mut cursor, diagnostics);
        let vis = attributes::visibility(&mut cursor, diagnostics);
        if cursor.at_end() {
            diagnostics.error_help(before, "expected a model after this", FORM);
        } else if start(&mut cursor, diagnostics) {
            let module = module(attrs, vis, &mut cursor, diagnostics);
            source.modules.extend(module.map(|module| Module { tokens: cursor.since(start_of_module), ..module }));
        } else {
            while !cursor.at_end() && !at_module(&cursor) {
                cursor.bump();
            }
        }
    }
    if !seen && diagnostics.errors().len() == errors {
        diagnostics.error_help(cursor.span(), "there is no model here", FORM);
    }
    source.exports = exports::of(&source.modules, &handed.bundles);
    link::link(&mut source, handed.bundles, diagnostics);
    source
}

/// `@runtime($crate)`, with which the runtime's own macro says where it is, whatever name the user's crate has for it.
fn runtime(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Path> {
    let is_said = cursor.at("@") && cursor.ident(1).is_some_and(|word| word == "runtime");
    if !is_said || !cursor.at_group(2, Delimiter::Parenthesis) {
        return None;
    }
    cursor.bump();
    cursor.bump();
    let group = cursor.take_group(Delimiter::Parenthesis)?;
    attributes::crate_path(group.stream(), group.span(), diagnostics).ok()
}

/// `@fused`, which the runtime's own macro says behind where it is.
fn fused(cursor: &mut Cursor) -> bool {
    let is_said = cursor.at("@") && cursor.ident(1).is_some_and(|word| word == "fused");
    if is_said {
        cursor.bump();
        cursor.bump();
    }
    is_said
}

/// `#![krate(::mb)]`
fn beginning(source: &mut Source, cursor: &mut Cursor, diagnostics: &mut Diagnostics) {
    for attribute in attributes::inner(cursor, diagnostics) {
        let (name, span) = attributes::name(&attribute);
        if name != "krate" {
            diagnostics.error_help(
                span,
                format!("`{name}` means nothing at the beginning of the call"),
                "only `#![krate(::name)]` stands here; other attributes go before a model or item",
            );
        } else if source.krate.is_some() {
            diagnostics.error(span, "`krate` is said twice");
        } else {
            source.krate = attributes::krate(&attribute, diagnostics).ok();
        }
    }
}

/// Whether a model starts here.
fn at_module(cursor: &Cursor) -> bool {
    let name_follows = cursor.ident(1).is_some() && cursor.at_group(2, Delimiter::Brace);
    let public = cursor.at_word("pub")
        && (cursor.ident(1).is_some_and(|word| word == "mod")
            || cursor.at_group(1, Delimiter::Parenthesis) && cursor.ident(2).is_some_and(|word| word == "mod"));
    public || cursor.at_word("mod") && name_follows
}

/// Takes `mod`, or a word that stands for it.
fn start(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> bool {
    if cursor.at_word("mod") {
        cursor.bump();
        return true;
    }
    let (span, found) = (cursor.span(), cursor.found());
    // `model arm { .. }` and `pub arm { .. }`; but `body arm { .. }` is an item.
    let other_word = cursor.ident(1).is_some() && cursor.at_group(2, Delimiter::Brace) && !cursor.at_item(0);
    let no_word = cursor.ident(0).is_some_and(is_name) && cursor.at_group(1, Delimiter::Brace) && !cursor.at_item(0);
    if other_word || no_word {
        diagnostics.error_help(span, format!("expected `mod`, found {found}"), FORM);
        if other_word {
            cursor.bump();
        }
        return true;
    }
    if cursor.at_item(0) {
        diagnostics.error_help(span, "items stand inside a model", format!("{FORM} around them"));
    } else {
        diagnostics.error_help(span, format!("expected a model, found {found}"), FORM);
    }
    false
}

/// A model behind its `mod`; `None` without a name.
pub(super) fn module(
    mut attrs: Vec<Attribute>,
    vis: Visibility,
    cursor: &mut Cursor,
    diagnostics: &mut Diagnostics,
) -> Option<Module> {
    let name = cursor.ident(0).filter(|name| is_name(name)).cloned();
    if name.is_none() {
        let message = format!("expected a model's name, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, FORM);
    }
    if cursor.ident(0).is_some() {
        cursor.bump();
    }
    let Some(group) = cursor.take_group(Delimiter::Brace) else {
        if name.is_some() {
            let message = format!("expected `{{` and the model's items, found {}", cursor.found());
            diagnostics.error_help(cursor.span(), message, FORM);
        }
        while !cursor.at_end() && !at_module(cursor) {
            cursor.bump();
        }
        return name.map(|name| Module {
            attrs,
            vis,
            name,
            items: Vec::new(),
            broken: true,
            tokens: TokenStream::new(),
            home: Home::Own,
        });
    };
    let Ok(mut inner) = cursor.enter(&group, diagnostics) else {
        return None;
    };
    for attribute in attributes::inner(&mut inner, diagnostics) {
        let (name, span) = attributes::name(&attribute);
        if name == "krate" {
            diagnostics.error(span, "`krate` stands at the beginning of the call, before the first model");
        } else {
            attrs.push(attribute);
        }
    }
    // Items of a model without a name are read all the same, for their own mistakes.
    let (items, broken) = items(&mut inner, diagnostics);
    name.map(|name| Module { attrs, vis, name, items, broken, tokens: TokenStream::new(), home: Home::Own })
}
