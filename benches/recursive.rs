//! Baseline: the textbook recursions over any tree of one-coordinate joints, on nalgebra's fixed-size types.
//!
//! In: the data of `tests/data/robots`. Newton-Euler in body axes, composite rigid bodies, and Cholesky's factors for
//! forward dynamics (Featherstone 2008, chapters 5 and 6). Inertias are kept as mass, first moment and tensor about the
//! joint, rotations as matrices, all on the stack.

use multibody::nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Unit, Vector3};
use serde_json::Value;

/// Mass, first moment and inertia tensor about the joint's origin.
#[derive(Clone, Copy)]
struct Inertia {
    mass: f64,
    first: Vector3<f64>,
    tensor: Matrix3<f64>,
}

#[derive(Clone, Copy)]
struct Link {
    parent: Option<usize>,
    /// Of the joint at zero, in the parent's axes.
    rotation: Rotation3<f64>,
    offset: Vector3<f64>,
    revolute: bool,
    axis: Unit<Vector3<f64>>,
    inertia: Inertia,
}

/// A tree of `N` bodies, parents first.
#[derive(Clone, Copy)]
pub struct Tree<const N: usize> {
    links: [Link; N],
    gravity: Vector3<f64>,
}

/// Rotation to the parent's axes and the origin in them.
#[derive(Clone, Copy)]
struct Place {
    rotation: Rotation3<f64>,
    offset: Vector3<f64>,
}

impl<const N: usize> Tree<N> {
    /// From the text of a `*.model.json`.
    pub fn read(text: &str) -> Self {
        let model: Value = serde_json::from_str(text).expect("a model");
        let joints = &model["joints"];
        assert_eq!(joints.as_array().map(Vec::len), Some(N));
        let links = std::array::from_fn(|i| Link::read(&joints[i]));
        Self { links, gravity: vector(&model["gravity"]) }
    }

    /// Efforts for these positions, velocities and accelerations.
    #[inline(never)]
    pub fn inverse_dynamics(&self, q: &SVector<f64, N>, v: &SVector<f64, N>, a: &SVector<f64, N>) -> SVector<f64, N> {
        let places = self.places(q);
        let zero = Vector3::zeros();
        let mut motions = [(zero, zero, zero); N];
        let mut forces = [(zero, zero); N];
        for (i, link) in self.links.iter().enumerate() {
            let (w, dw, acc) = link.parent.map_or((zero, zero, -self.gravity), |parent| motions[parent]);
            let Place { rotation, offset } = &places[i];
            let acc = rotation.inverse_transform_vector(&(acc + dw.cross(offset) + w.cross(&w.cross(offset))));
            let (w, dw) = (rotation.inverse_transform_vector(&w), rotation.inverse_transform_vector(&dw));
            let (rate, accel) = (*link.axis * v[i], *link.axis * a[i]);
            let (w, dw, acc) = if link.revolute {
                (w + rate, dw + w.cross(&rate) + accel, acc)
            } else {
                (w, dw, acc + 2.0 * w.cross(&rate) + accel)
            };
            motions[i] = (w, dw, acc);
            let Inertia { mass, first, tensor } = &link.inertia;
            let force = *mass * acc + dw.cross(first) + w.cross(&w.cross(first));
            let moment = tensor * dw + w.cross(&(tensor * w)) + first.cross(&acc);
            forces[i] = (force, moment);
        }
        let mut efforts = SVector::zeros();
        for (i, link) in self.links.iter().enumerate().rev() {
            let (force, moment) = forces[i];
            efforts[i] = link.axis.dot(if link.revolute { &moment } else { &force });
            if let Some(parent) = link.parent {
                let (force, moment) = places[i].carry(force, moment);
                forces[parent].0 += force;
                forces[parent].1 += moment;
            }
        }
        efforts
    }

    /// The mass matrix.
    #[inline(never)]
    pub fn mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        let places = self.places(q);
        let mut composite = self.links.map(|link| link.inertia);
        let mut matrix = SMatrix::zeros();
        for (i, link) in self.links.iter().enumerate().rev() {
            let body = composite[i];
            if let Some(parent) = link.parent {
                let moved = body.moved(&places[i]);
                let sum = &mut composite[parent];
                sum.mass += moved.mass;
                sum.first += moved.first;
                sum.tensor += moved.tensor;
            }
            let axis = link.axis.into_inner();
            let (mut force, mut moment) = if link.revolute {
                (axis.cross(&body.first), body.tensor * axis)
            } else {
                (axis * body.mass, body.first.cross(&axis))
            };
            let mut j = i;
            loop {
                let to = &self.links[j];
                let entry = to.axis.dot(if to.revolute { &moment } else { &force });
                matrix[(i, j)] = entry;
                matrix[(j, i)] = entry;
                let Some(parent) = to.parent else { break };
                (force, moment) = places[j].carry(force, moment);
                j = parent;
            }
        }
        matrix
    }

    /// Accelerations for these positions, velocities and efforts.
    #[inline(never)]
    pub fn forward_dynamics(
        &self,
        q: &SVector<f64, N>,
        v: &SVector<f64, N>,
        effort: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let rest = effort - self.inverse_dynamics(q, v, &SVector::zeros());
        self.mass_matrix(q).cholesky().map_or(rest, |factors| factors.solve(&rest))
    }

    fn places(&self, q: &SVector<f64, N>) -> [Place; N] {
        std::array::from_fn(|i| {
            let Link { rotation, offset, revolute, axis, .. } = &self.links[i];
            if *revolute {
                Place { rotation: rotation * Rotation3::from_axis_angle(axis, q[i]), offset: *offset }
            } else {
                Place { rotation: *rotation, offset: offset + rotation * (**axis * q[i]) }
            }
        })
    }
}

impl Place {
    /// A force and its moment about the origin, in the parent's axes and about the parent's origin.
    fn carry(&self, force: Vector3<f64>, moment: Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let force = self.rotation * force;
        (force, self.rotation * moment + self.offset.cross(&force))
    }
}

impl Inertia {
    fn moved(&self, place: &Place) -> Self {
        let (r, p) = (place.rotation.matrix(), &place.offset);
        let first = r * self.first;
        let tensor = r * self.tensor * r.transpose();
        // Steiner twice: about the new origin the first moment is first + m p.
        let square = |a: &Vector3<f64>, b: &Vector3<f64>| Matrix3::from_diagonal_element(a.dot(b)) - b * a.transpose();
        let shift = square(&first, p) + square(p, &first) + square(p, p) * self.mass;
        Self { mass: self.mass, first: first + p * self.mass, tensor: tensor + shift }
    }
}

impl Link {
    fn read(joint: &Value) -> Self {
        let placement = &joint["placement"];
        let (mass, com) = (number(&joint["mass"]), vector(&joint["com"]));
        let about_com = matrix(&joint["inertia_com"]);
        let steiner = Matrix3::from_diagonal_element(com.norm_squared()) - com * com.transpose();
        Self {
            parent: joint["parent"].as_u64().map(|parent| parent as usize),
            rotation: Rotation3::from_matrix_unchecked(matrix(&placement["R"])),
            offset: vector(&placement["p"]),
            revolute: joint["type"].as_str().is_some_and(|kind| kind.starts_with('R')),
            axis: Unit::new_unchecked(vector(&joint["axis"])),
            inertia: Inertia { mass, first: com * mass, tensor: about_com + steiner * mass },
        }
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn vector(list: &Value) -> Vector3<f64> {
    Vector3::from_fn(|k, _| number(&list[k]))
}

fn matrix(rows: &Value) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| number(&rows[i][j]))
}
