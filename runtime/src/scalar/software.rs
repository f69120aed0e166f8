//! Elementary functions in plain arithmetic: the same bits on every machine; sine and cosine of `f32` hold no operation of
//! `f64`.
//!
//! They stand in where there is no std, and everywhere under the feature `reproducible`. Sine and cosine are here; what
//! models seldom call comes from libm, whose functions are sums and products too; some of `f32` compute in `f64` (`asinf`, `hypotf`).
//!
//! Known crates do not fit: libm's `sinf` computes in `f64`, which a processor without a double-precision unit does in
//! software; fpmath 0.2 does so too; micromath and fast approximations miss by many units in the last place.

mod reduction;
pub(super) mod sine;
