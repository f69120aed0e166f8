//! Stage `mechanics`: constant rotations, of literals and parameters.
//!
//! In: axes, angles, frames. Out: rotations that are multiplied out to one matrix, since work on parameters is done once
//! and a vector then passes one rotation and not several; and the coordinate axis behind any axis. A literal direction
//! is reached by turns about coordinate axes, whose sines and cosines are quotients of its components and lengths, so that
//! it is exact as they are, and a rotation times its transpose is one.

use crate::symbolic::graph::{Call, Graph, Rotation, RotationNode, Scalar, Vector};
use crate::symbolic::number::Number;

use super::typed;

/// An axis of any direction as a coordinate axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Takes the coordinate axis into this one.
    pub turn: Rotation,
    pub index: usize,
    /// The axis is the negative coordinate axis: coordinates change their sign.
    pub flipped: bool,
}

/// The nine entries, row by row.
pub(super) fn rows(g: &mut Graph, r: Rotation) -> [[Scalar; 3]; 3] {
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

pub(super) fn transpose(m: &[[Scalar; 3]; 3]) -> [[Scalar; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// First `b`, then `a`, as one matrix unless it is simpler than that.
pub(super) fn compose(g: &mut Graph, a: Rotation, b: Rotation) -> Rotation {
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
pub(super) fn rotate(g: &mut Graph, r: Rotation, v: Vector) -> Vector {
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

/// Rotation about any axis by a constant angle.
pub(super) fn about(g: &mut Graph, axis: [Scalar; 3], angle: Scalar) -> Rotation {
    let axis = self::axis(g, axis);
    let turn = g.axis_rotation(axis.index, if axis.flipped { -angle } else { angle });
    let placed = compose(g, axis.turn, turn);
    compose(g, placed, axis.turn.transpose())
}

/// The coordinate axis behind a direction. An axis in a coordinate plane is one turn away from it, any other direction
/// is Rz(azimuth) Ry(inclination) Z.
pub(super) fn axis(g: &mut Graph, direction: [Scalar; 3]) -> Axis {
    let direction = typed::direction(g, direction);
    let nonzero: Vec<usize> = (0..3).filter(|&k| direction[k] != Scalar::ZERO).collect();
    if let [k] = nonzero[..]
        && let Some(n) = g.literal(direction[k])
    {
        return Axis { turn: Rotation::IDENTITY, index: k, flipped: n.is_negative() };
    }
    let typed = direction.iter().any(|&c| g.literal(c).is_some_and(Number::is_rounded_decimal));
    let normal = (0..3).find(|&k| direction[k] == Scalar::ZERO && direction[(k + 1) % 3] != Scalar::ZERO);
    if let Some(k) = normal {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let length = |g: &mut Graph| g.length([direction[i], direction[j], Scalar::ZERO]);
        return Axis { turn: towards(g, k, [direction[i], direction[j]], length, typed), index: i, flipped: false };
    }
    let [x, y, z] = direction;
    let level = g.length([x, y, Scalar::ZERO]);
    let first = towards(g, 2, [x, y], |_| level, typed);
    let second = towards(g, 1, [z, level], |g| g.length(direction), typed);
    Axis { turn: compose(g, first, second), index: 2, flipped: false }
}

/// The turn about a coordinate axis by the angle of the point (x, y). Of literals it is made of cosine and sine, so that it
/// is exact; `typed` ones were rounded, and mean the quarter of a degree that they round.
fn towards(
    g: &mut Graph,
    axis: usize,
    [x, y]: [Scalar; 2],
    length: impl Fn(&mut Graph) -> Scalar,
    typed: bool,
) -> Rotation {
    let (Some(along), Some(across)) = (g.literal(x), g.literal(y)) else {
        let angle = g.call(Call::Atan2, &[y, x]);
        return g.axis_rotation(axis, angle);
    };
    let angle = across.value().atan2(along.value());
    if typed && let Some(angle) = quarter_degrees(g, angle) {
        let (sin, cos) = (g.sin(angle), g.cos(angle));
        let size = along.value().hypot(across.value());
        let near = |s: Scalar, n: Number| {
            g.literal(s).is_some_and(|s| (s.value() * size - n.value()).abs() <= f64::EPSILON * size)
        };
        if near(cos, along) && near(sin, across) {
            return g.point_rotation(axis, cos, sin);
        }
    }
    let length = length(g);
    if !g.literal(length).is_some_and(Number::is_exact) {
        // A length with a root that is not exact: by its angle the turn is one on the circle all the same.
        let angle = g.call(Call::Atan2, &[y, x]);
        return g.axis_rotation(axis, angle);
    }
    let (cos, sin) = (g.div(x, length), g.div(y, length));
    g.point_rotation(axis, cos, sin)
}

/// The multiple of a quarter of a degree that is nearest to an angle.
pub(super) fn quarter_degrees(g: &mut Graph, angle: f64) -> Option<Scalar> {
    let count = (angle * 720.0 / std::f64::consts::PI).round();
    let part = (count.abs() < 1e6).then(|| Number::ratio(count as i64, 720))?;
    Some(g.number(part * Number::pi()))
}
