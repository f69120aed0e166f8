//! Stage `model`: quantities of the whole model, or of bodies and parts of it.
//!
//! In: `centre_of_mass().position`, `angular_momentum([torso, legs])`. Out: nodes with the bodies that count. The centre of mass is a
//! point like a frame, of which quantities are taken; the others are values.

use std::rc::Rc;

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprCall};

use crate::model::checker::{Checker, Context, FIRST_OF_PORTS, Meaning, ScopeId, Symbol};
use crate::model::typed::{Class, Typed, Uses, type_text};
use crate::model::types::{BodyId, BodyRef, ExprNode, Type, Whole};

use super::{source_text, span};

/// The centre of mass of some bodies.
#[derive(Clone)]
pub(in crate::model) struct Centre {
    /// All of the model if there are none.
    bodies: Option<Rc<[BodyId]>>,
    /// As it is written.
    text: String,
}

const QUANTITIES: [(&str, Whole, Class); 3] = [
    ("position", Whole::Position, Class::Finished),
    ("velocity", Whole::Velocity, Class::State),
    ("acceleration", Whole::Acceleration, Class::Acceleration),
];

impl<'a> Checker<'a, '_> {
    /// A call of a function of [`crate::model::names::WHOLE`].
    pub(super) fn whole(&mut self, name: &Ident, call: &ExprCall, context: Context<'a>) -> Option<Meaning> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let bodies = match arguments.as_slice() {
            [] => None,
            [one] => Some(self.bodies_named(name, one, context)?.into()),
            _ => {
                let message =
                    format!("`{name}` takes bodies and parts as one list, found {} arguments", arguments.len());
                self.report.help(call.span(), message, format!("write `{name}([a, b])`"));
                return None;
            }
        };
        let text = source_text(&Expr::Call(call.clone()));
        let (quantity, ty, class) = match name.to_string().as_str() {
            "total_mass" => (Whole::Mass, Type::Scalar, Class::Finished),
            "linear_momentum" => (Whole::LinearMomentum, Type::Vec3, Class::State),
            "angular_momentum" => (Whole::AngularMomentum, Type::Vec3, Class::State),
            _ => return Some(Meaning::Centre(Rc::new(Centre { bodies, text }))),
        };
        Some(Meaning::Value(whole(bodies, quantity, ty, class, (text, call.span()))))
    }

    pub(super) fn centre_member(&mut self, centre: &Centre, member: &Ident) -> Option<Meaning> {
        let name = member.to_string();
        let Some(&(_, quantity, class)) = QUANTITIES.iter().find(|(known, ..)| *known == name) else {
            let names = QUANTITIES.iter().map(|quantity| quantity.0);
            let help = "it has `position`, `velocity` and `acceleration`";
            self.report.unknown(
                member.span(),
                format!("a centre of mass has no `{name}`"),
                &name,
                names,
                Some(help.into()),
            );
            return None;
        };
        let text = format!("{}.{name}", centre.text);
        let value = whole(centre.bodies.clone(), quantity, Type::Vec3, class, (text, member.span()));
        Some(Meaning::Value(value))
    }

    /// The bodies of a list of bodies and parts, or of one of them.
    fn bodies_named(&mut self, name: &Ident, list: &Expr, context: Context<'a>) -> Option<Vec<BodyId>> {
        let elements: Vec<&Expr> = match list {
            Expr::Array(array) => array.elems.iter().collect(),
            one => vec![one],
        };
        if elements.is_empty() {
            self.report.help(
                span(list),
                "a list of bodies needs at least one",
                format!("write `{name}()` for all of them"),
            );
            return None;
        }
        let mut bodies: Vec<BodyId> = Vec::new();
        let mut is_sound = true;
        for element in elements {
            let Some(found) = self.bodies_of(element, context) else {
                is_sound = false;
                continue;
            };
            if found.iter().any(|body| bodies.contains(body)) {
                let message = format!("a body of `{}` is in this list already", source_text(element));
                self.report.error(span(element), message);
                is_sound = false;
            }
            bodies.extend(found);
        }
        bodies.sort_unstable();
        is_sound.then_some(bodies)
    }

    fn bodies_of(&mut self, expr: &Expr, context: Context<'a>) -> Option<Vec<BodyId>> {
        let mut bodies = Vec::new();
        let what = match self.meaning(expr, context)? {
            Meaning::Frame(frame) if frame.frame.steps.is_empty() => match frame.frame.body {
                BodyRef::Body(body) => return Some(vec![body]),
                BodyRef::Ground => "the ground".to_owned(),
            },
            // What a port leads to is not known where its part is checked by itself.
            Meaning::Frame(frame) if matches!(frame.frame.body, BodyRef::Body(body) if body >= FIRST_OF_PORTS) => {
                return None;
            }
            Meaning::Part(scope) => {
                self.gather(scope, &mut bodies);
                "a part without bodies".to_owned()
            }
            Meaning::Parts(scopes) => {
                scopes.iter().for_each(|&scope| self.gather(scope, &mut bodies));
                "parts without bodies".to_owned()
            }
            Meaning::Frame(_) => "a frame".to_owned(),
            Meaning::Value(value) => type_text(&value.expr.ty),
            Meaning::Joint(_) | Meaning::Coordinate(..) => "a joint".to_owned(),
            Meaning::Force(_) => "a force".to_owned(),
            Meaning::Constraint(_) => "a constraint".to_owned(),
            Meaning::Centre(_) => "a centre of mass".to_owned(),
        };
        if bodies.is_empty() {
            self.report.help(
                span(expr),
                format!("expected a body or a part with bodies, found {what}"),
                "write their names",
            );
            return None;
        }
        Some(bodies)
    }

    /// The bodies of a part, with those of its own parts.
    fn gather(&self, scope: ScopeId, bodies: &mut Vec<BodyId>) {
        for symbol in self.scopes[scope].names.values() {
            match symbol {
                Symbol::Body(body) => bodies.push(*body),
                Symbol::Part(inner) => self.gather(*inner, bodies),
                Symbol::Parts(inner) => inner.iter().for_each(|&inner| self.gather(inner, bodies)),
                _ => {}
            }
        }
    }
}

fn whole(bodies: Option<Rc<[BodyId]>>, quantity: Whole, ty: Type, class: Class, (text, at): (String, Span)) -> Typed {
    let mut uses = Uses::of(class, text.clone(), at);
    if quantity == Whole::Position {
        uses.add(Class::Finished, text, at);
    }
    Typed::leaf(ExprNode::Whole { bodies, quantity }, ty, at).with(uses)
}
