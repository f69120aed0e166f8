//! Whether what depends on parameters alone was translated to the value that it has.
//!
//! In: the checked model. Out: nothing, or a fault. What is wrong in the translation is wrong in all functions alike, so no law
//! between them tells of it. The numeric checks of the model have an evaluator of their own, which knows no graph; its values
//! are compared with those on the graph, with parameters off their defaults, each by a part of its own, and so with states that
//! bodies follow. Compared are inertial
//! parameters, armatures, gravity, frames with their turns, directions of joints as far as they are written, pitches, lengths of
//! rods and what forces are given.

use crate::contracts::symbol::Symbol;
use crate::dynamics::tree::Motion;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::equations::Equations;
use crate::model::checks::evaluate::{Evaluator as Checker, Value};
use crate::model::checks::placement;
use crate::model::types::{ConstraintKind, Directions, Expr, ForceKind, Frame, Joint, Model, ParamId, StateId, Type};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};
use crate::symbolic::rotations;

/// Of two evaluations in double precision, how often what a value moves by when all that is rounded moves by its last digits,
/// and how often what a typed matrix lacks to be a rotation: it stands for one within twice of that.
const TOLERANCE: f64 = 1e-9;
const NOISE: f64 = 1e3;
const DEFECT: f64 = 4.0;

/// What is rounded is moved by so many of its last digits, to see how far values are known.
const LAST_DIGITS: [f64; 5] = [0.0, 1.0, -1.0, 3.0, -2.0];

/// What has a value of its own in the model.
enum Quantity<'m> {
    Scalar(&'m Expr),
    Vector(&'m Expr),
    /// Its pose in its body.
    Frame(&'m Frame),
    /// Directions, and metres per radian along each that a screw turns about.
    Joint(&'m Joint),
    /// Stiffness, damping, and where there is no force.
    Spring([&'m Option<Expr>; 3]),
}

/// A value of the model's own evaluator, and how far the translated one may be from it.
struct Expected {
    value: f64,
    reach: f64,
}

pub(in crate::mechanics) fn check(model: &Model) {
    let mut checkers = LAST_DIGITS.map(|digits| checker(model, digits));
    let mut equations = Equations::plain(model);
    let (mut expected, mut translated): (Vec<Expected>, Vec<Scalar>) = (Vec::new(), Vec::new());
    for quantity in quantities(model) {
        if let Some(known) = quantity.known(&mut checkers) {
            expected.extend(known);
            quantity.translated(&mut equations, &mut translated);
        }
    }
    let table = &equations.scene.symbols.table;
    let value = |id: SymbolId| match table.get(id.0) {
        Some(&Symbol::Param { param, element }) => drawn(model, param, element),
        Some(&Symbol::State { state }) => begun(model, state),
        // No value of parameters alone reads another symbol, but branches that are not taken may.
        _ => f64::NAN,
    };
    let found = Evaluator::new(&equations.g, Real { symbols: &value }).run(&translated);
    // A model that holds a literal below or beyond the range of numbers is refused for that.
    let is_lost = |root: Scalar| {
        let scalars = equations.g.reachable_scalars(&[root]).into_iter().map(|index| equations.g.scalar_at(index));
        scalars.filter_map(|s| equations.g.literal(s)).any(|literal| !literal.value().is_finite())
    };
    let differs = |((expected, &found), &root): ((&Expected, &f64), &Scalar)| {
        if found.is_nan() { !is_lost(root) } else { (expected.value - found).abs() > expected.reach }
    };
    if expected.len() != found.len() || expected.iter().zip(&found).zip(&translated).any(differs) {
        raise("an expression of parameters is translated to its value");
    }
}

fn quantities(model: &Model) -> Vec<Quantity<'_>> {
    let mut list = Vec::new();
    for body in &model.bodies {
        list.extend([Quantity::Scalar(&body.mass), Quantity::Vector(&body.com)]);
        list.extend(body.inertia.iter().flat_map(|entries| entries.iter()).map(Quantity::Scalar));
    }
    for joint in &model.joints {
        list.extend([Quantity::Joint(joint), Quantity::Frame(&joint.parent), Quantity::Frame(&joint.child)]);
        list.extend(joint.armature.iter().map(Quantity::Scalar));
    }
    for constraint in &model.constraints {
        match &constraint.kind {
            ConstraintKind::Rod { between, length } => {
                list.extend(between.iter().map(Quantity::Frame));
                list.push(Quantity::Scalar(length));
            }
            ConstraintKind::Value(_) | ConstraintKind::Rate(_) => {}
        }
    }
    for force in &model.forces {
        match &force.kind {
            ForceKind::Effort { values, .. } => list.extend(values.iter().map(Quantity::Scalar)),
            ForceKind::JointSpring { stiffness, damping, rest, .. } => {
                list.push(Quantity::Spring([stiffness, damping, rest]));
            }
            ForceKind::LineSpring { between, stiffness, damping, length } => {
                list.extend(between.iter().map(Quantity::Frame));
                list.push(Quantity::Spring([stiffness, damping, length]));
            }
            ForceKind::Force { at, value, axes } | ForceKind::Torque { at, value, axes } => {
                list.extend([Quantity::Frame(at), Quantity::Vector(value), Quantity::Frame(axes)]);
            }
        }
    }
    list.extend(model.gravity.iter().map(Quantity::Vector));
    list
}

impl Quantity<'_> {
    /// Nothing if it hangs on more than parameters, or on how something is rounded.
    fn known(&self, checkers: &mut [Checker; LAST_DIGITS.len()]) -> Option<Vec<Expected>> {
        let [plain, moved @ ..] = checkers;
        let values = self.values(plain)?;
        let defect = match self {
            Quantity::Frame(frame) => placement::defect(plain, frame)?,
            _ => 0.0,
        };
        let size = 1.0 + values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut noise = vec![0.0_f64; values.len()];
        for checker in moved {
            for ((noise, value), other) in noise.iter_mut().zip(&values).zip(self.values(checker)?) {
                *noise = noise.max((other - value).abs());
            }
        }
        let expected = values.into_iter().zip(noise).map(|(value, noise)| Expected {
            value,
            reach: TOLERANCE * (1.0 + value.abs()) + NOISE * noise + DEFECT * defect * size,
        });
        Some(expected.collect())
    }

    /// What the checks of the model take it for, if it is finite.
    fn values(&self, checker: &mut Checker) -> Option<Vec<f64>> {
        let values = match self {
            Quantity::Scalar(expr) => vec![checker.scalar(expr)?],
            Quantity::Vector(expr) => checker.vector(expr)?.to_vec(),
            Quantity::Frame(frame) => {
                let pose = placement::pose(checker, frame)?;
                [pose.rotation.as_flattened(), &pose.position].concat()
            }
            Quantity::Joint(joint) => {
                let mut values = placement::directions(checker, &joint.directions)?[..written(joint)].concat();
                if let Some(pitch) = &joint.pitch {
                    values.extend([checker.scalar(pitch)?].repeat(joint.kind.freedoms.len()));
                }
                values
            }
            Quantity::Spring(data) => {
                let known = |expr: &&Option<Expr>| expr.as_ref().map_or(Some(0.0), |expr| checker.scalar(expr));
                data.iter().map(known).collect::<Option<_>>()?
            }
        };
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    /// The same as nodes of the graph, in the same order.
    fn translated(&self, equations: &mut Equations<'_>, into: &mut Vec<Scalar>) {
        match self {
            Quantity::Scalar(expr) => into.push(equations.scalar(expr)),
            Quantity::Vector(expr) => {
                let vector = equations.vector(expr);
                into.extend(equations.g.components(vector));
            }
            Quantity::Frame(frame) => {
                let (rotation, offset) = equations.steps(frame);
                into.extend(rotations::rows(&mut equations.g, rotation).as_flattened());
                into.extend(equations.g.components(offset));
            }
            Quantity::Joint(joint) => {
                let axes = equations.joint_axes(joint);
                for &axis in &axes[..written(joint)] {
                    let along = equations.along(axis, Scalar::ONE);
                    into.extend(equations.g.components(along));
                }
                for index in 0..joint.kind.freedoms.len() {
                    if let (_, Motion::Screw(_, pitch)) = equations.freedom_motion(joint, &axes, index) {
                        into.push(pitch);
                    }
                }
            }
            Quantity::Spring(data) => into.extend(equations.optional(*data)),
        }
    }
}

/// How many of a joint's directions follow from what is written: across a single axis the language chooses.
fn written(joint: &Joint) -> usize {
    match joint.directions {
        Directions::Frame => 0,
        Directions::Axis(_) => 1,
        Directions::Crossed(_) => 2,
        Directions::Plane(_) | Directions::Slot(_) => 3,
    }
}

fn checker(model: &Model, digits: f64) -> Checker {
    let mut checker = Checker::cautious(digits);
    for (id, param) in model.params.iter_ids() {
        let scalars: Vec<f64> = (0..param.ty.scalars()).map(|element| drawn(model, id, element)).collect();
        checker.set_param(id, shaped(&param.ty, &mut scalars.into_iter()));
    }
    for id in model.inertial_states() {
        checker.set_start(id, begun(model, id));
    }
    checker
}

/// A value near the default, and no other parameter's; none is zero, where a sign or another parameter would not show.
fn drawn(model: &Model, id: ParamId, element: usize) -> f64 {
    let default = model.params[id].default.get(element).or_fault("a parameter has a default for each of its scalars");
    beside(*default, 1.0 + id.0 as f64 + 0.1 * element as f64)
}

/// A value near the start.
fn begun(model: &Model, id: StateId) -> f64 {
    beside(model.states[id].start, -1.0 - id.0 as f64)
}

fn beside(x: f64, parts: f64) -> f64 {
    let near = if x == 0.0 { 1e-3 } else { x };
    near * (1.0 + 1e-3 * parts)
}

fn shaped(ty: &Type, scalars: &mut impl Iterator<Item = f64>) -> Value {
    let mut next = || scalars.next().or_fault("a type holds as many scalars as it counts");
    match ty {
        Type::Vec3 => Value::Vec3([next(), next(), next()]),
        Type::Array(element, count) => {
            let element: &Type = element;
            let elements: Vec<Value> = (0..*count).map(|_| shaped(element, &mut *scalars)).collect();
            elements.into()
        }
        _ => Value::Scalar(next()),
    }
}
