//! Stage `model`: functions of the user's own Rust, `extern f(x, y) = crate::path::Type;`.
//!
//! In: calls. Out: typed nodes. Arguments are scalars of any units; the value is a scalar with the unit that is declared with the
//! function. What nobody knows before the model runs decides no position, mass or constraint, so a call brings in a class of
//! its own ([`Class::External`]), which forces, states and outputs allow. Rust gives values and slopes, and no slopes of these.

use std::collections::HashSet;
use std::rc::Rc;

use proc_macro2::{Ident, Span};
use syn::Expr;

use crate::invariant::fault::OrFault;
use crate::model::checker::{Checker, Context, ScopeId, Symbol};
use crate::model::typed::{Class, Typed};
use crate::model::types::{Expr as Checked, ExprNode, External, ExternalId, Type};
use crate::model::units::Declared;
use crate::syntax::tree;

impl tree::External {
    /// As the checked model has it.
    pub(in crate::model) fn described(&self) -> External {
        External { name: self.name.clone(), arguments: self.parameters.clone(), path: self.path.clone() }
    }
}

impl<'a> Checker<'a, '_> {
    /// Enters a function with the unit of its value; all instances of a module have the same one.
    pub(in crate::model) fn external(&mut self, function: &'a tree::External, unit: Option<Declared>) -> ExternalId {
        let place = self.source.externals().position(|known| std::ptr::eq(known, function));
        let id = ExternalId(place.or_fault("a function of Rust is one of those of the call"));
        if let Some(unit) = unit {
            self.external_units.insert(id, unit);
        }
        id
    }

    /// Names of arguments are for readers alone.
    pub(in crate::model) fn check_external(&mut self, function: &tree::External) {
        for (place, parameter) in function.parameters.iter().enumerate() {
            if function.parameters[..place].contains(parameter) {
                self.report.error(parameter.span(), format!("two arguments have the name `{parameter}`"));
            }
        }
    }

    /// The function of Rust of this name in a module.
    pub(in crate::model) fn external_of(&self, scope: ScopeId, name: &Ident) -> Option<ExternalId> {
        match self.scopes[scope].names.get(&name.to_string()) {
            Some(Symbol::External(id)) => Some(*id),
            _ => None,
        }
    }

    /// The value of a function for these arguments.
    pub(super) fn external_call(
        &mut self,
        id: ExternalId,
        name: &Ident,
        arguments: &[&Expr],
        at: Span,
        context: Context<'a>,
    ) -> Option<Typed> {
        let values: Vec<Option<Typed>> = arguments.iter().map(|e| self.expect(e, context, &Type::Scalar)).collect();
        let function = self.source.externals().nth(id.0).or_fault("the id of a function of Rust is its place");
        if function.parameters.is_empty() {
            // Its head could not be read.
            self.report.silent();
            return None;
        }
        self.arity(name, arguments, function.parameters.len(), at)?;
        let values: Vec<Typed> = values.into_iter().collect::<Option<_>>()?;
        let node = ExprNode::External(id, values.iter().map(|value| value.expr.clone()).collect());
        let mut value = self.build(node, Type::Scalar, at, &values.iter().collect::<Vec<_>>())?;
        value.uses.add(Class::External, name.to_string(), name.span());
        if let Some(unit) = self.external_units.get(&id) {
            value.expr.unit = Some(Rc::new(unit.clone()));
        }
        Some(value)
    }

    /// Whether an expression may be differentiated: not by slopes of functions of Rust, which have none.
    pub(super) fn has_slopes(&mut self, of: &Checked, name: &Ident) -> bool {
        let Some(twice) = slope_of_external(of) else { return true };
        let function = self.source.externals().nth(twice.0).or_fault("the id of a function of Rust is its place");
        let message = format!("`{}` has slopes, and no slopes of these: it is differentiated once", function.name);
        self.report.help(name.span(), message, "let another function of Rust give the slope, with slopes of its own");
        false
    }
}

/// A function of Rust that an expression calls.
pub(super) fn external_in(expr: &Checked) -> Option<ExternalId> {
    called(expr, true)
}

/// A function of Rust that has been differentiated in an expression.
fn slope_of_external(expr: &Checked) -> Option<ExternalId> {
    called(expr, false)
}

/// `inside`: whether a call counts wherever it stands, or inside of a derivative alone.
fn called(expr: &Checked, inside: bool) -> Option<ExternalId> {
    let (mut stack, mut seen) = (vec![(expr, inside)], HashSet::new());
    while let Some((expr, inside)) = stack.pop() {
        if !seen.insert((Rc::as_ptr(&expr.node), inside)) {
            continue;
        }
        match &*expr.node {
            ExprNode::External(function, _) if inside => return Some(*function),
            node => {
                let inside = inside || matches!(node, ExprNode::Derivative { .. });
                stack.extend(node.operands().into_iter().map(|operand| (operand, inside)));
            }
        }
    }
    None
}
