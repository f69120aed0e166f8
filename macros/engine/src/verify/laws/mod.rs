//! Stage `verify`: functions of one model against each other.
//!
//! In: the derived equations of all functions that were asked for, and a state. Out: which two of them disagree. Each law holds
//! whatever the model: it is a sum over results of one or several functions, with random weights, that is zero. The sums are made
//! in double-double precision from the derived equations; as bound serves the error that one rounding of each of their
//! operations can leave. Slopes of a function are its own, by a reverse sweep, and not those of another function.

mod constraints;
mod derivatives;
mod dynamics;
mod energies;
mod forces;
mod momenta;
mod outputs;
mod poses;

use std::ops::Range;

use crate::contracts::function::FunctionKind;
use crate::contracts::results::{Parts, Slot};
use crate::contracts::symbol::Symbol;
use crate::mechanics::loops::structure::{Role, Structure};
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::types::{Coordinate, Model};
use crate::optimize::program::Doubt;
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::SymbolId;

use super::programs::WORST;
use super::states::{Random, State, States};
use super::tape::{Op, Tape};
use super::trace::{Slopes, Trace};

/// A sum of numbers with 31 digits that cancel is zero below this share of them.
const EXACT: f64 = 1e-24;

/// As many times what loops are open by may be missing of a sum for which they must be closed.
const OPEN: f64 = 64.0;

/// What the laws say at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// Those that have a clear value.
    Hold,
    Broken(FunctionKind, FunctionKind),
}

/// What functions have in common, whatever the model.
#[derive(Clone, Copy)]
pub(super) struct Law {
    /// In words.
    pub between: &'static str,
    judge: fn(&mut At<'_, '_>) -> Judged,
}

/// A law that has had no clear value yet, and why.
pub(super) struct Pending {
    pub law: Law,
    pub doubt: Option<Doubt>,
}

/// A function as it was derived.
pub(super) struct Known<'a> {
    pub kind: FunctionKind,
    pub parts: &'a Parts,
    pub tape: &'a Tape,
}

/// The functions of one model: those that are emitted, and those that were derived beside them.
pub(super) struct Laws<'a> {
    pub model: &'a Model,
    pub structure: &'a Structure,
    pub states: &'a States<'a>,
    pub functions: &'a [Known<'a>],
}

/// A law under way: terms of one sum.
#[derive(Default)]
struct Sum {
    value: Vec<Doubled>,
    bound: f64,
    /// By how much the loops are open that must be closed for it.
    open: f64,
}

impl Sum {
    fn add(&mut self, x: Doubled) {
        self.value.push(x);
    }

    fn product(&mut self, factors: &[Doubled]) {
        self.add(factors.iter().fold(Doubled::ONE, |product, &x| product * x));
    }

    /// Nothing where the sum has no value; else whether it is zero.
    fn holds(&self) -> Option<bool> {
        let sum = self.value.iter().fold(Doubled::ZERO, |sum, &x| sum + x).high.abs();
        let size: f64 = self.value.iter().map(|x| x.high.abs()).sum();
        if !(sum.is_finite() && size.is_finite() && self.bound.is_finite()) {
            return None;
        }
        let rounding = WORST * f64::EPSILON * (self.bound + size);
        Some(sum <= EXACT * size || sum <= rounding + OPEN * self.open * size)
    }
}

/// One state with what has been evaluated there.
struct At<'a, 's> {
    laws: &'a Laws<'a>,
    state: &'s State,
    traces: Vec<Option<Trace<'a, Doubled>>>,
    random: Random,
    /// Why what was read here says nothing.
    doubt: Option<Doubt>,
}

impl<'a> Laws<'a> {
    /// One file for each family.
    pub(super) fn all(&self) -> Vec<Pending> {
        // Energies are exact where motions are taken to first order.
        let energies = if self.model.small.is_empty() { energies::LAWS } else { &[] };
        let shown = [outputs::LAWS, poses::LAWS].concat();
        let families = [energies, dynamics::LAWS, derivatives::LAWS, momenta::LAWS, constraints::LAWS, &shown];
        families.concat().into_iter().map(|law| Pending { law, doubt: None }).collect()
    }

    /// The laws that are pending, at one state; those that have no clear value there stay.
    pub(super) fn judge(&'a self, state: &State, pending: &mut Vec<Pending>) -> Outcome {
        let traces = self.functions.iter().map(|_| None).collect();
        let mut at = At { laws: self, state, traces, random: Random(0x1A35), doubt: None };
        let mut broken = None;
        pending.retain_mut(|Pending { law, doubt }| {
            at.doubt = None;
            let open = match (law.judge)(&mut at) {
                Some(Some(_)) if at.doubt.is_some() => at.doubt,
                Some(Some(functions)) => {
                    broken = broken.or(Some(functions));
                    None
                }
                Some(None) => None,
                None => at.doubt.or(Some(Doubt::NotFinite)),
            };
            *doubt = doubt.or(open);
            open.is_some()
        });
        broken.map_or(Outcome::Hold, |(a, b)| Outcome::Broken(a, b))
    }
}

type Broken = (FunctionKind, FunctionKind);

/// Nothing where a value is missing at this state; else who disagrees.
type Judged = Option<Option<Broken>>;

fn judged(sum: &Sum, a: FunctionKind, b: FunctionKind) -> Judged {
    sum.holds().map(|holds| (!holds).then_some((a, b)))
}

impl<'a> At<'a, '_> {
    fn has(&self, kind: FunctionKind) -> bool {
        self.laws.functions.iter().any(|function| function.kind == kind)
    }

    /// Where a function's results stand that fill a slot.
    fn place(&self, kind: FunctionKind, slot: Slot) -> Range<usize> {
        let function = self.laws.functions.iter().find(|function| function.kind == kind);
        function.map_or(0..0, |function| function.parts.range(slot))
    }

    /// The rank of a function's system; zero where it has none.
    fn rank(&mut self, kind: FunctionKind) -> Option<f64> {
        let place = self.place(kind, Slot::Rank);
        Some(self.values(kind)?.get(place).and_then(<[Doubled]>::first).map_or(0.0, |rank| rank.high))
    }

    fn tape(&self, kind: FunctionKind) -> Option<&'a Tape> {
        self.laws.functions.iter().find(|function| function.kind == kind).map(|function| function.tape)
    }

    /// A function with some symbols set otherwise.
    fn with(&mut self, kind: FunctionKind, changed: &[(Symbol, Doubled)]) -> Option<Trace<'a, Doubled>> {
        let tape = self.tape(kind)?;
        let changed: Vec<(usize, Doubled)> =
            changed.iter().filter_map(|&(symbol, x)| Some((self.laws.states.place(symbol)?, x))).collect();
        let state = self.state;
        let symbol = |id: SymbolId| {
            let other = changed.iter().find(|(at, _)| *at == id.0);
            other.map_or_else(|| state.value(id), |&(_, x)| x)
        };
        let trace = Trace::new(tape, &symbol);
        self.doubt = self.doubt.or(doubt_of(&trace));
        Some(trace)
    }

    /// A function as the state is.
    fn trace(&mut self, kind: FunctionKind) -> Option<&Trace<'a, Doubled>> {
        let at = self.laws.functions.iter().position(|function| function.kind == kind)?;
        if self.traces[at].is_none() {
            self.traces[at] = self.with(kind, &[]);
        }
        let trace = self.traces[at].as_ref();
        self.doubt = self.doubt.or(trace.and_then(doubt_of));
        trace
    }

    /// What a system of lesser rank leaves open says nothing of its equations.
    fn deficient(&mut self) -> Judged {
        self.doubt = self.doubt.or(Some(Doubt::Rank));
        None
    }

    fn values(&mut self, kind: FunctionKind) -> Option<Vec<Doubled>> {
        self.trace(kind).map(Trace::roots)
    }

    fn bound(&mut self, kind: FunctionKind, weights: &[f64]) -> f64 {
        self.trace(kind).map_or(0.0, |trace| trace.slopes::<f64>(weights, 0).bound)
    }

    fn symbols(&self) -> usize {
        self.state.values.len()
    }

    fn coordinates(&self) -> &'a [Coordinate] {
        &self.laws.structure.state
    }

    /// Velocity coordinates: as a rule those of the state.
    fn speeds(&self) -> &'a [Coordinate] {
        self.laws.structure.speeds()
    }

    fn dof(&self) -> usize {
        self.speeds().len()
    }

    /// Rates of positions, as far as they are known: the velocities, or what follows from them.
    fn moved(&mut self) -> Option<Vec<Doubled>> {
        if self.laws.structure.has_speeds() {
            self.values(FunctionKind::PositionRates)
        } else {
            Some(self.velocities())
        }
    }

    /// Whether rates of positions are known.
    fn is_moved(&self) -> bool {
        !self.laws.structure.has_speeds() || self.has(FunctionKind::PositionRates)
    }

    fn weights(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.random.next()).collect()
    }

    /// Of velocity coordinates, in their order.
    fn of_state(&self, symbol: fn(Coordinate) -> Symbol) -> Vec<Doubled> {
        let value = |&c: &Coordinate| Doubled::new(self.laws.states.value(self.state, symbol(c)));
        self.speeds().iter().map(value).collect()
    }

    fn velocities(&self) -> Vec<Doubled> {
        self.of_state(velocity)
    }

    /// Whether velocities of the state are all that moves what these functions read.
    fn is_scleronomic(&mut self, kinds: &[FunctionKind]) -> bool {
        let structure = self.laws.structure;
        if structure.has_speeds() {
            // Nothing moves while all of them are zero.
            let still: Vec<(Symbol, Doubled)> = self.speeds().iter().map(|&c| (velocity(c), Doubled::ZERO)).collect();
            let rates = self.with(FunctionKind::PositionRates, &still).map(|trace| trace.roots());
            if rates.is_none_or(|rates| rates.iter().any(|rate| rate.high != 0.0)) {
                return false;
            }
        }
        let driven = structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)));
        let time = self.laws.states.place(Symbol::Time);
        let reads_time =
            |tape: &Tape| tape.nodes.iter().any(|node| matches!(node.op, Op::Symbol(id) if Some(id.0) == time));
        !driven && !kinds.iter().filter_map(|&kind| self.tape(kind)).any(reads_time)
    }

    fn slope(&self, slopes: &Slopes, symbol: Symbol) -> Doubled {
        let at = self.laws.states.place(symbol);
        at.map_or(Doubled::ZERO, |at| slopes.symbols[at])
    }

    /// Slopes by displacements of the position, in the order of the state.
    fn displacements(&self, slopes: &Slopes) -> Vec<Doubled> {
        let slope = |symbol: Symbol| self.slope(slopes, symbol);
        let displacement = |&Coordinate { joint, index }: &Coordinate| {
            let declared = &self.laws.model.joints[joint];
            let turns = declared.kind.freedoms().saturating_sub(3);
            if !has_quaternion(declared) || index < turns {
                return slope(Symbol::Position { joint, component: index });
            }
            let place = |component: usize| Symbol::Position { joint, component: turns + component };
            let [w, i, j, k] = [0, 1, 2, 3].map(|c| Doubled::new(0.5 * self.laws.states.value(self.state, place(c))));
            // q (0, e) / 2
            let rates = match index - turns {
                0 => [-i, w, k, -j],
                1 => [-j, -k, w, i],
                _ => [-k, j, -i, w],
            };
            (0..4).fold(Doubled::ZERO, |sum, c| sum + slope(place(c)) * rates[c])
        };
        self.coordinates().iter().map(displacement).collect()
    }

    fn by(&self, slopes: &Slopes, symbol: fn(Coordinate) -> Symbol) -> Vec<Doubled> {
        self.speeds().iter().map(|&c| self.slope(slopes, symbol(c))).collect()
    }
}

/// Why rounding decides what a function is, or which slopes it has.
fn doubt_of(trace: &Trace<'_, Doubled>) -> Option<Doubt> {
    match (trace.kink || trace.corner, trace.unclear) {
        (true, _) => Some(Doubt::Comparison),
        (_, true) => Some(Doubt::Rank),
        _ => None,
    }
}

fn velocity(c: Coordinate) -> Symbol {
    Symbol::Velocity { joint: c.joint, component: c.index }
}

fn acceleration(c: Coordinate) -> Symbol {
    Symbol::Acceleration { joint: c.joint, component: c.index }
}

fn momentum(c: Coordinate) -> Symbol {
    Symbol::Momentum { joint: c.joint, component: c.index }
}
