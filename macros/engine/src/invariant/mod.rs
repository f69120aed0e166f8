//! What cannot happen, and how it is said: below all stages, so that each can use it.
//!
//! In: a lookup whose answer must be there. Out: the answer, or a [`fault::Fault`], an error of this compiler that ends the
//! derivation and becomes one refusal at the model's name. No stage puts a zero in the place of what is missing: where absence
//! means something its type is an `Option` or a map, and the meaning stands where it is decided.
//!
//! [`index_vec`] has vectors that are indexed by ids of one type, [`injection`] breaks stages on purpose, [`kept`] has
//! slots for what later stages work out.

pub mod fault;
pub mod index_vec;
pub mod injection;
pub mod kept;
