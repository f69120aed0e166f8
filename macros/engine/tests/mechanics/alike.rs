//! One mechanism in several formulations: the same motion in each, found from a closed configuration in relative
//! coordinates, and what bodies and joints do in it.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::Means;
use multibody_engine::model::joint_kinds::JointKind;
use multibody_engine::model::types::{BodyRef, Coordinate, JointId};

use super::support::*;

/// A mechanism without its formulation.
pub(crate) struct Mechanism {
    /// Items of the model.
    pub(crate) items: String,
    bodies: Vec<String>,
    /// Scalar coordinates of the tree: joint, number, how outputs address it.
    coordinates: Vec<(String, usize, String)>,
    joints: Vec<String>,
}

/// Where everything is and how it moves.
pub(crate) struct Motion {
    /// By body: position, quaternion, velocity, angular velocity in the world.
    bodies: Vec<[Vec<f64>; 4]>,
    /// By scalar coordinate: value and rate.
    coordinates: Vec<[f64; 2]>,
    from: Vec<(Symbol, f64)>,
}

impl Mechanism {
    pub(crate) fn new(items: &str) -> Mechanism {
        let model = model_of(items);
        let name = |joint: JointId| model.joints[joint].place.field.to_string();
        let bodies = model.bodies.iter().map(|body| body.place.field.to_string()).collect();
        let mut coordinates = Vec::new();
        for &joint in &model.tree {
            let kind = model.joints[joint].kind;
            let names =
                kind.freedoms.iter().filter(|_| !kind.has_quaternion()).map(|freedom| &freedom.name).enumerate();
            coordinates.extend(names.map(|(k, text)| (name(joint), k, format!("{}.{text}", name(joint)))));
        }
        let joints = (0..model.joints.len()).map(|k| name(JointId(k))).collect();
        Mechanism { items: items.to_owned(), bodies, coordinates, joints }
    }

    /// With outputs that tell the motion, accelerations and reactions.
    pub(crate) fn case(&self, formulation: &str, relative: bool) -> Case {
        self.try_case(formulation, relative).unwrap_or_else(|refusal| panic!("{refusal} in {}", self.items))
    }

    /// The same, or why the formulation is refused.
    pub(crate) fn try_case(&self, formulation: &str, relative: bool) -> Result<Case, String> {
        let reactions = (0..self.joints.len()).map(|k| format!("output reaction_{k} = {}.reaction;", self.joints[k]));
        self.with_motion(&format!("{formulation} {}", reactions.collect::<String>()), relative)
    }

    /// Without reactions, which loops may share.
    pub(crate) fn with_motion(&self, formulation: &str, relative: bool) -> Result<Case, String> {
        let mut text = format!("{} {formulation}", self.items);
        for (k, body) in self.bodies.iter().enumerate() {
            text += &format!(
                "output pose_{k} = {body}.pose; output velocity_{k} = {body}.velocity;
                output spin_{k} = {body}.angular_velocity; output acceleration_{k} = {body}.acceleration;
                output spin_rate_{k} = {body}.angular_acceleration;"
            );
        }
        for (k, (_, _, address)) in self.coordinates.iter().enumerate().filter(|_| relative) {
            text += &format!("output coordinate_{k} = [{address}, {address}.rate];");
        }
        try_case(&text)
    }

    /// A random motion that the loops allow, in relative coordinates with multipliers.
    pub(crate) fn motion(&self, case: &Case, seed: u64) -> Option<Motion> {
        self.motion_within(case, seed, 1.0)
    }

    /// One with coordinates up to this.
    pub(crate) fn motion_within(&self, case: &Case, seed: u64, greatest: f64) -> Option<Motion> {
        let mut point = case.random(seed);
        for (joint, index, _) in &self.coordinates {
            let symbol = Symbol::Position { joint: case.joint(joint), component: *index };
            let value = point.get(symbol);
            point.set(symbol, greatest * value);
        }
        self.motion_from(case, &point)
    }

    /// One from a point near by, in which coordinates that no loop concerns stay.
    pub(crate) fn motion_from(&self, case: &Case, point: &Point) -> Option<Motion> {
        let point = closed(case, point)?;
        let outputs = case.outputs(&point);
        let bodies = (0..self.bodies.len()).map(|k| {
            let get = |what: &str| outputs[&format!("{what}_{k}")].clone();
            let pose = get("pose");
            [pose[..3].to_vec(), pose[3..].to_vec(), get("velocity"), get("spin")]
        });
        let bodies = bodies.collect();
        let coordinates = (0..self.coordinates.len()).map(|k| {
            let pair = &outputs[&format!("coordinate_{k}")];
            [pair[0], pair[1]]
        });
        let coordinates = coordinates.collect();
        let from = case.derivation.symbols.iter().map(|&symbol| (symbol, point.get(symbol))).collect();
        Some(Motion { bodies, coordinates, from })
    }

    /// The same motion in another formulation.
    pub(crate) fn adopt(&self, case: &Case, of: &Case, motion: &Motion) -> Point {
        let mut point = case.random(1);
        // What has one meaning everywhere; joints keep their places but for implicit ones.
        let name = |case: &Case, joint: JointId| {
            let joint = &case.model.joints[joint];
            (joint.place.field.to_string(), joint.kind.freedoms())
        };
        for &symbol in &case.derivation.symbols {
            let same = |other: Symbol| match (symbol, other) {
                (Symbol::Position { joint, component: c }, Symbol::Position { joint: j, component: d })
                | (Symbol::Velocity { joint, component: c }, Symbol::Velocity { joint: j, component: d }) => {
                    c == d && name(case, joint) == name(of, j)
                }
                (Symbol::Position { .. } | Symbol::Velocity { .. }, _) => false,
                (a, b) => a == b,
            };
            if let Some(&(_, value)) = motion.from.iter().find(|(other, _)| same(*other)) {
                point.set(symbol, value);
            }
        }
        for (number, joint) in case.model.joints.iter().enumerate() {
            let id = JointId(number);
            let Some(body) = self.bodies.iter().position(|body| joint.place.field == body) else { continue };
            assert!(joint.kind.is_free() && joint.parent.body == BodyRef::Ground);
            place(&mut point, id, joint.kind, &motion.bodies[body]);
        }
        for ((joint, index, _), [value, rate]) in self.coordinates.iter().zip(&motion.coordinates) {
            let id = case.joint(joint);
            if case.model.cuts.contains(&id) {
                continue;
            }
            point.set(Symbol::Position { joint: id, component: *index }, *value);
            point.set(Symbol::Velocity { joint: id, component: *index }, *rate);
        }
        let mut guesses = Vec::new();
        for step in &case.structure.steps {
            if let Means::Newton { .. } = step.means {
                guesses.extend(&step.unknowns);
            }
        }
        for (index, &Coordinate { joint, index: component }) in guesses.iter().enumerate() {
            let value = point.get(Symbol::Position { joint, component });
            point.set(Symbol::Guess { index }, value);
        }
        point
    }

    pub(crate) fn names(&self) -> (usize, usize) {
        (self.bodies.len(), self.joints.len())
    }
}

/// Sets a free body's coordinates.
fn place(point: &mut Point, joint: JointId, kind: &JointKind, [position, q, velocity, spin]: &[Vec<f64>; 4]) {
    for component in 0..3 {
        point.set(Symbol::Position { joint, component }, position[component]);
        point.set(Symbol::Velocity { joint, component }, velocity[component]);
    }
    let rotation = of_quaternion(q);
    if kind.has_quaternion() {
        let own = apply(&transpose(&rotation), &[spin[0], spin[1], spin[2]]);
        for (component, &q) in q.iter().enumerate() {
            point.set(Symbol::Position { joint, component: 3 + component }, q);
        }
        for (component, &rate) in own.iter().enumerate() {
            point.set(Symbol::Velocity { joint, component: 3 + component }, rate);
        }
        return;
    }
    let m = rotation;
    let yaw = m[1][0].atan2(m[0][0]);
    let pitch = (-m[2][0]).atan2(m[0][0].hypot(m[1][0]));
    let roll = m[2][1].atan2(m[2][2]);
    // Angular velocity = roll' Rz Ry x + pitch' Rz y + yaw' z.
    let (flat, w) = (pitch.cos(), spin);
    let along = w[0] * yaw.cos() + w[1] * yaw.sin();
    let rates = [along / flat, w[1] * yaw.cos() - w[0] * yaw.sin(), w[2] + along * pitch.tan()];
    for (k, (angle, rate)) in [roll, pitch, yaw].into_iter().zip(rates).enumerate() {
        point.set(Symbol::Position { joint, component: 3 + k }, angle);
        point.set(Symbol::Velocity { joint, component: 3 + k }, rate);
    }
}

/// The point near by at which positions and velocities obey the equations that have multipliers.
fn closed(case: &Case, start: &Point) -> Option<Point> {
    let (n, m) = (case.structure.state.len(), case.structure.rows.len());
    let mut point = start.clone();
    if m == 0 {
        return Some(point);
    }
    for _ in 0..60 {
        let residual = case.candidate(FunctionKind::Constraints, 0, &point);
        let size = residual.iter().fold(0.0_f64, |size, r| size.max(r.abs()));
        if size < 1e-14 {
            break;
        }
        let jacobian = case.candidate(FunctionKind::ConstraintJacobian, 0, &point);
        let mut step = least(&jacobian, &residual, n)?;
        let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.5 {
            step.iter_mut().for_each(|x| *x *= 0.5 / length);
        }
        let freedoms = case.structure.roles.iter().map(Vec::len).sum();
        let mut all = vec![0.0; freedoms];
        let mut first = Vec::new();
        let mut count = 0;
        for joints in &case.structure.roles {
            first.push(count);
            count += joints.len();
        }
        for (coordinate, x) in case.structure.state.iter().zip(&step) {
            all[first[coordinate.joint.0] + coordinate.index] = -x;
        }
        point = case.moved(&point, &all);
    }
    let residual = case.candidate(FunctionKind::Constraints, 0, &point);
    if residual.iter().any(|r| r.abs() > 1e-12) {
        return None;
    }
    let jacobian = case.candidate(FunctionKind::ConstraintJacobian, 0, &point);
    for _ in 0..2 {
        let rate = case.candidate(FunctionKind::ConstraintRate, 0, &point);
        let step = least(&jacobian, &rate, n)?;
        for (coordinate, x) in case.structure.state.iter().zip(&step) {
            let symbol = Symbol::Velocity { joint: coordinate.joint, component: coordinate.index };
            let value = point.get(symbol);
            point.set(symbol, value - x);
        }
    }
    Some(point)
}

/// The least x with G x = r, where G has full rank and is well conditioned.
fn least(jacobian: &[f64], r: &[f64], n: usize) -> Option<Vec<f64>> {
    let m = r.len();
    let row = |i: usize| &jacobian[i * n..(i + 1) * n];
    let mut a: Vec<Vec<f64>> = (0..m)
        .map(|i| {
            let mut line: Vec<f64> = (0..m).map(|j| row(i).iter().zip(row(j)).map(|(x, y)| x * y).sum()).collect();
            line.push(r[i]);
            line
        })
        .collect();
    for k in 0..m {
        let pivot = (k..m).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        if a[k][k].abs() < 1e-4 {
            return None;
        }
        for i in 0..m {
            if i != k {
                let factor = a[i][k] / a[k][k];
                let pivot = a[k].clone();
                a[i].iter_mut().zip(&pivot).skip(k).for_each(|(x, p)| *x -= factor * p);
            }
        }
    }
    let y: Vec<f64> = (0..m).map(|k| a[k][m] / a[k][k]).collect();
    Some((0..n).map(|j| (0..m).map(|i| row(i)[j] * y[i]).sum()).collect())
}
