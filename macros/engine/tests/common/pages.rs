//! Equations for readers beside compiled functions, at states drawn at random.

use std::collections::HashMap;

use multibody_engine::compile;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::{Role, Structure};
use multibody_engine::mechanics::written::Page;
use multibody_engine::mechanics::{self, analysis};
use multibody_engine::model::types::{Coordinate, JointId, Model, Request};
use multibody_engine::optimize::program::Compiled;

use super::interpreter;

/// Beyond this a configuration is near a dead centre, where nothing can be told.
const MOST: f64 = 1e6;

/// Fractions between minus one and one.
pub(crate) struct Random(pub u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A model with its equations and its functions.
pub(crate) struct Written {
    pub model: Model,
    pub structure: Structure,
    pub compiled: Compiled,
    pub page: Page,
}

impl Written {
    /// Of a model with the functions that its equations speak of, and `more`; None where it has none, or no formulas because
    /// Newton's method closes its loops or a user's program drives it.
    pub(crate) fn new(mut model: Model, more: &[Request]) -> Option<Written> {
        model.emit = vec![Request::MassMatrix, Request::Bias, Request::InverseDynamics];
        model.emit.extend(more);
        let structure = analysis::analyse(&model).ok()?;
        if !structure.rows.is_empty() {
            model.emit.push(Request::Residual);
        }
        let driven = structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)));
        if structure.guesses() > 0 || driven && model.drives.is_empty() {
            return None;
        }
        model.solve_for.clear();
        let (structure, compiled) = compile(&model).ok()?;
        let Ok(page) = mechanics::page(&model, &structure) else { panic!("{}: no page", model.name) };
        Some(Written { model, structure, compiled, page })
    }

    /// Values of symbols at a state, near a configuration in which loops are closed.
    pub(crate) fn draw(&self, random: &mut Random) -> HashMap<Symbol, f64> {
        let mut quaternions: HashMap<JointId, f64> = HashMap::new();
        let mut found = HashMap::new();
        for (_, symbol) in &self.page.symbols {
            let draw = random.unit();
            let value = match *symbol {
                Symbol::Param { param, element } => self.model.params[param].default[element],
                Symbol::Position { joint, component } => {
                    let closed =
                        self.structure.closed.first().and_then(|c| c.positions[joint.0].get(component)).copied();
                    let kind = self.model.joints[joint].kind;
                    match kind.has_quaternion() && component >= kind.turning().start {
                        true => {
                            let x = closed.unwrap_or(0.0) + 0.4 * draw;
                            *quaternions.entry(joint).or_default() += x * x;
                            x
                        }
                        false => {
                            let wide = if self.structure.closed.is_empty() { 1.0 } else { 0.05 };
                            closed.unwrap_or(0.0) + wide * draw
                        }
                    }
                }
                _ => draw,
            };
            found.insert(*symbol, value);
        }
        for (symbol, value) in &mut found {
            if let Symbol::Position { joint, component } = *symbol
                && component >= self.model.joints[joint].kind.turning().start
                && let Some(square) = quaternions.get(&joint)
            {
                *value /= square.sqrt();
            }
        }
        found
    }

    /// Results of a function, if the model has it.
    pub(crate) fn run(&self, kind: FunctionKind, at: &HashMap<Symbol, f64>) -> Option<Vec<f64>> {
        let function = self.compiled.functions.iter().find(|f| f.kind == kind)?;
        let symbols = |symbol: Symbol| at.get(&symbol).copied().unwrap_or(f64::NAN);
        let fields = interpreter::run(&self.compiled.prelude, &symbols, &|_| f64::NAN);
        Some(interpreter::run(&function.program, &symbols, &|field| fields[field.0]))
    }

    /// The next state at which mass matrix and bias have sizes that say something.
    pub(crate) fn state(&self, random: &mut Random) -> Option<HashMap<Symbol, f64>> {
        (0..40).map(|_| self.draw(random)).find(|at| {
            let sizes = [FunctionKind::MassMatrix, FunctionKind::Bias].map(|kind| self.run(kind, at));
            sizes.iter().flatten().flatten().all(|x| x.is_finite() && x.abs() <= MOST)
        })
    }

    /// Whether a symbol has an equation on the page, or none at all.
    pub(crate) fn follows(&self, symbol: Symbol) -> bool {
        let (joint, component) = match symbol {
            Symbol::Position { joint, component }
            | Symbol::Velocity { joint, component }
            | Symbol::Acceleration { joint, component } => (joint, component),
            _ => return false,
        };
        let size = self.model.joints[joint].kind.freedoms();
        self.structure.role(Coordinate { joint, index: component.min(size.saturating_sub(1)) }) != Role::State
    }

    /// The equations of motion with what does not vanish, as compiled.
    pub(crate) fn motion(&self, at: &HashMap<Symbol, f64>) -> Option<Vec<f64>> {
        let found = self.run(FunctionKind::Residual, at).or_else(|| self.run(FunctionKind::InverseDynamics, at));
        found.map(|list| list[..self.structure.state.len()].to_vec())
    }
}
