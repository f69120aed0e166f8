//! Stage `model`: functions of the user's own, `let f(x, y) = value;`.
//!
//! In: calls. Out: what the value means with the arguments in place. A call is expanded where it stands: the arguments are read
//! once, in the caller's terms, and each is one node that all its uses share; the value is read anew for every call, in the
//! terms of the module that declares the function. So the value has the types that the arguments give it.

use proc_macro2::{Ident, Span};
use syn::Expr;

use std::rc::Rc;

use crate::model::checker::{Call, Checker, Context, DefinedFunction, FunctionId, Meaning, ScopeId, Symbol};
use crate::model::names;
use crate::model::units::Declared;
use crate::syntax::tree;

use super::span;

/// Bound on the calls of one model, those in values of functions included: each is written out.
const MAX_CALLS: usize = 10_000;

impl<'a> Checker<'a, '_> {
    /// Enters a function of one instance of a module.
    pub(in crate::model) fn define(
        &mut self,
        item: &'a tree::Function,
        scope: ScopeId,
        unit: Option<Declared>,
    ) -> FunctionId {
        self.functions.push(DefinedFunction { item, scope, unit, refused: false })
    }

    /// Names of arguments hide nothing, as that of an index doesn't.
    pub(in crate::model) fn check_parameters(&mut self, function: &tree::Function, scope: ScopeId) {
        for (place, parameter) in function.parameters.iter().enumerate() {
            let name = parameter.to_string();
            if let Some(why) = names::refusal(&name) {
                self.report.help(parameter.span(), why, "take another name for the argument");
            } else if self.scopes[scope].names.contains_key(&name) {
                let message = format!("the name `{name}` is taken in this model");
                self.report.help(parameter.span(), message, "take another name for the argument");
            } else if function.parameters[..place].contains(parameter) {
                self.report.error(parameter.span(), format!("two arguments have the name `{name}`"));
            }
        }
    }

    /// The function of this name in a module.
    pub(in crate::model) fn function_of(&self, scope: ScopeId, name: &Ident) -> Option<FunctionId> {
        match self.scopes[scope].names.get(&name.to_string()) {
            Some(Symbol::Function(id)) => Some(*id),
            _ => None,
        }
    }

    /// Whether a module has a function of the user's own of this name, in the language or in Rust.
    pub(in crate::model) fn has_function(&self, scope: ScopeId, name: &Ident) -> bool {
        self.function_of(scope, name).is_some() || self.external_of(scope, name).is_some()
    }

    /// The names of all functions of a module.
    pub(in crate::model) fn functions_of(&self, scope: ScopeId) -> Vec<String> {
        let names = self.scopes[scope].names.iter();
        names
            .filter(|(_, symbol)| matches!(symbol, Symbol::Function(_) | Symbol::External(_)))
            .map(|(name, _)| name.clone())
            .collect()
    }

    /// What an argument of the function means in whose value a name stands.
    pub(super) fn argument(&self, name: &Ident, context: Context<'a>) -> Option<Meaning> {
        let call = self.calls.get(context.call?)?;
        let place = self.functions[call.function].item.parameters.iter().position(|parameter| parameter == name)?;
        Some(match call.arguments.get(place)?.clone() {
            Meaning::Value(value) => Meaning::Value(value.at(name.span())),
            other => other,
        })
    }

    /// Names that mean something here and nowhere else: an index, arguments.
    pub(in crate::model) fn locals(&self, context: Context<'a>) -> Vec<String> {
        let call = context.call.and_then(|call| self.calls.get(call));
        let parameters = call.into_iter().flat_map(|call| &self.functions[call.function].item.parameters);
        parameters.chain(context.index.map(|(index, _)| index)).map(ToString::to_string).collect()
    }

    /// The value of a function for these arguments.
    pub(super) fn expanded_call(
        &mut self,
        id: FunctionId,
        name: &Ident,
        arguments: &[&Expr],
        at: Span,
        context: Context<'a>,
    ) -> Option<Meaning> {
        let DefinedFunction { item, scope, refused, .. } = self.functions[id];
        // What stands between the parentheses may hold mistakes of its own.
        let given: Vec<Option<Meaning>> =
            arguments.iter().map(|argument| self.argument_of_call(argument, context)).collect();
        if refused || tree::poisoned(&item.value) {
            self.report.silent();
            return None;
        }
        self.arity(name, arguments, item.parameters.len(), at)?;
        let arguments = given.into_iter().collect::<Option<_>>()?;
        if let Some(first) = self.calls.iter().position(|call| call.function == id) {
            self.circle(first, name);
            return None;
        }
        if self.expanded_calls >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls of functions once all are expanded");
            self.report.help(
                at,
                message,
                "a function that is called twice by each of the next doubles with every step",
            );
            // What has been begun comes to an end, and nothing more is begun.
            self.functions.iter_mut().for_each(|function| function.refused = true);
            return None;
        }
        self.expanded_calls += 1;
        self.calls.push(Call { function: id, arguments });
        let inside = Context { scope, index: None, call: Some(self.calls.len() - 1) };
        let meaning = self.meaning(&item.value, inside);
        self.calls.pop();
        self.result(id, meaning?, name, at)
    }

    /// An argument: all that expressions speak of but parts, whose names belong to one module.
    fn argument_of_call(&mut self, expr: &Expr, context: Context<'a>) -> Option<Meaning> {
        match self.meaning(expr, context)? {
            Meaning::Part(_) | Meaning::Parts(_) => {
                self.report.help(
                    span(expr),
                    "a part can't be given to a function",
                    "give it something inside the part",
                );
                None
            }
            meaning => Some(meaning),
        }
    }

    fn result(&mut self, id: FunctionId, meaning: Meaning, name: &Ident, at: Span) -> Option<Meaning> {
        match meaning {
            Meaning::Value(mut value) => {
                value.uses = value.uses.through(&name.to_string(), name.span());
                let unit = self.functions[id].unit.clone();
                if let Some(unit) = unit {
                    value.expr.unit = Some(Rc::new(unit.over(value.expr.unit.take())));
                    self.returned.push(value.expr.clone());
                }
                Some(Meaning::Value(value.at(at)))
            }
            Meaning::Frame(mut frame) => {
                frame.uses = frame.uses.through(&name.to_string(), name.span());
                Some(Meaning::Frame(frame))
            }
            Meaning::Part(_) | Meaning::Parts(_) => {
                self.report.help(at, "a function has no part for a value", "take something inside the part");
                None
            }
            other => Some(other),
        }
    }

    /// Calls from this one on lead back to its function.
    fn circle(&mut self, first: usize, name: &Ident) {
        let members: Vec<FunctionId> = self.calls[first..].iter().map(|call| call.function).collect();
        let names: Vec<String> = members.iter().map(|id| format!("`{}`", self.functions[*id].item.name)).collect();
        let message = match names.as_slice() {
            [_] => format!("`{name}` is defined through itself"),
            several => format!("`{name}` is defined through itself: {} and again `{name}`", several.join(", ")),
        };
        self.report.help(name.span(), message, "functions are expanded where they are called, so none leads to itself");
        for id in members {
            self.functions[id].refused = true;
        }
    }
}
