//! Reference data and comparisons.

pub mod arm;
pub mod compare;
pub mod data;
pub mod engine;
pub mod jet;
pub mod ledger;
pub mod plain;
pub mod random;
pub mod required;
