//! Stage `verify`: inverse dynamics, forward dynamics and the residual of the equations.

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Slot;
use crate::contracts::symbol::Symbol;
use crate::symbolic::doubled::Doubled;

use super::{At, Judged, Law, Sum, acceleration, judged};

pub(super) const LAWS: &[Law] = &[
    Law { between: "the mass matrix and inverse dynamics", judge: |at| at.inertia() },
    Law { between: "the bias and inverse dynamics", judge: |at| at.efforts() },
    Law { between: "the residual and inverse dynamics", judge: |at| at.residual() },
    Law { between: "the residual and the constraints", judge: |at| at.residual_of_rows() },
    Law { between: "forward dynamics and the residual", judge: |at| at.free_motion(true) },
    Law { between: "forward dynamics and inverse dynamics", judge: |at| at.free_motion(false) },
    Law { between: "forward dynamics and the constraints", judge: |at| at.accelerated_rows() },
];

impl At<'_, '_> {
    /// Slopes of inverse dynamics by accelerations are M.
    fn inertia(&mut self) -> Judged {
        let (id, m) = (FunctionKind::InverseDynamics, FunctionKind::MassMatrix);
        if !self.has(id) || !self.laws.model.solve_for.is_empty() || !self.has(m) {
            return Some(None);
        }
        let n = self.dof();
        let (r, s) = (self.weights(n), self.weights(n));
        let symbols = self.symbols();
        let slopes = self.trace(id)?.slopes::<Doubled>(&r, symbols);
        let inertia = self.by(&slopes, acceleration);
        let mass = self.values(m)?;
        let mut sum = Sum::default();
        let mut weights = vec![0.0; n * n];
        for (at, &x) in mass.iter().enumerate() {
            weights[at] = r[at / n] * s[at % n];
            sum.product(&[x, Doubled::new(r[at / n]), Doubled::new(s[at % n])]);
        }
        inertia.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(m, &weights) + slopes.bound;
        }
        judged(&sum, m, id)
    }

    /// Inverse dynamics is M a + bias.
    fn efforts(&mut self) -> Judged {
        let (id, b) = (FunctionKind::InverseDynamics, FunctionKind::Bias);
        if !self.has(id) || !self.laws.model.solve_for.is_empty() || !self.has(b) {
            return Some(None);
        }
        let n = self.dof();
        let r = self.weights(n);
        let efforts = self.values(id)?;
        let symbols = self.symbols();
        let slopes = self.trace(id)?.slopes::<Doubled>(&r, symbols);
        let inertia = self.by(&slopes, acceleration);
        let bias = self.values(b)?;
        let accelerations = self.of_state(acceleration);
        let mut sum = Sum::default();
        efforts.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        bias.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        inertia.iter().zip(&accelerations).for_each(|(&x, &a)| sum.product(&[-x, a]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(b, &r) + slopes.bound;
        }
        judged(&sum, b, id)
    }

    /// Whatever accelerations and multipliers are: M a + bias + G^T lambda.
    fn residual(&mut self) -> Judged {
        let whole = FunctionKind::Residual;
        let (id, m, b) = (FunctionKind::InverseDynamics, FunctionKind::MassMatrix, FunctionKind::Bias);
        let (g, rows) = (FunctionKind::ConstraintJacobian, self.laws.structure.rows.len());
        let inverse = self.has(id) && self.laws.model.solve_for.is_empty();
        let others = inverse || (self.has(m) && self.has(b));
        if !self.has(whole) || !others || (rows > 0 && !self.has(g)) {
            return Some(None);
        }
        let (n, accelerations) = (self.dof(), self.of_state(acceleration));
        let r = self.weights(n);
        let (mut sum, mut bound) = (Sum::default(), 0.0);
        self.values(whole)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        let other = if inverse {
            self.values(id)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
            bound += self.bound(id, &r);
            id
        } else {
            let mut weights = vec![0.0; n * n];
            for (at, &x) in self.values(m)?.iter().enumerate() {
                sum.product(&[-x, Doubled::new(r[at / n]), accelerations[at % n]]);
                weights[at] = r[at / n] * accelerations[at % n].high;
            }
            self.values(b)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
            bound += self.bound(m, &weights) + self.bound(b, &r);
            m
        };
        if rows > 0 {
            let multiplier = |row: usize| self.laws.states.value(self.state, Symbol::Multiplier { row });
            let multipliers: Vec<f64> = (0..rows).map(multiplier).collect();
            let jacobian = self.values(g)?;
            let mut weights = vec![0.0; jacobian.len()];
            for (at, &x) in jacobian.iter().enumerate() {
                sum.product(&[-x, Doubled::new(multipliers[at / n]), Doubled::new(r[at % n])]);
                weights[at] = multipliers[at / n] * r[at % n];
            }
            bound += self.bound(g, &weights);
        }
        if sum.holds() != Some(true) {
            sum.bound = bound + self.bound(whole, &r);
        }
        judged(&sum, whole, other)
    }

    /// Behind the equations of motion the residual has those of the constraints.
    fn residual_of_rows(&mut self) -> Judged {
        let (whole, phi) = (FunctionKind::Residual, FunctionKind::Constraints);
        let rows = self.laws.structure.rows.len();
        if rows == 0 || !self.has(whole) || !self.has(phi) {
            return Some(None);
        }
        let rate = FunctionKind::ConstraintRate;
        // Equations of velocities have their left sides there, which are rates.
        let mut r = self.weights(rows);
        let positions = self.without_rates(r.clone());
        let of_velocities: Vec<f64> = r.iter().zip(&positions).map(|(&r, &p)| r - p).collect();
        let rolls = of_velocities.iter().any(|&r| r != 0.0) && self.has(rate);
        if !rolls {
            r.clone_from(&positions);
        }
        let mut weights = vec![0.0; self.place(whole, Slot::Gaps).start];
        weights.extend(&r);
        let mut sum = Sum::default();
        self.values(whole)?.iter().zip(&weights).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        self.values(phi)?.iter().zip(&positions).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        if rolls {
            self.values(rate)?.iter().zip(&of_velocities).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        }
        if sum.holds() != Some(true) {
            sum.bound = self.bound(whole, &weights) + self.bound(phi, &positions);
            sum.bound += if rolls { self.bound(rate, &of_velocities) } else { 0.0 };
        }
        judged(&sum, whole, phi)
    }

    /// The efforts of free motion are those of the multipliers: M a + bias + G^T lambda = 0, in the equations as one residual, or
    /// in those without multipliers.
    fn free_motion(&mut self, whole: bool) -> Judged {
        let fd = FunctionKind::ForwardDynamics;
        let (id, m, b) = (FunctionKind::InverseDynamics, FunctionKind::MassMatrix, FunctionKind::Bias);
        let inverse = !whole && self.has(id) && self.laws.model.solve_for.is_empty();
        let others = if whole { self.has(FunctionKind::Residual) } else { inverse || (self.has(m) && self.has(b)) };
        if !self.has(fd) || !others {
            return Some(None);
        }
        let (n, rows) = (self.dof(), self.laws.structure.rows.len());
        let found = self.values(fd)?;
        let accelerations = found[self.place(fd, Slot::Velocity)].to_vec();
        let held = self.place(fd, Slot::Multipliers);
        let multipliers = found[held.clone()].to_vec();
        let r = self.weights(n);
        let mut changed: Vec<(Symbol, Doubled)> = Vec::new();
        changed.extend(self.speeds().iter().zip(&accelerations).map(|(&c, &a)| (acceleration(c), a)));
        changed.extend(multipliers.iter().enumerate().map(|(row, &x)| (Symbol::Multiplier { row }, x)));
        let mut sum = Sum::default();
        // What forward dynamics leaves, weighted as it counts here.
        let mut back = vec![0.0; found.len()];
        let other = if inverse {
            let trace = self.with(id, &changed)?;
            let symbols = self.symbols();
            let slopes = trace.slopes::<f64>(&r, symbols);
            trace.roots().iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            back.iter_mut().zip(self.by(&slopes, acceleration)).for_each(|(slot, x)| *slot = x.high);
            sum.bound += slopes.bound;
            id
        } else if whole {
            let trace = self.with(FunctionKind::Residual, &changed)?;
            let symbols = self.symbols();
            let mut weights = r.clone();
            weights.resize(n + rows, 0.0);
            let slopes = trace.slopes::<f64>(&weights, symbols);
            trace.roots().iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            back.iter_mut().zip(self.by(&slopes, acceleration)).for_each(|(slot, x)| *slot = x.high);
            for row in 0..rows {
                let place = self.laws.states.place(Symbol::Multiplier { row });
                let slope = place.map_or(0.0, |at| slopes.symbols[at].high);
                back[held.start + row] = slope;
            }
            sum.bound += slopes.bound;
            FunctionKind::Residual
        } else {
            let (mass, bias) = (self.values(m)?, self.values(b)?);
            let mut weights = vec![0.0; n * n];
            for (at, &x) in mass.iter().enumerate() {
                sum.product(&[x, Doubled::new(r[at / n]), accelerations[at % n]]);
                weights[at] = r[at / n] * accelerations[at % n].high;
                back[at % n] += r[at / n] * x.high;
            }
            bias.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            sum.bound += self.bound(m, &weights) + self.bound(b, &r);
            m
        };
        let g = FunctionKind::ConstraintJacobian;
        if rows > 0 && other != FunctionKind::Residual {
            let jacobian = self.values(g)?;
            let mut weights = vec![0.0; jacobian.len()];
            for (at, &x) in jacobian.iter().enumerate() {
                let (row, column) = (at / n, at % n);
                sum.product(&[x, multipliers[row], Doubled::new(r[column])]);
                weights[at] = multipliers[row].high * r[column];
                back[held.start + row] += x.high * r[column];
            }
            sum.bound += self.bound(g, &weights);
        }
        sum.bound += self.bound(fd, &back);
        judged(&sum, fd, other)
    }

    /// Accelerations keep the constraints: G a and what is left of the second derivatives cancel, where no equation follows from
    /// others.
    fn accelerated_rows(&mut self) -> Judged {
        let (fd, g, b) =
            (FunctionKind::ForwardDynamics, FunctionKind::ConstraintJacobian, FunctionKind::ConstraintBias);
        let rows = self.laws.structure.rows.len();
        if rows == 0 || ![fd, g, b].iter().all(|&kind| self.has(kind)) {
            return Some(None);
        }
        let (n, r) = (self.dof(), self.weights(rows));
        let found = self.values(fd)?;
        if self.rank(fd)? < rows as f64 {
            return self.deficient();
        }
        let jacobian = self.values(g)?;
        let (mut sum, mut weights, mut back) = (Sum::default(), vec![0.0; rows * n], vec![0.0; found.len()]);
        for (at, &x) in jacobian.iter().enumerate() {
            let (row, column) = (at / n, at % n);
            sum.product(&[x, Doubled::new(r[row]), found[column]]);
            weights[at] = r[row] * found[column].high;
            back[column] += r[row] * x.high;
        }
        self.values(b)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(g, &weights) + self.bound(b, &r) + self.bound(fd, &back);
        }
        judged(&sum, fd, b)
    }
}
