//! Stage `model`: quantities of several bodies as one.
//!
//! In: `centre_of_mass()`, `linear_momentum([torso, legs])`. Out: typed nodes. Without a list all bodies of the model are
//! meant, wherever the call stands; a part in the list stands for its bodies and those of the parts in it.

use proc_macro2::{Ident, Span};
use syn::Expr;

use crate::model::checker::{Checker, Context, Meaning, ScopeId, Symbol};
use crate::model::typed::{Class, Typed, Uses};
use crate::model::types::{BodyId, BodyRef, ExprNode, Selection, SystemQuantity, Type};

use super::{source_text, span};

/// What to do where a centre of mass is nowhere.
pub(in crate::model) const NO_CENTRE: &str = "a centre of mass and momenta need a `mass` of some body";

/// The same where there is nothing to sum.
const NO_SUM: &str = "the sum is zero whatever happens: give some body a `mass`, or write `0.0`";

/// Bodies that stand in a list, or in no list at all.
pub(in crate::model) struct Selected {
    pub(in crate::model) bodies: Selection,
    /// What asks for them, as it stands in the text.
    pub(in crate::model) text: String,
    /// What to do where they have no mass.
    pub(in crate::model) help: &'static str,
    pub(in crate::model) span: Span,
}

impl<'a> Checker<'a, '_> {
    pub(super) fn of_bodies(
        &mut self,
        name: &Ident,
        quantity: SystemQuantity,
        arguments: &[&Expr],
        at: Span,
        context: Context<'a>,
    ) -> Option<Typed> {
        let (bodies, span) = match arguments {
            [] => (None, name.span()),
            [list] => (Some(self.selection(name, list, context)?.into()), span(list)),
            _ => {
                let message = format!("`{name}` takes one list of bodies, found {} arguments", arguments.len());
                self.report.help(at, message, format!("write `{name}([a, b])`"));
                return None;
            }
        };
        let help = if quantity == SystemQuantity::TotalMass { NO_SUM } else { NO_CENTRE };
        self.selected.push(Selected { bodies: bodies.clone(), text: format!("{name}()"), help, span });
        let (ty, class) = match quantity {
            SystemQuantity::TotalMass => (Type::Scalar, Class::Mass),
            SystemQuantity::CentreOfMass => (Type::Vec3, Class::Position),
            _ => (Type::Vec3, Class::State),
        };
        let uses = Uses::of(class, format!("{name}()"), name.span());
        Some(Typed::leaf(ExprNode::OfBodies(bodies, quantity), ty, at).with(uses))
    }

    /// The bodies of a list, each once.
    fn selection(&mut self, name: &Ident, list: &Expr, context: Context<'a>) -> Option<Vec<BodyId>> {
        let Expr::Array(array) = list else {
            let text = source_text(list);
            self.report.help(
                span(list),
                format!("`{name}` takes a list of bodies"),
                format!("write `{name}([{text}])`"),
            );
            return None;
        };
        if array.elems.is_empty() {
            let message = format!("`{name}` of no body at all");
            self.report.help(span(list), message, format!("name bodies and parts, or write `{name}()` for all"));
            return None;
        }
        let mut bodies = Vec::new();
        let mut complete = true;
        for element in &array.elems {
            let Some(found) = self.bodies_of(element, context) else {
                complete = false;
                continue;
            };
            if found.iter().any(|body| bodies.contains(body)) {
                let of = if found.len() == 1 { "" } else { "a body of " };
                let message = format!("{of}`{}` is in this list already", source_text(element));
                self.report.help(span(element), message, "each body counts once");
                complete = false;
            }
            bodies.extend(found);
        }
        bodies.sort_unstable();
        complete.then_some(bodies)
    }

    /// The body, or the bodies of the part, that an element of a list means.
    fn bodies_of(&mut self, element: &Expr, context: Context<'a>) -> Option<Vec<BodyId>> {
        let help = "name bodies and parts, such as `[torso, left_leg]`";
        let text = source_text(element);
        let message = match self.meaning(element, context)? {
            Meaning::Part(scope) => return self.bodies_in(&[scope], element),
            Meaning::Parts(scopes) => return self.bodies_in(&scopes, element),
            Meaning::Frame(value) => match value.frame.body {
                BodyRef::Ground => format!("`{text}` is the ground, which has no mass"),
                BodyRef::Body(body) if value.frame.steps.is_empty() => return Some(vec![body]),
                BodyRef::Body(_) => format!("`{text}` is a point of a body"),
            },
            _ => format!("`{text}` is neither a body nor a part"),
        };
        self.report.help(span(element), message, help);
        None
    }

    fn bodies_in(&mut self, scopes: &[ScopeId], element: &Expr) -> Option<Vec<BodyId>> {
        let mut bodies = Vec::new();
        let mut waiting = scopes.to_vec();
        while let Some(scope) = waiting.pop() {
            for symbol in self.scopes[scope].names.values() {
                match symbol {
                    Symbol::Body(body) => bodies.push(*body),
                    Symbol::Part(inner) => waiting.push(*inner),
                    Symbol::Parts(inner) => waiting.extend(inner.iter()),
                    _ => {}
                }
            }
        }
        // A body that the parser gave up is missed here alone.
        if bodies.is_empty() && !scopes.iter().any(|scope| self.is_broken(*scope)) {
            self.report.error(span(element), format!("the part `{}` has no body", source_text(element)));
        }
        if bodies.is_empty() {
            self.report.silent();
            return None;
        }
        Some(bodies)
    }

    /// `.position`, `.velocity`, `.acceleration` of a centre of mass, as a point has them.
    pub(super) fn centre_member(&mut self, value: &Typed, member: &Ident) -> Option<Typed> {
        let ExprNode::OfBodies(bodies, SystemQuantity::CentreOfMass) = &*value.expr.node else { return None };
        let (quantity, class) = match member.to_string().as_str() {
            "position" => return Some(value.clone()),
            "velocity" => (SystemQuantity::CentreOfMassVelocity, Class::State),
            "acceleration" => (SystemQuantity::CentreOfMassAcceleration, Class::Acceleration),
            _ => return None,
        };
        let uses = Uses::of(class, format!("centre_of_mass().{member}"), member.span());
        Some(Typed::leaf(ExprNode::OfBodies(bodies.clone(), quantity), Type::Vec3, member.span()).with(uses))
    }
}

/// Whether a value is the centre of mass itself, which moves, and not a vector that is made of it.
pub(super) fn is_centre_of_mass(value: &Typed) -> bool {
    matches!(&*value.expr.node, ExprNode::OfBodies(_, SystemQuantity::CentreOfMass))
}
