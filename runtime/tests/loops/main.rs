//! Closed loops: assembly, projection, stabilisation, impacts, dead centres.

mod assembly;
#[path = "../common/mod.rs"]
mod common;
pub mod dead_centres;
pub mod flat_poses;
mod handlings;
mod impact;
mod many_margins;
pub mod open_starts;
mod projection;
mod stabilisation;
