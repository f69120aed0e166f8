//! Generated models on bare metal: what they compute, what they cost, and that they cannot panic.
//!
//! A [`Scene`] is one function of a model as a control loop would call it. [`run`] reports for each: the result of one
//! call, the hash of ten thousand, and, where [`machine`] can tell, instructions (least and most over random inputs) and
//! stack. All of it is the same code on every target; `cargo xtask firmware` builds, runs and compares.

#![no_std]

pub mod bounded;
mod digest;
pub mod machine;
mod models;
mod random;
mod report;
pub mod scenes;

pub use report::run;
pub use scenes::Scene;

/// The scalar of this build.
#[cfg(not(feature = "double"))]
pub type Scalar = f32;
/// The scalar of this build.
#[cfg(feature = "double")]
pub type Scalar = f64;

/// The firmware of one scene.
#[macro_export]
macro_rules! firmware {
    ($scene:ty) => {
        #[cfg(not(target_os = "none"))]
        fn main() {
            $crate::run::<$scene>();
        }

        #[cfg(target_os = "none")]
        #[cfg_attr(target_arch = "arm", $crate::machine::entry)]
        #[cfg_attr(target_arch = "riscv32", $crate::machine::entry)]
        fn start() -> ! {
            $crate::run::<$scene>();
            $crate::machine::exit()
        }
    };
}
