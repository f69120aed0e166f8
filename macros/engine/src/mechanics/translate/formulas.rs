//! Stage `mechanics`: what another model says, in this one's equations.
//!
//! In: a formula that `derive/formula` has solved, in a graph of its own, and values for that model's variables. Out: the same
//! expression in this graph, with the values in the place of the symbols, and the declared numbers in the place of parameters
//! without a value. From there on it is differentiated, shared and counted as anything else.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::contracts::symbol::Symbol;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::derive::formula::{Solved, Unsolved, solved};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{coordinate_name, path};
use crate::mechanics::loops::structure::{Role, Structure};
use crate::model::site::Sited;
use crate::model::types::{
    ConstraintKind, Coordinate, Expr, ExprNode, Formula, Given, Handling, Model, Order, SolveHow, Type, Variable,
};
use crate::symbolic::graph::{Scalar, SymbolId};

use super::values::Value;

impl Equations<'_> {
    /// The value of a formula: values of what is given are known.
    pub(super) fn formula(&mut self, formula: &Formula, given: &[(Vec<Variable>, Value)], ty: &Type) -> Value {
        let found = solved(formula);
        let Ok(solved) = &*found else { raise("formulas are looked at before anything is derived") };
        let mut values: HashMap<Variable, Scalar> = HashMap::new();
        for (variables, value) in given {
            let mut scalars = Vec::new();
            value.flatten(&mut self.g, &mut scalars);
            values.extend(variables.iter().copied().zip(scalars));
        }
        let put: HashMap<SymbolId, Scalar> = solved
            .reads
            .iter()
            .map(|&(id, symbol)| {
                let declared = || match symbol {
                    Symbol::Param { param, element } => {
                        let default = formula.model.params[param].default.get(element);
                        Some(self.g.decimal(*default.or_fault("a parameter has a number for each scalar")))
                    }
                    _ => None,
                };
                let value = variable(&formula.model, symbol).and_then(|variable| values.get(&variable).copied());
                (id, value.or_else(declared).or_fault("what a formula reads is given"))
            })
            .collect();
        let scalars = self.g.transplant(&solved.graph, &solved.scalars, &put, None);
        self.shaped(&scalars, ty)
    }
}

/// What is wrong with formulas of other models, wherever they stand.
pub(in crate::mechanics) fn complaints(model: &Model) -> Result<(), Vec<Complaint>> {
    complaints_of(roots(model))?;
    let complaints = calls_of_rust(model);
    if complaints.is_empty() { Ok(()) } else { Err(complaints) }
}

/// Formulas that call functions of the user's own Rust, where they would have to be known while the model is derived. What such a
/// formula says of itself is told by its class; that the forces of the other model call one, and it follows from them, is known here.
fn calls_of_rust(model: &Model) -> Vec<Complaint> {
    let (mut complaints, mut seen, mut stack) = (Vec::new(), HashSet::new(), deciding(model));
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        stack.extend(expr.node.operands());
        let ExprNode::Formula { formula, .. } = &*expr.node else { continue };
        let found = solved(formula);
        let Some(function) = found.as_ref().as_ref().ok().and_then(|solved| solved.calls) else { continue };
        complaints.push(Complaint {
            at: expr.site(),
            message: format!(
                "this calls `{}`, a function of Rust, whose values are not known while the model is derived",
                model.externals[function].name
            ),
            help: Some("it may stand in forces, states and outputs".to_owned()),
        });
    }
    complaints
}

/// The same of some expressions.
pub(in crate::mechanics) fn complaints_of(roots: Vec<&Expr>) -> Result<(), Vec<Complaint>> {
    let (mut complaints, mut seen, mut told) = (Vec::new(), HashSet::new(), HashSet::new());
    let mut is_sound = true;
    let mut stack = roots;
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        stack.extend(expr.node.operands());
        let ExprNode::Formula { formula, given } = &*expr.node else { continue };
        let found = match &*solved(formula) {
            Ok(solved) => of_formula(expr, formula, given, solved),
            Err(Unsolved::Here(complaint)) => vec![complaint.clone()],
            Err(Unsolved::Elsewhere) => {
                is_sound = false;
                continue;
            }
        };
        // A call in an array of parts is one mistake; but each element gives values of its own.
        if !found.is_empty() && told.insert(Rc::as_ptr(formula)) {
            complaints.extend(found);
        }
    }
    if is_sound && complaints.is_empty() { Ok(()) } else { Err(complaints) }
}

fn of_formula(expr: &Expr, formula: &Formula, given: &[Given], solved: &Solved) -> Vec<Complaint> {
    let model = &formula.model;
    let mut complaints = Vec::new();
    if solved.structure.has_speeds() {
        let message =
            format!("velocities of `{}` are not the rates of its coordinates: nothing can be asked of it", model.name);
        return vec![Complaint { at: formula.site(), message, help: None }];
    }
    for given in given {
        if let Some(name) = declared_only(model, &solved.structure, given) {
            complaints.push(Complaint {
                at: given.site(),
                message: format!("the loops of `{}` are known to close for the declared `{name}` only", model.name),
                help: Some("solve them by `solve (..) from ..`, with equations that hold for any".to_owned()),
            });
        }
        for &variable in &given.variables {
            if let Variable::Coordinate(coordinate, _) = variable
                && let Some(why) = not_given(model, &solved.structure, coordinate)
            {
                let message =
                    format!("{} {why} in `{}`: it is not given", coordinate_name(model, coordinate), model.name);
                complaints.push(Complaint { at: given.site(), message, help: None });
            }
        }
    }
    let is_given = |variable: Variable| given.iter().any(|given| given.variables.contains(&variable));
    let mut missing = Vec::new();
    for &(_, symbol) in &solved.reads {
        match variable(model, symbol) {
            Some(Variable::Param(..)) => {}
            Some(variable) if is_given(variable) => {}
            Some(variable) => missing.push(name(model, variable)),
            None => {
                let message = format!(
                    "this reads an orientation in `{}`, or its rate, that has no coordinates to give",
                    model.name
                );
                let help = Some("take `RollPitchYaw` there".to_owned());
                return vec![Complaint { at: expr.site(), message, help }];
            }
        }
    }
    missing.sort_unstable();
    missing.dedup();
    if let Some(first) = missing.first().filter(|_| complaints.is_empty()) {
        let all = missing.iter().map(|name| format!("`{name}`")).collect::<Vec<String>>().join(", ");
        complaints.push(Complaint {
            at: expr.site(),
            message: format!("this needs values of {all} in `{}`", model.name),
            help: Some(format!("write `{}(.., {first} = ..)`", model.name)),
        });
    }
    complaints
}

/// A parameter that keeps its declared value: equations hold for that alone, or formulas of the user were tested with it.
fn declared_only(model: &Model, structure: &Structure, given: &Given) -> Option<String> {
    let is_tested = model.solves.iter().any(|solve| matches!(solve.how, SolveHow::Formulas(_)));
    let is_declared = |at: usize, declared: f64| {
        let value = match &*given.value.node {
            ExprNode::Vec3(components) => &components[at].node,
            ExprNode::Array(elements) if elements.len() == given.variables.len() => &elements[at].node,
            _ => &given.value.node,
        };
        let value = &**value;
        matches!(value, ExprNode::Number(x) if *x == declared)
    };
    let is_kept = |&(at, variable): &(usize, &Variable)| match *variable {
        Variable::Param(id, element) => {
            let declared = model.params[id].default.get(element).copied();
            let declared = declared.or_fault("a parameter has a number for each scalar");
            (is_tested || structure.pinned.contains(&(id.0, element))) && !is_declared(at, declared)
        }
        _ => false,
    };
    given.variables.iter().enumerate().find(is_kept).map(|(_, &variable)| name(model, variable))
}

/// Why a coordinate takes no value.
fn not_given(model: &Model, structure: &Structure, coordinate: Coordinate) -> Option<&'static str> {
    if model.cuts.contains(&coordinate.joint) {
        return Some("is measured on a joint that closes a loop");
    }
    match structure.role(coordinate) {
        Role::State => None,
        Role::Driven(_) => Some("follows the time"),
        Role::Dependent(_) => Some("follows from others"),
    }
}

/// The variable that a symbol is; components of quaternions are none.
fn variable(model: &Model, symbol: Symbol) -> Option<Variable> {
    match symbol {
        Symbol::Time => Some(Variable::Time),
        Symbol::Param { param, element } => Some(Variable::Param(param, element)),
        Symbol::Input { input, element } => Some(Variable::Input(input, element)),
        Symbol::State { state } => Some(Variable::State(state)),
        Symbol::Position { joint, component } => {
            let freedom = model.joints[joint].kind.freedoms.get(component);
            freedom.map(|_| Variable::Coordinate(Coordinate { joint, index: component }, Order::Position))
        }
        Symbol::Velocity { joint, .. } if model.speed(joint).is_some() => None,
        Symbol::Velocity { joint, component } => {
            let freedom = model.joints[joint].kind.freedoms.get(component);
            freedom.map(|_| Variable::Coordinate(Coordinate { joint, index: component }, Order::Rate))
        }
        Symbol::Acceleration { .. }
        | Symbol::Multiplier { .. }
        | Symbol::Impulse { .. }
        | Symbol::Momentum { .. }
        | Symbol::Alternative { .. }
        | Symbol::Rate { .. }
        | Symbol::Guess { .. }
        | Symbol::Unknown { .. }
        | Symbol::UnknownPoint { .. }
        | Symbol::Number { .. } => None,
    }
}

/// A variable as it is written.
fn name(model: &Model, variable: Variable) -> String {
    match variable {
        Variable::Time => "t".to_owned(),
        Variable::Coordinate(coordinate, Order::Rate) => coordinate_name(model, coordinate) + ".rate",
        Variable::Coordinate(coordinate, _) => coordinate_name(model, coordinate),
        Variable::State(id) => path(model, &model.states[id].place),
        Variable::Param(id, element) => path(model, &model.params[id].place) + &place(&model.params[id].ty, element),
        Variable::Input(id, element) => path(model, &model.inputs[id].place) + &place(&model.inputs[id].ty, element),
    }
}

/// Behind the name of a parameter or an input, one of its scalars.
fn place(ty: &Type, scalar: usize) -> String {
    match ty {
        Type::Vec3 => format!(".{}", ["x", "y", "z"][scalar % 3]),
        Type::Array(element, _) => {
            let width = element.scalars().max(1);
            format!("[{}]{}", scalar / width, place(element, scalar % width))
        }
        _ => String::new(),
    }
}

/// Expressions in which formulas of other models may stand.
fn roots(model: &Model) -> Vec<&Expr> {
    let mut roots: Vec<&Expr> = model.outputs.iter().map(|output| &output.value).collect();
    roots.extend(model.states.iter().map(|state| &state.rate));
    for force in &model.forces {
        roots.extend(force.kind.values());
    }
    roots.extend(deciding(model));
    roots
}

/// Those that decide where the mechanism is.
fn deciding(model: &Model) -> Vec<&Expr> {
    let mut roots: Vec<&Expr> = model.drives.iter().map(|drive| &drive.value).collect();
    roots.extend(&model.assumptions);
    for solve in &model.solves {
        match &solve.how {
            SolveHow::Formulas(list) | SolveHow::From { branches: list, .. } => roots.extend(list),
        }
    }
    for constraint in &model.constraints {
        match &constraint.kind {
            ConstraintKind::Value(value) | ConstraintKind::Rate(value) | ConstraintKind::Rod { length: value, .. } => {
                roots.push(value);
            }
        }
    }
    if let Handling::Stabilised { rate, position } = &model.handling {
        roots.extend([rate, position]);
    }
    roots
}
