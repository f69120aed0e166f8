//! What a projection holds dear: [`Weighting`], of coordinates alike ([`Plain`]), by numbers ([`Weights`]) or by the mass
//! matrix ([`ByMass`]).

use super::{all, ones};
use crate::{Constrained, Impulsive, PositionOf, Real, Tangent, VelocityOf};

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

    /// The same by the same operations whatever the numbers, and without squares of the equations where there is a way.
    fn fixed_correction(
        &self,
        system: &S,
        t: S::Scalar,
        q: &PositionOf<S>,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.correction(system, t, q, residual)
    }
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
        let Some((d, rank)) = system.least_correction(t, q, residual) else {
            return self.fixed_correction(system, t, q, residual);
        };
        let equations = residual.fold(S::Scalar::lit(0.0), &mut |count, _| count + S::Scalar::lit(1.0));
        let full = Real::le(equations, rank);
        if all(full) {
            return (d, rank);
        }
        let (other, least) = self.fixed_correction(system, t, q, residual);
        (d.zip(&other, &mut |d, other| Real::select(full, d, other)), Real::select(full, rank, least))
    }

    #[inline]
    fn fixed_correction(
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
