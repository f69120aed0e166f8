//! What the tests share: the models that they compile, reference data, and how errors are measured. Its only doctest is
//! the README's model.

pub mod models;
pub mod support;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
