//! Stage `verify`: momenta, their rates, and jumps of velocities.

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Slot;
use crate::contracts::symbol::Symbol;
use crate::symbolic::doubled::Doubled;

use super::{At, Judged, Law, Sum, judged, momentum, velocity};

pub(super) const LAWS: &[Law] = &[
    Law { between: "momenta and the mass matrix", judge: |at| at.momenta() },
    Law { between: "momenta and kinetic energy", judge: |at| at.vis_viva() },
    Law { between: "momenta and velocities from momenta", judge: |at| at.momenta_back() },
    Law { between: "the rates of momenta and momenta", judge: |at| at.momentum_rates() },
    Law { between: "the centroidal momentum matrix and momenta", judge: |at| at.centroidal_momenta() },
    Law { between: "the impulse and the mass matrix", judge: |at| at.jumps() },
    Law { between: "the impulse and the constraints", judge: |at| at.jumps_of_rows() },
    Law { between: "the least displacement and the constraints", judge: |at| at.displacement_of_rows() },
];

impl At<'_, '_> {
    /// p = M v.
    fn momenta(&mut self) -> Judged {
        let (p, m) = (FunctionKind::Momentum, FunctionKind::MassMatrix);
        if !self.has(p) || !self.has(m) || !self.is_scleronomic(&[p, m]) {
            return Some(None);
        }
        let (n, v) = (self.dof(), self.velocities());
        let (momenta, mass, r) = (self.values(p)?, self.values(m)?, self.weights(n));
        let mut sum = Sum::default();
        let mut weights = vec![0.0; n * n];
        for (at, &x) in mass.iter().enumerate() {
            sum.product(&[x, Doubled::new(r[at / n]), v[at % n]]);
            weights[at] = r[at / n] * v[at % n].high;
        }
        momenta.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(m, &weights) + self.bound(p, &r);
        }
        judged(&sum, m, p)
    }

    /// v p = 2 T.
    fn vis_viva(&mut self) -> Judged {
        let (p, t) = (FunctionKind::Momentum, FunctionKind::KineticEnergy);
        if !self.has(p) || !self.has(t) || !self.is_scleronomic(&[p, t]) {
            return Some(None);
        }
        let (momenta, energy, v) = (self.values(p)?, self.values(t)?, self.velocities());
        let mut sum = Sum::default();
        momenta.iter().zip(&v).for_each(|(&x, &v)| sum.product(&[x, v]));
        energy.iter().for_each(|&x| sum.product(&[-x, Doubled::new(2.0)]));
        if sum.holds() != Some(true) {
            let weights: Vec<f64> = v.iter().map(|x| x.high).collect();
            sum.bound = self.bound(p, &weights) + self.bound(t, &[2.0]);
        }
        judged(&sum, t, p)
    }

    /// What velocities a momentum gives back.
    fn momenta_back(&mut self) -> Judged {
        let (p, back) = (FunctionKind::Momentum, FunctionKind::MomentumVelocity);
        if !self.has(p) || !self.has(back) || !self.laws.structure.rows.is_empty() || !self.is_scleronomic(&[p]) {
            return Some(None);
        }
        let (momenta, v) = (self.values(p)?, self.velocities());
        let r = self.weights(v.len());
        let coordinates = self.coordinates().iter();
        let changed: Vec<(Symbol, Doubled)> = coordinates.zip(&momenta).map(|(&c, &x)| (momentum(c), x)).collect();
        let trace = self.with(back, &changed)?;
        let symbols = self.symbols();
        let slopes = trace.slopes::<f64>(&r, symbols);
        let mut sum = Sum::default();
        trace.roots().iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        v.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        let weights: Vec<f64> = self.by(&slopes, momentum).iter().map(|x| x.high).collect();
        sum.bound = slopes.bound + self.bound(p, &weights);
        judged(&sum, back, p)
    }

    /// p' = dp/dq v + M a in free motion, where M a is minus the bias.
    fn momentum_rates(&mut self) -> Judged {
        let (p, rate) = (FunctionKind::Momentum, FunctionKind::MomentumRate);
        let (fd, b) = (FunctionKind::ForwardDynamics, FunctionKind::Bias);
        let free = if self.has(fd) { fd } else { b };
        let all = [p, rate, free].iter().all(|&kind| self.has(kind));
        if !all || !self.laws.structure.rows.is_empty() || !self.is_scleronomic(&[p]) {
            return Some(None);
        }
        let (n, v, symbols) = (self.dof(), self.velocities(), self.symbols());
        let r = self.weights(n);
        let slopes = self.trace(p)?.slopes::<Doubled>(&r, symbols);
        let mut sum = Sum::default();
        self.values(rate)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
        self.displacements(&slopes).iter().zip(&v).for_each(|(&x, &v)| sum.product(&[-x, v]));
        let found = self.values(free)?;
        let mut weights = vec![0.0; found.len()];
        if free == fd {
            let inertia = self.by(&slopes, velocity);
            inertia.iter().zip(&found).for_each(|(&x, &a)| sum.product(&[-x, a]));
            inertia.iter().zip(&mut weights).for_each(|(x, weight)| *weight = x.high);
        } else {
            found.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            weights.clone_from(&r);
        }
        if sum.holds() != Some(true) {
            sum.bound = slopes.bound + self.bound(rate, &r) + self.bound(free, &weights);
        }
        judged(&sum, rate, p)
    }

    /// The centroidal momentum matrix holds the slopes of the momenta by velocities.
    fn centroidal_momenta(&mut self) -> Judged {
        let (a, h) = (FunctionKind::CentroidalMomentumMatrix, FunctionKind::CentroidalMomentum);
        if !self.has(a) || !self.has(h) {
            return Some(None);
        }
        let (n, symbols) = (self.dof(), self.symbols());
        let (r, by) = (self.weights(6), self.weights(n));
        let slopes = self.trace(h)?.slopes::<Doubled>(&r, symbols);
        let (mut sum, mut weights) = (Sum::default(), vec![0.0; 6 * n]);
        self.by(&slopes, velocity).iter().zip(&by).for_each(|(&x, &by)| sum.product(&[x, Doubled::new(by)]));
        for (at, &x) in self.values(a)?.iter().enumerate() {
            weights[at] = -r[at / n] * by[at % n];
            sum.product(&[-x, Doubled::new(r[at / n]), Doubled::new(by[at % n])]);
        }
        if sum.holds() != Some(true) {
            sum.bound = slopes.bound + self.bound(a, &weights);
        }
        judged(&sum, a, h)
    }

    /// M times a jump of velocities is the impulse, but for those of the constraints: M d + G^T mu = impulse.
    fn jumps(&mut self) -> Judged {
        let (jump, m, g) = (FunctionKind::Impulse, FunctionKind::MassMatrix, FunctionKind::ConstraintJacobian);
        let rows = self.laws.structure.rows.len();
        if !self.has(jump) || !self.has(m) || (rows > 0 && !self.has(g)) {
            return Some(None);
        }
        let n = self.dof();
        let (jumps, mass, r) = (self.values(jump)?, self.values(m)?, self.weights(n));
        let impulses = self.of_state(|c| Symbol::Impulse { joint: c.joint, component: c.index });
        let mut sum = Sum::default();
        let (mut weights, mut back) = (vec![0.0; n * n], vec![0.0; jumps.len()]);
        for (at, &x) in mass.iter().enumerate() {
            sum.product(&[x, Doubled::new(r[at / n]), jumps[at % n]]);
            weights[at] = r[at / n] * jumps[at % n].high;
            back[at % n] += r[at / n] * x.high;
        }
        if rows > 0 {
            let jacobian = self.values(g)?;
            let held = self.place(jump, Slot::Multipliers);
            let mut weights = vec![0.0; jacobian.len()];
            for (at, &x) in jacobian.iter().enumerate() {
                let (row, column) = (held.start + at / n, at % n);
                sum.product(&[x, jumps[row], Doubled::new(r[column])]);
                weights[at] = jumps[row].high * r[column];
                back[row] += x.high * r[column];
            }
            sum.bound += self.bound(g, &weights);
        }
        impulses.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        sum.bound += self.bound(m, &weights) + self.bound(jump, &back);
        judged(&sum, jump, m)
    }

    /// The least displacement does what the constraints ask for, where no equation follows from others.
    fn displacement_of_rows(&mut self) -> Judged {
        self.moves_rows(FunctionKind::Displacement)
    }

    /// A jump changes the rates of the constraints as it was asked to, where no equation follows from others.
    fn jumps_of_rows(&mut self) -> Judged {
        self.moves_rows(FunctionKind::Impulse)
    }

    fn moves_rows(&mut self, jump: FunctionKind) -> Judged {
        let g = FunctionKind::ConstraintJacobian;
        let rows = self.laws.structure.rows.len();
        if rows == 0 || !self.has(jump) || !self.has(g) {
            return Some(None);
        }
        let (n, r, jumps) = (self.dof(), self.weights(rows), self.values(jump)?);
        let rank = match jump {
            FunctionKind::Displacement => jumps.get(n).map_or(0.0, |rank| rank.high),
            _ => self.rank(jump)?,
        };
        if rank < rows as f64 {
            return self.deficient();
        }
        let (mut sum, mut weights, mut back) = (Sum::default(), vec![0.0; rows * n], vec![0.0; jumps.len()]);
        for (at, &x) in self.values(g)?.iter().enumerate() {
            let (row, column) = (at / n, at % n);
            sum.product(&[x, Doubled::new(r[row]), jumps[column]]);
            weights[at] = r[row] * jumps[column].high;
            back[column] += r[row] * x.high;
        }
        for (row, &r) in r.iter().enumerate() {
            let rate = self.laws.states.value(self.state, Symbol::Rate { row });
            sum.product(&[Doubled::new(-rate), Doubled::new(r)]);
        }
        if sum.holds() != Some(true) {
            sum.bound = self.bound(g, &weights) + self.bound(jump, &back);
        }
        judged(&sum, jump, g)
    }
}
