//! Loops in closed form: every branch, the one that conditions name, and its derivatives.

mod branches;
mod closed_forms;
mod cycle;
#[path = "../common/interpreter.rs"]
mod interpreter;
mod reference;
#[path = "../common/rng.rs"]
mod rng;
mod transform;
