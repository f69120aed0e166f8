//! [`Linearization`]: what `emit linearize` gives.

use nalgebra::SMatrix;

/// Equations and outputs linearised at a state and input: `x' = A x + B u`, `y = C x + D u` for small changes.
///
/// The `X` components of `x` are the displacement of the position, the velocities and the own states, each in the order of
/// its struct's fields; a rotation is displaced by the angles about its own axes (rad), all else by the coordinate itself.
/// The `U` components of `u` are the scalars of `Input`, the `Y` components of `y` those of `Output`, both flat: vectors by
/// component, matrices row by row, arrays element by element.
///
/// At a state that is no equilibrium the matrices are those of the motion beside the one through that state.
/// [`trim`](crate::trim) finds equilibria.
///
/// Where loops are held by multipliers all coordinates of the state are changed independently: only changes that keep the
/// loops closed are motions of the mechanism. With `constraints: Reduced` there are no others.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearization<T, const X: usize, const U: usize, const Y: usize> {
    /// Of the rates of `x` by `x`, in 1/s and products of the coordinates' units.
    pub a: SMatrix<T, X, X>,
    /// Of the rates of `x` by inputs.
    pub b: SMatrix<T, X, U>,
    /// Of outputs by `x`.
    pub c: SMatrix<T, Y, X>,
    /// Of outputs by inputs.
    pub d: SMatrix<T, Y, U>,
}
