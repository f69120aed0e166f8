//! What a projection holds dear: [`Weighting`], of coordinates alike ([`Plain`]), by numbers ([`Weights`],
//! [`SeparateWeights`]) or by the mass matrix ([`ByMass`]).

use super::{all, ones};
use crate::system::displacement_by;
use crate::{Constrained, DisplacementOf, Impulsive, Real, SecondOrder, Tangent, VelocityOf};

/// Which of all displacements that satisfy the constraints, and which of all changes of velocities, counts as the least.
pub trait Weighting<S: Constrained>: Copy {
    /// The least displacement `d` with `G d = residual` at the position of `state`, and the rank of the equations.
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar);

    /// The least change of the velocities that changes the constraints' rate by `residual`, and the rank of the equations.
    fn velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar);

    /// [`Weighting::correction`] by the same operations whatever the numbers, and without squares of the equations where
    /// there is a way.
    fn fixed_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        self.correction(system, t, state, residual)
    }

    /// [`Weighting::velocity_correction`] in the same way.
    fn fixed_velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        self.velocity_correction(system, t, state, residual)
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
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        let fixed = || self.fixed_correction(system, t, state, residual);
        of_full_rank(system.least_correction(t, state, residual), residual, fixed)
    }

    #[inline]
    fn velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        let fixed = || self.fixed_velocity_correction(system, t, state, residual);
        of_full_rank(system.least_velocity_correction(t, state, residual), residual, fixed)
    }

    #[inline]
    fn fixed_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        system.correction(t, state, residual, &ones())
    }

    #[inline]
    fn fixed_velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.velocity_correction(t, state, residual, &ones())
    }
}

/// What the faster way has found, where there is one and the equations are independent; else what the other one gives.
#[inline]
fn of_full_rank<T: Real, V: Tangent<T>>(
    found: Option<(V, T)>,
    residual: &impl Tangent<T>,
    fixed: impl FnOnce() -> (V, T),
) -> (V, T) {
    let Some((d, rank)) = found else { return fixed() };
    let equations = residual.fold(T::lit(0.0), &mut |count, _| count + T::lit(1.0));
    let full = Real::le(equations, rank);
    if all(full) {
        return (d, rank);
    }
    let (other, least) = fixed();
    (d.zip(&other, &mut |d, other| Real::select(full, d, other)), Real::select(full, rank, least))
}

/// The least sum of `d^2 / weight`, of displacements and of velocities, which are of one type here; a coordinate of weight
/// zero is held. Where they are not, take [`SeparateWeights`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights<V>(pub V);

impl<S: Constrained + SecondOrder> Weighting<S> for Weights<VelocityOf<S>> {
    #[inline]
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        system.correction(t, state, residual, &S::as_displacement(self.0))
    }

    #[inline]
    fn velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.velocity_correction(t, state, residual, &self.0)
    }
}

/// The least sum of `d^2 / weight`, with weights for displacements of the position and others for changes of the
/// velocities; what has weight zero is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeparateWeights<Q, V> {
    /// Of displacements.
    pub position: Q,
    /// Of velocities.
    pub velocity: V,
}

impl<S: Constrained> Weighting<S> for SeparateWeights<DisplacementOf<S>, VelocityOf<S>> {
    #[inline]
    fn correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        system.correction(t, state, residual, &self.position)
    }

    #[inline]
    fn velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.velocity_correction(t, state, residual, &self.velocity)
    }
}

/// The least `d^T M d` with the mass matrix `M`: what forces of constraint would do, whatever the units and the choice of
/// coordinates. A velocity loses the least kinetic energy that it can. Positions are displaced as velocities displace them,
/// so where these are fewer than coordinates, what no velocity closes stays open.
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
        state: &S::State,
        residual: &S::Residual,
    ) -> (DisplacementOf<S>, S::Scalar) {
        let (d, rank) = self.velocity_correction(system, t, state, residual);
        (displacement_by(system, t, state, &d), rank)
    }

    #[inline]
    fn velocity_correction(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        residual: &S::Residual,
    ) -> (VelocityOf<S>, S::Scalar) {
        system.jump(t, state, &VelocityOf::<S>::zero(), residual)
    }
}
