//! Velocities that are no rates of coordinates, whatever they stand for: the rates of positions are affine in them, so they are found from
//! the rates of the plain state, and what they do is told by the change of these rates along the plain motion.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::Coordinate;
use nalgebra::{DMatrix, DVector};

use super::loops::{energy, full, guesses};
use super::{At, Findings};
use crate::algebra::least;
use crate::mechanism::expression::Point;
use crate::mechanism::{Mechanism, wheels};
use crate::plain::{Plain, displaced, split};
use crate::programs::{Programs, Values};

const TOLERANCE: f64 = 1e-7;
/// How far the fastest coordinate moves in a step of central differences.
const STEP: f64 = 2e-4;
/// What they leave.
const DIFFERENCES: f64 = 1e-5;

/// A point with velocities that are no rates, and their changes.
struct With<'a> {
    rest: &'a dyn Values,
    list: &'a [Coordinate],
    speeds: &'a [f64],
    changes: &'a [f64],
}

impl Values for With<'_> {
    fn value(&self, symbol: Symbol, joint: Option<&str>) -> f64 {
        let (of, joint, component) = match symbol {
            Symbol::Velocity { joint, component } => (self.speeds, joint, component),
            Symbol::Acceleration { joint, component } => (self.changes, joint, component),
            _ => return self.rest.value(symbol, joint),
        };
        let known = self.list.iter().position(|at| (at.joint, at.index) == (joint, component));
        known.and_then(|k| of.get(k)).copied().unwrap_or(f64::NAN)
    }
}

/// A point of the tree with what Newton's method starts from.
struct Guessed<'a> {
    tree: At<'a>,
    guesses: Vec<f64>,
}

impl Values for Guessed<'_> {
    fn value(&self, symbol: Symbol, joint: Option<&str>) -> f64 {
        match symbol {
            Symbol::Guess { index } => self.guesses.get(index).copied().unwrap_or(f64::NAN),
            other => self.tree.value(other, joint),
        }
    }
}

/// The velocities of a plain state; nothing where they are poorly determined, or where its rates are none that they can give, which is told.
pub(super) fn of(
    programs: &Programs,
    rest: &dyn Values,
    rates: &[f64],
    findings: &mut Findings,
) -> Option<Vec<(Coordinate, f64)>> {
    let list = programs.structure.speeds();
    if list.is_empty() {
        return None;
    }
    let at = |speeds: &[f64]| {
        let values = With { rest, list, speeds, changes: &[] };
        programs.run(FunctionKind::PositionRates, &values).map(DVector::from)
    };
    let zero = vec![0.0; list.len()];
    let still = at(&zero)?;
    let column = |k: usize| {
        let mut one = zero.clone();
        one[k] = 1.0;
        at(&one).map(|rates| rates - &still)
    };
    let map = DMatrix::from_columns(&(0..list.len()).map(column).collect::<Option<Vec<_>>>()?);
    if map.iter().chain(&still).any(|x| !x.is_finite() || x.abs() > 1e3) {
        return None;
    }
    let wanted = DVector::from_column_slice(rates);
    let (speeds, ratio, rank) = least(&map, &(&wanted - &still));
    if rank < list.len() || ratio < 1e-2 {
        return None;
    }
    let found = &map * &speeds + &still;
    findings.compare("rates by speeds", found.as_slice(), rates, 1.0 + wanted.amax() / ratio, TOLERANCE);
    Some(list.iter().copied().zip(speeds.iter().copied()).collect())
}

/// Functions of velocities, at a point with its accelerations.
pub(super) fn compare(
    m: &Mechanism,
    programs: &Programs,
    (point, known, rates): (&Point, &[(Coordinate, f64)], &[f64]),
    (rest, size): (&dyn Values, f64),
    findings: &mut Findings,
) {
    let (list, speeds): (Vec<Coordinate>, Vec<f64>) = known.iter().copied().unzip();
    let first = (0..m.speeds.len()).filter_map(|k| list.iter().position(|&at| at == programs.model.coordinate_of(k)));
    let own: Vec<f64> = first.map(|k| speeds[k]).collect();
    if !m.speeds.is_empty() {
        let wanted = wheels::speeds(m, &point.v.concat());
        let scale = wanted.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        findings.compare("speeds", &own, &wanted, 10.0 * scale, TOLERANCE);
    }
    let with = |changes| With { rest, list: &list, speeds: &speeds, changes };
    let Some(forward) = programs.run_by(findings.way, FunctionKind::ForwardDynamics, &with(&[])) else { return };
    let (changes, behind) = forward.split_at(list.len());
    let moved = behind.get(m.states.len()..m.states.len() + rates.len()).unwrap_or_default();
    let quick = rates.iter().fold(10.0_f64, |most, x| most.max(x.abs()));
    findings.compare("rates of positions", moved, rates, quick, TOLERANCE);
    // The change of rates, along the plain motion and with the changes of velocities that are to be proven.
    let side = |h: f64| {
        let along = [&point.v, &point.a].map(|parts| DVector::from(parts.concat()));
        let step = &along[0] * h + &along[1] * (0.5 * h * h);
        let q = displaced(m, &point.q, &split(m, step.as_slice()), 1.0);
        let point = Point { q, time: point.time + h, ..point.clone() };
        let rest = Guessed { tree: At::new(&point), guesses: guesses(m, programs, &point) };
        let speeds: Vec<f64> = speeds.iter().zip(changes).map(|(speed, change)| speed + h * change).collect();
        programs.run(FunctionKind::PositionRates, &With { rest: &rest, list: &list, speeds: &speeds, changes: &[] })
    };
    let fastest = point.v.iter().flatten().fold(10.0_f64, |most, v| most.max(v.abs()));
    let slopes =
        |h: f64| -> Option<DVector<f64>> { Some((DVector::from(side(h)?) - DVector::from(side(-h)?)) / (2.0 * h)) };
    if let (Some(coarse), Some(fine)) = (slopes(STEP / fastest), slopes(0.5 * STEP / fastest)) {
        // Richardson's: what the two differ in bounds what is left of the better one.
        let better = (&fine * 4.0 - &coarse) / 3.0;
        let left = (fine - coarse).amax() / size.max(1e-3);
        let wanted: Vec<f64> = programs
            .structure
            .state
            .iter()
            .map(|c| {
                let name = programs.model.joints[c.joint].place.field.to_string();
                rest.value(Symbol::Acceleration { joint: c.joint, component: c.index }, Some(&name))
            })
            .collect();
        findings.compare("changes of rates", better.as_slice(), &wanted, size, DIFFERENCES.max(left));
    }
    let scleronomic = !m.goes_by_time();
    let [kinetic, _] = Plain::new(m, point).energies();
    if scleronomic && let Some(got) = programs.run_by(findings.way, FunctionKind::MassMatrix, &with(&[])) {
        let matrix = DMatrix::from_row_slice(list.len(), list.len(), &got);
        findings.compare("mass matrix (energy)", &[energy(&matrix, &speeds)], &[kinetic], kinetic, TOLERANCE);
    }
    if let Some(got) = programs.run_by(findings.way, FunctionKind::MassMatrixLower, &with(&[])) {
        if scleronomic {
            let energy = energy(&full(&got, list.len()), &speeds);
            findings.compare("lower triangle (energy)", &[energy], &[kinetic], kinetic, TOLERANCE);
        }
        findings.compared.triangles += 1;
    }
    let changes = changes.to_vec();
    if m.tail.contains("Reduced")
        && let Some(got) = programs.run_by(findings.way, FunctionKind::InverseDynamics, &with(&changes))
    {
        let zero = vec![0.0; got.len()];
        let needed = Plain::new(m, point).efforts().1;
        findings.compare("inverse dynamics (left)", &got, &zero, needed + size, TOLERANCE);
    }
}
