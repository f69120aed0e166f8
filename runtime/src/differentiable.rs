//! Partial derivatives of the equations of motion: [`Differentiable`], for implicit methods and equilibria, and
//! [`Derivatives`], what `emit derivatives` gives.
//!
//! A position is differentiated by its displacement: for a rotation by the angle about each of its own axes, for all
//! else by the coordinate itself.

use crate::linear::Square;
use crate::{ExtraOf, Real, System, VelocityOf};
use nalgebra::SMatrix;

/// Partial derivatives of the `R` results of a function: by the `N` components of a displacement of the position, by the
/// `N` velocities, by the `X` own states and by the `U` inputs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives<T, const R: usize, const N: usize, const X: usize, const U: usize> {
    /// By displacement of the position.
    pub position: SMatrix<T, R, N>,
    /// By velocity.
    pub velocity: SMatrix<T, R, N>,
    /// By own states.
    pub states: SMatrix<T, R, X>,
    /// By inputs.
    pub input: SMatrix<T, R, U>,
}

impl<T: Real, const R: usize, const N: usize, const X: usize, const U: usize> Derivatives<T, R, N, X, U> {
    /// Derivatives of forward dynamics in the form of [`Differentiable::jacobian`].
    #[inline]
    #[must_use]
    pub fn jacobian(&self) -> Jacobian<[[T; R]; R]> {
        self.jacobian_at(&core::array::from_fn(|place| place))
    }

    /// The same with rows and columns in another order: of each, its place among the velocities and own states. Where the
    /// place is none of these, the row and the column are zero.
    #[must_use]
    pub fn jacobian_at<const W: usize>(&self, places: &[usize; W]) -> Jacobian<[[T; W]; W]> {
        let entry = |matrix: &[T], row: usize, column: usize| {
            let place = column.checked_mul(R).and_then(|start| start.checked_add(row));
            let found = place.filter(|_| row < R).and_then(|place| matrix.get(place));
            found.copied().unwrap_or_else(|| T::lit(0.0))
        };
        let rate = |row: usize, column: usize| match column.checked_sub(N) {
            Some(state) => entry(self.states.as_slice(), row, state),
            None => entry(self.velocity.as_slice(), row, column),
        };
        Jacobian {
            position: places.map(|row| places.map(|column| entry(self.position.as_slice(), row, column))),
            rates: places.map(|row| places.map(|column| rate(row, column))),
        }
    }

    /// The derivative by the inputs, times a change of them.
    #[must_use]
    pub fn along_input(&self, change: &[T; U]) -> [T; R] {
        let mut sum = [T::lit(0.0); R];
        for (column, &change) in self.input.as_slice().chunks_exact(R.max(1)).zip(change) {
            for (sum, &slope) in sum.iter_mut().zip(column) {
                *sum += slope * change;
            }
        }
        sum
    }
}

/// How the rates of velocities and own states change with the state: what [`Differentiable::jacobian`] gives.
#[derive(Clone, Copy, Debug)]
pub struct Jacobian<M> {
    /// By displacement of the position; columns beyond the degrees of freedom are zero.
    pub position: M,
    /// By velocities, then own states.
    pub rates: M,
}

/// A system whose [`derivative`](System::derivative) can be differentiated exactly.
///
/// Models with `emit derivatives` implement it. Write `W` for the number of velocities and own states together. With
/// `y = (v, x)` and `y' = f(q, y)`, implicit methods then need to solve `W` equations, not as many as there are
/// coordinates in all, since `q' = v`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives, which implicit methods and equilibria need",
    label = "this has to be `Differentiable`",
    note = "a model of `multibody!` is with `emit forward_dynamics, derivatives`"
)]
pub trait Differentiable: System {
    /// A matrix of `W` rows and columns, `[[T; W]; W]`, by rows.
    type Matrix: Square<Self::Scalar>;

    /// Derivatives of the rates of velocities and own states, at `t` `[s]`.
    fn jacobian(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> Jacobian<Self::Matrix>;

    /// How these rates change along a change of the inputs: the derivative by the inputs, times `change`.
    fn input_derivative(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
        change: &Self::Input,
    ) -> (VelocityOf<Self>, ExtraOf<Self>);
}

impl<S: Differentiable + ?Sized> Differentiable for &S {
    type Matrix = S::Matrix;

    #[inline]
    fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> Jacobian<S::Matrix> {
        (**self).jacobian(t, state, input)
    }
    #[inline]
    fn input_derivative(
        &self,
        t: S::Scalar,
        state: &S::State,
        input: &S::Input,
        change: &S::Input,
    ) -> (VelocityOf<S>, ExtraOf<S>) {
        (**self).input_derivative(t, state, input, change)
    }
}
