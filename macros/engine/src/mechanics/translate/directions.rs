//! Stage `mechanics`: axes of any direction, as coordinate axes behind constant rotations.
//!
//! In: axes and angles, of literals and parameters. Out: the coordinate axis behind any axis. A literal direction
//! is reached by turns about coordinate axes, whose sines and cosines are quotients of its components and lengths, so that
//! it is exact as they are, and a rotation times its transpose is one.

use crate::contracts::call::Call;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Rotation, Scalar};
use crate::symbolic::number::Number;
use crate::symbolic::rotations::compose;

use super::typed;

/// An axis of any direction as a coordinate axis.
#[derive(Clone, Copy, Debug)]
pub(in crate::mechanics) struct Axis {
    /// Takes the coordinate axis into this one.
    pub turn: Rotation,
    pub index: usize,
    /// The axis is the negative coordinate axis: coordinates change their sign.
    pub flipped: bool,
}

impl Axis {
    /// An axis of the frame itself.
    pub(in crate::mechanics) fn coordinate(index: usize) -> Axis {
        Axis { turn: Rotation::IDENTITY, index: index % 3, flipped: false }
    }

    /// The coordinate axis that follows, or the one after that, in the same turned frame.
    pub(in crate::mechanics) fn next(self, by: usize) -> Axis {
        Axis { index: (self.index + by) % 3, flipped: false, ..self }
    }
}

/// Rotation about any axis by a constant angle.
pub(in crate::mechanics) fn about(g: &mut Graph, axis: [Scalar; 3], angle: Scalar) -> Rotation {
    let axis = self::axis(g, axis);
    let turn = g.axis_rotation(axis.index, if axis.flipped { -angle } else { angle });
    let placed = compose(g, axis.turn, turn);
    compose(g, placed, axis.turn.transpose())
}

/// The coordinate axis behind a direction. An axis in a coordinate plane is one turn away from it, any other direction
/// is Rz(azimuth) Ry(inclination) Z.
pub(in crate::mechanics) fn axis(g: &mut Graph, direction: [Scalar; 3]) -> Axis {
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

/// Two directions and the third of their right-handed frame, as axes of one turned frame. Of the second counts what is across
/// the first, so that the three are perpendicular whatever parameters do.
pub(in crate::mechanics) fn frame(g: &mut Graph, first: [Scalar; 3], second: [Scalar; 3]) -> [Axis; 3] {
    let one = axis(g, first);
    let typed = [first, second].as_flattened().iter().any(|&c| g.literal(c).is_some_and(Number::is_rounded_decimal));
    let second = typed::direction(g, second);
    let second = g.vector(second);
    let local = g.rotate(one.turn.transpose(), second);
    let mut local = g.components(local);
    local[one.index] = Scalar::ZERO;
    let local = typed::direction(g, local);
    let [i, j] = [1, 2].map(|next| (one.index + next) % 3);
    let (turn, index, flipped) = match [i, j].map(|k| (local[k], g.literal(local[k]).map(|n| n.is_negative()))) {
        [(_, Some(negative)), (Scalar::ZERO, _)] => (Rotation::IDENTITY, i, negative),
        [(Scalar::ZERO, _), (_, Some(negative))] => (Rotation::IDENTITY, j, negative),
        [(x, _), (y, _)] => {
            let length = |g: &mut Graph| g.length([x, y, Scalar::ZERO]);
            (towards(g, one.index, [x, y], length, typed), i, false)
        }
    };
    let turn = compose(g, one.turn, turn);
    // The cross product of axes i and i + 1 is i + 2, that of i and i + 2 is minus i + 1.
    let against = (one.index + 1) % 3 != index;
    let third = Axis { turn, index: 3 - one.index - index, flipped: one.flipped ^ flipped ^ against };
    [Axis { turn, ..one }, Axis { turn, index, flipped }, third]
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
    let y = if broken(Break::AxisTurn) { -y } else { y };
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
