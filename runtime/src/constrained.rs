//! What projection and assembly see of a model whose coordinates obey equations: [`Constrained`], and what
//! `emit kinematics` gives: [`Kinematics`].

use crate::{DisplacementOf, PositionOf, Real, StateSpace, System, Tangent, VelocityOf};
use nalgebra::SVector;

/// A system whose position has to satisfy `Phi(t, q) = 0`, and its velocity `G v + dPhi/dt = 0` with `G = dPhi/dq`.
///
/// Where velocities `u` are not the rates of coordinates, `G v` is `G q'` with `q' = N u + n` here: it is linear in them, too.
/// Equations of positions are then closed by displacements, and their rates by velocities, each with functions of its own.
///
/// Generated models with loops that are not reduced implement it. Written by hand, for a bead on a vertical ring, whose
/// force of constraint is part of its equations:
///
/// ```
/// use multibody::{Constrained, StateSpace, System, linear::least_norm, nalgebra::{Vector1, Vector2}};
///
/// #[derive(Clone, Copy)]
/// struct State { q: Vector2<f64>, v: Vector2<f64> }
///
/// impl StateSpace for State {
///     type Scalar = f64;
///     type Position = Vector2<f64>;
///     type Velocity = Vector2<f64>;
///     type Extra = ();
///     fn split(&self) -> (Vector2<f64>, Vector2<f64>, ()) { (self.q, self.v, ()) }
///     fn join(&self, q: Vector2<f64>, v: Vector2<f64>, (): ()) -> Self { Self { q, v } }
/// }
///
/// struct Bead;
///
/// impl System for Bead {
///     type Scalar = f64;
///     type State = State;
///     type Input = ();
///     fn derivative(&self, _t: f64, state: &State, (): &()) -> (Vector2<f64>, ()) {
///         let gravity = Vector2::new(0.0, -9.81);
///         let pull = (gravity.dot(&state.q) + state.v.norm_squared()) / state.q.norm_squared();
///         (gravity - state.q * pull, ())
///     }
///     fn position_rates(&self, _t: f64, state: &State) -> Vector2<f64> { state.v }
/// }
///
/// impl Constrained for Bead {
///     type Residual = f64;
///     fn constraints(&self, _t: f64, q: &Vector2<f64>) -> f64 { 0.5 * (q.norm_squared() - 1.0) }
///     fn constraint_rate(&self, _t: f64, state: &State) -> f64 { state.q.dot(&state.v) }
///     fn correction(&self, _t: f64, state: &State, residual: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
///         least_norm(&state.q.transpose(), &Vector1::new(*residual), weights)
///     }
///     fn velocity_correction(&self, t: f64, state: &State, residual: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
///         self.correction(t, state, residual, weights)
///     }
///     fn constraints_along(&self, t: f64, state: &State, d: &Vector2<f64>) -> f64 { self.constraint_rate_along(t, state, d) }
/// }
///
/// let state = State { q: Vector2::new(2.0, 0.0), v: Vector2::zeros() };
/// let (d, rank) = Bead.correction(0.0, &state, &0.5, &Vector2::new(1.0, 1.0));
/// assert_eq!((d, rank), (Vector2::new(0.25, 0.0), 1.0));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraint equations to project on",
    label = "this has to be `Constrained`",
    note = "a model of `multibody!` with loops is, with `emit forward_dynamics` and `formulation {{ constraints: Multipliers }}`; one that is `Reduced`, or has no loops, needs no projection"
)]
pub trait Constrained: System {
    /// One component for each equation.
    type Residual: Tangent<Self::Scalar>;

    /// `Phi(t, q)`, zero where the loops are closed. Each component has the unit of its equation, m or rad. That of an equation of
    /// velocities is always zero.
    fn constraints(&self, t: Self::Scalar, q: &PositionOf<Self>) -> Self::Residual;

    /// `G v + dPhi/dt`: the rate of [`Constrained::constraints`] along a motion, and the left side of equations of velocities.
    fn constraint_rate(&self, t: Self::Scalar, state: &Self::State) -> Self::Residual;

    /// Whether a fall of the equations' rank says that motions cross there. It doesn't where equations follow from others
    /// wherever the loops are closed, and are independent beside that, such as those of a third parallel bar whose length is a
    /// parameter: they come to depend on each other at the end of every step. Generated models know.
    fn tells_crossings(&self) -> bool {
        true
    }

    /// The displacement `d` with `G d = residual` for which the sum of `d^2 / weight` is least, and the rank of the
    /// equations. A coordinate of weight zero is held.
    ///
    /// Equations that depend on others at this position are left out, so the displacement is always finite where `G`
    /// is. [`least_norm`](crate::linear::least_norm) is all that it takes; where an equation may vanish in some pose,
    /// [`least_norm_in_groups`](crate::linear::least_norm_in_groups), as in generated models.
    fn correction(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        residual: &Self::Residual,
        weights: &DisplacementOf<Self>,
    ) -> (DisplacementOf<Self>, Self::Scalar);

    /// The change `d` of the velocities that changes [`Constrained::constraint_rate`] by `residual`, for which the sum of
    /// `d^2 / weight` is least, and the rank of the equations for velocities. A velocity of weight zero is held. All that is
    /// said of [`Constrained::correction`] holds for it.
    ///
    /// Where velocities are the rates of coordinates it is `self.correction(t, state, residual, weights)`.
    fn velocity_correction(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        residual: &Self::Residual,
        weights: &VelocityOf<Self>,
    ) -> (VelocityOf<Self>, Self::Scalar);

    /// `G d`: how [`Constrained::constraints`] change along a displacement of the position, to first order.
    ///
    /// Where velocities are the rates of coordinates it is `self.constraint_rate_along(t, state, d)`.
    fn constraints_along(&self, t: Self::Scalar, state: &Self::State, d: &DisplacementOf<Self>) -> Self::Residual;

    /// How [`Constrained::constraint_rate`] changes with a change `d` of the velocities, in which it is linear.
    #[inline]
    fn constraint_rate_along(&self, t: Self::Scalar, state: &Self::State, d: &VelocityOf<Self>) -> Self::Residual {
        let (q, _, x) = state.split();
        let rate = |v: VelocityOf<Self>| self.constraint_rate(t, &state.join(q, v, x));
        rate(*d).add_scaled(Self::Scalar::lit(-1.0), &rate(Tangent::zero()))
    }

    /// [`Constrained::correction`] with weights of one by the zeros of `G`, if there is a faster way by them: generated models with
    /// large systems have one. It forms squares of `G`, so equations count as dependent already where they differ by less than
    /// 3e-7, and twice as many digits are lost near that; where the rank is short, `correction` has to be asked.
    fn least_correction(
        &self,
        _t: Self::Scalar,
        _state: &Self::State,
        _residual: &Self::Residual,
    ) -> Option<(DisplacementOf<Self>, Self::Scalar)> {
        None
    }

    /// [`Constrained::velocity_correction`] with weights of one, in the same way.
    fn least_velocity_correction(
        &self,
        _t: Self::Scalar,
        _state: &Self::State,
        _residual: &Self::Residual,
    ) -> Option<(VelocityOf<Self>, Self::Scalar)> {
        None
    }
}

impl<S: Constrained + ?Sized> Constrained for &S {
    type Residual = S::Residual;

    #[inline]
    fn constraints(&self, t: S::Scalar, q: &PositionOf<S>) -> S::Residual {
        (**self).constraints(t, q)
    }
    #[inline]
    fn constraint_rate(&self, t: S::Scalar, state: &S::State) -> S::Residual {
        (**self).constraint_rate(t, state)
    }
    #[inline]
    fn tells_crossings(&self) -> bool {
        (**self).tells_crossings()
    }
    #[inline]
    fn correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &DisplacementOf<S>,
    ) -> (DisplacementOf<S>, S::Scalar) {
        (**self).correction(t, state, residual, weights)
    }
    #[inline]
    fn velocity_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
        weights: &VelocityOf<S>,
    ) -> (VelocityOf<S>, S::Scalar) {
        (**self).velocity_correction(t, state, residual, weights)
    }
    #[inline]
    fn constraints_along(&self, t: S::Scalar, state: &S::State, d: &DisplacementOf<S>) -> S::Residual {
        (**self).constraints_along(t, state, d)
    }
    #[inline]
    fn constraint_rate_along(&self, t: S::Scalar, state: &S::State, d: &VelocityOf<S>) -> S::Residual {
        (**self).constraint_rate_along(t, state, d)
    }
    #[inline]
    fn least_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> Option<(DisplacementOf<S>, S::Scalar)> {
        (**self).least_correction(t, state, residual)
    }
    #[inline]
    fn least_velocity_correction(
        &self,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> Option<(VelocityOf<S>, S::Scalar)> {
        (**self).least_velocity_correction(t, state, residual)
    }
}

/// Coordinates that follow from others, with their rates: what `emit kinematics` gives.
///
/// The components stand in the order in which `find` names them; each has the unit of its coordinate.
///
/// ```
/// use multibody::{Kinematics, nalgebra::SVector};
///
/// let found = Kinematics {
///     position: SVector::from([0.1, 0.2]),
///     velocity: SVector::from([0.0; 2]),
///     acceleration: SVector::from([0.0; 2]),
///     residual: 0.0,
/// };
/// assert_eq!(found.position[1], 0.2);
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics<T, const N: usize> {
    /// `[m]` or `[rad]`
    pub position: SVector<T, N>,
    /// `[m/s]` or `[rad/s]`
    pub velocity: SVector<T, N>,
    /// `[m/s^2]` or `[rad/s^2]`
    pub acceleration: SVector<T, N>,
    /// `[m]` or `[1]`: the greatest of what Newton's method has left of the equations that it solves, after its last round. It
    /// has converged where this is rounding; from far away it may not have. Zero where all is in closed form.
    pub residual: T,
}
