//! Whether expressions were translated to the values that they have.
//!
//! In: the checked model. Out: nothing, or a fault. What is wrong in the translation is wrong in all functions alike, so no law
//! between them tells of it. The numeric checks of the model have an evaluator of their own, which knows no graph: what depends
//! on parameters alone has the same value there, with parameters off their defaults, each by a part of its own.

use crate::contracts::symbol::Symbol;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::equations::Equations;
use crate::model::checks::evaluate::{Evaluator as Checker, Value};
use crate::model::types::{Expr, Frame, FrameStep, Model, ParamId, Type};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};

/// Of two evaluations in double precision; a value that is lost in rounding is compared with what it is made of, which is below
/// one for lengths and masses of machines.
const TOLERANCE: f64 = 1e-9;

pub(in crate::mechanics) fn check(model: &Model) {
    if model.params.is_empty() {
        return;
    }
    let mut checker = Checker::default();
    for (id, param) in model.params.iter_ids() {
        let scalars: Vec<f64> = (0..param.ty.scalars()).map(|element| drawn(model, id, element)).collect();
        checker.set_param(id, shaped(&param.ty, &mut scalars.into_iter()));
    }
    let mut equations = Equations::plain(model);
    let mut expected: Vec<f64> = Vec::new();
    let mut translated: Vec<Scalar> = Vec::new();
    for expr in scalars(model) {
        let Some(value) = checker.scalar(expr) else { continue };
        expected.push(value);
        translated.push(equations.scalar(expr));
    }
    for expr in vectors(model) {
        let Some(value) = checker.vector(expr) else { continue };
        expected.extend(value);
        let vector = equations.vector(expr);
        translated.extend(equations.g.components(vector));
    }
    let table = &equations.scene.symbols.table;
    let value = |id: SymbolId| match table.get(id.0) {
        Some(&Symbol::Param { param, element }) => drawn(model, param, element),
        _ => f64::NAN,
    };
    let found = Evaluator::new(&equations.g, Real { symbols: &value }).run(&translated);
    let differs = |(&a, &b): (&f64, &f64)| a.is_finite() && (b.is_nan() || (a - b).abs() > TOLERANCE * (1.0 + a.abs()));
    if expected.iter().zip(&found).any(differs) {
        raise("an expression of parameters is translated to its value");
    }
}

/// A value near the default, and no other parameter's.
fn drawn(model: &Model, id: ParamId, element: usize) -> f64 {
    let default = model.params[id].default.get(element).or_fault("a parameter has a default for each of its scalars");
    default * (1.0 + 1e-3 * (1.0 + id.0 as f64 + 0.1 * element as f64))
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
