//! Stage `dynamics`: mass distributions as zeroth, first and second moments.
//!
//! In: mass, centre of mass, inertia tensor. Out: an [`Inertia`] (m, m c, D) about a frame's origin, where D is the
//! second moment, the integral of r r^T dm; the inertia tensor about the origin is tr(D) 1 - D. Moments add, shift and
//! turn linearly and no centre of mass is divided by (Wensing, Kim and Slotine 2018 call the 4x4 matrix of all ten the
//! pseudo-inertia), and what a joint's motion doesn't move can be handed to the parent (see [`super::regroup`]).

use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, Vector};

/// Moments of a mass distribution in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    pub mass: Scalar,
    /// Mass times centre of mass.
    pub first: [Scalar; 3],
    /// xx, yy, zz, xy, xz, yz
    pub second: [Scalar; 6],
}

impl Inertia {
    /// Says what the moments are: `mass_upper`, `first_upper_x`, `second_upper_xx`, ..
    pub fn label(&self, g: &mut Graph, of: &str) {
        g.label(self.mass, || format!("mass_{of}"));
        for (axis, &moment) in ["x", "y", "z"].iter().zip(&self.first) {
            g.label(moment, || format!("first_{of}_{axis}"));
        }
        for (axes, &moment) in ["xx", "yy", "zz", "xy", "xz", "yz"].iter().zip(&self.second) {
            g.label(moment, || format!("second_{of}_{axes}"));
        }
    }
}

/// Where entry (i, j) of a symmetric matrix stands.
pub fn entry(i: usize, j: usize) -> usize {
    match (i.min(j), i.max(j)) {
        (0, 1) => 3,
        (0, 2) => 4,
        (1, 2) => 5,
        (k, _) => k,
    }
}

impl Inertia {
    pub const ZERO: Inertia = Inertia { mass: Scalar::ZERO, first: [Scalar::ZERO; 3], second: [Scalar::ZERO; 6] };

    pub fn is_zero(&self) -> bool {
        self.mass == Scalar::ZERO
            && self.first.iter().all(|&s| s == Scalar::ZERO)
            && self.second.iter().all(|&s| s == Scalar::ZERO)
    }

    /// From the tensor about the centre of mass (xx, yy, zz, xy, xz, yz): D = tr(I)/2 1 - I + m c c^T.
    pub fn from_tensor(g: &mut Graph, mass: Scalar, com: [Scalar; 3], tensor: [Scalar; 6]) -> Inertia {
        let trace = g.sum(&tensor[..3]);
        let half = g.decimal(0.5);
        let half = g.mul(half, trace);
        let mut second = [Scalar::ZERO; 6];
        for k in 0..3 {
            second[k] = g.sub(half, tensor[k]);
            second[k + 3] = -tensor[k + 3];
        }
        let first = com.map(|c| g.mul(mass, c));
        for i in 0..3 {
            for j in i..3 {
                let steiner = g.mul(first[i], com[j]);
                second[entry(i, j)] = g.add(second[entry(i, j)], steiner);
            }
        }
        Inertia { mass, first, second }
    }

    pub fn add(&self, g: &mut Graph, other: &Inertia) -> Inertia {
        Inertia {
            mass: g.add(self.mass, other.mass),
            first: std::array::from_fn(|k| g.add(self.first[k], other.first[k])),
            second: std::array::from_fn(|k| g.add(self.second[k], other.second[k])),
        }
    }

    pub fn sub(&self, g: &mut Graph, other: &Inertia) -> Inertia {
        let minus = Inertia { mass: -other.mass, first: other.first.map(|s| -s), second: other.second.map(|s| -s) };
        self.add(g, &minus)
    }

    /// The same distribution, seen from a frame in which this frame's origin is at `p`.
    pub fn shift(&self, g: &mut Graph, p: [Scalar; 3]) -> Inertia {
        let mut second = self.second;
        for i in 0..3 {
            for j in i..3 {
                let a = g.mul(self.first[i], p[j]);
                let b = g.mul(p[i], self.first[j]);
                let c = g.product(&[self.mass, p[i], p[j]]);
                second[entry(i, j)] = g.sum(&[second[entry(i, j)], a, b, c]);
            }
        }
        let first = std::array::from_fn(|k| {
            let moved = g.mul(self.mass, p[k]);
            g.add(self.first[k], moved)
        });
        Inertia { mass: self.mass, first, second }
    }

    /// Components in a frame that sees this one turned by a constant rotation.
    pub fn rotate(&self, g: &mut Graph, r: Rotation) -> Inertia {
        if r == Rotation::IDENTITY {
            return *self;
        }
        let first = g.vector(self.first);
        let first = g.rotate(r, first);
        let first = g.components(first);
        // R D R^T, column by column, then row by row.
        let columns: [Vector; 3] = [0, 1, 2].map(|j| {
            let column = [0, 1, 2].map(|i| self.second[entry(i, j)]);
            let column = g.vector(column);
            g.rotate(r, column)
        });
        let half = columns.map(|c| g.components(c));
        let rows: [[Scalar; 3]; 3] = [0, 1, 2].map(|i| {
            let row = g.vector([half[0][i], half[1][i], half[2][i]]);
            let row = g.rotate(r, row);
            g.components(row)
        });
        let mut second = [Scalar::ZERO; 6];
        for i in 0..3 {
            for j in i..3 {
                second[entry(i, j)] = rows[i][j];
            }
        }
        Inertia { mass: self.mass, first, second }
    }

    /// The same, one after the other where the rotation is a product.
    pub fn turned(&self, g: &mut Graph, r: Rotation) -> Inertia {
        match *g.rotation_node(r) {
            RotationNode::Product(a, b) => {
                let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
                self.turned(g, first).turned(g, second)
            }
            RotationNode::Axis(axis, angle) => self.turn(g, axis, if r.is_transposed() { -angle } else { angle }),
            _ => self.rotate(g, r),
        }
    }

    /// Components in a frame that sees this one turned about a coordinate axis. With A, C, B the entries xx, yy, xy of
    /// the turned plane, u = c (A - C) - 2 s B serves all three: A' = C + c u, C' = A - c u, B' = s u + B.
    pub fn turn(&self, g: &mut Graph, axis: usize, angle: Scalar) -> Inertia {
        let (sin, cos) = (g.sin(angle), g.cos(angle));
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let pair = |g: &mut Graph, x: Scalar, y: Scalar| {
            let (cx, sy) = (g.mul(cos, x), g.mul(sin, y));
            let (sx, cy) = (g.mul(sin, x), g.mul(cos, y));
            (g.sub(cx, sy), g.add(sx, cy))
        };
        let mut first = self.first;
        (first[j], first[k]) = pair(g, self.first[j], self.first[k]);
        let mut second = self.second;
        let (xj, xk) = (entry(axis, j), entry(axis, k));
        (second[xj], second[xk]) = pair(g, self.second[xj], self.second[xk]);
        let (a, c, b) = (self.second[j], self.second[k], self.second[entry(j, k)]);
        let difference = g.sub(a, c);
        let twice = g.add(b, b);
        let (cd, sb) = (g.mul(cos, difference), g.mul(sin, twice));
        let u = g.sub(cd, sb);
        let (cu, su) = (g.mul(cos, u), g.mul(sin, u));
        second[j] = g.add(c, cu);
        second[k] = g.sub(a, cu);
        second[entry(j, k)] = g.add(su, b);
        Inertia { mass: self.mass, first, second }
    }

    /// Whether a turn about a coordinate axis leaves the distribution as it is.
    pub fn is_symmetric(&self, axis: usize) -> bool {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let off = [self.first[j], self.first[k], self.second[3], self.second[4], self.second[5]];
        self.second[j] == self.second[k] && off.iter().all(|&moment| moment == Scalar::ZERO)
    }

    /// Entry of the inertia tensor about the origin, tr(D) 1 - D.
    pub fn tensor(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        if i == j {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            g.add(self.second[a], self.second[b])
        } else {
            -self.second[entry(i, j)]
        }
    }
}
