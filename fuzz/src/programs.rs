//! From text to compiled programs, and these in numbers.

use std::panic::{AssertUnwindSafe, catch_unwind};

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::{JointId, Model};
use multibody_engine::optimize::program::{Compiled, Function};
use multibody_engine::optimize::{Refusal, packs};
use multibody_engine::{Trouble, compile, model};

use crate::interpreter;

/// A compiled model.
pub struct Programs {
    /// As checked.
    pub model: Model,
    /// Of its coordinates.
    pub structure: Structure,
    /// Its functions.
    pub compiled: Compiled,
}

/// Why there is none.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The messages.
    Refused(Vec<String>),
    /// The engine's own check of what it has compiled says no.
    Engine(Refusal),
    /// Its optimiser has made something wrong, and the check has put the derived equations in its place.
    GivenBack,
    /// The engine broke.
    Panic,
}

/// Whose method a function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// That of `Model`.
    Model,
    /// That of what `Model::at` gives.
    At,
}

/// Where the values of symbols come from.
pub trait Values {
    /// By what the symbol stands for; the joint's name is that of its field.
    fn value(&self, symbol: Symbol, joint: Option<&str>) -> f64;
}

impl Programs {
    /// Compiles the one model of a call.
    pub fn new(text: &str) -> Result<Programs, Failure> {
        catch_unwind(AssertUnwindSafe(|| Programs::build(text))).unwrap_or(Err(Failure::Panic))
    }

    fn build(text: &str) -> Result<Programs, Failure> {
        let mut diagnostics = Diagnostics::default();
        let tokens = text.parse().map_err(|_| Failure::Refused(vec!["no tokens".into()]))?;
        let source = multibody_engine::parse(tokens, &mut diagnostics);
        let mut models = model::check(&source, &mut diagnostics);
        let said: Vec<String> = diagnostics.errors().iter().map(|e| e.message.clone()).collect();
        let (Some(model), []) = (models.pop(), &said[..]) else { return Err(Failure::Refused(said)) };
        Programs::of(model)
    }

    /// Compiles a checked model.
    pub(crate) fn of(model: Model) -> Result<Programs, Failure> {
        let model = multibody_engine::chosen(&model).map_err(|_| Failure::Panic)?.into_owned();
        match compile(&model) {
            Ok((_, compiled)) if !compiled.sound => Err(Failure::GivenBack),
            Ok((structure, compiled)) => Ok(Programs { model, structure, compiled }),
            Err(trouble) => Err(match trouble {
                Trouble::Complaints(list) => Failure::Refused(list.into_iter().map(|c| c.message).collect()),
                Trouble::Refused(Refusal::TooLarge(_)) => Failure::Refused(vec!["too large".into()]),
                Trouble::Refused(Refusal::NotFinite) => Failure::Refused(vec!["not finite".into()]),
                Trouble::Refused(own) => Failure::Engine(own),
                Trouble::Fault(_) => Failure::Panic,
            }),
        }
    }

    fn joint(&self, id: JointId) -> String {
        self.model.joints.get(id.0).map(|joint| joint.place.field.to_string()).unwrap_or_default()
    }

    /// Functions that go on from what `Model::at` computes.
    pub fn behind(&self) -> &[Function] {
        self.compiled.at.as_ref().map_or(&[], |at| &at.functions)
    }

    /// Whether limbs are computed together anywhere.
    pub fn has_packs(&self) -> bool {
        let at = self.compiled.at.iter().map(|at| &at.program);
        let functions = self.compiled.functions.iter().chain(self.behind()).map(|function| &function.program);
        at.chain(functions).any(|program| packs::operations(program).is_some())
    }

    /// Results of a method of `Model`, if the model has it.
    pub fn run(&self, kind: FunctionKind, values: &dyn Values) -> Option<Vec<f64>> {
        self.run_by(Way::Model, kind, values)
    }

    /// Results of a method of either, if there is one.
    pub fn run_by(&self, way: Way, kind: FunctionKind, values: &dyn Values) -> Option<Vec<f64>> {
        let functions = match way {
            Way::Model => &self.compiled.functions,
            Way::At => self.behind(),
        };
        let function = functions.iter().find(|f| f.kind == kind)?;
        let symbols = |symbol: Symbol| {
            let joint = match symbol {
                Symbol::Position { joint, .. }
                | Symbol::Velocity { joint, .. }
                | Symbol::Acceleration { joint, .. }
                | Symbol::Impulse { joint, .. }
                | Symbol::Momentum { joint, .. } => Some(self.joint(joint)),
                _ => None,
            };
            values.value(symbol, joint.as_deref())
        };
        let none = |_| f64::NAN;
        let mut fields = interpreter::run(&self.compiled.prelude, &symbols, &none);
        let Some(at) = self.compiled.at.as_ref().filter(|_| way == Way::At) else {
            return Some(interpreter::run(&function.program, &symbols, &|field| fields[field.0]));
        };
        let stored = interpreter::run(&at.program, &symbols, &|field| fields[field.0]);
        fields.extend(stored);
        // What `Model::at` takes is not there for the methods of what it gives.
        let late = |symbol: Symbol| match symbol {
            Symbol::Time | Symbol::Position { .. } | Symbol::State { .. } | Symbol::Guess { .. } => f64::NAN,
            other => symbols(other),
        };
        Some(interpreter::run(&function.program, &late, &|field| fields[field.0]))
    }

    /// The greatest ratio of two literals of a function: what comes of a division by rounding is far from all others.
    pub fn extremes(&self) -> (f64, f64) {
        let functions = self.compiled.functions.iter().chain(self.behind());
        let all = functions.flat_map(|f| f.program.literals());
        let sizes = all.chain(self.compiled.prelude.literals()).map(f64::abs).filter(|x| *x > 0.0);
        sizes.fold((f64::INFINITY, 0.0), |(low, high), x| (low.min(x), high.max(x)))
    }
}
