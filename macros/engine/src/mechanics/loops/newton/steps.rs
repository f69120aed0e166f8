//! Stage `mechanics`: how far an iteration moves its unknowns in a round.
//!
//! In: the equations and their derivatives where the iteration stands. Out: a [`Move`] of each unknown, against its step.
//!
//! Several unknowns move by Newton's step d, J d = f. An angle that is iterated as a point turns by twice the angle whose tangent
//! is t = d/2 (Cayley): that is d but for its cube, so convergence stays quadratic, and a step from far off stays below half a turn.
//! It takes no sines: sin = 2 t / (1 + t^2), 1 - cos = 2 t^2 / (1 + t^2).
//!
//! **One unknown** has one second derivative, which costs little beside what the first one shares with it, while rounds follow
//! each other and cannot be worked out side by side. So its rounds are of third order, and fewer. Of a number it is Halley's step,
//! of an angle the same idea on the circle: what f would be were it a constant, a cosine and a sine,
//!
//! ```text
//! f(x - d) = f - f' sin d + f'' (1 - cos d) = 0,   f (1 + t^2) - 2 f' t + 2 f'' t^2 = 0,   t = tan(d/2)
//! t = n / m,   n = f / f',   m = 2 - n (f / 2 + f'') / f'
//! ```
//!
//! where t is the smaller root up to its third power, as Halley's step is that of a parabola: a round leaves a multiple of the error's
//! cube. The turn needs one division more, w = 2 n / (n^2 + m^2), sin = w m, 1 - cos = w n, and nothing but angles and ratios stands in it,
//! so units and sizes don't matter. As dead centres are approached, where f and f' vanish together, a round of Newton's method halves
//! the error and one of these leaves a third of it: so there as elsewhere ln 2 / ln 3 of the rounds do the same (Traub 1964, *Iterative
//! Methods for the Solution of Equations*, chapter 5). Where the slope is zero nothing moves.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar};

/// How an unknown moves, against its step.
#[derive(Clone, Copy)]
pub(super) enum Move {
    /// Of a number.
    Shift(Scalar),
    /// Of a point on the circle: the sine of the angle by which it is turned back, and one less its cosine.
    Turn { sin: Scalar, versine: Scalar },
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
        let sin = g.div(step, length);
        Move::Turn { sin, versine: g.mul(sin, h) }
    }

    /// By the step of third order, of f and its two derivatives.
    pub(super) fn of_third_order(g: &mut Graph, [value, slope, curvature]: [Scalar; 3], is_point: bool) -> Move {
        let inverse = inverse_or_zero(g, slope);
        let (two, half) = (g.integer(2), g.decimal(0.5));
        let n = g.mul(value, inverse);
        if !is_point {
            // d = n / (1 - n f'' / (2 f')), Halley's.
            let bent = g.mul(half, curvature);
            let bent = g.mul(bent, inverse);
            let bent = g.mul(n, bent);
            let m = g.sub(Scalar::ONE, bent);
            let inverse = inverse_or_zero(g, m);
            return Move::Shift(g.mul(n, inverse));
        }
        let half = g.mul(half, value);
        let rest = g.add(half, curvature);
        let bent = g.mul(rest, inverse);
        let bent = g.mul(n, bent);
        let m = g.sub(two, bent);
        // These don't vanish together: m is two where n is zero.
        let (n_square, m_square) = (g.mul(n, n), g.mul(m, m));
        let length = g.add(n_square, m_square);
        let twice = g.mul(two, n);
        let w = g.div(twice, length);
        Move::Turn { sin: g.mul(w, m), versine: g.mul(w, n) }
    }
}

/// 1 / x, or zero where that is no number.
fn inverse_or_zero(g: &mut Graph, x: Scalar) -> Scalar {
    let inverse = g.reciprocal(x);
    if g.literal(x).is_some_and(|n| !n.is_zero()) {
        return inverse;
    }
    let vanishes = g.call(Call::Equal, &[x, Scalar::ZERO]);
    g.call(Call::Select, &[vanishes, Scalar::ZERO, inverse])
}

/// The point of an angle that is turned back.
pub(super) fn turned_back(g: &mut Graph, [cos, sin]: [Scalar; 2], [turn_sin, versine]: [Scalar; 2]) -> [Scalar; 2] {
    let products = [g.mul(turn_sin, sin), g.mul(versine, cos), g.mul(turn_sin, cos), g.mul(versine, sin)];
    let (more, less) = (g.sub(products[0], products[1]), g.add(products[2], products[3]));
    [g.add(cos, more), g.sub(sin, less)]
}

/// As many rounds of third order as do what these of Newton's method do.
pub(super) fn rounds_of_third_order(rounds: usize) -> usize {
    // 3^n is at least 2^rounds.
    let is_enough = |&count: &usize| 3_u128.pow(count as u32) >= 1 << rounds;
    (1..rounds).find(is_enough).unwrap_or(rounds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_of_third_order_are_as_good_as_newtons() {
        assert_eq!([1, 2, 3, 4, 6, 8, 64].map(rounds_of_third_order), [1, 2, 2, 3, 4, 6, 41]);
    }
}
