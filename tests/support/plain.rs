//! The mechanisms of `data/random.json` in plain numbers, to compare generated code with.
//!
//! Nothing of the engine is used, and another principle: positions are written down as functions of time, differentiated
//! twice by [`Jet`]s, and efforts follow from virtual power, the sum over bodies of force times partial velocity (Kane).

use serde_json::Value;

use super::data::{array, flat, list, number};
use super::jet::{Jet, Matrix, Vector, about, apply, fixed, plus, times, transpose, turning};

type V3 = [f64; 3];

/// One mechanism.
pub struct Plain {
    bodies: Vec<Body>,
    gravity: V3,
    reaction: usize,
}

struct Body {
    parent: Option<usize>,
    mass: f64,
    com: V3,
    /// About the centre of mass, in body axes.
    inertia: [V3; 3],
    joint: Value,
    kind: String,
    /// Rotation and place of the joint's frame on the parent and on the body.
    at: (Matrix, Vector),
    on: (Matrix, Vector),
}

/// How a body moves, in world axes.
#[derive(Clone, Copy)]
struct Motion {
    rotation: [V3; 3],
    centre: V3,
    /// Velocity and acceleration of the centre of mass.
    velocity: V3,
    acceleration: V3,
    omega: V3,
    alpha: V3,
    /// Of the body's origin: position, velocity, acceleration.
    origin: [V3; 3],
    /// Of the joint's frame on the body.
    pivot: V3,
}

fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn linear(a: V3, k: f64, b: V3) -> V3 {
    [0, 1, 2].map(|i| a[i] + k * b[i])
}

fn product(m: &[V3; 3], v: V3) -> V3 {
    m.map(|row| dot(row, v))
}

impl Body {
    fn of(data: &Value) -> Body {
        let [xx, yy, zz, xy, xz, yz] = array(&data["inertia"]);
        let frame = |data: &Value| {
            let rows = [0, 1, 2].map(|k| array::<3>(&data[0][k]));
            (fixed(rows), array::<3>(&data[1]).map(Jet::fixed))
        };
        Body {
            parent: usize::try_from(data["parent"].as_i64().unwrap()).ok(),
            mass: number(&data["mass"]),
            com: array(&data["com"]),
            inertia: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            kind: data["joint"]["kind"].as_str().unwrap().to_owned(),
            joint: data["joint"].clone(),
            at: frame(&data["at"]),
            on: frame(&data["on"]),
        }
    }

    fn freedoms(&self) -> usize {
        match self.kind.as_str() {
            "Fixed" => 0,
            "Revolute" | "Prismatic" | "Screw" => 1,
            "Cylindrical" | "Universal" => 2,
            "Planar" | "Ball" | "BallAngles" => 3,
            "Free" | "FreeAngles" => 6,
            other => panic!("what is a {other}?"),
        }
    }

    fn coordinates(&self) -> usize {
        self.freedoms() + usize::from(matches!(self.kind.as_str(), "Ball" | "Free"))
    }

    fn armature(&self) -> f64 {
        self.joint.get("armature").map_or(0.0, number)
    }

    /// The child's frame in the parent's: from coordinates, velocities, accelerations of this joint alone.
    fn motion(&self, q: &[f64], v: &[f64], a: &[f64]) -> (Matrix, Vector) {
        let jet = |k: usize| Jet([q[k], v[k], a[k]]);
        let still = fixed([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let none = [Jet::fixed(0.0); 3];
        let axis = || array::<3>(&self.joint["axis"]);
        let along = |axis: V3, x: Jet| axis.map(|n| Jet::fixed(n) * x);
        let angles = |k: usize| {
            let [roll, pitch, yaw] =
                [0, 1, 2].map(|i| about([0, 1, 2].map(|j| f64::from(u8::from(i == j))), jet(k + i)));
            times(&yaw, &times(&pitch, &roll))
        };
        let spin = |k: usize, l: usize| {
            turning([q[k], q[k + 1], q[k + 2], q[k + 3]], [v[l], v[l + 1], v[l + 2]], [a[l], a[l + 1], a[l + 2]])
        };
        match self.kind.as_str() {
            "Fixed" => (still, none),
            "Revolute" => (about(axis(), jet(0)), none),
            "Prismatic" => (still, along(axis(), jet(0))),
            "Screw" => (about(axis(), jet(0)), along(axis(), Jet::fixed(number(&self.joint["pitch"])) * jet(0))),
            "Cylindrical" => (about(axis(), jet(1)), along(axis(), jet(0))),
            "Universal" => {
                let [one, two] = [0, 1].map(|k| about(array(&self.joint["axes"][k]), jet(k)));
                (times(&one, &two), none)
            }
            "Planar" => {
                let index = self.joint["index"].as_u64().unwrap() as usize;
                let unit = |k: usize| [0, 1, 2].map(|i| f64::from(u8::from((index + k) % 3 == i)));
                (about(unit(0), jet(2)), plus(along(unit(1), jet(0)), along(unit(2), jet(1))))
            }
            "Ball" => (spin(0, 0), none),
            "BallAngles" => (angles(0), none),
            "Free" => (spin(3, 3), [jet(0), jet(1), jet(2)]),
            "FreeAngles" => (angles(3), [jet(0), jet(1), jet(2)]),
            other => panic!("what is a {other}?"),
        }
    }
}

/// Angular velocity and acceleration of a turning matrix: R' R^T and its derivative.
fn angular(r: &Matrix) -> (V3, V3) {
    let part = |k: usize| r.map(|row| row.map(|x| x.0[k]));
    let by = |a: &[V3; 3], b: &[V3; 3]| [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(a[i], b[j])));
    let (r, d, dd) = (part(0), part(1), part(2));
    let vee = |m: [V3; 3]| [0.5 * (m[2][1] - m[1][2]), 0.5 * (m[0][2] - m[2][0]), 0.5 * (m[1][0] - m[0][1])];
    let (first, second) = (by(&dd, &r), by(&d, &d));
    (vee(by(&d, &r)), vee([0, 1, 2].map(|i| linear(first[i], 1.0, second[i]))))
}

impl Plain {
    /// All mechanisms of the file.
    pub fn all(file: &Value) -> Vec<Plain> {
        list(file).iter().map(Plain::of).collect()
    }

    fn of(data: &Value) -> Plain {
        let bodies = list(&data["bodies"]).iter().map(Body::of).collect();
        let reaction = data["reaction"].as_u64().unwrap() as usize;
        Plain { bodies, gravity: flat(&data["gravity"]).try_into().unwrap(), reaction }
    }

    /// Number of velocity coordinates.
    pub fn freedoms(&self) -> usize {
        self.bodies.iter().map(Body::freedoms).sum()
    }

    /// Where quaternions stand among the position coordinates.
    pub fn quaternions(&self) -> Vec<usize> {
        let mut at = 0;
        let mut places = Vec::new();
        for body in &self.bodies {
            match body.kind.as_str() {
                "Ball" => places.push(at),
                "Free" => places.push(at + 3),
                _ => {}
            }
            at += body.coordinates();
        }
        places
    }

    /// Number of position coordinates.
    pub fn coordinates(&self) -> usize {
        self.bodies.iter().map(Body::coordinates).sum()
    }

    fn motions(&self, mut q: &[f64], mut v: &[f64], mut a: &[f64]) -> Vec<Motion> {
        let mut poses: Vec<(Matrix, Vector)> = Vec::new();
        let mut motions = Vec::new();
        for body in &self.bodies {
            let (of_joint, from) = body.motion(q, v, a);
            (q, v, a) = (&q[body.coordinates()..], &v[body.freedoms()..], &a[body.freedoms()..]);
            let (mut rotation, mut place) = body.at;
            if let Some(parent) = body.parent {
                let (turn, start) = poses[parent];
                place = plus(start, apply(&turn, place));
                rotation = times(&turn, &rotation);
            }
            let pivot = plus(place, apply(&rotation, from));
            let rotation = times(&times(&rotation, &of_joint), &transpose(&body.on.0));
            let place = plus(pivot, apply(&rotation, body.on.1.map(|x| -x)));
            poses.push((rotation, place));
            let centre = plus(place, apply(&rotation, body.com.map(Jet::fixed)));
            let part = |v: &Vector, k: usize| v.map(|x| x.0[k]);
            let (omega, alpha) = angular(&rotation);
            motions.push(Motion {
                rotation: rotation.map(|row| part(&row, 0)),
                centre: part(&centre, 0),
                velocity: part(&centre, 1),
                acceleration: part(&centre, 2),
                omega,
                alpha,
                origin: [0, 1, 2].map(|k| part(&place, k)),
                pivot: part(&pivot, 0),
            });
        }
        motions
    }

    /// Angular momentum of a turning body about its centre of mass for the angular velocity `w`, in world axes.
    fn spin(body: &Body, motion: &Motion, w: V3) -> V3 {
        let r = motion.rotation;
        let local = [0, 1, 2].map(|j| r[0][j] * w[0] + r[1][j] * w[1] + r[2][j] * w[2]);
        product(&r, product(&body.inertia, local))
    }

    /// Force and moment about the centre of mass that the motion of every body takes.
    fn wrenches(&self, motions: &[Motion]) -> Vec<(V3, V3)> {
        let wrench = |(body, motion): (&Body, &Motion)| {
            let force = linear(motion.acceleration, -1.0, self.gravity).map(|x| body.mass * x);
            let gyration = cross(motion.omega, Plain::spin(body, motion, motion.omega));
            (force, linear(Plain::spin(body, motion, motion.alpha), 1.0, gyration))
        };
        self.bodies.iter().zip(motions).map(wrench).collect()
    }

    /// Efforts by virtual power.
    pub fn inverse_dynamics(&self, q: &[f64], v: &[f64], a: &[f64]) -> Vec<f64> {
        let n = self.freedoms();
        let motions = self.motions(q, v, a);
        let wrenches = self.wrenches(&motions);
        let armatures: Vec<f64> = self.bodies.iter().flat_map(|b| vec![b.armature(); b.freedoms()]).collect();
        let effort = |k: usize| {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            let partial = self.motions(q, &unit, &vec![0.0; n]);
            let powers = partial.iter().zip(&wrenches).map(|(m, w)| dot(m.velocity, w.0) + dot(m.omega, w.1));
            powers.sum::<f64>() + armatures[k] * a[k]
        };
        (0..n).map(effort).collect()
    }

    /// Efforts without accelerations.
    pub fn bias(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        self.inverse_dynamics(q, v, &vec![0.0; self.freedoms()])
    }

    /// Row by row: what unit accelerations need at rest without gravity.
    pub fn mass_matrix(&self, q: &[f64]) -> Vec<f64> {
        let n = self.freedoms();
        let rest = self.bias(q, &vec![0.0; n]);
        let column = |k: usize| {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            let efforts = self.inverse_dynamics(q, &vec![0.0; n], &unit);
            efforts.iter().zip(&rest).map(|(a, b)| a - b).collect::<Vec<f64>>()
        };
        // Symmetric, so columns are rows.
        (0..n).flat_map(column).collect()
    }

    /// Kinetic and potential energy.
    pub fn energies(&self, q: &[f64], v: &[f64]) -> [f64; 2] {
        let motions = self.motions(q, v, &vec![0.0; self.freedoms()]);
        let (mut kinetic, mut potential, mut rest) = (0.0, 0.0, v);
        for (body, motion) in self.bodies.iter().zip(&motions) {
            let own = rest[..body.freedoms()].iter().map(|x| x * x).sum::<f64>();
            rest = &rest[body.freedoms()..];
            kinetic += 0.5 * (body.mass * dot(motion.velocity, motion.velocity) + body.armature() * own);
            kinetic += 0.5 * dot(motion.omega, Plain::spin(body, motion, motion.omega));
            potential -= body.mass * dot(self.gravity, motion.centre);
        }
        [kinetic, potential]
    }

    /// Of the last body: position, velocity, angular velocity and acceleration; then force and moment of the reaction.
    pub fn outputs(&self, q: &[f64], v: &[f64], a: &[f64]) -> [V3; 6] {
        let motions = self.motions(q, v, a);
        let wrenches = self.wrenches(&motions);
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        let point = motions[self.reaction].pivot;
        for k in 0..self.bodies.len() {
            if self.is_beyond(k) {
                force = linear(force, 1.0, wrenches[k].0);
                let arm = linear(motions[k].centre, -1.0, point);
                moment = linear(linear(moment, 1.0, wrenches[k].1), 1.0, cross(arm, wrenches[k].0));
            }
        }
        let last = motions[motions.len() - 1];
        [last.origin[0], last.origin[1], last.omega, last.origin[2], force, moment]
    }

    /// Whether a body hangs on the joint whose reaction is asked for.
    fn is_beyond(&self, body: usize) -> bool {
        body == self.reaction || self.bodies[body].parent.is_some_and(|parent| self.is_beyond(parent))
    }
}
