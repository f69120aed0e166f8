//! How well the functions of a generated model agree: [`verify`].
//!
//! In: a model with `inverse_dynamics`, `forward_dynamics`, `mass_matrix` and `energy`, and a state. Out: an
//! [`Agreement`]. Nothing here knows a formula of mechanics but M a + bias = effort and 2 T = v M v, so a model whose
//! functions agree is either right, or wrong in what all of them share: the declaration.

use crate::{Real, StateSpace, System, Tangent};
use nalgebra::{SMatrix, SVector};

/// A generated model whose functions can be compared.
///
/// Models implement it that `emit forward_dynamics, inverse_dynamics, mass_matrix, energy`, without `solve_for`. `N` is the
/// number of their coordinates.
#[diagnostic::on_unimplemented(
    message = "`{Self}` lacks functions that `verify` compares",
    label = "this has to be a `multibody::Verifiable`",
    note = "a model of `multibody!` is one with `emit forward_dynamics, inverse_dynamics, mass_matrix, energy` and without `solve_for`; the model itself is to be passed, `&Model<T>` and not its module or its parameters"
)]
pub trait Verifiable<const N: usize>: System {
    /// Accelerations of free motion, and the efforts with which equations that keep a multiplier hold the coordinates.
    fn free_motion(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
    ) -> (SVector<Self::Scalar, N>, SVector<Self::Scalar, N>);

    /// Efforts that these accelerations need beside all declared forces.
    fn efforts(
        &self,
        t: Self::Scalar,
        state: &Self::State,
        input: &Self::Input,
        accelerations: &SVector<Self::Scalar, N>,
    ) -> SVector<Self::Scalar, N>;

    /// The mass matrix.
    fn inertia(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> SMatrix<Self::Scalar, N, N>;

    /// The kinetic energy.
    fn kinetic(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input) -> Self::Scalar;
}

/// What is left where functions should agree, each relative to the terms that it is the difference of: a few roundings of
/// the scalar where all is well. NaN where a function has no finite value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement<T> {
    /// Of `inverse_dynamics` at the accelerations that `forward_dynamics` gives, with what multipliers do: free motion needs no
    /// effort.
    pub free_motion: T,
    /// Of `inverse_dynamics` at these accelerations less the same at none, against `mass_matrix`.
    pub inertia: T,
    /// Of `T(v) + T(-v) - 2 T(0)` against `v M v`: kinetic energy and mass matrix.
    pub kinetic_energy: T,
    /// Of `mass_matrix` against its transpose.
    pub symmetry: T,
}

impl<T: Real> Agreement<T> {
    /// The greatest of all; NaN if any is.
    pub fn worst(&self) -> T {
        let list = [self.free_motion, self.inertia, self.kinetic_energy, self.symmetry];
        list.into_iter().fold(T::lit(0.0), greater)
    }
}

/// Compares the functions of a model with each other, at time zero and without inputs.
///
/// ```
/// use multibody::{multibody, verify};
///
/// multibody! {
///     pub mod arm {
///         world { gravity: -9.81 * Z }
///         body upper { mass: 1.0, com: 0.5 * X, inertia: diag(0.01, 0.1, 0.1) }
///         body lower { mass: 0.7, com: 0.4 * X, inertia: diag(0.01, 0.05, 0.05) }
///         joint shoulder: Revolute { parent: ground, child: upper, axis: [1, 0, 1] }
///         joint elbow: Revolute { parent: upper.at(X).rotated([1, 1, 1], deg(60)), child: lower, axis: [0, 1, 1] }
///         emit forward_dynamics, inverse_dynamics, mass_matrix, energy;
///     }
/// }
///
/// let model = arm::Model::<f64>::default();
/// let mut state = arm::State::default();
/// (state.q.shoulder, state.q.elbow) = (0.3, -1.1);
/// (state.v.shoulder, state.v.elbow) = (2.0, 0.7);
/// assert!(verify(&model, &state).worst() < 1e-13);
/// ```
pub fn verify<S: Verifiable<N>, const N: usize>(model: &S, state: &S::State) -> Agreement<S::Scalar>
where
    S::Input: Default,
{
    verify_at(model, Real::lit(0.0), state, &S::Input::default())
}

/// The same at the time `t`, with inputs.
pub fn verify_at<S: Verifiable<N>, const N: usize>(
    model: &S,
    t: S::Scalar,
    state: &S::State,
    input: &S::Input,
) -> Agreement<S::Scalar> {
    let zero = S::Scalar::lit(0.0);
    let (accelerations, held) = model.free_motion(t, state, input);
    let mass = model.inertia(t, state, input);
    let efforts = model.efforts(t, state, input, &accelerations);
    let bias = model.efforts(t, state, input, &SVector::from([zero; N]));
    let (mut free, mut inertia) = (Difference::new(), Difference::new());
    let mut symmetry = Difference::new();
    for i in 0..N {
        let (mut product, mut size) = (zero, zero);
        for j in 0..N {
            let term = mass[(i, j)] * accelerations[j];
            product += term;
            size += Real::abs(term);
            let other = Real::sqrt(Real::abs(mass[(i, i)] * mass[(j, j)]));
            symmetry.take(mass[(i, j)] - mass[(j, i)], other);
        }
        let size = size + Real::abs(bias[i]);
        free.take(efforts[i] + held[i], size + Real::abs(held[i]));
        inertia.take(efforts[i] - bias[i] - product, size);
    }
    let (q, v, x) = state.split();
    let mut components = [zero; N];
    Tangent::fold(&v, 0, &mut |at, x| {
        if let Some(component) = components.get_mut(at) {
            *component = x;
        }
        at + 1
    });
    let energy = |factor: f64| model.kinetic(t, &state.join(q, v.scale(S::Scalar::lit(factor)), x), input);
    let (ahead, back, rest) = (energy(1.0), energy(-1.0), energy(0.0));
    let (mut product, mut size) = (zero, Real::abs(ahead) + Real::abs(back) + Real::abs(rest));
    for i in 0..N {
        for j in 0..N {
            let term = components[i] * mass[(i, j)] * components[j];
            product += term;
            size += Real::abs(term);
        }
    }
    let mut kinetic = Difference::new();
    kinetic.take(ahead + back - rest - rest - product, size);
    Agreement {
        free_motion: free.relative(),
        inertia: inertia.relative(),
        kinetic_energy: kinetic.relative(),
        symmetry: symmetry.relative(),
    }
}

/// The greatest difference and the greatest of what differs.
struct Difference<T> {
    left: T,
    size: T,
}

impl<T: Real> Difference<T> {
    fn new() -> Self {
        Self { left: T::lit(0.0), size: T::lit(0.0) }
    }

    fn take(&mut self, left: T, size: T) {
        self.left = greater(self.left, Real::abs(left));
        self.size = greater(self.size, size);
    }

    /// Zero where there is nothing to differ.
    fn relative(&self) -> T {
        let zero = T::lit(0.0);
        let none = Real::eq(self.size, zero);
        Real::select(none, self.left, self.left / Real::select(none, T::lit(1.0), self.size))
    }
}

/// The greater of two; NaN if one is.
fn greater<T: Real>(a: T, b: T) -> T {
    Real::select(Real::lt(a, b), b, a) + crate::linear::residue(b) + crate::linear::residue(a)
}
