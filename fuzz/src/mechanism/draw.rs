//! Random mechanisms: chains and trees with every kind of joint, seldom along coordinate axes.

use super::expression::{Function, Point};
use super::numbers::{angle, axis, decimal, length, perpendicular, positive, turn};
use super::{Body, Expr, Force, Frame, Inertia, Joint, Kind, Mechanism, Step, Vector};
use crate::algebra::{about, product, transposed};
use crate::random::Random;

impl Mechanism {
    /// An open chain or tree with everything on it.
    pub fn tree(random: &mut Random) -> Mechanism {
        let mut m = Mechanism::base(random);
        let bodies = *random.pick(&[1, 2, 2, 2, 3, 3, 3, 4, 4, 5]);
        for _ in 0..bodies {
            let kind = m.kind(random);
            m.hang(random, kind);
        }
        m.load(random);
        m.follow(random);
        m.emit = vec!["forward_dynamics", "inverse_dynamics", "mass_matrix", "bias", "energy"];
        if random.chance(20) {
            let keep = random.below(m.emit.len());
            m.emit = vec![m.emit[keep]];
        }
        if random.chance(20) && m.freedoms() <= 8 {
            m.emit.push("derivatives");
        }
        if random.chance(20) && m.freedoms() > 0 && m.states.is_empty() {
            m.emit.push("impulse");
            if m.joints.iter().all(|joint| joint.kind.quaternion().is_none()) {
                m.emit.push("momentum");
            }
        }
        m.outputs = random.chance(30) && m.freedoms() <= 10;
        m.ask_twice(random);
        m
    }

    /// Lets mass leave some bodies: what they are follows states.
    pub fn follow(&mut self, random: &mut Random) {
        if !random.chance(20) {
            return;
        }
        for body in &mut self.bodies {
            if random.chance(40) {
                continue;
            }
            let state = || Expr::State(self.states.len());
            body.mass = body.mass.clone().times(state());
            if let Vector::Parts(parts) = &mut body.com
                && random.chance(40)
            {
                let k = random.below(3);
                parts[k] = parts[k].clone().times(state());
            }
            let scaled = |e: &mut Expr| *e = e.clone().times(state());
            match &mut body.inertia {
                Inertia::Diagonal(list) => list.iter_mut().for_each(scaled),
                Inertia::Full(list) => list.iter_mut().for_each(scaled),
                // Of the mass.
                Inertia::Point | Inertia::Rod(..) | Inertia::Cuboid(_) | Inertia::Cylinder(..) | Inertia::Sphere(_) => {
                }
            }
            self.states.push(positive(random));
        }
    }

    /// What is asked for in other forms too: the mass matrix as a triangle, functions behind what a position decides.
    pub fn ask_twice(&mut self, random: &mut Random) {
        if random.chance(35) {
            self.emit.push("mass_matrix_lower");
        }
        if !random.chance(40) {
            return;
        }
        let impulse = self.emit.contains(&"impulse");
        let of_word = |word: &&'static str| match *word {
            "energy" => vec!["kinetic_energy", "potential_energy"],
            "derivatives" => vec!["forward_derivatives", "inverse_derivatives"],
            // An impulse is divided by the mass matrix as momenta are: then one function does for both.
            "momentum" if impulse => vec!["momentum", "momentum_rate"],
            "momentum" => vec!["momentum", "momentum_rate", "velocity"],
            word => vec![word],
        };
        let outputs = self.outputs.then_some("outputs");
        let all: Vec<&str> = self.emit.iter().flat_map(of_word).chain(outputs).collect();
        // What is left to a function alone is another program than what several share.
        let some: Vec<&str> = all.iter().copied().filter(|_| random.chance(60)).collect();
        self.at = if some.is_empty() { all } else { some };
    }

    /// Parameters and gravity.
    pub fn base(random: &mut Random) -> Mechanism {
        let mut m = Mechanism::default();
        if random.chance(50) {
            m.params = (0..1 + random.below(3)).map(|_| positive(random)).collect();
        }
        m.gravity = match random.below(6) {
            0 => None,
            1 | 2 => Some(Vector::Whole("-9.81 * Z".into(), [0.0, 0.0, -9.81])),
            3 => Some(Vector::Whole("[0, -9.80665, 0]".into(), [0.0, -9.80665, 0.0])),
            4 => Some(Vector::Parts([(); 3].map(|()| decimal(random, -9.0, 9.0)))),
            _ => Some(Vector::Whole("-9 * [1, 2, 2] / 3".into(), [-3.0, -6.0, -6.0])),
        };
        m
    }

    /// A number, or a parameter with a factor.
    fn or_param(&self, random: &mut Random, literal: Expr) -> Expr {
        if self.params.is_empty() || !random.chance(15) {
            return literal;
        }
        let param = Expr::Param(random.below(self.params.len()));
        if random.chance(50) { param } else { Expr::literal(0.5).times(param) }
    }

    /// An offset with zeros in it.
    pub fn offset(&self, random: &mut Random) -> Vector {
        match random.below(8) {
            0 => Vector::Whole("X".into(), [1.0, 0.0, 0.0]),
            1 => Vector::Whole("0.3 * Y".into(), [0.0, 0.3, 0.0]),
            2 => Vector::Whole("0.1 * X + 0.05 * Y".into(), [0.1, 0.05, 0.0]),
            _ => Vector::Parts([(); 3].map(|()| {
                let literal = length(random);
                self.or_param(random, literal)
            })),
        }
    }

    /// A frame on a body with some steps.
    pub fn frame(&self, random: &mut Random, body: Option<usize>) -> Frame {
        let steps = (0..*random.pick(&[0, 0, 1, 1, 2, 2, 3]))
            .map(|_| if random.chance(45) { Step::At(self.offset(random)) } else { turn(random) })
            .collect();
        Frame { body, steps }
    }

    /// An axis that may hold a parameter.
    fn axis(&self, random: &mut Random) -> Vector {
        if !self.params.is_empty() && random.chance(8) {
            let p = Expr::Param(random.below(self.params.len()));
            return Vector::Parts([p, Expr::literal(1.0), length(random)]);
        }
        axis(random)
    }

    /// One of the ten, hinges most often.
    pub fn kind(&self, random: &mut Random) -> Kind {
        match random.below(25) {
            0 => Kind::Fixed,
            1..=10 => Kind::Revolute(self.axis(random)),
            11..=13 => Kind::Prismatic(self.axis(random)),
            14 | 15 => {
                let pitch = decimal(random, -0.4, 0.4);
                Kind::Screw(self.axis(random), self.or_param(random, pitch))
            }
            16 => Kind::Cylindrical(self.axis(random)),
            17 | 18 => {
                let (a, b) = perpendicular(random);
                Kind::Universal(a, b)
            }
            24 => {
                let (a, b) = perpendicular(random);
                Kind::PinSlot(a, b)
            }
            19 if random.chance(50) => {
                let (a, b) = perpendicular(random);
                Kind::PlanarAlong(a, b)
            }
            19 => Kind::Planar(random.below(3), random.chance(40)),
            20 => Kind::Ball(false),
            21 => Kind::Ball(true),
            22 => Kind::Free(false),
            _ => Kind::Free(true),
        }
    }

    /// A further body on a joint.
    pub fn hang(&mut self, random: &mut Random, kind: Kind) {
        let count = self.bodies.len();
        let parent = match count {
            0 => None,
            _ if random.chance(70) => Some(count - 1),
            _ if random.chance(80) => Some(random.below(count)),
            _ => None,
        };
        let armature = (kind.freedoms() == 1 && random.chance(20)).then(|| decimal(random, 0.01, 0.3));
        let (parent, mut child) = (self.frame(random, parent), self.frame(random, Some(count)));
        if random.chance(50) {
            child.steps.clear();
        }
        self.joints.push(Joint { kind, parent, child, armature });
        let body = self.body(random);
        self.bodies.push(body);
    }

    fn body(&self, random: &mut Random) -> Body {
        let mass = positive(random);
        let mass = self.or_param(random, mass);
        let com = if random.chance(15) { Vector::literal([0.0; 3]) } else { self.offset(random) };
        let inertia = match random.below(12) {
            0..=3 => Inertia::Diagonal([0.1, 0.1, 0.1].map(Expr::literal)),
            4 | 5 => Inertia::Diagonal([0.1, 0.2, 0.25].map(Expr::literal)),
            6 => Inertia::Cuboid(Vector::Parts([(); 3].map(|()| positive(random)))),
            7 => Inertia::Cylinder(positive(random), positive(random), axis(random)),
            8 => Inertia::Sphere(positive(random)),
            _ => {
                let d = [(); 3].map(|()| random.between(0.05, 0.3));
                let principal = [d[1] + d[2], d[0] + d[2], d[0] + d[1]];
                let nothing = Point::default();
                let r = about(axis(random).value(&nothing), angle(random).value(&nothing));
                let mut turned = [0, 1, 2].map(|i| [0, 1, 2].map(|j| principal[i] * r[j][i]));
                turned = product(&r, &turned);
                debug_assert!((transposed(&turned)[0][1] - turned[0][1]).abs() < 1e-12);
                let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
                Inertia::Full(entries.map(|(i, j)| {
                    let text = format!("{:.4}", turned[i][j]);
                    let value = text.parse().expect("a decimal");
                    Expr::Number(text, value)
                }))
            }
        };
        Body { mass, com, inertia }
    }

    /// Inputs and forces.
    pub fn load(&mut self, random: &mut Random) {
        self.inputs = *random.pick(&[0, 0, 1, 2]);
        for _ in 0..*random.pick(&[0, 0, 1, 1, 2, 3]) {
            let force = self.any_force(random);
            self.forces.extend(force);
        }
    }

    fn any_body(&self, random: &mut Random) -> Option<usize> {
        Some(random.below(self.bodies.len()))
    }

    fn any_force(&self, random: &mut Random) -> Option<Force> {
        let joint = random.below(self.bodies.len());
        let kind = &self.joints[joint].kind;
        let some = |random: &mut Random, low, high| Some(decimal(random, low, high));
        Some(match random.below(8) {
            0 | 1 if kind.freedoms() > 0 => {
                if kind.names().is_empty() || random.chance(30) {
                    let values = (0..kind.freedoms()).map(|_| self.expression(random, 2)).collect();
                    Force::Effort { joint, component: None, values }
                } else {
                    let component = Some(random.below(kind.names().len()));
                    Force::Effort { joint, component, values: vec![self.expression(random, 2)] }
                }
            }
            2 | 3 if !kind.names().is_empty() && !matches!(kind, Kind::Free(false)) => {
                let which = random.below(3);
                Force::JointSpring {
                    joint,
                    component: random.below(kind.names().len()),
                    stiffness: if which == 1 { None } else { some(random, 1.0, 20.0) },
                    damping: if which == 0 { None } else { some(random, 0.1, 2.0) },
                    rest: if which != 1 && random.chance(50) { some(random, -1.0, 1.0) } else { None },
                }
            }
            4 | 5 => {
                let (a, b) = (random.below(self.bodies.len() + 1), random.below(self.bodies.len()));
                let first = (a != b && a < self.bodies.len()).then_some(a);
                let which = random.below(3);
                Force::LineSpring {
                    between: [self.frame(random, first), self.frame(random, Some(b))],
                    stiffness: if which == 1 { None } else { some(random, 1.0, 20.0) },
                    damping: if which == 0 { None } else { some(random, 0.1, 2.0) },
                    length: if which == 1 { None } else { some(random, 0.2, 1.5) },
                }
            }
            6 | 7 => {
                let body = self.any_body(random);
                let axes = if random.chance(40) { None } else { self.any_body(random) };
                Force::Wrench {
                    torque: random.chance(40),
                    at: self.frame(random, body),
                    value: Vector::Parts([(); 3].map(|()| self.expression(random, 1))),
                    axes: self.frame(random, axes),
                }
            }
            _ => return None,
        })
    }

    /// What a force may depend on.
    fn expression(&self, random: &mut Random, depth: usize) -> Expr {
        if depth > 0 && random.chance(50) {
            let a = self.expression(random, depth - 1);
            return match random.below(4) {
                0 => a.plus(self.expression(random, depth - 1)),
                1 => a.times(self.expression(random, depth - 1)),
                _ => {
                    let list = [Function::Sin, Function::Tanh, Function::Root, Function::Ramp, Function::Bent];
                    Expr::Call(*random.pick(&list), Box::new(a))
                }
            };
        }
        let joint = random.below(self.bodies.len());
        let kind = &self.joints[joint].kind;
        match random.below(7) {
            0 => Expr::Time,
            1 if self.inputs > 0 => Expr::Input(random.below(self.inputs)),
            2 | 3 if !kind.names().is_empty() => {
                let k = random.below(kind.names().len());
                Expr::Position(joint, k, kind.names()[k])
            }
            4 | 5 if !kind.names().is_empty() => {
                let k = random.below(kind.names().len());
                Expr::Rate(joint, k, (kind.freedoms() > 1).then(|| kind.names()[k]))
            }
            _ => {
                let literal = decimal(random, -5.0, 5.0);
                self.or_param(random, literal)
            }
        }
    }

    /// A point of the state space, near the default position or far from it.
    pub fn point(&self, random: &mut Random) -> Point {
        let size = *random.pick(&[0.3, 1.0, 2.0, 3.0, 20.0]);
        let away = random.chance(50);
        let mut at = Point { time: random.between(0.0, 2.0), ..Point::default() };
        for default in &self.params {
            let value = default.value(&at);
            at.params.push(if away { value * random.between(0.6, 1.5) } else { value });
        }
        for start in &self.states {
            let value = start.value(&at);
            at.states.push(if away { value * random.between(0.6, 1.5) } else { value });
        }
        at.inputs = (0..self.inputs).map(|_| 5.0 * random.unit()).collect();
        for joint in &self.joints[..self.bodies.len()] {
            let mut q: Vec<f64> = (0..joint.kind.coordinates()).map(|_| size * random.unit()).collect();
            if let Some(k) = joint.kind.quaternion() {
                let length = q[k..].iter().map(|x| x * x).sum::<f64>().sqrt();
                q[k..].iter_mut().for_each(|x| *x /= length);
            }
            if let Some(pitch) = joint.kind.names().iter().position(|name| *name == "pitch") {
                // Angles have poles there.
                while q[pitch].cos().abs() < 0.2 {
                    q[pitch] += 0.5;
                }
            }
            let n = joint.kind.freedoms();
            at.q.push(q);
            at.v.push((0..n).map(|_| 2.0 * random.unit()).collect());
            at.a.push((0..n).map(|_| 3.0 * random.unit()).collect());
        }
        at
    }
}
