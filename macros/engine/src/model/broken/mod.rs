//! Room `broken`: what is made of a model with mistakes, so that the rest of the user's code still compiles.

mod outline;
mod supposed;
