//! The runtime of `multibody`: what generated equations of motion need, and what integrates them in time.
//!
//! - [`Real`]: the scalar that generated code is generic over: `f32`, `f64`, lanes of them, dual numbers.
//! - [`System`], [`StateSpace`], [`Configuration`], [`Tangent`]: what integrators see of a model, of its state, of its
//!   position and of its velocity. Generated models implement them; so do wrappers written by hand.
//! - [`integrators`]: [`Rk4`], [`SemiImplicitEuler`], [`Euler`], [`DormandPrince`] with a given step, [`Adaptive`] with
//!   steps chosen by error.
//! - [`coordinates`]: the coordinates of joints that have several, [`Pose`], [`Twist`] and [`Wrench`].
//! - [`rotation`]: unit quaternions that stay of unit length.
//!
//! # Conventions
//! Right-handed axes, SI units, radians; rotations map child to parent components. Velocities belong to coordinates:
//! with a quaternion it is the angular velocity of the child relative to the parent, in child axes, with
//! roll-pitch-yaw angles it is the rates of the three.
//!
//! # Without std
//! Turn default features off and the feature `libm` on. There is no allocation, no `unsafe` code, and no panic on any
//! number: NaN and infinity pass through fixed steps and end an integration in a typed error.
//!
//! # Features
//! - `std` (default): elementary functions of the platform.
//! - `libm`: the same in plain Rust, for targets without std.
//! - `num-dual`: [`Real`] for the dual numbers of the crate `num-dual`, for derivatives.

#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

// Generated code names this crate `::multibody`; with this line it can do so in this crate's own examples.
extern crate self as multibody;

mod configuration;
pub mod coordinates;
mod cost;
mod inertia;
pub mod integrators;
pub mod rotation;
mod scalar;
mod system;
mod tangent;

pub use configuration::Configuration;
pub use coordinates::{Cylindrical, FreeRollPitchYaw, Planar, Pose, RollPitchYaw, Twist, Universal, Wrench};
pub use cost::Cost;
pub use inertia::{ParamError, inertia_violation};
pub use integrators::{Adaptive, DormandPrince, Euler, IntegrationError, Method, Rk4, SemiImplicitEuler, Statistics};
pub use multibody_macros::multibody;
pub use nalgebra;
pub use scalar::{Real, all, any};
pub use simba;
pub use system::{ExtraOf, StateSpace, System, VelocityOf};
pub use tangent::Tangent;
