//! Stage `model`: formulas of other models.
//!
//! In: `leg([gimbal.first, stroke], tip.x = 0.3, length = l)`: a model of the same call that stands above, an expression in its
//! terms, and values for its variables in the terms of this one. Out: a node that holds the other model, the expression, and the
//! values. The expression is read by a checker of the other model, so all its names are known there, `let` items and outputs among
//! them. What accelerations and forces follow from is left to that model's own functions: a formula is of positions, velocities,
//! states, inputs, parameters and time. Which of them it reads once loops are closed only `mechanics` knows, which asks for the
//! values that are missing.

use std::collections::HashMap;
use std::rc::Rc;

use proc_macro2::Ident;
use syn::spanned::Spanned;
use syn::{Expr, ExprAssign, ExprCall};

use crate::invariant::kept::Kept;
use crate::model::checker::{Checker, Context, FIRST_SCOPE};
use crate::model::expand::root;
use crate::model::is_part;
use crate::model::typed::{Class, Typed, Uses, type_text};
use crate::model::types::{ExprNode, Formula, Given, Handling, Type, Variable};
use crate::model::units::{Units, Wanted};

use super::externals::external_in;
use super::{source_text, span};

/// What each call asks another model for, by its address: in an array of parts one call stands many times.
pub(in crate::model) type Elsewhere = HashMap<*const ExprCall, Option<Asked>>;

/// What a call asks for, before it has values.
#[derive(Clone)]
pub(in crate::model) struct Asked {
    formula: Rc<Formula>,
    /// What is given, in order.
    variables: Rc<[(Vec<Variable>, Type)]>,
    /// Their units in the model that is asked.
    units: Rc<[Option<Wanted>]>,
    /// A function of Rust that the question calls.
    calls: Option<String>,
}

impl<'a> Checker<'a, '_> {
    /// The module that is called like a function.
    pub(super) fn module_called(&self, name: &Ident) -> Option<usize> {
        self.modules.get(&name.to_string()).copied()
    }

    /// The value of an expression of another model.
    pub(super) fn formula(
        &mut self,
        name: &Ident,
        module: usize,
        call: &ExprCall,
        context: Context<'a>,
    ) -> Option<Typed> {
        let mut given = Vec::new();
        for pair in call.args.iter().skip(1) {
            let Expr::Assign(pair) = pair else {
                self.report.help(span(pair), "expected `variable = value`", form(name));
                return None;
            };
            given.push(pair);
        }
        let key = std::ptr::from_ref(call);
        let asked = match self.asked_elsewhere.get(&key) {
            Some(known) => known.clone(),
            None => {
                let asked = self.ask(name, module, call, &given);
                self.asked_elsewhere.insert(key, asked.clone());
                asked
            }
        };
        // What is wrong with the values is said whatever is wrong with the question.
        let values: Vec<Option<Typed>> = match &asked {
            Some(asked) => given
                .iter()
                .zip(asked.variables.iter())
                .map(|(pair, (_, ty))| self.expect(&pair.right, context, ty))
                .collect(),
            None => given.iter().map(|pair| self.value(&pair.right, context)).collect(),
        };
        let Some(asked) = asked else {
            self.report.silent();
            return None;
        };
        let values: Vec<Typed> = values.into_iter().collect::<Option<_>>()?;
        let listed = given.iter().zip(asked.variables.iter()).zip(asked.units.iter()).zip(&values);
        let listed = listed.map(|(((pair, (variables, _)), wanted), value)| Given {
            variables: variables.clone(),
            value: value.expr.clone(),
            wanted: wanted.clone(),
            span: span(&pair.left),
        });
        let ty = asked.formula.of.ty.clone();
        let node = ExprNode::Formula { given: listed.collect(), formula: asked.formula };
        let parts: Vec<&Typed> = values.iter().collect();
        let mut value = self.build(node, ty, call.span(), &parts)?;
        value.uses.merge(&Uses::of(Class::Formula, name.to_string(), name.span()));
        if let Some(function) = asked.calls {
            value.uses.add(Class::External, function, name.span());
        }
        Some(value)
    }

    /// Reads the question in the other model's terms.
    fn ask(&mut self, name: &Ident, module: usize, call: &ExprCall, given: &[&ExprAssign]) -> Option<Asked> {
        let at = name.span();
        let Some(of) = call.args.first() else {
            self.report.help(at, format!("`{name}` is a model: what of it?"), form(name));
            return None;
        };
        if is_part(&self.source.modules[module]) {
            let message = format!("`{name}` is a part: it has no equations of its own");
            self.report.help(at, message, "formulas are taken from models, which are modules without ports");
            return None;
        }
        if self.source.modules.iter().filter(|other| other.name == *name).count() > 1 {
            self.report.error(at, format!("there are two modules `{name}`: which one is meant is not known here"));
            return None;
        }
        if !self.sound.contains(&module) {
            if module >= self.module() && !self.alone {
                let message = format!("`{name}` does not stand above");
                self.report.help(at, message, "a formula is taken from a model that stands above in the same call");
            } else {
                // It has mistakes, which have been reported.
                self.report.silent();
            }
            return None;
        }
        let mut other = Checker::new(self.source, self.modules, self.sound, &mut *self.report, false);
        (other.fuel, other.depth) = (self.fuel, self.depth + 1);
        let asked = other.answer(name, module, of, given);
        self.fuel = other.fuel;
        asked
    }

    /// In the model that is asked.
    fn answer(&mut self, name: &Ident, module: usize, of: &Expr, given: &[&ExprAssign]) -> Option<Asked> {
        let Some(model) = self.model(module) else {
            self.report.silent();
            return None;
        };
        if matches!(model.handling, Handling::Auto) {
            let message =
                format!("`{name}` has `constraints: Auto`: which of its coordinates follow is not known here");
            self.report.help(name.span(), message, "write `Reduced` or `Multipliers` there");
            return None;
        }
        let context = root(FIRST_SCOPE);
        let value = self.asked_value(name, of, context);
        let mut complete = true;
        let mut variables: Vec<(Vec<Variable>, Type)> = Vec::new();
        for pair in given {
            let Some(found) = self.variables(&pair.left, context) else {
                complete = false;
                continue;
            };
            if variables.iter().flat_map(|known| &known.0).any(|known| found.0.contains(known)) {
                self.report.error(span(&pair.left), "this variable is named twice");
                complete = false;
                continue;
            }
            variables.push(found);
        }
        for (joint, at) in std::mem::take(&mut self.coordinate_uses) {
            let closing = &model.joints[joint];
            if model.cuts.contains(&joint) && !self.is_measured(closing) {
                self.refuse_cut_coordinate(joint, at, &model.joints);
                complete = false;
            }
        }
        let value = value.filter(|_| complete)?;
        self.check_changing_question(&model.bodies, &value.expr);
        let mut units = Units::of_asked(self, &model.constraints);
        let unit = units.question(&value.expr);
        let written = given.iter().zip(&variables);
        let wanted = written.map(|(pair, (variables, _))| units.wanted(source_text(&pair.left), variables)).collect();
        units.tell(self.report);
        let calls = external_in(&value.expr).map(|function| model.externals[function].name.to_string());
        let formula = Formula { model, of: value.expr, unit, solved: Kept::default() };
        Some(Asked { formula: Rc::new(formula), variables: variables.into(), units: wanted, calls })
    }

    /// A number, a vector or several of them, of what is known without forces.
    fn asked_value(&mut self, name: &Ident, of: &Expr, context: Context<'a>) -> Option<Typed> {
        let value = self.value(of, context)?;
        if !is_plain(&value.expr.ty) {
            let message = format!("numbers and vectors are taken from `{name}`, found {}", type_text(&value.expr.ty));
            self.report.help(span(of), message, "take `.position`, an entry, or a component of it");
            return None;
        }
        for class in [Class::Acceleration, Class::Load] {
            if let Some((at, subject)) = value.uses.culprit(class) {
                let message =
                    format!("{subject} follows from the equations of motion of `{name}`: there is no formula");
                self.report.help(at, message, "positions and velocities are formulas, and what is made of them");
                return None;
            }
        }
        Some(value)
    }
}

fn form(name: &Ident) -> String {
    format!(
        "write `{name}(expression, variable = value)`, both in the terms of `{name}`, the value in those of this model"
    )
}

fn is_plain(ty: &Type) -> bool {
    match ty {
        Type::Scalar | Type::Vec3 => true,
        Type::Array(element, _) => is_plain(element),
        Type::Bool | Type::Rotation | Type::Pose | Type::Twist | Type::Wrench | Type::Jacobian => false,
    }
}
