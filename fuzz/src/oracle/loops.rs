//! Closed loops in all formulations, against the plain tree with multipliers for all equations.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::Means;
use multibody_engine::model::types::Coordinate;

use nalgebra::{DMatrix, DVector};

use super::excuses::is_redundant;
use super::{At, Findings, Verdict, outputs, speeds};
use crate::algebra::{V3, apply, extremes, norm, quaternion, transposed};
use crate::closed::{Equations, accelerations, settled, state, turns_beside};
use crate::mechanism::expression::Point;
use crate::mechanism::{Kind, Mechanism};
use crate::plain::{Motion, Plain, displaced, split};
use crate::programs::{Failure, Programs, Values, Way};
use crate::random::Random;

const TOLERANCE: f64 = 1e-7;

/// Compiles it and looks at it at several closed states. Of what has to be refused, all else is looked at.
pub fn check(mechanism: &Mechanism, seed: u64) -> Verdict {
    let programs = match Programs::new(&mechanism.text()) {
        Ok(programs) => programs,
        Err(Failure::Refused(said)) => match without(mechanism, &said) {
            Some(rest) => return check(&rest, seed),
            None => return Verdict::Refused(said),
        },
        Err(failure) => return failure.into(),
    };
    let mut random = Random::new(seed);
    let mut findings = Findings::new(&programs);
    // Most states of some models are near singular ones, or out of reach of the branch: then more are tried.
    for tried in 0..30 {
        if tried >= 8 && findings.compared.numbers > 0 {
            break;
        }
        let Some(mut point) = state(mechanism, &mut random) else { continue };
        if !mechanism.held.is_empty() && random.chance(30) {
            turn_on(mechanism, &programs, &mut point, &mut random);
        }
        for way in [Way::Model, Way::At] {
            findings.way = way;
            look(mechanism, &programs, &point, &mut findings);
        }
        if findings.compared.numbers - findings.compared.at > 400 {
            break;
        }
    }
    findings.verdict()
}

/// The mechanism without what is refused, if that is reactions that loops share, or jumps where there is an iteration.
fn without(mechanism: &Mechanism, said: &[String]) -> Option<Mechanism> {
    let mut rest = mechanism.clone();
    for text in said {
        if text.contains("`impulse` knows no guess") {
            rest.emit.retain(|word| *word != "impulse");
            continue;
        }
        let named = ["a reaction of `j", "the output `reaction"].iter().find_map(|words| text.strip_prefix(words))?;
        let (joint, why) = named.split_once('`')?;
        let joint: usize = joint.parse().ok()?;
        let is_true = why.contains("depends on how loops share their load") && mechanism.is_in_a_loop(joint);
        if !is_true || rest.unread.contains(&joint) {
            return None;
        }
        rest.unread.push(joint);
    }
    let is_excused = rest.unread.is_empty() || is_redundant(mechanism);
    (!said.is_empty() && is_excused).then_some(rest)
}

/// Some whole turns more, of coordinates of the state of which equations know the sine alone.
fn turn_on(m: &Mechanism, programs: &Programs, point: &mut Point, random: &mut Random) {
    // Measured angles jump.
    if m.tail.contains("Absolute") {
        return;
    }
    for coordinate in &programs.structure.state {
        let name = programs.model.joints[coordinate.joint].place.field.to_string();
        let Some(joint) = name.strip_prefix('j').and_then(|text| text.parse::<usize>().ok()) else { continue };
        let Some(kind) = m.joints.get(joint).map(|joint| &joint.kind) else { continue };
        let is_angle = |name: &&str| !matches!(*name, "travel" | "x" | "y" | "z");
        let turns = !matches!(kind, Kind::Screw(..)) && kind.names().get(coordinate.index).is_some_and(is_angle);
        if turns && !m.counts((joint, coordinate.index)) {
            point.q[joint][coordinate.index] += TAU * (random.below(13) as f64 - 6.0);
        }
    }
}

/// The drawn configuration, closed.
pub(super) fn drawn(mechanism: &Mechanism) -> Option<Point> {
    let mut random = Random::new(0);
    let mut at = mechanism.point(&mut random);
    at.params.clear();
    for default in &mechanism.params {
        let value = default.value(&at);
        at.params.push(value);
    }
    at.q = mechanism.closed.clone();
    settled(mechanism, at)
}

/// Whether the equations hold still every coordinate that they touch: nothing that they close can move.
pub fn is_locked(mechanism: &Mechanism) -> bool {
    drawn(mechanism).and_then(|at| accelerations(mechanism, &at)).is_some_and(|found| {
        let touched = found.equations.slope.column_iter().filter(|column| column.amax() > 1e-9).count();
        found.ratio > 1e-3 && found.rank == touched
    })
}

/// Whether the drawn configuration is one at all, and not a singular one.
pub fn is_regular(mechanism: &Mechanism) -> bool {
    drawn(mechanism)
        .and_then(|at| accelerations(mechanism, &at))
        .is_some_and(|found| found.ratio > 1e-3 && found.rank < mechanism.freedoms())
}

/// Whether fewer equations are independent where loops are closed than beside that.
pub fn loses_rank_where_closed(mechanism: &Mechanism) -> bool {
    drawn(mechanism).is_some_and(|closed| {
        let rank = |at: &Point| Equations::new(mechanism, at).rank();
        let mut random = Random::new(1);
        let direction: Vec<f64> = (0..mechanism.freedoms()).map(|_| random.unit()).collect();
        let q = displaced(mechanism, &closed.q, &split(mechanism, &direction), 0.1);
        rank(&Point { q, ..closed.clone() }) > rank(&closed)
    })
}

/// Whether a loop that a screw closes holds turns about other axes than the screw's.
pub fn turns_beside_a_screw(mechanism: &Mechanism) -> bool {
    drawn(mechanism).is_some_and(|at| turns_beside(mechanism, &at))
}

/// Roll, pitch, yaw of a turn.
fn angles(r: &[V3; 3]) -> [f64; 3] {
    [r[2][1].atan2(r[2][2]), -r[2][0].clamp(-1.0, 1.0).asin(), r[1][0].atan2(r[0][0])]
}

/// Rates of roll, pitch, yaw for an angular velocity in world axes.
fn angle_rates([_, pitch, yaw]: [f64; 3], w: V3) -> [f64; 3] {
    let ((sp, cp), (sy, cy)) = (pitch.sin_cos(), yaw.sin_cos());
    let level = cy * w[0] + sy * w[1];
    [level / cp, cy * w[1] - sy * w[0], w[2] + level * sp / cp]
}

/// A closed state in any formulation's coordinates.
pub(super) struct Anywhere<'a> {
    tree: At<'a>,
    bodies: &'a [Motion],
    quaternions: bool,
    guesses: Vec<f64>,
    /// Velocities that are no rates of the state: their coordinates, and values.
    pub(super) speeds: Vec<(Coordinate, f64)>,
}

impl Values for Anywhere<'_> {
    fn value(&self, symbol: Symbol, joint: Option<&str>) -> f64 {
        if let Symbol::Guess { index } = symbol {
            return self.guesses.get(index).copied().unwrap_or(f64::NAN);
        }
        if let Symbol::Velocity { joint, component } = symbol
            && let Some(known) = self.speeds.iter().find(|(at, _)| (at.joint, at.index) == (joint, component))
        {
            return known.1;
        }
        let body = joint.and_then(|name| name.strip_prefix('b')).and_then(|text| text.parse::<usize>().ok());
        let Some(body) = body.and_then(|k| self.bodies.get(k)) else { return self.tree.value(symbol, joint) };
        let rpy = angles(&body.rotation);
        match symbol {
            Symbol::Position { component, .. } if component < 3 => body.place[component],
            Symbol::Position { component, .. } if self.quaternions => quaternion(&body.rotation)[component - 3],
            Symbol::Position { component, .. } => rpy[component - 3],
            Symbol::Velocity { component, .. } if component < 3 => body.velocity[component],
            Symbol::Velocity { component, .. } if self.quaternions => {
                apply(&transposed(&body.rotation), body.omega)[component - 3]
            }
            Symbol::Velocity { component, .. } => angle_rates(rpy, body.omega)[component - 3],
            _ => f64::NAN,
        }
    }
}

/// Whether an angle is where one that is measured between frames isn't: beyond a half turn, a pitch beyond a right angle.
fn beyond_measure(m: &Mechanism, point: &Point) -> bool {
    m.joints.iter().zip(&point.q).any(|(joint, q)| {
        joint.kind.names().iter().zip(q).any(|(name, x)| match *name {
            "travel" | "x" | "y" | "z" => false,
            "pitch" => x.abs() > FRAC_PI_2,
            _ => x.abs() > PI,
        })
    })
}

/// The least singular value of the equations in the coordinates that follow from others, over the greatest in all.
fn off_dead_centres(m: &Mechanism, programs: &Programs, equations: &Equations) -> f64 {
    let first = |joint: usize| m.joints[..joint].iter().map(|joint| joint.kind.freedoms()).sum::<usize>();
    let unknowns = programs.structure.steps.iter().flat_map(|step| &step.unknowns);
    let columns: Vec<usize> = unknowns
        .filter_map(|unknown| {
            let name = programs.model.joints[unknown.joint].place.field.to_string();
            let joint: usize = name.strip_prefix('j')?.parse().ok()?;
            Some(first(joint) + unknown.index)
        })
        .collect();
    let slope = equations.position_slope();
    let (least, _) = extremes(slope.select_columns(columns.iter()));
    let (_, most) = extremes(slope);
    // Where nothing follows the least is infinite.
    if least.is_finite() { least / most } else { 1.0 }
}

fn look(m: &Mechanism, programs: &Programs, point: &Point, findings: &mut Findings) {
    let Some(found) = accelerations(m, point) else { return };
    // Near a singular pose nothing says how large a difference may be; in coordinates of the state dead centres are such poses.
    let ratio = found.ratio.min(off_dead_centres(m, programs, &found.equations));
    if ratio < 1e-2 || found.accelerations.iter().any(|x| x.abs() > 1e8) {
        return;
    }
    let point = Point { a: split(m, &found.accelerations), ..point.clone() };
    let plain = Plain::new(m, &point);
    let absolute = m.tail.contains("Absolute");
    let quaternions = m.tail.contains("Absolute(Quaternion)");
    if absolute && !quaternions && plain.bodies.iter().any(|b| angles(&b.rotation)[1].cos().abs() < 0.3) {
        return;
    }
    if absolute && beyond_measure(m, &point) {
        return;
    }
    // The branch that was chosen.
    if m.tail.contains("solve") && point.q[2 + usize::from(m.carried)][0].sin() < 0.05 {
        return;
    }
    let guesses = guesses(m, programs, &point);
    let mut values =
        Anywhere { tree: At::new(&point), bodies: &plain.bodies, quaternions, guesses, speeds: Vec::new() };
    if programs.structure.has_speeds() {
        let Some(speeds) = speeds::of(programs, &values, &rates(m, programs, &point), findings) else { return };
        values.speeds = speeds;
    }
    let fastest = found.accelerations.iter().fold(10.0_f64, |r, x| r.max(x.abs()));
    let quick = point.v.iter().flatten().fold(10.0_f64, |most, v| most.max(v.abs()));
    let reach = 1.0 + plain.bodies.iter().fold(0.0_f64, |r, b| r.max(norm(b.place)));
    let way = findings.way;
    let run = |kind| programs.run_by(way, kind, &values);
    let [kinetic, potential] = plain.energies();
    if let Some(got) = run(FunctionKind::KineticEnergy) {
        findings.compare("kinetic energy", &got, &[kinetic], kinetic, TOLERANCE);
    }
    if let Some(got) = run(FunctionKind::PotentialEnergy) {
        findings.compare("potential energy", &got, &[potential], potential.abs() + kinetic + 1.0, TOLERANCE);
    }
    let equations = programs.structure.independent.len();
    if m.held.is_empty() && !absolute && equations != found.rank && programs.structure.steps.is_empty() {
        findings.compare("number of equations", &[equations as f64], &[found.rank as f64], 1.0, 0.0);
    }
    if programs.structure.has_speeds() {
        let rates = rates(m, programs, &point);
        speeds::compare(m, programs, (&point, &values.speeds, &rates), (&values, fastest / ratio), findings);
    } else if !absolute {
        let joint = |k: usize| -> Option<usize> {
            programs.model.joints.get(k)?.place.field.to_string().strip_prefix('j')?.parse().ok()
        };
        let state: Vec<(usize, usize)> =
            programs.structure.state.iter().filter_map(|c| Some((joint(c.joint.0)?, c.index))).collect();
        let want: Vec<f64> = state.iter().map(|&(j, k)| point.a[j][k]).collect();
        if let Some(got) = run(FunctionKind::ForwardDynamics) {
            let got = &got[..want.len().min(got.len())];
            findings.compare("forward dynamics", got, &want, fastest / ratio, TOLERANCE);
        }
        let v: Vec<f64> = state.iter().map(|&(j, k)| point.v[j][k]).collect();
        let whole = run(FunctionKind::MassMatrix).map(|got| DMatrix::from_row_slice(v.len(), v.len(), &got));
        // What moves by time is no part of it, such as what a linear coupling gives, which is put in.
        let is_driven = m.goes_by_time();
        if let Some(matrix) = whole.as_ref().filter(|_| !is_driven) {
            findings.compare("mass matrix (energy)", &[energy(matrix, &v)], &[kinetic], kinetic, TOLERANCE);
        }
        if let Some(got) = run(FunctionKind::MassMatrixLower) {
            if !is_driven {
                let energy = energy(&full(&got, v.len()), &v);
                findings.compare("lower triangle (energy)", &[energy], &[kinetic], kinetic, TOLERANCE);
            }
            findings.compared.triangles += 1;
            if let Some(whole) = &whole {
                findings.compare_lower(&got, whole, whole.amax(), TOLERANCE);
            }
        }
        if m.tail.contains("Reduced")
            && let Some(got) = run(FunctionKind::InverseDynamics)
        {
            let zero = vec![0.0; got.len()];
            findings.compare("inverse dynamics (left)", &got, &zero, plain.efforts().1 / ratio, TOLERANCE);
        }
        if m.tail.contains("Reduced") && !is_driven {
            let momenta = momenta(m, &found.equations, &state, &point);
            let struck =
                Anywhere { tree: At { momenta, point: &point }, guesses: Vec::new(), speeds: Vec::new(), ..values };
            if let Some(got) = programs.run_by(way, FunctionKind::Impulse, &struck) {
                findings.compare("impulse", &got, &v, quick / ratio, TOLERANCE);
            }
        }
    }
    let of = outputs::Of { m, point: &point, plain: &plain, found: &found, reach, quick, size: fastest / ratio, ratio };
    outputs::compare(&of, programs, &mut values, findings);
}

/// Those of the coordinates of the state, joint by joint: what stops the mechanism, since others follow by G v = 0.
fn momenta(m: &Mechanism, equations: &Equations, state: &[(usize, usize)], point: &Point) -> Vec<Vec<f64>> {
    let places: Vec<(usize, usize)> = (0..m.bodies.len())
        .flat_map(|joint| (0..m.joints[joint].kind.freedoms()).map(move |component| (joint, component)))
        .collect();
    let (own, others): (Vec<usize>, Vec<usize>) = (0..places.len()).partition(|&k| state.contains(&places[k]));
    let all = Plain::mass_matrix(m, point) * DVector::from(point.v.concat());
    if own.is_empty() || others.is_empty() {
        return split(m, all.as_slice());
    }
    let slope = |of: &[usize]| equations.slope.select_columns(of);
    let follow = slope(&others).svd(true, true).solve(&-slope(&own), 1e-9).expect("both factors are asked for");
    let mut momenta = vec![0.0; places.len()];
    for (number, &k) in own.iter().enumerate() {
        let felt: f64 = others.iter().enumerate().map(|(row, &other)| follow[(row, number)] * all[other]).sum();
        momenta[k] = all[k] + felt;
    }
    split(m, &momenta)
}

/// The kinetic energy by a mass matrix.
pub(super) fn energy(matrix: &DMatrix<f64>, v: &[f64]) -> f64 {
    let v = DVector::from_column_slice(v);
    0.5 * v.dot(&(matrix * &v))
}

/// The symmetric matrix of a triangle's rows.
pub(super) fn full(packed: &[f64], size: usize) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |row, column| {
        let (below, left) = (row.max(column), row.min(column));
        packed.get(below * (below + 1) / 2 + left).copied().unwrap_or(f64::NAN)
    })
}

/// Rates of the coordinates of the state.
fn rates(m: &Mechanism, programs: &Programs, point: &Point) -> Vec<f64> {
    let rate = |c: &Coordinate| {
        let name = programs.model.joints[c.joint].place.field.to_string();
        let joint = name.strip_prefix('j').and_then(|text| text.parse::<usize>().ok());
        joint.filter(|&joint| joint < m.bodies.len()).map_or(f64::NAN, |joint| point.v[joint][c.index])
    };
    programs.structure.state.iter().map(rate).collect()
}

/// Where Newton's method starts: near the truth.
pub(super) fn guesses(m: &Mechanism, programs: &Programs, point: &Point) -> Vec<f64> {
    let mut list = vec![f64::NAN; programs.structure.guesses()];
    for step in &programs.structure.steps {
        let Means::Newton { guess, .. } = step.means else { continue };
        for (k, unknown) in step.unknowns.iter().enumerate() {
            let name = programs.model.joints[unknown.joint].place.field.to_string();
            let joint = name.strip_prefix('j').and_then(|text| text.parse::<usize>().ok());
            if let Some(joint) = joint.filter(|&j| j < m.bodies.len())
                && m.joints[joint].kind.quaternion().is_none()
            {
                list[guess + k] = point.q[joint][unknown.index] + 1e-4;
            }
        }
    }
    list
}
