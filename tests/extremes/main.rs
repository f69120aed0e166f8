//! Extremes: long chains and runs, large angles and energies, numbers of every size, failures.

mod chain;
mod energy;
mod invariance;
mod loops;
mod motion;
mod numbers;
mod rotation;
