//! Stage `mechanics`: rotation matrices that a user has typed.
//!
//! In: nine literals. Out: a rotation that is orthogonal exactly. Matrices are typed with sixteen digits, which are the
//! rounding of something else, and what is left of a zero then looks like a number. So a matrix that rounds turns about
//! coordinate axes, or one about a simple axis, by quarters of a degree or by short decimals, is those turns; one that
//! rounds a rotation which is there already is that rotation, and one that shares a simple axis with it (the frame at the
//! other end of a planar loop) is that rotation followed by a turn about this axis; any other becomes the rotation of a
//! rational quaternion, or, where it has zeros, turns with rational half-angle tangents that have the same zeros.

use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Rotation, Scalar};
use crate::symbolic::number::Number;
use crate::symbolic::rotations::{self, compose};

use super::directions;

type Matrix = [[f64; 3]; 3];

/// How far the entries of a matrix with sixteen digits lie from those of the rotation that was meant.
const ROUNDED: f64 = 1e-15;

/// What a component of a direction is to its largest where it is the rounding of a zero.
const DUST: f64 = 2.0 * f64::EPSILON;

/// Largest denominator of a simple axis.
const MOST_OF_AN_AXIS: i64 = 60;

/// A direction without what rounding has left of a zero: `[0, 1, 6.1e-17]` is Y. What was typed so small on purpose, as in
/// `[1, 1e-17, 0]`, is a zero too; either way the axis turns by less than 1e-15 rad, the rounding of its largest component.
pub(in crate::mechanics) fn direction(g: &Graph, components: [Scalar; 3]) -> [Scalar; 3] {
    let sizes = components.map(|c| g.literal(c).map(|n| n.value().abs()));
    let largest = sizes.iter().flatten().fold(0.0_f64, |most, &x| most.max(x));
    // Beside a parameter, which may be small, nothing is.
    if sizes.iter().any(Option::is_none) {
        return components;
    }
    std::array::from_fn(|k| match sizes[k] {
        Some(x) if x <= DUST * largest => Scalar::ZERO,
        _ => components[k],
    })
}

/// The rotation that is meant by a matrix, row by row.
pub(in crate::mechanics) fn oriented(g: &mut Graph, rows: [[Scalar; 3]; 3]) -> Rotation {
    let mut numbers = [[Number::ZERO; 3]; 3];
    for (number, &entry) in numbers.as_flattened_mut().iter_mut().zip(rows.as_flattened()) {
        match g.literal(entry) {
            Some(literal) => *number = literal,
            // No literal: taken as it is written.
            None => return g.matrix_rotation(rows),
        }
    }
    if is_orthogonal(&numbers) {
        return g.matrix_rotation(rows);
    }
    let m = numbers.map(|row| row.map(Number::value));
    // Fewer digits are further from any rotation.
    let reach = ROUNDED + 2.0 * defect(&m);
    let is_near = |g: &mut Graph, r: Rotation| {
        let rows = rotations::rows(g, r);
        let near = |(s, x): (&Scalar, &f64)| g.literal(*s).is_some_and(|n| (n.value() - x).abs() <= reach);
        rows.iter().flatten().zip(m.iter().flatten()).all(near)
    };
    let simple = [by_turns(g, &m, true), about_simple(g, &m), g.near_rotation(&m, ROUNDED)];
    for rotation in simple.into_iter().flatten() {
        if is_near(g, rotation) {
            return rotation;
        }
    }
    for rotation in g.literal_rotations() {
        if let Some(rotation) = about_shared(g, rotation, &m).filter(|&r| is_near(g, r)) {
            return rotation;
        }
    }
    let rational =
        if m.iter().flatten().any(|&x| x == 0.0) { by_turns(g, &m, false) } else { Some(by_quaternion(g, &m)) };
    match rational {
        Some(rotation) if is_near(g, rotation) => rotation,
        _ => g.matrix_rotation(rows),
    }
}

fn is_orthogonal(m: &[[Number; 3]; 3]) -> bool {
    (0..3).all(|i| {
        (i..3).all(|j| {
            let product = (0..3).fold(Number::ZERO, |sum, k| sum + m[i][k] * m[j][k]);
            if i == j { product.is_one() } else { product.is_zero() }
        })
    })
}

/// The largest entry of M M' - 1.
fn defect(m: &Matrix) -> f64 {
    let mut most = 0.0_f64;
    for i in 0..3 {
        for j in 0..3 {
            let product: f64 = (0..3).map(|k| m[i][k] * m[j][k]).sum();
            most = most.max((product - if i == j { 1.0 } else { 0.0 }).abs());
        }
    }
    most
}

/// As three turns about coordinate axes: `simple` ones, or those that keep the first zero of the matrix.
fn by_turns(g: &mut Graph, m: &Matrix, simple: bool) -> Option<Rotation> {
    let zero = (0..9).map(|at| (at / 3, at % 3)).find(|&(i, j)| m[i][j] == 0.0);
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)] {
        // R = Ri(a) Rj(b) Rk(c), whose entry (i, k) is the sine of b up to sign.
        if !simple && zero.is_some_and(|zero| zero != (i, k)) {
            continue;
        }
        let sign = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
        let angles = [
            (i, (-sign * m[j][k]).atan2(m[k][k])),
            (j, (sign * m[i][k]).atan2(m[i][i].hypot(m[i][j]))),
            (k, (-sign * m[i][j]).atan2(m[i][i])),
        ];
        if let Some(rotation) = turned(g, angles, simple) {
            return Some(rotation);
        }
    }
    // A zero on the diagonal: R = Ri(a) Rj(90 deg) Ri(c).
    let (i, j, k) = zero.filter(|(i, j)| i == j).map(|(i, _)| (i, (i + 1) % 3, (i + 2) % 3))?;
    let quarter = std::f64::consts::FRAC_PI_2;
    turned(g, [(i, m[j][i].atan2(-m[k][i])), (j, quarter), (i, m[i][j].atan2(m[i][k]))], simple)
}

fn turned(g: &mut Graph, turns: [(usize, f64); 3], simple: bool) -> Option<Rotation> {
    turns.into_iter().try_fold(Rotation::IDENTITY, |rotation, (axis, angle)| {
        let turn = match simple_angle(g, angle) {
            Some(angle) => g.axis_rotation(axis, angle),
            None if simple => return None,
            None => rational_turn(g, axis, angle),
        };
        Some(compose(g, rotation, turn))
    })
}

/// A quarter of a degree or a decimal of nine places that an angle rounds.
fn simple_angle(g: &mut Graph, angle: f64) -> Option<Scalar> {
    let near = |s: Scalar, g: &Graph| g.literal(s).is_some_and(|n| (n.value() - angle).abs() <= 2.0 * ROUNDED);
    let exact = directions::quarter_degrees(g, angle).filter(|&s| near(s, g));
    if exact.is_some() {
        return exact;
    }
    let short = g.decimal((angle * 1e9).round() / 1e9);
    near(short, g).then_some(short)
}

/// About a coordinate axis, by an angle whose half has a rational tangent.
fn rational_turn(g: &mut Graph, axis: usize, angle: f64) -> Rotation {
    let back = angle.abs() > std::f64::consts::FRAC_PI_2;
    let small = if back { angle - std::f64::consts::PI.copysign(angle) } else { angle };
    let tangent = Number::decimal((0.5 * small).tan());
    let square = tangent * tangent;
    let scale = Number::ONE / (Number::ONE + square);
    let (cos, sin) = ((Number::ONE - square) * scale, (tangent + tangent) * scale);
    let (cos, sin) = (g.number(cos), g.number(sin));
    if back { g.point_rotation(axis, -cos, -sin) } else { g.point_rotation(axis, cos, sin) }
}

/// Scalar and vector of the quaternion of a matrix, as large as they come.
fn quaternion(m: &Matrix) -> [f64; 4] {
    let [x, y, z] = [m[0][0], m[1][1], m[2][2]];
    let turns = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let both = [m[1][2] + m[2][1], m[2][0] + m[0][2], m[0][1] + m[1][0]];
    let forms = [
        [1.0 + x + y + z, turns[0], turns[1], turns[2]],
        [turns[0], 1.0 + x - y - z, both[2], both[1]],
        [turns[1], both[2], 1.0 - x + y - z, both[0]],
        [turns[2], both[1], both[0], 1.0 - x - y + z],
    ];
    let largest = (0..4).max_by(|&a, &b| forms[a][a].total_cmp(&forms[b][b])).or_fault("there are four forms");
    forms[largest]
}

/// A rotation by a simple angle about an axis whose components are to each other as small integers are.
fn about_simple(g: &mut Graph, m: &Matrix) -> Option<Rotation> {
    let q = quaternion(m);
    let axis = simple_axis(&q)?;
    simple_turn(g, &q, axis)
}

fn simple_turn(g: &mut Graph, [w, v @ ..]: &[f64; 4], axis: [i64; 3]) -> Option<Rotation> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let angle = simple_angle(g, 2.0 * length.atan2(*w))?;
    let axis = axis.map(|n| g.integer(n));
    Some(directions::about(g, axis, angle))
}

/// Small integers that the vector of a quaternion is proportional to.
fn simple_axis([_, v @ ..]: &[f64; 4]) -> Option<[i64; 3]> {
    let size = v.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    (1..=MOST_OF_AN_AXIS).find_map(|d| {
        let scaled = v.map(|x| x / size * d as f64);
        let whole = scaled.iter().all(|x| (x - x.round()).abs() <= 1e-13 * d as f64);
        whole.then(|| scaled.map(|x| x.round() as i64))
    })
}

/// A rotation that is there, followed by a turn about one of its simple axes.
fn about_shared(g: &mut Graph, (there, rows): (Rotation, Matrix), m: &Matrix) -> Option<Rotation> {
    let rest: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| rows[k][i] * m[k][j]).sum()));
    let q = quaternion(&rest);
    let axis = simple_axis(&q)?;
    let turn = simple_turn(g, &q, axis).unwrap_or_else(|| {
        // Scalar and axis as integers and their ratio, which is as good as any.
        let [w, v @ ..] = q;
        let (along, whole) =
            (0..3).map(|k| (v[k], axis[k])).max_by_key(|one| one.1.abs()).or_fault("an axis has three components");
        let (scalar, factor) = (w * whole as f64, along);
        let (scalar, factor) = if scalar.abs() < factor.abs() {
            (Number::decimal(scalar / factor), Number::ONE)
        } else {
            (Number::ONE, Number::decimal(factor / scalar))
        };
        rational(g, scalar, axis.map(|n| Number::integer(n) * factor))
    });
    Some(compose(g, there, turn))
}

/// The rational quaternion that is nearest.
fn by_quaternion(g: &mut Graph, m: &Matrix) -> Rotation {
    let q = quaternion(m);
    let size = q.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let [w, v @ ..] = q.map(|x| Number::decimal(x / size));
    rational(g, w, v)
}

/// The rotation of a rational quaternion; it needs no unit length.
fn rational(g: &mut Graph, w: Number, v: [Number; 3]) -> Rotation {
    let square = v.iter().fold(w * w, |sum, &x| sum + x * x);
    let two = Number::integer(2) / square;
    let mut rows = [[Scalar::ZERO; 3]; 3];
    for a in 0..3 {
        let (b, c) = ((a + 1) % 3, (a + 2) % 3);
        rows[a][a] = g.number(Number::ONE - two * (v[b] * v[b] + v[c] * v[c]));
        rows[a][b] = g.number(two * (v[a] * v[b] - w * v[c]));
        rows[b][a] = g.number(two * (v[a] * v[b] + w * v[c]));
    }
    g.matrix_rotation(rows)
}
