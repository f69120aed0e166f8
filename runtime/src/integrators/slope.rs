//! The rate of a whole state: what methods combine.

use super::method::Accepted;
use super::problem::{Problem, Step};
use crate::{Configuration, DisplacementOf, ExtraOf, PositionOf, Real, StateSpace, System, Tangent, VelocityOf, all};

/// Rates of position, velocity and own states, or a displacement of all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope<Q, V, X> {
    /// Of the position.
    pub q: Q,
    /// Of the velocity.
    pub v: V,
    /// Of own states.
    pub x: X,
}

/// The slope of a system.
pub type SlopeOf<S> = Slope<DisplacementOf<S>, VelocityOf<S>, ExtraOf<S>>;

/// A displacement of a whole state.
type Displacement<Z> = Slope<
    <<Z as StateSpace>::Position as Configuration<<Z as StateSpace>::Scalar>>::Velocity,
    <Z as StateSpace>::Velocity,
    <Z as StateSpace>::Extra,
>;

impl<T: Real, Q: Tangent<T>, V: Tangent<T>, X: Tangent<T>> Tangent<T> for Slope<Q, V, X> {
    #[inline]
    fn zero() -> Self {
        Self { q: Q::zero(), v: V::zero(), x: X::zero() }
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        Self { q: self.q.zip(&other.q, f), v: self.v.zip(&other.v, f), x: self.x.zip(&other.x, f) }
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        let start = self.q.fold(start, f);
        let start = self.v.fold(start, f);
        self.x.fold(start, f)
    }
}

/// Coefficients in the scalar's own precision. Inlined always: of constants this is one, and no number of double
/// precision is left in code of single precision.
#[inline(always)]
pub(super) fn literals<T: Real, const N: usize>(values: &[f64; N]) -> [T; N] {
    let mut result = [T::lit(0.0); N];
    for (result, value) in result.iter_mut().zip(values) {
        *result = T::lit(*value);
    }
    result
}

/// A slope at the end of the displacement `d`, as the rate of that displacement.
#[inline]
pub(super) fn rate_of_displacement<S: System>(d: &SlopeOf<S>, slope: &SlopeOf<S>) -> SlopeOf<S> {
    let q = <PositionOf<S> as Configuration<S::Scalar>>::dexp_inv(&d.q, &slope.q);
    Slope { q, ..*slope }
}

/// The state after a displacement.
#[inline]
pub(super) fn displaced<Z: StateSpace>(state: &Z, d: &Displacement<Z>) -> Z {
    let (q, v, x) = state.split();
    state.join(q.displace(&d.q), v.add(&d.v), x.add(&d.x))
}

/// The state after a displacement and what was left over from the one before, with what is left over now.
#[inline]
pub(super) fn advanced<Z: StateSpace>(state: &Z, d: &Displacement<Z>, rest: &Displacement<Z>) -> (Z, Displacement<Z>) {
    use crate::configuration::advanced;
    let (q, v, x) = state.split();
    let (q, rest_q) = q.advance(&d.q, &rest.q);
    let (v, rest_v) = advanced(&v, &d.v, &rest.v);
    let (x, rest_x) = advanced(&x, &d.x, &rest.x);
    (state.join(q, v, x), Slope { q: rest_q, v: rest_v, x: rest_x })
}

/// What is still owed to the state that [`System::accepted`] made of a step's end. A projection moves it by less than the
/// step did, and the rest stays a displacement that is still to come; but where a component has become so small that
/// the rest is no rounding of it any more, the state is another one, to which nothing is owed.
#[inline]
pub(super) fn owed<Z: StateSpace>(next: &Z, rest: &Displacement<Z>) -> Displacement<Z> {
    let zero = Z::Scalar::lit(0.0);
    rest.zip(&magnitude(next), &mut |rest, size| {
        Real::select(Real::le(Real::abs(rest), Z::Scalar::epsilon() * Real::abs(size)), rest, zero)
    })
}

/// The sizes of a state's coordinates.
#[inline]
pub(super) fn magnitude<Z: StateSpace>(state: &Z) -> Displacement<Z> {
    let (q, v, x) = state.split();
    Slope { q: q.magnitude(), v, x }
}

/// The slope that the next step starts with: `last`, the one after the displacement of the step, where
/// [`System::accepted`] has left its end as it was; else it is evaluated at the state that this made of it.
#[inline]
pub(super) fn slope_at_end<S: System>(
    problem: &Problem<'_, S>,
    step: &Step<'_, S>,
    next: &Accepted<S>,
    last: impl FnOnce() -> SlopeOf<S>,
) -> SlopeOf<S> {
    if next.changed {
        return problem.slope(step.end, &next.state);
    }
    // Compensated summation may have rounded the state otherwise.
    Slope { q: problem.position_rates(step.end, &next.state), ..last() }
}

/// `dt * (weights[0] * slopes[0] + ..)`.
#[inline(always)]
pub(super) fn combination<T: Real, V: Tangent<T>, const N: usize>(dt: T, weights: [f64; N], slopes: [&V; N]) -> V {
    let terms = literals(&weights).into_iter().zip(slopes);
    terms.fold(V::zero(), |sum, (weight, slope)| sum.add_scaled(weight, slope)).scale(dt)
}

/// `dt * (first + weights[0] * (slopes[0] - first) + ..)`: a step, of which the weight of the first slope is what the others
/// leave to one.
///
/// The rounding of the weights then falls on differences alone. As it is the same in every step, it would otherwise turn
/// the time by a part of 1e-16: more than all else that compensated summation leaves.
#[inline]
pub(super) fn advance_by<T: Real, V: Tangent<T>, const N: usize>(
    dt: T,
    first: &V,
    weights: [T; N],
    slopes: [&V; N],
) -> V {
    let minus = T::lit(-1.0);
    let terms = weights.into_iter().zip(slopes);
    let change = terms.fold(V::zero(), |sum, (weight, slope)| sum.add_scaled(weight, &slope.add_scaled(minus, first)));
    first.add(&change).scale(dt)
}

/// Whether every component of a vector is finite, in every lane.
#[inline]
pub(super) fn is_finite<T: Real, V: Tangent<T>>(vector: &V) -> bool {
    all(finite(vector))
}

/// The same lane by lane.
#[inline]
pub(super) fn finite<T: Real, V: Tangent<T>>(vector: &V) -> T::Mask {
    let zero = T::lit(0.0);
    vector.fold(Real::le(zero, zero), &mut |finite, component| finite & Real::is_finite(component))
}
