//! Partial derivatives of the equations of motion: [`Differentiable`], for implicit methods and equilibria, and
//! [`Derivatives`], what `emit derivatives` gives.
//!
//! A position is differentiated by its displacement: for a rotation by the angle about each of its own axes, for all
//! else by the coordinate itself.

use crate::integrators::{Eliminated, Entire, Matrices};
use crate::linear::Square;
use crate::{DisplacementOf, ExtraOf, Real, System, Tangent, VelocityOf};
use nalgebra::SMatrix;

/// Partial derivatives of the `R` results of a function: by the `P` components of a displacement of the position, which are
/// as many as velocities where these are the rates of coordinates, by the `N` velocities, by the `X` own states and by the `U`
/// inputs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives<T, const R: usize, const N: usize, const X: usize, const U: usize, const P: usize = N> {
    /// By displacement of the position.
    pub position: SMatrix<T, R, P>,
    /// By velocity.
    pub velocity: SMatrix<T, R, N>,
    /// By own states.
    pub states: SMatrix<T, R, X>,
    /// By inputs.
    pub input: SMatrix<T, R, U>,
}

impl<T: Real, const R: usize, const N: usize, const X: usize, const U: usize, const P: usize>
    Derivatives<T, R, N, X, U, P>
{
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

    /// How the result `row` changes with a displacement of the position, the velocities and own states, counted through;
    /// nothing outside of these.
    fn by_state(&self, row: usize, column: usize) -> Option<T> {
        let entry = |matrix: &[T], column: usize| {
            let place = column.checked_mul(R)?.checked_add(row)?;
            matrix.get(place).filter(|_| row < R).copied()
        };
        let Some(column) = column.checked_sub(P) else { return entry(self.position.as_slice(), column) };
        match column.checked_sub(N) {
            None => entry(self.velocity.as_slice(), column),
            Some(column) => entry(self.states.as_slice(), column),
        }
    }
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
}

/// How the rates of velocities and own states change with the state: what [`Differentiable::jacobian`] gives where
/// velocities are the rates of coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Jacobian<M> {
    /// By displacement of the position; columns beyond the degrees of freedom are zero.
    pub position: M,
    /// By velocities, then own states.
    pub rates: M,
}

/// How all rates of a system change with the state, where velocities need not be the rates of coordinates: what
/// [`Differentiable::jacobian`] gives there, and at the same time the matrix that it is made of.
///
/// Rows are the rates of the position (see [`System::position_rates`]), of the velocities and of own states. Columns are
/// the displacement of the position, the velocities and own states: as many, in the same order. A rotation is displaced
/// by angles about its own axes, and its rate is the angular velocity about them.
///
/// ```
/// use multibody::{Differentiable, FullJacobian, Radau, StateSpace, System};
///
/// #[derive(Clone, Copy)]
/// struct State { q: f64, u: f64 }
///
/// impl StateSpace for State {
///     type Scalar = f64;
///     type Position = f64;
///     type Velocity = f64;
///     type Extra = ();
///     fn split(&self) -> (f64, f64, ()) { (self.q, self.u, ()) }
///     fn join(&self, q: f64, u: f64, (): ()) -> Self { Self { q, u } }
/// }
///
/// /// `q' = 2 u`, `u' = -q - 100 u`.
/// struct Damped;
///
/// impl System for Damped {
///     type Scalar = f64;
///     type State = State;
///     type Input = ();
///     fn derivative(&self, _t: f64, x: &State, (): &()) -> (f64, ()) { (-x.q - 100.0 * x.u, ()) }
///     fn position_rates(&self, _t: f64, x: &State) -> f64 { 2.0 * x.u }
/// }
///
/// impl Differentiable for Damped {
///     type Matrix = FullJacobian<[[f64; 2]; 2]>;
///     fn jacobian(&self, _t: f64, _x: &State, (): &()) -> FullJacobian<[[f64; 2]; 2]> {
///         FullJacobian([[0.0, 2.0], [-1.0, -100.0]])
///     }
///     fn input_derivative(&self, _t: f64, _x: &State, (): &(), (): &()) -> (f64, ()) { (0.0, ()) }
/// }
///
/// let end = Radau::integrate(&Damped, 0.0, &State { q: 1.0, u: 0.0 }, &(), 0.5, 100, |_, _| ())?;
/// let slow = 50.0 - 2498.0_f64.sqrt(); // 1/s
/// assert!((end.q / (-slow * 50.0).exp() - 1.0).abs() < 1e-3);
/// # Ok::<(), multibody::IntegrationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullJacobian<M>(pub M);

impl<T: Real, const W: usize> FullJacobian<[[T; W]; W]> {
    /// From the derivatives of the rates of positions and those of forward dynamics. Of each row and column it takes the place
    /// among displacements, velocities and own states; where that is none of these, the row and the column are zero.
    #[must_use]
    pub fn of<const R: usize, const N: usize, const X: usize, const U: usize, const P: usize>(
        rates: &Derivatives<T, P, N, X, U, P>,
        motion: &Derivatives<T, R, N, X, U, P>,
        places: &[usize; W],
    ) -> Self {
        let entry = |row: usize, column: usize| match row.checked_sub(P) {
            None => rates.by_state(row, column),
            Some(row) => motion.by_state(row, column),
        };
        Self(places.map(|row| places.map(|column| entry(row, column).unwrap_or_else(|| T::lit(0.0)))))
    }
}

/// What a system's derivatives are written in, for a scalar `T`, displacements `Q` of the position, velocities `V` and own
/// states `X`: `[[T; W]; W]` with the velocities and own states alone, where velocities are the rates of coordinates and
/// `Q` is `V`, or [`FullJacobian`] with all three. There are no others.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no place for the derivatives of this system",
    note = "it is `[[T; W]; W]` where velocities are the rates of coordinates, and `FullJacobian<[[T; W]; W]>` for all others"
)]
pub trait JacobianMatrix<T: Real, Q, V, X>: Square<T> {
    /// What [`Differentiable::jacobian`] gives.
    type Jacobian: Copy;

    /// The equations of [`Radau`](crate::Radau), factored.
    #[doc(hidden)]
    type Radau: Matrices<T, Q, V, X, Self::Jacobian>;

    /// Whether displacements have rows and columns of their own.
    #[doc(hidden)]
    const FULL: bool;

    /// How the rate `row` of velocities and then own states changes with the component `column` of a displacement; zero
    /// outside of these.
    fn by_position(jacobian: &Self::Jacobian, row: usize, column: usize) -> T;

    /// How the rate `row` of velocities and then own states changes with the component `column` of these; zero outside.
    fn by_rates(jacobian: &Self::Jacobian, row: usize, column: usize) -> T;

    /// The same with what `position` and `rates` subtract for each row and column, counted as in [`JacobianMatrix::by_position`]
    /// and [`JacobianMatrix::by_rates`].
    #[must_use]
    fn less(
        jacobian: &Self::Jacobian,
        position: impl FnMut(usize, usize) -> T,
        rates: impl FnMut(usize, usize) -> T,
    ) -> Self::Jacobian;
}

impl<T: Real, V: Tangent<T>, X: Tangent<T>, const W: usize> JacobianMatrix<T, V, V, X> for [[T; W]; W] {
    type Jacobian = Jacobian<Self>;
    type Radau = Eliminated<T, Self>;
    const FULL: bool = false;

    #[inline]
    fn by_position(jacobian: &Jacobian<Self>, row: usize, column: usize) -> T {
        jacobian.position.get(row, column)
    }
    #[inline]
    fn by_rates(jacobian: &Jacobian<Self>, row: usize, column: usize) -> T {
        jacobian.rates.get(row, column)
    }
    fn less(
        jacobian: &Jacobian<Self>,
        mut position: impl FnMut(usize, usize) -> T,
        mut rates: impl FnMut(usize, usize) -> T,
    ) -> Jacobian<Self> {
        Jacobian {
            position: Square::from_fn(|i, j| jacobian.position.get(i, j) - position(i, j)),
            rates: Square::from_fn(|i, j| jacobian.rates.get(i, j) - rates(i, j)),
        }
    }
}

impl<T: Real, Q: Tangent<T>, V: Tangent<T>, X: Tangent<T>, M: Square<T>> JacobianMatrix<T, Q, V, X>
    for FullJacobian<M>
{
    type Jacobian = Self;
    type Radau = Entire<T, M>;
    const FULL: bool = true;

    #[inline]
    fn by_position(jacobian: &Self, row: usize, column: usize) -> T {
        let size = Q::zero().len();
        if column < size { jacobian.0.get(size.saturating_add(row), column) } else { T::lit(0.0) }
    }
    #[inline]
    fn by_rates(jacobian: &Self, row: usize, column: usize) -> T {
        let size = Q::zero().len();
        jacobian.0.get(size.saturating_add(row), size.saturating_add(column))
    }
    fn less(
        jacobian: &Self,
        mut position: impl FnMut(usize, usize) -> T,
        mut rates: impl FnMut(usize, usize) -> T,
    ) -> Self {
        let size = Q::zero().len();
        Self(M::from_fn(|i, j| {
            let entry = jacobian.0.get(i, j);
            match (i.checked_sub(size), j.checked_sub(size)) {
                (None, _) => entry,
                (Some(row), None) => entry - position(row, j),
                (Some(row), Some(column)) => entry - rates(row, column),
            }
        }))
    }
}

/// That of its entries.
impl<T: Real, M: Square<T>> Square<T> for FullJacobian<M> {
    const SIZE: usize = M::SIZE;
    type Vector = M::Vector;
    type Array<E: Copy> = M::Array<E>;
    type Factors = M::Factors;
    type ComplexFactors = M::ComplexFactors;

    #[inline]
    fn from_fn(entry: impl FnMut(usize, usize) -> T) -> Self {
        Self(M::from_fn(entry))
    }
    #[inline]
    fn vector(entry: impl FnMut(usize) -> T) -> M::Vector {
        M::vector(entry)
    }
    #[inline]
    fn array<E: Copy>(entry: impl FnMut(usize) -> E) -> M::Array<E> {
        M::array(entry)
    }
    #[inline]
    fn get(&self, row: usize, column: usize) -> T {
        self.0.get(row, column)
    }
    #[inline]
    fn solution(&self, b: &M::Vector) -> (M::Vector, T) {
        self.0.solution(b)
    }
    #[inline]
    fn times(&self, x: &M::Vector) -> M::Vector {
        self.0.times(x)
    }
    #[inline]
    fn factors(&self) -> M::Factors {
        self.0.factors()
    }
    #[inline]
    fn complex_factors(&self, imaginary: &Self) -> M::ComplexFactors {
        self.0.complex_factors(&imaginary.0)
    }
}

/// The derivatives of a system: [`Jacobian`] where velocities are the rates of coordinates, else [`FullJacobian`].
pub type JacobianOf<S> = <<S as Differentiable>::Matrix as JacobianMatrix<
    <S as System>::Scalar,
    DisplacementOf<S>,
    VelocityOf<S>,
    ExtraOf<S>,
>>::Jacobian;

/// A system whose [`slope`](System::slope) can be differentiated exactly.
///
/// Models with `emit derivatives` implement it. Write `W` for the number of velocities and own states together. With
/// `y = (v, x)` and `y' = f(q, y)`, implicit methods then need to solve `W` equations, not as many as there are
/// coordinates in all, since `q' = v`. Where velocities are not the rates of coordinates, `W` counts the components of a
/// displacement too, and derivatives are a [`FullJacobian`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no derivatives, which implicit methods and equilibria need",
    label = "this has to be `Differentiable`",
    note = "a model of `multibody!` is with `emit forward_dynamics, derivatives`"
)]
pub trait Differentiable: System {
    /// A matrix of `W` rows and columns, `[[T; W]; W]`, by rows; or [`FullJacobian`] around one.
    type Matrix: JacobianMatrix<Self::Scalar, DisplacementOf<Self>, VelocityOf<Self>, ExtraOf<Self>>;

    /// Derivatives of the rates of velocities and own states, at `t` `[s]`; in a [`FullJacobian`] of those of the position
    /// too.
    fn jacobian(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> JacobianOf<Self>;

    /// How the rates of velocities and own states change along a change of the inputs: the derivative by the inputs, times `change`.
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
    fn jacobian(&self, t: S::Scalar, state: &S::State, input: &S::Input) -> JacobianOf<S> {
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
