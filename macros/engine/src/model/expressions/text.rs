//! Stage `model`: expressions as messages quote them.
//!
//! In: `syn` expressions. Out: short text.

use syn::{Expr, Member};

/// `legs[2].stroke.travel`: names, members and indices; `..` for all else.
pub(in crate::model) fn source_text(expr: &Expr) -> String {
    text(expr, 8)
}

fn text(expr: &Expr, depth: usize) -> String {
    if depth == 0 {
        return "..".into();
    }
    match expr {
        Expr::Path(path) => {
            let names = path.path.segments.iter().map(|s| s.ident.to_string());
            names.collect::<Vec<_>>().join("::")
        }
        Expr::Field(field) => {
            let base = text(&field.base, depth - 1);
            match &field.member {
                Member::Named(name) => format!("{base}.{name}"),
                Member::Unnamed(index) => format!("{base}.{}", index.index),
            }
        }
        Expr::Index(index) => {
            format!("{}[{}]", text(&index.expr, depth - 1), text(&index.index, depth - 1))
        }
        Expr::MethodCall(call) => {
            format!("{}.{}(..)", text(&call.receiver, depth - 1), call.method)
        }
        Expr::Call(call) if call.args.is_empty() => format!("{}()", text(&call.func, depth - 1)),
        Expr::Call(call) => format!("{}(..)", text(&call.func, depth - 1)),
        Expr::Lit(literal) => match &literal.lit {
            syn::Lit::Int(int) => int.base10_digits().into(),
            syn::Lit::Float(float) => float.base10_digits().into(),
            _ => "..".into(),
        },
        Expr::Paren(inner) => text(&inner.expr, depth),
        Expr::Group(inner) => text(&inner.expr, depth),
        _ => "..".into(),
    }
}
