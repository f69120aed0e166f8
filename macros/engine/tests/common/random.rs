//! Random mechanisms: trees of bodies with primitive joints, as plain numbers.

use super::rng::Rng;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Revolute(usize),
    Prismatic(usize),
    Screw(usize, f64),
    Ball,
}

impl Kind {
    pub(crate) fn freedoms(self) -> usize {
        if self == Kind::Ball { 3 } else { 1 }
    }

    pub(crate) fn coordinates(self) -> usize {
        if self == Kind::Ball { 4 } else { 1 }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) parent: Option<usize>,
    /// The joint frame in the parent: a quaternion of small integers, so that its matrix is exactly orthogonal.
    pub(crate) placement: [i64; 4],
    pub(crate) offset: [f64; 3],
    pub(crate) kind: Kind,
    pub(crate) mass: f64,
    pub(crate) com: [f64; 3],
    /// About the centre of mass: xx, yy, zz, xy, xz, yz.
    pub(crate) tensor: [f64; 6],
    pub(crate) armature: f64,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Mechanism {
    pub(crate) bodies: Vec<Body>,
    pub(crate) gravity: [f64; 3],
}

/// Positions (four of a ball), velocities, accelerations, efforts.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) a: Vec<f64>,
    pub(crate) effort: Vec<f64>,
}

impl Mechanism {
    /// A tree with this many bodies of mass, and massless links between some of them.
    pub(crate) fn tree(rng: &mut Rng, bodies: usize) -> Mechanism {
        let mut mechanism = Mechanism::default();
        if rng.chance(80) {
            mechanism.gravity = sparse(rng, 10.0);
        }
        // Where branches may start.
        let mut ends: Vec<usize> = Vec::new();
        for chance in [20, 30] {
            if rng.chance(chance) {
                mechanism.float(rng);
                ends.push(mechanism.bodies.len() - 1);
            }
        }
        while ends.len() < bodies {
            let parent = match ends.last() {
                Some(&last) if rng.chance(60) => Some(last),
                Some(_) if rng.chance(85) => Some(ends[rng.below(ends.len())]),
                _ => None,
            };
            let parent = if rng.chance(25) { Some(mechanism.massless(rng, parent)) } else { parent };
            let kind = mechanism.kind_after(rng, parent);
            mechanism.body(rng, parent, kind);
            ends.push(mechanism.bodies.len() - 1);
        }
        mechanism
    }

    /// Something that floats: massless translations, two along the axes of a plane or three, and a body that turns on
    /// them by a ball, by three hinges or in the plane. It starts from the ground or from the last body.
    pub(crate) fn float(&mut self, rng: &mut Rng) {
        let (axis, planar) = (rng.below(3), rng.chance(30));
        let mut parent = self.bodies.len().checked_sub(1);
        for k in 0..if planar { 2 } else { 3 } {
            let mut slide = Body::massless(parent, Kind::Prismatic((axis + k) % 3));
            if k == 0 {
                (slide.placement, slide.offset) = (placement(rng), sparse(rng, 1.0));
            }
            self.bodies.push(slide);
            parent = Some(self.bodies.len() - 1);
        }
        let hinges = !planar && rng.chance(40);
        if hinges {
            for k in [2, 1] {
                self.bodies.push(Body::massless(parent, Kind::Revolute(k)));
                parent = Some(self.bodies.len() - 1);
            }
        }
        let kind = match (planar, hinges) {
            (true, _) => Kind::Revolute((axis + 2) % 3),
            (_, true) => Kind::Revolute(0),
            _ => Kind::Ball,
        };
        self.body(rng, parent, kind);
        let body = self.bodies.len() - 1;
        // A ball may sit anywhere; axes of hinges must not become parallel.
        if kind != Kind::Ball {
            (self.bodies[body].placement, self.bodies[body].offset) = ([1, 0, 0, 0], [0.0; 3]);
        }
    }

    fn massless(&mut self, rng: &mut Rng, parent: Option<usize>) -> usize {
        let axis = rng.below(3);
        let kind = match rng.below(3) {
            0 => Kind::Prismatic(axis),
            1 => Kind::Screw(axis, rng.decimal(0.05, 0.3)),
            _ => Kind::Revolute(axis),
        };
        let mut link = Body::massless(parent, kind);
        (link.placement, link.offset) = (placement(rng), sparse(rng, 1.0));
        self.bodies.push(link);
        self.bodies.len() - 1
    }

    /// Behind a massless link a motion that is never along the link's own, and no ball behind one that turns.
    fn kind_after(&self, rng: &mut Rng, parent: Option<usize>) -> Kind {
        let before = parent.map(|p| &self.bodies[p]).filter(|b| b.mass == 0.0).map(|b| b.kind);
        let axis = rng.below(3);
        match (before, rng.below(10)) {
            (None | Some(Kind::Prismatic(_)), 0) => Kind::Ball,
            (None | Some(Kind::Revolute(_)), 1..=3) => Kind::Prismatic(axis),
            (None, 4) => Kind::Screw(axis, rng.decimal(0.05, 0.3)),
            (Some(Kind::Revolute(a) | Kind::Screw(a, _)), _) => Kind::Revolute((a + 1 + rng.below(2)) % 3),
            _ => Kind::Revolute(axis),
        }
    }

    fn body(&mut self, rng: &mut Rng, parent: Option<usize>, kind: Kind) {
        let after_massless = parent.is_some_and(|p| self.bodies[p].mass == 0.0);
        let mass = rng.decimal(0.5, 3.0);
        // Principal second moments, so that the tensor is one that a body can have.
        let d = [(); 3].map(|()| rng.decimal(0.02, 0.2));
        let principal = [d[1] + d[2], d[0] + d[2], d[0] + d[1]];
        let r = matrix(if rng.chance(50) { [1, 0, 0, 0] } else { placement(rng) });
        let about = |i: usize, j: usize| (0..3).map(|k| r[i][k] * principal[k] * r[j][k]).sum::<f64>();
        self.bodies.push(Body {
            parent,
            // Axes of a massless link and the next must stay apart.
            placement: if after_massless { [1, 0, 0, 0] } else { placement(rng) },
            offset: sparse(rng, 1.0),
            kind,
            mass,
            com: sparse(rng, 0.5),
            tensor: [about(0, 0), about(1, 1), about(2, 2), about(0, 1), about(0, 2), about(1, 2)],
            armature: if kind != Kind::Ball && rng.chance(20) { rng.decimal(0.01, 0.2) } else { 0.0 },
        });
    }

    pub(crate) fn freedoms(&self) -> usize {
        self.bodies.iter().map(|b| b.kind.freedoms()).sum()
    }

    pub(crate) fn state(&self, rng: &mut Rng) -> State {
        let mut q = Vec::new();
        for body in &self.bodies {
            match body.kind {
                Kind::Ball => q.extend(unit_quaternion(rng)),
                _ => q.push(rng.real(-2.0, 2.0)),
            }
        }
        let n = self.freedoms();
        let mut list = |size: f64| -> Vec<f64> { (0..n).map(|_| rng.real(-size, size)).collect() };
        State { q, v: list(2.0), a: list(5.0), effort: list(10.0) }
    }
}

impl Body {
    fn massless(parent: Option<usize>, kind: Kind) -> Body {
        Body {
            parent,
            placement: [1, 0, 0, 0],
            offset: [0.0; 3],
            kind,
            mass: 0.0,
            com: [0.0; 3],
            tensor: [0.0; 6],
            armature: 0.0,
        }
    }
}

/// Zeros are common in what people write.
fn sparse(rng: &mut Rng, size: f64) -> [f64; 3] {
    [(); 3].map(|()| if rng.chance(40) { 0.0 } else { rng.decimal(-size, size) })
}

fn unit_quaternion(rng: &mut Rng) -> [f64; 4] {
    let q = [(); 4].map(|()| rng.real(-1.0, 1.0));
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / norm)
}

/// Half of them turn by quarters, as most drawings do.
fn placement(rng: &mut Rng) -> [i64; 4] {
    if rng.chance(50) {
        let mut q = [1, 0, 0, 0];
        q[rng.below(4)] += 1 - 2 * (rng.below(2) as i64);
        return if q == [0; 4] { [1, 0, 0, 0] } else { q };
    }
    let q = [(); 4].map(|()| rng.below(7) as i64 - 3);
    if q == [0; 4] { [1, 0, 0, 0] } else { q }
}

/// Numerators of the matrix of a quaternion, and their common denominator.
pub(crate) fn fractions([w, x, y, z]: [i64; 4]) -> ([[i64; 3]; 3], i64) {
    let rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    (rows, w * w + x * x + y * y + z * z)
}

pub(crate) fn matrix(q: [i64; 4]) -> [[f64; 3]; 3] {
    let (rows, d) = fractions(q);
    rows.map(|row| row.map(|n| n as f64 / d as f64))
}
