//! Equations for readers beside compiled functions, at states drawn at random.

use std::collections::HashMap;

use multibody_engine::compile;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::constraints::is_rate;
use multibody_engine::mechanics::loops::structure::{Role, Row, Structure};
use multibody_engine::mechanics::written::Page;
use multibody_engine::mechanics::{self, analysis};
use multibody_engine::model::types::{
    Coordinate, Docs, Expr, ExprNode, InstanceId, JointId, Model, Order, Output, Place, Request, Type,
};
use multibody_engine::optimize::program::Compiled;
use multibody_engine::symbolic::evaluate::solve_f64;

use proc_macro2::{Ident, Span};

use super::interpreter;

/// Beyond this a configuration is near a dead centre, where nothing can be told.
const MOST: f64 = 1e6;

/// The same of rates that follow from velocities of about one.
const MOST_RATE: f64 = 20.0;

/// What is left of a gap.
const CLOSED: f64 = 1e-14;
/// Most steps towards it.
const MOST_STEPS: usize = 30;

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
    /// Of the model as it is.
    pub page: Page,
    /// What the compiled functions tell of coordinates that follow, as the last of the outputs.
    following: Vec<(Coordinate, Order)>,
}

/// Coordinates outside of the state with their rates and accelerations, and those of coordinates whose rates follow.
fn following(model: &Model, structure: &Structure) -> Vec<(Coordinate, Order)> {
    let joints = (0..model.joints.len()).map(JointId).filter(|&joint| !model.joints[joint].kind.has_quaternion());
    let coordinates =
        joints.flat_map(|joint| (0..model.joints[joint].kind.freedoms()).map(move |index| Coordinate { joint, index }));
    let orders = |coordinate: Coordinate| -> &[Order] {
        match structure.role(coordinate) {
            Role::State if structure.rates.unknowns.contains(&coordinate) => &[Order::Rate, Order::Acceleration],
            Role::State => &[],
            _ => &[Order::Position, Order::Rate, Order::Acceleration],
        }
    };
    coordinates.flat_map(|coordinate| orders(coordinate).iter().map(move |&order| (coordinate, order))).collect()
}

fn output_of(list: &[(Coordinate, Order)]) -> Output {
    let expression = |node, ty| Expr::new(node, ty, Span::call_site());
    let entries = list.iter().map(|&(Coordinate { joint, index }, order)| {
        expression(ExprNode::Coordinate { joint, index, order }, Type::Scalar)
    });
    let value = expression(ExprNode::Array(entries.collect()), Type::Array(Box::new(Type::Scalar), list.len()));
    let place = Place { instance: InstanceId(0), field: Ident::new("following", Span::call_site()) };
    Output { place, value, docs: Docs::default() }
}

/// Whether an output solves for more unknowns than are written as quotients.
fn solves_with_pivots(model: &Model) -> bool {
    let mut open: Vec<&Expr> = model.outputs.iter().map(|output| &output.value).collect();
    let mut seen = std::collections::HashSet::new();
    while let Some(expr) = open.pop() {
        if !seen.insert(std::rc::Rc::as_ptr(&expr.node)) {
            continue;
        }
        if matches!(&*expr.node, ExprNode::Solved { size, .. } if *size > 3) {
            return true;
        }
        open.extend(expr.node.operands());
    }
    false
}

impl Written {
    /// Of a model with the functions that its equations speak of, and `more`; None where it has none, or no formulas because
    /// Newton's method closes its loops, a user's program drives it, or it solves systems with pivots, whose unknowns have names
    /// and no lines: among these are rates that follow from speeds or equations of velocities, unless they are few.
    pub(crate) fn new(mut model: Model, more: &[Request]) -> Option<Written> {
        model.emit = vec![Request::MassMatrix, Request::Bias, Request::InverseDynamics];
        model.emit.extend(more);
        let structure = analysis::analyse(&model).ok()?;
        if !structure.rows.is_empty() {
            model.emit.push(Request::Residual);
        }
        let driven = structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)));
        if structure.guesses() > 0 || driven && model.drives.is_empty() || solves_with_pivots(&model) {
            return None;
        }
        model.solve_for.clear();
        let following = following(&model, &structure);
        let own = model.outputs.len();
        if !following.is_empty() {
            model.outputs.push(output_of(&following));
        }
        let (structure, compiled) = compile(&model).ok()?;
        model.outputs.truncate(own);
        let Ok(page) = mechanics::page(&model, &structure) else { panic!("{}: no page", model.name) };
        if !page.unsolved.is_empty() {
            return None;
        }
        Some(Written { model, structure, compiled, page, following })
    }

    /// Positions, rates and accelerations of what follows, as compiled: symbols with their values.
    pub(crate) fn followed(&self, at: &HashMap<Symbol, f64>) -> Vec<(Symbol, f64)> {
        let outputs = self.run(FunctionKind::Outputs, at).unwrap_or_default();
        let own = outputs.len() - outputs.len().min(self.following.len());
        let symbols = self.following.iter().map(|&(Coordinate { joint, index: component }, order)| match order {
            Order::Position => Symbol::Position { joint, component },
            Order::Rate => Symbol::Velocity { joint, component },
            Order::Acceleration => Symbol::Acceleration { joint, component },
        });
        symbols.zip(outputs[own..].iter().copied()).collect()
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

    /// The next state with its loops closed at which mass matrix and bias have sizes that say something.
    pub(crate) fn state(&self, random: &mut Random) -> Option<HashMap<Symbol, f64>> {
        (0..40).filter_map(|_| self.closed(self.draw(random))).find(|at| {
            let sizes = [FunctionKind::MassMatrix, FunctionKind::Bias].map(|kind| self.run(kind, at));
            // What follows from velocities is ill-conditioned near poses in which it doesn't.
            let follows = if self.structure.has_speeds() { self.followed(at) } else { Vec::new() };
            let is_rate = |symbol: &Symbol| matches!(symbol, Symbol::Velocity { .. });
            let near = follows.iter().any(|(symbol, x)| is_rate(symbol) && (x.is_nan() || x.abs() > MOST_RATE));
            !near && sizes.iter().flatten().flatten().all(|x| x.is_finite() && x.abs() <= MOST)
        })
    }

    /// The state nearby with no gap in equations that keep multipliers: their efforts are what is written of them only there.
    fn closed(&self, mut at: HashMap<Symbol, f64>) -> Option<HashMap<Symbol, f64>> {
        for _ in 0..MOST_STEPS {
            let Some(gaps) = self.run(FunctionKind::Constraints, &at) else { return Some(at) };
            if gaps.iter().all(|gap| gap.abs() < CLOSED) {
                return Some(at);
            }
            let of_positions = self.run(FunctionKind::PositionJacobian, &at);
            let slopes = of_positions.or_else(|| self.run(FunctionKind::ConstraintJacobian, &at))?;
            let columns = slopes.len() / gaps.len();
            let rows: Vec<&[f64]> = slopes.chunks(columns).collect();
            // The shortest step; what keeps redundant equations solvable is lost in the next one.
            let square: Vec<f64> = (0..rows.len())
                .flat_map(|i| (0..rows.len()).map(move |j| (i, j)))
                .map(|(i, j)| {
                    rows[i].iter().zip(rows[j]).map(|(a, b)| a * b).sum::<f64>() + if i == j { 1e-9 } else { 0.0 }
                })
                .collect();
            let along = solve_f64(&square, &gaps);
            let step = |k: usize| -rows.iter().zip(&along).map(|(row, y)| row[k] * y).sum::<f64>();
            for (k, &coordinate) in self.structure.state.iter().enumerate() {
                self.displace(&mut at, coordinate, step(k));
            }
        }
        None
    }

    /// Moves along one velocity coordinate.
    pub(crate) fn displace(&self, at: &mut HashMap<Symbol, f64>, Coordinate { joint, index }: Coordinate, by: f64) {
        let kind = self.model.joints[joint].kind;
        let start = kind.turning().start;
        if !kind.has_quaternion() || index < start {
            *at.get_mut(&Symbol::Position { joint, component: index }).unwrap() += by;
            return;
        }
        // A small turn about an axis of the child: q (1, by / 2).
        let place = [0, 1, 2, 3].map(|k| Symbol::Position { joint, component: start + k });
        let [w, i, j, k] = place.map(|symbol| at[&symbol]);
        let turned = match index - start {
            0 => [-i, w, k, -j],
            1 => [-j, -k, w, i],
            _ => [-k, j, -i, w],
        };
        let next = [w, i, j, k].iter().zip(turned).map(|(q, d)| q + 0.5 * by * d).collect::<Vec<_>>();
        let size = next.iter().map(|x| x * x).sum::<f64>().sqrt();
        at.extend(place.into_iter().zip(next.into_iter().map(|x| x / size)));
    }

    /// Whether a symbol has an equation on the page, or none at all.
    pub(crate) fn follows(&self, symbol: Symbol) -> bool {
        let (joint, component, is_rate) = match symbol {
            Symbol::Position { joint, component } => (joint, component, false),
            Symbol::Velocity { joint, component } | Symbol::Acceleration { joint, component } => {
                (joint, component, true)
            }
            _ => return false,
        };
        // Speeds are behind all joints.
        if joint.0 >= self.model.joints.len() {
            return false;
        }
        let size = self.model.joints[joint].kind.freedoms();
        let coordinate = Coordinate { joint, index: component.min(size.saturating_sub(1)) };
        let is_state = self.structure.role(coordinate) == Role::State;
        !is_state || is_rate && self.structure.rates.unknowns.contains(&coordinate)
    }

    /// What is left of equations that keep multipliers, as compiled, if there are any; of an equation of velocities its own value.
    pub(crate) fn gaps(&self, at: &HashMap<Symbol, f64>) -> Option<Vec<f64>> {
        let positions = self.run(FunctionKind::Constraints, at)?;
        let rates = self.run(FunctionKind::ConstraintRate, at)?;
        let both = positions.into_iter().zip(rates);
        let of = |(&row, (gap, rate)): (&Row, (f64, f64))| if is_rate(&self.model, row) { rate } else { gap };
        Some(self.structure.rows.iter().zip(both).map(of).collect())
    }

    /// The equations of motion with what does not vanish, as compiled.
    pub(crate) fn motion(&self, at: &HashMap<Symbol, f64>) -> Option<Vec<f64>> {
        let found = self.run(FunctionKind::Residual, at).or_else(|| self.run(FunctionKind::InverseDynamics, at));
        found.map(|list| list[..self.structure.freedoms()].to_vec())
    }
}
