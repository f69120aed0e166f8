//! Mechanisms with closed loops: a configuration is drawn first, and the joints that close are put where it closes.
//!
//! The last frame of a loop is therefore typed to sixteen digits, as people who measure or compute it do.

use super::expression::Point;
use super::numbers::{angle, any_normal, axis, perpendicular, turn, typed};
use super::{Expr, Frame, Joint, Kind, Mechanism, Rod, Step, Vector};
use crate::algebra::{apply, minus, norm, product, transposed};
use crate::plain::{Motion, Plain, beyond};
use crate::random::Random;

fn z() -> Vector {
    Vector::Whole("Z".into(), [0.0, 0.0, 1.0])
}

fn at(x: f64, y: f64) -> Step {
    let text = |v: f64| format!("{v:.3}").parse().expect("a decimal");
    Step::At(Vector::literal([text(x), text(y), 0.0]))
}

impl Mechanism {
    /// A mechanism with loops of some family, in some formulation.
    pub fn looped_one(random: &mut Random) -> Mechanism {
        loop {
            let found = match random.below(10) {
                0..=3 => Mechanism::spatial(random),
                4..=6 => Mechanism::planar(random),
                7 => Mechanism::held_by_rods(random),
                _ => Mechanism::spherical(random),
            };
            if let Some(mut m) = found {
                m.load(random);
                m.follow(random);
                m.emit = vec!["forward_dynamics", "energy"];
                if random.chance(60) {
                    m.emit.extend(["inverse_dynamics", "mass_matrix"]);
                }
                m.outputs = random.chance(70);
                m.formulate(random);
                m.ask_twice(random);
                if random.chance(40) {
                    m.carry(random);
                }
                if m.tail.contains("Reduced") && random.chance(50) {
                    m.emit.push("impulse");
                }
                return m;
            }
        }
    }

    fn formulate(&mut self, random: &mut Random) {
        let choice = random.below(12);
        let said = match choice {
            0..=2 => "constraints: Multipliers",
            3 => "constraints: Stabilised, rate: 10, position: 25",
            4..=7 => "constraints: Reduced",
            8 | 9 => "coordinates: Absolute(Quaternion)",
            _ => "coordinates: Absolute(RollPitchYaw)",
        };
        self.tail += &format!("    formulation {{ {said} }}\n");
    }

    /// A configuration of the tree, of some size.
    pub(super) fn pose(&self, random: &mut Random) -> Point {
        let mut point = self.point(random);
        for (joint, q) in self.joints.iter().zip(&mut point.q) {
            let angles = joint.kind.quaternion().unwrap_or(q.len());
            q[..angles].iter_mut().for_each(|x| *x = 1.2 * random.unit());
        }
        let mut defaults = Point::default();
        for default in &self.params {
            let value = default.value(&defaults);
            defaults.params.push(value);
        }
        point.params = defaults.params;
        point
    }

    /// Puts a joint between two bodies that holds in a configuration, where its own coordinates are `c`.
    pub(super) fn close(&mut self, kind: Kind, parent: Frame, body: Option<usize>, point: &Point, c: &[f64]) {
        let mut joint = Joint { kind, parent, child: Frame { body, steps: Vec::new() }, armature: None };
        let plain = Plain::new(self, point);
        let none = vec![0.0; c.len()];
        let there = beyond(&joint, plain.frame(&joint.parent), c, &none, &none, point);
        let on = body.map_or_else(Motion::still, |body| plain.bodies[body]);
        let back = transposed(&on.rotation);
        joint.child.steps.push(Step::At(Vector::literal(apply(&back, minus(there.place, on.place)))));
        // A ball turns as it likes.
        if !matches!(joint.kind, Kind::Ball(_)) {
            joint.child.steps.push(Step::Oriented(typed(&product(&back, &there.rotation))));
        }
        self.joints.push(joint);
        self.closed = point.q.clone();
    }

    /// Any joints in a row, closed by any joint that leaves some freedom.
    fn spatial(random: &mut Random) -> Option<Mechanism> {
        let mut m = Mechanism::base(random);
        for _ in 0..2 + random.below(3) {
            let mut kind = m.kind(random);
            while matches!(kind, Kind::Free(_) | Kind::Fixed) {
                kind = m.kind(random);
            }
            m.hang(random, kind);
        }
        let (kind, equations) = match random.below(15) {
            0..=5 => (Kind::Ball(false), 3),
            6 => (Kind::Revolute(axis(random)), 5),
            7 => (Kind::Prismatic(axis(random)), 5),
            8 => (Kind::Screw(axis(random), Expr::literal(0.2)), 5),
            9 => (Kind::Cylindrical(axis(random)), 4),
            10 | 11 => {
                let (a, b) = perpendicular(random);
                (Kind::Universal(a, b), 4)
            }
            14 => {
                let (a, b) = perpendicular(random);
                (Kind::PinSlot(a, b), 4)
            }
            12 if random.chance(50) => {
                let (a, b) = perpendicular(random);
                (Kind::PlanarAlong(a, b), 3)
            }
            12 => (Kind::Planar(random.below(3), random.chance(50)), 3),
            _ => (Kind::Fixed, 6),
        };
        let last = m.bodies.len() - 1;
        let parent = if random.chance(70) { None } else { Some(random.below(last)) };
        // Freedoms that lie within the loop.
        let inside: usize = (0..m.bodies.len())
            .filter(|&joint| m.is_beyond(last, joint) && !parent.is_some_and(|p| m.is_beyond(p, joint)))
            .map(|joint| m.joints[joint].kind.freedoms())
            .sum();
        if inside <= equations || inside > equations + 3 {
            return None;
        }
        let point = m.pose(random);
        let frame = m.frame(random, parent);
        let c: Vec<f64> = (0..kind.coordinates()).map(|_| 0.8 * random.unit()).collect();
        let c = if kind.quaternion().is_some() { vec![1.0, 0.0, 0.0, 0.0] } else { c };
        m.close(kind, frame, Some(last), &point, &c);
        Some(m)
    }

    /// Links in a plane that lies anywhere.
    fn planar(random: &mut Random) -> Option<Mechanism> {
        let mut m = Mechanism::base(random);
        let mut base = Frame { body: None, steps: vec![Step::At(m.offset(random)), turn(random)] };
        if random.chance(50) {
            base.steps.push(turn(random));
        }
        // Every body may be written in axes of its own.
        let own: Vec<Vec<Step>> =
            (0..3).map(|_| if random.chance(40) { vec![turn(random)] } else { Vec::new() }).collect();
        let with =
            |k: usize, step: Option<Step>| Frame { body: Some(k), steps: own[k].iter().cloned().chain(step).collect() };
        let slider = random.chance(30);
        for k in 0..3 {
            let kind = if slider && k == 2 {
                Kind::Prismatic(Vector::Whole("X".into(), [1.0, 0.0, 0.0]))
            } else {
                Kind::Revolute(z())
            };
            m.hang(random, kind);
            let long = random.between(0.8, 1.4);
            let parent = if k == 0 { base.clone() } else { with(k - 1, Some(at(long, 0.0))) };
            m.joints[k].parent = parent;
            m.joints[k].child = with(k, None);
        }
        let mut point = m.pose(random);
        // Away from the dead centres of the dyad.
        point.q[1][0] = random.between(0.5, 1.2);
        point.q[2][0] = if slider { 0.4 } else { random.between(0.6, 1.6) };
        let end = with(2, Some(at(random.between(0.8, 1.3), 0.0)));
        let c = [random.unit()];
        let kind = match random.below(4) {
            0 => Kind::Ball(false),
            _ => Kind::Revolute(z()),
        };
        let c: &[f64] = if matches!(kind, Kind::Ball(_)) { &[1.0, 0.0, 0.0, 0.0] } else { &c };
        m.close(kind, end, None, &point, c);
        if !slider && random.chance(40) {
            let sign = if random.chance(50) { "sin(j2.angle) > 0" } else { "j1.angle < 100, sin(j2) > 0.0" };
            m.tail += &format!("    solve (j1.angle, j2.angle) from j3 {{ {sign} }}\n");
        }
        Some(m)
    }

    /// Axes that meet in a point.
    fn spherical(random: &mut Random) -> Option<Mechanism> {
        let mut m = Mechanism::base(random);
        let centre = Step::At(m.offset(random));
        for k in 0..3 {
            let kind = Kind::Revolute(axis(random));
            m.hang(random, kind);
            let tilt = Step::Rotated(axis(random), angle(random));
            let body = (k > 0).then(|| k - 1);
            let mut steps = if k == 0 { vec![centre.clone()] } else { Vec::new() };
            steps.push(tilt);
            m.joints[k].parent = Frame { body, steps };
            m.joints[k].child.steps.clear();
            if random.chance(30) {
                m.joints[k].child.steps.push(turn(random));
            }
        }
        let point = m.pose(random);
        m.close(Kind::Revolute(axis(random)), Frame { body: Some(2), steps: vec![turn(random)] }, None, &point, &[0.3]);
        Some(m)
    }

    /// A chain whose ends are tied.
    fn held_by_rods(random: &mut Random) -> Option<Mechanism> {
        let mut m = Mechanism::base(random);
        for _ in 0..2 + random.below(2) {
            let mut kind = m.kind(random);
            while matches!(kind, Kind::Fixed) {
                kind = m.kind(random);
            }
            m.hang(random, kind);
        }
        let rods = 1 + random.below(2);
        if m.freedoms() <= rods || m.freedoms() > 9 {
            return None;
        }
        let point = m.pose(random);
        let last = m.bodies.len() - 1;
        for _ in 0..rods {
            let normal = any_normal(random, [1.0, 0.3, 0.2]);
            let first =
                Frame { body: None, steps: vec![Step::At(Vector::literal(normal.map(|x| (x * 1e3).round() / 1e3)))] };
            let second = m.frame(random, Some(last));
            let plain = Plain::new(&m, &point);
            let length = norm(minus(plain.frame(&first).place, plain.frame(&second).place));
            if length < 0.2 {
                return None;
            }
            m.rods.push(Rod { between: [first, second], length: Expr::literal(length) });
        }
        m.closed = point.q.clone();
        Some(m)
    }
}
