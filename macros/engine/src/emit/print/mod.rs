//! Room `print`: programs and numbers as Rust text; it knows fields by their paths and documents nothing.

pub(super) mod blocks;
pub(super) mod expressions;
pub(super) mod literals;
pub(super) mod parts;
pub(super) mod range;
pub(super) mod text;
