//! Stage `model`: names in expressions.
//!
//! In: paths. Out: what they mean in their scope; near names where there is no such name.

use proc_macro2::{Ident, Span};
use syn::ExprPath;
use syn::spanned::Spanned;

use crate::diagnostics::nearest;
use crate::model::checker::{Checker, Context, Meaning, ScopeId, Symbol};
use crate::model::expand::article;
use crate::model::names::{FUNCTIONS, SPECIAL_FUNCTIONS, SYSTEM_QUANTITIES, VALUES};
use crate::model::typed::{Class, FrameValue, Typed, Uses};
use crate::model::types::{BodyRef, ExprNode, Frame, Type};

impl<'a> Checker<'a, '_> {
    pub(super) fn path(&mut self, path: &ExprPath, context: Context<'a>) -> Option<Meaning> {
        let Some(name) = path.path.get_ident().filter(|_| path.qself.is_none()) else {
            let pi = path.path.segments.last().is_some_and(|s| s.ident == "PI");
            let help =
                if pi { "write `PI`" } else { "names are those of this model, and the functions of the language" };
            self.report.help(path.span(), "paths have no meaning here", help);
            return None;
        };
        self.name(name, context)
    }

    fn name(&mut self, name: &Ident, context: Context<'a>) -> Option<Meaning> {
        let span = name.span();
        if let Some((_, k)) = context.index.filter(|(index, _)| *index == name) {
            return Some(Meaning::Value(Typed::number(k as f64, span)));
        }
        if let Some(argument) = self.argument(name, context) {
            return Some(argument);
        }
        let text = name.to_string();
        if let Some(meaning) = builtin(&text, span) {
            return Some(meaning);
        }
        if let Some(symbol) = self.scopes[context.scope].symbol(&text) {
            return self.symbol(&symbol, name);
        }
        if SYSTEM_QUANTITIES.iter().any(|(function, _)| *function == text) {
            let help = format!("write `{text}()` for the whole model, or `{text}([body, part])`");
            self.report.help(span, format!("`{text}` is a function"), help);
            return None;
        }
        if FUNCTIONS.iter().any(|(function, ..)| *function == text) || SPECIAL_FUNCTIONS.contains(&text.as_str()) {
            self.report.help(span, format!("`{text}` is a function"), format!("write `{text}(..)`"));
            return None;
        }
        let near = || self.names_of(context.scope).iter().any(|known| nearest(&text, [known.as_str()]).is_some());
        if let Some(instead) = elsewhere(&text).filter(|_| !near()) {
            self.report.help(span, format!("unknown name `{text}`"), instead);
            return None;
        }
        self.unknown_name(name, context);
        None
    }

    fn unknown_name(&mut self, name: &Ident, context: Context<'a>) {
        let text = name.to_string();
        let mut known: Vec<String> = self.names_of(context.scope);
        known.extend(self.locals(context));
        let candidates = known.iter().map(String::as_str).chain(VALUES);
        if self.is_broken(context.scope) {
            // The name may have been lost with an item that the parser gave up.
            let near = crate::diagnostics::nearest;
            if !self.report.suggests() || near(&text, candidates.clone()).is_none() {
                return self.report.silent();
            }
        }
        self.report.unknown(name.span(), format!("unknown name `{text}`"), &text, candidates, None);
    }

    pub(in crate::model) fn names_of(&self, scope: ScopeId) -> Vec<String> {
        let scope = &self.scopes[scope];
        scope.names.keys().chain(scope.outputs.keys()).cloned().collect()
    }

    pub(super) fn is_broken(&self, scope: ScopeId) -> bool {
        self.scopes[scope].module.broken
    }

    /// What a declared name stands for; `site` is where it is used.
    pub(super) fn symbol(&mut self, symbol: &Symbol, site: &Ident) -> Option<Meaning> {
        let span = site.span();
        let value = |node, ty, class| {
            let uses = Uses::of(class, site.to_string(), span);
            Some(Meaning::Value(Typed::leaf(node, ty, span).with(uses)))
        };
        match symbol {
            Symbol::Pending(keyword) => {
                self.report.error(
                    span,
                    format!(
                        "`{site}` is {} `{keyword}`: the number of parts follows from literals and `const`",
                        article(keyword)
                    ),
                );
                None
            }
            Symbol::Opaque(_) => {
                self.report.silent();
                None
            }
            Symbol::Named(id, keyword) => {
                let meaning = self.named_meaning(*id, span)?;
                Some(match meaning {
                    Meaning::Value(mut typed) if *keyword != "const" => {
                        typed.uses = typed.uses.through(&site.to_string(), span);
                        // A param stays one, also where it is set to a literal from outside.
                        if *keyword == "param" {
                            typed.uses.add(Class::Parameter, site.to_string(), span);
                        }
                        Meaning::Value(typed)
                    }
                    Meaning::Frame(mut frame) => {
                        frame.uses = frame.uses.through(&site.to_string(), span);
                        Meaning::Frame(frame)
                    }
                    other => other,
                })
            }
            Symbol::Param(id) => {
                let ty = self.param_type(*id, span)?;
                value(ExprNode::Param(*id), ty, Class::Parameter)
            }
            Symbol::Input(id) => {
                let ty = self.input_type(*id)?;
                value(ExprNode::Input(*id), ty, Class::Input)
            }
            Symbol::State(id) => value(ExprNode::State(*id), Type::Scalar, Class::Own),
            Symbol::Body(id) => {
                Some(Meaning::Frame(FrameValue { frame: plain_frame(BodyRef::Body(*id), span), uses: Uses::default() }))
            }
            Symbol::Joint(id) => Some(Meaning::Joint(*id)),
            Symbol::Force(id) => Some(Meaning::Force(*id)),
            Symbol::Constraint(id) => Some(Meaning::Constraint(*id)),
            Symbol::Unknown(system, place) => self.unknown(*system, *place, site).map(Meaning::Value),
            Symbol::Function(_) | Symbol::External(_) => {
                self.report.help(span, format!("`{site}` is a function"), format!("write `{site}(..)`"));
                None
            }
            Symbol::Part(scope) => Some(Meaning::Part(*scope)),
            Symbol::Parts(scopes) => Some(Meaning::Parts(scopes.clone())),
        }
    }
}

/// What is written in other languages for what every expression may name here.
fn elsewhere(name: &str) -> Option<&'static str> {
    Some(match name {
        "time" => "write `t`",
        "world" | "base" | "inertial" | "origin" => "the frame that does not move is `ground`",
        "ex" | "ey" | "ez" | "e_x" | "e_y" | "e_z" => "the unit vectors are `X`, `Y`, `Z`",
        "g" | "gravity" => "gravity stands in `world { gravity: -9.81 * Z }`; a number of your own is a `const`",
        _ => return None,
    })
}

/// The frame of a body itself.
pub(in crate::model) fn plain_frame(body: BodyRef, span: Span) -> Frame {
    Frame { body, steps: Vec::new(), span }
}

fn builtin(name: &str, span: Span) -> Option<Meaning> {
    Some(match name {
        "X" => Meaning::Value(Typed::vector([1.0, 0.0, 0.0], span)),
        "Y" => Meaning::Value(Typed::vector([0.0, 1.0, 0.0], span)),
        "Z" => Meaning::Value(Typed::vector([0.0, 0.0, 1.0], span)),
        "PI" => Meaning::Value(Typed::leaf(ExprNode::Pi, Type::Scalar, span)),
        "t" => {
            let uses = Uses::of(Class::Time, "t", span);
            Meaning::Value(Typed::leaf(ExprNode::Time, Type::Scalar, span).with(uses))
        }
        "ground" => Meaning::Frame(FrameValue { frame: plain_frame(BodyRef::Ground, span), uses: Uses::default() }),
        _ => return None,
    })
}
