//! Stage `symbolic`: constructors of vectors and rotations.
//!
//! In: operands. Out: the one node that has the value. Rotations about a common axis add their angles; a vector that a
//! rotation leaves as it is comes back as itself, since its print is the same.

use std::ops::{Add, Mul, Neg, Sub};

use super::fingerprint::Print;
use super::graph::{Graph, Rotation, RotationNode, Scalar, Vector, VectorNode};
use super::number::Number;

type Matrix = [[Print; 3]; 3];

impl Graph {
    /// A vector from its components.
    pub fn vector(&mut self, components: [Scalar; 3]) -> Vector {
        let print = components.map(|c| self.print(c));
        self.find_vector(print).unwrap_or_else(|| self.insert_vector(VectorNode::Triple(components), print))
    }

    /// A coordinate axis times a scalar.
    pub fn along(&mut self, axis: usize, length: Scalar) -> Vector {
        let mut components = [Scalar::ZERO; 3];
        components[axis] = length;
        self.vector(components)
    }

    pub fn components(&mut self, v: Vector) -> [Scalar; 3] {
        [0, 1, 2].map(|axis| self.component(v, axis))
    }

    pub fn add_vectors(&mut self, a: Vector, b: Vector) -> Vector {
        self.sum_vectors(&[a, b])
    }

    pub fn sub_vectors(&mut self, a: Vector, b: Vector) -> Vector {
        self.sum_vectors(&[a, -b])
    }

    /// N-ary sum.
    pub fn sum_vectors(&mut self, terms: &[Vector]) -> Vector {
        let print = terms.iter().fold([Print::ZERO; 3], |sum, &t| {
            let p = self.vector_print(t);
            std::array::from_fn(|k| sum[k].add(p[k]))
        });
        if let Some(found) = self.find_vector(print) {
            return found;
        }
        let mut list: Vec<Vector> = terms.iter().copied().filter(|&t| t != Vector::ZERO).collect();
        list.sort_unstable();
        if let [single] = list[..] {
            return single;
        }
        // Triples add up componentwise: nothing is hidden in them that a later pass could use.
        if list.iter().all(|&t| matches!(self.vector_node(t), VectorNode::Triple(_))) {
            let components = [0, 1, 2].map(|axis| {
                let terms: Vec<Scalar> = list.iter().map(|&t| self.component(t, axis)).collect();
                self.sum(&terms)
            });
            return self.vector(components);
        }
        self.insert_vector(VectorNode::Sum(list.into()), print)
    }

    pub fn scale(&mut self, s: Scalar, v: Vector) -> Vector {
        let factor = self.print(s);
        let print = self.vector_print(v).map(|p| p.mul(factor));
        if let Some(found) = self.find_vector(print) {
            return found;
        }
        if let &VectorNode::Triple(components) = self.vector_node(v) {
            let scaled = components.map(|c| self.mul(s, c));
            let result = self.vector(scaled);
            return result.flip_if(v.is_negative());
        }
        let node = VectorNode::Scale(s.positive(), v.flip_if(v.is_negative()));
        let flip = s.is_negative() != v.is_negative();
        self.insert_vector(node, if flip { print.map(Print::neg) } else { print }).flip_if(flip)
    }

    pub fn cross(&mut self, a: Vector, b: Vector) -> Vector {
        let (p, q) = (self.vector_print(a), self.vector_print(b));
        let print = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            p[j].mul(q[k]).sub(p[k].mul(q[j]))
        });
        if let Some(found) = self.find_vector(print) {
            return found;
        }
        if let (Some(a), Some(b)) = (self.literal_vector(a), self.literal_vector(b)) {
            let components = [0, 1, 2].map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                self.number(a[j] * b[k] - a[k] * b[j])
            });
            return self.vector(components);
        }
        let flip = a.is_negative() != b.is_negative();
        let node = VectorNode::Cross(a.flip_if(a.is_negative()), b.flip_if(b.is_negative()));
        self.insert_vector(node, if flip { print.map(Print::neg) } else { print }).flip_if(flip)
    }

    /// Applies a rotation (or its transpose, if the handle says so).
    pub fn rotate(&mut self, r: Rotation, v: Vector) -> Vector {
        let m = self.rotation_print(r);
        let print = apply(&m, &self.vector_print(v));
        if let Some(found) = self.find_vector(print) {
            return found;
        }
        let flip = v.is_negative();
        let node = VectorNode::Rotate(r, v.flip_if(flip));
        self.insert_vector(node, if flip { print.map(Print::neg) } else { print }).flip_if(flip)
    }

    /// Rotation about a coordinate axis.
    pub fn axis_rotation(&mut self, axis: usize, angle: Scalar) -> Rotation {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        if self.literal(angle).is_some() {
            let (s, c) = (self.sin(angle), self.cos(angle));
            return self.point_rotation(axis, c, s);
        }
        let point = self.point(angle);
        let (c, s) = (point.cos, point.sin);
        let mut m = [[Print::ZERO; 3]; 3];
        m[axis][axis] = Print::ONE;
        (m[j][j], m[j][k], m[k][j], m[k][k]) = (c, s.neg(), s, c);
        if let Some(found) = self.find_rotation(&m) {
            return found;
        }
        if angle.is_negative() {
            return self.axis_rotation(axis, -angle).transpose();
        }
        self.insert_rotation(RotationNode::Axis(axis, angle), m)
    }

    /// Rotation about a coordinate axis by the angle with this cosine and sine.
    pub fn point_rotation(&mut self, axis: usize, cos: Scalar, sin: Scalar) -> Rotation {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut rows = [[Scalar::ZERO; 3]; 3];
        rows[axis][axis] = Scalar::ONE;
        (rows[j][j], rows[j][k], rows[k][j], rows[k][k]) = (cos, -sin, sin, cos);
        self.matrix_rotation(rows)
    }

    /// A rotation of literals whose entries all lie this near to those of a matrix.
    pub fn near_rotation(&self, m: &[[f64; 3]; 3], reach: f64) -> Option<Rotation> {
        let entry = |rows: &[[Scalar; 3]; 3], i: usize, j: usize| self.literal(rows[i][j]).map(Number::value);
        let near = |x: Option<f64>, y: f64| x.is_some_and(|x| (x - y).abs() <= reach);
        let is_near = |rows: &[[Scalar; 3]; 3], transposed: bool| {
            (0..3).all(|i| (0..3).all(|j| near(entry(rows, i, j), if transposed { m[j][i] } else { m[i][j] })))
        };
        self.rotations.iter().enumerate().find_map(|(index, node)| match node {
            RotationNode::Matrix(rows) if is_near(rows, false) => Some(Rotation::new(index, false)),
            RotationNode::Matrix(rows) if is_near(rows, true) => Some(Rotation::new(index, true)),
            _ => None,
        })
    }

    /// All rotations of literals that are no identity, with their entries row by row, and then their inverses.
    pub fn literal_rotations(&self) -> Vec<(Rotation, [[f64; 3]; 3])> {
        let value = |s: Scalar| self.literal(s).map(Number::value);
        let matrix = |(index, node): (usize, &RotationNode)| {
            let RotationNode::Matrix(rows) = node else { return None };
            let mut m = [[0.0; 3]; 3];
            for (entry, &s) in m.iter_mut().flatten().zip(rows.iter().flatten()) {
                *entry = value(s)?;
            }
            Some((index, m))
        };
        let found: Vec<(usize, [[f64; 3]; 3])> = self.rotations.iter().enumerate().filter_map(matrix).collect();
        let forth = found.iter().map(|&(index, m)| (Rotation::new(index, false), m));
        let turned = |m: [[f64; 3]; 3]| [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]));
        forth.chain(found.iter().map(|&(index, m)| (Rotation::new(index, true), turned(m)))).collect()
    }

    /// From an orthogonal matrix with determinant one, row by row.
    pub fn matrix_rotation(&mut self, rows: [[Scalar; 3]; 3]) -> Rotation {
        let m = rows.map(|row| row.map(|s| self.print(s)));
        self.find_rotation(&m).unwrap_or_else(|| self.insert_rotation(RotationNode::Matrix(Box::new(rows)), m))
    }

    /// From a unit quaternion w, i, j, k.
    pub fn quaternion_rotation(&mut self, q: [Scalar; 4]) -> Rotation {
        let rows = self.quaternion_rows(q);
        let m = rows.map(|row| row.map(|s| self.print(s)));
        self.find_rotation(&m).unwrap_or_else(|| self.insert_rotation(RotationNode::Quaternion(q), m))
    }

    /// The matrix of a unit quaternion, 1 - 2 (j^2 + k^2) on its diagonal.
    pub(super) fn quaternion_rows(&mut self, [w, i, j, k]: [Scalar; 4]) -> [[Scalar; 3]; 3] {
        let v = [i, j, k];
        // Doubled components once: 2 q_a q_b and 2 w q_a then cost one product each.
        let double = v.map(|c| self.sum(&[c, c]));
        let square = [0, 1, 2].map(|a| self.mul(double[a], v[a]));
        let mut rows = [[Scalar::ZERO; 3]; 3];
        for a in 0..3 {
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let off = self.sum(&[square[b], square[c]]);
            rows[a][a] = self.sub(Scalar::ONE, off);
            let both = self.mul(double[a], v[b]);
            let turn = self.mul(double[c], w);
            rows[a][b] = self.sub(both, turn);
            rows[b][a] = self.add(both, turn);
        }
        rows
    }

    /// First `b`, then `a`.
    pub fn compose(&mut self, a: Rotation, b: Rotation) -> Rotation {
        let m = multiply(&self.rotation_print(a), &self.rotation_print(b));
        if let Some(found) = self.find_rotation(&m) {
            return found;
        }
        if let (Some((i, alpha)), Some((j, beta))) = (self.as_axis(a), self.as_axis(b))
            && i == j
        {
            let angle = self.add(alpha, beta);
            return self.axis_rotation(i, angle);
        }
        // Literal and parameter matrices multiply out; turning ones stay a product, applied one after the other.
        if let (RotationNode::Matrix(_), RotationNode::Matrix(_)) = (self.rotation_node(a), self.rotation_node(b)) {
            let (x, y) = (self.rotation_rows(a), self.rotation_rows(b));
            let rows = self.multiply_rows(&x, &y);
            return self.matrix_rotation(rows);
        }
        // (A B) C is A (B C): turning about one axis may meet on the inside.
        if let (&RotationNode::Product(x, y), false) = (self.rotation_node(a), a.is_transposed()) {
            let inner = self.compose(y, b);
            if !matches!(self.rotation_node(inner), RotationNode::Product(..)) {
                return self.compose(x, inner);
            }
        }
        self.insert_rotation(RotationNode::Product(a, b), m)
    }

    fn as_axis(&self, r: Rotation) -> Option<(usize, Scalar)> {
        match *self.rotation_node(r) {
            RotationNode::Axis(axis, angle) => Some((axis, if r.is_transposed() { -angle } else { angle })),
            _ => None,
        }
    }

    /// The nine entries, row by row.
    pub fn rotation_rows(&mut self, r: Rotation) -> [[Scalar; 3]; 3] {
        let columns = [0, 1, 2].map(|axis| {
            let unit = self.along(axis, Scalar::ONE);
            let turned = self.rotate(r, unit);
            self.components(turned)
        });
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
    }

    fn multiply_rows(&mut self, a: &[[Scalar; 3]; 3], b: &[[Scalar; 3]; 3]) -> [[Scalar; 3]; 3] {
        let mut rows = [[Scalar::ZERO; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let terms = [0, 1, 2].map(|k| self.mul(a[i][k], b[k][j]));
                *entry = self.sum(&terms);
            }
        }
        rows
    }
}

fn apply(m: &Matrix, v: &[Print; 3]) -> [Print; 3] {
    std::array::from_fn(|i| (0..3).fold(Print::ZERO, |sum, k| sum.add(m[i][k].mul(v[k]))))
}

fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).fold(Print::ZERO, |sum, k| sum.add(a[i][k].mul(b[k][j])))))
}
