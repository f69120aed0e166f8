//! Stage `syntax`: nodes of expressions, put together.
//!
//! In: parts and their tokens. Out: the `syn::Expr`, boxed. These functions are apart from the parser so that its own
//! recursion needs little stack: in a build without optimisation every local of this size keeps a place of its own.

use proc_macro2::{Group, Ident, Span};
use syn::punctuated::Punctuated;
use syn::{BinOp, Expr, Lit, Member, Token, UnOp, token};

/// Between brackets, with commas.
pub(super) type Elements = Punctuated<Expr, Token![,]>;

/// A number or a text.
pub(super) fn literal(lit: Lit) -> Box<Expr> {
    Box::new(Expr::Lit(syn::ExprLit { attrs: Vec::new(), lit }))
}

/// One name.
pub(super) fn name(name: Ident) -> Box<Expr> {
    Box::new(Expr::Path(syn::ExprPath { attrs: Vec::new(), qself: None, path: name.into() }))
}

/// `func(args)`
pub(super) fn call(func: Box<Expr>, group: &Group, args: Elements) -> Box<Expr> {
    let paren_token = token::Paren { span: group.delim_span() };
    Box::new(Expr::Call(syn::ExprCall { attrs: Vec::new(), func, paren_token, args }))
}

/// `(expr)`
pub(super) fn paren(group: &Group, expr: Box<Expr>) -> Box<Expr> {
    let paren_token = token::Paren { span: group.delim_span() };
    Box::new(Expr::Paren(syn::ExprParen { attrs: Vec::new(), paren_token, expr }))
}

/// `[elems]`
pub(super) fn array(group: &Group, elems: Elements) -> Box<Expr> {
    let bracket_token = token::Bracket { span: group.delim_span() };
    Box::new(Expr::Array(syn::ExprArray { attrs: Vec::new(), bracket_token, elems }))
}

/// `expr[index]`
pub(super) fn index(expr: Box<Expr>, group: &Group, index: Box<Expr>) -> Box<Expr> {
    let bracket_token = token::Bracket { span: group.delim_span() };
    Box::new(Expr::Index(syn::ExprIndex { attrs: Vec::new(), expr, bracket_token, index }))
}

/// `a, b` between brackets.
pub(super) fn pair(group: &Group, elems: Elements) -> Box<Expr> {
    let paren_token = token::Paren { span: group.delim_span() };
    Box::new(Expr::Tuple(syn::ExprTuple { attrs: Vec::new(), paren_token, elems }))
}

/// `name = value`
pub(super) fn named(left: Box<Expr>, equals: Span, right: Box<Expr>) -> Box<Expr> {
    Box::new(Expr::Assign(syn::ExprAssign { attrs: Vec::new(), left, eq_token: Token![=](equals), right }))
}

/// `base.name`
pub(super) fn field(base: Box<Expr>, dot: Span, name: Ident) -> Box<Expr> {
    let (dot_token, member) = (Token![.](dot), Member::Named(name));
    Box::new(Expr::Field(syn::ExprField { attrs: Vec::new(), base, dot_token, member }))
}

/// `receiver.method(args)`
pub(super) fn method(receiver: Box<Expr>, dot: Span, method: Ident, group: &Group, args: Elements) -> Box<Expr> {
    Box::new(Expr::MethodCall(syn::ExprMethodCall {
        attrs: Vec::new(),
        receiver,
        dot_token: Token![.](dot),
        method,
        turbofish: None,
        paren_token: token::Paren { span: group.delim_span() },
        args,
    }))
}

/// `-expr` or `!expr`
pub(super) fn unary(op: UnOp, expr: Box<Expr>) -> Box<Expr> {
    Box::new(Expr::Unary(syn::ExprUnary { attrs: Vec::new(), op, expr }))
}

/// `left op right`
pub(super) fn binary(left: Box<Expr>, op: BinOp, right: Box<Expr>) -> Box<Expr> {
    Box::new(Expr::Binary(syn::ExprBinary { attrs: Vec::new(), left, op, right }))
}

/// The operator that is written so, and how tightly it binds; `None` if it stands between no two values.
pub(super) fn operator(text: &str, first: Span, second: Span) -> Option<(BinOp, usize)> {
    let both = [first, second];
    Some(match text {
        "*" => (BinOp::Mul(Token![*](first)), 5),
        "/" => (BinOp::Div(Token![/](first)), 5),
        "+" => (BinOp::Add(Token![+](first)), 4),
        "-" => (BinOp::Sub(Token![-](first)), 4),
        "<" => (BinOp::Lt(Token![<](first)), COMPARISON),
        ">" => (BinOp::Gt(Token![>](first)), COMPARISON),
        "<=" => (BinOp::Le(Token![<=](both)), COMPARISON),
        ">=" => (BinOp::Ge(Token![>=](both)), COMPARISON),
        "==" => (BinOp::Eq(Token![==](both)), COMPARISON),
        "!=" => (BinOp::Ne(Token![!=](both)), COMPARISON),
        "&&" => (BinOp::And(Token![&&](both)), 2),
        "||" => (BinOp::Or(Token![||](both)), 1),
        _ => return None,
    })
}

/// How tightly comparisons bind; two of them in a row are no expression.
pub(super) const COMPARISON: usize = 3;
