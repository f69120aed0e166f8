//! Stage `mechanics`: how far an iteration moves its unknowns in a round.
//!
//! In: the equations and their derivatives where the iteration stands. Out: a [`Move`] of each unknown, against its step.
//!
//! Several unknowns move by Newton's step d, J d = f. An angle that is iterated as a point turns by twice the angle whose tangent
//! is t = d/2 (Cayley): that is d but for its cube, so convergence stays quadratic, and a step from far off stays below half a turn.
//! It takes no sines: with w = d / (1 + t^2), sin = w and 1 - cos = w t.
//!
//! **One unknown** has one second derivative, which costs little beside what the first one shares with it, while rounds follow
//! each other and cannot be worked out side by side. So its rounds are of third order, and half as many. They solve the equation that
//! has the same f, f' and f'' where the iteration stands (Cauchy's method; Traub 1964, *Iterative Methods for the Solution of
//! Equations*, chapter 5): of a number a parabola, of an angle a constant, a cosine and a sine, as which most loops turn out,
//!
//! ```text
//! f - f' d + f'' d^2 / 2 = 0,              d = 2 f / m,  m = f' +- sqrt(f'^2 - 2 f f'')
//! f - f' sin d + f'' (1 - cos d) = 0,      tan(d/2) = f / m,  m = f' +- sqrt(f'^2 - f (f + 2 f''))
//! ```
//!
//! of both roots the nearer one, the sign that of f'; where there is none, the root counts as zero. A turn takes one division,
//! w = 2 f / (f^2 + m^2), sin = w m, 1 - cos = w f. Nothing is divided by a slope, so neither extrema, from which Newton's method is
//! thrown far off, nor dead centres, where it halves the error, are any different. Of random sums of both sines of an angle and some of
//! twice the angle, three of these rounds leave 0.0, 0.3 and 2.4 percent open from guesses that are off by up to 0.1, 0.5 and 1 rad,
//! where six of Newton's method leave 0.4, 2.0 and 3.9; from anywhere at all 17 and 8.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar};

/// How an unknown moves, against its step.
#[derive(Clone, Copy)]
pub(super) enum Move {
    /// Of a number.
    Shift(Scalar),
    /// Of a point on the circle, turned back by the angle with sin = w m, 1 - cos = w n.
    Turn { w: Scalar, m: Scalar, n: Scalar },
}

impl Move {
    /// By a step d of Newton's method.
    pub(super) fn by(g: &mut Graph, step: Scalar, is_point: bool) -> Move {
        if !is_point {
            return Move::Shift(step);
        }
        let half = g.decimal(0.5);
        let h = g.mul(half, step);
        let square = g.mul(h, h);
        let length = g.add(Scalar::ONE, square);
        Move::Turn { w: g.div(step, length), m: Scalar::ONE, n: h }
    }

    /// By the step of third order, of f and its two derivatives.
    pub(super) fn of_third_order(g: &mut Graph, [value, slope, curvature]: [Scalar; 3], is_point: bool) -> Move {
        let two = g.integer(2);
        let square = g.mul(slope, slope);
        let twice_bent = g.mul(two, curvature);
        let bent = if is_point { g.add(value, twice_bent) } else { twice_bent };
        let product = g.mul(value, bent);
        let radicand = g.sub(square, product);
        let radicand = g.call(Call::Max, &[radicand, Scalar::ZERO]);
        let root = g.sqrt(radicand);
        let falls = g.call(Call::Less, &[slope, Scalar::ZERO]);
        let signed = g.call(Call::Select, &[falls, -root, root]);
        let m = g.add(slope, signed);
        let twice = g.mul(two, value);
        if !is_point {
            return Move::Shift(quotient(g, twice, m));
        }
        let (value_square, m_square) = (g.mul(value, value), g.mul(m, m));
        let length = g.add(value_square, m_square);
        let w = quotient(g, twice, length);
        Move::Turn { w, m, n: value }
    }
}

/// Nothing to speak of where the divisor vanishes, which the other one does then, or has no root near.
fn quotient(g: &mut Graph, x: Scalar, by: Scalar) -> Scalar {
    if g.literal(by).is_some_and(|n| !n.is_zero()) {
        return g.div(x, by);
    }
    let vanishes = g.call(Call::Equal, &[by, Scalar::ZERO]);
    let sound = g.call(Call::Select, &[vanishes, Scalar::ONE, by]);
    g.div(x, sound)
}

/// A point that is turned back: c + w (m s - n c), s - w (m c + n s). What w is multiplied with doesn't wait for its division.
pub(super) fn turned_back(g: &mut Graph, [cos, sin]: [Scalar; 2], [w, m, n]: [Scalar; 3]) -> [Scalar; 2] {
    let products = [g.mul(m, sin), g.mul(n, cos), g.mul(m, cos), g.mul(n, sin)];
    let (more, less) = (g.sub(products[0], products[1]), g.add(products[2], products[3]));
    let (more, less) = (g.mul(w, more), g.mul(w, less));
    [g.add(cos, more), g.sub(sin, less)]
}
