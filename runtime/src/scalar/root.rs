//! Square roots: those of std where it is there, else the processor's, else libm's. All are exact, so they are equal.

#[cfg(not(feature = "std"))]
pub(super) use without_std::*;

#[cfg(feature = "std")]
#[inline]
pub(super) fn f32(x: f32) -> f32 {
    x.sqrt()
}

#[cfg(feature = "std")]
#[inline]
pub(super) fn f64(x: f64) -> f64 {
    x.sqrt()
}

#[cfg(all(
    not(feature = "std"),
    feature = "hardware-root",
    any(target_arch = "arm", target_arch = "riscv32", target_arch = "riscv64")
))]
mod without_std {
    pub(in super::super) use super::super::hardware_root::f32;
    #[cfg(feature = "hardware-root-double")]
    pub(in super::super) use super::super::hardware_root::f64;
    #[cfg(not(feature = "hardware-root-double"))]
    pub(in super::super) use libm::sqrt as f64;
}

#[cfg(all(
    not(feature = "std"),
    not(all(feature = "hardware-root", any(target_arch = "arm", target_arch = "riscv32", target_arch = "riscv64")))
))]
mod without_std {
    pub(in super::super) use libm::{sqrt as f64, sqrtf as f32};
}
