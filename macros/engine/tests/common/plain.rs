//! Dynamics of a random mechanism in plain numbers: what the engine's graphs are compared with.
//!
//! Nothing of the engine is used, and other formulas: 6-D spatial vectors with spatial (not classical) accelerations, 6x6
//! inertias about the origin by the parallel-axis theorem (Featherstone 2008, chapters 2 and 5), the mass matrix column
//! by column from inverse dynamics, Gaussian elimination with pivoting.

use super::random::{Body, Kind, Mechanism, matrix};

type V3 = [f64; 3];
type V6 = [f64; 6];
type M3 = [V3; 3];

/// Joint coordinates in the child's frame: the frame's orientation and origin in the parent, and its unit twists.
struct Joint {
    rotation: M3,
    origin: V3,
    twists: Vec<V6>,
}

pub(crate) fn inverse_dynamics(mechanism: &Mechanism, q: &[f64], v: &[f64], a: &[f64], gravity: V3) -> Vec<f64> {
    let joints = joints(mechanism, q);
    let mut motions: Vec<(V6, V6)> = Vec::new();
    let mut forces: Vec<V6> = Vec::new();
    let mut first = 0;
    for (body, joint) in mechanism.bodies.iter().zip(&joints) {
        let at_rest = ([0.0; 6], join([0.0; 3], gravity.map(|g| -g)));
        let (parent_v, parent_a) = body.parent.map_or(at_rest, |p| motions[p]);
        let mut own = [0.0; 6];
        let mut rate = [0.0; 6];
        for (k, twist) in joint.twists.iter().enumerate() {
            own = add(own, twist.map(|s| s * v[first + k]));
            rate = add(rate, twist.map(|s| s * a[first + k]));
        }
        first += joint.twists.len();
        let velocity = add(joint.to_child(parent_v), own);
        let acceleration = add(add(joint.to_child(parent_a), rate), cross_motion(velocity, own));
        let inertia = spatial_inertia(body);
        let momentum = times(&inertia, velocity);
        forces.push(add(times(&inertia, acceleration), cross_force(velocity, momentum)));
        motions.push((velocity, acceleration));
    }
    let mut efforts = vec![0.0; mechanism.freedoms()];
    let mut last = mechanism.freedoms();
    for (index, (body, joint)) in mechanism.bodies.iter().zip(&joints).enumerate().rev() {
        last -= joint.twists.len();
        for (k, twist) in joint.twists.iter().enumerate() {
            efforts[last + k] = dot6(*twist, forces[index]) + body.armature * a[last + k];
        }
        if let Some(p) = body.parent {
            forces[p] = add(forces[p], joint.to_parent(forces[index]));
        }
    }
    efforts
}

pub(crate) fn bias(mechanism: &Mechanism, q: &[f64], v: &[f64]) -> Vec<f64> {
    inverse_dynamics(mechanism, q, v, &vec![0.0; v.len()], mechanism.gravity)
}

/// Row by row.
pub(crate) fn mass_matrix(mechanism: &Mechanism, q: &[f64]) -> Vec<Vec<f64>> {
    let n = mechanism.freedoms();
    let columns: Vec<Vec<f64>> = (0..n)
        .map(|k| {
            let mut unit = vec![0.0; n];
            unit[k] = 1.0;
            inverse_dynamics(mechanism, q, &vec![0.0; n], &unit, [0.0; 3])
        })
        .collect();
    (0..n).map(|i| (0..n).map(|j| columns[j][i]).collect()).collect()
}

pub(crate) fn forward_dynamics(mechanism: &Mechanism, q: &[f64], v: &[f64], effort: &[f64]) -> Vec<f64> {
    let rest = effort.iter().zip(bias(mechanism, q, v)).map(|(e, b)| e - b).collect();
    solve(mass_matrix(mechanism, q), rest)
}

pub(crate) fn solve(mut m: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| m[i][k].abs().total_cmp(&m[j][k].abs())).unwrap();
        m.swap(k, best);
        b.swap(k, best);
        for i in k + 1..n {
            b[i] -= subtract_row(&mut m, i, k) * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| m[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / m[k][k];
    }
    b
}

/// Smallest pivot of Cholesky's factorisation: positive if and only if the matrix is positive definite.
pub(crate) fn smallest_pivot(m: &[Vec<f64>]) -> f64 {
    let mut m = m.to_vec();
    let mut smallest = f64::INFINITY;
    for k in 0..m.len() {
        smallest = smallest.min(m[k][k]);
        for i in k + 1..m.len() {
            subtract_row(&mut m, i, k);
        }
    }
    smallest
}

/// Clears entry (i, k) by a multiple of row k, which is returned.
fn subtract_row(m: &mut [Vec<f64>], i: usize, k: usize) -> f64 {
    let pivot = m[k].clone();
    let factor = m[i][k] / pivot[k];
    m[i].iter_mut().zip(pivot).for_each(|(entry, p)| *entry -= factor * p);
    factor
}

fn joints(mechanism: &Mechanism, q: &[f64]) -> Vec<Joint> {
    let mut at = 0;
    let mut joints = Vec::new();
    for body in &mechanism.bodies {
        let q = &q[at..at + body.kind.coordinates()];
        at += q.len();
        joints.push(joint(body, q));
    }
    joints
}

fn joint(body: &Body, q: &[f64]) -> Joint {
    let placed = matrix(body.placement);
    let unit = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    let along = |axis: usize, length: f64| -> V3 { std::array::from_fn(|i| placed[i][axis] * length + body.offset[i]) };
    match body.kind {
        Kind::Revolute(axis) => {
            Joint { rotation: product(&placed, &turn(axis, q[0])), origin: body.offset, twists: vec![unit(axis)] }
        }
        Kind::Prismatic(axis) => Joint { rotation: placed, origin: along(axis, q[0]), twists: vec![unit(axis + 3)] },
        Kind::Screw(axis, pitch) => {
            let mut twist: V6 = unit(axis);
            twist[axis + 3] = pitch;
            let rotation = product(&placed, &turn(axis, q[0]));
            Joint { rotation, origin: along(axis, pitch * q[0]), twists: vec![twist] }
        }
        Kind::Ball => {
            let rotation = product(&placed, &quaternion([q[0], q[1], q[2], q[3]]));
            Joint { rotation, origin: body.offset, twists: (0..3).map(unit).collect() }
        }
    }
}

impl Joint {
    /// A motion vector of the parent, at the child's origin in the child's axes.
    fn to_child(&self, m: V6) -> V6 {
        let (w, v) = split(m);
        let moved = add3(v, cross(w, self.origin));
        join(transposed(&self.rotation, w), transposed(&self.rotation, moved))
    }

    /// A force vector of the child, at the parent's origin in the parent's axes.
    fn to_parent(&self, f: V6) -> V6 {
        let (n, f) = split(f);
        let (n, f) = (rotated(&self.rotation, n), rotated(&self.rotation, f));
        join(add3(n, cross(self.origin, f)), f)
    }
}

/// About the frame's origin: (I_c + m c x c x^T, m c x; m c x^T, m 1).
fn spatial_inertia(body: &Body) -> [V6; 6] {
    let [xx, yy, zz, xy, xz, yz] = body.tensor;
    let about_com = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let c = body.com;
    let hat = [[0.0, -c[2], c[1]], [c[2], 0.0, -c[0]], [-c[1], c[0], 0.0]];
    let mut m = [[0.0; 6]; 6];
    for i in 0..3 {
        for j in 0..3 {
            let steiner: f64 = (0..3).map(|k| hat[i][k] * hat[j][k]).sum();
            m[i][j] = about_com[i][j] + body.mass * steiner;
            m[i][j + 3] = body.mass * hat[i][j];
            m[j + 3][i] = m[i][j + 3];
        }
        m[i + 3][i + 3] = body.mass;
    }
    m
}

fn turn(axis: usize, angle: f64) -> M3 {
    let (s, c) = angle.sin_cos();
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = [[0.0; 3]; 3];
    m[axis][axis] = 1.0;
    (m[j][j], m[j][k], m[k][j], m[k][k]) = (c, -s, s, c);
    m
}

/// The homogeneous form, quadratic in all four.
fn quaternion([w, x, y, z]: [f64; 4]) -> M3 {
    [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
}

/// v x m
fn cross_motion(v: V6, m: V6) -> V6 {
    let ((w, u), (a, b)) = (split(v), split(m));
    join(cross(w, a), add3(cross(w, b), cross(u, a)))
}

/// v x* f
fn cross_force(v: V6, f: V6) -> V6 {
    let ((w, u), (n, f)) = (split(v), split(f));
    join(add3(cross(w, n), cross(u, f)), cross(w, f))
}

fn times(m: &[V6; 6], x: V6) -> V6 {
    m.map(|row| dot6(row, x))
}

fn dot6(a: V6, b: V6) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(a: V6, b: V6) -> V6 {
    std::array::from_fn(|k| a[k] + b[k])
}

fn add3(a: V3, b: V3) -> V3 {
    std::array::from_fn(|k| a[k] + b[k])
}

fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn split(x: V6) -> (V3, V3) {
    ([x[0], x[1], x[2]], [x[3], x[4], x[5]])
}

fn join(a: V3, b: V3) -> V6 {
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}

fn product(a: &M3, b: &M3) -> M3 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn rotated(m: &M3, v: V3) -> V3 {
    std::array::from_fn(|i| (0..3).map(|k| m[i][k] * v[k]).sum())
}

fn transposed(m: &M3, v: V3) -> V3 {
    std::array::from_fn(|i| (0..3).map(|k| m[k][i] * v[k]).sum())
}
