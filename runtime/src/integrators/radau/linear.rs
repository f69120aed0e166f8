//! The linear systems of the simplified Newton iteration: [`Matrices`], reduced to velocities and own states where the
//! velocities are the rates of coordinates ([`Eliminated`]), or of all that a state is made of ([`Entire`]).
//!
//! Of the former: with `y = (v, x)` and the displacement `d` of the position, the slope at the start has the derivative
//! `J = [0, P; Jp, Jr]`, where `P` takes the velocities out of `y`. A system `(g - h J) (d, y) = (a, b)`, with `g` real or
//! complex, gives `d = (a + h P y) / g`, and put into the second row
//!
//! ```text
//! (g - h Jr - h^2 / g Jp) y = b + h / g Jp a
//! ```
//!
//! so that a matrix of the size of `y` is factored, not one of all coordinates. (Between `d` and the velocities rotations
//! have `dexp_inv`, whose change along a step is left to the iteration: it makes the iteration contract by about a tenth of
//! the angle turned in the step.)

use super::super::slope::Slope;
use super::tableau::{ALPHA, BETA, GAMMA};
use crate::linear::{Solve, Square};
use crate::tangent::unpack;
use crate::{
    Differentiable, DisplacementOf, ExtraOf, FullJacobian, Jacobian, JacobianMatrix, Real, System, Tangent, VelocityOf,
    all,
};

/// Real and imaginary part of the inverse of the complex eigenvalue.
const COMPLEX_INVERSE: (f64, f64) = (ALPHA / (ALPHA * ALPHA + BETA * BETA), -BETA / (ALPHA * ALPHA + BETA * BETA));

/// The matrices of a system.
pub(super) type MatricesOf<S> = <<S as Differentiable>::Matrix as JacobianMatrix<
    <S as System>::Scalar,
    DisplacementOf<S>,
    VelocityOf<S>,
    ExtraOf<S>,
>>::Radau;

/// The two matrices for steps of one length, factored: `gamma - h J` and `alpha + i beta - h J` with the derivatives `J`
/// of slopes, of which `D` tells.
pub trait Matrices<T: Real, Q, V, X, D>: Copy {
    /// Factors the matrices of a step.
    fn new(jacobian: &D, dt: T) -> Self;

    /// `[s]` the length of that step.
    fn dt(&self) -> T;

    /// Whether these serve for steps of the length `dt`, which may differ by the rounding of a time.
    #[inline]
    fn are_for(&self, dt: T) -> bool {
        all(Real::le(Real::abs(dt - self.dt()), T::lit(1e-6) * Real::abs(dt)))
    }

    /// `(gamma - h J)^-1 r`.
    fn solve_real(&self, r: &Slope<Q, V, X>) -> Slope<Q, V, X>;

    /// `(alpha + i beta - h J)^-1 (r2 + i r3)`.
    fn solve_complex(&self, r2: &Slope<Q, V, X>, r3: &Slope<Q, V, X>) -> (Slope<Q, V, X>, Slope<Q, V, X>);
}

/// Where velocities are the rates of coordinates: matrices of the size of velocities and own states.
#[derive(Clone, Copy)]
pub struct Eliminated<T: Real, M: Square<T>> {
    dt: T,
    position: M,
    real: M::Factors,
    complex: M::ComplexFactors,
}

impl<T: Real, V: Tangent<T>, X: Tangent<T>, M: Square<T>> Matrices<T, V, V, X, Jacobian<M>> for Eliminated<T, M> {
    fn new(jacobian: &Jacobian<M>, dt: T) -> Self {
        let lit = T::lit;
        let (inverse_re, inverse_im) = COMPLEX_INVERSE;
        let matrix = |diagonal: f64, rates: T, positions: T| {
            M::from_fn(|i, j| {
                let diagonal = lit(if i == j { diagonal } else { 0.0 });
                diagonal - rates * jacobian.rates.get(i, j) - positions * jacobian.position.get(i, j)
            })
        };
        let square = dt * dt;
        let real = matrix(GAMMA, dt, square * lit(1.0 / GAMMA));
        let re = matrix(ALPHA, dt, square * lit(inverse_re));
        let im = matrix(BETA, lit(0.0), square * lit(inverse_im));
        Self { dt, position: jacobian.position, real: real.factors(), complex: re.complex_factors(&im) }
    }

    #[inline]
    fn dt(&self) -> T {
        self.dt
    }

    #[inline]
    fn solve_real(&self, r: &Slope<V, V, X>) -> Slope<V, V, X> {
        let inverse = T::lit(1.0 / GAMMA);
        let pushed = self.position.times(&M::packed(&r.q.scale(inverse * self.dt)));
        let y = self.real.solve(&sum::<T, M>(&M::packed(&(r.v, r.x)), &pushed));
        let (v, x): (V, X) = unpack(y.as_ref());
        Slope { q: r.q.add_scaled(self.dt, &v).scale(inverse), v, x }
    }

    #[inline]
    fn solve_complex(&self, r2: &Slope<V, V, X>, r3: &Slope<V, V, X>) -> (Slope<V, V, X>, Slope<V, V, X>) {
        let (re, im) = (T::lit(COMPLEX_INVERSE.0), T::lit(COMPLEX_INVERSE.1));
        let divided = |a: &V, b: &V| (a.scale(re).add_scaled(-im, b), b.scale(re).add_scaled(im, a));
        let (q2, q3) = divided(&r2.q, &r3.q);
        let pushed = |q: &V| self.position.times(&M::packed(&q.scale(self.dt)));
        let right = (
            sum::<T, M>(&M::packed(&(r2.v, r2.x)), &pushed(&q2)),
            sum::<T, M>(&M::packed(&(r3.v, r3.x)), &pushed(&q3)),
        );
        let (y2, y3) = self.complex.solve(&right);
        let ((v2, x2), (v3, x3)): ((V, X), (V, X)) = (unpack(y2.as_ref()), unpack(y3.as_ref()));
        let (q2, q3) = divided(&r2.q.add_scaled(self.dt, &v2), &r3.q.add_scaled(self.dt, &v3));
        (Slope { q: q2, v: v2, x: x2 }, Slope { q: q3, v: v3, x: x3 })
    }
}

/// For any velocities: matrices of the size of displacements, velocities and own states.
#[derive(Clone, Copy)]
pub struct Entire<T: Real, M: Square<T>> {
    dt: T,
    real: M::Factors,
    complex: M::ComplexFactors,
}

impl<T, Q, V, X, M> Matrices<T, Q, V, X, FullJacobian<M>> for Entire<T, M>
where
    T: Real,
    Q: Tangent<T>,
    V: Tangent<T>,
    X: Tangent<T>,
    M: Square<T>,
{
    fn new(FullJacobian(jacobian): &FullJacobian<M>, dt: T) -> Self {
        let diagonal = |value: f64, i: usize, j: usize| T::lit(if i == j { value } else { 0.0 });
        let less = |value: f64| M::from_fn(|i, j| diagonal(value, i, j) - dt * jacobian.get(i, j));
        let imaginary = M::from_fn(|i, j| diagonal(BETA, i, j));
        Self { dt, real: less(GAMMA).factors(), complex: less(ALPHA).complex_factors(&imaginary) }
    }

    #[inline]
    fn dt(&self) -> T {
        self.dt
    }

    #[inline]
    fn solve_real(&self, r: &Slope<Q, V, X>) -> Slope<Q, V, X> {
        unpack(self.real.solve(&M::packed(r)).as_ref())
    }

    #[inline]
    fn solve_complex(&self, r2: &Slope<Q, V, X>, r3: &Slope<Q, V, X>) -> (Slope<Q, V, X>, Slope<Q, V, X>) {
        let (y2, y3) = self.complex.solve(&(M::packed(r2), M::packed(r3)));
        (unpack(y2.as_ref()), unpack(y3.as_ref()))
    }
}

#[inline]
fn sum<T: Real, M: Square<T>>(a: &M::Vector, b: &M::Vector) -> M::Vector {
    let mut sum = *a;
    for (a, &b) in sum.as_mut().iter_mut().zip(b.as_ref()) {
        *a += b;
    }
    sum
}
