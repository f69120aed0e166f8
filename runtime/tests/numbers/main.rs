//! Scalars, rotations, inertias, small linear systems.

mod circle;
#[path = "../common/mod.rs"]
mod common;
#[cfg(feature = "num-dual")]
mod dual;
#[cfg(feature = "wide")]
mod fused;
mod inertia;
mod lanes;
mod linear;
mod lower_triangle;
mod rotation;
mod scalar;
#[cfg(feature = "reproducible")]
mod trigonometry;
#[cfg(not(feature = "reproducible"))]
mod truth;
