//! Systems with constraints written by hand: a bob on a rod in x and y, and a four-bar linkage in absolute coordinates.

#![allow(clippy::needless_range_loop)] // equations are known by their numbers

use core::cell::Cell;
use multibody::linear::{least_norm, solve_symmetric};
use multibody::nalgebra::{SMatrix, SVector, Vector2};
use multibody::{
    Constrained, DisplacementOf, ExtraOf, Impulsive, PositionOf, Real, StateSpace, System, Tangent, VelocityOf,
};

/// Positions and velocities in one vector each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coordinates<T, const N: usize> {
    pub(crate) q: SVector<T, N>,
    pub(crate) v: SVector<T, N>,
}

impl<T: Real, const N: usize> StateSpace for Coordinates<T, N> {
    type Scalar = T;
    type Position = SVector<T, N>;
    type Velocity = SVector<T, N>;
    type Extra = ();
    fn split(&self) -> (SVector<T, N>, SVector<T, N>, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: SVector<T, N>, v: SVector<T, N>, (): ()) -> Self {
        Self { q, v }
    }
}

/// A bob of mass one on a rod of the length `1 + stretch * sin(t)`, in x and y.
pub(crate) struct Rod<T> {
    pub(crate) gravity: T,
    pub(crate) stretch: T,
}

impl<T: Real> Rod<T> {
    pub(crate) fn rigid() -> Self {
        Self { gravity: T::lit(9.81), stretch: T::lit(0.0) }
    }
    /// Length, its rate and the rate of that.
    fn length(&self, t: T) -> [T; 3] {
        let (sin, cos) = Real::sin_cos(t);
        [T::lit(1.0) + self.stretch * sin, self.stretch * cos, -self.stretch * sin]
    }
}

fn dot<T: Real, const N: usize>(a: &SVector<T, N>, b: &SVector<T, N>) -> T {
    (0..N).fold(T::lit(0.0), |sum, i| sum + a[i] * b[i])
}

impl<T: Real> System for Rod<T> {
    type Scalar = T;
    type State = Coordinates<T, 2>;
    type Input = ();
    fn derivative(&self, t: T, state: &Coordinates<T, 2>, (): &()) -> (Vector2<T>, ()) {
        let [l, l1, l2] = self.length(t);
        let gravity = Vector2::new(T::lit(0.0), -self.gravity);
        let bias = dot(&state.v, &state.v) - l1 * l1 - l * l2;
        let pull = (dot(&gravity, &state.q) + bias) / dot(&state.q, &state.q);
        (gravity.add_scaled(-pull, &state.q), ())
    }
    fn position_rates(&self, _t: T, state: &Coordinates<T, 2>) -> Vector2<T> {
        state.v
    }
}

impl<T: Real> Constrained for Rod<T> {
    type Residual = T;
    fn constraints(&self, t: T, q: &Vector2<T>) -> T {
        let [l, ..] = self.length(t);
        T::lit(0.5) * (dot(q, q) - l * l)
    }
    fn constraint_rate(&self, t: T, state: &Coordinates<T, 2>) -> T {
        let [l, l1, _] = self.length(t);
        dot(&state.q, &state.v) - l * l1
    }
    fn correction(&self, _t: T, state: &Self::State, residual: &T, weights: &Vector2<T>) -> (Vector2<T>, T) {
        least_norm(&SMatrix::<T, 1, 2>::from([[state.q[0]], [state.q[1]]]), &SVector::from([*residual]), weights)
    }
    fn velocity_correction(
        &self,
        t: T,
        state: &Coordinates<T, 2>,
        residual: &T,
        weights: &Vector2<T>,
    ) -> (Vector2<T>, T) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: T, state: &Coordinates<T, 2>, d: &Vector2<T>) -> T {
        self.constraint_rate_along(t, state, d)
    }
}

impl<T: Real> Impulsive for Rod<T> {
    type Rates = T;
    fn jump(&self, _t: T, state: &Self::State, impulse: &Vector2<T>, rates: &T) -> (Vector2<T>, T) {
        let square = dot(&state.q, &state.q);
        let pull = (dot(&state.q, impulse) - *rates) / square;
        (impulse.add_scaled(-pull, &state.q), T::lit(1.0))
    }
}

/// Two ends that are one point, bar and side of it, and where that is if it is on the ground.
type Pin = ([Option<(usize, f64)>; 2], f64);

/// Four-bar linkage: crank, coupler and rocker, each with x, y and angle of its middle, four pins and so eight
/// equations. `M` beyond eight repeats equations from the first on. Mass one for each metre.
pub(crate) struct FourBar<T, const M: usize> {
    pub(crate) gravity: T,
    /// Ground, crank, coupler, rocker.
    pub(crate) lengths: [T; 4],
}

impl<T: Real, const M: usize> FourBar<T, M> {
    pub(crate) fn new(gravity: f64, lengths: [f64; 4]) -> Self {
        Self { gravity: T::lit(gravity), lengths: lengths.map(T::lit) }
    }

    /// The ends that each pin joins: bars with the distance from their middle, in halves of their length; the last
    /// number is where the pin is on the ground, in lengths of it.
    const PINS: [Pin; 4] = [
        ([Some((0, -1.0)), None], 0.0),
        ([Some((0, 1.0)), Some((1, -1.0))], 0.0),
        ([Some((1, 1.0)), Some((2, 1.0))], 0.0),
        ([Some((2, -1.0)), None], 1.0),
    ];

    /// For the row `m`: its pin and its axis.
    fn row(m: usize) -> (usize, usize) {
        ((m % 8) / 2, m % 2)
    }

    /// Calls `f` with the bar, the sign, and the half length of each end at a pin.
    fn ends(&self, pin: usize, mut f: impl FnMut(usize, T, T)) {
        for (end, sign) in Self::PINS[pin].0.into_iter().zip([1.0, -1.0]) {
            if let Some((bar, side)) = end {
                f(bar, T::lit(sign), T::lit(0.5 * side) * self.lengths[bar + 1]);
            }
        }
    }

    pub(crate) fn jacobian(&self, q: &SVector<T, 9>) -> SMatrix<T, M, 9> {
        let mut g = [[T::lit(0.0); M]; 9];
        for m in 0..M {
            let (pin, axis) = Self::row(m);
            self.ends(pin, |bar, sign, half| {
                let (sin, cos) = Real::sin_cos(q[3 * bar + 2]);
                g[3 * bar + axis][m] += sign;
                g[3 * bar + 2][m] += sign * half * if axis == 0 { -sin } else { cos };
            });
        }
        g.into()
    }

    fn masses(&self) -> SVector<T, 9> {
        let mut masses = [T::lit(0.0); 9];
        for bar in 0..3 {
            let l = self.lengths[bar + 1];
            masses[3 * bar] = l;
            masses[3 * bar + 1] = l;
            masses[3 * bar + 2] = l * l * l / T::lit(12.0);
        }
        masses.into()
    }

    pub(crate) fn energy(&self, state: &Coordinates<T, 9>) -> T {
        let masses = self.masses();
        (0..9).fold(T::lit(0.0), |sum, i| {
            let height = if i % 3 == 1 { self.gravity * state.q[i] } else { T::lit(0.0) };
            sum + masses[i] * (T::lit(0.5) * state.v[i] * state.v[i] + height)
        })
    }

    /// The state that follows from angles and rates of the bars: pins 0 to 2 close, the last one is left as it is.
    pub(crate) fn at_angles(&self, angles: [T; 3], rates: [T; 3]) -> Coordinates<T, 9> {
        let half = |bar: usize| T::lit(0.5) * self.lengths[bar + 1];
        let mut q = [T::lit(0.0); 9];
        let mut v = [T::lit(0.0); 9];
        let (mut x, mut y, mut vx, mut vy) = (T::lit(0.0), T::lit(0.0), T::lit(0.0), T::lit(0.0));
        for bar in 0..3 {
            let (sin, cos) = Real::sin_cos(angles[bar]);
            let (half, w) = if bar == 2 { (-half(bar), rates[bar]) } else { (half(bar), rates[bar]) };
            (x, y, vx, vy) = (x + half * cos, y + half * sin, vx - half * sin * w, vy + half * cos * w);
            (q[3 * bar], q[3 * bar + 1], q[3 * bar + 2]) = (x, y, angles[bar]);
            (v[3 * bar], v[3 * bar + 1], v[3 * bar + 2]) = (vx, vy, w);
            (x, y, vx, vy) = (x + half * cos, y + half * sin, vx - half * sin * w, vy + half * cos * w);
        }
        Coordinates { q: q.into(), v: v.into() }
    }
}

impl<T: Real, const M: usize> System for FourBar<T, M> {
    type Scalar = T;
    type State = Coordinates<T, 9>;
    type Input = ();
    fn derivative(&self, _t: T, state: &Coordinates<T, 9>, (): &()) -> (SVector<T, 9>, ()) {
        let (g, masses) = (self.jacobian(&state.q), self.masses());
        let free: [T; 9] = core::array::from_fn(|i| if i % 3 == 1 { -self.gravity } else { T::lit(0.0) });
        let mut schur = [[T::lit(0.0); M]; M];
        let mut right = [T::lit(0.0); M];
        for m in 0..M {
            for n in 0..M {
                schur[m][n] = (0..9).fold(T::lit(0.0), |sum, i| sum + g[(m, i)] * g[(n, i)] / masses[i]);
            }
            right[m] = (0..9).fold(T::lit(0.0), |sum, i| sum + g[(m, i)] * free[i]);
            let (pin, axis) = Self::row(m);
            self.ends(pin, |bar, sign, half| {
                let (sin, cos) = Real::sin_cos(state.q[3 * bar + 2]);
                let rate = state.v[3 * bar + 2];
                right[m] -= sign * half * rate * rate * if axis == 0 { cos } else { sin };
            });
        }
        let (multipliers, _) = solve_symmetric(schur, right);
        let accel =
            core::array::from_fn(|i| (0..M).fold(free[i], |sum, m| sum - g[(m, i)] * multipliers[m] / masses[i]));
        (SVector::from(accel), ())
    }
    fn position_rates(&self, _t: T, state: &Coordinates<T, 9>) -> SVector<T, 9> {
        state.v
    }
}

impl<T: Real, const M: usize> Constrained for FourBar<T, M> {
    type Residual = SVector<T, M>;
    fn constraints(&self, _t: T, q: &SVector<T, 9>) -> SVector<T, M> {
        let mut phi = [T::lit(0.0); M];
        for (m, phi) in phi.iter_mut().enumerate() {
            let (pin, axis) = Self::row(m);
            if axis == 0 {
                *phi -= T::lit(Self::PINS[pin].1) * self.lengths[0];
            }
            self.ends(pin, |bar, sign, half| {
                let (sin, cos) = Real::sin_cos(q[3 * bar + 2]);
                *phi += sign * (q[3 * bar + axis] + half * if axis == 0 { cos } else { sin });
            });
        }
        phi.into()
    }
    fn constraint_rate(&self, _t: T, state: &Coordinates<T, 9>) -> SVector<T, M> {
        let g = self.jacobian(&state.q);
        let rate = core::array::from_fn(|m| (0..9).fold(T::lit(0.0), |sum, i| sum + g[(m, i)] * state.v[i]));
        SVector::from(rate)
    }
    fn correction(
        &self,
        _t: T,
        state: &Self::State,
        residual: &SVector<T, M>,
        weights: &SVector<T, 9>,
    ) -> (SVector<T, 9>, T) {
        least_norm(&self.jacobian(&state.q), residual, weights)
    }
    fn velocity_correction(
        &self,
        t: T,
        state: &Coordinates<T, 9>,
        residual: &SVector<T, M>,
        weights: &SVector<T, 9>,
    ) -> (SVector<T, 9>, T) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: T, state: &Coordinates<T, 9>, d: &SVector<T, 9>) -> SVector<T, M> {
        self.constraint_rate_along(t, state, d)
    }
}

impl<T: Real, const M: usize> Impulsive for FourBar<T, M> {
    type Rates = SVector<T, M>;
    fn jump(&self, _t: T, state: &Self::State, impulse: &SVector<T, 9>, rates: &SVector<T, M>) -> (SVector<T, 9>, T) {
        let (g, masses) = (self.jacobian(&state.q), self.masses());
        let mut schur = [[T::lit(0.0); M]; M];
        let mut right = [T::lit(0.0); M];
        for m in 0..M {
            for n in 0..M {
                schur[m][n] = (0..9).fold(T::lit(0.0), |sum, i| sum + g[(m, i)] * g[(n, i)] / masses[i]);
            }
            right[m] = (0..9).fold(-rates[m], |sum, i| sum + g[(m, i)] * impulse[i] / masses[i]);
        }
        let (multipliers, rank) = solve_symmetric(schur, right);
        let jump =
            core::array::from_fn(|i| (0..M).fold(impulse[i], |sum, m| sum - g[(m, i)] * multipliers[m]) / masses[i]);
        (SVector::from(jump), rank)
    }
}

/// Counts what is asked of a system.
pub(crate) struct Watched<S> {
    pub(crate) system: S,
    pub(crate) evaluations: Cell<u32>,
    pub(crate) corrections: Cell<u32>,
}

pub(crate) fn watched<S>(system: S) -> Watched<S> {
    Watched { system, evaluations: Cell::new(0), corrections: Cell::new(0) }
}

impl<S: System> System for Watched<S> {
    type Scalar = S::Scalar;
    type State = S::State;
    type Input = S::Input;
    fn derivative(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> (VelocityOf<S>, ExtraOf<S>) {
        self.system.derivative(t, state, input)
    }
    fn position_rates(&self, t: S::Scalar, state: &S::State) -> DisplacementOf<S> {
        self.system.position_rates(t, state)
    }
}

impl<S: Constrained> Constrained for Watched<S> {
    type Residual = S::Residual;
    fn constraints(&self, t: S::Scalar, q: &PositionOf<S>) -> S::Residual {
        self.evaluations.set(self.evaluations.get() + 1);
        self.system.constraints(t, q)
    }
    fn constraint_rate(&self, t: S::Scalar, state: &S::State) -> S::Residual {
        self.evaluations.set(self.evaluations.get() + 1);
        self.system.constraint_rate(t, state)
    }
    fn correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &DisplacementOf<S>,
    ) -> (DisplacementOf<S>, S::Scalar) {
        self.corrections.set(self.corrections.get() + 1);
        self.system.correction(t, state, residual, weights)
    }
    fn velocity_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &VelocityOf<S>,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.corrections.set(self.corrections.get() + 1);
        self.system.velocity_correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: S::Scalar, state: &S::State, d: &DisplacementOf<S>) -> S::Residual {
        self.evaluations.set(self.evaluations.get() + 2);
        self.system.constraints_along(t, state, d)
    }
}
