//! Cycles of joints for tests: written as segments for the solver, and evaluated in plain arithmetic.

use std::collections::HashMap;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::dynamics::tree::{Motion, Orientation};
use multibody_engine::solve::{Balance, Failure, Segment, Solution, Solved, Value, solve};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, ScalarNode};
use multibody_engine::symbolic::lower::Lowering;

use crate::rng::Rng;
use crate::transform::{IDENTITY, Transform, apply, cross, least_squares, turn};

#[derive(Clone)]
enum Element {
    Fixed { turns: Vec<(usize, Scalar)>, offset: [Scalar; 3] },
    Joint { motion: Motion, pitch: f64, symbol: Scalar },
}

/// A cycle with a value for every symbol.
pub(crate) struct Cycle {
    pub(crate) g: Graph,
    elements: Vec<Element>,
    segments: Vec<Segment>,
    /// By symbol; coordinates of balls are three angles about x, y and z.
    pub(crate) values: Vec<f64>,
    wanted: Vec<Scalar>,
}

/// A root that is nearly zero makes digits disappear; such draws are no test.
pub(crate) enum Outcome {
    /// How far the rest of the loop stays open, at worst and on the branch that was drawn.
    Solved {
        branches: usize,
        error: f64,
        drawn: f64,
    },
    Poor,
}

impl Cycle {
    pub(crate) fn new() -> Cycle {
        Cycle { g: Graph::new(), elements: Vec::new(), segments: Vec::new(), values: Vec::new(), wanted: Vec::new() }
    }

    /// A symbol with a value.
    pub(crate) fn known(&mut self, value: f64) -> Scalar {
        self.values.push(value);
        self.g.symbol()
    }

    pub(crate) fn literal(&mut self, value: f64) -> Scalar {
        self.g.decimal(value)
    }

    pub(crate) fn number(&self, s: Scalar) -> f64 {
        self.numbers(&[s])[0]
    }

    pub(crate) fn numbers(&self, list: &[Scalar]) -> Vec<f64> {
        Evaluator::new(&self.g, Real { symbols: &|id| self.values[id.0] }).run(list)
    }

    pub(crate) fn set(&mut self, symbol: Scalar, value: f64) {
        if let ScalarNode::Symbol(id) = self.g.node(symbol) {
            self.values[id.0] = value;
        }
    }

    /// First the offset, then the turns from left to right.
    pub(crate) fn fixed(&mut self, turns: &[(usize, Scalar)], offset: [Scalar; 3]) {
        let g = &mut self.g;
        let mut rotation = Rotation::IDENTITY;
        for &(axis, angle) in turns {
            let next = g.axis_rotation(axis, angle);
            rotation = g.compose(rotation, next);
        }
        let vector = g.vector(offset);
        self.segments.push(Segment::Fixed { rotation, offset: vector });
        self.elements.push(Element::Fixed { turns: turns.to_vec(), offset });
    }

    pub(crate) fn shift(&mut self, offset: [f64; 3]) {
        let offset = offset.map(|x| self.g.decimal(x));
        self.fixed(&[], offset);
    }

    fn joint(&mut self, motion: impl Fn(Scalar) -> Motion, pitch: f64, wanted: bool, truth: f64) -> Scalar {
        let pitch_literal = self.g.decimal(pitch);
        let motion = motion(pitch_literal);
        let symbol = self.known(truth);
        self.segments.push(Segment::Unknown { motion, symbol, wanted });
        self.elements.push(Element::Joint { motion, pitch, symbol });
        if wanted {
            self.wanted.push(symbol);
        }
        symbol
    }

    pub(crate) fn revolute(&mut self, axis: usize, wanted: bool, truth: f64) -> Scalar {
        self.joint(|_| Motion::Revolute(axis), 0.0, wanted, truth)
    }

    pub(crate) fn prismatic(&mut self, axis: usize, wanted: bool, truth: f64) -> Scalar {
        self.joint(|_| Motion::Prismatic(axis), 0.0, wanted, truth)
    }

    pub(crate) fn screw(&mut self, axis: usize, pitch: f64, wanted: bool, truth: f64) -> Scalar {
        self.joint(|pitch| Motion::Screw(axis, pitch), pitch, wanted, truth)
    }

    pub(crate) fn ball(&mut self, truth: [f64; 3]) {
        let quaternion = self.g.unit_quaternion();
        self.values.extend([truth[0], truth[1], truth[2], 0.0]);
        let motion = Motion::Ball(Orientation::Quaternion(quaternion));
        self.segments.push(Segment::Unknown { motion, symbol: quaternion[0], wanted: false });
        self.elements.push(Element::Joint { motion, pitch: 0.0, symbol: quaternion[0] });
    }

    /// Closes the cycle where it stands, by symbols for angles and offsets.
    pub(crate) fn close(&mut self) {
        let gap = self.transform().inverse();
        let r = gap.rotation;
        // Rz Ry Rx
        let angles = [r[1][0].atan2(r[0][0]), (-r[2][0]).asin(), r[2][1].atan2(r[2][2])];
        let turns: Vec<(usize, Scalar)> =
            [2, 1, 0].into_iter().zip(angles).map(|(axis, angle)| (axis, self.known(angle))).collect();
        let offset = gap.offset.map(|x| self.known(x));
        self.fixed(&turns, offset);
    }

    /// The same by angles alone, about a common centre.
    pub(crate) fn close_spherical(&mut self) {
        let r = self.transform().inverse().rotation;
        let angles = [r[1][0].atan2(r[0][0]), (-r[2][0]).asin(), r[2][1].atan2(r[2][2])];
        let turns: Vec<(usize, Scalar)> =
            [2, 1, 0].into_iter().zip(angles).map(|(axis, angle)| (axis, self.known(angle))).collect();
        self.fixed(&turns, [Scalar::ZERO; 3]);
    }

    /// The same on the z axis.
    pub(crate) fn close_axial(&mut self) {
        let gap = self.transform().inverse();
        let angle = self.known(gap.rotation[1][0].atan2(gap.rotation[0][0]));
        let z = self.known(gap.offset[2]);
        self.fixed(&[(2, angle)], [Scalar::ZERO, Scalar::ZERO, z]);
    }

    /// The same in the plane z = 0.
    pub(crate) fn close_planar(&mut self) {
        let gap = self.transform().inverse();
        let angle = self.known(gap.rotation[1][0].atan2(gap.rotation[0][0]));
        let [x, y, _] = gap.offset;
        let offset = [self.known(x), self.known(y), Scalar::ZERO];
        self.fixed(&[(2, angle)], offset);
    }

    fn steps(&self) -> Vec<Transform> {
        let unit = |axis: usize| std::array::from_fn(|k| f64::from(u8::from(k == axis)));
        let about = |axis: usize, angle: f64| Transform { rotation: turn(unit(axis), angle), offset: [0.0; 3] };
        let along = |axis: usize, x: f64| Transform { offset: unit(axis).map(|u: f64| u * x), ..IDENTITY };
        let step = |element: &Element| match element {
            Element::Fixed { turns, offset } => {
                let offset = self.numbers(offset);
                let start = Transform { offset: [offset[0], offset[1], offset[2]], ..IDENTITY };
                turns.iter().fold(start, |t, &(axis, angle)| t.then(&about(axis, self.number(angle))))
            }
            Element::Joint { motion, pitch, symbol } => {
                let x = self.number(*symbol);
                match *motion {
                    Motion::Revolute(axis) => about(axis, x),
                    Motion::Prismatic(axis) => along(axis, x),
                    Motion::Screw(axis, _) => about(axis, x).then(&along(axis, pitch * x)),
                    Motion::Ball(Orientation::Quaternion(q)) => {
                        let angles = self.numbers(&q);
                        (0..3).fold(IDENTITY, |t, k| t.then(&about(k, angles[k])))
                    }
                    Motion::Ball(Orientation::Turn(_)) => unreachable!("these cycles have quaternions"),
                }
            }
        };
        self.elements.iter().map(step).collect()
    }

    pub(crate) fn transform(&self) -> Transform {
        self.steps().iter().fold(IDENTITY, |t, step| t.then(step))
    }

    pub(crate) fn solve(&mut self, signs: &[bool]) -> Result<Solution, Failure> {
        let cycle = multibody_engine::solve::KinematicLoop { segments: self.segments.clone(), winding: None };
        solve(&mut self.g, &[cycle], signs)
    }

    /// Puts the solved values in; `None` where there is no real solution.
    pub(crate) fn put(&mut self, solution: &Solution) -> Option<()> {
        for solved in &solution.solved {
            let value = match solved.value {
                Value::Angle { cos, sin } => {
                    let [c, s] = self.numbers(&[cos, sin])[..] else { return None };
                    assert!(c.is_nan() || (c.hypot(s) - 1.0).abs() < 1e-9, "on the circle: {c} {s}, {}", solved.how);
                    s.atan2(c)
                }
                Value::Length(x) => self.number(x),
            };
            if !value.is_finite() {
                return None;
            }
            self.set(solved.symbol, value);
        }
        Some(())
    }

    /// Moves what was not solved for until the cycle closes; the error that is left.
    pub(crate) fn complete(&mut self, solution: &Solution) -> f64 {
        let is_solved = |s: Scalar| solution.solved.iter().any(|solved| solved.symbol == s);
        let open: Vec<(usize, Scalar, usize)> = self
            .elements
            .iter()
            .enumerate()
            .filter_map(|(at, element)| match element {
                Element::Joint { motion, symbol, .. } if !is_solved(*symbol) => Some((at, *motion, *symbol)),
                _ => None,
            })
            .flat_map(|(at, motion, symbol)| {
                let list =
                    if let Motion::Ball(Orientation::Quaternion(q)) = motion { q[..3].to_vec() } else { vec![symbol] };
                list.into_iter().enumerate().map(move |(k, s)| (at, s, k))
            })
            .collect();
        let mut rng = Rng::new(5);
        let mut best = self.transform().error();
        if open.is_empty() {
            return best;
        }
        for _ in 0..40 {
            for _ in 0..60 {
                let steps = self.steps();
                let mut before = IDENTITY;
                let mut columns = vec![[0.0; 6]; open.len()];
                for (at, step) in steps.iter().enumerate() {
                    for (column, &(_, _, k)) in columns.iter_mut().zip(&open).filter(|(_, o)| o.0 == at) {
                        *column = self.twist(at, &before, k);
                    }
                    before = before.then(step);
                }
                let error = before.error();
                best = best.min(error);
                if error < 2e-16 {
                    break;
                }
                let size = error.min(1.0);
                let change = least_squares(&columns, &before.residual(), 1e-13 + 1e-3 * size * size);
                for (&(_, symbol, _), dx) in open.iter().zip(change) {
                    let x = self.number(symbol);
                    self.set(symbol, x - dx.clamp(-0.7, 0.7));
                }
            }
            if best < 1e-11 {
                return best;
            }
            for &(_, symbol, _) in &open {
                self.set(symbol, rng.real(-3.0, 3.0));
            }
        }
        best
    }

    /// Change of the whole transform per change of one coordinate.
    fn twist(&self, at: usize, before: &Transform, k: usize) -> [f64; 6] {
        let Element::Joint { motion, pitch, .. } = &self.elements[at] else { return [0.0; 6] };
        let (direction, slide, turns) = match *motion {
            Motion::Revolute(axis) => (before.axis(axis), 0.0, true),
            Motion::Prismatic(axis) => (before.axis(axis), 1.0, false),
            Motion::Screw(axis, _) => (before.axis(axis), *pitch, true),
            Motion::Ball(Orientation::Quaternion(q)) => {
                let angles = self.numbers(&q);
                let unit = |axis: usize| -> [f64; 3] { std::array::from_fn(|i| f64::from(u8::from(i == axis))) };
                let local = (0..k).rev().fold(unit(k), |v, j| apply(&turn(unit(j), angles[j]), v));
                (apply(&before.rotation, local), 0.0, true)
            }
            Motion::Ball(Orientation::Turn(_)) => unreachable!("these cycles have quaternions"),
        };
        let angular = if turns { direction } else { [0.0; 3] };
        // Of the point of the closed cycle that lies at the origin.
        let swept = cross(before.offset, angular);
        let linear: [f64; 3] = std::array::from_fn(|i| swept[i] + slide * direction[i]);
        [angular[0], angular[1], angular[2], linear[0], linear[1], linear[2]]
    }

    /// All branches: each closes the cycle, no two are equal, equations and slopes fit, and one branch is the truth.
    pub(crate) fn check(&mut self) -> Result<Outcome, Failure> {
        let truth = self.values.clone();
        let signs = self.solve(&[])?.signs;
        let mut found: Vec<Vec<f64>> = Vec::new();
        let (mut worst, mut drawn, mut hit) = (0.0_f64, 0.0, false);
        for branch in 0..1_usize << signs {
            let choice: Vec<bool> = (0..signs).map(|k| branch >> k & 1 == 0).collect();
            self.values.resize(self.values.len().max(truth.len()), 0.0);
            self.values[..truth.len()].copy_from_slice(&truth);
            let solution = self.solve(&choice)?;
            let Some(()) = self.put(&solution) else { continue };
            let roots: Vec<Scalar> = solution.solved.iter().flat_map(|s| &s.roots).map(|root| root.value).collect();
            if self.numbers(&roots).iter().any(|r| r.abs() < 0.2) {
                return Ok(Outcome::Poor);
            }
            if let Some(outcome) = self.check_slopes(&solution) {
                return Ok(outcome);
            }
            self.check_rates(&solution);
            let wanted: Vec<f64> = self.numbers(&self.wanted.clone());
            let near = |a: &[f64], b: &[f64]| {
                a.iter()
                    .zip(b)
                    .all(|(x, y)| (x - y).abs() < 1e-7 || ((x - y).abs() - std::f64::consts::TAU).abs() < 1e-7)
            };
            assert!(!found.iter().any(|other| near(other, &wanted)), "two branches are one: {wanted:?}");
            let true_wanted: Vec<f64> = {
                let values = std::mem::replace(&mut self.values, truth.clone());
                let list = self.numbers(&self.wanted.clone());
                self.values = values;
                list
            };
            let here = near(&true_wanted, &wanted);
            found.push(wanted);
            let open = self.complete(&solution);
            hit |= here;
            drawn = if here { open } else { drawn };
            worst = worst.max(open);
        }
        assert!(hit, "the truth is among the branches {found:?}");
        self.values = truth;
        Ok(Outcome::Solved { branches: found.len(), error: worst, drawn })
    }

    /// Equations vanish, slopes are right, and rates agree with finite differences.
    fn check_slopes(&mut self, solution: &Solution) -> Option<Outcome> {
        for solved in &solution.solved {
            let [Balance { equation, inverse_slope }] = solved.balances[..] else { panic!("one equation each") };
            let slope = self.g.derivative(equation, &[(solved.symbol, Scalar::ONE)]);
            let [e, slope, inverse] = self.numbers(&[equation, slope, inverse_slope])[..] else {
                return None;
            };
            if slope.abs() < 0.1 {
                return Some(Outcome::Poor);
            }
            assert!(e.abs() < 1e-12, "{}: equation {e}", solved.how);
            assert!((slope * inverse - 1.0).abs() < 1e-11, "{}: slope {slope} {inverse}", solved.how);
        }
        None
    }

    /// Rates and accelerations against differences, when all that closes the cycle moves.
    fn check_rates(&mut self, solution: &Solution) {
        let Some(Element::Fixed { turns, offset }) = self.elements.last() else { return };
        let symbols: Vec<Scalar> = turns.iter().map(|t| t.1).chain(*offset).filter(|&s| s != Scalar::ZERO).collect();
        let mut rng = Rng::new(3);
        let moving: Vec<(Scalar, f64, f64)> =
            symbols.into_iter().map(|s| (s, rng.real(-1.0, 1.0), rng.real(-1.0, 1.0))).collect();
        let start = self.values.clone();
        let motion = self.motion(solution, &moving);
        self.values[..start.len()].copy_from_slice(&start);
        let mut at = |time: f64| -> Vec<f64> {
            self.values[..start.len()].copy_from_slice(&start);
            for &(s, rate, acceleration) in &moving {
                let x = self.number(s);
                self.set(s, x + time * rate + 0.5 * time * time * acceleration);
            }
            self.put(solution);
            solution.solved.iter().map(|solved| self.number(solved.symbol)).collect()
        };
        let h = 1e-4;
        let list = [at(-h), at(0.0), at(h)];
        for (k, &(rate, acceleration)) in motion.iter().enumerate() {
            let [back, now, next] = [0, 1, 2].map(|i| {
                let d = list[i][k] - list[1][k];
                if d.abs() > 3.0 { d - d.signum() * std::f64::consts::TAU } else { d }
            });
            let (first, second) = ((next - back) / (2.0 * h), (next - 2.0 * now + back) / (h * h));
            let how = &solution.solved[k].how;
            let near = |x: f64, y: f64, tolerance: f64| (x - y).abs() < tolerance * (1.0 + y.abs().powi(3));
            assert!(first.is_nan() || near(first, rate, 1e-4), "{how}: rate {rate} {first}");
            let size = 1e-2 * (1.0 + rate.abs().powi(3));
            assert!(second.is_nan() || near(second, acceleration, size), "{how}: acceleration {acceleration} {second}");
        }
        self.values[..start.len()].copy_from_slice(&start);
    }

    /// Rates and accelerations of the solved unknowns by implicit differentiation, the knowns moving as given.
    pub(crate) fn motion(&mut self, solution: &Solution, knowns: &[(Scalar, f64, f64)]) -> Vec<(f64, f64)> {
        let mut first: Vec<(Scalar, Scalar)> = Vec::new();
        let mut second: Vec<(Scalar, Scalar)> = Vec::new();
        for &(symbol, rate, acceleration) in knowns {
            let (v, a) = (self.known(rate), self.known(acceleration));
            first.push((symbol, v));
            second.extend([(symbol, v), (v, a)]);
        }
        let mut result = Vec::new();
        for Solved { symbol, balances, .. } in &solution.solved {
            let [Balance { equation, inverse_slope }] = &balances[..] else { panic!("one equation each") };
            let rest = self.g.derivative(*equation, &first);
            let rate = -self.g.mul(rest, *inverse_slope);
            let v = self.known(0.0);
            let value = self.number(rate);
            self.set(v, value);
            first.push((*symbol, v));
            second.push((*symbol, v));
            let whole = self.g.derivative(*equation, &first);
            let rest = self.g.derivative(whole, &second);
            let acceleration = -self.g.mul(rest, *inverse_slope);
            let a = self.known(0.0);
            let value = self.number(acceleration);
            self.set(a, value);
            second.push((v, a));
            result.push((self.number(v), self.number(a)));
        }
        result
    }
}

impl Cycle {
    /// Operations for values and inverse slopes of all that was solved, with earlier solutions put in.
    pub(crate) fn cost(&mut self, solution: &Solution) -> Cost {
        let mut map = HashMap::new();
        let mut roots = Vec::new();
        for solved in &solution.solved {
            let list = match solved.value {
                Value::Angle { cos, sin } => vec![cos, sin, solved.balances[0].inverse_slope],
                Value::Length(x) => vec![x, solved.balances[0].inverse_slope],
            };
            let list = self.g.substitute(&list, &map);
            let value = match list[..] {
                [cos, sin, _] => self.g.angle(cos, sin),
                _ => list[0],
            };
            roots.extend(&list);
            map.insert(self.g.symbol_id(solved.symbol).unwrap(), value);
        }
        let mut lowering = Lowering::new(&self.g);
        let lowered = lowering.run(&roots);
        lowering.to.cost(&lowered)
    }
}
