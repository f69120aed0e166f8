//! Stage `model`: values where a certain type is wanted.
//!
//! In: expressions and the type they should have. Out: values of that type; an array of three scalars becomes a
//! `Vec3` where one is wanted, all else must agree.

use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, Context};
use crate::model::typed::{Typed, new_expr, type_text};
use crate::model::types::{Expr as Checked, ExprNode, Type};

impl<'a> Checker<'a, '_> {
    /// A value of type `ty`; where it is written as an array, the error is at the element.
    pub(in crate::model) fn expect(&mut self, expr: &Expr, context: Context<'a>, ty: &Type) -> Option<Typed> {
        match expr {
            Expr::Paren(inner) if self.deeper() => {
                let value = self.expect(&inner.expr, context, ty);
                self.depth -= 1;
                value
            }
            Expr::Array(array) if matches!(ty, Type::Vec3 | Type::Array(..)) && self.deeper() => {
                let value = self.expect_array(array, context, ty);
                self.depth -= 1;
                value
            }
            _ => {
                let value = self.value(expr, context)?;
                self.coerce(value, ty)
            }
        }
    }

    /// One level more, if there is room for it.
    fn deeper(&mut self) -> bool {
        let room = self.depth < super::MAX_NESTING;
        if room {
            self.depth += 1;
        }
        room
    }

    fn expect_array(&mut self, array: &syn::ExprArray, context: Context<'a>, ty: &Type) -> Option<Typed> {
        let (element, count) = match ty {
            Type::Array(element, count) => (&**element, *count),
            _ => (&Type::Scalar, 3),
        };
        let elements: Vec<Option<Typed>> = array.elems.iter().map(|e| self.expect(e, context, element)).collect();
        let at = array.span();
        if elements.len() != count {
            let found = elements.len();
            let wanted = match ty {
                Type::Vec3 => "a Vec3 has 3 components".to_string(),
                _ => format!("expected {count} elements"),
            };
            self.report.error(at, format!("{wanted}, found {found}"));
            return None;
        }
        let elements: Vec<Typed> = elements.into_iter().collect::<Option<_>>()?;
        self.collect(elements, ty.clone(), at)
    }

    /// An array or `Vec3` of checked elements.
    pub(super) fn collect(&mut self, elements: Vec<Typed>, ty: Type, at: proc_macro2::Span) -> Option<Typed> {
        let parts: Vec<&Typed> = elements.iter().collect();
        let exprs: Vec<Checked> = elements.iter().map(|e| e.expr.clone()).collect();
        let node = match (&ty, exprs.as_slice()) {
            (Type::Vec3, [x, y, z]) => ExprNode::Vec3([x.clone(), y.clone(), z.clone()]),
            _ => ExprNode::Array(exprs),
        };
        self.build(node, ty, at, &parts)
    }

    /// `value` as a value of type `ty`.
    pub(in crate::model) fn coerce(&mut self, value: Typed, ty: &Type) -> Option<Typed> {
        if let Some(value) = convert(&value, ty) {
            return Some(value);
        }
        let message = format!("expected {}, found {}", type_text(ty), type_text(&value.expr.ty));
        match (ty, &value.expr.ty) {
            (Type::Vec3, Type::Scalar) => {
                let help = "a vector is written `[x, y, z]`, or by axes: `-2.0 * Z`";
                self.report.help(value.expr.span, message, help);
            }
            _ => self.report.error(value.expr.span, message),
        }
        None
    }
}

/// The same value with type `ty`, where that needs no arithmetic.
pub(super) fn convert(value: &Typed, ty: &Type) -> Option<Typed> {
    if value.expr.ty == *ty {
        return Some(value.clone());
    }
    let expr = convert_expr(&value.expr, ty)?;
    Some(Typed { expr, uses: value.uses.clone(), depth: value.depth.saturating_add(2) })
}

fn convert_expr(expr: &Checked, ty: &Type) -> Option<Checked> {
    if expr.ty == *ty {
        return Some(expr.clone());
    }
    match (&expr.ty, ty) {
        (Type::Array(element, 3), Type::Vec3) if **element == Type::Scalar => {
            let [x, y, z] = [0, 1, 2].map(|k| element_of(expr, k));
            Some(new_expr(ExprNode::Vec3([x?, y?, z?]), Type::Vec3, expr.span))
        }
        (Type::Array(_, count), Type::Array(wanted, other)) if count == other => {
            let elements: Option<Vec<Checked>> =
                (0..*count).map(|k| convert_expr(&element_of(expr, k)?, wanted)).collect();
            Some(new_expr(ExprNode::Array(elements?), ty.clone(), expr.span))
        }
        _ => None,
    }
}

/// Element of an array; of a written one the element itself.
pub(in crate::model) fn element_of(array: &Checked, index: usize) -> Option<Checked> {
    let Type::Array(ty, count) = &array.ty else {
        return None;
    };
    if index >= *count {
        return None;
    }
    if let ExprNode::Array(elements) = &*array.node {
        return Some(in_unit_of(elements[index].clone(), array));
    }
    Some(in_unit_of(new_expr(ExprNode::Index(array.clone(), index), (**ty).clone(), array.span), array))
}

/// Component of a `Vec3`; of a written one the component itself.
pub(in crate::model) fn component_of(vector: &Checked, index: usize) -> Option<Checked> {
    (index < 3).then(|| {
        let component = match &*vector.node {
            ExprNode::Vec3(components) => components[index].clone(),
            _ => new_expr(ExprNode::Component(vector.clone(), index), Type::Scalar, vector.span),
        };
        in_unit_of(component, vector)
    })
}

/// What is declared of the whole holds of its parts.
fn in_unit_of(mut part: Checked, whole: &Checked) -> Checked {
    part.unit = whole.unit.clone().or(part.unit);
    part
}
