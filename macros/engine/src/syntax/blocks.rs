//! Stage `syntax`: items with braces, and `part` and `solve`, which may have them.
//!
//! In: tokens behind the keyword. Out: the item; `None` where not even a name could be read.

use proc_macro2::{Delimiter, Ident};

use super::cursor::{Cursor, Read, Reported};
use super::expressions::{expression, is_name, list};
use super::fields::{fields, lost};
use super::keywords::Keyword;
use super::names::{count, finish, form, kind, last_value, name, unreadable};
use super::tree::{Fields, ItemKind, Part, Solution, UNREADABLE, poison};
use crate::diagnostics::Diagnostics;

/// `{ .. }`: `world` and `formulation` have no name.
pub(super) fn unnamed(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Fields {
    if let (Some(name), true) = (cursor.ident(0).cloned(), cursor.at_group(1, Delimiter::Brace)) {
        diagnostics.error_help(name.span(), format!("`{}` has no name", keyword.word()), form(keyword));
        cursor.bump();
    }
    block(keyword, cursor, diagnostics)
}

/// The braces of an item that ends with them. What stands in other brackets may have a `;` behind.
fn block(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Fields {
    let fields = fields(form(keyword), cursor, diagnostics);
    if fields.broken && fields.list.is_empty() {
        cursor.take(";");
    }
    fields
}

/// `name { .. }`
pub(super) fn body(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let keyword = Keyword::Body;
    let name = name(keyword, cursor, diagnostics).ok()?;
    if let Some(colon) = cursor.take(":") {
        diagnostics.error_help(colon, "a body has no kind", form(keyword));
        if cursor.at_group(1, Delimiter::Brace) {
            cursor.bump();
        }
    }
    let fields = block(keyword, cursor, diagnostics);
    Some(ItemKind::Body { name, fields })
}

/// `name: Kind { .. }`
pub(super) fn kinded(
    keyword: Keyword,
    cursor: &mut Cursor,
    diagnostics: &mut Diagnostics,
) -> Option<(Ident, Ident, Fields)> {
    let name = name(keyword, cursor, diagnostics).ok()?;
    let kind = kind(keyword, cursor, diagnostics);
    // One error is enough for `joint elbow;`, and for `joint elbow { type: Revolute, .. }`.
    let fields = match (kind == UNREADABLE, cursor.at_group(0, Delimiter::Brace)) {
        (true, false) => lost(cursor),
        (true, true) => block(keyword, cursor, &mut Diagnostics::default()),
        (false, _) => block(keyword, cursor, diagnostics),
    };
    Some((name, kind, fields))
}

/// `name = value;` or `name: Kind { .. }`
pub(super) fn constraint(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let keyword = Keyword::Constraint;
    let value_follows = cursor.operator(1) == "=";
    if !value_follows {
        let (name, kind, fields) = kinded(keyword, cursor, diagnostics)?;
        return Some(ItemKind::ConstraintKind { name, kind, fields });
    }
    let name = name(keyword, cursor, diagnostics).ok()?;
    cursor.take("=");
    let value = last_value(cursor, diagnostics);
    Some(ItemKind::ConstraintValue { name, value })
}

const ARRAY: &str = "write `part name: [kind; n] = |i| kind { port: frame };`";

/// `name: kind { .. };` or `name: [kind; n] = |i| kind { .. };`
pub(super) fn part(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let keyword = Keyword::Part;
    let name = name(keyword, cursor, diagnostics).ok()?;
    if !cursor.at_group(1, Delimiter::Bracket) {
        let kind = kind(keyword, cursor, diagnostics);
        let fields = part_fields(&kind, form(keyword), cursor, diagnostics);
        return Some(ItemKind::Part(Part { name, kind, count: None, index: None, again: None, fields }));
    }
    if cursor.take(":").is_none() {
        diagnostics.error_help(cursor.span(), format!("expected `:`, found {}", cursor.found()), ARRAY);
        cursor.bump();
    }
    let (kind, count) = array(cursor, diagnostics);
    let ((index, again), fields) = match element(&kind, cursor, diagnostics) {
        Ok(element) => (element, part_fields(&kind, ARRAY.to_owned(), cursor, diagnostics)),
        Err(Reported) => ((None, None), lost(cursor)),
    };
    Some(ItemKind::Part(Part { name, kind, count: Some(count), index, again, fields }))
}

/// `= |i| kind`: the index, and the kind as it stands here.
fn element(kind: &Ident, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<(Option<Ident>, Option<Ident>)> {
    let mut wrong = |expected: &str, cursor: &Cursor| {
        let message = format!("expected {expected}, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, ARRAY);
        Reported
    };
    cursor.take("=").ok_or_else(|| wrong("`=`", cursor))?;
    let mut index = None;
    if cursor.at("||") || cursor.take("|").is_some() {
        index = cursor.ident(0).filter(|name| is_name(name) || *name == "_").cloned();
        if index.is_none() {
            return Err(wrong("the name of an index", cursor));
        }
        cursor.bump();
        cursor.take("|").ok_or_else(|| wrong("`|`", cursor))?;
    }
    let again = cursor.ident(0).cloned();
    if again.as_ref() != Some(kind) && kind != UNREADABLE {
        let reported = wrong(&format!("`{kind}` again"), cursor);
        if again.is_none() || !cursor.at_group(1, Delimiter::Brace) {
            return Err(reported);
        }
    }
    if again.is_some() {
        cursor.bump();
    }
    Ok((index.filter(|index| index != "_"), again))
}

/// `[kind; n]`, which is known to come next.
fn array(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> (Ident, syn::Expr) {
    let span = cursor.span();
    let Some(group) = cursor.take_group(Delimiter::Bracket) else {
        return (unreadable(span), poison());
    };
    let Ok(mut inner) = cursor.enter(&group, diagnostics) else {
        return (unreadable(span), poison());
    };
    let Some(kind) = inner.ident(0).filter(|name| is_name(name)).cloned() else {
        let message = format!("expected the name of a part, found {}", inner.found());
        diagnostics.error_help(inner.span(), message, ARRAY);
        return (unreadable(span), poison());
    };
    inner.bump();
    let count = count(&mut inner, diagnostics).map_or_else(|Reported| poison(), |(_, count)| count);
    (kind, count)
}

/// `{ .. };`
fn part_fields(kind: &Ident, form: String, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Fields {
    if !cursor.at_group(0, Delimiter::Brace) {
        // One error is enough for `part legs: 6;`.
        return if kind == UNREADABLE { lost(cursor) } else { fields(form, cursor, diagnostics) };
    }
    let fields = fields(form, cursor, diagnostics);
    // What stands in the braces is valid whatever comes behind.
    let _ = finish(Ok(()), "`;`", cursor, diagnostics);
    fields
}

/// `(unknowns) = (formulas);`, `(unknowns) from joint { branches }` or `(unknowns) from (joint, joint) { branches }`
pub(super) fn solve(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    const FORMULAS: &str = "write `solve (a, b) = (formula, formula);`";
    const EQUATIONS: &str = "write `solve (x) from a * x == b;`";
    let unknowns = parenthesised("the unknowns", &form(Keyword::Solve), cursor, diagnostics)?;
    if cursor.take("=").is_some() {
        let formulas = parenthesised("the formulas", FORMULAS, cursor, diagnostics);
        let read = formulas.ok_or(Reported);
        let formulas = finish(read, "`;`", cursor, diagnostics).ok()?;
        return Some(ItemKind::Solve { unknowns, how: Solution::Formulas(formulas) });
    }
    if !cursor.at_word("from") {
        let message = format!("expected `=` or `from`, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, format!("{}, or {FORMULAS}", form(Keyword::Solve)));
        return None;
    }
    cursor.bump();
    // No operand of an equation: loops that are solved together.
    let several =
        cursor.at_group(0, Delimiter::Parenthesis) && cursor.punct(1).is_none_or(|punct| punct.as_char() == ';');
    let closings = match several {
        true => parenthesised("what closes the loops", &form(Keyword::Solve), cursor, diagnostics)?,
        false => vec![expression(cursor, diagnostics).ok()?],
    };
    let equations = if let ([one], false) = (&closings[..], several) { equations(one) } else { None };
    if let Some(equations) = &equations
        && !cursor.at_group(0, Delimiter::Brace)
    {
        finish(Ok(()), "an operator, `;` or conditions in braces", cursor, diagnostics).ok()?;
        return Some(ItemKind::System { unknowns, equations: equations.clone(), branches: Vec::new() });
    }
    if cursor.at("=") {
        diagnostics.error_help(cursor.span(), "an equation is written with `==`", EQUATIONS);
        return None;
    }
    let Some(group) = cursor.take_group(Delimiter::Brace) else {
        let message = format!("expected `{{` and the conditions that choose a branch, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form(Keyword::Solve));
        return None;
    };
    let branches = match cursor.enter(&group, diagnostics) {
        Ok(mut inner) => list(&mut inner, diagnostics),
        Err(Reported) => vec![poison()],
    };
    Some(match equations {
        Some(equations) => ItemKind::System { unknowns, equations, branches },
        None => ItemKind::Solve { unknowns, how: Solution::From { closings, branches } },
    })
}

/// `a == b`, or several in brackets.
fn equations(expr: &syn::Expr) -> Option<Vec<syn::Expr>> {
    let is_equation =
        |expr: &syn::Expr| matches!(expr, syn::Expr::Binary(binary) if matches!(binary.op, syn::BinOp::Eq(_)));
    match expr {
        syn::Expr::Array(array) if !array.elems.is_empty() && array.elems.iter().all(is_equation) => {
            Some(array.elems.iter().cloned().collect())
        }
        expr if is_equation(expr) => Some(vec![expr.clone()]),
        _ => None,
    }
}

/// `(a, b)`
fn parenthesised(what: &str, form: &str, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Vec<syn::Expr>> {
    let Some(group) = cursor.take_group(Delimiter::Parenthesis) else {
        diagnostics.error_help(cursor.span(), format!("expected `(` and {what}, found {}", cursor.found()), form);
        return None;
    };
    match cursor.enter(&group, diagnostics) {
        Ok(inner) if inner.at_end() => {
            diagnostics.error_help(cursor.last_span(), format!("expected {what}, found `)`"), form);
            None
        }
        Ok(mut inner) => Some(list(&mut inner, diagnostics)),
        Err(Reported) => None,
    }
}
