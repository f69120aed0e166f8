//! The serial arms of the tests behind one trait, with a state to evaluate them at, and their data as text.

#[path = "../tests/models/arms.rs"]
pub mod arms;

use multibody::Real;
use multibody::nalgebra::SVector;
use multibody::simba::simd::{WideF32x8, WideF64x4};

/// A scalar made of one or several numbers.
pub trait Lanes: Real {
    /// The lanes' values by their number.
    fn fill(value: impl Fn(usize) -> f64) -> Self;
}

macro_rules! lanes {
    ($($scalar:ty, $element:ty, $count:literal;)*) => {
        $(
            impl Lanes for $scalar {
                fn fill(value: impl Fn(usize) -> f64) -> Self {
                    let values: [$element; $count] = std::array::from_fn(|lane| value(lane) as $element);
                    values.into()
                }
            }
        )*
    };
}

lanes! { WideF64x4, f64, 4; WideF32x8, f32, 8; }

impl Lanes for f64 {
    fn fill(value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }
}

impl Lanes for f32 {
    fn fill(value: impl Fn(usize) -> f64) -> Self {
        value(0) as f32
    }
}

/// Number `kind` of a point's vectors: positions, velocities, accelerations, efforts, different in every lane.
///
/// Positions lie between 0.9 and 1.15 rad, so that the platform's sine takes the same way for an angle as for the sum of
/// two, and instruction counts compare the models alone.
pub fn sample<T: Lanes, const N: usize>(kind: usize) -> SVector<T, N> {
    SVector::from_fn(|row, _| {
        T::fill(|lane| {
            let seed = 1.0 + (kind * 61 + row * 17 + lane * 5) as f64;
            let share = (seed * 0.754_877_666).fract();
            if kind == 0 { 0.9 + 0.25 * share } else { 2.4 * share - 1.2 }
        })
    })
}

/// A module for each arm: a point in its types, its functions, and the same point for what takes plain vectors.
macro_rules! arm {
    ($name:ident, $driven:ident, $dof:literal, [$($tau:ident)*]) => {
        pub mod $name {
            use super::arms::{$driven, $name};
            use super::{Lanes, sample};

            pub const DOF: usize = $dof;
            pub const DATA: &str = include_str!(concat!("../tests/data/robots/", stringify!($name), ".model.json"));

            /// Everything that the functions take.
            #[derive(Clone, Copy)]
            pub struct Point<T: Lanes> {
                pub model: $name::Model<T>,
                pub state: $name::State<T>,
                pub accel: $name::Velocity<T>,
                pub driven: $driven::Model<T>,
                pub driven_state: $driven::State<T>,
                pub input: $driven::Input<T>,
            }

            pub fn point<T: Lanes>() -> Point<T> {
                let (q, v) = (sample::<T, DOF>(0), sample::<T, DOF>(1));
                let [[$($tau),*]] = sample::<T, DOF>(3).data.0;
                Point {
                    model: $name::Model::default(),
                    state: $name::State { q: q.into(), v: v.into() },
                    accel: sample::<T, DOF>(2).into(),
                    driven: $driven::Model::default(),
                    driven_state: $driven::State { q: q.into(), v: v.into() },
                    input: $driven::Input { $($tau),* },
                }
            }

            #[inline(never)]
            pub fn inverse_dynamics<T: Lanes>(p: &Point<T>) -> $name::Velocity<T> {
                p.model.inverse_dynamics(T::lit(0.0), &p.state, &(), &p.accel)
            }

            #[inline(never)]
            pub fn mass_matrix<T: Lanes>(p: &Point<T>) -> multibody::nalgebra::SMatrix<T, DOF, DOF> {
                p.model.mass_matrix(&p.state.q)
            }

            #[inline(never)]
            pub fn forward_dynamics<T: Lanes>(p: &Point<T>) -> $driven::Velocity<T> {
                p.driven.forward_dynamics(T::lit(0.0), &p.driven_state, &p.input)
            }
        }
    };
}

arm!(double_pendulum, double_pendulum_driven, 2, [tau1 tau2]);
arm!(cart5, cart5_driven, 6, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(puma560, puma560_driven, 6, [tau1 tau2 tau3 tau4 tau5 tau6]);
arm!(panda, panda_driven, 7, [tau1 tau2 tau3 tau4 tau5 tau6 tau7]);
