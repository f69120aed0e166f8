//! Elementary functions in plain arithmetic: the same bits on every machine; those of `f32` here hold no operation of
//! `f64`.
//!
//! They stand in where there is no std, and everywhere under the feature `reproducible`. Sine, cosine and the inverse
//! functions are here; what models seldom call comes from libm, whose functions are sums and products too, but some of
//! those for `f32` compute in `f64` (`hypotf`).
//!
//! Known crates do not fit: libm's `sinf` computes in `f64`, which a processor without a double-precision unit does in
//! software; fpmath 0.2 does so too; micromath and fast approximations miss by many units in the last place.

pub(super) mod arctangent;
mod polynomial;
mod reduction;
pub(super) mod sine;
