//! Stage `syntax`: the small things that items are made of.
//!
//! In: tokens inside an item. Out: names, kinds and types; the `;` at the end.

use proc_macro2::{Delimiter, Ident, Span};
use syn::{Expr, Token, Type, token};

use super::cursor::{Cursor, Read, Reported};
use super::expressions::{expression, is_name};
use super::hints;
use super::keywords::Keyword;
use super::tree::{UNREADABLE, poison, poison_type};
use crate::diagnostics::Diagnostics;

/// `write ..`, for an item.
pub(super) fn form(keyword: Keyword) -> String {
    match keyword {
        Keyword::Constraint => format!("write `{}` or `constraint name: Rod {{ .. }}`", keyword.form()),
        _ => format!("write `{}`", keyword.form()),
    }
}

/// The name behind a keyword.
pub(super) fn name(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Ident> {
    if let Some(word) = cursor.ident(0).filter(|word| *word == "mut").cloned() {
        diagnostics.error_help(word.span(), "nothing is ever assigned anew here", "remove the `mut`");
        cursor.bump();
    }
    match cursor.ident(0).cloned() {
        Some(name) if is_name(&name) && !cursor.at_item(0) => {
            cursor.bump();
            Ok(name)
        }
        Some(word) if word != "_" && !cursor.at_item(0) => {
            diagnostics.error_help(word.span(), format!("`{word}` is a word of Rust's"), "choose another name");
            Err(Reported)
        }
        _ => {
            let message = format!("expected a name after `{}`, found {}", keyword.word(), cursor.found());
            diagnostics.error_help(cursor.span(), message, form(keyword));
            Err(Reported)
        }
    }
}

/// `: Kind`, up to the braces.
pub(super) fn kind(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Ident {
    let colon = cursor.take(":");
    match cursor.ident(0).cloned() {
        Some(kind) if is_name(&kind) && !cursor.at_item(0) => {
            if colon.is_none() {
                let message = format!("expected `:` before the kind, found `{kind}`");
                diagnostics.error_help(kind.span(), message, form(keyword));
            }
            cursor.bump();
            kind
        }
        _ => {
            let message = match colon {
                Some(_) => format!("expected a kind after `:`, found {}", cursor.found()),
                None => format!("expected `:` and a kind, found {}", cursor.found()),
            };
            diagnostics.error_help(cursor.span(), message, form(keyword));
            unreadable(cursor.span())
        }
    }
}

/// Stands for a kind that has been reported.
pub(super) fn unreadable(span: Span) -> Ident {
    Ident::new(UNREADABLE, span)
}

/// `: Ty`, if it is there; poisoned if it can't be read.
pub(super) fn optional_type(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Type> {
    cursor.take(":")?;
    let read = ty(cursor, diagnostics).and_then(|ty| match cursor.operator(0).as_str() {
        "::" | "<" => {
            diagnostics.error(cursor.span(), "a type is one name here, such as `Scalar` or `Vec3`");
            Err(Reported)
        }
        _ => Ok(ty),
    });
    Some(read.unwrap_or_else(|Reported| {
        cursor.skip_within_item(&["="]);
        poison_type()
    }))
}

/// One name, or `[Ty; count]`.
fn ty(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Type> {
    if let Some(name) = cursor.ident(0).filter(|name| is_name(name)).cloned() {
        cursor.bump();
        return Ok(Type::Path(syn::TypePath { attrs: Vec::new(), qself: None, path: name.into() }));
    }
    let Some(group) = cursor.take_group(Delimiter::Bracket) else {
        let message = format!("expected a type, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, "types are `Scalar`, `Vec3` and arrays such as `[Scalar; 6]`");
        return Err(Reported);
    };
    let mut inner = cursor.enter(&group, diagnostics)?;
    let elem = Box::new(ty(&mut inner, diagnostics)?);
    let (semi, len) = count(&mut inner, diagnostics)?;
    let bracket_token = token::Bracket { span: group.delim_span() };
    Ok(Type::Array(syn::TypeArray { attrs: Vec::new(), bracket_token, elem, semi_token: Token![;](semi), len }))
}

/// `; count` at the end of an array's type.
pub(super) fn count(inner: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<(Span, Expr)> {
    let Some(semi) = inner.take(";") else {
        let message = format!("expected `;` and the number of elements, found {}", inner.found());
        diagnostics.error(inner.span(), message);
        return Err(Reported);
    };
    let count = expression(inner, diagnostics)?;
    if !inner.at_end() {
        return Err(hints::no_end("an operator or `]`", inner, diagnostics));
    }
    Ok((semi, count))
}

/// `value;` at the end of an item; poisoned if it can't be read.
pub(super) fn last_value(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Expr {
    let value = expression(cursor, diagnostics);
    finish(value, "an operator or `;`", cursor, diagnostics).unwrap_or_else(|Reported| poison())
}

/// The `;` at the end of an item of which `read` came last. Only a missing `;` leaves `read` valid.
pub(super) fn finish<T>(read: Read<T>, expected: &str, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<T> {
    let result = read.and_then(|read| {
        if cursor.take(";").is_some() {
            return Ok(read);
        }
        if cursor.at_end() || cursor.at_item(0) {
            diagnostics.error(cursor.last_span(), "missing `;` at the end of this item");
            return Ok(read);
        }
        Err(hints::no_end(expected, cursor, diagnostics))
    });
    if result.is_err() {
        cursor.skip_item();
    }
    result
}
