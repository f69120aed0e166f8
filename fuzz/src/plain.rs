//! The mechanics of a description in plain numbers: positions, velocities and accelerations body by body with 3x3
//! matrices, and efforts by virtual power, the sum over bodies of force times partial velocity (Kane).
//!
//! Nothing of the engine is used: no graph, no tokens, no spatial vectors, no quaternion but in the turn of a ball.

use nalgebra::{DMatrix, DVector};

use crate::algebra::{
    Matrix, V3, about, apply, cross, dot, hamilton, identity, minus, norm, of_quaternion, plus, product, scaled,
    transposed,
};
use crate::mechanism::expression::Point;
use crate::mechanism::{Body, Force, Frame, Inertia, Joint, Kind, Mechanism, Step};

/// How a frame moves, in world axes.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// To world axes.
    pub rotation: Matrix,
    /// Of its origin.
    pub place: V3,
    /// Of its origin.
    pub velocity: V3,
    /// Of its origin.
    pub acceleration: V3,
    /// Angular velocity.
    pub omega: V3,
    /// Angular acceleration.
    pub alpha: V3,
}

/// A force and a moment about a point.
pub type Wrench = (V3, V3);

impl Motion {
    /// The ground.
    pub fn still() -> Motion {
        let none = [0.0; 3];
        Motion { rotation: identity(), place: none, velocity: none, acceleration: none, omega: none, alpha: none }
    }

    /// A frame that is fixed to this one.
    pub fn carried(&self, (turn, offset): &(Matrix, V3)) -> Motion {
        let arm = apply(&self.rotation, *offset);
        let sweep = cross(self.omega, arm);
        Motion {
            rotation: product(&self.rotation, turn),
            place: plus(self.place, arm),
            velocity: plus(self.velocity, sweep),
            acceleration: plus(self.acceleration, plus(cross(self.alpha, arm), cross(self.omega, sweep))),
            ..*self
        }
    }

    /// Turned about an axis of its own.
    fn turned(&self, axis: V3, q: f64, v: f64, a: f64) -> Motion {
        let n = apply(&self.rotation, scaled(1.0 / norm(axis), axis));
        Motion {
            rotation: product(&self.rotation, &about(axis, q)),
            omega: plus(self.omega, scaled(v, n)),
            alpha: plus(self.alpha, plus(scaled(a, n), scaled(v, cross(self.omega, n)))),
            ..*self
        }
    }

    /// Moved along an axis of its own.
    fn moved(&self, axis: V3, q: f64, v: f64, a: f64) -> Motion {
        let n = apply(&self.rotation, scaled(1.0 / norm(axis), axis));
        let arm = scaled(q, n);
        let (sweep, own) = (cross(self.omega, arm), scaled(v, n));
        let turning = plus(cross(self.alpha, arm), cross(self.omega, sweep));
        let coriolis = scaled(2.0, cross(self.omega, own));
        Motion {
            place: plus(self.place, arm),
            velocity: plus(self.velocity, plus(sweep, own)),
            acceleration: plus(self.acceleration, plus(turning, plus(coriolis, scaled(a, n)))),
            ..*self
        }
    }

    /// Turned by a quaternion; angular velocity and its rate of change in the new axes.
    fn spun(&self, q: &[f64], v: &[f64], a: &[f64]) -> Motion {
        let three = |list: &[f64]| [list[0], list[1], list[2]];
        let rotation = product(&self.rotation, &of_quaternion([q[0], q[1], q[2], q[3]]));
        let w = apply(&rotation, three(v));
        Motion {
            rotation,
            omega: plus(self.omega, w),
            alpha: plus(self.alpha, plus(apply(&rotation, three(a)), cross(self.omega, w))),
            ..*self
        }
    }
}

/// The turn and the place of a frame on its body.
pub fn seat(frame: &Frame, at: &Point) -> (Matrix, V3) {
    let (mut turn, mut place) = (identity(), [0.0; 3]);
    for step in &frame.steps {
        match step {
            Step::At(offset) => place = plus(place, apply(&turn, offset.value(at))),
            Step::Rotated(axis, angle) => turn = product(&turn, &about(axis.value(at), angle.value(at))),
            Step::Oriented(rows) => {
                let rows = rows.each_ref().map(|row| row.each_ref().map(|e| e.value(at)));
                turn = product(&turn, &rows);
            }
        }
    }
    (turn, place)
}

fn unit(k: usize) -> V3 {
    [0, 1, 2].map(|i| f64::from(u8::from(i == k)))
}

/// The frame of a joint on its child, from that on its parent.
pub fn beyond(joint: &Joint, from: Motion, q: &[f64], v: &[f64], a: &[f64], at: &Point) -> Motion {
    let turn = |m: Motion, axis: V3, k: usize| m.turned(axis, q[k], v[k], a[k]);
    let slide = |m: Motion, axis: V3, k: usize| m.moved(axis, q[k], v[k], a[k]);
    let angles = |m: Motion, k: usize| turn(turn(turn(m, unit(2), k + 2), unit(1), k + 1), unit(0), k);
    match &joint.kind {
        Kind::Fixed => from,
        Kind::Revolute(axis) => turn(from, axis.value(at), 0),
        Kind::Prismatic(axis) => slide(from, axis.value(at), 0),
        Kind::Screw(axis, pitch) => {
            let p = pitch.value(at);
            turn(from, axis.value(at), 0).moved(axis.value(at), p * q[0], p * v[0], p * a[0])
        }
        Kind::Cylindrical(axis) => turn(slide(from, axis.value(at), 0), axis.value(at), 1),
        Kind::Universal(first, second) => turn(turn(from, first.value(at), 0), second.value(at), 1),
        Kind::Planar(k, minus) => {
            let axis = scaled(if *minus { -1.0 } else { 1.0 }, unit(*k));
            turn(slide(slide(from, unit((k + 1) % 3), 0), unit((k + 2) % 3), 1), axis, 2)
        }
        Kind::PinSlot(axis, along) => turn(slide(from, along.value(at), 0), axis.value(at), 1),
        Kind::PlanarAlong(first, second) => {
            let (x, y) = (first.value(at), second.value(at));
            turn(slide(slide(from, x, 0), y, 1), cross(x, y), 2)
        }
        Kind::Ball(true) => angles(from, 0),
        Kind::Ball(false) => from.spun(q, v, a),
        Kind::Free(rpy) => {
            let there = slide(slide(slide(from, unit(0), 0), unit(1), 1), unit(2), 2);
            if *rpy { angles(there, 3) } else { there.spun(&q[3..], &v[3..], &a[3..]) }
        }
    }
}

/// xx, xy, ..: about the centre of mass in body axes.
fn tensor(body: &Body, at: &Point) -> Matrix {
    let diagonal = |x: f64, y: f64, z: f64| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let round = |across: f64, along: f64, axis: V3| {
        let n = scaled(1.0 / norm(axis), axis);
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| across * f64::from(u8::from(i == j)) + (along - across) * n[i] * n[j]))
    };
    let m = body.mass.value(at);
    match &body.inertia {
        Inertia::Point => [[0.0; 3]; 3],
        Inertia::Diagonal([x, y, z]) => diagonal(x.value(at), y.value(at), z.value(at)),
        Inertia::Full(list) => {
            let [xx, yy, zz, xy, xz, yz] = list.each_ref().map(|e| e.value(at));
            [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        }
        Inertia::Rod(length, axis) => {
            let l = length.value(at);
            round(m * l * l / 12.0, 0.0, axis.value(at))
        }
        Inertia::Cuboid(size) => {
            let s = size.value(at).map(|x| m * x * x / 12.0);
            diagonal(s[1] + s[2], s[0] + s[2], s[0] + s[1])
        }
        Inertia::Cylinder(radius, length, axis) => {
            let (r, l) = (radius.value(at), length.value(at));
            round(m * (3.0 * r * r + l * l) / 12.0, 0.5 * m * r * r, axis.value(at))
        }
        Inertia::Sphere(radius) => {
            let r = radius.value(at);
            let x = 0.4 * m * r * r;
            diagonal(x, x, x)
        }
    }
}

/// A mechanism at a point: everything that is read off it.
pub struct Plain<'a> {
    of: &'a Mechanism,
    at: &'a Point,
    /// Of the bodies.
    pub bodies: Vec<Motion>,
    /// Of the tree's joints' child frames.
    pub pivots: Vec<Motion>,
    /// Partial velocities of the bodies, velocity coordinate by velocity coordinate: linear of the origin, angular.
    pub partial: Vec<Vec<(V3, V3)>>,
}

fn motions(of: &Mechanism, at: &Point, v: &[Vec<f64>], a: &[Vec<f64>]) -> (Vec<Motion>, Vec<Motion>) {
    let (mut bodies, mut pivots): (Vec<Motion>, Vec<Motion>) = (Vec::new(), Vec::new());
    for (k, joint) in of.joints[..of.bodies.len()].iter().enumerate() {
        let on = joint.parent.body.map_or_else(Motion::still, |body| bodies[body]);
        let pivot = beyond(joint, on.carried(&seat(&joint.parent, at)), &at.q[k], &v[k], &a[k], at);
        let (turn, offset) = seat(&joint.child, at);
        let back = transposed(&turn);
        bodies.push(pivot.carried(&(back, scaled(-1.0, apply(&back, offset)))));
        pivots.push(pivot);
    }
    (bodies, pivots)
}

impl<'a> Plain<'a> {
    /// Everything moves as the point says.
    pub fn new(of: &'a Mechanism, at: &'a Point) -> Plain<'a> {
        let (bodies, pivots) = motions(of, at, &at.v, &at.a);
        let none: Vec<Vec<f64>> = at.v.iter().map(|list| vec![0.0; list.len()]).collect();
        let mut partial = Vec::new();
        for k in 0..of.bodies.len() {
            for i in 0..of.joints[k].kind.freedoms() {
                let mut one = none.clone();
                one[k][i] = 1.0;
                let (moving, _) = motions(of, at, &one, &none);
                partial.push(moving.iter().map(|m| (m.velocity, m.omega)).collect());
            }
        }
        Plain { of, at, bodies, pivots, partial }
    }

    /// A frame.
    pub fn frame(&self, frame: &Frame) -> Motion {
        frame.body.map_or_else(Motion::still, |body| self.bodies[body]).carried(&seat(frame, self.at))
    }

    fn gravity(&self) -> V3 {
        self.of.gravity.as_ref().map_or([0.0; 3], |g| g.value(self.at))
    }

    /// Momentum of turning about the centre of mass for an angular velocity.
    fn spin(&self, body: usize, w: V3) -> V3 {
        let r = self.bodies[body].rotation;
        apply(&r, apply(&tensor(&self.of.bodies[body], self.at), apply(&transposed(&r), w)))
    }

    fn centre(&self, body: usize) -> Motion {
        self.bodies[body].carried(&(identity(), self.of.bodies[body].com.value(self.at)))
    }

    /// What the motion of a body takes beside gravity: a force, and a moment about the body's origin.
    fn inertial(&self, body: usize) -> Wrench {
        let (m, c, on) = (self.of.bodies[body].mass.value(self.at), self.centre(body), &self.bodies[body]);
        let force = scaled(m, minus(c.acceleration, self.gravity()));
        let moment = plus(self.spin(body, c.alpha), cross(c.omega, self.spin(body, c.omega)));
        (force, plus(moment, cross(minus(c.place, on.place), force)))
    }

    /// Wrenches of declared forces on bodies, about their origins, and efforts on the tree's coordinates; and the power of
    /// what no potential belongs to.
    fn applied(&self) -> (Vec<Wrench>, Vec<Vec<f64>>, f64) {
        let none = [0.0; 3];
        let mut wrenches = vec![(none, none); self.of.bodies.len()];
        let mut efforts: Vec<Vec<f64>> = self.at.v.iter().map(|list| vec![0.0; list.len()]).collect();
        let mut power = 0.0;
        let mut push = |frame: &Frame, force: V3, moment: V3| {
            if let Some(body) = frame.body {
                let arm = minus(self.frame(frame).place, self.bodies[body].place);
                let (f, m) = wrenches[body];
                wrenches[body] = (plus(f, force), plus(m, plus(moment, cross(arm, force))));
            }
        };
        let value = |e: &Option<crate::mechanism::Expr>| e.as_ref().map_or(0.0, |e| e.value(self.at));
        for force in &self.of.forces {
            match force {
                Force::Effort { joint, component, values } => {
                    for (i, e) in values.iter().enumerate() {
                        let k = component.unwrap_or(i);
                        efforts[*joint][k] += e.value(self.at);
                        power += e.value(self.at) * self.at.v[*joint][k];
                    }
                }
                Force::JointSpring { joint, component, stiffness, damping, rest } => {
                    let (q, v) = (self.at.q[*joint][*component], self.at.v[*joint][*component]);
                    efforts[*joint][*component] -= value(stiffness) * (q - value(rest)) + value(damping) * v;
                    power -= value(damping) * v * v;
                }
                Force::LineSpring { between: [a, b], stiffness, damping, length } => {
                    let (from, to) = (self.frame(a), self.frame(b));
                    let d = minus(to.place, from.place);
                    let reach = norm(d);
                    // Where two points meet there is no direction, and no force.
                    let n = if reach > 1e-9 { scaled(1.0 / reach, d) } else { none };
                    let rate = dot(n, minus(to.velocity, from.velocity));
                    let pull = value(stiffness) * (reach - value(length)) + value(damping) * rate;
                    push(a, scaled(pull, n), none);
                    push(b, scaled(-pull, n), none);
                    power -= value(damping) * rate * rate;
                }
                Force::Wrench { torque, at, value, axes } => {
                    let x = apply(&self.frame(axes).rotation, value.value(self.at));
                    let on = self.frame(at);
                    if *torque {
                        push(at, none, x);
                        power += dot(x, on.omega);
                    } else {
                        push(at, x, none);
                        power += dot(x, on.velocity);
                    }
                }
            }
        }
        (wrenches, efforts, power)
    }

    /// What joints must exert on a body beside declared forces on it: a force, and a moment about its origin.
    pub fn needed(&self, body: usize) -> Wrench {
        let (need, have) = (self.inertial(body), self.applied().0[body]);
        (minus(need.0, have.0), minus(need.1, have.1))
    }

    /// Efforts that the motion needs beside declared forces, and the sum of sizes that they are made of.
    pub fn efforts(&self) -> (Vec<f64>, f64) {
        let (wrenches, own, _) = self.applied();
        let (mut efforts, mut size) = (Vec::new(), 0.0_f64);
        for (k, joint) in self.of.joints[..self.of.bodies.len()].iter().enumerate() {
            let armature = joint.armature.as_ref().map_or(0.0, |e| e.value(self.at));
            for (i, given) in own[k].iter().enumerate() {
                let partial = &self.partial[efforts.len()];
                let (mut sum, mut parts) = (armature * self.at.a[k][i] - given, given.abs());
                for (body, (velocity, omega)) in partial.iter().enumerate() {
                    let (need, have) = (self.inertial(body), wrenches[body]);
                    sum += dot(*velocity, minus(need.0, have.0)) + dot(*omega, minus(need.1, have.1));
                    parts += norm(*velocity) * (norm(need.0) + norm(have.0));
                    parts += norm(*omega) * (norm(need.1) + norm(have.1));
                }
                efforts.push(sum);
                size = size.max(parts);
            }
        }
        (efforts, size)
    }

    /// Kinetic energy; potential energy of gravity and springs.
    pub fn energies(&self) -> [f64; 2] {
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for (k, body) in self.of.bodies.iter().enumerate() {
            let (m, c) = (body.mass.value(self.at), self.centre(k));
            kinetic += 0.5 * (m * dot(c.velocity, c.velocity) + dot(c.omega, self.spin(k, c.omega)));
            potential -= m * dot(self.gravity(), c.place);
            if let Some(armature) = &self.of.joints[k].armature {
                kinetic += 0.5 * armature.value(self.at) * self.at.v[k][0] * self.at.v[k][0];
            }
        }
        for force in &self.of.forces {
            match force {
                Force::JointSpring { joint, component, stiffness: Some(k), rest, .. } => {
                    let x = self.at.q[*joint][*component] - rest.as_ref().map_or(0.0, |e| e.value(self.at));
                    potential += 0.5 * k.value(self.at) * x * x;
                }
                Force::LineSpring { between: [a, b], stiffness: Some(k), length, .. } => {
                    let reach = norm(minus(self.frame(b).place, self.frame(a).place));
                    let x = reach - length.as_ref().map_or(0.0, |e| e.value(self.at));
                    potential += 0.5 * k.value(self.at) * x * x;
                }
                _ => {}
            }
        }
        [kinetic, potential]
    }

    /// Power of efforts that the user gives and of declared forces without a potential.
    pub fn power(&self) -> f64 {
        self.applied().2
    }

    /// What a joint of the tree exerts on its child, at the child's frame, where no loops pull.
    pub fn reaction(&self, joint: usize) -> Wrench {
        let (wrenches, ..) = self.applied();
        let point = self.pivots[joint].place;
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        for (body, have) in wrenches.iter().enumerate() {
            if self.of.is_beyond(body, joint) {
                let need = self.inertial(body);
                let net = (minus(need.0, have.0), minus(need.1, have.1));
                force = plus(force, net.0);
                moment = plus(moment, plus(net.1, cross(minus(self.bodies[body].place, point), net.0)));
            }
        }
        (force, moment)
    }

    /// M: what unit accelerations need at rest, less what rest needs.
    pub fn mass_matrix(of: &Mechanism, at: &Point) -> DMatrix<f64> {
        let mut at = at.clone();
        at.v.iter_mut().chain(&mut at.a).for_each(|list| list.fill(0.0));
        let rest = DVector::from(Plain::new(of, &at).efforts().0);
        let n = of.freedoms();
        let mut matrix = DMatrix::zeros(n, n);
        let mut column = 0;
        for k in 0..of.bodies.len() {
            for i in 0..of.joints[k].kind.freedoms() {
                at.a[k][i] = 1.0;
                let efforts = DVector::from(Plain::new(of, &at).efforts().0);
                matrix.set_column(column, &(efforts - &rest));
                at.a[k][i] = 0.0;
                column += 1;
            }
        }
        matrix
    }
}

/// A list of numbers for all velocity coordinates, joint by joint.
pub fn split(of: &Mechanism, list: &[f64]) -> Vec<Vec<f64>> {
    let mut rest = list;
    let mut parts = Vec::new();
    for joint in &of.joints[..of.bodies.len()] {
        let (own, more) = rest.split_at(joint.kind.freedoms());
        parts.push(own.to_vec());
        rest = more;
    }
    parts
}

/// The positions a small way along a displacement, by the exponential of a quaternion's part.
pub fn displaced(of: &Mechanism, q: &[Vec<f64>], along: &[Vec<f64>], h: f64) -> Vec<Vec<f64>> {
    let mut result = q.to_vec();
    for (k, joint) in of.joints[..of.bodies.len()].iter().enumerate() {
        let Some(at) = joint.kind.quaternion() else {
            result[k].iter_mut().zip(&along[k]).for_each(|(x, d)| *x += h * d);
            continue;
        };
        (0..at).for_each(|i| result[k][i] += h * along[k][i]);
        let w = [0, 1, 2].map(|i| 0.5 * h * along[k][at + i]);
        let angle = norm(w);
        let factor = if angle > 0.0 { angle.sin() / angle } else { 1.0 };
        let small = [angle.cos(), factor * w[0], factor * w[1], factor * w[2]];
        let now = [0, 1, 2, 3].map(|i| q[k][at + i]);
        result[k][at..at + 4].copy_from_slice(&hamilton(now, small));
    }
    result
}
