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
        judge: |at| at.derivative(FunctionKind::ForwardDerivatives, FunctionKind::ForwardDynamics),
    },
    Law {
        between: "the derivatives of inverse dynamics and its slopes",
        judge: |at| at.derivative(FunctionKind::InverseDerivatives, FunctionKind::InverseDynamics),
    },
];

impl At<'_, '_> {
    fn derivative(&mut self, derivative: FunctionKind, function: FunctionKind) -> Judged {
        let inverse = function == FunctionKind::InverseDynamics;
        if !self.has(derivative) || !self.has(function) || (inverse && !self.laws.model.solve_for.is_empty()) {
            return Some(None);
        }
        let (n, model) = (self.dof(), self.laws.model);
        let states = model.states.len();
        let rows = n + if inverse { 0 } else { states };
        let mut r = self.weights(rows);
        let count = self.values(function)?.len();
        let rows_weights = r.clone();
        r.resize(count, 0.0);
        let symbols = self.symbols();
        let slopes = self.trace(function)?.slopes::<Doubled>(&r, symbols);
        let (positions, velocities) = (self.displacements(&slopes), self.by(&slopes, velocity));
        let other = |symbol: Symbol| self.slope(&slopes, symbol);
        let own = (0..states).map(|k| other(Symbol::State { state: StateId(k) })).collect();
        let inputs = model.inputs.iter().enumerate().flat_map(|(k, input)| {
            let input_id = InputId(k);
            (0..input.ty.scalars()).map(move |element| Symbol::Input { input: input_id, element })
        });
        let inputs: Vec<Doubled> = inputs.map(other).collect();
        let blocks: [Vec<Doubled>; 4] = [positions, velocities, own, inputs];
        let given = self.values(derivative)?;
        let mut weights = vec![0.0; given.len()];
        let mut sum = Sum::default();
        let slots = [Slot::ByPosition, Slot::ByVelocity, Slot::ByState, Slot::ByInput];
        for (block, slot) in blocks.iter().zip(slots) {
            let first = self.place(derivative, slot).start;
            let s = self.weights(block.len());
            block.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
            for (i, &r) in rows_weights.iter().enumerate() {
                for (j, &s) in s.iter().enumerate() {
                    let at = first + i * block.len() + j;
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
