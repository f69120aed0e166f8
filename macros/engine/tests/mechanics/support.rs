//! Models from text, functions as numbers.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics::Derivation;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::check;
use multibody_engine::model::types::{Joint, Model};
use multibody_engine::parse;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::SymbolId;

/// A model with its equations.
pub(crate) struct Case {
    pub(crate) model: Model,
    pub(crate) structure: Structure,
    pub(crate) derivation: Derivation,
}

/// Values of all symbols.
#[derive(Clone)]
pub(crate) struct Point {
    pub(crate) values: HashMap<Symbol, f64>,
}

/// Derives the body of `mod m { .. }`, preceded by `parts`.
pub(crate) fn case_with(parts: &str, body: &str) -> Case {
    derived(model_with(parts, body)).unwrap_or_else(|messages| panic!("{messages} in {body}"))
}

/// The same without parts, or why it is refused.
pub(crate) fn try_case(body: &str) -> Result<Case, String> {
    derived(model_of(body))
}

fn derived(model: Model) -> Result<Case, String> {
    let (structure, derivation) = multibody_engine::mechanics::of(&model).map_err(|list| {
        let messages: Vec<_> = list.iter().map(|complaint| complaint.message.as_str()).collect();
        messages.join("; ")
    })?;
    Ok(Case { model, structure, derivation })
}

/// The checked model of `mod m { .. }`.
pub(crate) fn model_of(body: &str) -> Model {
    model_with("", body)
}

/// The same, preceded by `parts`.
pub(crate) fn model_with(parts: &str, body: &str) -> Model {
    let text = format!("{parts} pub mod m {{ {body} }}");
    let tokens = text.parse().unwrap_or_else(|error| panic!("{error} in {text}"));
    let mut diagnostics = Diagnostics::default();
    let source = parse(tokens, &mut diagnostics);
    let models = check(&source, &mut diagnostics);
    let messages: Vec<&str> = diagnostics.errors().iter().map(|error| error.message.as_str()).collect();
    assert!(messages.is_empty(), "{messages:?}");
    models.into_iter().find(|model| model.name == "m").expect("a model")
}

pub(crate) fn case(body: &str) -> Case {
    case_with("", body)
}

/// Numbers between -1 and 1 (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn quaternion_start(joint: &Joint) -> Option<usize> {
    joint.kind.has_quaternion().then(|| joint.kind.turning().start)
}

impl Case {
    /// Params at their defaults, everything else random.
    pub(crate) fn random(&self, seed: u64) -> Point {
        let mut random = Random(seed);
        let mut values = HashMap::new();
        for &symbol in &self.derivation.symbols {
            let value = match symbol {
                Symbol::Param { param, element } => self.model.params[param].default[element],
                Symbol::UnknownPoint { component, .. } => [0.6, 0.8][component],
                _ => random.next(),
            };
            values.insert(symbol, value);
        }
        let mut point = Point { values };
        self.normalise(&mut point);
        point
    }

    /// Everything zero but params; quaternions one.
    pub(crate) fn rest(&self) -> Point {
        let mut point = self.random(0);
        for (symbol, value) in &mut point.values {
            if !matches!(symbol, Symbol::Param { .. }) {
                *value = 0.0;
            }
        }
        for (joint, start) in self.quaternions() {
            point.values.insert(Symbol::Position { joint, component: start }, 1.0);
        }
        point
    }

    fn quaternions(&self) -> Vec<(multibody_engine::model::types::JointId, usize)> {
        let joints = self.model.joints.iter().enumerate();
        joints
            .filter_map(|(k, joint)| Some((multibody_engine::model::types::JointId(k), quaternion_start(joint)?)))
            // Joints that close loops have no coordinates.
            .filter(|(id, _)| !self.model.cuts.contains(id))
            .collect()
    }

    fn normalise(&self, point: &mut Point) {
        for (joint, start) in self.quaternions() {
            let key = |k: usize| Symbol::Position { joint, component: start + k };
            let norm = (0..4).map(|k| point.values[&key(k)].powi(2)).sum::<f64>().sqrt();
            for k in 0..4 {
                *point.values.get_mut(&key(k)).expect("known") /= norm;
            }
        }
    }

    pub(crate) fn joint(&self, name: &str) -> multibody_engine::model::types::JointId {
        let joints = &self.model.joints;
        let index = joints.iter().position(|joint| joint.place.field == name).expect("a joint");
        multibody_engine::model::types::JointId(index)
    }

    /// All numbers of a function by its candidate.
    pub(crate) fn candidate(&self, kind: FunctionKind, candidate: usize, point: &Point) -> Vec<f64> {
        let function = self.derivation.functions.iter().find(|f| f.kind == kind).expect("derived");
        let results = &function.candidates[candidate].1.list;
        let symbols = |id: SymbolId| point.values[&self.derivation.symbols[id.0]];
        Evaluator::new(&self.derivation.graph, Real { symbols: &symbols }).run(results)
    }

    pub(crate) fn candidates(&self, kind: FunctionKind) -> usize {
        self.derivation.functions.iter().find(|f| f.kind == kind).map_or(0, |f| f.candidates.len())
    }

    /// Numbers of a function; all candidates agree, near dead centres as far as positions are known.
    pub(crate) fn eval(&self, kind: FunctionKind, point: &Point) -> Vec<f64> {
        let first = self.candidate(kind, 0, point);
        for k in 1..self.candidates(kind) {
            let other = self.candidate(kind, k, point);
            let tolerance = if is_close(&other, &first, 1e-9) { 1e-9 } else { 4.0 * self.blur(kind, point, &first) };
            close(&format!("{kind:?}, candidate {k}"), &other, &first, tolerance.min(1e-6));
        }
        first
    }

    /// How far a function moves with the last digits of positions, in the measure of [`close`].
    fn blur(&self, kind: FunctionKind, point: &Point, here: &[f64]) -> f64 {
        let scale = 1.0 + here.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let mut random = Random(7);
        let mut moved = 0.0_f64;
        for _ in 0..20 {
            let mut near = point.clone();
            for (symbol, value) in &mut near.values {
                if matches!(symbol, Symbol::Position { .. }) {
                    *value *= 1.0 + 4.0 * f64::EPSILON * random.next();
                }
            }
            let there = self.candidate(kind, 0, &near);
            moved = there.iter().zip(here).fold(moved, |m, (a, b)| m.max((a - b).abs()));
        }
        moved / scale
    }

    /// Numbers of one output.
    pub(crate) fn output(&self, name: &str, point: &Point) -> Vec<f64> {
        self.outputs(point).remove(name).unwrap_or_else(|| panic!("no output {name}"))
    }

    /// Numbers of all outputs.
    pub(crate) fn outputs(&self, point: &Point) -> HashMap<String, Vec<f64>> {
        let all = self.eval(FunctionKind::Outputs, point);
        let mut start = 0;
        let outputs = self.model.outputs.iter().map(|output| {
            let end = start + width(&output.value.ty, self.structure.freedoms());
            let values = all[start..end].to_vec();
            start = end;
            (output.place.field.to_string(), values)
        });
        outputs.collect()
    }

    pub(crate) fn dof(&self) -> usize {
        self.model.joints.iter().map(|joint| joint.kind.freedoms()).sum()
    }

    pub(crate) fn velocity(&self, point: &Point) -> Vec<f64> {
        self.list(point, |symbol| matches!(symbol, Symbol::Velocity { .. }))
    }

    pub(crate) fn acceleration(&self, point: &Point) -> Vec<f64> {
        self.list(point, |symbol| matches!(symbol, Symbol::Acceleration { .. }))
    }

    fn list(&self, point: &Point, wanted: impl Fn(&Symbol) -> bool) -> Vec<f64> {
        self.derivation.symbols.iter().filter(|symbol| wanted(symbol)).map(|symbol| point.values[symbol]).collect()
    }

    /// The point after time h along rates of positions `v`, velocities `a`, and states `x`.
    pub(crate) fn displaced(&self, point: &Point, h: f64, v: &[f64], a: &[f64], x: &[f64]) -> Point {
        let mut next = point.clone();
        *next.values.get_mut(&Symbol::Time).expect("time") += h;
        let mut first = 0;
        for (k, joint) in self.model.joints.iter().enumerate() {
            let id = multibody_engine::model::types::JointId(k);
            if self.model.cuts.contains(&id) {
                continue;
            }
            let straight = quaternion_start(joint).unwrap_or(joint.kind.freedoms());
            for component in 0..straight {
                *next.values.get_mut(&Symbol::Position { joint: id, component }).expect("known") +=
                    h * v[first + component];
            }
            if let Some(start) = quaternion_start(joint) {
                let w = &v[first + start..first + start + 3];
                let key = |c: usize| Symbol::Position { joint: id, component: start + c };
                let q: Vec<f64> = (0..4).map(|c| point.values[&key(c)]).collect();
                let angle = w.iter().map(|x| x * x).sum::<f64>().sqrt() * h;
                let sinc = if angle == 0.0 { 0.5 * h } else { (0.5 * angle).sin() / angle * h };
                let turn = [(0.5 * angle).cos(), w[0] * sinc, w[1] * sinc, w[2] * sinc];
                for (c, value) in multiply_quaternions(&q, &turn).into_iter().enumerate() {
                    next.values.insert(key(c), value);
                }
            }
            for component in 0..joint.kind.freedoms() {
                *next.values.get_mut(&Symbol::Velocity { joint: id, component }).expect("known") +=
                    h * a[first + component];
            }
            first += joint.kind.freedoms();
        }
        for (k, rate) in x.iter().enumerate() {
            let state = multibody_engine::model::types::StateId(k);
            *next.values.get_mut(&Symbol::State { state }).expect("known") += h * rate;
        }
        next
    }

    /// The point after a displacement, velocities and everything else as they were.
    pub(crate) fn moved(&self, point: &Point, displacement: &[f64]) -> Point {
        let still = vec![0.0; displacement.len()];
        let mut next = self.displaced(point, 1.0, displacement, &still, &[]);
        next.set(Symbol::Time, point.get(Symbol::Time));
        next
    }

    /// The derivative of a function along the flow of the forward dynamics.
    pub(crate) fn rate_along_flow(&self, point: &Point, f: impl Fn(&Point) -> Vec<f64>) -> Vec<f64> {
        let rates = self.eval(FunctionKind::ForwardDynamics, point);
        let (a, x) = rates.split_at(self.dof());
        let v = self.velocity(point);
        self.derivative(|h| f(&self.displaced_curved(point, h, &v, a, x)))
    }

    /// Positions to second order, so that central differences see a smooth curve.
    fn displaced_curved(&self, point: &Point, h: f64, v: &[f64], a: &[f64], x: &[f64]) -> Point {
        let mean: Vec<f64> = v.iter().zip(a).map(|(v, a)| v + 0.5 * h * a).collect();
        self.displaced(point, h, &mean, a, x)
    }

    /// Central differences of order four.
    pub(crate) fn derivative(&self, f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
        let h = 2e-4;
        let [a, b, c, d] = [f(-2.0 * h), f(-h), f(h), f(2.0 * h)];
        (0..a.len()).map(|k| (a[k] - 8.0 * b[k] + 8.0 * c[k] - d[k]) / (12.0 * h)).collect()
    }
}

impl Point {
    pub(crate) fn set(&mut self, symbol: Symbol, value: f64) {
        assert!(self.values.insert(symbol, value).is_some(), "{symbol:?} is no symbol");
    }

    pub(crate) fn get(&self, symbol: Symbol) -> f64 {
        self.values[&symbol]
    }
}

fn width(ty: &multibody_engine::model::types::Type, dof: usize) -> usize {
    use multibody_engine::model::types::Type;
    match ty {
        Type::Scalar | Type::Bool => 1,
        Type::Vec3 => 3,
        Type::Rotation => 9,
        Type::Pose => 7,
        Type::Twist | Type::Wrench => 6,
        Type::Jacobian => 6 * dof,
        Type::Array(element, count) => count * width(element, dof),
    }
}

pub(crate) fn multiply_quaternions(p: &[f64], q: &[f64]) -> [f64; 4] {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// max |a - b| at most `tolerance` times 1 + max |b|
pub(crate) fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    let error = a.iter().zip(b).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
    assert!(is_close(a, b, tolerance), "{what}: off by {error:e}\n{a:?}\n{b:?}");
}

fn is_close(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    let scale = 1.0 + b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let error = a.iter().zip(b).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
    let sound = a.iter().chain(b).all(|x| x.is_finite());
    a.len() == b.len() && sound && error <= tolerance * scale
}

pub(crate) type Matrix = [[f64; 3]; 3];

pub(crate) const ONE: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(crate) fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

pub(crate) fn transpose(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

pub(crate) fn apply(a: &Matrix, v: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| a[i][k] * v[k]).sum())
}

pub(crate) fn plus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}

/// Rodrigues' formula; the axis may have any length.
pub(crate) fn turn(axis: [f64; 3], angle: f64) -> Matrix {
    let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let u = axis.map(|x| x / norm);
    let (s, c) = angle.sin_cos();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let cross = if i == j {
                0.0
            } else if (i + 1) % 3 == j {
                -u[3 - i - j]
            } else {
                u[3 - i - j]
            };
            (if i == j { c } else { 0.0 }) + (1.0 - c) * u[i] * u[j] + s * cross
        })
    })
}

pub(crate) fn of_quaternion(q: &[f64]) -> Matrix {
    let norm = (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    if norm == 0.0 { ONE } else { turn([q[1], q[2], q[3]], 2.0 * norm.atan2(q[0])) }
}
