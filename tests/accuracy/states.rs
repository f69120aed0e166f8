//! Random states of a model.
//!
//! Every number is one of single precision, so that `f64` and `f32` start from the same; but for parameters that must stay where
//! they are, quaternions, and guesses, of which a program reads the nearest numbers that it has. Loops stand near a configuration
//! in which they close, nearer with every attempt; guesses of Newton's method are solutions.

use std::collections::HashMap;

use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::{Means, Structure};
use multibody_engine::model::types::{Coordinate, JointId, Model};
use multibody_tests::support::random::Random;

use super::digits::{Big, exact, integer};

/// How often a state is drawn again where a function has no clear value.
pub(crate) const ATTEMPTS: usize = 6;

/// How far from where loops close, by attempt.
const NEAR: [f64; ATTEMPTS] = [0.3, 0.1, 0.1, 0.03, 0.03, 0.01];

/// How far coordinates go that no loop holds: all the way round.
const WIDE: f64 = 3.1;

/// The size of parameters that are zero.
const ZERO: f64 = 0.5;

/// How far parameters are moved, relative to their size.
const AROUND: f64 = 0.1;

pub(crate) struct States<'m> {
    model: &'m Model,
    structure: &'m Structure,
    symbols: &'m [Symbol],
    places: HashMap<Symbol, usize>,
}

/// Numbers for all symbols.
#[derive(Clone)]
pub(crate) struct State<'m> {
    states: &'m States<'m>,
    values: Vec<f64>,
    /// Symbols of each quaternion.
    quaternions: Vec<[usize; 4]>,
}

impl<'m> States<'m> {
    pub(crate) fn new(model: &'m Model, structure: &'m Structure, symbols: &'m [Symbol]) -> States<'m> {
        let places = symbols.iter().enumerate().map(|(at, &symbol)| (symbol, at)).collect();
        States { model, structure, symbols, places }
    }

    pub(crate) fn draw(&'m self, number: usize, attempt: usize) -> State<'m> {
        let mut random = Random::new(7919 * number as u64 + 104_729 * attempt as u64);
        let closed = &self.structure.closed;
        let configuration = closed.get(number % closed.len().max(1));
        let held = |joint: usize, component: usize| {
            configuration.and_then(|c| c.positions.get(joint)?.get(component).copied())
        };
        let mut draw = |symbol: &Symbol| match *symbol {
            Symbol::Param { param, element } => {
                let default = self.model.params[param].default[element];
                let size = size(&self.model.params[param].default, element);
                let moved = single(default + AROUND * NEAR[attempt] * size * random.unit());
                if self.structure.pinned.contains(&(param.0, element)) { default } else { moved }
            }
            Symbol::Position { joint, component } => single(match held(joint.0, component) {
                Some(x) => x + NEAR[attempt] * random.unit(),
                None => WIDE * random.unit(),
            }),
            _ => single(random.unit()),
        };
        let values = self.symbols.iter().map(&mut draw).collect();
        let mut state = State { states: self, values, quaternions: self.quaternions() };
        for step in &self.structure.steps {
            let Means::Newton { guess, .. } = step.means else { continue };
            for (k, &Coordinate { joint, index }) in step.unknowns.iter().enumerate() {
                if let Some(x) = held(joint.0, index) {
                    state.set_guess(guess + k, x);
                }
            }
        }
        state
    }

    /// Number of the graph's symbol that stands for this.
    pub(crate) fn place(&self, symbol: Symbol) -> Option<usize> {
        self.places.get(&symbol).copied()
    }

    fn quaternions(&self) -> Vec<[usize; 4]> {
        let mut found = Vec::new();
        for (id, joint) in self.model.joints.iter().enumerate().filter(|(_, joint)| joint.kind.has_quaternion()) {
            let first = joint.kind.freedoms() - 3;
            let places =
                [0, 1, 2, 3].map(|k| self.place(Symbol::Position { joint: JointId(id), component: first + k }));
            if let [Some(w), Some(i), Some(j), Some(k)] = places {
                found.push([w, i, j, k]);
            }
        }
        found
    }
}

impl State<'_> {
    /// What equations are evaluated at, by symbol: quaternions are of unit length, whatever programs make of them.
    pub(crate) fn exact(&self) -> Vec<Big> {
        let mut values: Vec<Big> = self.values.iter().map(|&x| exact(x)).collect();
        for list in &self.quaternions {
            let square = list.map(|at| values[at].clone() * &values[at]).into_iter().reduce(|a, b| a + b);
            let length = square.expect("four components").sqrt();
            list.iter().for_each(|&at| values[at] = values[at].clone() / &length);
        }
        for (value, symbol) in values.iter_mut().zip(self.states.symbols) {
            match *symbol {
                // Outside its iteration only what is the same anywhere on the circle reads it.
                Symbol::UnknownPoint { component, .. } => *value = integer([3, 4][component]) / integer(5),
                Symbol::Alternative { component } if component < 2 => *value = integer([3, 4][component]) / integer(5),
                Symbol::Alternative { .. } => *value = integer(1),
                _ => {}
            }
        }
        values
    }

    /// As a program reads it.
    pub(crate) fn read(&self, symbol: Symbol) -> f64 {
        self.values[self.states.place(symbol).expect("programs read symbols of the graph")]
    }

    /// Sets a guess of Newton's method.
    pub(crate) fn set_guess(&mut self, index: usize, value: f64) {
        if let Some(at) = self.states.place(Symbol::Guess { index }) {
            self.values[at] = value;
        }
    }
}

/// What is zero has the size of the greatest element beside it: a product of inertia that is of another size than the moments leaves
/// no mass matrix that is positive.
fn size(default: &[f64], element: usize) -> f64 {
    let greatest = default.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    [default[element].abs(), greatest, ZERO].into_iter().find(|&size| size > 0.0).expect("not all are zero")
}

/// The nearest number of single precision.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}
