//! Stage `model`: bodies.
//!
//! In: `body name { .. }`. Out: mass, centre of mass and inertia, possible ones at the declared defaults and where states start.

use proc_macro2::Ident;
use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, Slot};
use crate::model::checks::matrix3::eigenvalues;
use crate::model::docs::{self, Attributes};
use crate::model::expand::root;
use crate::model::typed::{Allowed, Typed};
use crate::model::types::{Body, ExprNode};
use crate::syntax::tree::ItemKind;

use super::fields::{Known, field};
use super::inertia::Tensor;

const FIELDS: Known<'static> = Known { required: &["mass"], optional: &["com", "inertia", "coordinates"] };

/// How far below zero an eigenvalue may be, relative to the trace: data are rounded.
const ROUNDING: f64 = 1e-9;

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn finish_body(&mut self, slot: &Slot<'a>) -> Option<Body> {
        let ItemKind::Body { name, fields } = &slot.item.kind else {
            return None;
        };
        let attributes = docs::attributes(&slot.item.attrs, self.report);
        self.refuse_cut(&attributes);
        self.check_fields(&format!("the body `{name}`"), name, fields, &FIELDS);
        let context = root(slot.scope);
        let mass = field(fields, "mass").and_then(|expr| {
            let mass = self.scalar(expr, context, Allowed::Inertia)?;
            self.begin_states(&mass.expr);
            self.not_negative(&mass, &format!("the mass of `{name}`"))
        });
        let com = match field(fields, "com") {
            Some(expr) => self.vector(expr, context, Allowed::Inertia).and_then(|com| {
                self.begin_states(&com.expr);
                self.finite(&com).map(|()| com)
            }),
            None => Some(Typed::vector([0.0; 3], name.span())),
        };
        let inertia = match field(fields, "inertia") {
            Some(expr) => {
                let tensor = self.inertia(expr, context);
                if let (Some(tensor), None) = (&tensor, attributes.unphysical_inertia) {
                    self.check_inertia(name, tensor, expr);
                }
                tensor.map(Some)
            }
            None => Some(None),
        };
        if let Some(expr) = field(fields, "coordinates") {
            self.check_coordinates(expr);
        }
        let (mass, com) = (mass?.expr, com?.expr);
        let inertia = inertia?.filter(|tensor| !is_zero(tensor));
        self.check_followed(name, &mass, &com, inertia.as_deref().map_or(&[][..], |tensor| &tensor[..]))?;
        Some(Body { place: slot.place.clone(), mass, com, inertia, docs: attributes.docs, span: name.span() })
    }

    /// `#[cut]` stands on joints.
    pub(in crate::model) fn refuse_cut(&mut self, attributes: &Attributes) {
        if let Some(span) = attributes.cut {
            self.report.error(span, "`#[cut]` stands on joints only");
        }
    }

    /// `#[allow(unphysical_inertia)]` stands on bodies.
    pub(in crate::model) fn refuse_waiver(&mut self, attributes: &Attributes) {
        if let Some(span) = attributes.unphysical_inertia {
            self.report.error(span, "`unphysical_inertia` is allowed on bodies only");
        }
    }

    /// A finite value at the declared defaults that is not below zero.
    pub(super) fn not_negative(&mut self, value: &Typed, what: &str) -> Option<Typed> {
        self.finite(value)?;
        let number = self.evaluator.scalar(&value.expr)?;
        if number < 0.0 {
            let message = format!("{what} must not be negative, but is {number} at the declared defaults");
            self.report.error(value.expr.span, message);
            return None;
        }
        Some(value.clone())
    }

    /// No body can have an inertia whose half trace times one, minus itself, has a negative eigenvalue: that is the
    /// second moment of mass.
    fn check_inertia(&mut self, name: &Ident, tensor: &Tensor, expr: &Expr) -> Option<()> {
        let mut numbers = [0.0; 6];
        for (number, entry) in numbers.iter_mut().zip(tensor.iter()) {
            *number = self.evaluator.scalar(entry)?;
        }
        let [xx, yy, zz, xy, xz, yz] = numbers;
        let trace = xx + yy + zz;
        let half = 0.5 * trace;
        let moments = [[half - xx, -xy, -xz], [-xy, half - yy, -yz], [-xz, -yz, half - zz]];
        let least = eigenvalues(moments).into_iter().fold(f64::INFINITY, f64::min);
        if least < -ROUNDING * trace.abs() {
            self.report.help(
                expr.span(),
                format!(
                    "`{name}` can't have this inertia: an eigenvalue of tr(I)/2 - I is {least:.3e} at the declared defaults"
                ),
                "each principal moment is at most the sum of the other two; `#[allow(unphysical_inertia)]` on the body waives this",
            );
        }
        Some(())
    }
}

fn is_zero(tensor: &Tensor) -> bool {
    let zero = |node: &ExprNode| matches!(node, ExprNode::Number(x) if *x == 0.0);
    tensor.iter().all(|entry| zero(&entry.node))
}
