//! Operation counts of the committed models.

use std::borrow::Cow;
use std::fmt;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::emit::function_name;
use multibody_engine::model::types::{Model, Packs, SpeedChoice};
use multibody_engine::optimize::program::Compiled;
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
    derivation.at.clear();
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

/// A model that the ledger keeps.
pub struct Entry {
    /// As declared.
    pub model: Model,
    /// Every number is a param; else every number is a literal.
    pub params: bool,
    /// Before its name, where several files have models of one name.
    group: &'static str,
    /// Functions that are kept; all of them where there are none.
    only: &'static [&'static str],
}

impl Entry {
    /// As the ledger has it.
    pub fn name(&self) -> String {
        let text = self.model.name.to_string();
        let name = text.strip_suffix("_params").unwrap_or(&text);
        if self.group.is_empty() { name.to_owned() } else { format!("{}, {name}", self.group) }
    }

    /// Whether the ledger has a function of the model.
    pub fn keeps(&self, function: &str) -> bool {
        self.only.is_empty() || self.only.contains(&function)
    }

    fn rows(&self) -> Vec<Row> {
        let mut rows = count(&self.model, self.params);
        rows.retain(|row| self.keeps(&row.function));
        rows.iter_mut().for_each(|row| row.model = self.name());
        rows
    }
}

/// All models that the ledger keeps. The arms stand in their file in both forms, the others with params.
pub fn entries() -> Vec<Entry> {
    let mut entries = Vec::new();
    let mut add = |models: Vec<Model>, params: bool, group: &'static str, only: &'static [&'static str]| {
        entries.extend(models.into_iter().map(|model| Entry { model, params, group, only }));
    };
    for model in calls("models/arms.rs").into_iter().flat_map(models) {
        let params = model.name.to_string().ends_with("_params");
        add(vec![model], params, "", &[]);
    }
    for call in calls("models/actuated.rs") {
        add(models(literal(call.clone())), false, "", &[]);
        let with_params = models(call).into_iter().filter(|model| !model.params.is_empty());
        add(with_params.collect(), true, "", &[]);
    }
    for call in ["models/small.rs", "models/motion.rs"].into_iter().flat_map(calls) {
        add(models(literal(call.clone())), false, "", &[]);
        add(models(call), true, "", &[]);
    }
    // What answers to impulses, and what has momenta.
    for model in calls("models/impulses.rs").into_iter().flat_map(|call| models(literal(call))) {
        if IMPULSES.contains(&&*model.name.to_string()) {
            add(vec![model], false, "momenta", &MOMENTA);
        }
    }
    // On wheels, with equations of velocities that are eliminated and that are kept.
    for call in calls("models/rolling.rs") {
        add(models(call), true, "bicycle", &[]);
    }
    for call in
        ["models/required.rs", "models/quadruped.rs", "models/torso.rs", "models/hopper.rs"].into_iter().flat_map(calls)
    {
        add(models(call), false, "", &[]);
    }
    // The platform in several coordinates: everything literal. Then what Newton's method closes, beside the same with
    // multipliers.
    for (file, group) in [("models/stewart.rs", "stewart"), ("models/iterated.rs", "iterated")] {
        for call in calls(file) {
            add(models(literal(call)), false, group, &[]);
        }
    }
    entries
}

/// Rows of all of them.
pub fn all() -> Vec<Row> {
    entries().iter().flat_map(Entry::rows).collect()
}

/// A function that goes on from what is done once for a position.
pub struct Behind {
    /// Of the generated module.
    pub model: String,
    /// Of the generated method.
    pub function: Cow<'static, str>,
    /// Of the method of `Model` with this name.
    pub alone: Cost,
    /// Of that which takes a position.
    pub behind: Cost,
}

/// What is done once for a position in a model, and what its functions do behind that.
pub struct Once {
    /// Of the generated module.
    pub model: String,
    /// What is done once.
    pub at: Cost,
    /// In the order of the model.
    pub functions: Vec<Behind>,
}

/// All models of the ledger that ask for it.
pub fn once() -> Vec<Once> {
    let entries = entries();
    let asking = entries.iter().filter(|entry| !entry.model.at.is_empty());
    asking.map(|entry| of_position(&entry.model, entry.name())).collect()
}

fn of_position(model: &Model, name: String) -> Once {
    let compiled = compiled(model);
    let at = compiled.at.as_ref().expect("what a model asks for");
    let functions = at.functions.iter().map(|function| {
        let alone = compiled.functions.iter().find(|alone| alone.kind == function.kind);
        Behind {
            model: name.clone(),
            function: function_name(model, function.kind),
            alone: alone.expect("what is asked for at a position is asked for").after,
            behind: function.after,
        }
    });
    Once { at: at.cost, functions: functions.collect(), model: name }
}

fn compiled(model: &Model) -> Compiled {
    let derived = mechanics::of(model).unwrap_or_else(|trouble| panic!("{}: {}", model.name, trouble[0].message));
    let compiled = optimize::compile(&derived.1).unwrap_or_else(|_| panic!("{} is too large", model.name));
    assert!(compiled.sound, "{}: a pass changed a value", model.name);
    compiled
}

/// A function whose limbs go in packs.
pub struct Packed {
    /// Of the generated module.
    pub model: String,
    /// Of the generated method.
    pub function: Cow<'static, str>,
    /// On scalars alone.
    pub after: Cost,
    /// Operations on packs, and on scalars beside these.
    pub operations: [usize; 2],
}

/// The models of the ledger with limbs that are alike, in packs: functions that have any.
pub fn packed() -> Vec<Packed> {
    let mut rows = Vec::new();
    for mut entry in entries().into_iter().filter(|entry| PACKED.contains(&&*entry.name())) {
        entry.model.packs = Packs::Off;
        let alone = compiled(&entry.model).functions;
        entry.model.packs = Packs::Four;
        // What packs are asked for may be derived in another way.
        for (function, alone) in compiled(&entry.model).functions.iter().zip(&alone) {
            assert_eq!(function.kind, alone.kind);
            let Some(operations) = optimize::packs::operations(&function.program) else { continue };
            let name = function_name(&entry.model, function.kind);
            rows.push(Packed { model: entry.name(), function: name, after: alone.after, operations });
        }
    }
    rows
}

/// Those models.
const PACKED: [&str; 3] = ["quadruped", "torso", "stewart, reduced"];

/// Forward dynamics of a model in one choice of velocities and in another.
pub struct InSpeeds {
    /// Of the generated module.
    pub model: String,
    /// With the rates of coordinates for velocities.
    pub in_rates: Cost,
    /// With the speeds that are chosen.
    pub in_speeds: Cost,
    /// The speeds that the model's `speeds: Auto` stands for.
    pub speeds: Vec<String>,
    /// Rates of coordinates from speeds, which forward dynamics holds.
    pub position_rates: Cost,
}

/// Models of `models/turning.rs`, with the speeds that are chosen for them and without.
pub fn in_speeds() -> Vec<InSpeeds> {
    let of = |model: Model| {
        let cost = |model: &Model, wanted: &str| {
            let functions = compiled(model).functions;
            let found = functions.iter().find(|function| function_name(model, function.kind) == wanted);
            found.map(|function| function.after).unwrap_or_default()
        };
        let chosen =
            multibody_engine::chosen(&model).unwrap_or_else(|_| panic!("{} is refused", model.name)).into_owned();
        let rates = Model { speed_choice: SpeedChoice::Written, ..model };
        InSpeeds {
            model: rates.name.to_string(),
            in_rates: cost(&rates, "forward_dynamics"),
            in_speeds: cost(&chosen, "forward_dynamics"),
            speeds: chosen.speeds.iter().map(|speed| speed.place.field.to_string()).collect(),
            position_rates: cost(&chosen, "position_rates"),
        }
    };
    calls("models/turning.rs").into_iter().flat_map(models).map(of).collect()
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
