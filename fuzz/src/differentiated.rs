//! `diff` of energies and outputs of all models of the project, against differences of the values themselves.
//!
//! Values and derivatives come from one compiled function at states with loops closed; the differences are central, of sixth
//! order, along the motions that the model has: a coordinate of the state takes those along that follow from it.

use std::collections::HashMap;
use std::path::Path;

use multibody_engine::compile;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::freedoms;
use multibody_engine::mechanics::loops::structure::Role;
use multibody_engine::model::types::{
    Coordinate, Docs, Expr, ExprNode, FrameQuantity, InputId, InstanceId, Model, Order, Output, ParamId, Place,
    Request, StateId, Type, Variable,
};
use multibody_engine::optimize::program::Compiled;
use proc_macro2::{Ident, Span};

use crate::corpus;
use crate::interpreter;
use crate::pages::{Random, Written};

/// What is looked at.
pub struct Plan {
    /// Of all models as many as this, chosen at random.
    pub models: usize,
    /// For each model.
    pub states: usize,
    /// Of the choice and of the states.
    pub seed: u64,
    /// Larger models are left out.
    pub most_freedoms: usize,
}

/// What came of it.
#[derive(Default)]
pub struct Found {
    /// Models looked at.
    pub models: usize,
    /// Derivatives compared.
    pub numbers: usize,
    /// Largest error, of the size of the derivative, of the value, and of one.
    pub worst: f64,
    /// What is further off than [`TOLERANCE`].
    pub wrong: Vec<String>,
}

/// Differences of sixth order end here.
pub const TOLERANCE: f64 = 1e-9;

/// Wide ones round least, narrow ones end well where values bend: the best of them counts.
pub(crate) const STEPS: [f64; 3] = [2e-3, 3e-4, 4e-5];

/// Weights of the differences at one, two and three steps.
pub(crate) const WEIGHTS: [f64; 3] = [45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0];

/// Looks at the models of the project.
pub fn run(plan: &Plan) -> Found {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let calls = corpus::PLACES.iter().flat_map(|place| corpus::calls_of(&root, place));
    // Twice: once as it is, for states with loops closed, and once for values and derivatives.
    let pairs = calls.flat_map(|(_, call)| corpus::models(call.clone()).into_iter().zip(corpus::models(call)));
    let mut models: Vec<(Model, Model)> = pairs.filter(|pair| freedoms(&pair.0) <= plan.most_freedoms).collect();
    let mut random = Random(plan.seed);
    let mut found = Found::default();
    while found.models < plan.models && !models.is_empty() {
        let drawn = ((random.unit() + 1.0) / 2.0 * models.len() as f64) as usize;
        let (model, other) = models.remove(drawn.min(models.len() - 1));
        let name = model.name.to_string();
        let Some(of) = Written::new(model, &[]) else { continue };
        // By coordinates and their rates: states in other velocities can't be moved so.
        if of.structure.has_speeds() {
            continue;
        }
        let Some(differentiated) = Differentiated::new(&of, other) else { continue };
        found.models += 1;
        for _ in 0..plan.states {
            let Some(at) = of.state(&mut random) else { break };
            differentiated.compare(&of, &at, &name, &mut found);
        }
    }
    found
}

/// Values and their derivatives, one function.
struct Differentiated {
    compiled: Compiled,
    variables: Vec<Variable>,
    /// Scalars of each value.
    widths: Vec<usize>,
}

impl Differentiated {
    fn new(of: &Written, mut model: Model) -> Option<Differentiated> {
        let variables = variables(of);
        let mut values =
            vec![expression(ExprNode::Kinetic, Type::Scalar), expression(ExprNode::Potential, Type::Scalar)];
        let frames = of.model.outputs.iter().map(|output| &output.value).filter(|value| is_moving(value));
        values.extend(frames.take(2).cloned());
        let widths = values.iter().map(|value| if value.ty == Type::Vec3 { 3 } else { 1 }).collect();
        let mut outputs: Vec<Output> = values.iter().cloned().map(output).collect();
        for value in &values {
            for &by in &variables {
                let node = ExprNode::Derivative { of: value.clone(), by, accelerated: false };
                outputs.push(output(expression(node, value.ty.clone())));
            }
        }
        model.outputs = outputs;
        // Where nothing is asked for, forward dynamics is.
        model.emit = vec![Request::MassMatrix];
        model.kinematics.clear();
        model.solve_for.clear();
        let (_, compiled) = compile(&model).ok()?;
        Some(Differentiated { compiled, variables, widths })
    }

    fn run(&self, at: &HashMap<Symbol, f64>) -> Vec<f64> {
        let symbols = |symbol: Symbol| at.get(&symbol).copied().unwrap_or(f64::NAN);
        let fields = interpreter::run(&self.compiled.prelude, &symbols, &|_| f64::NAN);
        let function = self.compiled.functions.iter().find(|f| f.kind == FunctionKind::Outputs);
        function.map_or_else(Vec::new, |f| interpreter::run(&f.program, &symbols, &|field| fields[field.0]))
    }

    /// Of all values, by one variable.
    fn difference(&self, of: &Written, at: &HashMap<Symbol, f64>, by: Variable, step: f64) -> Vec<f64> {
        let mut slopes = vec![0.0; self.widths.iter().sum()];
        for (steps, weight) in (1..).zip(WEIGHTS) {
            let [after, before] = [1.0, -1.0].map(|sign| self.run(&moved(of, at, by, sign * f64::from(steps) * step)));
            for ((slope, after), before) in slopes.iter_mut().zip(after).zip(before) {
                *slope += weight * (after - before) / step;
            }
        }
        slopes
    }

    fn compare(&self, of: &Written, at: &HashMap<Symbol, f64>, name: &str, found: &mut Found) {
        let here = self.run(at);
        let count: usize = self.widths.iter().sum();
        for (k, &by) in self.variables.iter().enumerate() {
            let slopes = STEPS.map(|step| self.difference(of, at, by, step));
            let (mut value, mut derivatives) = (0, count);
            for &width in &self.widths {
                for component in 0..width {
                    let got = here[derivatives + k * width + component];
                    let size = 1.0 + here[value + component].abs();
                    let error = |want: f64| (got - want).abs() / (size + want.abs());
                    let wanted = slopes.each_ref().map(|slopes| slopes[value + component]);
                    let want = wanted.into_iter().min_by(|a, b| error(*a).total_cmp(&error(*b))).unwrap_or(f64::NAN);
                    let error = error(want);
                    found.numbers += 1;
                    found.worst = found.worst.max(error);
                    if error.is_nan() || error > TOLERANCE {
                        found.wrong.push(format!("{name}: {by:?}: {got} for {want}"));
                    }
                }
                value += width;
                derivatives += width * self.variables.len();
            }
        }
    }
}

/// The state with one variable moved.
fn moved(of: &Written, at: &HashMap<Symbol, f64>, by: Variable, step: f64) -> HashMap<Symbol, f64> {
    let mut at = at.clone();
    match by {
        Variable::Coordinate(coordinate, Order::Position) => of.displace(&mut at, coordinate, step),
        other => {
            if let Some(value) = symbol(other).and_then(|symbol| at.get_mut(&symbol)) {
                *value += step;
            }
        }
    }
    at
}

pub(crate) fn symbol(variable: Variable) -> Option<Symbol> {
    match variable {
        Variable::Time => None,
        Variable::Coordinate(Coordinate { joint, index: component }, Order::Rate) => {
            Some(Symbol::Velocity { joint, component })
        }
        Variable::Coordinate(Coordinate { joint, index: component }, _) => Some(Symbol::Position { joint, component }),
        Variable::State(state) => Some(Symbol::State { state }),
        Variable::Param(param, element) => Some(Symbol::Param { param, element }),
        Variable::Input(input, element) => Some(Symbol::Input { input, element }),
    }
}

/// All that may be differentiated by; parameters where nothing follows from other coordinates.
fn variables(of: &Written) -> Vec<Variable> {
    let (model, structure) = (&of.model, &of.structure);
    let mut variables = Vec::new();
    for &coordinate in &structure.state {
        let kind = model.joints[coordinate.joint].kind;
        if !kind.has_quaternion() || coordinate.index < kind.turning().start {
            variables.push(Variable::Coordinate(coordinate, Order::Position));
        }
        variables.push(Variable::Coordinate(coordinate, Order::Rate));
    }
    variables.extend((0..model.states.len()).map(|k| Variable::State(StateId(k))));
    let inputs = (0..model.inputs.len()).map(InputId);
    variables.extend(inputs.flat_map(|id| (0..model.inputs[id].ty.scalars()).map(move |k| Variable::Input(id, k))));
    if structure.roles.iter().flatten().all(|role| *role == Role::State) {
        let params = (0..model.params.len()).map(ParamId);
        variables
            .extend(params.flat_map(|id| (0..model.params[id].default.len()).map(move |k| Variable::Param(id, k))));
    }
    variables
}

/// A position or velocity of a frame.
fn is_moving(value: &Expr) -> bool {
    matches!(&*value.node, ExprNode::OfFrame(_, FrameQuantity::Position | FrameQuantity::Velocity))
}

fn expression(node: ExprNode, ty: Type) -> Expr {
    Expr::new(node, ty, Span::call_site())
}

fn output(value: Expr) -> Output {
    let place = Place { instance: InstanceId(0), field: Ident::new("value", Span::call_site()) };
    Output { place, value, docs: Docs::default() }
}
