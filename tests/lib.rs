//! What the tests share: the models that they compile, reference data, and how errors are measured.

pub mod models;
pub mod support;
