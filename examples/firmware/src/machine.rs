//! What differs between machines: where text goes, how instructions are counted, how a program ends.
//!
//! The only `unsafe` code of the firmware is here.

#[cfg(target_os = "none")]
mod bare;
#[cfg(not(any(target_os = "none", target_family = "wasm")))]
mod hosted;
#[cfg(all(target_os = "none", target_arch = "arm"))]
#[path = "machine/cortex_m.rs"]
mod processor;
#[cfg(all(target_os = "none", target_arch = "riscv32"))]
#[path = "machine/riscv.rs"]
mod processor;
#[cfg(target_family = "wasm")]
mod wasm;

#[cfg(target_os = "none")]
pub use bare::{exit, put, stack};
#[cfg(not(any(target_os = "none", target_family = "wasm")))]
pub use hosted::{exit, instructions, put, stack};
#[cfg(target_os = "none")]
pub use processor::{entry, instructions};
#[cfg(target_family = "wasm")]
pub use wasm::{instructions, put, stack};
