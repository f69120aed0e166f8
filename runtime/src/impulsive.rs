//! How velocities answer to impulses: [`Impulsive`].

use crate::{System, Tangent, VelocityOf};

/// A system that tells the jump of its velocities under an impulse, consistent with its constraints.
///
/// Models with `emit impulse` implement it. With the mass matrix `M` and, where equations between coordinates are kept,
/// their Jacobian `G`, the jump `d` solves
///
/// ```text
/// M d + G^T mu = impulse
/// G d          = rates
/// ```
///
/// Where velocities are not the rates of coordinates, `M` is the mass matrix and an impulse the generalised one of these
/// velocities (times them it is power), and `G` says how they change the rates of the equations.
///
/// Impacts take an impulse and no rates; a projection weighted by mass, or a stabilised acceleration, takes rates and no
/// impulse.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not tell what an impulse does",
    label = "this has to be `Impulsive`",
    note = "a model of `multibody!` is with `emit forward_dynamics, impulse`"
)]
pub trait Impulsive: System {
    /// One component for each equation between coordinates that is kept; `()` where there is none. It is the `Residual`
    /// of [`Constrained`](crate::Constrained) for systems that are constrained.
    type Rates: Tangent<Self::Scalar>;

    /// The jump of the velocities, and the rank of the constraints at this position (zero where there are none).
    ///
    /// `impulse` has the components of efforts, times seconds: `[N s]` or `[N m s]`.
    fn jump(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        impulse: &VelocityOf<Self>,
        rates: &Self::Rates,
    ) -> (VelocityOf<Self>, Self::Scalar);
}

impl<S: Impulsive + ?Sized> Impulsive for &S {
    type Rates = S::Rates;

    #[inline]
    fn jump(
        &self,
        t: S::Scalar,
        state: &S::State,
        impulse: &VelocityOf<S>,
        rates: &S::Rates,
    ) -> (VelocityOf<S>, S::Scalar) {
        (**self).jump(t, state, impulse, rates)
    }
}
