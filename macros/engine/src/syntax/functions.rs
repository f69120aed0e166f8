//! Stage `syntax`: functions of the user's own, `let name(x, y) = value;`.
//!
//! In: the name, the parentheses, and the tokens behind them. Out: the function; where its head can't be read the value
//! is poisoned, so nothing more is said about calls of it.

use proc_macro2::{Group, Ident};

use super::cursor::{Cursor, Read, Reported};
use super::expressions::is_name;
use super::names::last_value;
use super::tree::{Function, poison};
use crate::diagnostics::Diagnostics;

const FORM: &str = "write `let name(x, y) = value;`";

/// What stands behind `let name`.
pub(super) fn function(name: Ident, head: &Group, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Function {
    let read = cursor.enter(head, diagnostics).and_then(|mut inner| {
        let empty = format!("without any it is a value: `let {name} = value;`");
        parameters(&mut inner, &empty, FORM, diagnostics)
    });
    if cursor.take("=").is_none() {
        // A head with mistakes has been reported; what comes behind it may belong to the same mistake.
        if read.is_ok() {
            let message = format!("expected `=`, found {}", cursor.found());
            diagnostics.error_help(cursor.span(), message, FORM);
        }
        cursor.skip_item();
        return Function { name, parameters: Vec::new(), value: poison() };
    }
    let value = last_value(cursor, diagnostics);
    match read {
        Ok(parameters) => Function { name, parameters, value },
        Err(Reported) => Function { name, parameters: Vec::new(), value: poison() },
    }
}

/// `x, y`; `empty` is what helps where there are none, `form` where something else stands.
pub(super) fn parameters(
    inner: &mut Cursor,
    empty: &str,
    form: &str,
    diagnostics: &mut Diagnostics,
) -> Read<Vec<Ident>> {
    if inner.at_end() {
        diagnostics.error_help(inner.last_span(), "a function has arguments", empty);
        return Err(Reported);
    }
    let mut parameters = Vec::new();
    while !inner.at_end() {
        let Some(name) = inner.ident(0).filter(|name| is_name(name)).cloned() else {
            let message = format!("expected the name of an argument, found {}", inner.found());
            diagnostics.error_help(inner.span(), message, form);
            return Err(Reported);
        };
        inner.bump();
        parameters.push(name);
        if inner.at(":") {
            let help = "an argument has the type of what is given, and so has the value";
            diagnostics.error_help(inner.span(), "types of arguments are not written", help);
            return Err(Reported);
        }
        if inner.take(",").is_none() && !inner.at_end() {
            let message = format!("expected `,` or `)`, found {}", inner.found());
            diagnostics.error_help(inner.span(), message, form);
            return Err(Reported);
        }
    }
    Ok(parameters)
}
