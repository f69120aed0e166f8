//! Stage `mechanics`: typed expressions become nodes of the graph.
//!
//! In: expressions of the checked model, a tree with shared branches. Out: [`Value`]s. Each shared branch is translated
//! once, and operands go first on a stack of their own, so that a long chain of `let` items needs no deep recursion.

use std::collections::HashMap;
use std::rc::Rc;

use crate::contracts::call::Call;
use crate::invariant::fault::{OrFault, raise};
use crate::invariant::injection::{Break, broken};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{ClosedIn, Writing, row_called};
use crate::mechanics::loops::structure::Role;
use crate::model::types::{Coordinate, Expr, ExprNode, Order};
use crate::symbolic::graph::{Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::directions;
use super::values::{Part, TYPES, Value};

/// Values of expressions.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Memo {
    /// By address: the model outlives this.
    known: HashMap<*const ExprNode, Value>,
}

impl Equations<'_> {
    /// The value of an expression.
    pub(in crate::mechanics) fn value(&mut self, expr: &Expr) -> Value {
        let mut stack = vec![expr];
        while let Some(&top) = stack.last() {
            let key = Rc::as_ptr(&top.node);
            if !self.caches.memo.known.contains_key(&key) {
                let before = stack.len();
                let open = |e: &&Expr| !self.caches.memo.known.contains_key(&Rc::as_ptr(&e.node));
                stack.extend(top.node.operands().into_iter().filter(open));
                if stack.len() > before {
                    continue;
                }
                let value = self.node(&top.node);
                self.caches.memo.known.insert(key, value);
            }
            stack.pop();
        }
        self.known(expr)
    }

    pub(in crate::mechanics) fn scalar(&mut self, expr: &Expr) -> Scalar {
        self.value(expr).scalar()
    }

    pub(in crate::mechanics) fn vector(&mut self, expr: &Expr) -> Vector {
        let value = self.value(expr);
        value.vector(&mut self.g)
    }

    /// The value of an operand, which is there when its user is translated.
    fn known(&self, expr: &Expr) -> Value {
        self.caches
            .memo
            .known
            .get(&Rc::as_ptr(&expr.node))
            .cloned()
            .or_fault("operands are translated before their users")
    }

    fn known_vector(&mut self, expr: &Expr) -> Vector {
        self.known(expr).vector(&mut self.g)
    }

    fn node(&mut self, node: &ExprNode) -> Value {
        match node {
            ExprNode::Number(x) => Value::Scalar(self.g.decimal(*x)),
            ExprNode::Pi => Value::Scalar(self.g.pi()),
            ExprNode::Time => Value::Scalar(self.scene.symbols.time),
            ExprNode::Param(id) => {
                if broken(Break::LostParameter) {
                    return Value::Scalar(Scalar::ONE);
                }
                let scene = Rc::clone(&self.scene);
                self.shaped(&scene.symbols.params[id.0], &scene.model.params[*id].ty)
            }
            ExprNode::Input(id) => {
                let scene = Rc::clone(&self.scene);
                self.shaped(&scene.symbols.inputs[id.0], &scene.model.inputs[*id].ty)
            }
            ExprNode::State(id) => Value::Scalar(self.scene.symbols.states[id.0]),
            &ExprNode::Coordinate { joint, index, order } => {
                Value::Scalar(self.coordinate(Coordinate { joint, index }, order))
            }
            &ExprNode::RelativeAngularVelocity(joint) => Value::Vector(match self.stands_apart() {
                true => self.read_relative_angular_velocity(joint),
                false => self.relative_angular_velocity(joint),
            }),
            &ExprNode::Effort { joint, index } => {
                let coordinate = Coordinate { joint, index };
                Value::Scalar(match self.scene.structure.role(coordinate) {
                    Role::Driven(_) => self.drive_effort(coordinate),
                    _ if self.is_held(coordinate) => self.holding_effort(coordinate),
                    _ => self.effort(joint, index),
                })
            }
            ExprNode::OfFrame(frame, quantity) => {
                let place = self.place(frame);
                if self.stands_apart() { self.read_place(&place, *quantity) } else { self.of_place(&place, *quantity) }
            }
            ExprNode::Jacobian { frame, axes } => {
                let (place, axes) = (self.place(frame), self.place(axes));
                self.jacobian(&place, &axes)
            }
            ExprNode::Reaction { joint, axes } => {
                let axes = self.place(axes);
                self.reaction(*joint, &axes)
            }
            &ExprNode::Multiplier(constraint) => Value::Scalar(self.multiplier(constraint)),
            ExprNode::Power(force) => Value::Scalar(self.power(*force)),
            ExprNode::Kinetic => Value::Scalar(self.kinetic()),
            ExprNode::Potential => Value::Scalar(self.potential()),
            ExprNode::OfBodies(bodies, quantity) => self.of_bodies(bodies, *quantity),
            ExprNode::Derivative { of, by, accelerated } => {
                let of = self.known(of);
                self.derivative(&of, *by, *accelerated)
            }
            ExprNode::Substituted { of, pairs } => {
                let pairs: Vec<_> = pairs.iter().map(|(by, value)| (*by, self.known(value).scalar())).collect();
                let of = self.known(of);
                self.substituted(&of, &pairs)
            }
            ExprNode::Solved { system, size, index } => {
                let system: Vec<Scalar> = system.iter().map(|entry| self.known(entry).scalar()).collect();
                Value::Scalar(self.solved_system(system, *size, *index))
            }
            ExprNode::OneOfTwo { form, coefficients, second } => {
                let coefficients = coefficients.each_ref().map(|entry| self.known(entry).scalar());
                Value::Scalar(self.one_of_two(*form, coefficients, *second))
            }
            ExprNode::Formula { formula, given } => {
                let given: Vec<_> =
                    given.iter().map(|given| (given.variables.clone(), self.known(&given.value))).collect();
                self.formula(formula, &given, &formula.of.ty)
            }
            ExprNode::Residual { closing, component } => {
                let index = row_called(self.scene.model, *closing, component.as_deref());
                let index = index.or_fault("names of equations are looked at before anything is derived");
                // In the axes that equations are named by, whatever those are in which loops are closed.
                let rows = self.residuals(*closing, Writing { axes: ClosedIn::Parent, ..Writing::PLAIN });
                Value::Scalar(rows.get(index).copied().or_fault("a row is one of the equations of its closing"))
            }
            &ExprNode::Closed(coordinate) => Value::Scalar(self.coordinate(coordinate, Order::Position)),
            ExprNode::Undefined => Value::Scalar(self.g.call(Call::Nan, &[])),
            ExprNode::Unknown(_) => raise("unknowns stand inside their equations, which have been solved"),
            &ExprNode::MassMatrix(entry) => Value::Scalar(self.mass_matrix_entry(entry)),
            &ExprNode::Bias(coordinate) => Value::Scalar(self.bias_entry(coordinate)),
            ExprNode::Express { frame, vector } => {
                let place = self.place(frame);
                Value::Vector(if self.stands_apart() {
                    let v = self.known_vector(vector);
                    self.read_express(&place, v)
                } else {
                    self.express(&place, vector)
                })
            }
            _ => self.operation(node),
        }
    }

    /// Nodes whose operands are known.
    fn operation(&mut self, node: &ExprNode) -> Value {
        match node {
            ExprNode::Vec3(components) => {
                let components = [0, 1, 2].map(|k| self.known(&components[k]).scalar());
                Value::Vector(self.g.vector(components))
            }
            ExprNode::Identity => self.rotation_value(Rotation::IDENTITY),
            ExprNode::RotationAbout { axis, angle } => {
                let axis = self.known_vector(axis);
                let axis = self.g.components(axis);
                let angle = self.known(angle).scalar();
                let rotation = directions::about(&mut self.g, axis, angle);
                self.rotation_value(rotation)
            }
            ExprNode::RollPitchYaw(angles) => {
                let turns = [2, 1, 0].map(|k| {
                    let angle = self.known(&angles[k]).scalar();
                    self.g.axis_rotation(k, angle)
                });
                let rotation = rotations::compose(&mut self.g, turns[1], turns[2]);
                let rotation = rotations::compose(&mut self.g, turns[0], rotation);
                self.rotation_value(rotation)
            }
            ExprNode::Compose(a, b) => {
                let [a, b] = [a, b].map(|e| self.known_rotation(e));
                let rotation = rotations::compose(&mut self.g, a, b);
                self.rotation_value(rotation)
            }
            ExprNode::Rotated(rotation, vector) => {
                let (rotation, vector) = (self.known_rotation(rotation), self.known_vector(vector));
                Value::Vector(self.g.rotate(rotation, vector))
            }
            ExprNode::Pose(position, orientation) => {
                let position = self.known_vector(position);
                let rows = match self.known(orientation) {
                    Value::Rotation(rows) => *rows,
                    _ => raise(TYPES),
                };
                Value::Pose(position, super::orientation::of_rows(&mut self.g, &rows))
            }
            ExprNode::Array(list) => Value::Array(list.iter().map(|e| self.known(e)).collect()),
            ExprNode::Index(array, index) => match self.known(array) {
                Value::Array(list) => list[*index].clone(),
                Value::Vector(v) => Value::Scalar(self.g.component(v, (*index).min(2))),
                _ => raise(TYPES),
            },
            ExprNode::Component(vector, axis) => {
                let vector = self.known_vector(vector);
                Value::Scalar(self.g.component(vector, (*axis).min(2)))
            }
            ExprNode::Linear(pair) => match self.known(pair) {
                Value::Pair(first, _) | Value::Pose(first, _) => Value::Vector(first),
                _ => raise(TYPES),
            },
            ExprNode::Angular(pair) => match self.known(pair) {
                Value::Pair(_, second) => Value::Vector(second),
                _ => raise(TYPES),
            },
            ExprNode::Neg(a) => self.known(a).map(&mut self.g, &mut |_, part| match part {
                Part::Scalar(s) => Part::Scalar(-s),
                Part::Vector(v) => Part::Vector(-v),
            }),
            ExprNode::Add(a, b) => self.both(a, b, |g, x, y| g.add(x, y), |g, x, y| g.add_vectors(x, y)),
            ExprNode::Sub(a, b) => self.both(a, b, |g, x, y| g.sub(x, y), |g, x, y| g.sub_vectors(x, y)),
            ExprNode::Mul(a, b) => match (self.known(a), self.known(b)) {
                (Value::Scalar(x), y) | (y, Value::Scalar(x)) => self.scaled(x, &y),
                _ => raise(TYPES),
            },
            ExprNode::Div(a, b) => {
                let divisor = self.known(b).scalar();
                let dividend = self.known(a);
                let factor = self.g.reciprocal(divisor);
                if divisor == Scalar::ZERO {
                    // Nothing by nothing is no more a number than anything else by nothing, which is refused.
                    return dividend.map(&mut self.g, &mut |g, part| match part {
                        Part::Scalar(_) => Part::Scalar(factor),
                        Part::Vector(_) => Part::Vector(g.vector([factor; 3])),
                    });
                }
                self.scaled(factor, &dividend)
            }
            ExprNode::Call(function, arguments) => {
                let arguments: Vec<Value> = arguments.iter().map(|e| self.known(e)).collect();
                super::functions::call(&mut self.g, *function, &arguments)
            }
            ExprNode::External(function, arguments) => {
                let arguments: Vec<Scalar> = arguments.iter().map(|e| self.known(e).scalar()).collect();
                let value = self.g.call(Call::External(*function), &arguments);
                let name = &self.scene.model.externals[*function].name;
                Value::Scalar(self.g.label(value, || name.to_string().replace("r#", "")))
            }
            ExprNode::Compare(comparison, a, b) => {
                let (a, b) = (self.known(a).scalar(), self.known(b).scalar());
                Value::Scalar(super::functions::compare(&mut self.g, *comparison, a, b))
            }
            ExprNode::And(a, b) => self.mask(Call::And, &[a, b]),
            ExprNode::Or(a, b) => self.mask(Call::Or, &[a, b]),
            ExprNode::Not(a) => self.mask(Call::Not, &[a]),
            ExprNode::Select(condition, a, b) => {
                let mask = self.known(condition).scalar();
                let choose = move |g: &mut crate::symbolic::graph::Graph, x, y| g.call(Call::Select, &[mask, x, y]);
                self.both(a, b, choose, move |g, x, y| {
                    let (x, y) = (g.components(x), g.components(y));
                    let chosen = [0, 1, 2].map(|k| choose(g, x[k], y[k]));
                    g.vector(chosen)
                })
            }
            _ => raise(TYPES),
        }
    }

    fn rotation_value(&mut self, rotation: Rotation) -> Value {
        Value::Rotation(Rc::new(rotations::rows(&mut self.g, rotation)))
    }

    fn known_rotation(&mut self, expr: &Expr) -> Rotation {
        match self.known(expr) {
            Value::Rotation(rows) => self.g.matrix_rotation(*rows),
            _ => Rotation::IDENTITY,
        }
    }

    fn both(
        &mut self,
        a: &Expr,
        b: &Expr,
        mut scalars: impl FnMut(&mut crate::symbolic::graph::Graph, Scalar, Scalar) -> Scalar,
        mut vectors: impl FnMut(&mut crate::symbolic::graph::Graph, Vector, Vector) -> Vector,
    ) -> Value {
        let (a, b) = (self.known(a), self.known(b));
        a.zip(&b, &mut self.g, &mut scalars, &mut vectors)
    }

    fn scaled(&mut self, factor: Scalar, value: &Value) -> Value {
        value.map(&mut self.g, &mut |g, part| match part {
            Part::Scalar(s) => Part::Scalar(g.mul(factor, s)),
            Part::Vector(v) => Part::Vector(g.scale(factor, v)),
        })
    }

    fn mask(&mut self, call: Call, operands: &[&Expr]) -> Value {
        let operands: Vec<Scalar> = operands.iter().map(|e| self.known(e).scalar()).collect();
        Value::Scalar(self.g.call(call, &operands))
    }
}
