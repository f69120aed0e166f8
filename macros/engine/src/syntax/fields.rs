//! Stage `syntax`: `{ name: value, .. }`.
//!
//! In: the place of the braces. Out: fields in source order. A field that can't be read costs only itself.

use proc_macro2::{Delimiter, Group, TokenTree};
use syn::{Expr, Lit};

use super::build;
use super::cursor::{Cursor, Reported};
use super::expressions::{expression, is_name};
use super::hints;
use super::tree::{Field, Fields, poison};
use crate::diagnostics::Diagnostics;

/// The braces that must come next; `form` says how the whole item is written.
pub(super) fn fields(form: String, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Fields {
    if let Some(group) = cursor.take_group(Delimiter::Brace) {
        return between(&group, cursor, diagnostics);
    }
    let found = cursor.found();
    if let Some(group) = cursor.group(0).cloned() {
        diagnostics.error_help(cursor.span(), format!("expected `{{`, found {found}"), form);
        cursor.bump();
        if named(&group) {
            return between(&group, cursor, diagnostics);
        }
        // Values by position: said once.
        return Fields::none(group.span());
    }
    diagnostics.error_help(cursor.span(), format!("expected `{{`, found {found}"), form);
    lost(cursor)
}

/// Whether the first of what a group holds is written `name: ..`.
fn named(group: &Group) -> bool {
    let mut tokens = group.stream().into_iter();
    let name = tokens.next();
    let colon = tokens.next();
    matches!(name, Some(TokenTree::Ident(_)))
        && matches!(colon, Some(TokenTree::Punct(punct)) if punct.as_char() == ':')
}

/// Fields of an item whose braces are unreadable or missing; goes on behind them.
pub(super) fn lost(cursor: &mut Cursor) -> Fields {
    let span = cursor.last_span();
    cursor.skip_item();
    Fields::none(span)
}

/// The fields in a group.
pub(super) fn between(group: &Group, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Fields {
    let mut fields = Fields { span: group.span(), list: Vec::new(), broken: false };
    let Ok(mut inner) = cursor.enter(group, diagnostics) else {
        fields.broken = true;
        return fields;
    };
    while !inner.at_end() {
        match field(fields.list.last(), &mut inner, diagnostics) {
            Ok(field) => fields.list.push(field),
            Err(Reported) => {
                fields.broken = true;
                inner.skip_to(&[","]);
                inner.take(",");
            }
        }
    }
    fields
}

/// One field and what separates it from the next; `before` is the one before it.
fn field(before: Option<&Field>, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Result<Field, Reported> {
    const FORM: &str = "a field is written `name: value`";
    if cursor.at("#") && cursor.at_group(1, Delimiter::Bracket) {
        diagnostics.error_help(
            cursor.span(),
            "documentation and attributes go before items, not before fields",
            "write a comment with `//`",
        );
        while cursor.at("#") && cursor.at_group(1, Delimiter::Bracket) {
            cursor.bump();
            cursor.bump();
        }
    }
    let Some(name) = cursor.ident(0).filter(|name| is_name(name)).cloned() else {
        let message = format!("expected a field, found {}", cursor.found());
        let digits = cursor.literal().is_some() && before.is_some_and(|before| matches!(before.value, Expr::Lit(_)));
        let help = match digits {
            _ if cursor.at("..") => "fields left out have the defaults of the documentation",
            true => hints::POINT,
            false => FORM,
        };
        diagnostics.error_help(cursor.span(), message, help);
        return Err(Reported);
    };
    cursor.bump();
    if cursor.at_end() || cursor.at(",") {
        let message = format!("field `{name}` has no value");
        diagnostics.error_help(name.span(), message, format!("write `{name}: value`"));
        cursor.take(",");
        return Ok(Field { name, value: poison() });
    }
    if cursor.take(":").is_none() {
        let message = format!("expected `:` after `{name}`, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, FORM);
        if cursor.take("=").is_none() {
            cursor.skip_to(&[","]);
            cursor.take(",");
            return Ok(Field { name, value: poison() });
        }
    }
    let text = if name == "file" { text(cursor) } else { None };
    let value = text.map_or_else(|| expression(cursor, diagnostics), Ok).and_then(|value| {
        let next_field = cursor.ident(0).is_some() && cursor.operator(1) == ":";
        if cursor.at_end() || cursor.take(",").is_some() {
            Ok(value)
        } else if next_field {
            diagnostics.error(cursor.span(), format!("missing `,` before {}", cursor.found()));
            Ok(value)
        } else if cursor.at(";") {
            diagnostics.error(cursor.span(), "fields are separated by `,`, not by `;`");
            cursor.take(";");
            Ok(value)
        } else {
            Err(hints::no_end("an operator or `,`", cursor, diagnostics))
        }
    });
    let value = value.unwrap_or_else(|Reported| {
        cursor.skip_to(&[","]);
        cursor.take(",");
        poison()
    });
    Ok(Field { name, value })
}

/// A text in quotation marks, which only names a file.
fn text(cursor: &mut Cursor) -> Option<Expr> {
    let literal = cursor.literal()?.clone();
    let lit = syn::parse2::<Lit>(TokenTree::Literal(literal).into()).ok()?;
    if !matches!(lit, Lit::Str(_)) {
        return None;
    }
    cursor.bump();
    Some(*build::literal(lit))
}
