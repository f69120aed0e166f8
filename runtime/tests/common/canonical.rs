//! A double pendulum in velocities and in momenta, written by hand: two point masses of one kilogram on massless rods
//! of one metre, in absolute angles.

use multibody::nalgebra::Vector2;
use multibody::{Canonical, Real, System};

use super::loops::Coordinates;

#[derive(Clone, Copy)]
pub(crate) struct DoublePendulum<T> {
    pub(crate) gravity: T,
}

pub(crate) type Angles<T> = Coordinates<T, 2>;

impl<T: Real> DoublePendulum<T> {
    pub(crate) fn energy(&self, state: &Angles<T>) -> T {
        let [w1, w2] = state.v.into();
        let half = T::lit(0.5);
        let kinetic = w1 * w1 + half * w2 * w2 + w1 * w2 * Real::cos(state.q[0] - state.q[1]);
        // 1 - cos, so that small energies keep their digits
        let rise = |angle: T| T::lit(2.0) * Real::powi(Real::sin(half * angle), 2);
        kinetic + self.gravity * (T::lit(2.0) * rise(state.q[0]) + rise(state.q[1]))
    }

    /// `M(q)^-1 b` with `M = [2, cos; cos, 1]`.
    fn solve(&self, q: &Vector2<T>, b: [T; 2]) -> Vector2<T> {
        let c = Real::cos(q[0] - q[1]);
        let det = T::lit(2.0) - c * c;
        Vector2::from([(b[0] - c * b[1]) / det, (T::lit(2.0) * b[1] - c * b[0]) / det])
    }

    fn weights(&self, q: &Vector2<T>) -> [T; 2] {
        [-T::lit(2.0) * self.gravity * Real::sin(q[0]), -self.gravity * Real::sin(q[1])]
    }
}

impl<T: Real> System for DoublePendulum<T> {
    type Scalar = T;
    type State = Angles<T>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Angles<T>, (): &()) -> (Vector2<T>, ()) {
        let [w1, w2] = state.v.into();
        let s = Real::sin(state.q[0] - state.q[1]);
        let [f1, f2] = self.weights(&state.q);
        (self.solve(&state.q, [f1 - s * w2 * w2, f2 + s * w1 * w1]), ())
    }
    fn position_rates(&self, _t: T, state: &Angles<T>) -> Vector2<T> {
        state.v
    }
}

impl<T: Real> Canonical for DoublePendulum<T> {
    fn momentum(&self, state: &Angles<T>) -> Vector2<T> {
        let [w1, w2] = state.v.into();
        let c = Real::cos(state.q[0] - state.q[1]);
        Vector2::from([T::lit(2.0) * w1 + c * w2, c * w1 + w2])
    }
    fn velocity(&self, q: &Vector2<T>, momentum: &Vector2<T>) -> Vector2<T> {
        self.solve(q, [momentum[0], momentum[1]])
    }
    fn momentum_rate(&self, _t: T, state: &Angles<T>, (): &()) -> Vector2<T> {
        let [w1, w2] = state.v.into();
        let couple = w1 * w2 * Real::sin(state.q[0] - state.q[1]);
        let [f1, f2] = self.weights(&state.q);
        Vector2::from([f1 - couple, f2 + couple])
    }
}
