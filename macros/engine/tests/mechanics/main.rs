//! From the checked model to numbers: derived functions are interpreted on the graph and compared with plain f64
//! computations, with finite differences and with laws of mechanics.

mod alike;
mod analysis;
mod balance;
mod closings;
mod expressions;
mod forces;
mod formulations;
mod jacobians;
mod joints;
mod kinks;
mod loops;
mod motion;
mod random_outputs;
mod ranks;
mod reactions;
mod support;
