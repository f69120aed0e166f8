//! Outputs of closed states: motions of bodies, reactions, contacts and multipliers.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::Findings;
use super::loops::Anywhere;
use crate::algebra::{V3, cross, dot, minus, norm, plus, scaled};
use crate::closed::{Closed, Source, touching};
use crate::mechanism::expression::Point;
use crate::mechanism::{Held, Load, Mechanism};
use crate::plain::Plain;
use crate::programs::{Programs, Values};

const TOLERANCE: f64 = 1e-7;

/// The plain state, and what differences count in terms of.
pub(super) struct Of<'a> {
    pub m: &'a Mechanism,
    pub point: &'a Point,
    pub plain: &'a Plain<'a>,
    pub found: &'a Closed,
    /// Of places.
    pub reach: f64,
    /// Of velocities.
    pub quick: f64,
    /// Of accelerations.
    pub size: f64,
    /// How far the equations are from singular.
    pub ratio: f64,
}

/// Outputs behind each other, in the order in which they are declared.
struct Reader<'a> {
    rest: &'a [f64],
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> &'a [f64] {
        let (own, rest) = self.rest.split_at(count.min(self.rest.len()));
        self.rest = rest;
        own
    }
}

/// All that the mechanism declares.
pub(super) fn compare(of: &Of<'_>, programs: &Programs, values: &mut Anywhere<'_>, findings: &mut Findings) {
    let Some(got) = programs.run_by(findings.way, FunctionKind::Outputs, values) else { return };
    let freedoms = programs.structure.freedoms();
    let mut reader = Reader { rest: &got };
    if of.m.outputs {
        let bodies = reader.take(of.m.bodies.len() * (24 + 6 * freedoms));
        compare_bodies(of, programs, values, bodies, findings);
        let reactions: HashMap<usize, &[f64]> = of.m.read_joints().map(|joint| (joint, reader.take(6))).collect();
        balance(of, &reactions, findings);
    }
    if of.m.contacts {
        contacts(of, &mut reader, findings);
    }
    loads(of, &mut reader, findings);
    findings.compare("number of outputs", &[reader.rest.len() as f64], &[0.0], 1.0, 0.0);
}

fn compare_bodies(of: &Of<'_>, programs: &Programs, values: &mut Anywhere<'_>, got: &[f64], findings: &mut Findings) {
    let Of { m, plain, reach, quick, size: fastest, .. } = *of;
    let freedoms = programs.structure.freedoms();
    // Velocities of the model, by which Jacobians are.
    let speeds = |values: &Anywhere<'_>| -> Vec<f64> {
        let of = |c: &multibody_engine::model::types::Coordinate| {
            if let Some(known) = values.speeds.iter().find(|(at, _)| at == c) {
                return known.1;
            }
            let name = programs.model.joints[c.joint].place.field.to_string();
            values.value(Symbol::Velocity { joint: c.joint, component: c.index }, Some(&name))
        };
        programs.structure.speeds().iter().map(of).collect()
    };
    let v = speeds(values);
    // What moves by time moves without these.
    let still = m.goes_by_time().then(|| {
        let kept = std::mem::take(&mut values.speeds);
        values.speeds = programs.structure.speeds().iter().map(|c| (*c, 0.0)).collect();
        let still = programs.run_by(findings.way, FunctionKind::Outputs, values);
        values.speeds = kept;
        still.unwrap_or_default()
    });
    let width = 24 + 6 * freedoms;
    for (k, body) in plain.bodies.iter().enumerate() {
        let mut reader = Reader { rest: got.get(k * width..(k + 1) * width).unwrap_or_default() };
        let mut take = |what: &str, want: &[f64], size: f64| {
            findings.compare(&format!("{what} of b{k}"), reader.take(want.len()), want, size, TOLERANCE);
        };
        let twist = [body.velocity, body.omega].concat();
        take("position", &body.place, reach);
        take("rotation", body.rotation.as_flattened(), 1.0);
        take("twist", &twist, quick * reach);
        take("acceleration", &body.acceleration, reach * fastest);
        take("angular acceleration", &body.alpha, fastest);
        let columns = reader.rest;
        let along = |row: &[f64]| row.iter().zip(&v).map(|(a, b)| a * b).sum::<f64>();
        let mut moved: Vec<f64> = columns.chunks(freedoms.max(1)).map(along).collect();
        let by_time = still.as_ref().and_then(|still| still.get(k * width + 12..k * width + 18)).unwrap_or(&[0.0; 6]);
        moved.iter_mut().zip(by_time).for_each(|(moved, by_time)| *moved += by_time);
        if freedoms > 0 {
            findings.compare(&format!("Jacobian by velocity of b{k}"), &moved, &twist, quick * reach, TOLERANCE);
        }
    }
}

/// The multiplier of the equation `row` of a source, if it is known.
fn multiplier(found: &Closed, of: Source, row: usize) -> Option<f64> {
    let first = found.equations.sources.iter().position(|source| *source == of)?;
    found.multipliers[first + row]
}

/// What a wheel or a blade is pushed with, and where, if it is known.
fn push(of: &Of<'_>, number: usize) -> Option<(V3, V3)> {
    let touching = touching(of.m, of.plain, number, of.point)?;
    let mut force = [0.0; 3];
    for (row, direction) in touching.directions.iter().enumerate() {
        force = minus(force, scaled(multiplier(of.found, Source::Held(number), row)?, *direction));
    }
    Some((touching.place, force))
}

/// Reactions with all forces at a body, those of wheels and rods too, are what its motion takes; of bodies all of whose joints are read.
fn balance(of: &Of<'_>, reactions: &HashMap<usize, &[f64]>, findings: &mut Findings) {
    let Of { m, plain, .. } = *of;
    // At which bodies these push, where, and how.
    let mut pushes: Vec<(Option<usize>, V3, V3)> = Vec::new();
    for (k, held) in m.held.iter().enumerate() {
        let Some([what, on]) = held.frames() else { continue };
        let Some((place, force)) = push(of, k) else { return };
        pushes.extend([(what.body, place, force), (on.body, place, scaled(-1.0, force))]);
    }
    for (k, rod) in m.rods.iter().enumerate() {
        let Some(multiplier) = multiplier(of.found, Source::Rod(k), 0) else { return };
        let [a, b] = rod.between.each_ref().map(|frame| plain.frame(frame).place);
        let away = minus(b, a);
        let force = scaled(-multiplier / norm(away), away);
        pushes.extend([(rod.between[1].body, b, force), (rod.between[0].body, a, scaled(-1.0, force))]);
    }
    let size = (plain.efforts().1 * of.reach + of.size) / of.ratio;
    let holds = |joint: usize, body: usize| {
        m.joints
            .get(joint)
            .is_some_and(|joint| [&joint.parent, &joint.child].iter().any(|frame| frame.body == Some(body)))
    };
    for body in 0..m.bodies.len() {
        if m.unread.iter().any(|&joint| holds(joint, body)) {
            continue;
        }
        let (need, mut have) = (plain.needed(body), ([0.0; 3], [0.0; 3]));
        let mut largest = size;
        let mut add = |place: V3, force: V3, moment: V3| {
            let turned = plus(moment, cross(minus(place, plain.bodies[body].place), force));
            have = (plus(have.0, force), plus(have.1, turned));
            largest = largest.max(dot(force, force).sqrt() + dot(turned, turned).sqrt());
        };
        for (k, joint) in m.joints.iter().enumerate() {
            let reaction = reactions.get(&k).copied().unwrap_or_default();
            let part = |at: usize| [0, 1, 2].map(|i| reaction.get(at + i).copied().unwrap_or(f64::NAN));
            let on_child = joint.child.body == Some(body);
            if !on_child && joint.parent.body != Some(body) {
                continue;
            }
            let sign = if on_child { 1.0 } else { -1.0 };
            add(plain.frame(&joint.child).place, scaled(sign, part(0)), scaled(sign, part(3)));
        }
        for (_, place, force) in pushes.iter().filter(|one| one.0 == Some(body)) {
            add(*place, *force, [0.0; 3]);
        }
        let (have, need) = ([have.0, have.1].concat(), [need.0, need.1].concat());
        findings.compare(&format!("balance of b{body} with reactions"), &have, &need, largest, TOLERANCE);
    }
}

fn contacts(of: &Of<'_>, reader: &mut Reader<'_>, findings: &mut Findings) {
    for (k, held) in of.m.held.iter().enumerate() {
        let Some(touching) = touching(of.m, of.plain, k, of.point) else { continue };
        if !matches!(held, Held::Blade { .. }) {
            findings.compare("contact", reader.take(3), &touching.place, of.reach, TOLERANCE);
        }
        findings.compare("slip", reader.take(3), &touching.slip, of.quick * of.reach, TOLERANCE);
    }
}

fn loads(of: &Of<'_>, reader: &mut Reader<'_>, findings: &mut Findings) {
    let found = of.found;
    let size = of.plain.efforts().1.max(found.greatest) / of.ratio;
    for (number, load) in of.m.loads.iter().enumerate() {
        let (what, got, want) = match *load {
            Load::Force(k) => ("force", reader.take(3), push(of, k).map(|push| push.1.to_vec())),
            Load::Row(k, row) => {
                ("multiplier", reader.take(1), multiplier(found, Source::Held(k), row).map(|x| vec![x]))
            }
            Load::Rod(k) => {
                let [a, b] = of.m.rods[k].between.each_ref().map(|frame| of.plain.frame(frame).place);
                // Of half the square of the length.
                let multiplier = multiplier(found, Source::Rod(k), 0).map(|x| vec![x / norm(minus(b, a))]);
                ("multiplier of a rod", reader.take(1), multiplier)
            }
            Load::Coupling(k) => {
                let multiplier = multiplier(found, Source::Coupling(k), 0).map(|x| vec![x]);
                ("multiplier of a coupling", reader.take(1), multiplier)
            }
            Load::Drive(k) => {
                ("effort of a drive", reader.take(1), multiplier(found, Source::Drive(k), 0).map(|x| vec![-x]))
            }
        };
        let [known, shared] = findings.loads.entry(number).or_default();
        match want {
            Some(want) => {
                *known += 1;
                findings.compare(what, got, &want, size, TOLERANCE);
            }
            None => *shared += 1,
        }
    }
}
