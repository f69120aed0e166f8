//! Stage `verify`: states at which programs are evaluated.
//!
//! In: the model, its structure with the closed configurations that the analysis has found, and the symbols of the
//! derivation. Out: numbers for all symbols, always the same: parameters at their defaults in the first state and near them in others,
//! states that bodies follow where they start and near that,
//! coordinates of loops at or near a closed configuration, everything else at random. Parameters that open loops stay at their defaults.

use std::collections::BTreeSet;

use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::mechanics::loops::structure::{Means, Structure};
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::types::{Coordinate, Model, StateId};
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::SymbolId;

use super::ATTEMPTS;
use super::tape::Tape;
use super::trace::Trace;

/// How far parameters are moved, relative to their size.
const AROUND: f64 = 0.02;

/// How far those are moved that open loops, to see whether that is reported.
const OPENING: f64 = 1e-4;

/// Rounds of Newton's method, each of as many steps as the emitted code takes.
const CLOSINGS: usize = 20;

/// What is left of loops that are closed.
const CLOSED: f64 = 1e-10;

/// Values of all symbols of a derivation.
#[derive(Clone)]
pub(super) struct State {
    pub values: Vec<f64>,
    /// Whether parameters are at their defaults.
    pub defaults: bool,
}

impl State {
    pub(super) fn value(&self, id: SymbolId) -> Doubled {
        Doubled::new(self.values[id.0])
    }
}

/// Draws states of one model.
pub(super) struct States<'m> {
    model: &'m Model,
    structure: &'m Structure,
    symbols: &'m [Symbol],
    table: Table,
    /// That bodies follow.
    inertial: BTreeSet<StateId>,
}

/// Places of symbols.
#[derive(Default)]
struct Table {
    lists: [Vec<Vec<usize>>; 13],
}

/// Which list a symbol stands in, and where.
fn address(symbol: Symbol) -> (usize, usize, usize) {
    match symbol {
        Symbol::Time => (0, 0, 0),
        Symbol::Param { param, element } => (1, param.0, element),
        Symbol::Input { input, element } => (2, input.0, element),
        Symbol::State { state } => (3, state.0, 0),
        Symbol::Position { joint, component } => (4, joint.0, component),
        Symbol::Velocity { joint, component } => (5, joint.0, component),
        Symbol::Acceleration { joint, component } => (6, joint.0, component),
        Symbol::Multiplier { row } => (7, row, 0),
        Symbol::Impulse { joint, component } => (8, joint.0, component),
        Symbol::Momentum { joint, component } => (9, joint.0, component),
        Symbol::Rate { row } => (10, row, 0),
        Symbol::Guess { index } => (11, index, 0),
        Symbol::Alternative { component } => (12, component, 0),
        Symbol::Unknown { .. } | Symbol::UnknownPoint { .. } | Symbol::Number { .. } => (usize::MAX, 0, 0),
    }
}

impl<'m> States<'m> {
    pub(super) fn new(model: &'m Model, structure: &'m Structure, symbols: &'m [Symbol]) -> States<'m> {
        let mut table = Table::default();
        for (at, &symbol) in symbols.iter().enumerate() {
            let (list, item, element) = address(symbol);
            let Some(list) = table.lists.get_mut(list) else { continue };
            if list.len() <= item {
                list.resize(item + 1, Vec::new());
            }
            if list[item].len() <= element {
                list[item].resize(element + 1, usize::MAX);
            }
            list[item][element] = at;
        }
        States { model, structure, symbols, table, inertial: model.inertial_states() }
    }

    /// Whether a body's mass follows a state.
    pub(super) fn is_inertial(&self, state: StateId) -> bool {
        self.inertial.contains(&state)
    }

    /// Number of the graph's symbol that stands for this.
    pub(super) fn place(&self, symbol: Symbol) -> Option<usize> {
        let (list, item, element) = address(symbol);
        let list = self.table.lists.get(list)?;
        list.get(item)?.get(element).copied().filter(|&at| at != usize::MAX)
    }

    /// What a program reads.
    pub(super) fn value(&self, state: &State, symbol: Symbol) -> f64 {
        state.values[self.place(symbol).or_fault("a program reads symbols of the graph")]
    }

    /// Whether nothing depends on how states with parameters at their defaults differ from others.
    pub(super) fn has_no_parameters(&self) -> bool {
        self.symbols.iter().all(|&symbol| match symbol {
            Symbol::Param { param, element } => self.structure.pinned.contains(&(param.0, element)),
            _ => true,
        })
    }

    /// State number `number`, drawn for the time `attempt`: nearer to where loops close each time, then near the default
    /// position with numbers of other sizes.
    pub(super) fn draw(&self, number: usize, attempt: usize) -> State {
        self.drawn(number, attempt, &self.structure.pinned, if number == 0 { 0.0 } else { AROUND })
    }

    /// The same with all parameters moved by a little: those that open loops too.
    pub(super) fn unpinned(&self, number: usize, attempt: usize) -> State {
        self.drawn(number, attempt, &[], OPENING)
    }

    /// Whether there are parameters that open loops.
    pub(super) fn has_pinned(&self) -> bool {
        !self.structure.pinned.is_empty()
    }

    fn drawn(&self, number: usize, attempt: usize, pinned: &[(usize, usize)], around: f64) -> State {
        let mut random = Random(0x0C8E_C4ED + 7919 * number as u64 + 104_729 * attempt as u64);
        // The first is the one that a person would draw: in line, or at right angles.
        let closed = self.structure.closed.get(1..).filter(|list| !list.is_empty()).unwrap_or(&self.structure.closed);
        let further = attempt.checked_sub(ATTEMPTS);
        let configuration = match further {
            Some(_) => self.structure.closed.first(),
            None => closed.get((number + attempt) % closed.len().max(1)),
        };
        let near = [0.1, 0.03, 0.3, 0.01, 0.0][attempt % 5];
        let wide = if further.is_some() { near } else { [1.2, 0.8, 0.4, 1.6, 0.1][attempt % 5] };
        // Functions of the user's may ask for numbers that are large, or small, or all positive.
        let size = further.map_or(1.0, |k| [1.0, 0.1, 10.0, 1e-2, 100.0, 1e-3, 1e3][k / 2 % 7]);
        let positive = further.is_some_and(|k| k % 2 == 1);
        let held = |joint: usize, component: usize| {
            configuration.and_then(|c| c.positions.get(joint)?.get(component).copied())
        };
        let beside = |x: f64, way: f64| x + around * (if x == 0.0 { 0.5 } else { x.abs() }) * way;
        let mut value = |symbol: &Symbol| match *symbol {
            Symbol::Time => 0.4 + 0.4 * random.next(),
            Symbol::Param { param, element } => {
                let default = self.model.params[param].default[element];
                let moved = beside(default, random.next());
                if pinned.contains(&(param.0, element)) { default } else { moved }
            }
            // Others would be masses of no body.
            Symbol::State { state } if self.inertial.contains(&state) => {
                beside(self.model.states[state].start, random.next())
            }
            Symbol::Position { joint, component } => match held(joint.0, component) {
                // Equations with multipliers are zero where they are closed, which says nothing of their own values.
                Some(x) if attempt == 0 && !self.structure.rows.is_empty() => x,
                Some(x) => x + near * random.next(),
                None => wide * random.next(),
            },
            Symbol::Guess { .. } => 0.0,
            // A point of the circle, another one each time, and sides.
            Symbol::Alternative { component } => {
                let (sin, cos) = (2.399_963 * (1 + number + 3 * attempt) as f64).sin_cos();
                let side = |k: usize| if attempt >> k & 1 == 0 { 1.0 } else { -1.0 };
                [cos, sin, side(0), side(1), side(2)][component]
            }
            // Outside its iteration only what is the same anywhere on the circle reads it.
            Symbol::UnknownPoint { component, .. } => [0.6, 0.8][component],
            _ => {
                let x = random.next();
                size * if positive { x.abs() } else { x }
            }
        };
        let values = self.symbols.iter().map(&mut value).collect();
        let mut state = State { values, defaults: around == 0.0 };
        self.start(&mut state, &held);
        self.normalise(&mut state);
        state
    }

    /// The same with guesses at which loops are open, without a solution.
    pub(super) fn open(&self, number: usize, attempt: usize) -> State {
        let mut state = self.draw(number, attempt);
        let mut random = Random(0x09E2 + attempt as u64);
        for &at in self.table.lists[11].iter().flatten() {
            state.values[at] += 0.3 * random.next();
        }
        state
    }

    /// Guesses of Newton's method.
    fn start(&self, state: &mut State, held: &dyn Fn(usize, usize) -> Option<f64>) {
        for step in &self.structure.steps {
            let Means::Newton { guess, .. } = step.means else { continue };
            for (k, &Coordinate { joint, index }) in step.unknowns.iter().enumerate() {
                if let (Some(at), Some(x)) = (self.place(Symbol::Guess { index: guess + k }), held(joint.0, index)) {
                    state.values[at] = x;
                }
            }
        }
    }

    /// The same with its loops closed by Newton's method, as `Model::close` does; nothing if they don't close.
    pub(super) fn closed(&self, mut state: State, closing: &Tape) -> Option<State> {
        for _ in 0..CLOSINGS {
            let symbol = |id: SymbolId| state.value(id);
            let results = Trace::<f64>::new(closing, &symbol).roots();
            let (residual, guesses) = results.split_last()?;
            for (index, &x) in guesses.iter().enumerate() {
                if let Some(at) = self.place(Symbol::Guess { index }) {
                    state.values[at] = x;
                }
            }
            if *residual < CLOSED {
                return Some(state);
            }
        }
        None
    }

    /// Quaternions are of unit length.
    fn normalise(&self, state: &mut State) {
        for (joint, declared) in self.model.joints.iter().enumerate().filter(|(_, joint)| has_quaternion(joint)) {
            let first = declared.kind.freedoms() - 3;
            let Some(places) = self.table.lists[4].get(joint).and_then(|list| list.get(first..first + 4)) else {
                continue;
            };
            let square: f64 = places.iter().map(|&at| state.values[at].powi(2)).sum();
            for &at in places {
                state.values[at] /= square.sqrt();
            }
        }
    }
}

/// Numbers between -1 and 1 (SplitMix64), the same in every build.
pub(super) struct Random(pub u64);

impl Random {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
