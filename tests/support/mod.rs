//! Reference data and comparisons.

pub mod arm;
pub mod compare;
pub mod data;
pub mod energy;
pub mod engine;
pub mod jet;
pub mod ledger;
pub mod length;
pub mod long_runs;
pub mod plain;
pub mod random;
pub mod required;
