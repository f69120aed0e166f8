//! Whether expressions were translated to the values that they have.
//!
//! In: the checked model. Out: nothing, or a fault. Compared are inertial parameters, offsets and gravity. What is wrong in the
//! translation is wrong in all functions alike, so no law between them tells of it. The numeric checks of the model have an
//! evaluator of their own, which knows no graph: what depends on parameters alone has the same value there, with parameters
//! off their defaults, each by a part of its own.

use crate::contracts::symbol::Symbol;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::equations::Equations;
use crate::model::checks::evaluate::{Evaluator as Checker, Value};
use crate::model::types::{Expr, Frame, FrameStep, Model, ParamId, Type};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};

/// Of two evaluations in double precision, and how often what a value moves by when parameters move by their last digits.
const TOLERANCE: f64 = 1e-9;
const NOISE: f64 = 1e3;

/// Parameters are moved by so many of their last digits, to see how far values are known.
const LAST_DIGITS: [f64; 5] = [0.0, 1.0, -1.0, 3.0, -2.0];

pub(in crate::mechanics) fn check(model: &Model) {
    if model.params.is_empty() {
        return;
    }
    let [expected, moved @ ..] = LAST_DIGITS.map(|digits| values(model, digits));
    let mut equations = Equations::plain(model);
    let mut translated: Vec<Scalar> = Vec::new();
    for expr in scalars(model) {
        translated.push(equations.scalar(expr));
    }
    for expr in vectors(model) {
        let vector = equations.vector(expr);
        translated.extend(equations.g.components(vector));
    }
    let table = &equations.scene.symbols.table;
    let value = |id: SymbolId| match table.get(id.0) {
        Some(&Symbol::Param { param, element }) => drawn(model, param, element, 0.0),
        _ => f64::NAN,
    };
    let found = Evaluator::new(&equations.g, Real { symbols: &value }).run(&translated);
    let differs = |(k, (a, b)): (usize, (&f64, &f64))| {
        let noise = moved.iter().map(|values| (values[k] - a).abs()).fold(0.0, f64::max);
        a.is_finite()
            && noise.is_finite()
            && (b.is_nan() || (a - b).abs() > TOLERANCE * (1.0 + a.abs()) + NOISE * noise)
    };
    if expected.iter().zip(&found).enumerate().any(differs) {
        raise("an expression of parameters is translated to its value");
    }
}

/// What the checks of the model evaluate; what is no value of parameters alone, or hangs on the rounding of decimals, is no
/// number.
fn values(model: &Model, digits: f64) -> Vec<f64> {
    let mut checker = Checker::cautious();
    for (id, param) in model.params.iter_ids() {
        let elements = 0..param.ty.scalars();
        let scalars: Vec<f64> = elements.map(|element| drawn(model, id, element, digits)).collect();
        checker.set_param(id, shaped(&param.ty, &mut scalars.into_iter()));
    }
    let numbers: Vec<f64> = scalars(model).map(|expr| checker.scalar(expr).unwrap_or(f64::NAN)).collect();
    let components = vectors(model).flat_map(|expr| checker.vector(expr).unwrap_or([f64::NAN; 3]));
    numbers.iter().copied().chain(components).collect()
}

/// A value near the default, and no other parameter's; none is zero, where a sign or another parameter would not show.
fn drawn(model: &Model, id: ParamId, element: usize, digits: f64) -> f64 {
    let default = model.params[id].default.get(element).or_fault("a parameter has a default for each of its scalars");
    let near = if *default == 0.0 { 1e-3 } else { *default };
    near * (1.0 + 1e-3 * (1.0 + id.0 as f64 + 0.1 * element as f64)) * (1.0 + digits * f64::EPSILON)
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

fn scalars(model: &Model) -> impl Iterator<Item = &Expr> {
    let inertias = model.bodies.iter().flat_map(|body| body.inertia.iter().flat_map(|entries| entries.iter()));
    let armatures = model.joints.iter().filter_map(|joint| joint.armature.as_ref());
    model.bodies.iter().map(|body| &body.mass).chain(inertias).chain(armatures)
}

fn vectors(model: &Model) -> impl Iterator<Item = &Expr> {
    let frames = model.joints.iter().flat_map(|joint| [&joint.parent, &joint.child]);
    let origins = frames.flat_map(|frame: &Frame| &frame.steps).filter_map(|step| match step {
        FrameStep::At(origin) => Some(origin),
        FrameStep::Rotated(..) | FrameStep::Oriented(_) => None,
    });
    model.bodies.iter().map(|body| &body.com).chain(origins).chain(&model.gravity)
}
