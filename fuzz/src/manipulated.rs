//! Random expressions that take others apart, against what they are made of.
//!
//! Everything is an output of one compiled model, and differences and substitutions are made by moving what the functions read: a
//! derivative against differences of the value, a substitution against the value with a variable set to what is put in, a question
//! to another model against an output of that model at what was given.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::types::{ExprNode, Model, ParamId, StateId, Variable};
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{compile, model};

use crate::campaign::{Plan, Tally};
use crate::differentiated::{STEPS, WEIGHTS, symbol};
use crate::grammar::apart;
use crate::grammar::oracle::minimise;
use crate::interpreter;
use crate::random::Random;

/// States of each model.
const STATES: usize = 3;
/// Of one, the value, and what is compared.
const TOLERANCE: f64 = 1e-7;
/// Differences that are further apart are none of a smooth value.
const AGREED: f64 = 1e-4;
/// What is larger says nothing of expressions with powers and exponentials.
const LARGE: f64 = 1e5;

/// Looks at the calls of some seeds. Those that are refused count for nothing.
pub fn run(plan: Plan) -> Tally {
    let start = std::time::Instant::now();
    let mut tally = Tally::default();
    for seed in plan.seed..plan.seed + plan.models as u64 {
        if start.elapsed() > plan.time {
            break;
        }
        let Some(lines) = apart(&mut Random::new(seed)) else { continue };
        let found = judged(&lines, seed);
        let Some((numbers, wrong)) = found else { continue };
        tally.models += 1;
        tally.numbers += numbers;
        let Some(wrong) = wrong else { continue };
        let class = wrong.split(':').next().unwrap_or_default().to_owned();
        let seen = tally.classes.entry(class.clone()).or_default();
        seen.push(seed);
        if seen.len() <= plan.shown {
            let same = |lines: &[String]| {
                judged(lines, seed).and_then(|found| found.1).is_some_and(|wrong| wrong.starts_with(&class))
            };
            let small = minimise(lines, &mut |lines| same(lines));
            tally.reports.push(format!("== {wrong}, seed {seed}\n{}\n", small.join("\n")));
        }
    }
    tally
}

/// Numbers compared, and the first that is wrong; nothing of a call that is refused.
fn judged(lines: &[String], seed: u64) -> Option<(usize, Option<String>)> {
    let text = lines.join("\n");
    catch_unwind(AssertUnwindSafe(|| {
        let mut diagnostics = Diagnostics::default();
        let source = multibody_engine::parse(text.parse().ok()?, &mut diagnostics);
        let mut models = model::check(&source, &mut diagnostics).into_iter();
        let (aid, model) = (models.next()?, models.next()?);
        Some(compare(&Outputs::new(aid)?, &Outputs::new(model)?, seed))
    }))
    .unwrap_or_else(|_| Some((0, Some("panic: of the compiler".to_owned()))))
}

struct Outputs {
    model: Model,
    compiled: Compiled,
    /// Where the scalars of each begin.
    first: Vec<usize>,
}

type At = HashMap<Symbol, f64>;

impl Outputs {
    fn new(model: Model) -> Option<Outputs> {
        let (_, compiled) = compile(&model).ok()?;
        let mut next = 0;
        let first = model.outputs.iter().map(|output| {
            let first = next;
            next += output.value.ty.scalars();
            first
        });
        let first = first.collect();
        Some(Outputs { model, compiled, first })
    }

    fn number(&self, name: &str) -> Option<usize> {
        self.model.outputs.iter().position(|output| output.place.field == name)
    }

    fn run(&self, at: &At) -> Vec<f64> {
        let symbols = |symbol: Symbol| at.get(&symbol).copied().unwrap_or(f64::NAN);
        let fields = interpreter::run(&self.compiled.prelude, &symbols, &|_| f64::NAN);
        let function = self.compiled.functions.iter().find(|f| f.kind == FunctionKind::Outputs);
        function.map_or_else(Vec::new, |f| interpreter::run(&f.program, &symbols, &|field| fields[field.0]))
    }

    /// A scalar output.
    fn value(&self, name: &str, all: &[f64]) -> Option<f64> {
        all.get(*self.first.get(self.number(name)?)?).copied()
    }

    fn defaults(&self) -> At {
        let params = (0..self.model.params.len()).map(ParamId);
        let scalars = params.flat_map(|param| {
            let default = &self.model.params[param].default;
            default.iter().enumerate().map(move |(element, &x)| (Symbol::Param { param, element }, x))
        });
        scalars.collect()
    }

    fn state(&self, random: &mut Random) -> At {
        let mut at: At =
            self.defaults().into_iter().map(|(symbol, x)| (symbol, x * random.between(0.9, 1.1))).collect();
        at.insert(Symbol::Time, random.unit());
        for (joint, declared) in self.model.joints.iter_ids() {
            for component in 0..declared.kind.freedoms() {
                at.insert(Symbol::Position { joint, component }, random.unit());
                at.insert(Symbol::Velocity { joint, component }, random.unit());
            }
        }
        for state in (0..self.model.states.len()).map(StateId) {
            at.insert(Symbol::State { state }, random.unit());
        }
        for (input, declared) in self.model.inputs.iter_ids() {
            for element in 0..declared.ty.scalars() {
                at.insert(Symbol::Input { input, element }, random.unit());
            }
        }
        at
    }
}

fn of(variable: Variable) -> Symbol {
    symbol(variable).unwrap_or(Symbol::Time)
}

fn compare(aid: &Outputs, model: &Outputs, seed: u64) -> (usize, Option<String>) {
    let mut random = Random::new(seed ^ 0x5157);
    let mut numbers = 0;
    for _ in 0..STATES {
        let at = model.state(&mut random);
        let here = model.run(&at);
        for (output, &first) in model.model.outputs.iter().zip(&model.first) {
            let name = output.place.field.to_string();
            let Some(&got) = here.get(first) else { continue };
            let wanted = match &*output.value.node {
                ExprNode::Derivative { by, .. } if name.starts_with('d') => slope(model, &at, of(*by), got),
                ExprNode::Substituted { pairs, .. } if name == "put" => put(model, &at, &here, of(pairs[0].0)),
                ExprNode::Formula { given, .. } if name == "asked" => {
                    let mut there = aid.defaults();
                    let values = given.iter().enumerate().filter_map(|(k, given)| {
                        Some((of(*given.variables.first()?), model.value(&format!("g{k}"), &here)?))
                    });
                    there.extend(values);
                    aid.value("asked", &aid.run(&there))
                }
                _ => continue,
            };
            let Some(want) = wanted.filter(|want| want.abs() < LARGE) else { continue };
            let size = 1.0 + want.abs() + model.value("of", &here).map_or(0.0, f64::abs);
            numbers += 1;
            let error = (got - want).abs();
            // What is compared with is finite.
            if error.is_nan() || error > TOLERANCE * size {
                let what = if name.starts_with('d') { "derivative" } else { &name };
                return (numbers, Some(format!("{what}: {got} for {want}")));
            }
        }
    }
    (numbers, None)
}

/// The value with a variable set to what is put in.
fn put(model: &Outputs, at: &At, here: &[f64], variable: Symbol) -> Option<f64> {
    let mut there = at.clone();
    there.insert(variable, model.value("value", here)?);
    model.value("of", &model.run(&there))
}

/// The difference of the value nearest to what it is compared with; nothing where narrow and wide differences disagree, since the
/// value jumps or runs away between.
fn slope(model: &Outputs, at: &At, by: Symbol, got: f64) -> Option<f64> {
    let value = |step: f64| {
        let mut at = at.clone();
        *at.get_mut(&by)? += step;
        model.value("of", &model.run(&at))
    };
    let mut differences = Vec::new();
    for step in STEPS {
        let mut slope = 0.0;
        for (steps, weight) in (1..).zip(WEIGHTS) {
            let [after, before] = [1.0, -1.0].map(|sign: f64| value(sign * f64::from(steps) * step));
            slope += weight * (after? - before?) / step;
        }
        differences.push(slope);
    }
    let size = differences.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    let apart = differences.windows(2).map(|pair| (pair[0] - pair[1]).abs());
    let apart = apart.fold(0.0, |most: f64, gap| if gap.is_nan() { f64::INFINITY } else { most.max(gap) });
    let nearest = differences.into_iter().min_by(|a, b| (a - got).abs().total_cmp(&(b - got).abs()));
    nearest.filter(|_| apart <= AGREED * size)
}
