//! Stage `verify`: derivatives are the slopes of what they are derivatives of.

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Slot;
use crate::contracts::symbol::Symbol;
use crate::model::types::{InputId, StateId};
use crate::symbolic::doubled::Doubled;

use super::{At, Judged, Law, Sum, judged, velocity};

pub(super) const LAWS: &[Law] = &[
    Law {
        between: "the derivatives of forward dynamics and its slopes",
        judge: |at| at.blocks(FunctionKind::ForwardDerivatives, FunctionKind::ForwardDynamics),
    },
    Law {
        between: "the derivatives of inverse dynamics and its slopes",
        judge: |at| at.blocks(FunctionKind::InverseDerivatives, FunctionKind::InverseDynamics),
    },
    Law {
        between: "the derivatives of rates of positions and their slopes",
        judge: |at| at.blocks(FunctionKind::RateDerivatives, FunctionKind::PositionRates),
    },
    Law {
        between: "the linearised equations and the slopes of forward dynamics",
        judge: |at| at.linear(FunctionKind::ForwardDynamics, [Slot::StateMatrix, Slot::InputMatrix]),
    },
    Law {
        between: "the linearised outputs and their slopes",
        judge: |at| at.linear(FunctionKind::Outputs, [Slot::OutputMatrix, Slot::Feedthrough]),
    },
];

/// Where derivatives of a function stand among the numbers of another.
struct Entries<'a> {
    derivative: FunctionKind,
    function: FunctionKind,
    /// Results of the function that are differentiated: the first so many.
    rows: usize,
    /// By the number of what it is differentiated by (position, velocity, own states, inputs), row and column.
    place: &'a dyn Fn(usize, usize, usize) -> usize,
}

impl At<'_, '_> {
    /// One matrix for each of what a function is differentiated by.
    fn blocks(&mut self, derivative: FunctionKind, function: FunctionKind) -> Judged {
        let inverse = function == FunctionKind::InverseDynamics;
        if !self.has(derivative) || !self.has(function) || (inverse && !self.laws.model.solve_for.is_empty()) {
            return Some(None);
        }
        let sizes = self.moving();
        let rows = match function {
            FunctionKind::PositionRates => sizes[0],
            _ => self.dof() + if inverse { 0 } else { sizes[2] },
        };
        let slots = [Slot::ByPosition, Slot::ByVelocity, Slot::ByState, Slot::ByInput];
        let first = slots.map(|slot| self.place(derivative, slot).start);
        let place = |block: usize, row: usize, column: usize| first[block] + row * sizes[block] + column;
        self.derivative(&Entries { derivative, function, rows, place: &place })
    }

    /// A matrix by the state and one by the inputs; of the rates of the state the last rows are accelerations and rates of
    /// own states.
    fn linear(&mut self, function: FunctionKind, slots: [Slot; 2]) -> Judged {
        let derivative = FunctionKind::Linearization;
        if !self.has(derivative) || !self.has(function) {
            return Some(None);
        }
        let [positions, velocities, states, inputs] = self.moving();
        let width = positions + velocities + states;
        let ranges = slots.map(|slot| self.place(derivative, slot));
        let all = ranges[0].len() / width.max(1);
        let above = if function == FunctionKind::ForwardDynamics { positions } else { 0 };
        let rows = all - above;
        let first = ranges.map(|range| range.start);
        let before = [0, positions, positions + velocities];
        let place = |block: usize, row: usize, column: usize| match before.get(block) {
            Some(before) => first[0] + (above + row) * width + before + column,
            None => first[1] + (above + row) * inputs + column,
        };
        self.derivative(&Entries { derivative, function, rows, place: &place })
    }

    /// Numbers of displacements, velocities, own states and inputs.
    fn moving(&self) -> [usize; 4] {
        let model = self.laws.model;
        let inputs = model.inputs.iter().map(|input| input.ty.scalars()).sum();
        [self.coordinates().len(), self.dof(), model.states.len(), inputs]
    }

    fn derivative(&mut self, entries: &Entries<'_>) -> Judged {
        let &Entries { derivative, function, rows, place } = entries;
        let model = self.laws.model;
        let mut r = self.weights(rows);
        let count = self.values(function)?.len();
        let rows_weights = r.clone();
        r.resize(count, 0.0);
        let symbols = self.symbols();
        let slopes = self.trace(function)?.slopes::<Doubled>(&r, symbols);
        let (positions, velocities) = (self.displacements(&slopes), self.by(&slopes, velocity));
        let other = |symbol: Symbol| self.slope(&slopes, symbol);
        let own = (0..model.states.len()).map(|k| other(Symbol::State { state: StateId(k) })).collect();
        let inputs = model.inputs.iter().enumerate().flat_map(|(k, input)| {
            let input_id = InputId(k);
            (0..input.ty.scalars()).map(move |element| Symbol::Input { input: input_id, element })
        });
        let inputs: Vec<Doubled> = inputs.map(other).collect();
        let blocks: [Vec<Doubled>; 4] = [positions, velocities, own, inputs];
        let given = self.values(derivative)?;
        let mut weights = vec![0.0; given.len()];
        let mut sum = Sum::default();
        for (number, block) in blocks.iter().enumerate() {
            let s = self.weights(block.len());
            block.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
            for (i, &r) in rows_weights.iter().enumerate() {
                for (j, &s) in s.iter().enumerate() {
                    let at = place(number, i, j);
                    sum.product(&[given[at], Doubled::new(r), Doubled::new(s)]);
                    weights[at] = r * s;
                }
            }
        }
        if sum.holds() != Some(true) {
            // A reverse sweep rounds as often as there are operations, and each may count as much as the function itself.
            sum.bound = self.bound(derivative, &weights) + slopes.bound;
        }
        judged(&sum, derivative, function)
    }
}
