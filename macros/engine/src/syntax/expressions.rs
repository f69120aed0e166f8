//! Stage `syntax`: expressions.
//!
//! In: tokens. Out: `syn::Expr` of these kinds and no others: `Lit` (numbers), `Path` (one name), `Field`, `Index`,
//! `Call` of a name, `MethodCall`, `Unary` (`-`, `!`), `Binary` (`+ - * /`, comparisons, `&&`, `||`), `Paren`, `Array`; and
//! `Assign` (`name = value`) among the arguments of a call, `Tuple` as the index of `mass_matrix`. They bind as in Rust. All
//! else is refused at its token, with a hint.
//!
//! syn's own parser is not used: it fails whole at the first mistake, would have its result checked once more, and
//! recurses without a bound, as does dropping what it returns.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenTree};
use syn::{BinOp, Expr, Token, UnOp};

use super::build::{self, COMPARISON, Elements};
use super::cursor::{Cursor, Read, Reported};
use super::hints;
use super::numbers::number;
use super::tree::poison;
use crate::diagnostics::Diagnostics;

/// Operators within operators are read to this depth, so that every stage may recurse into the result.
const HIGHEST: usize = 256;

/// An expression and the number of levels in it.
struct Node {
    expr: Box<Expr>,
    height: usize,
}

/// An expression, up to the first token that can't belong to it.
pub(super) fn expression(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Expr> {
    node(cursor, diagnostics).map(|node| *node.expr)
}

/// What is between brackets, with commas. Elements that can't be read are poisoned.
pub(super) fn list(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Vec<Expr> {
    let (nodes, _) = nodes(whole, cursor, diagnostics);
    nodes.into_iter().map(|node| node.map_or_else(|Reported| poison(), |node| *node.expr)).collect()
}

/// A word that Rust doesn't keep for itself.
pub(super) fn is_name(word: &Ident) -> bool {
    syn::parse2::<Ident>(TokenTree::Ident(word.clone()).into()).is_ok()
}

/// Operators wait in `pending` with their left side until one comes that binds no tighter; no recursion.
fn node(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let mut pending: Vec<(Node, Operator)> = Vec::new();
    let mut current = operand(cursor, diagnostics)?;
    while let Some(next) = operator(&current.expr, cursor, diagnostics)? {
        current = reduce(&mut pending, current, Some(&next), diagnostics)?;
        pending.push((current, next));
        current = operand(cursor, diagnostics)?;
    }
    reduce(&mut pending, current, None, diagnostics)
}

/// An operator between two values.
struct Operator {
    symbol: BinOp,
    /// The higher, the tighter it binds.
    strength: usize,
    span: Span,
}

/// Applies the waiting operators that bind as tightly as `next`.
fn reduce(
    pending: &mut Vec<(Node, Operator)>,
    mut current: Node,
    next: Option<&Operator>,
    diagnostics: &mut Diagnostics,
) -> Read<Node> {
    let strength = next.map_or(0, |next| next.strength);
    while let Some((left, waiting)) = pending.pop_if(|(_, waiting)| waiting.strength >= strength) {
        if let Some(next) = next
            && strength == COMPARISON
            && waiting.strength == COMPARISON
        {
            diagnostics.error_help(next.span, "comparisons can't be chained", "write `a < b && b < c`");
            return Err(Reported);
        }
        let height = left.height.max(current.height);
        let expr = build::binary(left.expr, waiting.symbol, current.expr);
        current = grown(expr, height, waiting.span, diagnostics)?;
    }
    Ok(current)
}

/// One level higher, if that is allowed.
fn grown(expr: Box<Expr>, height: usize, span: Span, diagnostics: &mut Diagnostics) -> Read<Node> {
    if height < HIGHEST {
        return Ok(Node { expr, height: height + 1 });
    }
    let message = format!("this expression has more than {HIGHEST} operators in a row");
    diagnostics.error_help(span, message, "name parts of it with `let`");
    Err(Reported)
}

/// The operator that comes next, taken; `None` where the expression ends.
fn operator(left: &Expr, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Option<Operator>> {
    if hints::no_operator(left, cursor, diagnostics) {
        return Err(Reported);
    }
    let text = cursor.operator(0);
    let span = cursor.span();
    let second = cursor.punct(1).map_or(span, |punct| punct.span());
    let Some((symbol, strength)) = build::operator(&text, span, second) else {
        return Ok(None);
    };
    cursor.take(&text);
    Ok(Some(Operator { symbol, strength, span }))
}

/// Signs, a value, and what is taken from it: `-a.b[c].d(e)`.
fn operand(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let signs = signs(cursor);
    let mut current = value(cursor, diagnostics)?;
    loop {
        let span = cursor.span();
        if cursor.take(".").is_some() {
            current = member(current, span, cursor, diagnostics)?;
        } else if let Some(group) = cursor.take_group(Delimiter::Bracket) {
            let index = index(&current.expr, &group, cursor, diagnostics)?;
            let height = current.height.max(index.height);
            current = grown(build::index(current.expr, &group, index.expr), height, span, diagnostics)?;
        } else {
            break;
        }
    }
    for (op, span) in signs.into_iter().rev() {
        current = grown(build::unary(op, current.expr), current.height, span, diagnostics)?;
    }
    Ok(current)
}

/// `-` and `!` before a value.
fn signs(cursor: &mut Cursor) -> Vec<(UnOp, Span)> {
    let mut signs = Vec::new();
    loop {
        let span = cursor.span();
        match cursor.operator(0).as_str() {
            "-" => signs.push((UnOp::Neg(Token![-](span)), span)),
            "!" => signs.push((UnOp::Not(Token![!](span)), span)),
            _ => return signs,
        }
        cursor.bump();
    }
}

/// A number, a name, a call, or something in brackets.
fn value(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    if let Some(group) = cursor.take_group(Delimiter::Parenthesis) {
        let inner = only(&group, cursor, diagnostics)?;
        return grown(build::paren(&group, inner.expr), inner.height, group.span_open(), diagnostics);
    }
    if let Some(group) = cursor.take_group(Delimiter::Bracket) {
        let (elements, height) = elements(&group, cursor, diagnostics)?;
        return grown(build::array(&group, elements), height, group.span_open(), diagnostics);
    }
    let leaf = leaf(cursor, diagnostics)?;
    if !matches!(*leaf.expr, Expr::Path(_)) {
        return Ok(leaf);
    }
    let Some(group) = cursor.take_group(Delimiter::Parenthesis) else {
        return Ok(leaf);
    };
    let (arguments, height) = elements_of(named, &group, cursor, diagnostics)?;
    grown(build::call(leaf.expr, &group, arguments), height, group.span_open(), diagnostics)
}

/// Whether this is the one word.
fn is_word(expr: &Expr, word: &str) -> bool {
    matches!(expr, Expr::Path(path) if path.path.is_ident(word))
}

/// What stands between the brackets behind `base`: one value, or the two indices of a matrix.
fn index(base: &Expr, group: &Group, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    if !["mass_matrix", "jacobian"].iter().any(|word| is_word(base, word)) {
        return only(group, cursor, diagnostics);
    }
    let (indices, height) = elements(group, cursor, diagnostics)?;
    if indices.is_empty() {
        return only(group, cursor, diagnostics);
    }
    Ok(Node { expr: build::pair(group, indices), height })
}

/// A number or name.
fn leaf(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let expr = match cursor.peek(0) {
        Some(TokenTree::Literal(literal)) => build::literal(number(literal, cursor, diagnostics)?),
        Some(TokenTree::Ident(word)) if is_name(word) && !cursor.at_item(0) => build::name(word.clone()),
        _ => return Err(hints::no_value(cursor, diagnostics)),
    };
    cursor.bump();
    Ok(Node { expr, height: 1 })
}

/// `.name` or `.name(arguments)`, behind the dot.
fn member(left: Node, dot: Span, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let Some(name) = cursor.ident(0).filter(|name| is_name(name)).cloned() else {
        return Err(hints::no_member(cursor, diagnostics));
    };
    cursor.bump();
    let Some(group) = cursor.take_group(Delimiter::Parenthesis) else {
        return grown(build::field(left.expr, dot, name), left.height, dot, diagnostics);
    };
    let (arguments, height) = elements(&group, cursor, diagnostics)?;
    let height = left.height.max(height);
    grown(build::method(left.expr, dot, name, &group, arguments), height, dot, diagnostics)
}

/// The one expression that a group holds.
fn only(group: &Group, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let mut inner = cursor.enter(group, diagnostics)?;
    if inner.at_end() {
        diagnostics.error(group.span_open(), "expected a value between these brackets");
        return Err(Reported);
    }
    let node = whole(&mut inner, diagnostics);
    match inner.take(",") {
        Some(comma) => Err(hints::no_tuple(group, comma, diagnostics)),
        None => node,
    }
}

/// Reads one element.
type Element = fn(&mut Cursor, &mut Diagnostics) -> Read<Node>;

/// All expressions between brackets and the height of the highest; all of them are read, then the first error counts.
fn elements(group: &Group, cursor: &Cursor, diagnostics: &mut Diagnostics) -> Read<(Elements, usize)> {
    elements_of(whole, group, cursor, diagnostics)
}

fn elements_of(
    element: Element,
    group: &Group,
    cursor: &Cursor,
    diagnostics: &mut Diagnostics,
) -> Read<(Elements, usize)> {
    let mut inner = cursor.enter(group, diagnostics)?;
    let (nodes, complete) = nodes(element, &mut inner, diagnostics);
    complete?;
    let mut elements = Elements::new();
    let mut height = 0;
    for node in nodes {
        let node = node?;
        height = height.max(node.height);
        elements.push(*node.expr);
    }
    Ok((elements, height))
}

/// Expressions with commas between them, each readable or not, and whether nothing else stood there.
fn nodes(element: Element, cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> (Vec<Read<Node>>, Read<()>) {
    let mut nodes = Vec::new();
    let mut complete = Ok(());
    while !cursor.at_end() {
        if cursor.at(",") {
            diagnostics.error(cursor.span(), "expected a value, found `,`");
            complete = Err(Reported);
        } else {
            nodes.push(element(cursor, diagnostics));
        }
        cursor.take(",");
    }
    (nodes, complete)
}

/// An expression up to a `,` or the end; whatever else is there is reported and skipped.
fn whole(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let mut result = node(cursor, diagnostics);
    if result.is_ok() && !cursor.at_end() && !cursor.at(",") {
        result = Err(hints::no_end("an operator or `,`", cursor, diagnostics));
    }
    cursor.skip_to(&[","]);
    result
}

/// A value, or `name = value`.
fn named(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Node> {
    let mut left = node(cursor, diagnostics);
    let equals = cursor.span();
    if left.is_ok() && cursor.take("=").is_some() {
        let right = whole(cursor, diagnostics)?;
        let left = left?;
        let height = left.height.max(right.height);
        return grown(build::named(left.expr, equals, right.expr), height, equals, diagnostics);
    }
    if left.is_ok() && !cursor.at_end() && !cursor.at(",") {
        left = Err(hints::no_end("an operator or `,`", cursor, diagnostics));
    }
    cursor.skip_to(&[","]);
    left
}
