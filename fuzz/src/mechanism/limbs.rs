//! A trunk on limbs that are built alike: what packs are for.
//!
//! One limb is drawn and hung up several times, each time at a place of its own: as it is, mirrored every other time, with other
//! numbers everywhere, or both. What is zero in one limb is zero in all of them, as in robots.

use super::numbers::{angle, axis, decimal};
use super::{Body, Expr, Force, Frame, Inertia, Joint, Kind, Mechanism, Step, Vector};
use crate::random::Random;

/// A joint with the body on it; frames are numbered within the limb.
type Part = (Joint, Body);

/// What acts in every limb.
struct Drive {
    motors: bool,
    springs: bool,
    /// A spring to the ground holds the outermost body at this place.
    foot: Option<Vector>,
}

impl Mechanism {
    /// A trunk, or the ground, on limbs that are alike.
    pub fn limbed(random: &mut Random) -> Mechanism {
        let mut m = Mechanism::base(random);
        match random.below(8) {
            0..=3 => m.hang(random, Kind::Free(false)),
            4 => m.hang(random, Kind::Free(true)),
            5 => {}
            6 => m.hang(random, Kind::Fixed),
            _ => {
                let kind = m.kind(random);
                m.hang(random, kind);
            }
        }
        let trunk = m.bodies.len().checked_sub(1);
        // Pairs stay as they are; of five and six a second pack is filled in part.
        let count = *random.pick(&[2, 3, 4, 4, 4, 4, 5, 6, 6]);
        let bodies = 1 + random.below(if count < 5 { 3 } else { 2 });
        let limb = m.limb(random, bodies);
        let (mirrored, varied) = (random.chance(50), random.chance(60));
        let drive = Drive {
            motors: random.chance(40),
            springs: random.chance(30),
            foot: random.chance(15).then(|| m.offset(random)),
        };
        let limbs: Vec<usize> = (0..count)
            .map(|number| {
                let spread = if varied { 0.3 } else { 0.0 };
                let mut twin = Twin { mirrored: mirrored && number % 2 == 1, spread, random: &mut *random };
                let limb: Vec<Part> = limb.iter().map(|(joint, body)| (twin.joint(joint), twin.body(body))).collect();
                m.attach(random, trunk, limb)
            })
            .collect();
        if random.chance(20) {
            m.load(random);
        }
        for first in limbs {
            m.drive(random, &drive, first..first + bodies);
        }
        let all = ["forward_dynamics", "inverse_dynamics", "mass_matrix", "bias", "energy"];
        m.emit = all.into_iter().filter(|_| random.chance(40)).collect();
        if m.emit.is_empty() {
            m.emit.push("forward_dynamics");
        }
        m.packs = true;
        m.follow(random);
        m.ask_twice(random);
        m
    }

    /// Some bodies on each other, with up to three velocity coordinates.
    fn limb(&self, random: &mut Random, bodies: usize) -> Vec<Part> {
        loop {
            let mut limb = Mechanism { params: self.params.clone(), ..Mechanism::default() };
            for number in 0..bodies {
                let kind = limb.kind(random);
                limb.hang(random, kind);
                limb.joints[number].parent.body = number.checked_sub(1);
            }
            if (1..=3).contains(&limb.freedoms()) {
                return limb.joints.into_iter().zip(limb.bodies).collect();
            }
        }
    }

    /// Hangs a limb on the trunk at some place, turned somehow; the number of its first body.
    fn attach(&mut self, random: &mut Random, trunk: Option<usize>, limb: Vec<Part>) -> usize {
        let first = self.bodies.len();
        let place = Vector::Parts([(); 3].map(|()| decimal(random, -0.6, 0.6)));
        let hip = [Step::At(place), Step::Rotated(axis(random), angle(random))];
        for (mut joint, body) in limb {
            let number = self.bodies.len();
            joint.child.body = Some(number);
            match joint.parent.body {
                Some(inner) => joint.parent.body = Some(first + inner),
                None => {
                    joint.parent.body = trunk;
                    joint.parent.steps.splice(0..0, hip.clone());
                }
            }
            self.joints.push(joint);
            self.bodies.push(body);
        }
        first
    }

    fn drive(&mut self, random: &mut Random, drive: &Drive, limb: std::ops::Range<usize>) {
        let last = limb.end - 1;
        for joint in limb {
            let kind = &self.joints[joint].kind;
            let Some(&name) = kind.names().first() else { continue };
            if drive.springs {
                let [stiffness, damping] =
                    [(2.0, 20.0), (0.1, 2.0)].map(|(low, high)| Some(decimal(random, low, high)));
                self.forces.push(Force::JointSpring { joint, component: 0, stiffness, damping, rest: None });
            }
            if drive.motors {
                let rate = Expr::Rate(joint, 0, (kind.freedoms() > 1).then_some(name));
                let value = Expr::Input(self.inputs).plus(Expr::literal(-0.3).times(rate));
                self.inputs += 1;
                self.forces.push(Force::Effort { joint, component: Some(0), values: vec![value] });
            }
        }
        if let Some(foot) = &drive.foot {
            let anchor = Frame { body: None, steps: vec![Step::At(self.offset(random))] };
            let foot = Frame { body: Some(last), steps: vec![Step::At(foot.clone())] };
            self.forces.push(Force::LineSpring {
                between: [anchor, foot],
                stiffness: Some(decimal(random, 1.0, 20.0)),
                damping: Some(decimal(random, 0.1, 2.0)),
                length: Some(decimal(random, 0.2, 1.5)),
            });
        }
    }
}

/// Makes another limb of one: its mirror image in the plane of x and z, with other numbers.
struct Twin<'r> {
    mirrored: bool,
    /// Numbers differ by up to this share.
    spread: f64,
    random: &'r mut Random,
}

impl Twin<'_> {
    fn factor(&mut self) -> f64 {
        if self.spread == 0.0 { 1.0 } else { (1e3 * (1.0 + self.spread * self.random.unit())).round() / 1e3 }
    }

    fn number(&mut self, e: &Expr) -> Expr {
        multiple(e, self.factor())
    }

    fn sign(&self) -> f64 {
        if self.mirrored { -1.0 } else { 1.0 }
    }

    /// Of a place or a way.
    fn polar(&mut self, v: &Vector) -> Vector {
        let sign = self.sign();
        self.vector(v, [1.0, sign, 1.0])
    }

    /// Of a turn.
    fn axial(&mut self, v: &Vector) -> Vector {
        let sign = self.sign();
        self.vector(v, [sign, 1.0, sign])
    }

    fn vector(&mut self, v: &Vector, signs: [f64; 3]) -> Vector {
        let factors = signs.map(|sign| sign * self.factor());
        times(v, factors)
    }

    fn frame(&mut self, frame: &Frame) -> Frame {
        let sign = self.sign();
        let step = |step: &Step| match step {
            Step::At(v) => Step::At(self.polar(v)),
            Step::Rotated(v, e) => Step::Rotated(times(v, [sign, 1.0, sign]), self.number(e)),
            Step::Oriented(rows) => Step::Oriented([0, 1, 2].map(|i| {
                [0, 1, 2].map(|j| if (i == 1) == (j == 1) { rows[i][j].clone() } else { multiple(&rows[i][j], sign) })
            })),
        };
        Frame { body: frame.body, steps: frame.steps.iter().map(step).collect() }
    }

    fn joint(&mut self, joint: &Joint) -> Joint {
        let sign = self.sign();
        // Pairs of axes stay at a right angle.
        let (polar, axial) = ([1.0, sign, 1.0], [sign, 1.0, sign]);
        let kind = match &joint.kind {
            Kind::Revolute(v) => Kind::Revolute(self.axial(v)),
            Kind::Prismatic(v) => Kind::Prismatic(self.polar(v)),
            Kind::Screw(v, pitch) => {
                let pitch = self.number(pitch);
                Kind::Screw(self.axial(v), multiple(&pitch, sign))
            }
            Kind::Cylindrical(v) => Kind::Cylindrical(self.axial(v)),
            Kind::Universal(a, b) => Kind::Universal(times(a, axial), times(b, axial)),
            Kind::PinSlot(a, b) => Kind::PinSlot(times(a, axial), times(b, polar)),
            Kind::PlanarAlong(a, b) => Kind::PlanarAlong(times(a, polar), times(b, polar)),
            Kind::Fixed | Kind::Planar(..) | Kind::Ball(_) | Kind::Free(_) => joint.kind.clone(),
        };
        let armature = joint.armature.as_ref().map(|e| self.number(e));
        Joint { kind, parent: self.frame(&joint.parent), child: self.frame(&joint.child), armature }
    }

    fn body(&mut self, body: &Body) -> Body {
        let (sign, factor) = (self.sign(), self.factor());
        let whole = |e: &Expr| multiple(e, factor);
        // Moments grow together, so that no body has any that matter can't have.
        let inertia = match &body.inertia {
            Inertia::Point => Inertia::Point,
            Inertia::Diagonal(list) => Inertia::Diagonal(list.each_ref().map(whole)),
            Inertia::Full([xx, yy, zz, xy, xz, yz]) => {
                let crossed = |e: &Expr| multiple(e, factor * sign);
                Inertia::Full([whole(xx), whole(yy), whole(zz), crossed(xy), whole(xz), crossed(yz)])
            }
            Inertia::Rod(a, v) => Inertia::Rod(whole(a), times(v, [1.0, sign, 1.0])),
            Inertia::Cuboid(v) => Inertia::Cuboid(times(v, [factor; 3])),
            Inertia::Cylinder(a, b, v) => Inertia::Cylinder(whole(a), whole(b), times(v, [1.0, sign, 1.0])),
            Inertia::Sphere(a) => Inertia::Sphere(whole(a)),
        };
        Body { mass: self.number(&body.mass), com: self.polar(&body.com), inertia }
    }
}

fn multiple(e: &Expr, factor: f64) -> Expr {
    match e {
        _ if factor == 1.0 => e.clone(),
        Expr::Number(_, value) if *value == 0.0 => e.clone(),
        Expr::Number(_, value) => Expr::literal(factor * value),
        other => Expr::literal(factor).times(other.clone()),
    }
}

fn times(v: &Vector, factors: [f64; 3]) -> Vector {
    match v {
        _ if factors == [1.0; 3] => v.clone(),
        Vector::Whole(_, value) => Vector::Parts([0, 1, 2].map(|k| multiple(&Expr::literal(value[k]), factors[k]))),
        Vector::Parts(parts) => Vector::Parts([0, 1, 2].map(|k| multiple(&parts[k], factors[k]))),
    }
}
