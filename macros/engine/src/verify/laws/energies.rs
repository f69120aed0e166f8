//! Stage `verify`: energies and the mass matrix.

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Slot;
use crate::contracts::symbol::Symbol;
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::types::{Coordinate, InputId, StateId};
use crate::optimize::program::Doubt;
use crate::symbolic::doubled::Doubled;
use crate::verify::trace::Slopes;

use super::{At, EXACT, Judged, Law, Sum, acceleration, forces, judged, velocity};

/// What is left of closed loops.
const CLOSED: f64 = 1e-9;

/// What is left of an equation that follows from others.
const DEPENDENT: f64 = 1e-9;

pub(super) const LAWS: &[Law] = &[
    Law { between: "the mass matrix and kinetic energy", judge: |at| at.energy() },
    Law { between: "the lower triangle of the mass matrix and kinetic energy", judge: |at| at.energy_by_triangle() },
    Law { between: "the mass matrix and its lower triangle", judge: |at| at.triangle() },
    Law { between: "the mass matrix and its transpose", judge: |at| at.symmetry() },
    Law { between: "the mass matrix and energies that are positive", judge: |at| at.pivots() },
    Law { between: "energies and the equations of motion", judge: |at| at.lagrange() },
];

impl At<'_, '_> {
    /// v M v / 2 is the kinetic energy.
    fn energy(&mut self) -> Judged {
        let (a, b) = (FunctionKind::MassMatrix, FunctionKind::KineticEnergy);
        if !self.has(a) || !self.has(b) || !self.is_scleronomic(&[a, b]) {
            return Some(None);
        }
        let (mass, energy, v) = (self.values(a)?, self.values(b)?, self.velocities());
        let n = v.len();
        let mut sum = Sum::default();
        let mut weights = vec![0.0; n * n];
        for (at, &m) in mass.iter().enumerate() {
            sum.product(&[m, v[at / n], v[at % n], Doubled::new(0.5)]);
            weights[at] = 0.5 * v[at / n].high * v[at % n].high;
        }
        energy.iter().for_each(|&x| sum.add(-x));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(a, &weights) + self.bound(b, &[1.0]);
        }
        judged(&sum, a, b)
    }

    /// The same, with twice what is below the diagonal.
    fn energy_by_triangle(&mut self) -> Judged {
        let (a, b) = (FunctionKind::MassMatrixLower, FunctionKind::KineticEnergy);
        if !self.has(a) || !self.has(b) || !self.is_scleronomic(&[a, b]) {
            return Some(None);
        }
        let (lower, energy, v) = (self.values(a)?, self.values(b)?, self.velocities());
        let places = (0..v.len()).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let (mut sum, mut weights) = (Sum::default(), Vec::new());
        for ((i, j), &m) in places.zip(&lower) {
            let times = if i == j { 0.5 } else { 1.0 };
            sum.product(&[m, v[i], v[j], Doubled::new(times)]);
            weights.push(times * v[i].high * v[j].high);
        }
        energy.iter().for_each(|&x| sum.add(-x));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(a, &weights) + self.bound(b, &[1.0]);
        }
        judged(&sum, a, b)
    }

    /// Entry by entry, by weights that are random.
    fn triangle(&mut self) -> Judged {
        let (a, b) = (FunctionKind::MassMatrixLower, FunctionKind::MassMatrix);
        if !self.has(a) || !self.has(b) {
            return Some(None);
        }
        let (lower, mass, n) = (self.values(a)?, self.values(b)?, self.dof());
        let of_lower = self.weights(lower.len());
        let mut of_mass = vec![0.0; n * n];
        let places = (0..n).flat_map(|row| (0..=row).map(move |column| row * n + column));
        let mut sum = Sum::default();
        for ((at, &x), &weight) in places.zip(&lower).zip(&of_lower) {
            sum.product(&[x, Doubled::new(weight)]);
            sum.product(&[-mass[at], Doubled::new(weight)]);
            of_mass[at] = weight;
        }
        if sum.holds() != Some(true) {
            sum.bound = self.bound(a, &of_lower) + self.bound(b, &of_mass);
        }
        judged(&sum, a, b)
    }

    fn symmetry(&mut self) -> Judged {
        let a = FunctionKind::MassMatrix;
        if !self.has(a) {
            return Some(None);
        }
        let (mass, n) = (self.values(a)?, self.dof());
        if !mass.iter().all(|x| x.is_finite()) {
            return None;
        }
        for i in 0..n {
            for j in 0..i {
                let (x, y) = (mass[i * n + j].high, mass[j * n + i].high);
                let size = (mass[i * n + i].high * mass[j * n + j].high).abs().sqrt();
                if (x - y).abs() > 1e-10 * (size + x.abs()) {
                    return Some(Some((a, a)));
                }
            }
        }
        Some(None)
    }

    /// No pivot of M is negative. Other parameters than the defaults may be those of no body.
    fn pivots(&mut self) -> Judged {
        let a = FunctionKind::MassMatrix;
        if !self.has(a) {
            return Some(None);
        }
        let (mass, n) = (self.values(a)?, self.dof());
        if !self.state.defaults || !mass.iter().all(|x| x.is_finite()) {
            return None;
        }
        // In 31 digits: behind a pivot that is rounding alone, such as a thin rod's about its own axis, stands anything.
        let mut rest = mass.clone();
        let rounding = 1e-24 * mass.iter().fold(0.0_f64, |most, x| most.max(x.high.abs()));
        for k in 0..n {
            let pivot = rest[k * n + k];
            let size = mass[k * n + k].high;
            if size < -rounding || pivot.high < -1e-9 * size - rounding {
                return Some(Some((a, a)));
            }
            if pivot.high <= 1e-12 * size + rounding {
                // Without inertia of its own: what is coupled to it says no more.
                return Some(None);
            }
            for i in k + 1..n {
                let factor = rest[i * n + k] / pivot;
                for j in k + 1..n {
                    rest[i * n + j] = rest[i * n + j] - factor * rest[k * n + j];
                }
            }
        }
        Some(None)
    }

    /// By how much equations are not met, in what counts as one; nothing where loops are open.
    fn gap(&mut self) -> Option<f64> {
        let structure = self.laws.structure;
        let residuals = self.values(FunctionKind::Constraints)?;
        let gaps = structure.rows.iter().zip(&residuals).map(|(&row, x)| x.high.abs() / structure.scale(row));
        let gap = gaps.fold(0.0_f64, |most, x| if x > most || x.is_nan() { x } else { most });
        if gap < CLOSED {
            return Some(gap + f64::EPSILON);
        }
        self.doubt = self.doubt.or(Some(Doubt::Open));
        None
    }

    /// What of velocities keeps the equations.
    fn closed_velocities(&mut self, v: Vec<Doubled>) -> Option<Vec<Doubled>> {
        let jacobian = self.values(FunctionKind::ConstraintJacobian)?;
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let mut v: Vec<f64> = v.iter().map(|x| x.high).collect();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let take = |from: &mut Vec<f64>, basis: &[Vec<f64>]| {
            // Twice, for the digits that the first time has lost.
            for unit in basis.iter().chain(basis) {
                let along = dot(unit, from);
                from.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
            }
        };
        for row in jacobian.chunks(v.len().max(1)) {
            let mut row: Vec<f64> = row.iter().map(|x| x.high).collect();
            let size = dot(&row, &row).sqrt();
            take(&mut row, &basis);
            let left = dot(&row, &row).sqrt();
            if left > DEPENDENT * size {
                row.iter_mut().for_each(|x| *x /= left);
                basis.push(row);
            }
        }
        take(&mut v, &basis);
        Some(v.into_iter().map(Doubled::new).collect())
    }

    /// Lagrange's equations, which say of r = v that the rate of both energies is the power of all else:
    /// r M a + d(r p)/dq v - dT/dq r + r (w x p) + dU/dq r is the work of all other forces along r. With r at random they are all of
    /// the equations of motion, from energies that share nothing with the recursions of the dynamics. Since T is v M v / 2, r p is
    /// (T(v + r) - T(v - r)) / 2. Velocities w that are no rates of coordinates, those of quaternions, have r (w x p) beside it
    /// (Hamel). Forces that vanish at rest without inputs and are linear in velocities are opposite in opposite motions, so
    /// half the sum over both leaves inertia, weight and springs. Where rates follow from velocities by own states x, a wheel that is steered,
    /// the energy changes by dT/dx x' too, of which the part is left that changes its sign with the motion.
    fn lagrange(&mut self) -> Judged {
        let (t, u) = (FunctionKind::KineticEnergy, FunctionKind::PotentialEnergy);
        let (fd, id, b) = (FunctionKind::ForwardDynamics, FunctionKind::InverseDynamics, FunctionKind::Bias);
        let g = FunctionKind::ConstraintJacobian;
        let rows = self.laws.structure.rows.len();
        let inverse = self.has(id) && self.laws.model.solve_for.is_empty();
        let kind = match () {
            () if self.has(fd) && (rows == 0 || self.has(g)) => fd,
            () if inverse => id,
            () if self.has(b) => b,
            () => return Some(None),
        };
        let speeds = self.laws.structure.has_speeds();
        let all = self.has(t) && self.has(u) && self.is_scleronomic(&[t, u, kind, g, FunctionKind::PositionRates]);
        if !all || !self.is_moved() || !forces::are_balanced(self.laws.model) {
            return Some(None);
        }
        let model = self.laws.model;
        // Springs on joints that close loops follow coordinates that are measured, which are those of the forces where loops are
        // closed, and stay so.
        let measured = rows > 0 && forces::on_closed_joints(model);
        let mut v = self.velocities();
        let mut r: Vec<Doubled> = self.weights(v.len()).into_iter().map(Doubled::new).collect();
        let mut open = 0.0;
        if measured {
            if !self.has(g) || !self.has(FunctionKind::Constraints) {
                return Some(None);
            }
            open = self.gap()?;
        }
        // Where what moves has no inertia of its own, a thin rod in absolute coordinates, multipliers are determined along motions
        // that keep the equations only.
        let held = rows > 0 && kind == fd;
        if measured || held {
            v = self.closed_velocities(v)?;
        }
        // What is measured is no function of coordinates where loops are open: of that the power is all that is known.
        let mut rotors = model.cuts.iter().filter(|&&joint| model.joints[joint].armature.is_some());
        // Of velocities that are no rates of positions the power is known: other equations have terms of how their directions turn.
        if speeds || measured || held || (rows > 0 && rotors.next().is_some()) {
            r.clone_from(&v);
        }
        let inputs = model.inputs.iter().enumerate().flat_map(|(k, input)| {
            (0..input.ty.scalars()).map(move |element| (Symbol::Input { input: InputId(k), element }, Doubled::ZERO))
        });
        let inputs: Vec<(Symbol, Doubled)> = inputs.collect();
        let coordinates = self.speeds();
        let moving = |velocities: &[Doubled]| {
            let velocities = coordinates.iter().zip(velocities).map(|(&c, &v)| (velocity(c), v));
            inputs.iter().copied().chain(velocities).collect::<Vec<(Symbol, Doubled)>>()
        };
        let sums: Vec<Doubled> = v.iter().zip(&r).map(|(&v, &r)| v + r).collect();
        let differences: Vec<Doubled> = v.iter().zip(&r).map(|(&v, &r)| v - r).collect();
        let opposite: Vec<Doubled> = v.iter().map(|&v| -v).collect();
        let (along, way) = if speeds {
            let rates = FunctionKind::PositionRates;
            let [one, other] = [&v, &opposite].map(|v| Some(self.with(rates, &moving(v))?.roots()));
            let (one, other) = (one?, other?);
            // What moves by itself takes power.
            if one.iter().zip(&other).any(|(&x, &y)| (x + y).high.abs() > EXACT * (x.high.abs() + y.high.abs())) {
                return Some(None);
            }
            (one.clone(), one)
        } else {
            (v.clone(), r.clone())
        };
        let symbols = self.symbols();
        let kinetic = self.with(t, &moving(&v))?.slopes::<Doubled>(&[1.0], symbols);
        let faster = self.with(t, &moving(&sums))?.slopes::<Doubled>(&[1.0], symbols);
        let slower = self.with(t, &moving(&differences))?.slopes::<Doubled>(&[1.0], symbols);
        let potential = self.with(u, &moving(&v))?.slopes::<Doubled>(&[1.0], symbols);
        let (one, other) = (self.with(kind, &moving(&v))?, self.with(kind, &moving(&opposite))?);
        let half = Doubled::new(0.5);
        let steering = self.steering(&kinetic)?;
        if steering.iter().any(|&(state, _)| kind != fd || self.laws.states.is_inertial(StateId(state))) {
            return Some(None);
        }
        let own = self.place(fd, Slot::States);
        let mean: Vec<Doubled> = one.roots().iter().zip(other.roots()).map(|(&x, y)| (x + y) * half).collect();
        let mut sum = Sum::default();
        self.displacements(&faster).iter().zip(&along).for_each(|(&x, &v)| sum.product(&[x, v, half]));
        self.displacements(&slower).iter().zip(&along).for_each(|(&x, &v)| sum.product(&[-x, v, half]));
        self.displacements(&kinetic).iter().zip(&way).for_each(|(&x, &r)| sum.product(&[-x, r]));
        self.displacements(&potential).iter().zip(&way).for_each(|(&x, &r)| sum.product(&[x, r]));
        if !speeds {
            self.turning(&self.by(&kinetic, velocity), &v, &r, &mut sum);
        }
        let inertia = self.by(&faster, velocity).into_iter().zip(self.by(&slower, velocity));
        let inertia: Vec<Doubled> = inertia.map(|(x, y)| (x - y) * half).collect();
        let mut weights = vec![0.0; mean.len()];
        if kind == fd {
            inertia.iter().zip(&mean).for_each(|(&x, &a)| sum.product(&[x, a]));
            inertia.iter().zip(&mut weights).for_each(|(x, weight)| *weight = x.high);
            for &(state, slope) in &steering {
                let [one, other] = [&one, &other].map(|trace| trace.roots()[own.start + state]);
                sum.product(&[slope, one, half]);
                sum.product(&[-slope, other, half]);
                weights[own.start + state] += 0.5 * slope.high.abs();
            }
            if rows > 0 {
                let (n, held) = (v.len(), self.place(fd, Slot::Multipliers));
                let jacobian = self.with(g, &inputs)?.roots();
                for (at, &x) in jacobian.iter().enumerate() {
                    let (row, column) = (held.start + at / n, at % n);
                    sum.product(&[x, mean[row], r[column]]);
                    weights[row] += x.high * r[column].high;
                }
            }
        } else {
            if kind == id {
                let accelerations = self.of_state(acceleration);
                inertia.iter().zip(&accelerations).for_each(|(&x, &a)| sum.product(&[x, a]));
            }
            mean.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, r]));
            r.iter().zip(&mut weights).for_each(|(r, weight)| *weight = r.high);
        }
        if sum.holds() != Some(true) {
            sum.open = open;
            sum.bound = kinetic.bound + faster.bound + slower.bound + potential.bound;
            sum.bound += one.slopes::<f64>(&weights, 0).bound + other.slopes::<f64>(&weights, 0).bound;
        }
        let found = judged(&sum, if kind == fd { u } else { t }, kind);
        // What has no inertia is held by equations of its own, which are no forces: where loops are open nothing follows from that.
        if held && matches!(found, Some(Some(_))) && self.has_idle_motions(v.len(), &inputs)? {
            return Some(None);
        }
        found
    }

    /// Own states by which rates follow from velocities, with their slopes of a kinetic energy: those of masses are no power.
    fn steering(&mut self, kinetic: &Slopes) -> Option<Vec<(usize, Doubled)>> {
        if !self.laws.structure.has_speeds() || self.laws.model.states.is_empty() {
            return Some(Vec::new());
        }
        let weights = self.weights(self.coordinates().len());
        let symbols = self.symbols();
        let moved = self.trace(FunctionKind::PositionRates)?.slopes::<f64>(&weights, symbols);
        let of = |slopes: &Slopes, state: usize| self.slope(slopes, Symbol::State { state: StateId(state) });
        let states = (0..self.laws.model.states.len()).filter(|&state| of(&moved, state).high != 0.0);
        Some(states.map(|state| (state, of(kinetic, state))).collect())
    }

    /// Whether some motion has no kinetic energy: a pivot of the mass matrix, which is made of the gradients of that energy, is
    /// rounding.
    fn has_idle_motions(&mut self, n: usize, still: &[(Symbol, Doubled)]) -> Option<bool> {
        let coordinates = self.speeds();
        let mut rest: Vec<Vec<Doubled>> = Vec::with_capacity(n);
        for k in 0..n {
            let along = coordinates
                .iter()
                .enumerate()
                .map(|(at, &c)| (velocity(c), if at == k { Doubled::new(1.0) } else { Doubled::ZERO }));
            let symbols = self.symbols();
            let all: Vec<(Symbol, Doubled)> = still.iter().copied().chain(along).collect();
            let slopes = self.with(FunctionKind::KineticEnergy, &all)?.slopes::<Doubled>(&[1.0], symbols);
            rest.push(self.by(&slopes, velocity));
        }
        for k in 0..n {
            let size = rest[k][k].high;
            let pivot = (0..k).fold(rest[k][k], |pivot, j| pivot - rest[k][j] * rest[j][k]);
            if pivot.high <= 1e-9 * size {
                return Some(true);
            }
            for i in k + 1..n {
                for j in 0..k {
                    let (left, right) = (rest[i][j], rest[j][k]);
                    rest[i][k] = rest[i][k] - left * right;
                    let (left, right) = (rest[k][j], rest[j][i]);
                    rest[k][i] = rest[k][i] - left * right;
                }
                rest[i][k] = rest[i][k] / pivot;
            }
        }
        Some(false)
    }

    /// r (w x p) of every orientation that is a quaternion.
    fn turning(&self, p: &[Doubled], v: &[Doubled], r: &[Doubled], sum: &mut Sum) {
        for (at, &Coordinate { joint, index }) in self.coordinates().iter().enumerate() {
            let declared = &self.laws.model.joints[joint];
            // The state has all coordinates of a quaternion, one behind the other.
            if !has_quaternion(declared) || index + 3 != declared.kind.freedoms() {
                continue;
            }
            for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(|axes| axes.map(|axis| at + axis)) {
                sum.product(&[r[i], v[j], p[k]]);
                sum.product(&[-r[i], v[k], p[j]]);
            }
        }
    }
}
