//! Stage `symbolic`: constant rotations, multiplied out.
//!
//! In: rotations of literals and parameters. Out: one matrix for several, since work on parameters is done once and a vector
//! then passes one rotation.

use super::graph::{Graph, Rotation, RotationNode, Scalar, Vector};

/// The nine entries, row by row.
pub(crate) fn rows(g: &mut Graph, r: Rotation) -> [[Scalar; 3]; 3] {
    let m = match g.rotation_node(r) {
        RotationNode::Matrix(rows) => **rows,
        &RotationNode::Axis(axis, angle) => {
            let (s, c) = (g.sin(angle), g.cos(angle));
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut m = [[Scalar::ZERO; 3]; 3];
            m[axis][axis] = Scalar::ONE;
            (m[j][j], m[j][k], m[k][j], m[k][k]) = (c, -s, s, c);
            m
        }
        _ => return g.rotation_rows(r),
    };
    if r.is_transposed() { transpose(&m) } else { m }
}

/// Components of a vector of a plane after a turn by the angle with this cosine and sine; with minus the sine, before it.
pub(crate) fn turn_pair(g: &mut Graph, [cos, sin]: [Scalar; 2], [a, b]: [Scalar; 2]) -> [Scalar; 2] {
    let terms = [[g.mul(cos, a), -g.mul(sin, b)], [g.mul(sin, a), g.mul(cos, b)]];
    terms.map(|terms| g.sum(&terms))
}

pub(crate) fn transpose(m: &[[Scalar; 3]; 3]) -> [[Scalar; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// First `b`, then `a`, as one matrix unless it is simpler than that.
pub(crate) fn compose(g: &mut Graph, a: Rotation, b: Rotation) -> Rotation {
    if a == Rotation::IDENTITY {
        return b;
    }
    if b == Rotation::IDENTITY {
        return a;
    }
    if let (RotationNode::Axis(i, _), RotationNode::Axis(j, _)) = (g.rotation_node(a), g.rotation_node(b))
        && i == j
    {
        return g.compose(a, b);
    }
    let (x, y) = (rows(g, a), rows(g, b));
    let product = x.map(|row| {
        [0, 1, 2].map(|j| {
            let terms = [0, 1, 2].map(|k| g.mul(row[k], y[k][j]));
            g.sum(&terms)
        })
    });
    g.matrix_rotation(product)
}

/// A constant vector, turned: a triple, so that literals fold.
pub(crate) fn rotate(g: &mut Graph, r: Rotation, v: Vector) -> Vector {
    if r == Rotation::IDENTITY || v == Vector::ZERO {
        return v;
    }
    let (m, v) = (rows(g, r), g.components(v));
    let turned = m.map(|row| {
        let terms = [0, 1, 2].map(|k| g.mul(row[k], v[k]));
        g.sum(&terms)
    });
    g.vector(turned)
}
