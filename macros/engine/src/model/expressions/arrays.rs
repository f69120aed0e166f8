//! Stage `model`: arrays as written, and elements of them.
//!
//! In: `[a, b, c]`, `a[k]`. Out: typed arrays; elements; instances of arrays of parts.

use syn::spanned::Spanned;
use syn::{Expr, ExprArray, ExprIndex};

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::typed::{MAX_SCALARS, Typed, bounded_scalars, type_text};
use crate::model::types::Type;

use super::coerce::{component_of, convert, element_of};
use super::span;

impl<'a> Checker<'a, '_> {
    /// Elements must have one type; three scalars are a `Vec3` where another element is one.
    pub(super) fn array(&mut self, array: &ExprArray, context: Context<'a>) -> Option<Typed> {
        let at = array.span();
        let elements: Vec<Option<Typed>> = array.elems.iter().map(|e| self.value(e, context)).collect();
        let elements: Vec<Typed> = elements.into_iter().collect::<Option<_>>()?;
        let Some(first) = elements.first() else {
            self.report.error(at, "an array needs at least one element");
            return None;
        };
        let vector = elements.iter().any(|e| e.expr.ty == Type::Vec3);
        let ty = if vector { Type::Vec3 } else { first.expr.ty.clone() };
        let converted: Vec<Option<Typed>> = elements
            .iter()
            .map(|element| {
                let value = convert(element, &ty);
                if value.is_none() {
                    self.report.error(
                        element.expr.span,
                        format!(
                            "elements of an array have one type: expected {}, found {}",
                            type_text(&ty),
                            type_text(&element.expr.ty)
                        ),
                    );
                }
                value
            })
            .collect();
        let converted: Vec<Typed> = converted.into_iter().collect::<Option<_>>()?;
        let ty = Type::Array(Box::new(ty), converted.len());
        self.bounded(&ty, at)?;
        self.collect(converted, ty, at)
    }

    /// `n` of the type `[T; n]`.
    pub(in crate::model) fn array_length(&mut self, expr: &Expr, context: Context<'a>) -> Option<usize> {
        let count = self.whole_number(expr, context)?;
        match usize::try_from(count) {
            Ok(count) if (1..=MAX_SCALARS).contains(&count) => Some(count),
            _ => {
                let message = format!("expected a length from 1 to {MAX_SCALARS}, found {count}");
                self.report.error(span(expr), message);
                None
            }
        }
    }

    /// Refuses a type with too many scalars.
    pub(in crate::model) fn bounded(&mut self, ty: &Type, at: proc_macro2::Span) -> Option<()> {
        if bounded_scalars(ty).is_none() {
            let message = format!("an array has at most {MAX_SCALARS} numbers");
            self.report.error(at, message);
            return None;
        }
        Some(())
    }

    pub(super) fn index(&mut self, index: &ExprIndex, context: Context<'a>) -> Option<Meaning> {
        if let Some(matrix) = self.matrix_name(&index.expr, context) {
            return self.entry(matrix, index, context).map(Meaning::Value);
        }
        let place = match &*index.index {
            Expr::Tuple(several) if several.elems.len() == 1 => &several.elems[0],
            Expr::Tuple(_) => {
                self.report.help(span(&index.index), "one index at a time", "write `a[i][j]`");
                return None;
            }
            one => one,
        };
        let base = self.meaning(&index.expr, context);
        let k = self.whole_number(place, context);
        let (base, k) = (base?, k?);
        let count = match &base {
            Meaning::Parts(scopes) => scopes.len(),
            Meaning::Value(value) => match &value.expr.ty {
                Type::Array(_, count) => *count,
                Type::Vec3 => 3,
                other => {
                    let message = format!("{} has no elements", type_text(other));
                    self.report.error(span(&index.expr), message);
                    return None;
                }
            },
            _ => {
                let message = format!("`{}` is no array", super::source_text(&index.expr));
                self.report.error(span(&index.expr), message);
                return None;
            }
        };
        let Some(k) = usize::try_from(k).ok().filter(|k| *k < count) else {
            self.report
                .error(span(&index.index), format!("index {k} is out of range: there are {count} elements, from 0"));
            return None;
        };
        match base {
            Meaning::Parts(scopes) => Some(Meaning::Part(scopes[k])),
            Meaning::Value(value) => {
                let element = match value.expr.ty {
                    Type::Vec3 => component_of(&value.expr, k),
                    _ => element_of(&value.expr, k),
                };
                Some(Meaning::Value(Typed { expr: element?, uses: value.uses, depth: value.depth.saturating_add(1) }))
            }
            _ => None,
        }
    }
}
