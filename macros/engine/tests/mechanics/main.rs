//! From the checked model to numbers: derived functions are interpreted on the graph and compared with plain f64
//! computations, with finite differences and with laws of mechanics.

mod balance;
mod expressions;
mod forces;
mod joints;
mod motion;
mod reactions;
mod support;
