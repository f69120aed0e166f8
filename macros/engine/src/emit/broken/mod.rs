//! Room `broken`: what is written of a model with mistakes, so that one mistake is one error.

mod guesses;
pub(super) mod skeleton;
