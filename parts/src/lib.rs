#![doc = include_str!("../README.md")]
#![no_std]
#![deny(missing_docs)]

mod control;
mod electric;
mod friction;
mod hydraulics;
mod rope;
mod rotor;
mod stops;
mod transmission;
mod tyres;
mod vehicles;
mod water;

pub use control::{low_pass, pid, second_order, servo, state_feedback};
pub use electric::{dc_motor, inductive_motor};
pub use friction::stribeck_friction;
pub use hydraulics::hydraulic_cylinder;
pub use rope::rope;
pub use rotor::rotor;
pub use stops::bump_stops;
pub use transmission::{gear, gearbox, harmonic_drive};
pub use tyres::{combined_tyre, linear_tyre, magic_tyre};
pub use vehicles::{carcass, suspension};
pub use water::{buoyancy, water_drag};
