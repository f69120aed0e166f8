//! Stage `verify`: functions of one model against each other.
//!
//! In: the derived equations of all functions that were asked for, and a state. Out: which two of them disagree. Each law holds
//! whatever the model: it is a sum over results of one or several functions, with random weights, that is zero. The sums are made
//! in double-double precision from the derived equations; as bound serves the error that one rounding of each of their
//! operations can leave. Slopes of a function are its own, by a reverse sweep, and not those of another function.

use super::programs::WORST;
use super::states::{Random, State, States};
use super::tape::{Op, Tape};
use super::trace::{Slopes, Trace};
use crate::mechanics::structure::{Role, Structure};
use crate::mechanics::symbols::has_quaternion;
use crate::model::types::{Coordinate, Handling, InputId, Model, StateId};
use crate::optimize::program::{FunctionKind, Symbol};
use crate::symbolic::doubled::Doubled;
use crate::symbolic::graph::SymbolId;

/// A sum of numbers with 31 digits that cancel is zero below this share of them.
const EXACT: f64 = 1e-24;

/// What the laws say at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    Hold,
    Broken(FunctionKind, FunctionKind),
    /// Not at this state.
    Unclear,
}

/// The functions of one model.
pub(super) struct Laws<'a> {
    pub model: &'a Model,
    pub structure: &'a Structure,
    pub states: &'a States<'a>,
    pub functions: &'a [(FunctionKind, &'a Tape)],
}

/// A law under way: terms of one sum.
#[derive(Default)]
struct Sum {
    value: Vec<Doubled>,
    bound: f64,
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
        Some(sum <= EXACT * size || sum <= WORST * f64::EPSILON * (self.bound + size))
    }
}

/// One state with what has been evaluated there.
struct At<'a, 's> {
    laws: &'a Laws<'a>,
    state: &'s State,
    traces: Vec<Option<Trace<'a, Doubled>>>,
    random: Random,
    doubtful: bool,
}

impl<'a> Laws<'a> {
    /// All laws that hold between these functions, at one state.
    pub(super) fn judge(&'a self, state: &State) -> Outcome {
        let traces = self.functions.iter().map(|_| None).collect();
        let mut at = At { laws: self, state, traces, random: Random(0x1A35), doubtful: false };
        let mut unclear = false;
        for law in 0..8 {
            let judged = match law {
                0 => at.energy(),
                1 => at.symmetry(),
                2 => at.efforts(),
                3 => at.free_motion(),
                4 => at.slopes_of_functions(),
                5 => at.momenta(),
                6 => at.jumps(),
                _ => at.constraints(),
            };
            match judged {
                Some(Some(_)) if at.doubtful => unclear = true,
                Some(Some((a, b))) => return Outcome::Broken(a, b),
                Some(None) => {}
                None => unclear = true,
            }
        }
        if unclear { Outcome::Unclear } else { Outcome::Hold }
    }
}

type Broken = (FunctionKind, FunctionKind);

/// Nothing where a value is missing at this state; else who disagrees.
type Judged = Option<Option<Broken>>;

fn judged(sum: &Sum, a: FunctionKind, b: FunctionKind) -> Judged {
    sum.holds().map(|holds| (!holds).then_some((a, b)))
}

/// The first that is broken, or unclear.
fn both(a: Judged, b: impl FnOnce() -> Judged) -> Judged {
    match a {
        Some(None) => b(),
        other => other,
    }
}

impl<'a> At<'a, '_> {
    fn has(&self, kind: FunctionKind) -> bool {
        self.laws.functions.iter().any(|function| function.0 == kind)
    }

    fn tape(&self, kind: FunctionKind) -> Option<&'a Tape> {
        self.laws.functions.iter().find(|function| function.0 == kind).map(|function| function.1)
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
        self.doubtful |= trace.kink || trace.unclear;
        Some(trace)
    }

    /// A function as the state is.
    fn trace(&mut self, kind: FunctionKind) -> Option<&Trace<'a, Doubled>> {
        let at = self.laws.functions.iter().position(|function| function.0 == kind)?;
        if self.traces[at].is_none() {
            self.traces[at] = self.with(kind, &[]);
        }
        self.traces[at].as_ref()
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

    fn dof(&self) -> usize {
        self.coordinates().len()
    }

    fn weights(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.random.next()).collect()
    }

    /// Of the state, in its order.
    fn of_state(&self, symbol: fn(Coordinate) -> Symbol) -> Vec<Doubled> {
        let value = |&c: &Coordinate| Doubled::new(self.laws.states.value(self.state, symbol(c)));
        self.coordinates().iter().map(value).collect()
    }

    fn velocities(&self) -> Vec<Doubled> {
        self.of_state(velocity)
    }

    /// Whether velocities of the state are all that moves.
    fn is_scleronomic(&self) -> bool {
        let structure = self.laws.structure;
        let driven = structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)));
        let time = self.laws.states.place(Symbol::Time);
        let reads_time =
            |tape: &Tape| tape.nodes.iter().any(|node| matches!(node.op, Op::Symbol(id) if Some(id.0) == time));
        let kinds = [FunctionKind::MassMatrix, FunctionKind::KineticEnergy, FunctionKind::Momentum];
        !driven && !kinds.iter().filter_map(|&kind| self.tape(kind)).any(reads_time)
    }

    /// Slopes by displacements of the position, in the order of the state.
    fn displacements(&self, slopes: &Slopes) -> Vec<Doubled> {
        let slope = |symbol: Symbol| {
            let at = self.laws.states.place(symbol);
            at.and_then(|at| slopes.symbols.get(at)).copied().unwrap_or(Doubled::ZERO)
        };
        let displacement = |&Coordinate { joint, index }: &Coordinate| {
            let declared = &self.laws.model.joints[joint.0];
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
        let slope = |&c: &Coordinate| {
            let at = self.laws.states.place(symbol(c));
            at.and_then(|at| slopes.symbols.get(at)).copied().unwrap_or(Doubled::ZERO)
        };
        self.coordinates().iter().map(slope).collect()
    }

    /// v M v / 2 is the kinetic energy.
    fn energy(&mut self) -> Judged {
        let (a, b) = (FunctionKind::MassMatrix, FunctionKind::KineticEnergy);
        if !self.has(a) || !self.has(b) || !self.is_scleronomic() {
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

    /// M is symmetric, and no pivot of it is negative.
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
        let mut rest: Vec<f64> = mass.iter().map(|x| x.high).collect();
        for k in 0..n {
            let pivot = rest[k * n + k];
            let size = mass[k * n + k].high;
            if size < 0.0 || pivot < -1e-9 * size {
                return Some(Some((a, a)));
            }
            if pivot <= 1e-12 * size {
                // Without inertia of its own: what is coupled to it says no more.
                return Some(None);
            }
            for i in k + 1..n {
                let factor = rest[i * n + k] / pivot;
                for j in k + 1..n {
                    rest[i * n + j] -= factor * rest[k * n + j];
                }
            }
        }
        Some(None)
    }

    /// Inverse dynamics is M a + bias.
    fn efforts(&mut self) -> Judged {
        let id = FunctionKind::InverseDynamics;
        let (m, b) = (FunctionKind::MassMatrix, FunctionKind::Bias);
        if !self.has(id) || !self.laws.model.solve_for.is_empty() || !(self.has(m) || self.has(b)) {
            return Some(None);
        }
        let n = self.dof();
        let (r, s) = (self.weights(n), self.weights(n));
        let efforts = self.values(id)?;
        let symbols = self.symbols();
        let slopes = self.trace(id)?.slopes::<Doubled>(&r, symbols);
        let inertia = self.by(&slopes, acceleration);
        let mut first = Some(None);
        if self.has(m) {
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
            first = judged(&sum, m, id);
        }
        if !self.has(b) {
            return first;
        }
        both(first, || {
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
        })
    }

    /// The efforts of free motion are those of the multipliers: M a + bias + G^T lambda = 0.
    fn free_motion(&mut self) -> Judged {
        let whole = self.free_motion_by(true);
        both(whole, || self.free_motion_by(false))
    }

    /// In the equations as one residual, or in those without multipliers.
    fn free_motion_by(&mut self, whole: bool) -> Judged {
        let fd = FunctionKind::ForwardDynamics;
        let (id, m, b) = (FunctionKind::InverseDynamics, FunctionKind::MassMatrix, FunctionKind::Bias);
        let inverse = !whole && self.has(id) && self.laws.model.solve_for.is_empty();
        let others = if whole { self.has(FunctionKind::Residual) } else { inverse || (self.has(m) && self.has(b)) };
        if !self.has(fd) || !others {
            return Some(None);
        }
        let (n, rows) = (self.dof(), self.laws.structure.rows.len());
        let found = self.values(fd)?;
        let accelerations = found.get(..n)?.to_vec();
        let states = self.laws.model.states.len();
        let multipliers = if rows == 0 { Vec::new() } else { found.get(n + states..n + states + rows)?.to_vec() };
        let r = self.weights(n);
        let mut changed: Vec<(Symbol, Doubled)> = Vec::new();
        changed.extend(self.coordinates().iter().zip(&accelerations).map(|(&c, &a)| (acceleration(c), a)));
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
                let slope = place.and_then(|at| slopes.symbols.get(at)).map_or(0.0, |x| x.high);
                back[n + states + row] = slope;
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
                back[n + states + row] += x.high * r[column];
            }
            sum.bound += self.bound(g, &weights);
        }
        sum.bound += self.bound(fd, &back);
        judged(&sum, fd, other)
    }

    /// Derivatives are the slopes of what they are derivatives of.
    fn slopes_of_functions(&mut self) -> Judged {
        let pairs = [
            (FunctionKind::ForwardDerivatives, FunctionKind::ForwardDynamics),
            (FunctionKind::InverseDerivatives, FunctionKind::InverseDynamics),
        ];
        let mut first = Some(None);
        for (derivative, function) in pairs {
            let inverse = function == FunctionKind::InverseDynamics;
            if !self.has(derivative) || !self.has(function) || (inverse && !self.laws.model.solve_for.is_empty()) {
                continue;
            }
            first = both(first, || self.derivative(derivative, function, !inverse));
        }
        first
    }

    fn derivative(&mut self, derivative: FunctionKind, function: FunctionKind, with_states: bool) -> Judged {
        let (n, model) = (self.dof(), self.laws.model);
        let states = model.states.len();
        let rows = n + if with_states { states } else { 0 };
        let mut r = self.weights(rows);
        let count = self.values(function)?.len();
        let rows_weights = r.clone();
        r.resize(count, 0.0);
        let symbols = self.symbols();
        let slopes = self.trace(function)?.slopes::<Doubled>(&r, symbols);
        let (positions, velocities) = (self.displacements(&slopes), self.by(&slopes, velocity));
        let other = |symbol: Symbol| {
            let at = self.laws.states.place(symbol);
            at.and_then(|at| slopes.symbols.get(at)).copied().unwrap_or(Doubled::ZERO)
        };
        let own = (0..states).map(|k| other(Symbol::State { state: StateId(k) })).collect();
        let inputs = model.inputs.iter().enumerate().flat_map(|(k, input)| {
            let input_id = InputId(k);
            (0..input.ty.scalars()).map(move |element| Symbol::Input { input: input_id, element })
        });
        let inputs: Vec<Doubled> = inputs.map(other).collect();
        let blocks: [Vec<Doubled>; 4] = [positions, velocities, own, inputs];
        let given = self.values(derivative)?;
        let mut weights = vec![0.0; given.len()];
        let (mut sum, mut first) = (Sum::default(), 0);
        for block in &blocks {
            let s = self.weights(block.len());
            block.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
            for (i, &r) in rows_weights.iter().enumerate() {
                for (j, &s) in s.iter().enumerate() {
                    let at = first + i * block.len() + j;
                    sum.product(&[*given.get(at)?, Doubled::new(r), Doubled::new(s)]);
                    weights[at] = r * s;
                }
            }
            first += rows * block.len();
        }
        if sum.holds() != Some(true) {
            // A reverse sweep rounds as often as there are operations, and each may count as much as the function itself.
            sum.bound = self.bound(derivative, &weights) + slopes.bound;
        }
        judged(&sum, derivative, function)
    }

    /// p = M v, v p = 2 T, and what velocities a momentum gives back.
    fn momenta(&mut self) -> Judged {
        let p = FunctionKind::Momentum;
        if !self.has(p) || !self.is_scleronomic() {
            return Some(None);
        }
        let (n, v) = (self.dof(), self.velocities());
        let momenta = self.values(p)?;
        let (m, t) = (FunctionKind::MassMatrix, FunctionKind::KineticEnergy);
        let mut first = Some(None);
        let r = self.weights(n);
        if self.has(m) {
            let mass = self.values(m)?;
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
            first = judged(&sum, m, p);
        }
        if self.has(t) {
            first = both(first, || {
                let energy = self.values(t)?;
                let mut sum = Sum::default();
                momenta.iter().zip(&v).for_each(|(&x, &v)| sum.product(&[x, v]));
                energy.iter().for_each(|&x| sum.product(&[-x, Doubled::new(2.0)]));
                if sum.holds() != Some(true) {
                    let weights: Vec<f64> = v.iter().map(|x| x.high).collect();
                    sum.bound = self.bound(p, &weights) + self.bound(t, &[2.0]);
                }
                judged(&sum, t, p)
            });
        }
        let back = FunctionKind::MomentumVelocity;
        if self.has(back) && self.laws.structure.rows.is_empty() {
            first = both(first, || {
                let coordinates = self.coordinates().iter();
                let changed: Vec<(Symbol, Doubled)> =
                    coordinates.zip(&momenta).map(|(&c, &x)| (momentum(c), x)).collect();
                let trace = self.with(back, &changed)?;
                let symbols = self.symbols();
                let slopes = trace.slopes::<f64>(&r, symbols);
                let mut sum = Sum::default();
                trace.roots().iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
                v.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
                let weights: Vec<f64> = self.by(&slopes, momentum).iter().map(|x| x.high).collect();
                sum.bound = slopes.bound + self.bound(p, &weights);
                judged(&sum, back, p)
            });
        }
        first
    }

    /// M times a jump of velocities is the impulse.
    fn jumps(&mut self) -> Judged {
        let (jump, m) = (FunctionKind::Impulse, FunctionKind::MassMatrix);
        if !self.has(jump) || !self.has(m) || !self.laws.structure.rows.is_empty() {
            return Some(None);
        }
        let n = self.dof();
        let (jumps, mass, r) = (self.values(jump)?, self.values(m)?, self.weights(n));
        let impulses = self.of_state(|c| Symbol::Impulse { joint: c.joint, component: c.index });
        let mut sum = Sum::default();
        let (mut weights, mut back) = (vec![0.0; n * n], vec![0.0; n]);
        for (at, &x) in mass.iter().enumerate() {
            sum.product(&[x, Doubled::new(r[at / n]), *jumps.get(at % n)?]);
            weights[at] = r[at / n] * jumps[at % n].high;
            back[at % n] += r[at / n] * x.high;
        }
        impulses.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[-x, Doubled::new(r)]));
        sum.bound = self.bound(m, &weights) + self.bound(jump, &back);
        judged(&sum, jump, m)
    }

    /// The Jacobian of the constraints, their rates, and what is left of their second derivatives.
    fn constraints(&mut self) -> Judged {
        let rows = self.laws.structure.rows.len();
        let (phi, g) = (FunctionKind::Constraints, FunctionKind::ConstraintJacobian);
        let (rate, bias) = (FunctionKind::ConstraintRate, FunctionKind::ConstraintBias);
        if rows == 0 || ![phi, g, rate, bias].iter().all(|&kind| self.has(kind)) {
            return Some(None);
        }
        let (n, r, symbols) = (self.dof(), self.weights(rows), self.symbols());
        let (s, v) = (self.weights(n), self.velocities());
        let time = self.laws.states.place(Symbol::Time);
        let by_time = |slopes: &Slopes| time.and_then(|at| slopes.symbols.get(at)).copied().unwrap_or(Doubled::ZERO);
        let slopes = self.trace(phi)?.slopes::<Doubled>(&r, symbols);
        let columns = self.displacements(&slopes);
        let jacobian = self.values(g)?;
        let mut sum = Sum::default();
        let mut weights = vec![0.0; jacobian.len()];
        for (at, &x) in jacobian.iter().enumerate() {
            sum.product(&[x, Doubled::new(*r.get(at / n)?), Doubled::new(s[at % n])]);
            weights[at] = r[at / n] * s[at % n];
        }
        columns.iter().zip(&s).for_each(|(&x, &s)| sum.product(&[-x, Doubled::new(s)]));
        if sum.holds() != Some(true) {
            sum.bound = self.bound(g, &weights) + slopes.bound;
        }
        let first = judged(&sum, g, phi);
        let first = both(first, || {
            let mut sum = Sum::default();
            self.values(rate)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            columns.iter().zip(&v).for_each(|(&x, &v)| sum.product(&[-x, v]));
            sum.add(-by_time(&slopes));
            if sum.holds() != Some(true) {
                sum.bound = self.bound(rate, &r) + slopes.bound;
            }
            judged(&sum, rate, phi)
        });
        if matches!(self.laws.model.handling, Handling::Stabilised { .. }) {
            // Stabilising terms are in it too.
            return first;
        }
        both(first, || {
            let slopes = self.trace(rate)?.slopes::<Doubled>(&r, symbols);
            let columns = self.displacements(&slopes);
            let mut sum = Sum::default();
            self.values(bias)?.iter().zip(&r).for_each(|(&x, &r)| sum.product(&[x, Doubled::new(r)]));
            columns.iter().zip(&v).for_each(|(&x, &v)| sum.product(&[-x, v]));
            sum.add(-by_time(&slopes));
            if sum.holds() != Some(true) {
                sum.bound = self.bound(bias, &r) + slopes.bound;
            }
            judged(&sum, bias, rate)
        })
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
