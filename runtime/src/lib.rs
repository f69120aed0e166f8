//! Equations of motion of mechanisms, derived symbolically while your crate compiles.
//!
//! A mechanism is declared inside [`multibody!`]; the macro checks its mechanics, derives its equations, removes all
//! work that is repeated or not needed, and emits plain Rust. This crate is what that code needs, and what integrates
//! it in time.
//!
//! ```
//! use multibody::{Rk4, multibody};
//!
//! multibody! {
//!     /// A rod that hangs from a hinge.
//!     pub mod pendulum {
//!         /// [m]
//!         param length = 1.0;
//!         world { gravity: -9.81 * Y }
//!         body rod { mass: 2.0, com: -0.5 * length * Y, inertia: rod(2.0, length, Y) }
//!         joint hinge: Revolute { parent: ground, child: rod, axis: Z }
//!         output energy = kinetic() + potential();
//!     }
//! }
//!
//! let model = pendulum::Model::new(&pendulum::Params { length: 0.8 });
//! let mut state = pendulum::State::default();
//! state.q.hinge = 0.5; // rad
//! let energy = model.outputs(0.0, &state, &()).energy;
//! for k in 0..1000 {
//!     state = Rk4::step(&model, 1e-3 * f64::from(k), &state, &(), 1e-3);
//! }
//! assert!((model.outputs(1.0, &state, &()).energy - energy).abs() < 1e-9);
//! ```
//!
//! - [`language`]: what a mechanism is declared with.
//! - [`generated`]: what the macro makes of it, and how to use that.
//! - [`integrators`]: [`Rk4`], [`SemiImplicitEuler`], [`Euler`], [`DormandPrince`] and others, with steps of one
//!   length or chosen by error: [`Integrator`].
//! - [`System`], [`StateSpace`], [`Configuration`], [`Tangent`]: what integrators see of a model, of its state, of its
//!   position and of its velocity. Generated models implement them; so do wrappers written by hand.
//! - [`Real`]: the scalar that generated code is generic over: `f32`, `f64`, lanes of them, dual numbers.
//! - [`Function`]: functions of your own, written in Rust, that models call.
//! - [`coordinates`]: the coordinates of joints that have several, [`Pose`], [`Placement`], [`Twist`] and [`Wrench`].
//! - [`rotation`]: unit quaternions that stay of unit length.
//! - [`Constrained`]: a model whose coordinates obey equations; [`assemble`] closes its loops, and [`projection`] keeps
//!   them closed.
//! - [`impact`]: impulses, and impacts with Newton's law, at joints and frames.
//! - [`mod@equilibrium`]: states of rest and steady motions.
//! - [`record`]: names, units and values of generated structs, and `Recorder`, which writes them as CSV.
//! - [`verify`](fn@verify): how well the functions of a model agree, for your tests.
//! - [`linear`]: small linear systems, with their rank and without a branch.
//!
//! # Conventions
//! Right-handed axes, SI units, radians; rotations map child to parent components. Velocities belong to coordinates:
//! with a quaternion it is the angular velocity of the child relative to the parent, in child axes, with
//! roll-pitch-yaw angles it is the rates of the three. All of them stand in [`language`](language#conventions).
//!
//! # Without std
//! Turn default features off and the feature `libm` on; [`embedded`] tells more, with figures. There is no allocation,
//! and no panic on any number: NaN and infinity pass through fixed steps and end an integration in a typed error. There is
//! no `unsafe` code, but for square roots by instruction where the feature `hardware-root` asks for them.
//!
//! # Features
//! - `std` (default): elementary functions of the platform.
//! - `libm`: the same in plain Rust, for targets without std. Sine and cosine of `f32` hold no operation of `f64` there,
//!   and take the same instructions for every angle up to 12,800 rad (`f64`: a million).
//! - `reproducible`: these functions on targets with std too, so that results are equal bit for bit on all of them. Not for
//!   dual numbers: those take the platform's functions.
//! - `hardware-root`, `hardware-root-double`: square roots of `f32`, and of `f64`, by the processor's instruction on Arm and
//!   RISC-V without std, where libm's take some 54 instructions in `f32`, fewer for NaN. They turn on the one file of `unsafe` code of this crate.
//! - `wide` (default): [`Real`] for simba's lanes, and vectors for the sines of several angles of `f64` or `f32`
//!   ([`Real::sin_cos_all`]), by a kernel of the crate's own.
//! - `std-sines`: these sines one by one by std, as those of single angles are.
//! - `fma`: products that are added to something are one instruction with one rounding, in what [`multibody!`] generates, where
//!   the target has it ([`Real::mul_add`]): faster, a little more accurate, and with other last bits. `reproducible` keeps its bits and leaves
//!   this feature without effect.
//! - `serde`: generated structs are written and read by serde under the names of their fields, without heap: see [`generated`](crate::generated#storing).
//! - `num-dual`: [`Real`] for the dual numbers of the crate `num-dual`, for derivatives.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(not(feature = "hardware-root"), forbid(unsafe_code))]
#![deny(missing_docs)]

// Generated code names this crate `::multibody`; with this line it can do so in this crate's own examples.
extern crate self as multibody;

pub mod assembly;
mod canonical;
mod configuration;
mod constrained;
pub mod coordinates;
mod cost;
mod differentiable;
#[doc(hidden)]
pub mod emitted;
mod equation;
#[doc = include_str!("../docs/embedded.md")]
pub mod embedded {}
pub mod equilibrium;
mod feedback;
mod function;
#[doc = include_str!("../docs/generated.md")]
pub mod generated {}
pub mod impact;
mod impulsive;
mod inertia;
pub mod integrators;
#[doc = include_str!("../docs/language.md")]
pub mod language {}
pub mod linear;
mod linearization;
mod lower_triangle;
mod opening;
#[doc(hidden)]
pub mod pivots;
pub mod projection;
pub mod record;
pub mod rotation;
mod sampled;
mod scalar;
mod second_order;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod serial;
mod shake;
mod simulate;
mod system;
mod tangent;
mod verify;
#[doc(hidden)]
pub mod words;

pub use assembly::AssemblyMode;
pub use canonical::{Canonical, Separable};
pub use configuration::Configuration;
pub use constrained::{Constrained, Kinematics};
pub use coordinates::{
    Cylindrical, FreeRollPitchYaw, PinSlot, Placement, Planar, Pose, RollPitchYaw, Twist, Universal, Wrench,
};
pub use cost::Cost;
pub use differentiable::{Derivatives, Differentiable, FullJacobian, Jacobian, JacobianMatrix, JacobianOf};
pub use equation::Equation;
pub use equilibrium::{Equilibrium, EquilibriumError, Free, constrained_equilibrium, equilibrium, trim};
pub use feedback::{Feedback, closed_loop};
pub use function::{Function, slope_deviation};
pub use impulsive::Impulsive;
pub use inertia::{ParamError, inertia_violation, is_held};
pub use integrators::{
    Composition4, Composition6, Dop853, DormandPrince, Euler, GaussLegendre4, GaussLegendre6, GeneralisedAlpha,
    ImplicitMidpoint, IntegrationError, Integrator, LaneEnd, LaneEnds, Method, Radau, Rk4, SemiImplicitEuler, Slope,
    SlopeOf, Statistics, Steps, SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint, Tolerance, Verlet,
};
pub use linearization::Linearization;
pub use lower_triangle::LowerTriangle;
#[cfg(not(feature = "serde"))]
#[doc(hidden)]
pub use multibody_macros::multibody as __multibody;
// Which macro is called is decided here, so that what it emits never asks for impls that this build of the crate lacks.
#[cfg(feature = "serde")]
#[doc(hidden)]
pub use multibody_macros::multibody_with_serde as __multibody;
pub use nalgebra;
#[doc(hidden)]
pub use opening::Gauge;
pub use opening::{Open, Opening};
pub use projection::{
    Assembled, AssemblyError, Projected, Projection, ProjectionError, WithBaumgarte, WithProjection, WithRank,
    ambiguity, assemble,
};
#[cfg(feature = "std")]
pub use record::Recorder;
pub use record::{Column, Columns};
pub use sampled::{Held, Sampled, sampled};
pub use scalar::{Four, Pack, Packed, Real, Two, all, any};
pub use second_order::SecondOrder;
#[cfg(feature = "serde")]
pub use serde;
pub use simba;
pub use simulate::{simulate, simulate_lanes, simulate_stiff};
pub use system::{DisplacementOf, ExtraOf, Margin, PositionOf, StateSpace, System, VelocityOf};
pub use tangent::Tangent;
pub use verify::{Agreement, Verifiable, verify, verify_at};

/// Derives the equations of motion of the declared mechanisms and emits them as Rust modules.
///
/// A call holds models and the parts that they use, one `mod` for each:
///
/// ```
/// multibody::multibody! {
///     /// A rod that hangs from a hinge.
///     pub mod pendulum {
///         /// [m]
///         param length = 1.0;
///         world { gravity: -9.81 * Y }
///         body rod { mass: 2.0, com: -0.5 * length * Y, inertia: rod(2.0, length, Y) }
///         joint hinge: Revolute { parent: ground, child: rod, axis: Z }
///         output energy = kinetic() + potential();
///         emit forward_dynamics, mass_matrix; // outputs are always emitted
///     }
/// }
/// assert_eq!(pendulum::DOF, 1);
/// ```
///
/// The module [`language`] documents the language, [`generated`] what is emitted. Generated code finds this crate under
/// whatever name yours has for it.
///
/// # Errors
///
/// Every mistake of a call is a compile error at the token where it stands, all of them in one build.
#[cfg(not(all(feature = "fma", not(feature = "reproducible"))))]
#[macro_export]
macro_rules! multibody {
    ($($tokens:tt)*) => {
        $crate::__multibody! { @runtime($crate) $($tokens)* }
    };
}

/// Derives the equations of motion of the declared mechanisms and emits them as Rust modules, with products fused to sums: the
/// feature `fma` is on. All else is told in the module [`language`].
///
/// # Errors
///
/// Every mistake of a call is a compile error at the token where it stands, all of them in one build.
#[cfg(all(feature = "fma", not(feature = "reproducible")))]
#[macro_export]
macro_rules! multibody {
    ($($tokens:tt)*) => {
        $crate::__multibody! { @runtime($crate) @fused $($tokens)* }
    };
}
