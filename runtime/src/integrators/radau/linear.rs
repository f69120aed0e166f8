//! The linear systems of the simplified Newton iteration, reduced to velocities and own states: [`Matrices`].
//!
//! With `y = (v, x)` and the displacement `d` of the position, the slope at the start has the derivative
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

use super::super::slope::{Slope, SlopeOf};
use super::tableau::{ALPHA, BETA, GAMMA};
use crate::linear::{Solve, Square};
use crate::tangent::unpack;
use crate::{Differentiable, Jacobian, Real, Tangent, VelocityOf, all};

type Vector<S> = <<S as Differentiable>::Matrix as Square<<S as crate::System>::Scalar>>::Vector;
type Factors<S> = <<S as Differentiable>::Matrix as Square<<S as crate::System>::Scalar>>::Factors;
type ComplexFactors<S> = <<S as Differentiable>::Matrix as Square<<S as crate::System>::Scalar>>::ComplexFactors;

/// Real and imaginary part of the inverse of the complex eigenvalue.
const COMPLEX_INVERSE: (f64, f64) = (ALPHA / (ALPHA * ALPHA + BETA * BETA), -BETA / (ALPHA * ALPHA + BETA * BETA));

/// The two matrices for steps of one length, factored.
pub(super) struct Matrices<S: Differentiable> {
    dt: S::Scalar,
    position: S::Matrix,
    real: Factors<S>,
    complex: ComplexFactors<S>,
}

impl<S: Differentiable> Clone for Matrices<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Differentiable> Copy for Matrices<S> {}

impl<S: Differentiable> Matrices<S> {
    /// Factors the matrices of a step.
    pub(super) fn new(jacobian: &Jacobian<S::Matrix>, dt: S::Scalar) -> Self {
        let lit = S::Scalar::lit;
        let (inverse_re, inverse_im) = COMPLEX_INVERSE;
        let matrix = |diagonal: f64, rates: S::Scalar, positions: S::Scalar| {
            S::Matrix::from_fn(|i, j| {
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

    /// Whether these serve for steps of the length `dt`, which may differ by the rounding of a time.
    pub(super) fn are_for(&self, dt: S::Scalar) -> bool {
        all(Real::le(Real::abs(dt - self.dt), S::Scalar::lit(1e-6) * Real::abs(dt)))
    }

    /// `(gamma - h J)^-1 r`.
    #[inline]
    pub(super) fn solve_real(&self, r: &SlopeOf<S>) -> SlopeOf<S> {
        let inverse = S::Scalar::lit(1.0 / GAMMA);
        let pushed = self.position.times(&S::Matrix::packed(&r.q.scale(inverse * self.dt)));
        let y = self.real.solve(&sum::<S>(&S::Matrix::packed(&(r.v, r.x)), &pushed));
        let Slope { v, x, .. } = slope::<S>(&y);
        Slope { q: r.q.add_scaled(self.dt, &v).scale(inverse), v, x }
    }

    /// `(alpha + i beta - h J)^-1 (r2 + i r3)`.
    #[inline]
    pub(super) fn solve_complex(&self, r2: &SlopeOf<S>, r3: &SlopeOf<S>) -> (SlopeOf<S>, SlopeOf<S>) {
        let (re, im) = (S::Scalar::lit(COMPLEX_INVERSE.0), S::Scalar::lit(COMPLEX_INVERSE.1));
        let divided = |a: &VelocityOf<S>, b: &VelocityOf<S>| {
            (a.scale(re).add_scaled(-im, b), b.scale(re).add_scaled(im, a)) //
        };
        let (q2, q3) = divided(&r2.q, &r3.q);
        let pushed = |q: &VelocityOf<S>| self.position.times(&S::Matrix::packed(&q.scale(self.dt)));
        let right = (
            sum::<S>(&S::Matrix::packed(&(r2.v, r2.x)), &pushed(&q2)),
            sum::<S>(&S::Matrix::packed(&(r3.v, r3.x)), &pushed(&q3)),
        );
        let (y2, y3) = self.complex.solve(&right);
        let (mut y2, mut y3) = (slope::<S>(&y2), slope::<S>(&y3));
        (y2.q, y3.q) = divided(&r2.q.add_scaled(self.dt, &y2.v), &r3.q.add_scaled(self.dt, &y3.v));
        (y2, y3)
    }
}

/// A vector as velocities and own states.
#[inline]
fn slope<S: Differentiable>(vector: &Vector<S>) -> SlopeOf<S> {
    let (v, x) = unpack(vector.as_ref());
    Slope { q: Tangent::zero(), v, x }
}

#[inline]
fn sum<S: Differentiable>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    let mut sum = *a;
    for (a, &b) in sum.as_mut().iter_mut().zip(b.as_ref()) {
        *a += b;
    }
    sum
}
