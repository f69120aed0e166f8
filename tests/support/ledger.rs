//! Operation counts of the committed models.

use std::borrow::Cow;
use std::fmt;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::emit::function_name;
use multibody_engine::model::types::Model;
use multibody_engine::{mechanics, optimize};

use super::engine::{calls, literal, models};

/// Counts of one function of one model.
pub struct Row {
    /// Of the generated module.
    pub model: String,
    /// Of the generated method.
    pub function: Cow<'static, str>,
    /// Every number is a param; else every number is a literal.
    pub params: bool,
    /// What it was made from.
    pub method: &'static str,
    /// As derived.
    pub before: Cost,
    /// As emitted.
    pub after: Cost,
    /// In `Model::new`, for this function alone.
    pub new: Cost,
    /// Of the model.
    pub dof: usize,
}

/// Every function of a model, each compiled alone so that its share of `new` is its own.
pub fn count(model: &Model, params: bool) -> Vec<Row> {
    let mut derivation =
        mechanics::of(model).unwrap_or_else(|trouble| panic!("{}: {}", model.name, trouble[0].message)).1;
    let dof = model.joints.iter().map(|joint| joint.kind.freedoms()).sum();
    let functions = std::mem::take(&mut derivation.functions);
    let rows = functions.into_iter().map(|function| {
        derivation.functions = vec![function];
        let compiled = optimize::compile(&derivation).unwrap_or_else(|_| panic!("{} is too large", model.name));
        assert!(compiled.sound, "{}: a pass changed a value", model.name);
        let function = &compiled.functions[0];
        let text = model.name.to_string();
        Row {
            model: text.strip_suffix("_params").unwrap_or(&text).to_owned(),
            function: function_name(model, function.kind),
            params,
            method: function.method,
            before: function.before,
            after: function.after,
            new: compiled.prelude_cost,
            dof,
        }
    });
    rows.collect()
}

/// Models of `models/impulses.rs`, and functions of them.
const IMPULSES: [&str; 4] = ["rods", "crane", "four_bar", "stretched"];
const MOMENTA: [&str; 5] = ["forward_dynamics", "impulse", "momentum", "momentum_rate", "velocity"];

/// All models that the ledger keeps. The arms stand in their file in both forms, the others with params.
pub fn all() -> Vec<Row> {
    let mut rows = Vec::new();
    for model in calls("models/arms.rs").into_iter().flat_map(models) {
        rows.extend(count(&model, model.name.to_string().ends_with("_params")));
    }
    for call in calls("models/actuated.rs") {
        models(literal(call.clone())).iter().for_each(|model| rows.extend(count(model, false)));
        models(call).iter().filter(|model| !model.params.is_empty()).for_each(|model| rows.extend(count(model, true)));
    }
    for file in ["models/small.rs", "models/motion.rs"] {
        for call in calls(file) {
            models(literal(call.clone())).iter().for_each(|model| rows.extend(count(model, false)));
            models(call).iter().for_each(|model| rows.extend(count(model, true)));
        }
    }
    // What answers to impulses, and what has momenta.
    for model in calls("models/impulses.rs").into_iter().flat_map(|call| models(literal(call))) {
        let mut counted = count(&model, false);
        counted.retain(|row| IMPULSES.contains(&&*row.model) && MOMENTA.contains(&&*row.function));
        counted.iter_mut().for_each(|row| row.model = format!("momenta, {}", row.model));
        rows.extend(counted);
    }
    for model in calls("models/required.rs").into_iter().flat_map(models) {
        rows.extend(count(&model, false));
    }
    // The platform in several coordinates: everything literal.
    for model in calls("models/stewart.rs").into_iter().flat_map(|call| models(literal(call))) {
        let mut counted = count(&model, false);
        counted.iter_mut().for_each(|row| row.model = format!("stewart, {}", row.model));
        rows.extend(counted);
    }
    // What Newton's method closes, beside the same with multipliers.
    for model in calls("models/iterated.rs").into_iter().flat_map(|call| models(literal(call))) {
        let mut counted = count(&model, false);
        counted.iter_mut().for_each(|row| row.model = format!("iterated, {}", row.model));
        rows.extend(counted);
    }
    rows
}

/// Additions, products, quotients and roots.
pub fn flops(cost: &Cost) -> u32 {
    cost.add + cost.mul + cost.div + cost.sqrt
}

/// `12 add, 20 mul, 1 div`
pub struct Written<'a>(pub &'a Cost);

impl fmt::Display for Written<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Cost { add, mul, div, sqrt, sincos, compare, other } = self.0;
        write!(f, "{add}/{mul}/{div}")?;
        for (count, what) in [(sqrt, "sqrt"), (sincos, "sincos"), (compare, "compare"), (other, "other")] {
            if *count > 0 {
                write!(f, " {count} {what}")?;
            }
        }
        Ok(())
    }
}
