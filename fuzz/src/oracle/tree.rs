//! Open chains and trees: all functions against the plain recursion, and against each other.

use multibody_engine::contracts::function::FunctionKind;
use nalgebra::{DMatrix, DVector};

use super::{At, Findings, Verdict};
use crate::algebra::{V3, norm};
use crate::mechanism::expression::Point;
use crate::mechanism::{FLOW, Mechanism};
use crate::plain::{Plain, displaced, split};
use crate::programs::{Programs, Way};
use crate::random::Random;

/// Relative to the sizes that sums are made of.
const TOLERANCE: f64 = 1e-9;

/// Compiles it and looks at it at several points.
pub fn check(mechanism: &Mechanism, seed: u64) -> Verdict {
    let programs = match Programs::new(&mechanism.text()) {
        Ok(programs) => programs,
        Err(failure) => return failure.into(),
    };
    let mut random = Random::new(seed);
    let mut findings = Findings::new(&programs);
    for _ in 0..3 {
        let point = mechanism.point(&mut random);
        for way in [Way::Model, Way::At] {
            findings.way = way;
            Sight { mechanism, programs: &programs, way, point: point.clone() }.all(&mut findings);
        }
    }
    findings.verdict()
}

/// Whether its mass matrix is singular wherever one looks: a true reason to refuse it.
pub fn is_singular(mechanism: &Mechanism, seed: u64) -> bool {
    let mut random = Random::new(seed);
    (0..5).all(|_| {
        let point = mechanism.point(&mut random);
        let eigen = Plain::mass_matrix(mechanism, &point).symmetric_eigenvalues();
        let most = eigen.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        eigen.iter().any(|x| *x <= 1e-10 * most)
    })
}

/// A model at a point.
struct Sight<'a> {
    mechanism: &'a Mechanism,
    programs: &'a Programs,
    way: Way,
    point: Point,
}

impl Sight<'_> {
    fn run(&self, kind: FunctionKind, point: &Point) -> Option<Vec<f64>> {
        self.programs.run_by(self.way, kind, &At::new(point))
    }

    fn at(&self, v: &[Vec<f64>], a: &[Vec<f64>]) -> Point {
        Point { v: v.to_vec(), a: a.to_vec(), ..self.point.clone() }
    }

    fn all(&self, findings: &mut Findings) {
        let (m, point) = (self.mechanism, &self.point);
        let plain = Plain::new(m, point);
        let none: Vec<Vec<f64>> = point.a.iter().map(|list| vec![0.0; list.len()]).collect();
        let (efforts, size) = plain.efforts();
        let matrix = Plain::mass_matrix(m, point);
        let largest = matrix.amax();
        let flat: Vec<f64> = matrix.transpose().iter().copied().collect();
        if let Some(got) = self.run(FunctionKind::InverseDynamics, point) {
            findings.compare("inverse dynamics", &got, &efforts, size, TOLERANCE);
        }
        if let Some(got) = self.run(FunctionKind::MassMatrix, point) {
            findings.compare("mass matrix", &got, &flat, largest, TOLERANCE);
        }
        if let Some(got) = self.run(FunctionKind::MassMatrixLower, point) {
            findings.compare_lower(&got, &matrix, largest, TOLERANCE);
        }
        let rest = self.at(&point.v, &none);
        let (bias, bias_size) = Plain::new(m, &rest).efforts();
        if let Some(got) = self.run(FunctionKind::Bias, point) {
            findings.compare("bias", &got, &bias, bias_size, TOLERANCE);
        }
        let [kinetic, potential] = plain.energies();
        if let Some(got) = self.run(FunctionKind::KineticEnergy, point) {
            findings.compare("kinetic energy", &got, &[kinetic], kinetic.abs(), TOLERANCE);
        }
        if let Some(got) = self.run(FunctionKind::PotentialEnergy, point) {
            findings.compare("potential energy", &got, &[potential], potential.abs() + kinetic, TOLERANCE);
        }
        if let Some(got) = self.run(FunctionKind::ForwardDynamics, point) {
            self.forward(findings, &got, &matrix);
        }
        self.outputs(findings);
        self.impulses(findings, &matrix);
        self.derivatives(findings);
    }

    /// Accelerations leave no effort, and the energy grows by the power of the forces.
    fn forward(&self, findings: &mut Findings, got: &[f64], matrix: &DMatrix<f64>) {
        let m = self.mechanism;
        let count = m.freedoms() + m.states.len();
        if got.len() != count || got.iter().any(|x| !x.is_finite()) {
            findings.compare("forward dynamics", got, &vec![0.0; count], 1e-300, TOLERANCE);
            return;
        }
        let (got, rates) = got.split_at(m.freedoms());
        let flows: Vec<f64> = self.point.states.iter().map(|x| FLOW * x).collect();
        findings.compare("rates of states", rates, &flows, 1.0, TOLERANCE);
        let a = split(m, got);
        let moving = self.at(&self.point.v, &a);
        let (left, size) = Plain::new(m, &moving).efforts();
        let turning = (matrix.abs() * DVector::from(got.to_vec()).abs()).amax();
        let zero = vec![0.0; left.len()];
        findings.compare("forward dynamics (efforts left)", &left, &zero, size + turning, 10.0 * TOLERANCE);
        let energy = |h: f64| {
            let q = displaced(m, &self.point.q, &self.point.v, h);
            // Second order, so that what is left of the differences is of third.
            let q = displaced(m, &q, &a, 0.5 * h * h);
            let v: Vec<Vec<f64>> =
                self.point.v.iter().zip(&a).map(|(v, a)| v.iter().zip(a).map(|(v, a)| v + h * a).collect()).collect();
            let point = Point { q, v, a: a.clone(), ..self.point.clone() };
            let kinetic = self.run(FunctionKind::KineticEnergy, &point)?;
            let potential = self.run(FunctionKind::PotentialEnergy, &point)?;
            Some(kinetic[0] + potential[0])
        };
        let slope = |h: f64| Some((energy(h)? - energy(-h)?) / (2.0 * h));
        let (Some(coarse), Some(fine), Some(level)) = (slope(2e-4), slope(1e-4), energy(0.0)) else { return };
        let power = Plain::new(m, &moving).power();
        let scale = level.abs().max(power.abs()).max(fine.abs()).max(1.0);
        // Where it bends too much the differences say nothing.
        if (coarse - fine).abs() < 1e-6 * scale {
            findings.compare("energy balance", &[fine], &[power], scale, 1e-5);
        }
    }

    fn outputs(&self, findings: &mut Findings) {
        let m = self.mechanism;
        let (Some(got), true) = (self.run(FunctionKind::Outputs, &self.point), m.outputs) else { return };
        let a = self.run(FunctionKind::ForwardDynamics, &self.point);
        let a = a.map(|a| a[..m.freedoms()].to_vec());
        let Some(a) = a.or_else(|| self.accelerations()) else { return };
        let moving = self.at(&self.point.v, &split(m, &a));
        let plain = Plain::new(m, &moving);
        let mut rest = &got[..];
        let mut take = |what: String, want: &[f64], size: f64| {
            if rest.len() < want.len() {
                findings.compare(&what, rest, want, size, TOLERANCE);
                return;
            }
            let (own, more) = rest.split_at(want.len());
            rest = more;
            findings.compare(&what, own, want, size, 100.0 * TOLERANCE);
        };
        let reach = 1.0 + plain.bodies.iter().fold(0.0_f64, |r, b| r.max(norm(b.place)));
        let fastest = a.iter().fold(1.0_f64, |r, x| r.max(x.abs())) + 10.0;
        for (k, body) in plain.bodies.iter().enumerate() {
            take(format!("position of b{k}"), &body.place, reach);
            take(format!("rotation of b{k}"), body.rotation.as_flattened(), 1.0);
            take(format!("twist of b{k}"), &[body.velocity, body.omega].concat(), reach * 10.0);
            take(format!("acceleration of b{k}"), &body.acceleration, reach * fastest * 10.0);
            take(format!("angular acceleration of b{k}"), &body.alpha, fastest * 10.0);
            let column = |of: &dyn Fn(&(V3, V3)) -> V3, row: usize| -> Vec<f64> {
                plain.partial.iter().map(|partial| of(&partial[k])[row]).collect()
            };
            let rows: Vec<f64> = (0..3)
                .flat_map(|row| column(&|p| p.0, row))
                .chain((0..3).flat_map(|row| column(&|p| p.1, row)))
                .collect();
            take(format!("Jacobian of b{k}"), &rows, reach);
        }
        let size = plain.efforts().1 + 10.0 * fastest;
        for k in 0..m.bodies.len() {
            let (force, moment) = plain.reaction(k);
            take(format!("reaction of j{k}"), &[force, moment].concat(), size * reach);
        }
    }

    /// From the plain matrix, where forward dynamics wasn't asked for.
    fn accelerations(&self) -> Option<Vec<f64>> {
        let m = self.mechanism;
        let none: Vec<Vec<f64>> = self.point.a.iter().map(|list| vec![0.0; list.len()]).collect();
        let bias = DVector::from(Plain::new(m, &self.at(&self.point.v, &none)).efforts().0);
        let matrix = Plain::mass_matrix(m, &self.point);
        if bias.is_empty() {
            return Some(Vec::new()); // what is made smaller may come to this
        }
        matrix.lu().solve(&-bias).map(|x| x.iter().copied().collect())
    }

    fn impulses(&self, findings: &mut Findings, matrix: &DMatrix<f64>) {
        let m = self.mechanism;
        let v = DVector::from(self.point.v.concat());
        let momenta = matrix * &v;
        let size = matrix.amax() * v.amax().max(1e-3);
        let list: Vec<f64> = momenta.iter().copied().collect();
        let mut at = At::new(&self.point);
        at.momenta = split(m, &list);
        let run = |kind| self.programs.run_by(self.way, kind, &at);
        let ratio = || {
            let eigen = matrix.clone().symmetric_eigenvalues();
            eigen.amax() / eigen.iter().fold(f64::INFINITY, |m, x| m.min(x.abs()))
        };
        if let Some(got) = run(FunctionKind::Momentum) {
            findings.compare("momentum", &got, &list, size, TOLERANCE);
        }
        for (what, kind) in
            [("velocity of momenta", FunctionKind::MomentumVelocity), ("impulse", FunctionKind::Impulse)]
        {
            if let Some(got) = run(kind) {
                let bound = TOLERANCE * (1.0 + 1e-4 * ratio());
                findings.compare(what, &got, v.as_slice(), v.amax(), bound);
            }
        }
        let Some(rates) = run(FunctionKind::MomentumRate) else { return };
        let Some(a) = self.accelerations() else { return };
        let a = split(m, &a);
        let momentum = |h: f64| {
            let q = displaced(m, &self.point.q, &self.point.v, h);
            let q = displaced(m, &q, &a, 0.5 * h * h);
            let v: Vec<f64> = self.point.v.concat().iter().zip(a.concat()).map(|(v, a)| v + h * a).collect();
            Plain::mass_matrix(m, &Point { q, ..self.point.clone() }) * DVector::from(v)
        };
        let slope = |h: f64| (momentum(h) - momentum(-h)) / (2.0 * h);
        let (coarse, fine) = (slope(2e-4), slope(1e-4));
        let scale = size + fine.amax();
        if (&coarse - &fine).amax() < 1e-6 * scale {
            findings.compare("momentum rate", &rates, fine.as_slice(), scale, 1e-5);
        }
    }

    /// Against differences of the functions themselves.
    fn derivatives(&self, findings: &mut Findings) {
        let kinds = [
            ("forward derivatives", FunctionKind::ForwardDerivatives, FunctionKind::ForwardDynamics),
            ("inverse derivatives", FunctionKind::InverseDerivatives, FunctionKind::InverseDynamics),
        ];
        for (what, kind, function) in kinds {
            let (Some(got), Some(here)) = (self.run(kind, &self.point), self.run(function, &self.point)) else {
                continue;
            };
            let (rows, n) = (here.len(), self.mechanism.freedoms());
            let blocks = [n, n, self.mechanism.states.len(), self.mechanism.inputs];
            let count = rows * blocks.iter().sum::<usize>();
            if got.len() != count {
                findings.compare(what, &got, &vec![0.0; count], 1.0, 0.0);
                continue;
            }
            let size = here.iter().chain(&got).fold(1.0_f64, |m, x| m.max(x.abs()));
            let mut start = 0;
            let columns = blocks.into_iter().enumerate().flat_map(|(block, width)| {
                start += width;
                let first = rows * (start - width);
                (0..width).map(move |k| (block, width, k, first))
            });
            for (block, width, k, first) in columns {
                let exact: Vec<f64> = (0..rows).map(|row| got[first + row * width + k]).collect();
                let slope = |h: f64| -> Option<Vec<f64>> {
                    let side = |h: f64| self.run(function, &self.beside(block, k, h));
                    Some(side(h)?.iter().zip(side(-h)?).map(|(a, b)| (a - b) / (2.0 * h)).collect())
                };
                let (Some(coarse), Some(fine)) = (slope(2e-5), slope(1e-5)) else { return };
                if coarse.iter().zip(&fine).all(|(a, b)| (a - b).abs() < 1e-6 * size) {
                    findings.compare(what, &exact, &fine, size, 1e-5);
                }
            }
        }
    }

    /// The point with one of its displacements, velocities, states or inputs changed.
    fn beside(&self, block: usize, place: usize, h: f64) -> Point {
        let mut point = self.point.clone();
        let unit: Vec<f64> = (0..self.mechanism.freedoms()).map(|k| f64::from(u8::from(k == place))).collect();
        let along = split(self.mechanism, &unit);
        match block {
            0 => point.q = displaced(self.mechanism, &point.q, &along, h),
            1 => point.v.iter_mut().zip(&along).for_each(|(v, d)| v.iter_mut().zip(d).for_each(|(v, d)| *v += h * d)),
            2 => point.states[place] += h,
            _ => point.inputs[place] += h,
        }
        point
    }
}
