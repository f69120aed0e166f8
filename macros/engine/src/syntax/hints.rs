//! Stage `syntax`: what parses as Rust but means nothing here, and what to write instead.
//!
//! In: the place where an expression can't go on. Out: one error at the user's token. All such hints stand here.

use proc_macro2::{Delimiter, Group, Span, TokenTree};
use quote::ToTokens;
use syn::Expr;

use super::cursor::{Cursor, Reported, short};
use crate::diagnostics::Diagnostics;

const LET: &str = "name intermediate results with `let name = value;`";
/// What somebody hears who writes `1,5`.
pub(super) const POINT: &str = "decimals are written with a point: `1.5`";
const SELECT: &str = "write `select(condition, a, b)`";
const ALONE: &str = "a name stands alone, such as `sin(x)` or `PI`";

/// Reports the token that stands where a value should be.
pub(super) fn no_value(cursor: &Cursor, diagnostics: &mut Diagnostics) -> Reported {
    let found = cursor.found();
    let nothing = |what: &str| format!("{what} mean nothing in an expression");
    let expected = format!("expected a value, found {found}");
    let (message, help) = match cursor.peek(0) {
        // The next item already: this one is half typed.
        Some(TokenTree::Ident(_)) if cursor.at_item(0) => (expected, None),
        Some(TokenTree::Ident(word)) => rust_word(&word.to_string()),
        Some(TokenTree::Literal(_)) => ("text means nothing in an expression".to_owned(), Some("only numbers do")),
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => (nothing("blocks"), Some(LET)),
        Some(TokenTree::Punct(punct)) => match punct.as_char() {
            '&' => (nothing("references"), Some("remove the `&`")),
            '*' => (nothing("dereferences"), Some("remove the `*`")),
            '|' => (nothing("closures"), Some(LET)),
            '+' => ("a value has no plus sign".to_owned(), Some("remove the `+`")),
            ':' if cursor.at("::") => (nothing("paths"), Some(ALONE)),
            '.' if found.starts_with("`..") => (nothing("ranges"), None),
            '\'' => (nothing("labels"), None),
            '#' => (nothing("attributes"), Some("they go before an item")),
            _ => (expected, None),
        },
        _ => (expected, None),
    };
    report(cursor, diagnostics, message, help)
}

/// Words of Rust's: they can't be names.
fn rust_word(word: &str) -> (String, Option<&'static str>) {
    let help = match word {
        "if" | "match" => Some(SELECT),
        "for" | "while" | "loop" => Some("repeated parts are written `part name: [kind; n] = |i| kind { .. };`"),
        "true" | "false" => Some("a condition compares, such as `x > 0.0`"),
        "move" | "unsafe" | "async" | "const" | "let" => Some(LET),
        "self" | "Self" | "super" | "crate" => Some(ALONE),
        "_" => return ("expected a value, found `_`".to_owned(), None),
        _ => None,
    };
    (format!("`{}` means nothing in an expression", short(word)), help)
}

/// Reports what stands behind the value `left` but is no operator here, if that is so; `false` if an expression may
/// end there.
pub(super) fn no_operator(left: &Expr, cursor: &Cursor, diagnostics: &mut Diagnostics) -> bool {
    let nothing = |what: &str| format!("{what} mean nothing in an expression");
    let operator = cursor.operator(0);
    let one = format!("`{operator}` means nothing in an expression");
    let own: String;
    let (message, help) = match operator.as_str() {
        "^" => {
            own = power(left, cursor, 1);
            (one, Some(own.as_str()))
        }
        "*" if cursor.operator(1) == "*" => {
            own = power(left, cursor, 2);
            ("`**` means nothing in an expression".to_owned(), Some(own.as_str()))
        }
        "?" => (one, Some("remove it: nothing fails")),
        "%" | "<<" | ">>" => (one, None),
        "&" => (one, Some("\"and\" is written `&&`")),
        "|" => (one, Some("\"or\" is written `||`")),
        "+=" | "-=" | "*=" | "/=" | "%=" | "^=" | "&=" | "|=" | "<<=" | ">>=" => {
            (one, Some("every name has one value: give the new one a name of its own with `let`"))
        }
        "!" => (nothing("macros"), None),
        "::" => (nothing("paths"), Some(ALONE)),
        ".." | "..=" | "..." => (nothing("ranges"), None),
        _ if cursor.at_word("as") => {
            ("`as` means nothing in an expression".to_owned(), Some("remove it: all numbers are of one type"))
        }
        _ => return false,
    };
    report(cursor, diagnostics, message, help);
    true
}

/// How a power of `left` is written; the exponent comes after `ahead` tokens.
fn power(left: &Expr, cursor: &Cursor, ahead: usize) -> String {
    let base = match left {
        Expr::Path(_) | Expr::Lit(_) => short(&left.to_token_stream().to_string()),
        _ => "v".to_owned(),
    };
    match cursor.peek(ahead).map(TokenTree::to_string) {
        Some(number) if number.parse::<i32>().is_ok() => format!("write `powi({base}, {number})`"),
        Some(number) if number.parse::<f64>().is_ok() => {
            format!("write `powf({base}, {})`", short(&number))
        }
        _ => format!("write `powi({base}, 2)`, or `powf({base}, p)` for other exponents"),
    }
}

/// Reports what stands behind a dot but is no name.
pub(super) fn no_member(cursor: &Cursor, diagnostics: &mut Diagnostics) -> Reported {
    let message = format!("expected a name after `.`, found {}", cursor.found());
    let help = cursor.literal().map(|_| "elements are written `[0]`, components `.x`, `.y` and `.z`");
    report(cursor, diagnostics, message, help)
}

/// Reports the comma in brackets that hold one value.
pub(super) fn no_tuple(group: &Group, comma: Span, diagnostics: &mut Diagnostics) -> Reported {
    let (message, help) = if group.delimiter() == Delimiter::Bracket {
        ("one index at a time", "write `a[i][j]`")
    } else {
        ("tuples mean nothing in an expression", "a vector is written `[x, y, z]`")
    };
    diagnostics.error_help(comma, message, help);
    Reported
}

/// Reports what stands behind a whole expression that should have been followed by `expected`.
pub(super) fn no_end(expected: &str, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Reported {
    let message = format!("expected {expected}, found {}", cursor.found());
    let value = matches!(cursor.peek(0), Some(TokenTree::Ident(_) | TokenTree::Literal(_)));
    let (message, help) = match cursor.operator(0).as_str() {
        _ if !expected.contains("operator") => (message, None),
        "," if matches!(cursor.peek(1), Some(TokenTree::Literal(_))) => (message, Some(POINT)),
        ";" => (message, Some("values are separated by `,`; arrays are written element by element")),
        "=" => (message, Some("to compare, write `==`")),
        _ if cursor.at_group(0, Delimiter::Brace) => {
            (message, Some("blocks and structs mean nothing in an expression"))
        }
        _ if matches!(cursor.ident(0), Some(word) if word == "deg" || word == "degrees") => {
            (message, Some("angles are in radians: write `deg(30.0)`"))
        }
        _ if value || cursor.at_group(0, Delimiter::Parenthesis) => (message, Some("a product is written with `*`")),
        _ => (message, None),
    };
    report(cursor, diagnostics, message, help)
}

fn report(cursor: &Cursor, diagnostics: &mut Diagnostics, message: String, help: Option<&str>) -> Reported {
    match help {
        Some(help) => diagnostics.error_help(cursor.span(), message, help),
        None => diagnostics.error(cursor.span(), message),
    }
    Reported
}
