//! Stage `verify`: constraint equations, their Jacobian, their rates, and what is left of their second derivatives.

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Slot;
use crate::contracts::symbol::Symbol;
use crate::mechanics::loops::constraints::is_rate;
use crate::model::types::{Handling, StateId};
use crate::symbolic::doubled::Doubled;
use crate::verify::trace::Slopes;

use super::{At, Judged, Law, Sum, judged, velocity};

pub(super) const LAWS: &[Law] = &[
    Law { between: "the constraints and their Jacobian", judge: |at| at.jacobian() },
    Law { between: "the constraints and their rates", judge: |at| at.rates() },
    Law { between: "the rates of the constraints and their Jacobian", judge: |at| at.slopes_of_rates() },
    Law { between: "the Jacobians of the constraints by positions and by velocities", judge: |at| at.both_jacobians() },
    Law { between: "the rates of the constraints and their bias", judge: |at| at.second_rates() },
];

impl At<'_, '_> {
    /// Slopes of what is left of equations of positions.
    fn jacobian(&mut self) -> Judged {
        let r = self.of_positions();
        let speeds = self.laws.structure.has_speeds();
        let g = if speeds { FunctionKind::PositionJacobian } else { FunctionKind::ConstraintJacobian };
        self.jacobian_of(FunctionKind::Constraints, g, &r, |at, slopes| at.displacements(slopes))
    }

    /// Rates are linear in velocities, those of velocities alone too: their slopes are the Jacobian.
    fn slopes_of_rates(&mut self) -> Judged {
        let r = self.weights(self.laws.structure.rows.len());
        let g = FunctionKind::ConstraintJacobian;
        self.jacobian_of(FunctionKind::ConstraintRate, g, &r, |at, slopes| at.by(slopes, velocity))
    }

    /// Where velocities are no rates of positions, what they open is what the rates of positions open that they add.
    fn both_jacobians(&mut self) -> Judged {
        let (moved, all, own) =
            (FunctionKind::PositionRates, FunctionKind::PositionJacobian, FunctionKind::ConstraintJacobian);
        if ![moved, all, own].iter().all(|&kind| self.has(kind)) {
            return Some(None);
        }
        let r = self.weights(self.laws.structure.rows.len());
        let (v, rates) = (self.velocities(), self.values(moved)?);
        let still: Vec<(Symbol, Doubled)> = self.speeds().iter().map(|&c| (velocity(c), Doubled::ZERO)).collect();
        let at_rest = self.with(moved, &still)?.roots();
        let added: Vec<Doubled> = rates.iter().zip(&at_rest).map(|(&rate, &rest)| rate - rest).collect();
        let mut sum = Sum::default();
        for (g, sign, along) in [(own, 1.0, &v), (all, -1.0, &added)] {
            let (jacobian, width) = (self.values(g)?, along.len());
            let mut weights = vec![0.0; jacobian.len()];
            for (at, &x) in jacobian.iter().enumerate() {
                sum.product(&[x, Doubled::new(sign * r[at / width]), along[at % width]]);
                weights[at] = r[at / width] * along[at % width].high;
            }
            sum.bound += self.bound(g, &weights);
            // What the rates of positions are rounded by.
            if g == all {
                let mut back = vec![0.0; width];
                jacobian.iter().enumerate().for_each(|(at, x)| back[at % width] += r[at / width] * x.high);
                sum.bound += 2.0 * self.bound(moved, &back);
            }
        }
        judged(&sum, own, all)
    }

    /// The slopes of a sum of equations with these weights, along a random direction, against a Jacobian.
    fn jacobian_of(
        &mut self,
        of: FunctionKind,
        g: FunctionKind,
        r: &[f64],
        columns: impl Fn(&Self, &Slopes) -> Vec<Doubled>,
    ) -> Judged {
        if r.is_empty() || !self.has(of) || !self.has(g) {
            return Some(None);
        }
        let symbols = self.symbols();
        let slopes = self.trace(of)?.slopes::<Doubled>(r, symbols);
        let columns = columns(self, &slopes);
        let (n, s) = (columns.len(), self.weights(columns.len()));
        let jacobian = self.values(g)?;
        let mut sum = Sum::default();
        let mut weights = vec![0.0; jacobian.len()];
        for (at, &x) in jacobian.iter().enumerate() {
            sum.product(&[x, Doubled::new(r[at / n]), Doubled::new(s[at % n])]);
            weights[at] = r[at / n] * s[at % n];
        }
        columns.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(g, &weights) + slopes.bound;
        }
        judged(&sum, g, of)
    }

    fn rates(&mut self) -> Judged {
        let r = self.of_positions();
        self.rate_of(FunctionKind::Constraints, FunctionKind::ConstraintRate, &r)
    }

    /// Weights of equations, without those of velocities: these have no residual that their Jacobian were a slope of.
    fn of_positions(&mut self) -> Vec<f64> {
        let weights = self.weights(self.laws.structure.rows.len());
        self.without_rates(weights)
    }

    /// The same of these.
    pub(super) fn without_rates(&self, mut weights: Vec<f64>) -> Vec<f64> {
        let (structure, model) = (self.laws.structure, self.laws.model);
        weights.iter_mut().zip(&structure.rows).filter(|(_, row)| is_rate(model, **row)).for_each(|(w, _)| *w = 0.0);
        weights
    }

    fn second_rates(&mut self) -> Judged {
        if matches!(self.laws.model.handling, Handling::Stabilised { .. }) {
            // Stabilising terms are in it too.
            return Some(None);
        }
        let r = self.weights(self.laws.structure.rows.len());
        self.rate_of(FunctionKind::ConstraintRate, FunctionKind::ConstraintBias, &r)
    }

    /// Slopes by positions, time and own states, times their rates, while velocities stand.
    fn rate_of(&mut self, of: FunctionKind, rate: FunctionKind, r: &[f64]) -> Judged {
        let rows = self.laws.structure.rows.len();
        if rows == 0 || !self.has(of) || !self.has(rate) {
            return Some(None);
        }
        if !self.is_moved() {
            return Some(None);
        }
        let (v, symbols) = (self.moved()?, self.symbols());
        let slopes = self.trace(of)?.slopes::<Doubled>(r, symbols);
        let mut sum = Sum::default();
        self.values(rate)?.iter().zip(r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        self.displacements(&slopes).iter().zip(&v).for_each(|(&x, &v)| sum.product(&[-x, v]));
        sum.add(-self.slope(&slopes, Symbol::Time));
        let of_states: Vec<Doubled> = (0..self.laws.model.states.len())
            .map(|k| self.slope(&slopes, Symbol::State { state: StateId(k) }))
            .collect();
        if of_states.iter().any(|slope| slope.high != 0.0) {
            let forward = FunctionKind::ForwardDynamics;
            if !self.has(forward) {
                return Some(None);
            }
            let place = self.place(forward, Slot::States);
            let rates = self.values(forward)?.get(place).unwrap_or_default().to_vec();
            of_states.iter().zip(&rates).for_each(|(&slope, &rate)| sum.product(&[-slope, rate]));
        }
        if sum.holds() != Some(true) {
            sum.bound = self.bound(rate, r) + slopes.bound;
        }
        judged(&sum, rate, of)
    }
}
