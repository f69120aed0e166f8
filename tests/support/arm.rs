//! The generated arms behind one trait, over slices, so that one test serves all of them and every scalar.

use multibody::nalgebra::{SMatrix, SVector};
use multibody::{Derivatives, Real};

use crate::models::arms;

/// A generated arm and its twin with an input for the effort of every joint.
pub trait Arm<T: Real> {
    /// Of the data in `data/robots`.
    const NAME: &'static str;
    /// With the declared values.
    fn new() -> Self;
    /// Efforts for these positions, velocities and accelerations.
    fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T>;
    /// Efforts without acceleration.
    fn bias(&self, q: &[T], v: &[T]) -> Vec<T>;
    /// Row by row.
    fn mass_matrix(&self, q: &[T]) -> Vec<T>;
    /// Accelerations without efforts.
    fn free_dynamics(&self, q: &[T], v: &[T]) -> Vec<T>;
    /// Accelerations under these efforts.
    fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T]) -> Vec<T>;
    /// Derivatives of the accelerations under these efforts.
    fn forward_derivatives(&self, q: &[T], v: &[T], tau: &[T]) -> Slopes<T>;
    /// Derivatives of the efforts for these accelerations.
    fn inverse_derivatives(&self, q: &[T], v: &[T], a: &[T]) -> Slopes<T>;
    /// `[J]`
    fn kinetic_energy(&self, q: &[T], v: &[T]) -> T;
    /// `[J]`
    fn potential_energy(&self, q: &[T]) -> T;
    /// Of the tool frame.
    fn tool(&self, q: &[T], v: &[T]) -> Tool<T>;
}

/// Partial derivatives, row by row.
pub struct Slopes<T> {
    /// By positions.
    pub position: Vec<T>,
    /// By velocities.
    pub velocity: Vec<T>,
    /// By efforts.
    pub input: Vec<T>,
}

impl<T: Real> Slopes<T> {
    fn of<const R: usize, const N: usize, const U: usize>(derivatives: &Derivatives<T, R, N, 0, U>) -> Self {
        Self {
            position: rows(&derivatives.position),
            velocity: rows(&derivatives.velocity),
            input: rows(&derivatives.input),
        }
    }
}

/// What the outputs say about the tool frame.
pub struct Tool<T> {
    /// `[m]`
    pub position: Vec<T>,
    /// w, i, j, k
    pub quaternion: Vec<T>,
    /// The pose's orientation as a matrix, row by row.
    pub orientation: Vec<T>,
    /// The output of type `Rotation`, row by row.
    pub rotation: Vec<T>,
    /// Six rows.
    pub jacobian: Vec<T>,
    /// Linear, then angular velocity.
    pub twist: Vec<T>,
}

fn rows<T: Real, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>) -> Vec<T> {
    (0..R).flat_map(|i| (0..C).map(move |j| (i, j))).map(|at| matrix[at]).collect()
}

fn list<T: Real, const N: usize>(vector: impl Into<SVector<T, N>>) -> Vec<T> {
    vector.into().iter().copied().collect()
}

fn vector<T: Real, const N: usize>(list: &[T]) -> SVector<T, N> {
    assert_eq!(list.len(), N);
    SVector::from_fn(|k, _| list[k])
}

/// The matrix of a unit quaternion w, i, j, k, row by row.
fn matrix<T: Real>(q: &[T]) -> Vec<T> {
    let (w, i, j, k) = (q[0], q[1], q[2], q[3]);
    let two = T::lit(2.0);
    let one = T::lit(1.0);
    let rows = [
        [one - two * (j * j + k * k), two * (i * j - w * k), two * (i * k + w * j)],
        [two * (i * j + w * k), one - two * (i * i + k * k), two * (j * k - w * i)],
        [two * (i * k - w * j), two * (j * k + w * i), one - two * (i * i + j * j)],
    ];
    rows.concat()
}

macro_rules! arm {
    ($name:ident of $data:literal: $module:ident, $driven:ident, [$($tau:ident)*]) => {
        #[doc = concat!("The models `", stringify!($module), "` and `", stringify!($driven), "`.")]
        pub struct $name<T: Real>(arms::$module::Model<T>, arms::$driven::Model<T>);

        impl<T: Real> Arm<T> for $name<T> {
            const NAME: &'static str = $data;

            fn new() -> Self {
                let free = arms::$module::Model::new(&arms::$module::Params::default());
                Self(free, arms::$driven::Model::new(&arms::$driven::Params::default()))
            }

            fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T> {
                let state = arms::$module::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                list(self.0.inverse_dynamics(T::lit(0.0), &state, &(), &vector::<T, { arms::$module::DOF }>(a).into()))
            }

            fn bias(&self, q: &[T], v: &[T]) -> Vec<T> {
                let state = arms::$module::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                list(self.0.bias(T::lit(0.0), &state, &()))
            }

            fn mass_matrix(&self, q: &[T]) -> Vec<T> {
                rows(&self.0.mass_matrix(&vector::<T, { arms::$module::DOF }>(q).into()))
            }

            fn free_dynamics(&self, q: &[T], v: &[T]) -> Vec<T> {
                let state = arms::$module::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                list(self.0.forward_dynamics(T::lit(0.0), &state, &()))
            }

            fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T]) -> Vec<T> {
                let state = arms::$driven::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                let [$($tau),*] = *tau else { panic!("not one effort per joint") };
                list(self.1.forward_dynamics(T::lit(0.0), &state, &arms::$driven::Input { $($tau),* }))
            }

            fn forward_derivatives(&self, q: &[T], v: &[T], tau: &[T]) -> Slopes<T> {
                let state = arms::$driven::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                let [$($tau),*] = *tau else { panic!("not one effort per joint") };
                Slopes::of(&self.1.forward_derivatives(T::lit(0.0), &state, &arms::$driven::Input { $($tau),* }))
            }

            fn inverse_derivatives(&self, q: &[T], v: &[T], a: &[T]) -> Slopes<T> {
                let state = arms::$driven::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                let accel = vector::<T, { arms::$module::DOF }>(a).into();
                Slopes::of(&self.1.inverse_derivatives(T::lit(0.0), &state, &arms::$driven::Input::default(), &accel))
            }

            fn kinetic_energy(&self, q: &[T], v: &[T]) -> T {
                self.0.kinetic_energy(&arms::$module::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() })
            }

            fn potential_energy(&self, q: &[T]) -> T {
                self.0.potential_energy(&vector::<T, { arms::$module::DOF }>(q).into())
            }

            fn tool(&self, q: &[T], v: &[T]) -> Tool<T> {
                let state = arms::$module::State { q: vector::<T, { arms::$module::DOF }>(q).into(), v: vector::<T, { arms::$module::DOF }>(v).into() };
                let output = self.0.outputs(T::lit(0.0), &state, &());
                let coords = output.pose.orientation.into_inner().coords;
                let quaternion = vec![coords.w, coords.x, coords.y, coords.z];
                Tool {
                    position: list(output.pose.position),
                    orientation: matrix(&quaternion),
                    quaternion,
                    rotation: rows(output.rotation.matrix()),
                    jacobian: rows(&output.jacobian),
                    twist: [list(output.twist.linear), list(output.twist.angular)].concat(),
                }
            }
        }
    };
}

arm!(DoublePendulum of "double_pendulum": double_pendulum, double_pendulum_driven, [tau1 tau2]);
arm!(DoublePendulumParams of "double_pendulum": double_pendulum_params, double_pendulum_driven_params, [tau1 tau2]);
arm!(Cart5 of "cart5": cart5, cart5_driven, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(Cart5Params of "cart5": cart5_params, cart5_driven_params, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(Puma560 of "puma560": puma560, puma560_driven, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(Puma560Params of "puma560": puma560_params, puma560_driven_params, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(Panda of "panda": panda, panda_driven, [tau1 tau2 tau3 tau4 tau5 tau6 tau7]);
arm!(PandaParams of "panda": panda_params, panda_driven_params, [tau1 tau2 tau3 tau4 tau5 tau6 tau7]);
