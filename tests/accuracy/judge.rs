//! Errors of programs at random states.

use std::cell::OnceCell;
use std::ops::Range;

use multibody::Real;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Slot;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::emit::function_name;
use multibody_engine::mechanics;
use multibody_engine::symbolic::evaluate::Evaluator;
use multibody_engine::symbolic::graph::SymbolId;
use multibody_tests::support::ledger::Entry;

use super::digits::{Big, Sensitivity, Tape, exact, rounded};
use super::machine::{self, Reads};
use super::states::{ATTEMPTS, State, States};
use super::variants::{Subject, Variant, subjects};
use super::{GREATEST, MEDIAN};

/// Slots that hold numbers of one kind, which have one size. Left out are ranks, which are whole numbers, and residuals of
/// iterations, which are nothing but rounding.
const SLOTS: [Slot; 18] = [
    Slot::Value,
    Slot::Velocity,
    Slot::States,
    Slot::Multipliers,
    Slot::Inputs,
    Slot::Gaps,
    Slot::Unknowns,
    Slot::Positions,
    Slot::Rates,
    Slot::Accelerations,
    Slot::ByPosition,
    Slot::ByVelocity,
    Slot::ByState,
    Slot::ByInput,
    Slot::StateMatrix,
    Slot::InputMatrix,
    Slot::OutputMatrix,
    Slot::Feedthrough,
];

/// Where the bound on an error is a tenth of the result, errors are not small, and conditions say nothing of them.
const SMALL: f64 = 0.1;

/// Rounds of Newton's method, each of as many steps as the emitted code takes.
const CLOSINGS: usize = 20;

/// What is left of loops that are closed.
const CLOSED: f64 = 1e-10;

/// One function of one model, in one variant and one scalar.
pub(crate) struct Figures {
    pub(crate) model: String,
    pub(crate) params: bool,
    pub(crate) function: String,
    pub(crate) variant: String,
    /// Digits of the scalar.
    pub(crate) scalar: &'static str,
    /// The median of errors of each result at each state, in units of the last place of the greatest result of its kind.
    pub(crate) median: f64,
    errors: Vec<f64>,
    /// The median of condition numbers.
    pub(crate) condition: f64,
    conditions: Vec<f64>,
    pub(crate) states: usize,
    /// The greatest of them over the condition number.
    pub(crate) greatest: f64,
    /// The condition number there.
    pub(crate) at_worst: f64,
    /// The greatest of them over what one rounding of each operation of the equations as derived leaves.
    pub(crate) operations: f64,
    /// The greatest error of a single result, over that which the data leave in it.
    pub(crate) componentwise: f64,
    /// States that are left out, since the condition number leaves few digits or the equations have no clear value.
    pub(crate) left_out: usize,
}

impl Figures {
    /// Without the errors themselves, which are many.
    fn closed(mut self) -> Figures {
        (self.median, self.condition) = (median(&mut self.errors), median(&mut self.conditions));
        (self.errors, self.conditions) = (Vec::new(), Vec::new());
        self
    }
}

fn median(list: &mut [f64]) -> f64 {
    let middle = list.len() / 2;
    if list.is_empty() { 0.0 } else { *list.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// Where what misses a bound comes from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Miss {
    /// Medians that are no greater than the bound times the condition number, which is great at most states.
    Data,
    /// No more than one rounding of each operation of the equations as derived leaves.
    Equations,
    /// More than that: the optimiser loses it.
    Form,
}

impl Figures {
    pub(crate) fn miss(&self) -> Option<Miss> {
        let median_of_data = self.median <= MEDIAN * self.condition.max(1.0);
        match (self.median <= MEDIAN, self.greatest <= GREATEST) {
            (true, true) => None,
            _ if self.operations > 1.0 => Some(Miss::Form),
            (_, true) if median_of_data => Some(Miss::Data),
            _ => Some(Miss::Equations),
        }
    }
}

/// Results of a function at one state.
struct Truth {
    values: Vec<Big>,
    /// By result.
    sensitivities: Vec<Sensitivity>,
}

/// All functions of a model at so many states.
pub(crate) fn judge(entry: &Entry, count: usize, thorough: bool) -> Vec<Figures> {
    let model = &entry.model;
    let Ok((structure, mut derivation)) = mechanics::of(model) else { panic!("{} is not derived", model.name) };
    let keeps = |kind: FunctionKind| entry.keeps(&function_name(model, kind));
    let subjects = subjects(model, &mut derivation, &keeps, thorough);
    let states = States::new(model, &structure, &derivation.symbols);
    let closing = subjects.iter().find(|subject| subject.kind == FunctionKind::Guess);
    let mut figures: Vec<Vec<[Figures; 2]>> = subjects
        .iter()
        .map(|subject| {
            let function = function_name(model, subject.kind);
            let function = if subject.at { format!("at, {function}") } else { function.into_owned() };
            let of = |variant: &Variant, scalar| Figures {
                model: entry.name(),
                params: entry.params,
                function: function.clone(),
                variant: variant.name.clone(),
                scalar,
                median: 0.0,
                errors: Vec::new(),
                condition: 0.0,
                conditions: Vec::new(),
                states: 0,
                at_worst: 0.0,
                operations: 0.0,
                greatest: 0.0,
                componentwise: 0.0,
                left_out: 0,
            };
            subject.programs.iter().map(|variant| ["f64", "f32"].map(|scalar| of(variant, scalar))).collect()
        })
        .collect();
    for number in 0..count {
        let drawn: [OnceCell<Option<Vec<Big>>>; ATTEMPTS] = Default::default();
        let exact = |attempt: usize| {
            let draw = || closed(states.draw(number, attempt), closing).map(|state| state.exact());
            drawn[attempt].get_or_init(draw).as_ref()
        };
        for (subject, figures) in subjects.iter().zip(&mut figures) {
            let found = (0..ATTEMPTS).filter_map(exact).find_map(|symbols| {
                let value = |id: SymbolId| symbols[id.0].clone();
                let tape = Tape::new(&value);
                let mut evaluator = Evaluator::new(&derivation.graph, tape);
                let places = evaluator.run(subject.roots(&derivation));
                let tape = evaluator.field();
                (!tape.is_unclear()).then(|| {
                    let values = places.iter().map(|&place| tape.value(place)).collect();
                    let sensitivities = places.iter().map(|&place| tape.sensitivity(place)).collect();
                    (symbols, Truth { values, sensitivities })
                })
            });
            let Some((symbols, truth)) = found else {
                figures.iter_mut().flatten().for_each(|figures| figures.left_out += 1);
                continue;
            };
            let slots = Slots::of(subject, truth.values.len());
            let reads: Vec<f64> = symbols.iter().map(rounded).collect();
            for (variant, [double, single]) in subject.programs.iter().zip(figures) {
                let symbol = |symbol: Symbol| reads[states.place(symbol).expect("programs read symbols of the graph")];
                double.add(&truth, &slots, f64::EPSILON, &results::<f64>(variant, &symbol));
                single.add(&truth, &slots, f64::from(f32::EPSILON), &results::<f32>(variant, &symbol));
            }
        }
    }
    figures.into_iter().flatten().flatten().map(Figures::closed).collect()
}

/// The same with its loops closed; nothing if they don't close.
fn closed<'m>(mut state: State<'m>, closing: Option<&Subject>) -> Option<State<'m>> {
    let Some(program) = closing.and_then(|subject| subject.programs.first()) else { return Some(state) };
    for _ in 0..CLOSINGS {
        let solution = results::<f64>(program, &|symbol| state.read(symbol));
        let (residual, guesses) = solution.split_last()?;
        guesses.iter().enumerate().for_each(|(index, &x)| state.set_guess(index, x));
        if *residual < CLOSED {
            return Some(state);
        }
    }
    None
}

/// What a function gives in this scalar.
fn results<T: Real>(variant: &Variant, symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
    let symbol = |of: Symbol| T::lit(symbol(of));
    let mut fields: Vec<T> = Vec::new();
    for program in &variant.first {
        let values = machine::run(program, &Reads { symbol: &symbol, fields: &fields });
        fields.extend(values);
    }
    let results = machine::run(&variant.last, &Reads { symbol: &symbol, fields: &fields });
    results.into_iter().map(Real::greatest).collect()
}

/// The distance of numbers of the size of `x` in a scalar of this rounding unit.
fn ulp(x: f64, epsilon: f64) -> f64 {
    epsilon * 2.0_f64.powf(x.log2().floor())
}

impl Figures {
    fn add(&mut self, truth: &Truth, slots: &Slots, epsilon: f64, results: &[f64]) {
        // A rank that has fallen is told to the user.
        if slots.ranks.clone().any(|at| results[at] != rounded(&truth.values[at])) {
            self.left_out += 1;
            return;
        }
        let (mut errors, mut conditions) = (Vec::new(), Vec::new());
        let (mut over, mut condition, mut single, mut operations) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        for range in &slots.kinds {
            // What is zero and has come out so is right.
            let Some(group) = Group::new(truth, results, range.clone()) else { continue };
            if group.condition * 64.0 * epsilon > SMALL {
                self.left_out += 1;
                return;
            }
            errors.extend(group.errors.iter().map(|error| error / ulp(group.size, epsilon)));
            conditions.push(group.condition);
            let error = group.error / ulp(group.size, epsilon) / group.condition;
            if error > over {
                (over, condition) = (error, group.condition);
            }
            single = single.max(group.componentwise / epsilon);
            operations = operations.max(group.error / group.operations / epsilon);
        }
        self.errors.extend(errors);
        self.conditions.extend(conditions);
        self.states += 1;
        if over > self.greatest {
            (self.greatest, self.at_worst) = (over, condition);
        }
        self.operations = self.operations.max(operations);
        self.componentwise = self.componentwise.max(single);
    }
}

/// Where results stand.
struct Slots {
    /// Of each kind that a function has.
    kinds: Vec<Range<usize>>,
    ranks: Range<usize>,
}

impl Slots {
    fn of(subject: &Subject, count: usize) -> Slots {
        // The rank of a displacement stands behind it in the same slot.
        let (ranks, end) = match subject.kind {
            FunctionKind::Displacement => (count - 1..count, count - 1),
            _ => (subject.parts.range(Slot::Rank), count),
        };
        let kinds = SLOTS.map(|slot| subject.parts.range(slot)).into_iter();
        let kinds = kinds.map(|range| range.start..range.end.min(end)).filter(|range| !range.is_empty());
        Slots { kinds: kinds.collect(), ranks }
    }
}

/// Results of one kind.
struct Group {
    /// The greatest.
    size: f64,
    /// At least one.
    condition: f64,
    /// What one rounding of each operation leaves.
    operations: f64,
    error: f64,
    /// Of each.
    errors: Vec<f64>,
    /// The greatest error of a result over its own size, or what the data leave in it where that is more.
    componentwise: f64,
}

impl Group {
    /// Nothing where all of them are zero.
    fn new(truth: &Truth, results: &[f64], range: Range<usize>) -> Option<Group> {
        let mut group =
            Group { size: 0.0, condition: 0.0, operations: 0.0, error: 0.0, errors: Vec::new(), componentwise: 0.0 };
        for at in range {
            let size = rounded(&truth.values[at]).abs();
            let error = match results[at].is_finite() {
                true => rounded(&(exact(results[at]) - &truth.values[at])).abs(),
                false => f64::INFINITY,
            };
            let Sensitivity { data: sensitivity, operations } = truth.sensitivities[at];
            group.size = group.size.max(size);
            group.condition = group.condition.max(sensitivity);
            group.operations = group.operations.max(operations).max(size);
            group.error = group.error.max(error);
            group.errors.push(error);
            if error > 0.0 {
                group.componentwise = group.componentwise.max(error / size.max(sensitivity));
            }
        }
        group.condition = (group.condition / group.size).max(1.0);
        (group.size > 0.0 || group.error > 0.0).then_some(group)
    }
}
