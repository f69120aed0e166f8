//! What a projection holds dear: [`Weighting`], of coordinates alike ([`Plain`]), by numbers ([`Weights`]) or by the mass
//! matrix ([`ByMass`]).

use super::ones;
use crate::{Constrained, Impulsive, PositionOf, Tangent, VelocityOf};

/// Which of all displacements that satisfy the constraints counts as the least.
pub trait Weighting<S: Constrained>: Copy {
    /// The least displacement `d` with `G d = residual`, and the rank of the equations.
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar);
}

/// The least sum of squares, of metres and radians alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plain;

impl<S: Constrained> Weighting<S> for Plain {
    #[inline]
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.correction(t, q, residual, &ones())
    }
}

/// The least sum of `d^2 / weight`; a coordinate of weight zero is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights<V>(pub V);

impl<S: Constrained> Weighting<S> for Weights<VelocityOf<S>> {
    #[inline]
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.correction(t, q, residual, &self.0)
    }
}

/// The least `d^T M d` with the mass matrix `M`: what forces of constraint would do, whatever the units and the choice of
/// coordinates. A velocity loses the least kinetic energy that it can.
///
/// It costs as much as accelerations do. [`Impulsive`] squares the Jacobian of the constraints, so equations count as
/// dependent already where they differ by less than 3e-7.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByMass;

impl<S: Constrained + Impulsive<Rates = <S as Constrained>::Residual>> Weighting<S> for ByMass {
    #[inline]
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.jump(t, q, &VelocityOf::<S>::zero(), residual)
    }
}
