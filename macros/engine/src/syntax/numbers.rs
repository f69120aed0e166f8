//! Stage `syntax`: numbers.
//!
//! In: a literal. Out: a finite number without a suffix.

use proc_macro2::{Literal, TokenTree};
use syn::Lit;

use super::cursor::{Cursor, Read, Reported, short};
use super::hints;
use crate::diagnostics::Diagnostics;

/// Digits of one number. More can't matter in `f64`, and syn needs quadratic time.
const LONGEST: usize = 800;

/// The number that comes next; not taken.
pub(super) fn number(literal: &Literal, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Read<Lit> {
    let text = literal.to_string();
    if !text.starts_with(|first: char| first.is_ascii_digit() || first == '-') {
        return Err(hints::no_value(cursor, diagnostics));
    }
    if text.len() > LONGEST {
        diagnostics.error(literal.span(), format!("this number has more than {LONGEST} digits"));
        return Err(Reported);
    }
    let lit = syn::parse2::<Lit>(TokenTree::Literal(literal.clone()).into());
    let (digits, suffix) = match &lit {
        Ok(Lit::Int(int)) => (int.base10_digits().to_owned(), int.suffix().to_owned()),
        Ok(Lit::Float(float)) => (float.base10_digits().to_owned(), float.suffix().to_owned()),
        _ => Default::default(),
    };
    if !suffix.is_empty() {
        let plain = text.strip_suffix(&suffix).unwrap_or(&digits).trim_end_matches('_');
        let (message, help) = match suffix.as_str() {
            "deg" | "degrees" => ("a number has no suffix here".to_owned(), format!("write `deg({})`", short(plain))),
            _ => {
                let message = format!("a number has no suffix here: remove `{}`", short(&suffix));
                let sized = suffix.ends_with(|last: char| last.is_ascii_digit());
                let name = if matches!(lit, Ok(Lit::Int(_))) && !sized { "; a name begins with a letter" } else { "" };
                (message, format!("write `{}`{name}", short(plain)))
            }
        };
        diagnostics.error_help(literal.span(), message, help);
        return Err(Reported);
    }
    let message = match (lit, digits.parse::<f64>()) {
        (Ok(lit), Ok(value)) if value.is_finite() => return Ok(lit),
        (Ok(_), Ok(_)) => "this number is too large for `f64`".to_owned(),
        _ => format!("`{}` is not a number", short(&text)),
    };
    diagnostics.error(literal.span(), message);
    Err(Reported)
}
