//! Random mechanisms: outputs of every type in every formulation, against finite differences of positions along the
//! motion, Newton's and Euler's laws of every single body, and the balance of power.
//!
//! Oblique axes, frames that are turned, all kinds of joints, efforts, springs and dampers on joints and along lines,
//! forces, torques, loops. As many are looked at as 20 seconds allow, ten at most; `MULTIBODY_MECHANISMS=1000 cargo test
//! --release -p multibody-engine --test mechanics random_outputs` looks at so many, however long it takes.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use multibody_engine::contracts::function::FunctionKind;

use super::alike::Mechanism;
use super::support::*;

const FORMULATIONS: [&str; 4] = [
    "formulation { constraints: Reduced }",
    "formulation { coordinates: Absolute(RollPitchYaw) }",
    "formulation { coordinates: Absolute(Quaternion) }",
    "formulation { coordinates: Absolute(RollPitchYaw), constraints: Reduced }",
];

const GRAVITY: [f64; 3] = [1.0, -9.0, 2.0];

struct Body {
    mass: f64,
    com: [f64; 3],
    tensor: Matrix,
}

/// A joint's bodies; the ground is nothing.
struct Joint {
    parent: Option<usize>,
    child: usize,
}

enum Load {
    Force {
        body: usize,
        value: [f64; 3],
    },
    Torque {
        body: usize,
        value: [f64; 3],
    },
    /// Stiffness, damping, length.
    Line {
        bodies: [Option<usize>; 2],
        data: [f64; 3],
    },
    OnJoint,
}

struct Sample {
    text: String,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    loads: Vec<Load>,
    /// Outputs that must agree.
    told: Vec<String>,
    /// Bodies on which a constraint pulls that tells no reaction.
    held: Vec<usize>,
}

fn round(x: f64) -> f64 {
    (x * 64.0).round() / 64.0
}

impl Random {
    fn vector(&mut self) -> [f64; 3] {
        [0, 1, 2].map(|_| round(self.next()))
    }

    fn below(&mut self, count: usize) -> usize {
        (((self.next() + 1.0) * 0.5 * count as f64) as usize).min(count - 1)
    }

    fn frame(&mut self, body: &str) -> String {
        let at = self.vector();
        match self.below(3) {
            0 => format!("{body}.at({at:?})"),
            _ => {
                let axis = self.vector().map(|x| x + 0.01);
                format!("{body}.at({at:?}).rotated({axis:?}, {:?})", round(3.0 * self.next()))
            }
        }
    }
}

fn name(body: Option<usize>) -> String {
    body.map_or("ground".to_owned(), |k| format!("b{k}"))
}

/// Point masses have an inertia that a body can have.
fn body(random: &mut Random) -> Body {
    let points: Vec<([f64; 3], f64)> = (0..5).map(|_| (random.vector(), round(0.3 + 0.2 * random.next()))).collect();
    let mass: f64 = points.iter().map(|point| point.1).sum();
    let com: [f64; 3] = [0, 1, 2].map(|k| points.iter().map(|(p, m)| m * p[k]).sum::<f64>() / mass);
    let mut tensor = [[0.0; 3]; 3];
    for (p, m) in &points {
        let d = [0, 1, 2].map(|k| p[k] - com[k]);
        let square: f64 = d.iter().map(|x| x * x).sum();
        for i in 0..3 {
            for j in 0..3 {
                tensor[i][j] += m * (if i == j { square } else { 0.0 } - d[i] * d[j]);
            }
        }
    }
    Body { mass, com, tensor }
}

fn sample(seed: u64) -> Sample {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 7);
    let r = &mut random;
    let count = 2 + r.below(2);
    let bodies: Vec<Body> = (0..count).map(|_| body(r)).collect();
    let mut text = format!("world {{ gravity: {GRAVITY:?} }}");
    for (k, Body { mass, com, tensor: t }) in bodies.iter().enumerate() {
        let [a, b, c, d, e, f] = [t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]];
        text += &format!(
            "body b{k} {{ mass: {mass:?}, com: {com:?}, inertia: inertia({a:?}, {b:?}, {c:?}, {d:?}, {e:?}, {f:?}) }}
            output com_{k} = b{k}.at({com:?}).position; output com_acceleration_{k} = b{k}.at({com:?}).acceleration;
            output turn_{k} = b{k}.rotation; output jacobian_{k} = b{k}.at({:?}).jacobian;
            output twist_{k} = b{k}.at({:?}).twist;",
            [0.5, -0.25, 0.125],
            [0.5, -0.25, 0.125]
        );
    }
    let (mut joints, mut loads) = (Vec::new(), Vec::new());
    let mut told = vec!["moving".to_owned()];
    text += "output moving = kinetic();";
    let kinds: [(&str, &[&str]); 12] = [
        ("Revolute { axis: AXIS", &["angle"]),
        ("Revolute { armature: 0.25, axis: AXIS", &["angle"]),
        ("Prismatic { axis: AXIS", &["travel"]),
        ("Screw { pitch: 0.25, axis: AXIS", &["angle"]),
        ("Cylindrical { axis: AXIS", &["travel", "angle"]),
        ("Universal { axes: [X, -Z]", &["first", "second"]),
        ("Planar { axis: AXIS", &["x", "y", "angle"]),
        ("PinSlot { axis: [1, 2, 2], slide: [2, 1, -2]", &["travel", "angle"]),
        ("Planar { axes: [[1, 2, 2], [2, 1, -2]]", &["x", "y", "angle"]),
        ("Ball { coordinates: RollPitchYaw", &["roll", "pitch", "yaw"]),
        ("Ball { coordinates: Quaternion", &[]),
        ("Free { coordinates: RollPitchYaw", &["x", "y", "z", "roll", "pitch", "yaw"]),
    ];
    for child in 0..count {
        let parent = if child == 0 { None } else { Some(r.below(child + 1)).filter(|k| *k > 0).map(|k| k - 1) };
        let (kind, names) = kinds[r.below(kinds.len())];
        let axis = if r.below(4) == 0 { "-Y".to_owned() } else { format!("{:?}", r.vector().map(|x| x + 0.01)) };
        let kind = kind.replace("AXIS", &axis);
        let separator = if kind.ends_with('{') { "" } else { "," };
        let (at, from) = (r.frame(&format!("b{child}")), r.frame(&name(parent)));
        text += &format!(
            "joint j{child}: {kind}{separator} parent: {from}, child: {at} }} output at_{child} = {at}.position;"
        );
        joints.push(Joint { parent, child });
        for coordinate in names.iter() {
            if r.below(2) == 0 {
                continue;
            }
            let k = loads.len();
            let (a, b, c) = (round(2.0 + r.next()), round(0.3 + 0.2 * r.next()), round(r.next()));
            text += &match r.below(3) {
                0 => format!("force f{k}: Effort {{ joint: j{child}.{coordinate}, value: {a:?} * cos(t) }}"),
                1 => format!("force f{k}: Spring {{ joint: j{child}.{coordinate}, stiffness: {a:?}, rest: {c:?} }}"),
                _ => format!(
                    "force f{k}: SpringDamper {{ joint: j{child}.{coordinate}, stiffness: {a:?}, damping: {b:?}, rest: {c:?} }}"
                ),
            };
            text += &format!(
                "output coordinate_of_{k} = [j{child}.{coordinate}, j{child}.{coordinate}.rate, j{child}.{coordinate}.accel,
                j{child}.{coordinate}.effort];"
            );
            told.push(format!("coordinate_of_{k}"));
            loads.push(Load::OnJoint);
        }
    }
    for _ in 0..2 {
        let k = loads.len();
        let (one, value) = (r.below(count), r.vector());
        match r.below(3) {
            0 => {
                let at = r.frame(&format!("b{one}"));
                text += &format!(
                    "force f{k}: Force {{ at: {at}, value: {value:?}, axes: ground }} output load_{k} = {at}.position;"
                );
                loads.push(Load::Force { body: one, value });
            }
            1 => {
                text += &format!("force f{k}: Torque {{ at: b{one}, value: {value:?}, axes: ground }}");
                loads.push(Load::Torque { body: one, value });
            }
            _ => {
                let other = Some(r.below(count)).filter(|k| *k != one);
                let data = [round(3.0 + r.next()), round(0.4 + 0.2 * r.next()), round(1.0 + 0.5 * r.next())];
                let [a, b] = [other, Some(one)].map(|body| r.frame(&name(body)));
                text += &format!(
                    "force f{k}: SpringDamper {{ between: [{a}, {b}], stiffness: {:?}, damping: {:?}, length: {:?} }}
                    output line_{k} = [{a}.position, {b}.position, {a}.velocity, {b}.velocity];",
                    data[0], data[1], data[2]
                );
                loads.push(Load::Line { bodies: [other, Some(one)], data });
            }
        }
    }
    let mut held = Vec::new();
    let last = count - 1;
    match r.below(4) {
        0 => {
            let [a, b] = [r.frame("ground"), r.frame(&format!("b{last}"))];
            text += &format!("constraint rod: Rod {{ between: [{a}, {b}], length: 1.5 }}");
            held.push(last);
        }
        1 => {
            let point = r.frame(&format!("b{last}"));
            let (normal, first) = (r.vector().map(|x| x + 0.01), r.frame("b0"));
            text += &format!("constraint plane = dot({point}.position - {first}.position, {normal:?}) - 0.25;");
            held.extend([0, last]);
        }
        _ => {}
    }
    for k in 0..loads.len() {
        text += &format!("output power_{k} = f{k}.power;");
        told.push(format!("power_{k}"));
    }
    Sample { text, bodies, joints, loads, told, held }
}

/// What a refusal may say: all of these stand in the tests of the analysis.
fn is_known(refusal: &str) -> bool {
    ["quaternion", "can't be reduced", "no freedom", "cannot close", "wrong way", "redundant", "singular"]
        .iter()
        .any(|part| refusal.contains(part))
}

#[test]
fn random_outputs() {
    let wanted: Option<u64> = std::env::var("MULTIBODY_MECHANISMS").ok().and_then(|text| text.parse().ok());
    let bound = if wanted.is_some() { Duration::MAX } else { Duration::from_secs(20) };
    let start = Instant::now();
    let (mut models, mut refused) = (0, 0);
    for seed in 1..=wanted.unwrap_or(10) {
        if start.elapsed() > bound {
            break;
        }
        let sample = sample(seed);
        let mechanism = Mechanism::new(&sample.text);
        let base = match mechanism.try_case("formulation { constraints: Multipliers }", true) {
            Ok(base) => base,
            Err(refusal) => {
                assert!(is_known(&refusal), "{refusal} in {}", sample.text);
                refused += 1;
                continue;
            }
        };
        let Some(motion) = (1..20).find_map(|start| mechanism.motion(&base, start)) else {
            refused += 1;
            continue;
        };
        let point = mechanism.adopt(&base, &base, &motion);
        let outputs = base.outputs(&point);
        models += 1;
        let what = format!("seed {seed}");
        jets(&what, &base, &point, &sample);
        laws(&what, &sample, &outputs);
        columns(&what, &base, &point, &sample);
        for formulation in FORMULATIONS {
            let what = format!("{what}, {formulation}");
            let case = match mechanism.try_case(formulation, false) {
                Ok(case) => case,
                Err(refusal) => {
                    assert!(is_known(&refusal), "{what}: {refusal} in {}", sample.text);
                    refused += 1;
                    continue;
                }
            };
            models += 1;
            let point = mechanism.adopt(&case, &base, &motion);
            let found = case.outputs(&point);
            columns(&what, &case, &point, &sample);
            laws(&what, &sample, &found);
            let bodies = (0..sample.bodies.len()).flat_map(|k| {
                ["velocity", "spin", "acceleration", "spin_rate", "com", "turn", "twist"]
                    .map(|name| format!("{name}_{k}"))
            });
            let determined = base.structure.dropped.is_empty() && case.structure.dropped.is_empty();
            let reactions = (0..sample.joints.len()).filter(|_| determined).map(|k| format!("reaction_{k}"));
            for name in bodies.chain(reactions).chain(sample.told.iter().cloned()) {
                close(&format!("{what}, {name}"), &found[&name], &outputs[&name], 1e-7);
            }
        }
    }
    println!("{models} models, {refused} refused");
    assert!(models > 2 * refused, "{models} models, {refused} refused");
}

/// Velocities are the rates of positions, accelerations those of velocities, and energy is what power makes of it.
fn jets(what: &str, case: &Case, point: &Point, sample: &Sample) {
    let rates = case.motion_rates(point);
    let along = |name: &str| {
        case.derivative(|h| {
            let outputs = case.outputs(&case.along(point, h, &rates));
            outputs[name].clone()
        })
    };
    let now = case.outputs(point);
    let check = |name: &str, found: &[f64], rate: &[f64]| close(&format!("{what}, {name}"), found, rate, 2e-6);
    for k in 0..sample.bodies.len() {
        check("acceleration", &now[&format!("acceleration_{k}")], &along(&format!("velocity_{k}")));
        check("velocity", &now[&format!("velocity_{k}")], &along(&format!("pose_{k}"))[..3]);
        check("angular acceleration", &now[&format!("spin_rate_{k}")], &along(&format!("spin_{k}")));
        // R' = w x R
        let (turn, spin) = (&now[&format!("turn_{k}")], &now[&format!("spin_{k}")]);
        let turned: Vec<f64> = (0..9)
            .map(|at| {
                let (i, j) = (at / 3, at % 3);
                let (a, b) = ((i + 1) % 3, (i + 2) % 3);
                spin[a] * turn[3 * b + j] - spin[b] * turn[3 * a + j]
            })
            .collect();
        check("angular velocity", &turned, &along(&format!("turn_{k}")));
    }
    let gravity: f64 = (0..sample.bodies.len())
        .map(|k| {
            let rate = along(&format!("com_{k}"));
            sample.bodies[k].mass * (0..3).map(|i| GRAVITY[i] * rate[i]).sum::<f64>()
        })
        .sum();
    let power: f64 = (0..sample.loads.len()).map(|k| now[&format!("power_{k}")][0]).sum();
    check("power", &[gravity + power], &along("moving"));
}

/// Newton's and Euler's laws of each body about its centre of mass.
fn laws(what: &str, sample: &Sample, now: &HashMap<String, Vec<f64>>) {
    let vector = |name: String| -> [f64; 3] { std::array::from_fn(|k| now[&name][k]) };
    let count = sample.bodies.len();
    let coms: Vec<[f64; 3]> = (0..count).map(|k| vector(format!("com_{k}"))).collect();
    let mut forces = vec![[0.0; 3]; count];
    let mut moments = vec![[0.0; 3]; count];
    let mut act = |body: Option<usize>, sign: f64, at: [f64; 3], force: [f64; 3], moment: [f64; 3]| {
        let Some(k) = body else { return };
        let arm: [f64; 3] = std::array::from_fn(|i| at[i] - coms[k][i]);
        let lever = cross(arm, force);
        for i in 0..3 {
            forces[k][i] += sign * force[i];
            moments[k][i] += sign * (moment[i] + lever[i]);
        }
    };
    for (k, joint) in sample.joints.iter().enumerate() {
        let (at, reaction) = (vector(format!("at_{k}")), &now[&format!("reaction_{k}")]);
        let (force, moment) = ([0, 1, 2].map(|i| reaction[i]), [0, 1, 2].map(|i| reaction[3 + i]));
        act(Some(joint.child), 1.0, at, force, moment);
        act(joint.parent, -1.0, at, force, moment);
    }
    for (k, load) in sample.loads.iter().enumerate() {
        match load {
            Load::Force { body, value } => act(Some(*body), 1.0, vector(format!("load_{k}")), *value, [0.0; 3]),
            Load::Torque { body, value } => act(Some(*body), 1.0, [0.0; 3], [0.0; 3], *value),
            Load::Line { bodies, data } => {
                let ends = &now[&format!("line_{k}")];
                let part = |at: usize| -> [f64; 3] { std::array::from_fn(|i| ends[3 * at + i]) };
                let way: [f64; 3] = std::array::from_fn(|i| part(1)[i] - part(0)[i]);
                let rate: [f64; 3] = std::array::from_fn(|i| part(3)[i] - part(2)[i]);
                let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
                let speed = (0..3).map(|i| way[i] * rate[i]).sum::<f64>() / length;
                let tension = data[0] * (length - data[2]) + data[1] * speed;
                let pull = way.map(|x| x * tension / length);
                act(bodies[0], 1.0, part(0), pull, [0.0; 3]);
                act(bodies[1], -1.0, part(1), pull, [0.0; 3]);
            }
            Load::OnJoint => {}
        }
    }
    for (k, body) in sample.bodies.iter().enumerate().filter(|(k, _)| !sample.held.contains(k)) {
        let a = vector(format!("com_acceleration_{k}"));
        let (w, alpha) = (vector(format!("spin_{k}")), vector(format!("spin_rate_{k}")));
        let r: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| now[&format!("turn_{k}")][3 * i + j]));
        let tensor = times(&times(&r, &body.tensor), &transpose(&r));
        let force: Vec<f64> = (0..3).map(|i| body.mass * (a[i] - GRAVITY[i])).collect();
        let moment = plus(&apply(&tensor, &alpha), &cross(w, apply(&tensor, &w)));
        close(&format!("{what}, Newton for b{k}"), &forces[k], &force, 1e-8);
        close(&format!("{what}, Euler for b{k}"), &moments[k], &moment, 1e-8);
    }
}

/// Columns of Jacobians against twists.
fn columns(what: &str, case: &Case, point: &Point, sample: &Sample) {
    use multibody_engine::contracts::symbol::Symbol;
    let state = case.structure.state.clone();
    let moved = |column: Option<usize>| {
        let mut point = point.clone();
        for (k, coordinate) in state.iter().enumerate() {
            let symbol = Symbol::Velocity { joint: coordinate.joint, component: coordinate.index };
            point.set(symbol, if column == Some(k) { 1.0 } else { 0.0 });
        }
        case.outputs(&point)
    };
    let still = moved(None);
    for column in 0..state.len() {
        let moved = moved(Some(column));
        for k in 0..sample.bodies.len() {
            let (a, b) = (&moved[&format!("twist_{k}")], &still[&format!("twist_{k}")]);
            let expected: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            let jacobian = &still[&format!("jacobian_{k}")];
            let found: Vec<f64> = (0..6).map(|row| jacobian[row * state.len() + column]).collect();
            close(&format!("{what}, column {column} of b{k}"), &found, &expected, 1e-9);
        }
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl Case {
    /// Velocities and accelerations of all coordinates of the tree, where all of them are in the state.
    fn motion_rates(&self, point: &Point) -> [Vec<f64>; 2] {
        let found = self.candidate(FunctionKind::ForwardDynamics, 0, point);
        let accelerations = found[..self.structure.freedoms()].to_vec();
        [self.velocity(point), accelerations]
    }

    fn along(&self, point: &Point, h: f64, [v, a]: &[Vec<f64>; 2]) -> Point {
        let mean: Vec<f64> = v.iter().zip(a).map(|(v, a)| v + 0.5 * h * a).collect();
        self.displaced(point, h, &mean, a, &[])
    }
}
