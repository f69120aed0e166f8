//! Stage `syntax`: the items of a model, one after the other.
//!
//! In: the tokens between a module's braces. Out: items in source order, and whether one was lost. A mistake inside an
//! item is reported where it stands; reading goes on at the next item.

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::{BinOp, Expr, ExprLit, Lit, Member, Type, TypePath};

use super::attributes::{outer, visibility};
use super::blocks;
use super::cursor::{Cursor, Reported};
use super::expressions::{expression, is_name};
use super::externals::external;
use super::fields::{between, fields};
use super::functions::function;
use super::keywords::Keyword;
use super::names::{finish, form, last_value, name, optional_type, unreadable};
use super::tree::{Item, ItemKind, Request, Value, poison, poison_type, poisoned, poisoned_type};
use crate::diagnostics::Diagnostics;

/// All items, and whether one was lost.
pub(super) fn items(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> (Vec<Item>, bool) {
    let mut items: Vec<Item> = Vec::new();
    let mut broken = false;
    while !cursor.at_end() {
        if cursor.at(";") {
            stray(items.last(), cursor, diagnostics);
            continue;
        }
        let before = cursor.span();
        let attrs = outer(cursor, diagnostics);
        if cursor.at_end() {
            diagnostics.error(before, "expected an item after this");
            break;
        }
        if cursor.at_word("pub") {
            diagnostics.error_help(cursor.span(), "items are as visible as their model", "remove the `pub`");
            visibility(cursor, diagnostics);
        }
        let keyword = cursor.span();
        let kind = start(cursor, diagnostics).and_then(|word| item(word, cursor, diagnostics));
        match kind {
            Some(kind) => items.push(Item { attrs, keyword, kind }),
            None => {
                broken = true;
                cursor.skip_item();
            }
        }
    }
    (items, broken)
}

/// A `;` where an item should start.
fn stray(before: Option<&Item>, cursor: &mut Cursor, diagnostics: &mut Diagnostics) {
    let block = before.is_some_and(|item| {
        matches!(
            item.kind,
            ItemKind::World(_)
                | ItemKind::Formulation(_)
                | ItemKind::Body { .. }
                | ItemKind::Joint { .. }
                | ItemKind::Force { .. }
                | ItemKind::ConstraintKind { .. }
                | ItemKind::Solve { .. }
        )
    });
    let message = if block { "an item with braces has no `;`" } else { "expected an item, found `;`" };
    diagnostics.error_help(cursor.span(), message, "remove the `;`");
    cursor.bump();
}

/// The keyword, taken; the one that was meant if it is misspelt.
fn start(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Keyword> {
    let span = cursor.span();
    let found = cursor.found();
    let Some(TokenTree::Ident(word)) = cursor.bump() else {
        diagnostics.error_help(span, format!("expected an item, found {found}"), starts());
        return None;
    };
    if let Some(keyword) = Keyword::of(&word) {
        return Some(keyword);
    }
    if word == "mod" {
        let help = "declare it beside this one; `part name: kind { .. };` uses it";
        diagnostics.error_help(span, "models don't stand inside one another", help);
        return None;
    }
    if word == "use" {
        let help = "parts of other calls are used at the head of the call, before the first model";
        diagnostics.error_help(span, "`use` doesn't stand inside a model", help);
        return None;
    }
    let message = format!("unknown item {found}");
    if let Some(keyword) = Keyword::meant_by(&word) {
        diagnostics.error_help(span, message, form(keyword));
        return None;
    }
    match Keyword::near(&word) {
        Some(keyword) => {
            diagnostics.error_help(span, message, format!("did you mean `{}`?", keyword.word()));
            Some(keyword)
        }
        None => {
            diagnostics.error_help(span, message, starts());
            None
        }
    }
}

fn starts() -> String {
    format!("an item starts with one of {}", Keyword::list())
}

/// The item behind its keyword; `None` if it is lost.
fn item(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    match keyword {
        Keyword::Const => value(keyword, cursor, diagnostics).map(ItemKind::Const),
        Keyword::Param => value(keyword, cursor, diagnostics).map(ItemKind::Param),
        Keyword::Input => value(keyword, cursor, diagnostics).map(ItemKind::Input),
        Keyword::Let => binding(cursor, diagnostics),
        Keyword::Extern => external(cursor, diagnostics).map(ItemKind::External),
        Keyword::Output => value(keyword, cursor, diagnostics).map(ItemKind::Output),
        Keyword::State => state(cursor, diagnostics),
        Keyword::Port => port(cursor, diagnostics),
        Keyword::World => Some(ItemKind::World(blocks::unnamed(keyword, cursor, diagnostics))),
        Keyword::Formulation => Some(ItemKind::Formulation(blocks::unnamed(keyword, cursor, diagnostics))),
        Keyword::Body => blocks::body(cursor, diagnostics),
        Keyword::Joint => blocks::kinded(keyword, cursor, diagnostics).map(|(name, kind, fields)| ItemKind::Joint {
            name,
            kind,
            fields,
        }),
        Keyword::Force => blocks::kinded(keyword, cursor, diagnostics).map(|(name, kind, fields)| ItemKind::Force {
            name,
            kind,
            fields,
        }),
        Keyword::Constraint => blocks::constraint(cursor, diagnostics),
        Keyword::Speed => value(keyword, cursor, diagnostics).map(ItemKind::Speed),
        Keyword::Drive => Some(drive(cursor, diagnostics)),
        Keyword::Solve => blocks::solve(cursor, diagnostics),
        Keyword::Simplify => simplify(cursor, diagnostics),
        Keyword::Assume => Some(ItemKind::Assume(last_value(cursor, diagnostics))),
        Keyword::Part => blocks::part(cursor, diagnostics),
        Keyword::Emit => emit(cursor, diagnostics),
    }
}

/// `name: Ty = value;` or `name(x, y) = value;`
fn binding(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let name = name(Keyword::Let, cursor, diagnostics).ok()?;
    match cursor.take_group(Delimiter::Parenthesis) {
        Some(parameters) => Some(ItemKind::Function(function(name, &parameters, cursor, diagnostics))),
        None => value_of(Keyword::Let, name, cursor, diagnostics).map(ItemKind::Let),
    }
}

/// `name: Ty = value;`
fn value(keyword: Keyword, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Value> {
    let name = name(keyword, cursor, diagnostics).ok()?;
    value_of(keyword, name, cursor, diagnostics)
}

/// `: Ty = value;`
fn value_of(keyword: Keyword, name: Ident, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<Value> {
    let ty = optional_type(cursor, diagnostics);
    let valued = keyword != Keyword::Input;
    if let Some(equals) = cursor.take("=") {
        let value = last_value(cursor, diagnostics);
        if !valued {
            let help = "a `param` has a value, an `input` gets one with every call";
            diagnostics.error_help(equals, "an `input` has no value", help);
        }
        return Some(Value { name, ty, value: valued.then_some(value) });
    }
    if !valued {
        // The input is valid whatever comes behind.
        let _ = finish(Ok(()), "`;`", cursor, diagnostics);
    } else if cursor.at(";") || cursor.at_end() || cursor.at_item(0) {
        // `param name: 1.0;` is one mistake.
        if !ty.as_ref().is_some_and(poisoned_type) {
            let message = format!("`{} {name}` has no value", keyword.word());
            diagnostics.error_help(name.span(), message, form(keyword));
        }
        cursor.take(";");
    } else {
        let message = format!("expected `=`, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form(keyword));
        cursor.skip_item();
        // `output tip: hand.position;`: what stands there is a value, so no type is looked for.
        return Some(Value { name, ty: ty.map(|_| poison_type()), value: valued.then(poison) });
    }
    Some(Value { name, ty, value: valued.then(poison) })
}

/// `name: rate = value, start: value;`
fn state(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let keyword = Keyword::State;
    let name = name(keyword, cursor, diagnostics).ok()?;
    let mut expect = |found: bool, what: &str, cursor: &mut Cursor| {
        if !found {
            let message = format!("expected {what}, found {}", cursor.found());
            diagnostics.error_help(cursor.span(), message, form(keyword));
            cursor.skip_item();
        }
        found
    };
    let lost = |name| Some(ItemKind::State { name, rate: poison(), start: Some(poison()) });
    let colon = cursor.take(":").is_some();
    if !expect(colon, "`:`", cursor) || !expect(cursor.at_word("rate"), "`rate`", cursor) {
        return lost(name);
    }
    cursor.bump();
    let equals = cursor.take("=").is_some();
    if !expect(equals, "`=`", cursor) {
        return lost(name);
    }
    let rate = expression(cursor, diagnostics).unwrap_or_else(|Reported| {
        cursor.skip_within_item(&[","]);
        poison()
    });
    if cursor.at_word("start") && cursor.operator(1) == ":" {
        diagnostics.error(cursor.span(), "missing `,` before `start`");
    } else if cursor.take(",").is_none() || cursor.at(";") {
        let end = finish(Ok(rate), "an operator, `,` or `;`", cursor, diagnostics);
        // Where the end can't be read, a start may have been lost.
        let start = end.is_err().then(poison);
        return Some(ItemKind::State { name, rate: end.unwrap_or_else(|Reported| poison()), start });
    }
    if !cursor.at_word("start") || cursor.operator(1) != ":" {
        let message = format!("expected `start:`, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form(keyword));
        cursor.skip_item();
        return Some(ItemKind::State { name, rate, start: Some(poison()) });
    }
    cursor.bump();
    cursor.take(":");
    let start = expression(cursor, diagnostics);
    if start.is_ok() {
        cursor.take(",");
    }
    let start = finish(start, "an operator or `;`", cursor, diagnostics).unwrap_or_else(|Reported| poison());
    Some(ItemKind::State { name, rate, start: Some(start) })
}

/// `name: Frame;`
fn port(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let keyword = Keyword::Port;
    let name = name(keyword, cursor, diagnostics).ok()?;
    let colon = cursor.take(":").is_some();
    let ty = cursor.ident(0).filter(|ty| colon && is_name(ty)).filter(|_| !cursor.at_item(0)).cloned();
    let Some(ty) = ty else {
        let expected = if colon { "`Frame`" } else { "`: Frame`" };
        let message = format!("expected {expected}, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, form(keyword));
        let ty = unreadable(cursor.span());
        cursor.skip_item();
        return Some(port_of(name, ty));
    };
    cursor.bump();
    // The port is valid whatever comes behind.
    let _ = finish(Ok(()), "`;`", cursor, diagnostics);
    Some(port_of(name, ty))
}

fn port_of(name: Ident, ty: Ident) -> ItemKind {
    let written = Type::Path(TypePath { attrs: Vec::new(), qself: None, path: ty.clone().into() });
    let signal = Value { name: name.clone(), ty: Some(written), value: None };
    ItemKind::Port { name, ty, signal }
}

/// `target = value;`
fn drive(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> ItemKind {
    let target = expression(cursor, diagnostics).and_then(|target| {
        if cursor.at("=") {
            return Ok(target);
        }
        let doubled = match &target {
            Expr::Binary(comparison) => match comparison.op {
                BinOp::Eq(equals) => equals.spans.first().copied(),
                _ => None,
            },
            _ => None,
        };
        let (span, found) = doubled.map_or_else(|| (cursor.span(), cursor.found()), |span| (span, "`==`".to_owned()));
        diagnostics.error_help(span, format!("expected `=`, found {found}"), form(Keyword::Drive));
        Err(Reported)
    });
    let Ok(target) = target else {
        cursor.skip_item();
        return ItemKind::Drive { target: poison(), value: poison() };
    };
    cursor.take("=");
    let value = last_value(cursor, diagnostics);
    ItemKind::Drive { target, value }
}

/// `hinge == 0.0;`, `current.rate == 0.0;`, `small(hinge);`
fn simplify(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    const FORMS: &str = "write `simplify hinge == 0.0;`, `simplify current.rate == 0.0;` or `simplify small(hinge);`";
    let at = cursor.span();
    match last_value(cursor, diagnostics) {
        Expr::Call(call) if matches!(&*call.func, Expr::Path(path) if path.path.is_ident("small")) => {
            if call.args.is_empty() {
                diagnostics.error_help(at, "nothing is said to be small", FORMS);
                return None;
            }
            Some(ItemKind::Small(call.args.into_iter().collect()))
        }
        Expr::Binary(binary) if matches!(binary.op, BinOp::Eq(_)) => match *binary.left {
            Expr::Field(field) if matches!(&field.member, Member::Named(name) if name == "rate") => {
                if !is_zero(&binary.right) {
                    diagnostics.error_help(at, "a rate is left out where it is zero", FORMS);
                    return None;
                }
                Some(ItemKind::Settled(*field.base))
            }
            // What is held at a value follows a course that does not move.
            target => Some(ItemKind::Drive { target, value: *binary.right }),
        },
        expr if poisoned(&expr) => None,
        _ => {
            diagnostics.error_help(at, "nothing here can be left out", FORMS);
            None
        }
    }
}

fn is_zero(expr: &Expr) -> bool {
    match expr {
        Expr::Lit(ExprLit { lit: Lit::Int(int), .. }) => int.base10_digits() == "0",
        Expr::Lit(ExprLit { lit: Lit::Float(float), .. }) => float.base10_parse::<f64>().is_ok_and(|x| x == 0.0),
        _ => false,
    }
}

/// `a, b { field: value };`
fn emit(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Option<ItemKind> {
    let mut requests = Vec::new();
    loop {
        let name = cursor.ident(0).filter(|name| is_name(name)).filter(|_| !cursor.at_item(0)).cloned();
        let Some(name) = name else {
            let message = format!("expected the name of a function, found {}", cursor.found());
            diagnostics.error_help(cursor.span(), message, form(Keyword::Emit));
            cursor.skip_item();
            break;
        };
        cursor.bump();
        let options = cursor.group(0).cloned().map(|group| {
            if group.delimiter() == Delimiter::Brace {
                cursor.bump();
                between(&group, cursor, diagnostics)
            } else {
                fields("options stand in braces".to_owned(), cursor, diagnostics)
            }
        });
        requests.push(Request { name, options });
        let comma = cursor.take(",").is_some();
        if !comma || cursor.at(";") {
            let end = finish(Ok(()), "`,` or `;`", cursor, diagnostics);
            if end.is_err() {
                break;
            }
            return Some(ItemKind::Emit(requests));
        }
    }
    // What was asked for is known in part: better than nothing, which would mean the default.
    Some(ItemKind::Emit(requests))
}
